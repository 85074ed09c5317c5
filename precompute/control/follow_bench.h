// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/follow_bench.h - how far the feet slide when the game moves the character.
//
// The game's body heads for a goal, reaching its velocity with a time constant of a quarter of a
// second. A goal is any heading between served directions (where one is served alone, that one), at
// 0.8 to 1.25 times the usual speed of the sprite's moving samples, and changes every 1.5 to 4 s.
// Slip is what the drawn character moves in a tick beyond what was filmed, at the rate at which the
// film is played (owner.h), over the body's speed.
#pragma once

#include <cstdint>

#include "vsprite/sprite.h"

namespace vsprite {

struct FollowReport {
  std::uint64_t ticks = 0;  ///< that the body moved at a quarter of the usual speed or more
  double slip_median = 0, slip_p95 = 0;    ///< share of the speed
  double within_tenth = 0;                 ///< share of the ticks that slip at most a tenth
  double trail_median = 0, trail_p95 = 0;  ///< of the drawn anchor from the body, body lengths
  double cost_mean = 0, cost_p99 = 0;      ///< T of shown frames
  double jumps_per_second = 0;
};

/// `ticks` > 0. Nothing is counted for a sprite that does not move.
FollowReport measure_following(const Sprite& sprite, int mode, std::uint64_t ticks,
                               std::uint64_t seed);

}  // namespace vsprite
