// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/floor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "vsprite/random.h"

namespace vsprite {
namespace {

/// A subject 0.75 as high as its feet lie below the horizon at 100, seen at feet from 180 to 420,
/// its height swaying by `sway` of itself, one sight in ten a crouch.
std::vector<Standing> walk(double sway) {
  Random random{3};
  std::vector<Standing> out;
  for (int k = 0; k < 1000; ++k) {
    const double feet = 300 + 120 * std::sin(k * 0.05);
    const double height = 0.75 * (feet - 100) * (1 + sway * (2 * random.unit() - 1));
    out.push_back({feet + random.unit() - 0.5, k % 10 == 0 ? 0.6 * height : height});
  }
  return out;
}
std::string error_of(const std::vector<Standing>& sights, const FloorChoice& choice) {
  const auto floor = find_floor(sights, choice, 640);
  return floor ? "" : floor.error().message;
}
bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

TEST(Floor, TheHorizonIsFoundThroughStridesAndCrouches) {
  const auto floor = find_floor(walk(0.08), {.horizon = {}, .fitted = true}, 640);
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->horizon, 100, 6);
  EXPECT_NEAR(floor->line, 420, 1);
  EXPECT_EQ(floor->center, 320);
  EXPECT_EQ(floor->focal, 512);
}

TEST(Floor, WhatIsGivenIsTaken) {
  const auto floor = find_floor(walk(0), {.horizon = 80, .line = 400, .focal = 900}, 640);
  ASSERT_TRUE(floor);
  EXPECT_EQ(floor->horizon, 80);
  EXPECT_EQ(floor->line, 400);
  EXPECT_EQ(floor->focal, 900);
}

TEST(Floor, SaysWhatCannotBe) {
  std::vector<Standing> same, flat;
  for (int k = 0; k < 100; ++k) same.push_back({200.0 + k, 90}), flat.push_back({200, 90.0 + k});
  EXPECT_TRUE(has(error_of(same, {.horizon = {}, .fitted = true}), "keeps its size, 90 px with"));
  EXPECT_TRUE(has(error_of(flat, {.horizon = {}, .fitted = true}), "feet stay at y = 200"));
  EXPECT_TRUE(has(error_of(walk(0), {.horizon = 300}), "feet come to y = 18"));
  EXPECT_TRUE(has(error_of(walk(0), {.horizon = 100, .line = 90}), "above the horizon"));
  EXPECT_FALSE(error_of({}, {.horizon = 100}).empty());
}

}  // namespace
}  // namespace vsprite
