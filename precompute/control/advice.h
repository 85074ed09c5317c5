// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/advice.h - what the footage can do, turn by turn, and what to film next.
//
// Every turn from one served direction to another is driven, with the engine's own actor, from many
// moments at which a player could ask for it. What turns badly although it moves well both before
// and after is a turn that was never filmed often enough: that is worth saying in words.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "vsprite/geometry.h"
#include "vsprite/sprite.h"

namespace vsprite {

/// Turning from one served direction to another, over `starts` moments.
struct TurnForecast {
  Direction from = Direction::Right, to = Direction::Right;
  double frames = 0;      ///< to turn (DESIGN section 4), median; 120 = not within 120
  double slow = 0;        ///< the same, 90th percentile
  double worst_cost = 0;  ///< dearest transition on the way, median
  int filmed = 0;         ///< such turns in the film: one heading, then within 2 s the other
};

/// Of sixteen headings, clockwise from right: what the film holds.
struct RoseSector {
  double seconds = 0;  ///< of kept, moving samples
  double speed = 0;    ///< px/s, mean of these
};
inline constexpr std::size_t kRoseSectors = 16;

struct Advice {
  std::vector<TurnForecast> turns;
  std::array<RoseSector, kRoseSectors> rose{};
  double standing = 0;                ///< s of kept samples that do not move
  std::vector<std::uint32_t> unused;  ///< kept samples that no run showed
  std::vector<std::string> film;      ///< what to film next, most useful first
};

/// Drives every turn, and ten minutes of random goals. Some tenths of a second.
Advice make_advice(const Sprite& sprite, int mode, std::uint64_t seed);

}  // namespace vsprite
