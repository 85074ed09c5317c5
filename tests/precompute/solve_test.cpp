// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/solve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/dense_control.h"
#include "support/random_film.h"
#include "vsprite/random.h"

namespace vsprite {
namespace {

using vsprite::testing::random_costs;

std::vector<Vec2> random_velocities(std::size_t n, Random& random) {
  std::vector<Vec2> v;
  for (std::size_t i = 0; i < n; ++i) {
    v.push_back({static_cast<float>(100 * random.unit() - 50),
                 static_cast<float>(100 * random.unit() - 50)});
  }
  return v;
}

// The paper's literal iteration of F from F = T, edge by edge.
std::vector<double> iterate(const CostTable& costs, std::span<const Vec2> v, double v0, Direction l,
                            double w1, double alpha) {
  std::vector<double> values(costs.kept.size(), 0);
  for (int sweep = 0; sweep < 3000; ++sweep) {
    std::vector<double> after(values.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < values.size(); ++i) {
      for (std::uint32_t e = costs.row_start[i]; e < costs.row_start[i + 1]; ++e) {
        const Transition& t = costs.transitions[e];
        const double f = sweep == 0
                             ? static_cast<double>(t.cost)
                             : static_cast<double>(t.cost) + w1 * direction_cost(v[t.to], v0, l) +
                                   alpha * values[t.to];
        after[i] = std::min(after[i], f);
      }
    }
    values = after;
  }
  return values;
}

TEST(Solve, AgreesWithThePapersIterationWithinTheCertifiedBound) {
  Random random{3};
  const CostTable costs = random_costs(60, random);
  const auto v = random_velocities(61, random);
  const SolveConfig config{.alpha = 0.97, .w1 = 0.5, .cap = 10, .free_steps = 2};
  const auto solution = solve(costs, v, 20, config);
  ASSERT_TRUE(solution);
  EXPECT_LT(solution->mode.residual, 1e-5);
  for (int d = 0; d < kDirectionCount; ++d) {
    const auto due = iterate(costs, v, 20, static_cast<Direction>(d), 0.5, 0.97);
    const float* values = solution->values.data() + static_cast<std::size_t>(d) * 3 * 61;
    for (std::size_t i = 0; i < 60; ++i) {
      EXPECT_NEAR(static_cast<double>(values[i]), due[i], solution->mode.error_bound + 1e-9);
    }
    EXPECT_TRUE(std::isinf(values[60]));
  }
}

// Equation 2 as a matrix, from F = T: what the tables hold is that F, row by row.
TEST(Solve, GivesTheFOfThePaperLiterally) {
  Random random{7};
  const CostTable costs = random_costs(30, random);
  const auto v = random_velocities(31, random);
  const auto solution = solve(costs, v, 20, {.alpha = 0.95, .w1 = 0.4, .cap = 1, .free_steps = 0});
  ASSERT_TRUE(solution);
  const auto t = testing::dense_costs(costs, 1);
  for (std::size_t d = 0; d < kDirectionCount; ++d) {
    std::vector<double> angle;
    for (const Vec2& w : v) angle.push_back(direction_cost(w, 20, static_cast<Direction>(d)));
    const auto f = testing::dense_f(t, angle, 0.4, 0.95);
    for (std::size_t i = 0; i < 30; ++i) {
      const std::uint32_t next = solution->mode.next[d * 31 + i];
      double least = testing::kNever;
      for (std::size_t j = 0; j < 30; ++j) {
        least = std::min(least, f[i * 31 + j]);
        if (!std::isfinite(t[i * 31 + j])) continue;
        const auto go = static_cast<double>(solution->mode.go[d * 31 + j]);
        ASSERT_NEAR(f[i * 31 + j], t[i * 31 + j] + go, solution->mode.error_bound + 1e-5);
      }
      ASSERT_NEAR(f[i * 31 + next], least, 2 * solution->mode.error_bound + 1e-4);
    }
  }
}

TEST(Solve, ThePapersOwnIterationGivesTheSameTables) {
  Random random{8};
  const CostTable costs = random_costs(60, random);
  const auto v = random_velocities(61, random);
  SolveConfig config{.alpha = 0.97, .w1 = 0.5, .cap = 1, .free_steps = 3};
  const auto policy = solve(costs, v, 20, config);
  config.iterate = true;
  const auto iterated = solve(costs, v, 20, config);
  ASSERT_TRUE(policy && iterated);
  EXPECT_EQ(policy->mode.next, iterated->mode.next);
  for (std::size_t k = 0; k < policy->values.size(); ++k) {
    if (std::isfinite(policy->values[k])) {
      ASSERT_NEAR(policy->values[k], iterated->values[k], policy->mode.error_bound + 1e-5);
    }
  }
}

TEST(Solve, ChargesTheAngleToTheCommandAndPiForStanding) {
  for (int d = 0; d < kCompassCount; ++d) {
    for (int h = 0; h < kCompassCount; ++h) {
      const Vec2 unit = unit_vector(static_cast<Direction>(h));
      const int apart = std::min(std::abs(d - h), 8 - std::abs(d - h));
      EXPECT_NEAR(direction_cost({50 * unit.x, 50 * unit.y}, 20, static_cast<Direction>(d)),
                  apart * kPi / 4, 1e-6);
    }
    EXPECT_EQ(direction_cost({}, 20, static_cast<Direction>(d)), kPi);
  }
  EXPECT_EQ(direction_cost({}, 20, Direction::Rest), 0);
  EXPECT_EQ(direction_cost({0, 90}, 20, Direction::Rest), kPi);
  EXPECT_EQ(direction_cost({0, 90}, 20, Direction::None), 0);
}

TEST(Solve, GivesTheSameTablesAtEveryThreadCount) {
  Random random{4};
  const CostTable costs = random_costs(50, random);
  const auto v = random_velocities(51, random);
  const auto one = solve(costs, v, 20, {}, 1), four = solve(costs, v, 20, {}, 4);
  ASSERT_TRUE(one && four);
  EXPECT_EQ(one->values, four->values);
  EXPECT_EQ(one->mode.next, four->mode.next);
}

TEST(Solve, NeverEmptiesARowByTheCap) {
  Random random{5};
  const CostTable costs = random_costs(50, random);
  const auto v = random_velocities(51, random);
  const auto solution = solve(costs, v, 20, {.cap = 1e-6});
  ASSERT_TRUE(solution);
  for (std::size_t k = 0; k < solution->mode.next.size(); ++k) {
    EXPECT_EQ(solution->mode.next[k] == kNoSample, k % 51 == 50);
  }
}

TEST(Solve, RefusesAnAlphaOfOne) {
  Random random{6};
  const CostTable costs = random_costs(5, random);
  const auto v = random_velocities(6, random);
  for (double alpha : {1.0, -0.1, std::numeric_limits<double>::quiet_NaN()}) {
    const auto solution = solve(costs, v, 20, {.alpha = alpha});
    ASSERT_FALSE(solution);
    EXPECT_EQ(solution.error().code, ErrorCode::BadSetting);
  }
}

TEST(Solve, SaysWhichSettingDoesNotFitAndWhatIsDue) {
  Random random{6};
  const CostTable costs = random_costs(5, random);
  const auto v = random_velocities(6, random);
  const auto negative = solve(costs, v, 20, {.w1 = -1});
  ASSERT_FALSE(negative);
  EXPECT_EQ(negative.error().message, "solve: w1 is -1, 0 to 1000000 is due; correct the setting");
  const auto large = solve(costs, v, 20, {.free_steps = 10, .headings = 32});
  ASSERT_FALSE(large);
  EXPECT_EQ(large.error().message,
            "solve: free-steps is 10, with 32 directions at most 6 is due; correct the setting");
}

}  // namespace
}  // namespace vsprite
