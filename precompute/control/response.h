// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/response.h - how a solved sprite answers: which directions it can travel, how well, how
// fast.
//
// Runs the engine's own actor, so that what is measured is what a player gets.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vsprite/geometry.h"
#include "vsprite/input.h"
#include "vsprite/sprite.h"

namespace vsprite {

/// Tracking of one compass direction (DESIGN section 4): angle between the command and
/// position(12 s) - position(2 s), mean of five seeded starts.
struct DirectionReport {
  Direction direction = Direction::Right;
  bool reachable = false;                    ///< travels, within 60 degrees of the command
  std::optional<double> tracking_error_deg;  ///< empty where unreachable
  double speed = 0;                          ///< px/s of that displacement
};
std::array<DirectionReport, kCompassCount> measure_directions(const Sprite& sprite, int mode,
                                                              std::uint64_t seed);

/// A headless control run: one row a tick.
struct TraceRow {
  std::uint64_t frame = 0;
  std::uint32_t sample = 0;
  double x = 0, y = 0;
  Direction direction = Direction::None;
  int table = 0;
  double cost = 0;
};

struct SteerReport {
  std::uint64_t frames = 0;
  std::uint64_t states_hash = 0;
  std::optional<double> tracking_error_deg;  ///< mean over the served directions
  double turn_median = 0, turn_p95 = 0;      ///< frames_to_turn, ticks
  int turns = 0, unfinished = 0;
  double cost_mean = 0, cost_p99 = 0, cost_max = 0;
  double jumps_per_second = 0;
  std::uint64_t freezes = 0;
};
SteerReport measure_steering(const Sprite& sprite, int mode, const KeyScript& script,
                             std::uint64_t frames, std::uint64_t seed,
                             std::vector<TraceRow>* trace = nullptr);

/// Commands that change every `min_s`..`max_s` seconds to another of the eight, for `seconds`.
KeyScript random_script(double seconds, double min_s, double max_s, double fps, std::uint64_t seed);

}  // namespace vsprite
