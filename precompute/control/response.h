// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/response.h - how a solved sprite answers: which directions it can travel, how well, how
// fast.
//
// Runs the engine's own actor, so that what is measured is what a player gets. The measures are
// those of DESIGN section 4. `usual speed`: the median speed of the sprite's moving samples.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "similarity/features.h"
#include "vsprite/geometry.h"
#include "vsprite/input.h"
#include "vsprite/sprite.h"

namespace vsprite {

/// What counts as moving in a sprite, and how fast it usually moves; sprite px/s.
SpeedScale measure_speeds(std::span<const Sample> samples);
/// v0 as make_feature_set() takes it from the same speeds.
double usual_v0(const SpeedScale& speeds) noexcept;

/// Tracking of one compass direction (DESIGN section 4): angle between the command and
/// position(12 s) - position(2 s), mean of five seeded starts.
struct DirectionReport {
  Direction direction = Direction::Right;
  bool reachable = false;  ///< within 60 degrees, at a quarter of the usual speed or more, and at a
                           ///< speed that counts as moving: one that only sways plays by itself
  std::optional<double> tracking_error_deg;  ///< empty where unreachable
  double raw_error_deg = 0;                  ///< the same angle, whether or not reachable
  double speed = 0;                          ///< px/s of that displacement, mean
};
std::array<DirectionReport, kCompassCount> measure_directions(const Sprite& sprite, int mode,
                                                              std::uint64_t seed);

/// Which commands have a table of their own, and what the others follow.
struct ServedDirections {
  std::array<Direction, kDirectionCount> table_of{};
  std::uint32_t served = 0;  ///< bit d: direction d can be travelled
};
/// A command that cannot be travelled follows the nearest served direction within 60 degrees (of
/// two equally near, the one that tracks better), else Rest.
ServedDirections serve_directions(const std::array<DirectionReport, kCompassCount>& reports);

/// Measures a mode and writes into it what it serves: of the `wanted` directions (bit d) those that
/// it travels, their headings, and the headings between two of them.
void serve(const Sprite& sprite, int mode, std::uint64_t seed, std::uint32_t wanted,
           ControlMode& result);

/// A headless control run: one row a tick.
struct TraceRow {
  std::uint64_t frame = 0;  ///< ticks made, from 1
  std::uint32_t sample = 0;
  double x = 0, y = 0;  ///< px
  Direction direction = Direction::None;
  int table = 0;
  double cost = 0;
};

struct SteerReport {
  std::uint64_t frames = 0;
  std::uint64_t states_hash = 0;
  std::optional<double> tracking_error_deg;  ///< mean over the reachable directions
  double turn_median = 0, turn_p95 = 0;      ///< frames_to_turn, ticks; 0 without a turn
  int turns = 0, unfinished = 0;  ///< commands to a served direction; those never reached
  /// Ticks from a command until another picture shows than the old command would have shown.
  double first_change_median = 0, first_change_p95 = 0;
  double cost_mean = 0, cost_p99 = 0, cost_max = 0;
  double jumps_per_second = 0;
  std::uint64_t freezes = 0;
  double speed = 0;         ///< px/s along the path, while a served direction is commanded
  double travel_share = 0;  ///< of that path, what goes along the command
};

/// What one or more runs showed, added up.
class SteerTally {
 public:
  SteerReport report(double fps) const;

  std::vector<double> turns, first_changes, costs;
  int unfinished = 0;
  std::uint64_t jumps = 0, freezes = 0, commanded_ticks = 0;
  double way = 0, along = 0;  ///< px
};
/// One run added to `tally`; `hash` and `trace` may be null.
void tally_steering(const Sprite& sprite, int mode, const KeyScript& script, std::uint64_t frames,
                    std::uint64_t seed, SteerTally& tally, std::uint64_t* hash = nullptr,
                    std::vector<TraceRow>* trace = nullptr);
/// A command that the end of the run cuts off before its turn is not counted.
SteerReport measure_steering(const Sprite& sprite, int mode, const KeyScript& script,
                             std::uint64_t frames, std::uint64_t seed,
                             std::vector<TraceRow>* trace = nullptr);

/// Commands that change every `min_s`..`max_s` seconds to another of the eight, for `seconds`.
KeyScript random_script(double seconds, double min_s, double max_s, double fps, std::uint64_t seed);

}  // namespace vsprite
