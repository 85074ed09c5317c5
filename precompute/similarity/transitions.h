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
#include "similarity/joins.h"
#include "vsprite/result.h"
#include "vsprite/sprite.h"

namespace vsprite {

struct TransitionConfig {
  int max_per_sample = 100;  ///< cheapest kept in a row, >= 1; natural continuation always, and the
                             ///< few more that the part needs to stay strongly connected
  int min_back = 15;         ///< shortest jump backwards inside a clip, samples, >= 1
  /// Of a run of near-identical jumps (i, j), (i + 1, j + 1), ... only the cheapest of its
  /// neighbours; thins rows for small packs, and costs response.
  bool minima = false;
  /// Near misses: pairs with 1 < D <= 1 + near_miss, >= 0, make transitions too, at near_miss_price
  /// times the larger D, > 1, so that a cap of at most 1 (mode paper's) never takes one. They join
  /// kept samples only and do not count for what is kept (McCann and Pollard 2007 found occasional
  /// poor transitions essential to response).
  float near_miss = 0;
  float near_miss_price = 3;
};

/// Immediate costs, pruned. Sparse (N, N); a dropped sample has an empty row and no column.
struct CostTable {
  std::vector<std::uint32_t> row_start;  ///< (N + 1)
  std::vector<Transition> transitions;   ///< ascending by `to` in a row
  std::vector<std::uint8_t> kept;        ///< (N) 1 = in the strongly connected part
  std::vector<std::uint8_t> needed;      ///< (transitions) 1 = no cap cuts it; empty: none is
};

struct TransitionStats {
  std::uint64_t pairs = 0;  ///< considered: N (N - 1) / 2
  std::uint64_t compared =
      0;  ///< of these, pairs whose pixels were looked at (the caller fills it in)
  std::uint64_t accepted = 0;
  std::uint64_t near_misses = 0;  ///< pairs beyond the threshold that came in
  std::uint64_t transitions = 0;  ///< in the table, natural continuations among them
  double jumps_per_second = 0;    ///< transitions that are no continuation, per second of kept film
  int kept = 0;
  int lost_clip_end = 0;  ///< first or last sample of its clip: nothing before or after to compare
  int lost_dead_end = 0;  ///< no way from here into the kept part
  int lost_unreachable = 0;          ///< no way from the kept part to here
  std::vector<std::string> reasons;  ///< sentences for the report
  std::vector<TagJoin> joins;        ///< dear ways between the tags of a cast
};

/// `pairs`: pairs with D <= 1 + near_miss, ascending by (i, j). `classifier`: prices the joins
/// between tags; without one there are none.
/// Errors: BadContent (no endless run of samples is left: says why and what to do), BadSetting.
Result<CostTable> make_cost_table(const FeatureSet& set, std::span<const PairDistance> pairs,
                                  const TransitionConfig& config, TransitionStats& stats,
                                  const Classifier* classifier = nullptr);

/// The transitions that no mode's cap may cut: the cheapest without which a sample could not be
/// reached or left (a sprite that starts in a part which only dearer jumps leave would stay there),
/// and in a cast the cheapest from one tag to another. `tags`: (N), empty where there is none.
/// (transitions); empty where no sample is kept. Cost O(transitions log transitions).
std::vector<std::uint8_t> needed_transitions(const CostTable& costs,
                                             std::span<const std::string> tags);

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
