// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// How well the classifier does on pairs that it has not seen. Neighbouring frames are near copies
// of one another: a pair is judged only by a classifier that saw neither of its frames nor any
// frame near them.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "similarity/classifier.h"

namespace vsprite {
namespace {

constexpr int kGap = 15;         // samples left out around a held-out block of time
constexpr int kFewAnswers = 20;  // of one kind; below that the film's own labels lead

// The fold of every sample: whole clips, longest first, each to the fold with the fewest samples;
// or blocks of time.
std::vector<int> make_folds(const FeatureSet& set, int folds) {
  struct Clip {
    int clip = 0;
    std::size_t begin = 0, size = 0;
  };
  const std::size_t n = set.rows.size(), parts = static_cast<std::size_t>(folds);
  std::vector<Clip> clips;
  for (std::size_t i = 0; i < n; ++i) {
    if (clips.empty() || clips.back().clip != set.rows[i].clip)
      clips.push_back({set.rows[i].clip, i, 0});
    ++clips.back().size;
  }
  std::stable_sort(clips.begin(), clips.end(),
                   [](const Clip& a, const Clip& b) { return a.size > b.size; });
  std::vector<int> fold(n);
  if (clips.size() < parts || 2 * clips.front().size > n) {
    for (std::size_t i = 0; i < n; ++i) fold[i] = static_cast<int>(i * parts / n);
    return fold;
  }
  std::vector<std::size_t> filled(parts, 0);
  for (const Clip& clip : clips) {
    const auto least = std::min_element(filled.begin(), filled.end());
    *least += clip.size;
    std::fill_n(fold.begin() + static_cast<std::ptrdiff_t>(clip.begin), clip.size,
                static_cast<int>(least - filled.begin()));
  }
  return fold;
}

// True if the sample lies in fold `held`, or in the same clip within kGap samples of it.
bool touches(const FeatureSet& set, const std::vector<int>& fold, int sample, int held) {
  const int n = static_cast<int>(fold.size());
  const auto at = static_cast<std::size_t>(sample);
  for (int s = std::max(0, sample - kGap); s <= std::min(n - 1, sample + kGap); ++s) {
    const auto k = static_cast<std::size_t>(s);
    if (fold[k] == held && set.rows[k].clip == set.rows[at].clip) return true;
  }
  return false;
}

bool has_both_classes(const LabelledPairs& pairs, std::span<const int> chosen) {
  bool good = false, bad = false;
  for (const int k : chosen)
    (pairs.labels[static_cast<std::size_t>(k)].acceptable ? good : bad) = true;
  return good && bad;
}

void count(Confusion& confusion, bool acceptable, bool accepted) {
  ++(acceptable ? (accepted ? confusion.true_accept : confusion.false_reject)
                : (accepted ? confusion.false_accept : confusion.true_reject));
}

void set_weight_spread(const std::vector<std::array<double, kFeatureCount>>& of_folds,
                       HeldOut& out) {
  const auto n = static_cast<double>(of_folds.size());
  for (std::size_t k = 0; k < kFeatureCount && !of_folds.empty(); ++k) {
    double sum = 0, squares = 0;
    for (const auto& weights : of_folds) sum += weights[k];
    out.weight_mean[k] = sum / n;
    for (const auto& weights : of_folds) squares += (weights[k] - sum / n) * (weights[k] - sum / n);
    out.weight_sd[k] = std::sqrt(squares / n);
  }
}

// Pairs by distance; one point after every group of equal ones.
void set_roc(const LabelledPairs& pairs, HeldOut& out) {
  const Confusion& p = out.person;
  out.roc_by_person = p.true_accept + p.false_reject > 0 && p.true_reject + p.false_accept > 0;
  std::vector<std::pair<float, bool>> judged;
  double good = 0, bad = 0;
  for (std::size_t k = 0; k < pairs.labels.size(); ++k) {
    const Label& label = pairs.labels[k];
    if (out.distance[k] < 0 || (out.roc_by_person && !label.by_person)) continue;
    judged.emplace_back(out.distance[k], label.acceptable);
    (label.acceptable ? good : bad) += 1;
  }
  if (good == 0 || bad == 0) return;
  std::sort(judged.begin(), judged.end());
  double accepted_good = 0, accepted_bad = 0;
  out.roc.push_back({0, 0, 0});
  for (std::size_t k = 0; k < judged.size(); ++k) {
    (judged[k].second ? accepted_good : accepted_bad) += 1;
    if (k + 1 < judged.size() && judged[k + 1].first == judged[k].first) continue;
    const RocPoint before = out.roc.back();
    out.roc.push_back({double{judged[k].first}, accepted_good / good, accepted_bad / bad});
    out.roc_area += (out.roc.back().accepted_bad - before.accepted_bad) *
                    (out.roc.back().accepted_good + before.accepted_good) / 2;
  }
}

HeldOut cross_validate(const FeatureSet& set, const LabelledPairs& pairs,
                       const std::array<double, kFeatureCount>& spread, const TrainConfig& config) {
  HeldOut out;
  out.distance.assign(pairs.labels.size(), -1);
  const std::vector<int> fold = make_folds(set, config.folds);
  std::vector<std::array<double, kFeatureCount>> weights;
  for (int held = 0; held < config.folds; ++held) {
    std::vector<int> training, test;
    for (std::size_t k = 0; k < pairs.labels.size(); ++k) {
      const Label& l = pairs.labels[k];
      const int index = static_cast<int>(k);
      if (fold[static_cast<std::size_t>(l.i)] == held) test.push_back(index);
      if (!touches(set, fold, l.i, held) && !touches(set, fold, l.j, held))
        training.push_back(index);
    }
    if (test.empty() || !has_both_classes(pairs, training)) continue;
    const Classifier classifier = fit_classifier(pairs, training, spread, config);
    auto& of_fold = weights.emplace_back();
    for (std::size_t k = 0; k < kFeatureCount; ++k)
      of_fold[k] = classifier.weights[k] * spread[k] / classifier.threshold;
    for (const int k : test) {
      const auto at = static_cast<std::size_t>(k);
      const Label& label = pairs.labels[at];
      out.distance[at] = classifier.distance(pairs.vectors[at]);
      count(out.all, label.acceptable, out.distance[at] <= 1);
      if (label.by_person) count(out.person, label.acceptable, out.distance[at] <= 1);
    }
  }
  out.folds = static_cast<int>(weights.size());
  set_weight_spread(weights, out);
  set_roc(pairs, out);
  return out;
}

// Sentences about labels that can teach little.
std::vector<std::string> find_warnings(const LabelledPairs& pairs, const HeldOut& checked,
                                       const TrainConfig& config) {
  std::vector<std::string> warnings;
  int good = 0, bad = 0, untested = 0;
  for (std::size_t k = 0; k < pairs.labels.size(); ++k) {
    if (pairs.labels[k].by_person) ++(pairs.labels[k].acceptable ? good : bad);
    untested += checked.distance[k] < 0;
  }
  const int answers = good + bad;
  if (answers > 0 && std::min(good, bad) < kFewAnswers)
    warnings.push_back(
        "few answers: " + std::to_string(good) + " smooth, " + std::to_string(bad) +
        " visible jumps, and " + std::to_string(kFewAnswers) +
        " of each are due before they decide; until then the film's own labels lead");
  if (const int against = count_contradictions(pairs); 10 * against > answers)
    warnings.push_back("contradictory answers: " + std::to_string(against) + " of " +
                       std::to_string(answers) +
                       " call a pair smooth that differs more in every feature than one called a "
                       "visible jump, or the reverse: look again at those that surprise you");
  if (untested > 0)
    warnings.push_back("not tested: " + std::to_string(untested) + " of " +
                       std::to_string(pairs.labels.size()) +
                       " labels, because the film is too short for " +
                       std::to_string(config.folds) + " folds: the rates hold for the others only");
  return warnings;
}

bool differs_at_least_as_much(const FeatureVector& a, const FeatureVector& b) {
  for (std::size_t k = 0; k < a.size(); ++k)
    if (a[k] < b[k]) return false;
  return true;
}

}  // namespace

Result<void> check_labels(const FeatureSet& set, std::span<const Label> labels,
                          const TrainConfig& config) {
  if (!(config.false_accept_cost > 0) || !(config.ridge > 0) || !(config.floor >= 0) ||
      !(config.floor <= 0.1) || config.folds < 2 || !(config.film_labels_worth > 0)) {
    return Error{ErrorCode::BadSetting,
                 "train: false_accept_cost, ridge and film_labels_worth must be above 0, floor in "
                 "0..0.1, folds at least 2; correct the setting"};
  }
  const auto acceptable =
      std::count_if(labels.begin(), labels.end(), [](const Label& l) { return l.acceptable; });
  const bool none_good = acceptable == 0;
  if (none_good || acceptable == std::ssize(labels)) {
    return Error{ErrorCode::BadContent,
                 "train: " + std::to_string(labels.size()) + " labelled pairs of " +
                     std::to_string(set.samples.size()) + " samples hold " +
                     (none_good ? "no acceptable pair" : "no unacceptable pair") +
                     ", at least one of each kind is due; film the subject for longer and let it "
                     "take different poses"};
  }
  return {};
}

void FalseAccepts::count(bool is_accepted, bool is_acceptable) noexcept {
  ++(is_accepted ? accepted : refused);
  if (is_accepted && !is_acceptable) ++wrong;
  if (!is_accepted && is_acceptable) ++missed;
}

double likely_at_most(int wrong, int count) noexcept {
  if (count == 0) return 1;
  constexpr double z = 1.959964;
  const double n = count, p = wrong / n;
  const double spread = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  return std::min(1.0, (p + z * z / (2 * n) + spread) / (1 + z * z / n));
}

FalseAccepts estimate_false_accepts(std::span<const Label> labels, const HeldOut& checked,
                                    double at) {
  FalseAccepts out;
  for (std::size_t k = 0; k < labels.size(); ++k)
    if (labels[k].at_random && checked.distance[k] >= 0)
      out.count(double{checked.distance[k]} <= at, labels[k].acceptable);
  return out;
}

int count_contradictions(const LabelledPairs& pairs) {
  std::vector<std::size_t> good, bad;
  for (std::size_t k = 0; k < pairs.labels.size(); ++k)
    if (pairs.labels[k].by_person) (pairs.labels[k].acceptable ? good : bad).push_back(k);
  std::vector<char> against(pairs.labels.size(), 0);
  for (const std::size_t g : good)
    for (const std::size_t b : bad)
      if (differs_at_least_as_much(pairs.vectors[g], pairs.vectors[b])) against[g] = against[b] = 1;
  return static_cast<int>(std::count(against.begin(), against.end(), 1));
}

Result<Training> train(const FeatureSet& set, std::span<const Label> labels,
                       const TrainConfig& config) {
  if (auto ok = check_labels(set, labels, config); !ok) return ok.error();
  const LabelledPairs pairs = measure_pairs(set, {labels.begin(), labels.end()});
  std::vector<int> all(labels.size());
  std::iota(all.begin(), all.end(), 0);
  Training result;
  result.spread = measure_spread(pairs.vectors);
  result.classifier = fit_classifier(pairs, all, result.spread, config);
  result.checked = cross_validate(set, pairs, result.spread, config);
  result.held_out = result.checked.all;
  result.warnings = find_warnings(pairs, result.checked, config);
  return result;
}

}  // namespace vsprite
