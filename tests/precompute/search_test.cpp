// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "similarity/features.h"
#include "support/naive_beam.h"
#include "support/tiny_sprite.h"

namespace vsprite {
namespace {

using testing::naive_beam;
using testing::Selection;

const std::vector<Vec2> kSquare = {{10, 10}, {90, 10}, {90, 90}, {10, 90}, {10, 10}};
const std::vector<Vec2> kCorner = {{0, 0}, {10, 0}, {10, 6}};

PathWeights weights(double tau = 0) {
  return {.w1 = 0.3,
          .w2 = 0.02,
          .tau = tau,
          .usual_speed = testing::kTinySpeed,
          .v0 = 20,
          .least_speed = 5};
}
PathCost path_of(const Sprite& sprite, std::span<const Vec2> points, double tau = 0) {
  return *PathCost::make(sprite, points, weights(tau));
}

bool same(const PathState& a, const PathState& b) {
  return a.cost == b.cost && a.x == b.x && a.y == b.y && a.sample == b.sample &&
         a.segment == b.segment && a.arc == b.arc && a.slack == b.slack;
}
using Beams = std::vector<std::vector<PathState>>;
auto keep_in(Beams& beams) {
  return [&beams](std::span<const PathState> s) { beams.emplace_back(s.begin(), s.end()); };
}
void expect_same(const Beams& a, const Beams& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t t = 0; t < a.size(); ++t)
    ASSERT_TRUE(std::equal(a[t].begin(), a[t].end(), b[t].begin(), b[t].end(), same)) << t;
}

TEST(Search, SurvivorsAreThoseOfSortingEverythingAtEveryWidth) {
  const Sprite sprite = testing::tiny_sprite();
  for (const double tau : {0.0, 0.1}) {
    const PathCost path = path_of(sprite, kSquare, tau);
    for (const int width : {1, 2, 7, 100, 5000}) {
      Beams ours, due;
      const auto clip = search_path(path, {.width = width, .survivors = keep_in(ours)});
      const auto naive =
          naive_beam(path, static_cast<std::size_t>(width), Selection::Sort, 0, keep_in(due));
      expect_same(ours, due);
      ASSERT_EQ(clip.has_value(), naive.best != kNoCost) << width;
      if (!clip || tau > 0) continue;
      EXPECT_EQ(clip->cost, static_cast<double>(naive.best) / kCostOne) << width;
    }
  }
}

TEST(Search, TheResultDoesNotDependOnTheThreads) {
  const Sprite sprite = testing::tiny_sprite();
  const PathCost path = path_of(sprite, kSquare);
  Beams one, three;
  ASSERT_TRUE(search_path(path, {.width = 20000, .jobs = 1, .survivors = keep_in(one)}));
  ASSERT_TRUE(search_path(path, {.width = 20000, .jobs = 3, .survivors = keep_in(three)}));
  expect_same(one, three);
}

// Equation 1 in plain floating point, on every sequence there is.
struct Exhaustive {
  const Sprite& sprite;
  const PathCost& path;
  double best = std::numeric_limits<double>::infinity();

