// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/joint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "control/reach.h"
#include "similarity/features.h"
#include "support/dense_control.h"
#include "support/random_film.h"

namespace vsprite {
namespace {

using testing::RandomFilm;

constexpr double kV0 = 20;

// The problem of joint.h for a film, from its definition.
testing::DenseJoint dense_problem(const RandomFilm& film, const JointConfig& config) {
  testing::DenseJoint dense;
  dense.n = film.velocities.size();
  dense.price = testing::dense_costs(film.costs, config.cap);
  for (double& t : dense.price) t *= t;
  for (std::size_t i = 0; i < dense.n; ++i) {
    const auto skip = static_cast<double>(film.skip_costs[i]);
    if (config.play_through && skip <= config.cap)
      dense.price[i * dense.n + i + 2] = config.skip_price * skip * config.skip_price * skip;
  }
  dense.alpha = config.alpha, dense.rho = config.change_rate;
  dense.cruise_w1 = config.cruise_w1, dense.turn_w1 = config.turn_w1;
  const double fast = fast_speed(film.velocities, kV0);
  for (int l = 0; l < 8; ++l) {
    dense.angle.emplace_back();
    dense.turned.emplace_back();
    const Vec2 unit = unit_vector(static_cast<Direction>(l));
    for (const Vec2& v : film.velocities) {
      const double speed = std::hypot(v.x, v.y), f = std::min(1.0, speed / kV0);
      const double off =
          speed > 0 ? std::acos(std::clamp((v.x * unit.x + v.y * unit.y) / speed, -1.0, 1.0)) : 0;
      const double along = std::clamp((v.x * unit.x + v.y * unit.y) / fast, 0.0, 1.0);
      dense.angle[static_cast<std::size_t>(l)].push_back(
          f * std::max(0.0, off - config.bend_deg * kPi / 180) + (1 - f) * kPi +
          config.speed_weight * (1 - along));
      dense.turned[static_cast<std::size_t>(l)].push_back(speed > 0.7 * kV0 &&
                                                          off <= config.exit_deg * kPi / 180);
    }
  }
  return dense;
}

TEST(Joint, AgreesWithTheDenseProblemWithinTheCertifiedBound) {
  const RandomFilm film(40, 3);
  for (const double rho : {0.0, 0.05}) {
    const JointConfig config{
        .alpha = 0.97, .cap = 10, .change_rate = rho, .play_through = true, .skip_price = 0.4};
    const auto solution =
        solve_joint(film.costs, {film.velocities, film.skip_costs, kV0}, config, 0xFF);
    ASSERT_TRUE(solution) << solution.error().message;
    EXPECT_LT(solution->mode.residual, 1e-4);
    const auto due = dense_problem(film, config).solve();
    for (std::size_t l = 0; l < 8; ++l) {
      for (std::size_t stage = 0; stage < 2; ++stage) {
        for (std::size_t i = 0; i < 40; ++i) {
          const float value = solution->values[(2 * l + stage) * 41 + i];
          ASSERT_NEAR(static_cast<double>(value), due[stage * 8 + l][i],
                      solution->mode.error_bound + 1e-6)
              << "rho " << rho << " heading " << l << " stage " << stage << " sample " << i;
        }
      }
    }
  }
}

TEST(Joint, WhatItSolvesIsASpriteThatTheEngineTakes) {
  const RandomFilm film(40, 4);
  const auto solution = solve_joint(film.costs, {film.velocities, film.skip_costs, kV0},
                                    {.cap = 10, .play_through = true}, 0xFF);
  ASSERT_TRUE(solution);
  const auto sprite = make_sprite(film.data(solution->mode));
  EXPECT_TRUE(sprite) << sprite.error().message;
  EXPECT_TRUE(solution->mode.by_state);
  EXPECT_NEAR(std::atan2(solution->mode.bend_sin, solution->mode.bend_cos), kPi / 12, 1e-8);
}

TEST(Joint, EveryPartCanBeSwitchedOff) {
  const RandomFilm film(40, 5);
  const auto values = [&](const JointConfig& config) {
    return solve_joint(film.costs, {film.velocities, film.skip_costs, kV0}, config, 0xFF)->values;
  };
  const JointConfig off{.cruise_w1 = 0.3,
                        .turn_w1 = 0.3,
                        .cap = 10,
                        .change_rate = 0,
                        .speed_weight = 0,
                        .play_through = false,
                        .bend_deg = 0};
  const auto plain = values(off);
  for (std::size_t l = 0; l < 8; ++l) {  // one weight: both phases are the same table
    for (std::size_t i = 0; i < 40; ++i)
      ASSERT_NEAR(plain[2 * l * 41 + i], plain[(2 * l + 1) * 41 + i], 1e-4);
  }
  JointConfig on = off;
  on.turn_w1 = 2;
  EXPECT_NE(values(on), plain);
  on = off, on.change_rate = 0.01;
  EXPECT_NE(values(on), plain);
  on = off, on.speed_weight = 0.3;
  EXPECT_NE(values(on), plain);
  on = off, on.bend_deg = 15;
  EXPECT_NE(values(on), plain);
  on = off, on.play_through = true, on.skip_price = 0;
  EXPECT_NE(values(on), plain);
}

TEST(Joint, GivesTheSameTablesAtEveryThreadCount) {
  const RandomFilm film(60, 6);
  const Motion motion{film.velocities, film.skip_costs, kV0};
  const auto one = solve_joint(film.costs, motion, {}, 0xFF, 1);
  const auto four = solve_joint(film.costs, motion, {}, 0xFF, 4);
  ASSERT_TRUE(one && four);
  EXPECT_EQ(one->values, four->values);
  EXPECT_EQ(one->mode.next, four->mode.next);
}

TEST(Joint, SixteenHeadingsHoldTheEight) {
  const RandomFilm film(40, 7);
  const auto solution = solve_joint(film.costs, {film.velocities, film.skip_costs, kV0},
                                    {.cap = 10, .change_rate = 0, .headings = 16}, 0xFFFF);
  const auto eight = solve_joint(film.costs, {film.velocities, film.skip_costs, kV0},
                                 {.cap = 10, .change_rate = 0}, 0xFF);
  ASSERT_TRUE(solution && eight);
  EXPECT_EQ(solution->mode.tables(), 36u);
  EXPECT_TRUE(make_sprite(film.data(solution->mode)));
  for (std::size_t l = 0; l < 8; ++l) {
    for (std::size_t i = 0; i < 40; ++i)
      ASSERT_NEAR(solution->values[4 * l * 41 + i], eight->values[2 * l * 41 + i], 1e-4);
  }
}

TEST(Joint, RefusesSettingsThatMeanNothing) {
  const RandomFilm film(10, 8);
  const Motion motion{film.velocities, film.skip_costs, kV0};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const JointConfig& config :
       {JointConfig{.alpha = 1}, JointConfig{.alpha = nan}, JointConfig{.cruise_w1 = -1},
        JointConfig{.turn_w1 = nan}, JointConfig{.cap = 0}, JointConfig{.change_rate = 1},
        JointConfig{.speed_weight = -0.1}, JointConfig{.skip_price = nan},
        JointConfig{.bend_deg = 90}, JointConfig{.exit_deg = 0}, JointConfig{.headings = 12}}) {
    const auto solution = solve_joint(film.costs, motion, config, 0xFF);
    ASSERT_FALSE(solution);
    EXPECT_EQ(solution.error().code, ErrorCode::BadSetting);
    EXPECT_NE(solution.error().message.find("is due"), std::string::npos);
  }
}

TEST(Reach, ALowCapCutsTurnsOffAndTheFloorTellsSo) {
  const RandomFilm film(60, 9);
  const Motion motion{film.velocities, film.skip_costs, kV0};
  const std::vector<std::uint16_t> durations(61, 1);
  const Reach high = measure_reach(film.costs, motion, durations, 0xFF, 8, 1.2, false);
  const Reach low = measure_reach(film.costs, motion, durations, 0xFF, 8, 0.3, false);
  EXPECT_LE(high.floor, low.floor);
  EXPECT_LT(high.floor, 4);
  EXPECT_GT(low.floor, high.floor);
  const std::vector<std::uint16_t> twice(61, 2);
  EXPECT_EQ(measure_reach(film.costs, motion, twice, 0xFF, 8, 1.2, false).floor, 2 * high.floor);
  const double cap = choose_cap(film.costs, motion, durations, 0xFF, 8, false);
  EXPECT_GE(cap, 0.3);
  EXPECT_LE(cap, 1);
}

}  // namespace
}  // namespace vsprite
