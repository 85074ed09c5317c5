// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "maze.h"

#include <gtest/gtest.h>

namespace vsprite::maze {
namespace {

TEST(Maze, TheScriptedWayIsFreeAndTheWallsAreNot) {
  const auto corridors = make_corridors();
  for (std::size_t k = 1; k < kScript.size(); ++k)
    for (float t = 0; t <= 1; t += 0.05f)
      EXPECT_TRUE(is_free(corridors, {kScript[k - 1].x + t * (kScript[k].x - kScript[k - 1].x),
                                      kScript[k - 1].y + t * (kScript[k].y - kScript[k - 1].y)}));
  EXPECT_FALSE(is_free(corridors, {450, 300}));
  EXPECT_FALSE(is_free(corridors, {-10, 150}));
  EXPECT_FALSE(is_free(corridors, {900, 300}));
}

TEST(Maze, NobodyLeavesTheCorridorsWhateverIsSteered) {
  const auto corridors = make_corridors();
  for (int course = 0; course < 16; ++course) {
    Vec2 at = kScript[0];
    for (int tick = 0; tick < 2000; ++tick) {
      const double angle = course * 0.39 + tick * 0.011;
      const Vec2 to{at.x + static_cast<float>(8 * std::cos(angle)),
                    at.y + static_cast<float>(8 * std::sin(angle))};
      at = slide(corridors, at, to);
      ASSERT_TRUE(is_free(corridors, at));
    }
  }
}

TEST(Maze, AWallIsSlidAlong) {
  const auto corridors = make_corridors();
  const Vec2 at{400, 150 + kReach};
  const Vec2 slid = slide(corridors, at, {405, 160 + kReach});
  EXPECT_EQ(slid, (Vec2{405, at.y}));
}

TEST(Maze, AllFoodCanBeEaten) {
  const auto corridors = make_corridors();
  auto food = make_food(corridors);
  EXPECT_GT(food.size(), 30u);
  for (const Vec2 p : std::vector(food)) {
    EXPECT_TRUE(is_free(corridors, p));
    eat(food, p);
  }
  EXPECT_TRUE(food.empty());
}

}  // namespace
}  // namespace vsprite::maze