  double at(std::uint32_t sample, double x, double y, std::uint32_t l) const {
    const auto& s = path.segments()[l];
    const Vec2 v = sprite.samples()[sample].velocity;
    const double f = std::min(1.0, double{std::hypot(v.x, v.y)} / 20);
    const double angle = std::acos(
        std::clamp((v.x * s.unit_x + v.y * s.unit_y) / std::max(1e-9, double{std::hypot(v.x, v.y)}),
                   -1.0, 1.0));
    const double d = (y - s.y / kPathUnit) * s.unit_x - (x - s.x / kPathUnit) * s.unit_y;
    return 0.3 * (f * angle + (1 - f) * kPi) + 0.02 * d * d;
  }
  void go(std::uint32_t sample, double x, double y, std::uint32_t l, double cost, int depth) {
    if (cost >= best || depth > 40) return;
    const Sample& s = sprite.samples()[sample];
    for (int tick = 1; tick <= s.duration; ++tick) {
      x += s.step_x / kPathUnit;
      y += s.step_y / kPathUnit;
      const auto passed = [&](const PathSegment& p) {
        return (x - p.x / kPathUnit) * p.unit_x + (y - p.y / kPathUnit) * p.unit_y >=
               p.length / kPathUnit;
      };
      while (l < path.segments().size() && passed(path.segments()[l])) ++l;
      if (l == path.segments().size()) {
        best = std::min(best, cost);
        return;
      }
      cost += tick < s.duration ? at(sample, x, y, l) : off(x, y, l);
    }
    for (const Transition& t : sprite.transitions(sample))
      go(t.to, x, y, l, cost + double{t.cost} + at(t.to, x, y, l) - off(x, y, l), depth + 1);
  }
  double off(double x, double y, std::uint32_t l) const {
    const auto& s = path.segments()[l];
    const double d = (y - s.y / kPathUnit) * s.unit_x - (x - s.x / kPathUnit) * s.unit_y;
    return 0.02 * d * d;
  }
};

TEST(Search, AFullWidthBeamFindsWhatExhaustiveSearchFinds) {
  const Sprite sprite = testing::tiny_sprite();
  const PathCost path = path_of(sprite, kCorner);
  const auto clip = search_path(path, {.width = 5000000});
  ASSERT_TRUE(clip);
  Exhaustive all{sprite, path, clip->cost + 0.01};
  for (std::uint32_t i = 1; i < testing::kTinySamples; ++i)
    all.go(i, 0, 0, 0, all.at(i, 0, 0, 0), 0);
  EXPECT_NEAR(clip->cost, all.best, 1e-4);
}

TEST(Search, FollowsASelfCrossingPathInTheOrderOfItsSegments) {
  const Sprite sprite = testing::tiny_sprite();
  const std::vector<Vec2> cross = {{0, 50}, {120, 50}, {120, 0}, {60, 0}, {60, 110}};
  const PathCost path = path_of(sprite, cross, 0.1);
  const auto clip = search_path(path, {.width = 20000});
  ASSERT_TRUE(clip);
  std::uint32_t before = 0;
  for (const ClipTick& tick : clip->ticks) {
    EXPECT_TRUE(tick.segment == before || tick.segment == before + 1);
    before = tick.segment;
    EXPECT_LT(tick.deviation, sprite.data().body_length / 2);
  }
  EXPECT_EQ(before, 3u);
}

TEST(Search, AClipMovesByTheStepsOfItsSamplesAndPaysItsCost) {
  const Sprite sprite = testing::tiny_sprite();
  const PathCost path = path_of(sprite, kSquare);
  const auto clip = search_path(path, {.width = 1000});
  ASSERT_TRUE(clip);
  EXPECT_EQ(clip->ticks[0].position, to_position(kSquare[0]));
  double cost = clip->ticks[0].cost;
  for (std::size_t k = 1; k < clip->ticks.size(); ++k) {
    const ClipTick &a = clip->ticks[k - 1], &b = clip->ticks[k];
    const Sample& shown = sprite.samples()[a.sample];
    EXPECT_EQ(b.position.x - a.position.x, shown.step_x);
    EXPECT_EQ(b.position.y - a.position.y, shown.step_y);
    if (b.sample != a.sample) {
      EXPECT_EQ(b.transition, sprite.transition_cost(a.sample, b.sample));
    }
    cost += b.cost;
  }
  EXPECT_NEAR(cost, clip->cost, 1e-9);
}

TEST(Search, WhoeverMakesNoHeadwayIsDropped) {
  SpriteData data = testing::tiny_sprite_data();
  for (Sample& s : data.samples) {  // film of something that only ever goes up
    s.step_x = 0;
    s.step_y = -65536;
    s.velocity = {0, -30};
  }
  const Sprite sprite = *make_sprite(std::move(data));
  const std::vector<Vec2> right = {{0, 0}, {100, 0}};
  const auto clip = search_path(path_of(sprite, right), {.width = 100});
  ASSERT_FALSE(clip);
  EXPECT_EQ(clip.error().code, ErrorCode::BadContent);
  EXPECT_NE(clip.error().message.find("segment 1 of 1"), std::string::npos);
}

TEST(Path, RefusesWhatIsNone) {
  const Sprite sprite = testing::tiny_sprite();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const auto code = [&](const std::vector<Vec2>& points) {
    const auto path = PathCost::make(sprite, points, weights());
    return path ? ErrorCode::Internal : path.error().code;
  };
  EXPECT_EQ(code({}), ErrorCode::BadContent);
  EXPECT_EQ(code({{1, 1}}), ErrorCode::BadContent);
  EXPECT_EQ(code({{1, 1}, {1, 1}, {1, 1}}), ErrorCode::BadContent);
  EXPECT_EQ(code({{1, 1}, {kNan, 1}}), ErrorCode::BadContent);
  EXPECT_EQ(code({{1, 1}, {1e9f, 1}}), ErrorCode::LimitExceeded);
}

TEST(Path, TenThousandShortSegmentsAreFollowed) {
  const Sprite sprite = testing::tiny_sprite();
  std::vector<Vec2> points;
  for (int k = 0; k <= 10000; ++k) {
    const double t = k / 10000.0;
    points.push_back({static_cast<float>(200 * t), static_cast<float>(40 * t * (1 - t))});
  }
  const auto clip = search_path(path_of(sprite, points, 0.1), {.width = 2000});
  ASSERT_TRUE(clip);
  EXPECT_GT(clip->ticks.back().segment, 9000u);
}

}  // namespace
}  // namespace vsprite
