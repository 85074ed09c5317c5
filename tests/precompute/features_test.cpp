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

TEST(Features, PerAreaAreFreeOfScale) {
  const auto take = [](int size) {
    std::vector<SampleRow> rows(2);
    for (int i = 0; i < 2; ++i) {
      SampleRow& r = rows[static_cast<std::size_t>(i)];
      r.width = r.height = size, r.anchor_x = r.anchor_y = size / 2;
      r.velocity_x = size * (2 + i), r.area = size * size / (1.0 + i);
    }
    FeatureSet set = make_feature_set(rows, 30, 16, [&](int i) {
      Image image{size, size, std::vector<std::uint8_t>(static_cast<std::size_t>(4 * size * size))};
      for (std::size_t p = 0; p < image.rgba.size(); p += 4) {
        image.rgba[p] = static_cast<std::uint8_t>(100 + 50 * i);
        image.rgba[p + 3] = i == 0 || p < image.rgba.size() / 2 ? 255 : 0;
      }
      return image;
    });
    set.scale = FeatureScale::PerArea;
    return features(set, 0, 1);
  };
  const FeatureVector near = take(64), far = take(32);
  EXPECT_EQ(near, far);
  EXPECT_FLOAT_EQ(near[kAlpha], 128.0f / 192);  // 256 cells against 128
  EXPECT_FLOAT_EQ(near[kColor], 50 * std::sqrt(128.0f / 192));
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
