// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/image.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vsprite {
namespace {

double decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

TEST(Image, LinearTableIsTheStandardsFormula) {
  for (int e = 0; e < 256; ++e) {
    EXPECT_EQ(linear_from_srgb(static_cast<std::uint8_t>(e)),
              static_cast<std::uint16_t>(decode(e / 255.0) * 65535 + 0.5))
        << e;
  }
}

TEST(Image, EncodedTableIsTheNearestCodeOfEveryLinearValue) {
  for (int l = 0; l < 65536; ++l) {
    const double linear = l / 65535.0;
    const double encoded =
        255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
    const double half = std::fabs(encoded - std::floor(encoded) - 0.5);
    if (half < 1e-4) continue;  // the standard's two formulas disagree that much
    ASSERT_EQ(srgb_from_linear(static_cast<std::uint16_t>(l)), static_cast<int>(encoded + 0.5))
        << l;
  }
}

TEST(Image, EncodingUndoesDecoding) {
  for (int e = 0; e < 256; ++e) {
    EXPECT_EQ(srgb_from_linear(linear_from_srgb(static_cast<std::uint8_t>(e))), e);
  }
}

TEST(Image, PremultiplyRoundsToNearest) {
  Image image{256, 256, std::vector<std::uint8_t>(4 * 256 * 256)};
  for (std::size_t i = 0; i < 65536; ++i) {
    for (std::size_t c = 0; c < 3; ++c) image.rgba[4 * i + c] = static_cast<std::uint8_t>(i % 256);
    image.rgba[4 * i + 3] = static_cast<std::uint8_t>(i / 256);
  }
  premultiply(image);
  for (std::size_t i = 0; i < 65536; ++i) {
    const double exact = static_cast<double>(i % 256) * static_cast<double>(i / 256) / 255;
    ASSERT_EQ(image.rgba[4 * i], static_cast<int>(exact + 0.5)) << i;
    ASSERT_EQ(image.rgba[4 * i + 3], i / 256);
  }
}

TEST(Image, UnpremultiplyIsExactWhereOpaqueAndWithinRoundingElsewhere) {
  for (int alpha : {0, 1, 2, 51, 128, 254, 255}) {
    for (int value = 0; value < 256; ++value) {
      const auto v = static_cast<std::uint8_t>(value);
      Image image{1, 1, {v, v, v, static_cast<std::uint8_t>(alpha)}};
      premultiply(image);
      Image again = image;
      unpremultiply(again);
      if (alpha > 0) {
        EXPECT_LE(std::abs(again.rgba[0] - value), alpha == 255 ? 0 : 128 / alpha + 1);
      }
      premultiply(again);
      EXPECT_EQ(again.rgba, image.rgba) << "value " << value << ", alpha " << alpha;
    }
  }
}

}  // namespace
}  // namespace vsprite
