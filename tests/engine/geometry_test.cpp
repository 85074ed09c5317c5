// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vsprite {
namespace {

TEST(Geometry, NamesAndParsingAreInverse) {
  for (int d = 0; d < kDirectionCount; ++d) {
    const auto direction = static_cast<Direction>(d);
    EXPECT_EQ(parse_direction(direction_name(direction)), direction) << direction_name(direction);
  }
}

TEST(Geometry, PairsMayBeNamedInAnyOrderAndOppositesCancel) {
  EXPECT_EQ(parse_direction("down+right"), Direction::RightDown);
  EXPECT_EQ(parse_direction(" up + left "), Direction::LeftUp);
  EXPECT_EQ(parse_direction("left+right"), Direction::None);
  EXPECT_EQ(parse_direction("left+right+up"), Direction::Up);
}

TEST(Geometry, UnknownNamesAreRefused) {
  for (const char* name : {"", "+", "right+", "+right", "Right", "rihgt", "right-up", "none+left",
                           "rest+up", "right up", "righ"}) {
    EXPECT_FALSE(parse_direction(name)) << '"' << name << '"';
  }
}

TEST(Geometry, UnitVectorsHaveLengthOneAndPointIntoTheirOwnSector) {
  for (int d = 0; d < kCompassCount; ++d) {
    const Vec2 unit = unit_vector(static_cast<Direction>(d));
    EXPECT_NEAR(std::hypot(unit.x, unit.y), 1.0, 1e-6);
    EXPECT_NEAR(std::atan2(unit.y, unit.x),
                std::remainder(d * std::acos(-1.0) / 4, 2 * std::acos(-1.0)), 1e-6);
    EXPECT_EQ(nearest_direction(unit), static_cast<Direction>(d));
  }
  EXPECT_EQ(unit_vector(Direction::None), Vec2());
  EXPECT_EQ(unit_vector(Direction::Rest), Vec2());
}

TEST(Geometry, SectorsAreFortyFiveDegreesWide) {
  const double pi = std::acos(-1.0);
  for (int tenths = 0; tenths < 3600; ++tenths) {
    const double angle = tenths * pi / 1800;
    if ((tenths + 225) % 450 == 0) continue;  // on the border
    const int due = ((tenths + 225) / 450) % 8;
    for (double length : {1e-30, 1.0, 1e30}) {
      const Vec2 v{static_cast<float>(length * std::cos(angle)),
                   static_cast<float>(length * std::sin(angle))};
      ASSERT_EQ(static_cast<int>(nearest_direction(v)), due) << tenths << " tenths of a degree";
    }
  }
  EXPECT_EQ(nearest_direction({0, 0}), Direction::None);
}

TEST(Geometry, AxesGiveTheEightDirections) {
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const Vec2 v{static_cast<float>(x), static_cast<float>(y)};
      EXPECT_EQ(direction_from_axes(x, y), nearest_direction(v));
    }
  }
}

TEST(Geometry, FixedPointRoundsToNearestAndSurvivesNonsense) {
  EXPECT_EQ(to_position({1.5f, -2.25f}), (Position{98304, -147456}));
  EXPECT_EQ(to_pixels(to_position({123.25f, -0.5f})), (Vec2{123.25f, -0.5f}));
  const float inf = std::numeric_limits<float>::infinity();
  const Position far = to_position({inf, -inf});
  EXPECT_EQ(far.x, -far.y);
  EXPECT_GT(far.x, std::int64_t{1} << 61);
  EXPECT_EQ(to_position({std::nanf(""), 1e30f}), (Position{0, far.x}));
}

}  // namespace
}  // namespace vsprite
