// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/actions.h - the way to every tag of a cast, without and with a deadline.
//
//     V_i = 0 at the tag's first samples,  V_i = tau d_i + min_j (T_ij + V_j) elsewhere
//     W_m(i) = min_j (p(T_ij) + W_(m - d_i)(j)),  m = 1..horizon,  p(T) = max(T, T^2)
//
// (tagged.h). V is undiscounted and tau > 0, so the least is found exactly by Dijkstra on the
// reversed graph. W adds to every sample a cut: the dearest way, at its own T, straight to a first
// sample. Beyond the threshold T counts squared there: one jump that shows is worse than two that
// do not. `stay` minimises the discounted cost of remaining in the tag for ever, where holding a
// sample costs a threshold a tick.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "similarity/transitions.h"
#include "vsprite/result.h"
#include "vsprite/sprite.h"
#include "vsprite/tagged.h"

namespace vsprite {

struct ActionConfig {
  double tau = 0.05;  ///< price of a tick in transition costs, >= 0.001
  int horizon = 8;    ///< deadlines with a table of their own, ticks, 1..64
};

/// From sample i straight to a first sample of the tag.
struct Cut {
  std::uint32_t to = kNoSample;
  float cost = 0;  ///< T, in units of the threshold
};

/// The first samples of a tag: kept, and the predecessor is another clip's or tag's, or was not
/// kept. `samples`: clip, tag and kept are read.
std::vector<std::uint32_t> first_samples(std::span<const Sample> samples, std::uint16_t tag);

/// For every kept sample the cheapest cut to one of `firsts`, T_ij with what exists of it
/// (joins.h). Cost O(N firsts).
std::vector<Cut> find_cuts(const FeatureSet& set, const Classifier& classifier,
                           std::span<const Sample> samples, std::span<const std::uint32_t> firsts);

/// `cuts`: (N). Errors: BadSetting (tau, horizon), BadContent (the tag has no first sample, or a
/// kept sample from which it cannot be reached).
Result<ActionTable> solve_action(const CostTable& costs, std::span<const Sample> samples,
                                 std::uint16_t tag, std::span<const Cut> cuts,
                                 const ActionConfig& config);

}  // namespace vsprite
