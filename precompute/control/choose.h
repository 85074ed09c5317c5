// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/choose.h - a smaller sprite from a large one: the samples without which control loses
// least are left out, and what is left is solved again.
//
// What a sample is worth to a player is how often the solved tables show it. So a round drives the
// engine's own actor by random commands, counts what is shown, leaves out what is shown least,
// keeps the largest strongly connected part of the rest, and solves it again: the tables then make
// do with what there is, and the next round counts anew. What is shown between two jumps is shown
// equally often, so whole runs go rather than single samples out of them. Each round leaves a
// quarter out at most, and a round after which a direction cannot be travelled any more, or one
// turn in a hundred takes too long, is taken back and made again with a smaller share. (Slow turns
// are put up with where the limit cannot be met otherwise.)
//
// Never left out: samples with an event, the tags that steering does not show (actions), and the
// first samples that a cut to a tag shows, so that the cuts stay as they were judged.
#pragma once

#include <cstdint>
#include <vector>

#include "vsprite/result.h"
#include "vsprite/sprite.h"

namespace vsprite {

struct ChoiceConfig {
  double limit = 256;             ///< the chosen samples weigh at most so much, > 0
  std::vector<double> weights{};  ///< (N), > 0, e.g. bytes; empty: 1 each
  double transition_weight = 0;   ///< of every transition between two chosen samples, >= 0
  double share = 0.25;            ///< of the weight that a round leaves out at most, (0, 1)
  std::uint64_t ticks = 120000;   ///< driven a round
  std::uint64_t seed = 1;         ///< of the commands
  int jobs = 0;                   ///< threads, 0 = all; the result does not depend on it
};

struct SampleChoice {
  /// Numbered anew without gaps, modes and actions solved by their own settings; where samples are
  /// missing a clip ends and another begins. Its start sample is 0.
  SpriteData data;
  std::vector<std::uint32_t> from;  ///< (n) ascending: the sample's number in the large sprite
};

/// A sprite of the samples with `chosen[i] != 0`, (N), which must be strongly connected: everything
/// but the modes' tables and the action tables, which are left out.
SampleChoice take_samples(const SpriteData& data, const std::vector<std::uint8_t>& chosen);

/// A sprite that is small enough already is solved again too. Cost: some seconds for 10,000
/// samples. Errors: BadContent (no such choice serves all directions that the default mode of
/// `data` serves: says how much the smallest one weighs), those of solve(), solve_joint() and
/// solve_action().
Result<SampleChoice> choose_samples(const SpriteData& data, const ChoiceConfig& config);

}  // namespace vsprite
