// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/label.h - which pairs are known to look alike, or not.
//
// Without a person the film itself answers: near-consecutive frames are acceptable, far pairs mostly
// are not; pairs one period of a loop apart are not used as negatives.
#pragma once

#include <cstdint>
#include <vector>

#include "similarity/features.h"

namespace vsprite {

struct Label {
  int i = 0, j = 0;
  bool acceptable = false;
  bool by_person = false;
};

/// Labels bootstrapped from the film; deterministic in (set, seed). About `count` pairs.
std::vector<Label> bootstrap_labels(const FeatureSet& set, int count, std::uint64_t seed);

}  // namespace vsprite
