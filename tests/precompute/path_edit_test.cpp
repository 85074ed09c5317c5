// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/path_edit.h"

#include <gtest/gtest.h>

#include "tool/path_script.h"

namespace vsprite {
namespace {

using Points = std::vector<Vec2>;

TEST(PathEdit, EveryStepIsTakenBackAndDoneAgain) {
  PathEdit edit({{0, 0}, {100, 0}});
  edit.insert(2, {100, 100});
  edit.insert(1, {50, 0});
  edit.erase(0);
  EXPECT_EQ(edit.points(), (Points{{50, 0}, {100, 0}, {100, 100}}));
  EXPECT_TRUE(edit.undo());
  EXPECT_EQ(edit.points(), (Points{{0, 0}, {50, 0}, {100, 0}, {100, 100}}));
  EXPECT_TRUE(edit.undo());
  EXPECT_TRUE(edit.undo());
  EXPECT_FALSE(edit.undo());
  EXPECT_EQ(edit.points(), (Points{{0, 0}, {100, 0}}));
  EXPECT_TRUE(edit.redo());
  EXPECT_TRUE(edit.redo());
  EXPECT_TRUE(edit.redo());
  EXPECT_FALSE(edit.redo());
  EXPECT_EQ(edit.points(), (Points{{50, 0}, {100, 0}, {100, 100}}));
  EXPECT_TRUE(edit.undo());
  edit.clear();
  EXPECT_FALSE(edit.redo());  // what was to come is gone
  EXPECT_TRUE(edit.undo());
  EXPECT_EQ(edit.points().size(), 4u);
}

TEST(PathEdit, ADragIsOneStepAndSoIsAPointDrawnAndDragged) {
  PathEdit edit({{0, 0}, {100, 0}});
  edit.take(1);
  for (int k = 1; k <= 20; ++k) edit.move({100, static_cast<float>(k)});
  edit.drop();
  edit.move({7, 7});  // nothing is held
  EXPECT_EQ(edit.points()[1], (Vec2{100, 20}));
  edit.insert(2, {50, 50});
  edit.take(2);
  edit.move({60, 60});
  edit.move({70, 70});
  edit.drop();
  EXPECT_TRUE(edit.undo());
  EXPECT_EQ(edit.points(), (Points{{0, 0}, {100, 20}}));
  EXPECT_TRUE(edit.undo());
  EXPECT_EQ(edit.points(), (Points{{0, 0}, {100, 0}}));
  edit.take(0);  // held and let go where it was: no step
  edit.move({0, 0});
  edit.drop();
  EXPECT_TRUE(edit.redo());
}

TEST(PathEdit, KnowsWhetherItIsSaved) {
  PathEdit edit({{0, 0}, {100, 0}});
  EXPECT_TRUE(edit.is_saved());
  edit.insert(2, {5, 5});
  EXPECT_FALSE(edit.is_saved());
  edit.mark_saved();
  EXPECT_TRUE(edit.is_saved());
  edit.undo();
  EXPECT_FALSE(edit.is_saved());
  edit.redo();
  EXPECT_TRUE(edit.is_saved());
}

TEST(PathEdit, FindsTheNearestPointAndSegment) {
  const PathEdit edit({{0, 0}, {100, 0}, {100, 0}, {100, 100}});
  EXPECT_EQ(edit.point_at({95, 3}, 10), 2u);  // of two in one place the later one
  EXPECT_EQ(edit.point_at({50, 3}, 10), std::nullopt);
  EXPECT_EQ(edit.segment_at({50, 3}, 10), 0u);
  EXPECT_EQ(edit.segment_at({96, 60}, 10), 2u);
  EXPECT_EQ(edit.segment_at({50, 50}, 10), std::nullopt);
  EXPECT_EQ(PathEdit().point_at({0, 0}, 10), std::nullopt);
}

TEST(PathEdit, WhatIsSavedIsReadBackWithItsComments) {
  const std::string text = "# A square.\n\n   # By hand.\n10 20\n# not this one\n30 40\n";
  EXPECT_EQ(head_of_path(text), "# A square.\n\n   # By hand.\n");
  EXPECT_EQ(head_of_path("10 20\n"), "");
  EXPECT_EQ(head_of_path(""), "");
  const std::string saved = format_path({{10, 20.04f}, {-0.01f, 1234.56f}}, head_of_path(text));
  EXPECT_EQ(saved, "# A square.\n\n   # By hand.\n10 20\n0 1234.6\n");
  const auto read = parse_path(saved, "x");
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, (Points{{10, 20}, {0, 1234.6f}}));
}

}  // namespace
}  // namespace vsprite
