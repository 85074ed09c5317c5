// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/action_bench.h - how fast and at what price every tag answers, from every state.
//
// A state is a kept sample that has just come to be shown, steered without a command. The engine's
// own actor plays the tag from there; counted are the ticks until the tag's first sample shows (0
// where it already does) and the largest and summed T of the jumps on the way.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "vsprite/sprite.h"

namespace vsprite {

/// -1: none.
inline constexpr std::array<int, 5> kBenchDeadlines{0, 2, 4, 8, -1};

struct ActionReport {
  std::string tag;
  int within = -1;                     ///< ticks; -1: no deadline
  std::uint64_t states = 0, late = 0;  ///< late: the deadline was not kept; none ever may be
  double frames_median = 0, frames_p95 = 0, frames_max = 0;  ///< ticks
  double cost_mean = 0, cost_p95 = 0, cost_max = 0;          ///< summed T of a way
  double worst_mean = 0, worst_p95 = 0;                      ///< dearest jump of a way
  double cut_share = 0;  ///< of the states: reached by a jump dearer than the threshold
};

/// Tags in the order of the pack, each with all deadlines; empty for a sprite without actions.
std::vector<ActionReport> measure_actions(const Sprite& sprite, int mode = 0);

}  // namespace vsprite
