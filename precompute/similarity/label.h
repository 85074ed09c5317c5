// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/label.h - which pairs are known to look alike, or not.
//
// Without a person the film itself answers: neighbouring frames (one and two samples apart) are
// acceptable, two thirds of them from moving samples; random pairs are not. A random pair that
// looks like a neighbour - its rough distance, the sum of the six features each over its mean among
// random pairs, is no larger than that of most neighbours - is a repeat (one period of a loop
// apart, a pose held) and no negative.
#pragma once

#include <cstdint>
#include <vector>

#include "similarity/features.h"

namespace vsprite {

struct Label {
  int i = 0, j = 0;
  bool acceptable = false;
  bool by_person = false;
  bool at_random = false;  ///< a person was asked about a pair that chance picked (ask.h)
};

/// Labels bootstrapped from the film; deterministic in (set, seed). About `count` pairs, half of
/// them acceptable; fewer where the film has fewer. i < j, no pair twice.
std::vector<Label> bootstrap_labels(const FeatureSet& set, int count, std::uint64_t seed);

}  // namespace vsprite
