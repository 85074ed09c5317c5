// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/transitions.h - which sample may follow which, and at what cost.
//
//     T_ij = (D_i,j-1 + D_i+1,j) / 2,   natural continuation 0,   rejected pairs gone
//
// j-1 and i+1 exist only inside one clip. A jump to the same or one of the 14 samples before it in a
// clip is no transition (stutter). Kept is the largest strongly connected part.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "similarity/classifier.h"
#include "similarity/features.h"
#include "vsprite/result.h"
#include "vsprite/sprite.h"

namespace vsprite {

struct TransitionConfig {
  int max_per_sample = 100;  ///< cheapest kept in a row; natural continuation always
  int min_back = 15;         ///< shortest jump backwards inside a clip, samples
  int jobs = 0;              ///< threads, 0 = all; the result does not depend on it
};

/// An accepted pair, i < j, D <= 1.
struct PairDistance {
  std::uint32_t i = 0, j = 0;
  float distance = 0;
};

/// Immediate costs, pruned. Sparse (N, N); a dropped sample has an empty row and no column.
struct CostTable {
  std::vector<std::uint32_t> row_start;  ///< (N + 1)
  std::vector<Transition> transitions;   ///< ascending by `to` in a row
  std::vector<std::uint8_t> kept;        ///< (N) 1 = in the strongly connected part
};

struct TransitionStats {
  std::uint64_t pairs = 0;      ///< considered: N (N - 1) / 2
  std::uint64_t compared = 0;   ///< of these, pairs whose pixels were looked at
  std::uint64_t accepted = 0;
  std::uint64_t transitions = 0;
  int kept = 0, lost_clip_end = 0, lost_dead_end = 0, lost_unreachable = 0;
  std::vector<std::string> reasons;  ///< sentences for the report
};

/// Accepted pairs, ascending by (i, j): exactly those of the plain loop over all pairs.
std::vector<PairDistance> accepted_pairs(const FeatureSet& set, const Classifier& classifier, int jobs,
                                         std::uint64_t* compared = nullptr,
                                         const std::function<void(double)>& progress = {});

/// Errors: BadContent (no endless run of samples is left: says why and what to do).
Result<CostTable> make_cost_table(const FeatureSet& set, std::span<const PairDistance> pairs,
                                  const TransitionConfig& config, TransitionStats& stats);

}  // namespace vsprite
