// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/svg_points.h"

#include <gtest/gtest.h>

namespace vsprite {
namespace {

using Points = std::vector<Vec2>;

Result<Points> read(const std::string& body, const std::string& page = "viewBox='0 0 100 50'") {
  return parse_svg_points("<svg xmlns='http://www.w3.org/2000/svg' " + page + ">" + body + "</svg>",
                          "a.svg", 200, 100);
}
/// In a page of the picture's size.
Points path(const std::string& data) {
  const auto points = read("<path d='" + data + "'/>", "viewBox='0 0 200 100'");
  EXPECT_TRUE(points) << points.error().message;
  return points ? *points : Points{};
}

TEST(SvgPoints, EveryCommandEndsInANode) {
  EXPECT_EQ(path("M10 20L30,40 H50 V60"), (Points{{10, 20}, {30, 40}, {50, 40}, {50, 60}}));
  EXPECT_EQ(path("m10 20l5 5h5v5"), (Points{{10, 20}, {15, 25}, {20, 25}, {20, 30}}));
  EXPECT_EQ(path("M1 2 C 0 0 9 9 3 4 s 9 9 2 2 Q 8 8 7 8 t 1 1 A 5 5 30 0 1 9 10"),
            (Points{{1, 2}, {3, 4}, {5, 6}, {7, 8}, {8, 9}, {9, 10}}));
}

TEST(SvgPoints, NumbersNeedNothingBetweenThem) {
  EXPECT_EQ(path("M1.5.5-2-3e1"), (Points{{1.5f, 0.5f}, {-2, -30}}));
  EXPECT_EQ(path("M0,0a5,5 0 1150 20"), (Points{{0, 0}, {50, 20}}));  // flags 1 and 1, then 50
  EXPECT_EQ(path("M1 2 3 4m1 1 1 1"), (Points{{1, 2}, {3, 4}, {4, 5}, {5, 6}}));
}

TEST(SvgPoints, AClosedPathHasEveryNodeOnce) {
  EXPECT_EQ(path("M1 1 H9 V9 Z"), (Points{{1, 1}, {9, 1}, {9, 9}}));
  EXPECT_EQ(path("M1 1 H9 V9 L1 1 Z"), (Points{{1, 1}, {9, 1}, {9, 9}}));
  EXPECT_EQ(path("M1 1 H9 z l 2 2"), (Points{{1, 1}, {9, 1}, {1, 1}, {3, 3}}));
}

TEST(SvgPoints, ThePageLiesOverThePictureAndGroupsMoveTheirPaths) {
  const auto points = read(
      "<g transform='translate(10 5) scale(2)'><path d='M1 1'/>"
      "<g transform='rotate(90)'><path d='M1 0'/></g></g>"
      "<polygon points='1,2 3,4'/><polyline points='5 6'/><line x1='7' y1='8' x2='9' y2='10'/>"
      "<defs><path d='M90 40'/></defs><path style='display:none' d='M90 40'/>");
  ASSERT_TRUE(points) << points.error().message;
  EXPECT_EQ(*points, (Points{{24, 14}, {20, 14}, {2, 4}, {6, 8}, {10, 12}, {14, 16}, {18, 20}}));
  EXPECT_EQ(*read("<path d='M5 5'/>", "viewBox='-5 0 100 50'"), (Points{{20, 10}}));
  EXPECT_EQ(*read("<path d='M5 5'/>", "width='100mm' height='50mm' viewBox='0 0 100 50'"),
            (Points{{10, 10}}));
  EXPECT_EQ(*read("<path d='M5 5'/>", ""), (Points{{5, 5}}));
  EXPECT_EQ(*read("<path d='M96 48'/>", "width='2in' height='96'"), (Points{{100, 50}}));
}

TEST(SvgPoints, NamesWhatIsWrong) {
  const std::pair<Result<Points>, const char*> bad[] = {
      {parse_svg_points("hello", "a.svg", 9, 9), "a.svg: no XML at byte"},
      {parse_svg_points("", "a.svg", 9, 9), "no XML"},
      {parse_svg_points("<html/>", "a.svg", 9, 9), "its root is <html>"},
      {read(""), "no path is in it"},
      {read("<path id='ear' d='L1 1'/>"), "path `ear`: it has to begin with M"},
      {read("<path d='M1 1 X2'/>"), "`X` is no command"},
      {read("<path d='M1 1 L2'/>"), "`L` needs 2 numbers"},
      {read("<path d='M1 nan'/>"), "`M` needs 2 numbers"},
      {read("<path d='M1 1 Z 3'/>"), "a command is due where `3` stands"},
      {read("<path d='M0 0 a5 5 0 2 1 3 3'/>"), "`a` needs 7 numbers"},
      {read("<path d='M99999999 0'/>"), "at most 30000 is due"},
      {read("<path d='M1 1'/>", "viewBox='0 0 100 100'"), "has another shape than the picture"},
      {read("<path d='M1 1'/>", "viewBox='0 0 0 0'"), "viewBox"},
      {read("<g transform='spin(3)'/>"), "transform: `spin(3)`"},
      {read("<g transform='scale'/>"), "transform"}};
  for (const auto& [points, due] : bad) {
    ASSERT_FALSE(points) << due;
    EXPECT_EQ(points.error().code, ErrorCode::BadContent);
    EXPECT_NE(points.error().message.find(due), std::string::npos) << points.error().message;
  }
}

}  // namespace
}  // namespace vsprite
