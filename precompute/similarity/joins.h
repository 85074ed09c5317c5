// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/joins.h - ways between the tagged clips of a cast, however dear.
//
// Material filmed or generated apart often has no accepted transition from one action to the next,
// and a cast never loses a tag. Where no accepted transition leads from one tag to another, the
// cheapest one is joined to the graph at its price, T_ij in units of the threshold; then the
// cheapest joins without which a tagged sample could not be reached or left. At the border of a
// clip the half of T_ij that does not exist is left out: the last frame of a jump compares with the
// frame before j alone.
#pragma once

#include <string>
#include <vector>

#include "similarity/classifier.h"
#include "similarity/features.h"
#include "vsprite/sprite.h"

namespace vsprite {

struct CostTable;

/// A transition that was not accepted, kept because nothing else leads there.
struct TagJoin {
  std::uint32_t from = 0, to = 0;  ///< samples
  float cost = 0;                  ///< T, in units of the threshold
  std::string from_tag, to_tag;
};

/// Shortest jump backwards in the clip of sample i: `min_back`, but in a tagged clip half the clip
/// where that is shorter, so that a loop of any length closes. >= 1.
int shortest_jump_back(const FeatureSet& set, int i, int min_back);

/// The joins that `graph`, the accepted transitions, needs; empty where no sample has a tag.
/// Ascending by (from, to). Cost O(pairs of tagged samples).
std::vector<TagJoin> find_joins(const FeatureSet& set, const Classifier& classifier,
                                const CostTable& graph, int min_back);

/// `jump -> idle joined at 1.8 x the threshold: film jump going over into idle`
std::string describe(const TagJoin& join);

}  // namespace vsprite
