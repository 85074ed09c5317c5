// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/bench.h - response against smoothness, for every mode over a grid of settings.
//
// One number says nothing: any controller turns faster if it may jump more. So each mode is solved
// again from the sprite's own T and velocities over a grid, driven by the same random goals, and
// the whole curve is given, with the footage's own floor. Measures: DESIGN section 4.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "control/joint.h"
#include "control/reach.h"
#include "control/response.h"

namespace vsprite {

/// One setting of one mode, measured.
struct CurvePoint {
  std::string mode;
  bool is_default = false;               ///< the settings that the sprite itself was solved with
  SolveConfig paper;                     ///< of mode "paper"
  JointConfig joint;                     ///< of mode "responsive"
  double turn_median = 0, turn_p95 = 0;  ///< film frames
  double first_change_median = 0, first_change_p95 = 0;  ///< until the first jump after a command
  int turns = 0, unfinished = 0;
  double cost_mean = 0, cost_p99 = 0, cost_max = 0;
  double jumps_per_second = 0;
  double tracking_mean = 0, tracking_worst = 0;  ///< degrees, over the served directions
  double speed_ratio = 0;                        ///< speed travelled over the film's usual speed
  double share_fast = 0;  ///< of the way, along the command; goals change every 0.3-0.7 s
  double share_slow = 0;  ///< the same, 1.5-4 s
};

struct BenchConfig {
  std::vector<std::uint64_t> seeds;   ///< of the random goals; their turns are pooled
  double seconds = 825;               ///< of each seed's run: 300 changes of 1.5-4 s
  const KeyScript* script = nullptr;  ///< instead of random goals
  std::vector<CurvePoint> grid{};     ///< settings to measure; empty: the usual ones
  int jobs = 0;                       ///< threads, 0 = all; the result does not depend on it
};

struct BenchResult {
  std::vector<CurvePoint> curves;  ///< paper first, then responsive
  std::vector<Reach> floor;        ///< by cap, 0.3 .. 1
};

/// `progress`: share done, one call at a time. Errors: those of the solvers.
Result<BenchResult> measure_curves(const Sprite& sprite, const BenchConfig& config,
                                   const std::function<void(double)>& progress = {});

/// The settings that a mode was solved with. A mode that other programs made may not say at which
/// angle a turn ends (exit_angle 0): the usual one then.
JointConfig joint_config(const ControlMode& mode);
SolveConfig paper_config(const ControlMode& mode);

/// The same as two small diagrams, median frames to turn over p99 and over the mean of T.
std::string curves_svg(const BenchResult& result, const std::string& title);

}  // namespace vsprite
