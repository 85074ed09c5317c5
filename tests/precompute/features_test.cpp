// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "support/creature.h"

namespace vsprite {
namespace {

TEST(Features, AngleOfAgreesWithAtan2) {
  for (int k = 0; k < 3600; ++k) {
    const double a = 2 * kPi * k / 3600;
    const double x = std::cos(a), y = std::sin(a);
    EXPECT_NEAR(angle_of(x, y), std::atan2(y, x), 1e-8) << k;
  }
  EXPECT_EQ(angle_of(0, 0), 0);
}

TEST(Features, AreSymmetricAndZeroForAPairWithItself) {
  const FeatureSet set = testing::make_creature(80, 40);
  for (int i = 0; i < 80; i += 7) {
    EXPECT_EQ(features(set, i, i), FeatureVector{});
    for (int j = 0; j < 80; j += 9) {
      const FeatureVector f = features(set, i, j);
      EXPECT_EQ(f, features(set, j, i));
      for (float value : f) EXPECT_GE(value, 0);
    }
  }
}

TEST(Features, AlphaCountsTheCellsThatDiffer) {
  SampleRow a, b;
  a.width = b.width = a.height = b.height = 16;
  a.anchor_x = b.anchor_x = a.anchor_y = b.anchor_y = 8;
  Image full{16, 16, std::vector<std::uint8_t>(1024, 255)}, half = full;
  for (std::size_t p = 0; p < 128; ++p) half.rgba[4 * p + 3] = 0;
  const FeatureSet set =
      make_feature_set({a, b}, 30, 16, [&](int i) { return i == 0 ? full : half; });
  EXPECT_EQ(features(set, 0, 1)[kAlpha], 128);
  EXPECT_EQ(features(set, 0, 1)[kColor], 0);
}

TEST(Features, AngleFadesAtLowSpeed) {
  SampleRow right, left;
  right.velocity_x = 100, left.velocity_x = -1;
  right.area = left.area = 100;  // side 10 px: faster than 2.5 px/s moves
  const FeatureSet set = make_feature_set({right, left}, 30, 16, [](int) { return Image{}; });
  EXPECT_NEAR(features(set, 0, 1)[kAngle], kPi / set.v0, 1e-5);
}

}  // namespace
}  // namespace vsprite
