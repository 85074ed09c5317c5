// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/distance.h - every pair of samples that looks alike, exactly.
//
// N samples are N (N - 1) / 2 pairs. Because the weights are non-negative, D of a vector that is
// nowhere larger than the features is a lower bound of D, and a bound above 1 refuses the pair. In
// order of price: the four features without pixels; coverage by blocks, since
// |sum a_i - sum a_j| <= sum |a_i - a_j|; coverage by cells; colour, stopped at the first rows that
// take it too far. What is accepted, and its distance, is bit for bit what the plain loop gives.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "similarity/classifier.h"
#include "similarity/features.h"

namespace vsprite {

/// An accepted pair, i < j, D <= 1.
struct PairDistance {
  std::uint32_t i = 0, j = 0;
  float distance = 0;
  friend bool operator==(const PairDistance&, const PairDistance&) = default;
};

/// Accepted pairs, ascending by (i, j): exactly those of the plain loop over all pairs.
/// `jobs`: threads, 0 = all; the result does not depend on it. `compared`: pairs whose pixels were
/// looked at. `progress`: share done, rising, one call at a time, from any thread.
std::vector<PairDistance> accepted_pairs(const FeatureSet& set, const Classifier& classifier,
                                         int jobs, std::uint64_t* compared = nullptr,
                                         const std::function<void(double)>& progress = {});

}  // namespace vsprite
