// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/reach.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "similarity/features.h"

namespace vsprite {
namespace {

constexpr double kTurnedDeg = 22.5;
constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kMostFrames = 600;  // a turn that takes longer never comes

// The ways under a cap, forwards and backwards.
struct Ways {
  CostTable forward, backward;
};

Ways make_ways(const CostTable& costs, std::span<const float> skip_costs, double cap,
               bool play_through) {
  Ways ways;
  const std::size_t n = costs.kept.size();
  ways.forward.kept = ways.backward.kept = costs.kept;
  ways.forward.row_start.assign(1, 0);
  ways.backward.row_start.assign(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::uint32_t e = costs.row_start[i]; e < costs.row_start[i + 1]; ++e) {
      if (static_cast<double>(costs.transitions[e].cost) <= cap)
        ways.forward.transitions.push_back(costs.transitions[e]);
    }
    const bool skips =
        play_through && i < skip_costs.size() && static_cast<double>(skip_costs[i]) <= cap;
    if (skips) ways.forward.transitions.push_back({static_cast<std::uint32_t>(i + 2), 0});
    ways.forward.row_start.push_back(static_cast<std::uint32_t>(ways.forward.transitions.size()));
  }
  for (const Transition& t : ways.forward.transitions) ++ways.backward.row_start[t.to + 1];
  for (std::size_t i = 0; i < n; ++i) ways.backward.row_start[i + 1] += ways.backward.row_start[i];
  ways.backward.transitions.resize(ways.forward.transitions.size());
  std::vector<std::uint32_t> at(ways.backward.row_start.begin(), ways.backward.row_start.end() - 1);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::uint32_t e = ways.forward.row_start[i]; e < ways.forward.row_start[i + 1]; ++e)
      ways.backward.transitions[at[ways.forward.transitions[e].to]++] = {
          static_cast<std::uint32_t>(i), 0};
  }
  return ways;
}

// Frames from every sample to the nearest goal: Dijkstra with a bucket a frame, backwards from the
// goals. Leaving sample i takes its duration.
std::vector<std::uint32_t> frames_to(const CostTable& backward, std::span<const std::uint8_t> goal,
                                     std::span<const std::uint16_t> durations) {
  std::vector<std::uint32_t> frames(goal.size(), kFar);
  std::vector<std::vector<std::uint32_t>> buckets(kMostFrames + 1);
  for (std::uint32_t i = 0; i < goal.size(); ++i) {
    if (goal[i] != 0) frames[i] = 0, buckets[0].push_back(i);
  }
  for (std::uint32_t now = 0; now <= kMostFrames; ++now) {
    for (std::size_t k = 0; k < buckets[now].size(); ++k) {
      const std::uint32_t j = buckets[now][k];
      if (frames[j] != now) continue;
      for (std::uint32_t e = backward.row_start[j]; e < backward.row_start[j + 1]; ++e) {
        const std::uint32_t i = backward.transitions[e].to;
        const std::uint32_t then = now + durations[i];
        if (then >= frames[i] || then > kMostFrames) continue;
        frames[i] = then;
        buckets[then].push_back(i);
      }
    }
  }
  return frames;
}

std::vector<std::uint8_t> moving_samples(const CostTable& costs, const Motion& motion) {
  std::vector<std::uint8_t> moving(costs.kept.size(), 0);
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const auto x = static_cast<double>(motion.velocities[i].x);
    const auto y = static_cast<double>(motion.velocities[i].y);
    moving[i] = costs.kept[i] != 0 && x * x + y * y > motion.v0 * motion.v0;
  }
  return moving;
}

double connected_share(const CostTable& forward, const std::vector<std::uint8_t>& moving) {
  const Components parts = find_components(forward);
  std::vector<std::size_t> counts(parts.count, 0);
  std::size_t all = 0;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (moving[i] != 0) ++counts[parts.of[i]], ++all;
  }
  if (all == 0) return 0;
  return static_cast<double>(*std::max_element(counts.begin(), counts.end())) /
         static_cast<double>(all);
}

}  // namespace

Reach measure_reach(const CostTable& costs, const Motion& motion,
                    std::span<const std::uint16_t> durations, std::uint32_t served, int headings,
                    double cap, bool play_through) {
  const Ways ways = make_ways(costs, motion.skip_costs, cap, play_through);
  const std::vector<std::uint8_t> moving = moving_samples(costs, motion);
  Reach reach{cap, connected_share(ways.forward, moving), 0};
  std::vector<std::uint32_t> frames;
  std::vector<std::uint8_t> goal(moving.size());
  for (int h = 0; h < headings; ++h) {
    if ((served >> h & 1u) == 0) continue;
    for (std::size_t i = 0; i < goal.size(); ++i) {
      goal[i] = moving[i] != 0 &&
                heading_angle(motion.velocities[i], h, headings) * 180 / kPi <= kTurnedDeg;
    }
    const auto to = frames_to(ways.backward, goal, durations);
    for (std::size_t i = 0; i < goal.size(); ++i) {
      if (moving[i] != 0 && goal[i] == 0) frames.push_back(to[i]);
    }
  }
  if (frames.empty()) return reach;
  const auto middle = frames.begin() + std::ssize(frames) / 2;
  std::nth_element(frames.begin(), middle, frames.end());
  reach.floor = *middle == kFar ? std::numeric_limits<double>::infinity() : *middle;
  return reach;
}

double choose_cap(const CostTable& costs, const Motion& motion,
                  std::span<const std::uint16_t> durations, std::uint32_t served, int headings,
                  bool play_through) {
  const auto at = [&](int twentieths) {
    return measure_reach(costs, motion, durations, served, headings, twentieths / 20.0,
                         play_through);
  };
  const Reach whole = at(20);
  for (int twentieths = 6; twentieths < 20; ++twentieths) {
    const Reach reach = at(twentieths);
    if (reach.connected >= 0.95 * whole.connected && reach.floor <= 1.5 * whole.floor)
      return reach.cap;
  }
  return whole.cap;
}

}  // namespace vsprite
