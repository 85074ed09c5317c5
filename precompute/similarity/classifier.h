// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/classifier.h - smooth or not: a linear classifier with non-negative weights.
//
//     D_ij = w . f_ij / threshold,  w >= 0,  smooth where D <= 1      [NIPS section 2]
//
// Squared hinge loss, a false accept ten times dearer than a false reject, ridge; projected Newton in
// double, fixed order. w >= 0, so that a pair that differs more never looks better.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "similarity/features.h"
#include "similarity/label.h"
#include "vsprite/result.h"

namespace vsprite {

struct TrainConfig {
  double false_accept_cost = 10;  ///< times a false reject
  double ridge = 1e-3;            ///< > 0
  double floor = 0.02;            ///< smallest share of a feature's weight x sd, [0, 0.1]
  int folds = 5;                  ///< by clip
};

struct Classifier {
  std::array<double, kFeatureCount> weights{};  ///< >= 0, per unit of the feature
  double threshold = 1;                         ///< > 0
  /// D_ij; the same bits in every loop that sums in feature order.
  float distance(const FeatureVector& f) const noexcept;
};

/// Counts over held-out pairs.
struct Confusion {
  int true_accept = 0, false_accept = 0, true_reject = 0, false_reject = 0;
};

struct Training {
  Classifier classifier;
  Confusion held_out;                            ///< summed over the folds, by clip
  std::array<double, kFeatureCount> spread{};    ///< sd of each feature over the labelled pairs
};

/// Errors: BadContent (one class missing: says which, and what to do).
Result<Training> train(const FeatureSet& set, std::span<const Label> labels, const TrainConfig& config);

}  // namespace vsprite
