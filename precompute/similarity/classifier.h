// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/classifier.h - smooth or not: a linear classifier with non-negative weights.
//
//     D_ij = w . f_ij / threshold,  w >= 0,  smooth where D <= 1      [NIPS section 2]
//
// With y = +1 for an acceptable pair and -1 else, cost c = 1 and `false_accept_cost`, weight m of
// the label, and x the features over their spread (scaled, never centred: x = 0 must stay "no
// difference"),
//
//     minimise  sum m c max(0, 1 - y (b - u . x))^2 / sum m + ridge |u|^2,   u >= floor, threshold
//     = b
//
// by projected Newton in double, in a fixed order. u >= 0, so that a pair that differs more never
// looks better, and a partial sum is a lower bound of D.
//
// A person's answers and the film's own labels teach together: an answer weighs 1, all of the
// film's labels together weigh `film_labels_worth` answers. The film knows roughly what looks
// alike, the person where the line lies: a handful of answers moves it, a hundred decide it.
#pragma once

#include <array>
#include <span>
#include <string>
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
  double film_labels_worth = 20;  ///< answers that the film's own labels weigh, > 0
};

struct Classifier {
  std::array<double, kFeatureCount> weights{};  ///< >= 0, per unit of the feature
  double threshold = 1;                         ///< > 0
  /// D_ij. Summed in feature order, so the same bits in every loop; and, rounding being monotone, a
  /// vector that is nowhere larger never gives a larger distance.
  float distance(const FeatureVector& f) const noexcept;
};

/// Labels and the features of their pairs; the same length.
struct LabelledPairs {
  std::vector<Label> labels;
  std::vector<FeatureVector> vectors;
};
LabelledPairs measure_pairs(const FeatureSet& set, std::vector<Label> labels);

/// Sd of each feature over the labelled pairs.
std::array<double, kFeatureCount> measure_spread(std::span<const FeatureVector> vectors);

/// Learns from the pairs at `chosen`. `spread`: the features' scale, from measure_spread.
/// Pre: `chosen` holds both classes, and the config is sound (train checks both). A few
/// milliseconds for some thousand pairs.
Classifier fit_classifier(const LabelledPairs& pairs, std::span<const int> chosen,
                          const std::array<double, kFeatureCount>& spread,
                          const TrainConfig& config);

/// Errors: BadContent (one class missing: says which, and what to do), BadSetting.
Result<void> check_labels(const FeatureSet& set, std::span<const Label> labels,
                          const TrainConfig& config);

/// Counts over held-out pairs.
struct Confusion {
  int true_accept = 0, false_accept = 0, true_reject = 0, false_reject = 0;
};

/// Answers about pairs that chance picked (ask.h): their shares hold for the film.
struct FalseAccepts {
  int accepted = 0;  ///< by the classifier
  int wrong = 0;     ///< of these, called a visible jump
  int refused = 0;   ///< by the classifier
  int missed = 0;    ///< of these, called smooth
  void count(bool is_accepted, bool is_acceptable) noexcept;
  double share() const noexcept { return accepted > 0 ? double(wrong) / accepted : 0; }
};
/// The largest share that `wrong` of `count` leaves likely: upper end of Wilson's 95 % interval.
double likely_at_most(int wrong, int count) noexcept;

/// What would be accepted if the line lay at D = `at`, of held-out pairs.
struct RocPoint {
  double at = 0;
  double accepted_good = 0;  ///< share of the acceptable pairs, [0, 1]
  double accepted_bad = 0;   ///< share of the others, [0, 1]
};

/// Every label judged once, by a classifier trained without any pair that touches the fold of its
/// first sample. Folds are whole clips; where the film has fewer clips, or one clip holds over half
/// of it, blocks of time with 15 samples left out around them. A label whose fold could not be
/// tested (nothing left to learn from) is in no count.
struct HeldOut {
  Confusion all, person;
  std::vector<float> distance;  ///< (labels) D; < 0: not tested
  /// From the strictest line to the loosest, ties together, over the person's labels if they are
  /// of both classes, else over all.
  std::vector<RocPoint> roc;
  double roc_area = 0;  ///< 0.5 = chance, 1 = perfect
  bool roc_by_person = false;
  /// Of each weight x sd / threshold: mean and sd over the folds.
  std::array<double, kFeatureCount> weight_mean{}, weight_sd{};
  int folds = 0;  ///< that could be tested
};

struct Training {
  Classifier classifier;
  Confusion held_out;                          ///< = checked.all
  std::array<double, kFeatureCount> spread{};  ///< sd of each feature over the labelled pairs
  HeldOut checked;
  std::vector<std::string> warnings;  ///< too few, contradictory, untested; a sentence each
};

/// Errors: those of check_labels.
Result<Training> train(const FeatureSet& set, std::span<const Label> labels,
                       const TrainConfig& config);

/// Of the labels that chance picked, by held-out distance, with the line at D = `at`.
FalseAccepts estimate_false_accepts(std::span<const Label> labels, const HeldOut& checked,
                                    double at);

/// Of the person's labels, those that contradict another: a pair called acceptable that differs at
/// least as much in every feature as one that is not. No classifier of this kind satisfies both.
int count_contradictions(const LabelledPairs& pairs);

}  // namespace vsprite
