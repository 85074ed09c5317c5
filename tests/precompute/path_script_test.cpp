// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/path_script.h"

#include <gtest/gtest.h>

namespace vsprite {
namespace {

TEST(PathScript, ReadsPointsAndSkipsComments) {
  const auto points = parse_path("# a corner\n0 0\n\n 10.5\t-2 # turn\r\n1e2 3", "p.txt");
  ASSERT_TRUE(points);
  ASSERT_EQ(points->size(), 3u);
  EXPECT_EQ((*points)[1], (Vec2{10.5f, -2}));
  EXPECT_EQ((*points)[2], (Vec2{100, 3}));
}

TEST(PathScript, NamesFileLineAndWhatWasFound) {
  for (const char* line : {"1", "1 2 3", "1,2", "nan 1", "1 inf", "1e99 0", "x y"}) {
    const auto points = parse_path("0 0\n" + std::string(line) + "\n", "p.txt");
    ASSERT_FALSE(points) << line;
    EXPECT_EQ(points.error().code, ErrorCode::BadContent);
    EXPECT_EQ(points.error().message.rfind("p.txt:2: `" + std::string(line) + "`", 0), 0u);
  }
}

TEST(PathScript, ThePictureHoldsThePathAndABodyLengthAround) {
  const PathPicture picture = picture_around({{100, 50}, {300, 90}}, 20);
  EXPECT_EQ(picture.origin, (Vec2{80, 30}));
  EXPECT_EQ(picture.width, 240);
  EXPECT_EQ(picture.height, 80);
}

TEST(PathScript, APathOutsideThePictureIsRefusedOneThatEntersIsNot) {
  const PathPicture picture{100, 100, {}};
  EXPECT_TRUE(check_inside({{-50, 50}, {50, 50}}, picture, "p"));
  EXPECT_FALSE(check_inside({{-50, 50}, {-1, 50}}, picture, "p"));
  EXPECT_FALSE(check_inside({{10, 101}, {50, 500}}, picture, "p"));
}

}  // namespace
}  // namespace vsprite
