// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/follow_bench.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "control/response.h"
#include "vsprite/owner.h"
#include "vsprite/random.h"

namespace vsprite {
namespace {

constexpr double kReach = 0.25, kShortest = 1.5, kLongest = 4;  // s
constexpr int kMostTries = 1000;
constexpr double kNarrow = 0.25;      // of the way to the next direction, where that is not served
constexpr double kLeastShare = 0.25;  // of the usual speed

double percentile(const std::vector<double>& sorted, std::size_t percent) {
  return sorted[std::min(sorted.size() - 1, sorted.size() * percent / 100)];
}

double length(Vec2 v) { return std::sqrt(double{v.x} * v.x + double{v.y} * v.y); }

// Any heading that the mode serves or that lies between two served ones, at 0.8 to 1.25 times the
// usual speed.
Vec2 draw_goal(const ControlMode& mode, double usual, Random& random) {
  for (int tries = 0;; ++tries) {
    const double turn = kCompassCount * random.unit();
    const int d = static_cast<int>(turn) % kCompassCount, next = (d + 1) % kCompassCount;
    const bool served = (mode.served >> d & 1u) != 0, both = (mode.served >> next & 1u) != 0;
    if (tries < kMostTries && !(served && both) && !(served && turn - d < kNarrow)) continue;
    const double angle = (served && both ? turn : d) * kPi / 4;
    const double speed = usual * (0.8 + 0.45 * random.unit());
    return {static_cast<float>(speed * std::cos(angle)),
            static_cast<float>(speed * std::sin(angle))};
  }
}

}  // namespace

FollowReport measure_following(const Sprite& sprite, int mode, std::uint64_t ticks,
                               std::uint64_t seed) {
  const SpeedScale speeds = measure_speeds(sprite.samples());
  const ControlMode& control = sprite.data().modes[static_cast<std::size_t>(mode)];
  FollowReport report;
  if (!(speeds.usual > 0) || (control.served & 0xFFu) == 0) return report;
  Random random{seed};
  Actor actor = make_actor(sprite, {}, seed, mode);
  std::vector<double> slips, trails, costs;
  Vec2 velocity, goal = draw_goal(control, speeds.usual, random);
  const double fps = sprite.fps(), share = 1 - std::exp(-1 / (kReach * fps));
  double until = 0;
  std::uint64_t jumps = 0;
  for (std::uint64_t t = 0; t < ticks; ++t) {
    if (static_cast<double>(t) >= until) {
      goal = draw_goal(control, speeds.usual, random);
      until = static_cast<double>(t) + fps * (kShortest + (kLongest - kShortest) * random.unit());
    }
    velocity.x += static_cast<float>(share) * (goal.x - velocity.x);
    velocity.y += static_cast<float>(share) * (goal.y - velocity.y);
    follow(sprite, actor, velocity);
    const double speed = length(velocity);
    if (speed >= kLeastShare * speeds.usual) {
      slips.push_back(foot_slip(sprite, actor) / speed);
      const Vec2 drawn = draw_position(sprite, actor, 0), body = to_pixels(actor.position);
      trails.push_back(length({drawn.x - body.x, drawn.y - body.y}) /
                       double{sprite.data().body_length});
    }
    const std::uint32_t before = actor.sample;
    step(sprite, actor);
    jumps += actor.jumped;
    const double cost = double{shown_cost(sprite, before, actor)};
    costs.push_back(std::isfinite(cost) ? cost : 0);
  }
  if (slips.empty()) return report;
  std::sort(slips.begin(), slips.end());
  std::sort(costs.begin(), costs.end());
  report.ticks = slips.size();
  report.slip_median = percentile(slips, 50);
  report.slip_p95 = percentile(slips, 95);
  report.within_tenth =
      static_cast<double>(std::upper_bound(slips.begin(), slips.end(), 0.1) - slips.begin()) /
      static_cast<double>(slips.size());
  std::sort(trails.begin(), trails.end());
  report.trail_median = percentile(trails, 50);
  report.trail_p95 = percentile(trails, 95);
  for (const double c : costs) report.cost_mean += c / static_cast<double>(costs.size());
  report.cost_p99 = percentile(costs, 99);
  report.jumps_per_second = static_cast<double>(jumps) * fps / static_cast<double>(ticks);
  return report;
}

}  // namespace vsprite
