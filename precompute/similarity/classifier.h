// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/classifier.h - smooth or not: a linear classifier with non-negative weights.
//
//     D_ij = w . f_ij / threshold,  w >= 0,  smooth where D <= 1      [NIPS section 2]
//
// With y = +1 for an acceptable pair and -1 else, cost c = 1 and `false_accept_cost`, and x the
// features over their spread (scaled, never centred: x = 0 must stay "no difference"),
//
//     minimise  1/n sum c max(0, 1 - y (b - u . x))^2 + ridge |u|^2,   u >= floor, threshold = b
//
// by projected Newton in double, in a fixed order. u >= 0, so that a pair that differs more never
// looks better, and a partial sum is a lower bound of D.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "similarity/features.h"
#include "similarity/label.h"
#include "vsprite/result.h"

namespace vsprite {

struct TrainConfig {
  double false_accept_cost = 10;  ///< times a false reject, > 0
  double ridge = 1e-3;            ///< > 0
  double floor = 0.02;            ///< smallest share of a feature's weight x sd, [0, 0.1]
  int folds = 5;                  ///< of the cross-validation, >= 2
};

struct Classifier {
  std::array<double, kFeatureCount> weights{};  ///< >= 0, per unit of the feature
  double threshold = 1;                         ///< > 0
  /// D_ij. Summed in feature order, so the same bits in every loop; and, rounding being monotone, a
  /// vector that is nowhere larger never gives a larger distance.
  float distance(const FeatureVector& f) const noexcept;
};

/// Counts over held-out pairs.
struct Confusion {
  int true_accept = 0, false_accept = 0, true_reject = 0, false_reject = 0;
};

struct Training {
  Classifier classifier;
  /// Summed over the folds: every label is judged once, by a classifier trained without any pair
  /// that touches the fold of its first sample. Folds are whole clips; where the film has fewer
  /// clips, or one clip holds over half of it, blocks of time with 15 samples left out around them.
  Confusion held_out;
  std::array<double, kFeatureCount> spread{};  ///< sd of each feature over the labelled pairs
};

/// Errors: BadContent (one class missing: says which, and what to do), BadSetting.
Result<Training> train(const FeatureSet& set, std::span<const Label> labels,
                       const TrainConfig& config);

}  // namespace vsprite
