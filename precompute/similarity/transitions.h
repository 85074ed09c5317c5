// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/transitions.h - which sample may follow which, and at what cost.
//
//     T_ij = (D_i,j-1 + D_i+1,j) / 2,   natural continuation 0,   rejected pairs gone
//
// j-1 and i+1 exist only inside one clip. A jump to the same or one of the 14 samples before it in
// a clip is no transition (stutter). Kept is the largest strongly connected part: from each of its
// samples every other one can be reached, so that no sprite ever freezes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "similarity/classifier.h"
#include "similarity/distance.h"
#include "similarity/features.h"
#include "vsprite/result.h"
#include "vsprite/sprite.h"

namespace vsprite {

struct TransitionConfig {
  int max_per_sample = 100;  ///< cheapest kept in a row, >= 1; natural continuation always, and the
                             ///< few more that the part needs to stay strongly connected
  int min_back = 15;         ///< shortest jump backwards inside a clip, samples, >= 1
  int jobs = 0;              ///< threads, 0 = all; the result does not depend on it
};

/// Immediate costs, pruned. Sparse (N, N); a dropped sample has an empty row and no column.
struct CostTable {
  std::vector<std::uint32_t> row_start;  ///< (N + 1)
  std::vector<Transition> transitions;   ///< ascending by `to` in a row
  std::vector<std::uint8_t> kept;        ///< (N) 1 = in the strongly connected part
};

struct TransitionStats {
  std::uint64_t pairs = 0;  ///< considered: N (N - 1) / 2
  std::uint64_t compared =
      0;  ///< of these, pairs whose pixels were looked at (the caller fills it in)
  std::uint64_t accepted = 0;
  std::uint64_t transitions = 0;  ///< in the table, natural continuations among them
  int kept = 0;
  int lost_clip_end = 0;  ///< first or last sample of its clip: nothing before or after to compare
  int lost_dead_end = 0;  ///< no way from here into the kept part
  int lost_unreachable = 0;          ///< no way from the kept part to here
  std::vector<std::string> reasons;  ///< sentences for the report
};

/// `pairs`: accepted pairs, ascending by (i, j).
/// Errors: BadContent (no endless run of samples is left: says why and what to do), BadSetting.
Result<CostTable> make_cost_table(const FeatureSet& set, std::span<const PairDistance> pairs,
                                  const TransitionConfig& config, TransitionStats& stats);

/// (N) T of leaving the next sample out, (D_i,i+1 + D_i+1,i+2) / 2, whether or not these pairs are
/// accepted; infinity where the clip ends before, or an end was not kept.
std::vector<float> skip_costs(const FeatureSet& set, const Classifier& classifier,
                              std::span<const std::uint8_t> kept);

/// For every sample the number of its strongly connected part of the graph, and their count. Parts
/// are numbered so that a part comes after those that it leads to.
struct Components {
  std::vector<std::uint32_t> of;
  std::uint32_t count = 0;
};
Components find_components(const CostTable& graph);

}  // namespace vsprite
