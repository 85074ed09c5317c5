// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/response.h"

#include <gtest/gtest.h>

#include "control/bench.h"
#include "support/tiny_sprite.h"

namespace vsprite {
namespace {

TEST(Response, CommandsWithoutATableGoToTheBetterNeighbourOrToRest) {
  std::array<DirectionReport, kCompassCount> reports{};
  for (std::size_t d = 0; d < kCompassCount; ++d) reports[d].direction = static_cast<Direction>(d);
  reports[0].reachable = reports[2].reachable = true;
  reports[0].tracking_error_deg = 9;
  reports[2].tracking_error_deg = 4;
  const ServedDirections served = serve_directions(reports);
  EXPECT_EQ(served.served, 5u);
  EXPECT_EQ(served.table_of[0], Direction::Right);
  EXPECT_EQ(served.table_of[1], Direction::Down);
  EXPECT_EQ(served.table_of[7], Direction::Right);
  EXPECT_EQ(served.table_of[4], Direction::Rest);
  EXPECT_EQ(served.table_of[8], Direction::None);
}

TEST(Response, TheTinySpriteGoesWhereItIsTold) {
  const Sprite sprite = testing::tiny_sprite();
  for (const DirectionReport& report : measure_directions(sprite, 0, 1)) {
    ASSERT_TRUE(report.reachable) << direction_name(report.direction);
    EXPECT_LT(*report.tracking_error_deg, 5) << direction_name(report.direction);
  }
  const SteerReport run =
      measure_steering(sprite, 0, random_script(60, 1.5, 4, sprite.fps(), 1), 1800, 1);
  EXPECT_EQ(run.freezes, 0u);
  EXPECT_EQ(run.unfinished, 0);
  EXPECT_GT(run.turns, 10);
  EXPECT_EQ(
      run.states_hash,
      measure_steering(sprite, 0, random_script(60, 1.5, 4, sprite.fps(), 1), 1800, 1).states_hash);
}

TEST(Response, RestComesToRest) {
  const Sprite sprite = testing::tiny_sprite();
  std::vector<TraceRow> trace;
  measure_steering(sprite, 0, *parse_key_script("0 right; 4 rest", sprite.fps()), 300, 1, &trace);
  EXPECT_GT(trace[100].x, trace[60].x);
  EXPECT_EQ(trace.back().x, trace[trace.size() - 60].x);
  EXPECT_EQ(trace.back().y, trace[trace.size() - 60].y);
}

TEST(Response, WhereNothingIsReachedEveryCommandRests) {
  const ServedDirections served = serve_directions({});
  EXPECT_EQ(served.served, 0u);
  for (std::size_t d = 0; d < kCompassCount; ++d)
    EXPECT_EQ(served.table_of[d], Direction::Rest) << d;
}

TEST(Response, RandomScriptsAreReproducibleAndAlwaysChange) {
  const KeyScript a = random_script(60, 1.5, 4, 30, 2), b = random_script(60, 1.5, 4, 30, 2);
  ASSERT_EQ(a.entries.size(), b.entries.size());
  for (std::size_t k = 0; k + 1 < a.entries.size(); ++k) {
    EXPECT_EQ(a.entries[k].tick, b.entries[k].tick);
    EXPECT_NE(a.entries[k].direction, a.entries[k + 1].direction);
    EXPECT_GE(a.entries[k + 1].tick - a.entries[k].tick, 44u);
  }
}

TEST(Response, ServingTwoDirectionsNarrowsTheHeadingsToo) {
  const Sprite sprite = testing::tiny_sprite();
  ControlMode mode = sprite.data().modes[0];
  serve(sprite, 0, 1, 0x11, mode);
  EXPECT_EQ(mode.served, 0x11u);
  EXPECT_EQ(mode.served_headings, 0x11u);
  EXPECT_EQ(mode.table_of[1], Direction::Right);
  EXPECT_EQ(mode.table_of[2], Direction::Rest);
}

TEST(Bench, MeasuresTheDefaultOfEveryModeAmongOthersTheSameAtEveryThreadCount) {
  const Sprite sprite = testing::tiny_sprite();
  BenchConfig config{.seeds = {5}, .seconds = 40};
  CurvePoint paper, responsive;
  paper.mode = "paper";
  responsive.mode = "responsive";
  config.grid = {paper, responsive};
  config.jobs = 1;
  const auto one = measure_curves(sprite, config);
  config.jobs = 4;
  const auto four = measure_curves(sprite, config);
  ASSERT_TRUE(one && four);
  ASSERT_EQ(one->curves.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const CurvePoint& p = one->curves[k];
    EXPECT_EQ(p.turn_median, four->curves[k].turn_median);
    EXPECT_EQ(p.cost_mean, four->curves[k].cost_mean);
    EXPECT_GT(p.turns, 10);
    EXPECT_GT(p.turn_median, 2);
    EXPECT_LT(p.tracking_worst, 23);
    EXPECT_GT(p.share_slow, p.share_fast);
  }
  EXPECT_EQ(one->floor.size(), 15u);
  const std::string svg = curves_svg(*one, "a < b");
  EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
}

// The tiny sprite's mode says which samples have turned, but not by what angle.
TEST(Bench, AModeThatNamesNoExitAngleIsSolvedWithTheUsualOne) {
  const Sprite sprite = testing::tiny_sprite();
  const ControlMode& mode = sprite.data().modes[1];
  ASSERT_EQ(mode.exit_angle, 0);
  BenchConfig config{.seeds = {5}, .seconds = 40};
  CurvePoint point;
  point.mode = "responsive";
  point.joint = joint_config(mode);
  EXPECT_EQ(point.joint.exit_deg, JointConfig{}.exit_deg);
  config.grid = {point};
  const auto result = measure_curves(sprite, config);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_LT(result->curves[0].tracking_worst, 23);
  ControlMode other = mode;
  other.exit_angle = 0.5f;
  EXPECT_NEAR(joint_config(other).exit_deg, 28.64789, 1e-5);
}

}  // namespace
}  // namespace vsprite
