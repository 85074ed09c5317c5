// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/reach.h - what the footage can do at all, for a given cap on T.
//
// A character cannot turn faster than the shortest way through its transitions. That floor, and how
// much of the film stays connected, say how low the cap may be: a low cap makes every jump
// invisible, and at last no turn possible.
#pragma once

#include <cstdint>
#include <span>

#include "control/joint.h"

namespace vsprite {

struct Reach {
  double cap = 1;
  double connected = 0;  ///< share of the moving samples in the largest strongly connected part
  /// Film frames from a moving sample to the first one that goes within 22.5 degrees of another
  /// heading, median over samples and served headings; infinity where most never get there. (A
  /// velocity, not yet five frames of travel: the measure of DESIGN adds 3.)
  double floor = 0;
};

/// `durations`: (N) film frames that a sample is shown. `play_through`: i -> i+2 counts as a way.
Reach measure_reach(const CostTable& costs, const Motion& motion,
                    std::span<const std::uint16_t> durations, std::uint32_t served, int headings,
                    double cap, bool play_through);

/// The lowest cap of 0.3, 0.35 .. 1 at which 95 % of the moving samples that are connected at 1
/// still are, and the floor is at most 1.5 times that at 1.
double choose_cap(const CostTable& costs, const Motion& motion,
                  std::span<const std::uint16_t> durations, std::uint32_t served, int headings,
                  bool play_through);

}  // namespace vsprite
