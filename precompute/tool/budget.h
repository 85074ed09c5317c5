// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/budget.h - a pack of at most so many bytes: the samples that a player would miss least are
// left out (control/choose.h), the rest is solved again.
//
// A sample weighs what it takes in the file: its compressed picture, its rows in every table, and
// its transitions to those that stay. Samples are numbered anew; `Sample::frame` still names the
// frame of the film. The floor and the puppets stay; scripted runs (clip.h) and sections that this
// program does not know go, since they may name samples.
#pragma once

#include <cstdint>
#include <string>

#include "vsprite/pack.h"
#include "vsprite/result.h"

namespace vsprite {

struct BudgetConfig {
  double bytes = 10e6;     ///< of the whole file at most, > 0
  std::uint64_t seed = 1;  ///< of the commands by which samples are judged
  int jobs = 0;            ///< threads, 0 = all; the result does not depend on it
  FrameSource pictures{};  ///< of the whole pack's samples; none: the pack's own
};

/// Of the pack before and after: what `--budget` is judged by.
struct PackMeasure {
  std::uint64_t bytes = 0;
  std::size_t samples = 0;  ///< kept ones
  double turn_median = 0;   ///< frames_to_turn of the default mode, random goals, one seed
};
struct BudgetOutcome {
  PackMeasure before, after;
};

/// Reads the pack at `from` and writes the smaller one to `to` (which may be `from`): complete and
/// synced, or not at all. One that fits already is solved again all the same. Cost: some seconds
/// for 10,000 samples. Errors: those of load_pack and save_pack; BadContent (no such pack serves
/// every direction and tag: says how much the smallest one weighs).
Result<BudgetOutcome> fit_pack(const std::string& from, const std::string& to,
                               const BudgetConfig& config);

}  // namespace vsprite
