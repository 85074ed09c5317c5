// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <linear.h>

#include <cmath>
#include <numeric>

#include "similarity/classifier.h"
#include "support/creature.h"

namespace vsprite {
namespace {

Training train_on(const FeatureSet& set, const std::vector<Label>& labels) {
  auto training = train(set, labels, {});
  EXPECT_TRUE(training);
  return std::move(*training);
}

double scaled(const FeatureVector& f, const std::array<double, kFeatureCount>& sd, std::size_t k) {
  return sd[k] > 0 ? static_cast<double>(f[k]) / sd[k] : 0;
}

constexpr double kBias = 100;  // large, so that its weight is hardly regularised

/// The same loss without the sign constraint, by liblinear (L2-regularised squared hinge, primal).
std::vector<double> unconstrained(const LabelledPairs& pairs,
                                  const std::array<double, kFeatureCount>& sd,
                                  const TrainConfig& config) {
  const std::size_t n = pairs.labels.size();
  std::vector<std::vector<feature_node>> nodes(n);
  std::vector<feature_node*> rows;
  std::vector<double> classes;
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t f = 0; f < kFeatureCount; ++f)
      nodes[k].push_back({static_cast<int>(f) + 1, scaled(pairs.vectors[k], sd, f)});
    nodes[k].push_back({kFeatureCount + 1, kBias});
    nodes[k].push_back({-1, 0});
    rows.push_back(nodes[k].data());
    classes.push_back(pairs.labels[k].acceptable ? 1 : -1);
  }
  problem data{};
  data.l = static_cast<int>(n);
  data.n = kFeatureCount + 1;
  data.y = classes.data();
  data.x = rows.data();
  data.bias = kBias;
  int weighted[] = {-1};
  double costs[] = {config.false_accept_cost};
  parameter how{};
  how.solver_type = L2R_L2LOSS_SVC;
  how.eps = 1e-8;
  how.C = 1 / (2 * config.ridge * static_cast<double>(n));
  how.nr_weight = 1;
  how.weight_label = weighted;
  how.weight = costs;
  set_print_string_function([](const char*) {});
  model* fitted = ::train(&data, &how);
  std::vector<double> w(fitted->w, fitted->w + kFeatureCount + 1);
  if (fitted->label[0] != 1)
    for (double& value : w) value = -value;
  w.back() *= kBias;
  free_and_destroy_model(&fitted);
  return w;
}

double loss(const LabelledPairs& pairs, const std::array<double, kFeatureCount>& sd,
            const TrainConfig& config, const std::vector<double>& w) {
  double sum = 0, ridge = 0;
  for (std::size_t k = 0; k < pairs.labels.size(); ++k) {
    double score = w.back();
    for (std::size_t f = 0; f < kFeatureCount; ++f) score += w[f] * scaled(pairs.vectors[k], sd, f);
    const bool good = pairs.labels[k].acceptable;
    const double slack = std::max(0.0, 1 - (good ? score : -score));
    sum += (good ? 1 : config.false_accept_cost) * slack * slack;
  }
  for (std::size_t f = 0; f < kFeatureCount; ++f) ridge += config.ridge * w[f] * w[f];
  return sum / static_cast<double>(pairs.labels.size()) + ridge;
}

TEST(Classifier, IsAsGoodAsTheUnconstrainedOneUpToItsConstraint) {
  const FeatureSet set = testing::make_creature(320, 80);
  const LabelledPairs pairs = measure_pairs(set, bootstrap_labels(set, 600, 1));
  const auto sd = measure_spread(pairs.vectors);
  std::vector<int> all(pairs.labels.size());
  std::iota(all.begin(), all.end(), 0);
  TrainConfig config;
  config.floor = 0;
  const Classifier ours = fit_classifier(pairs, all, sd, config);
  std::vector<double> w;
  for (std::size_t k = 0; k < kFeatureCount; ++k) w.push_back(-ours.weights[k] * sd[k]);
  w.push_back(ours.threshold);
  const std::vector<double> free = unconstrained(pairs, sd, config);
  const double mine = loss(pairs, sd, config, w), theirs = loss(pairs, sd, config, free);
  EXPECT_GE(mine, theirs - 1e-5);
  bool has_sign = true;  // where liblinear's optimum happens to obey the constraint, ours is it
  for (std::size_t k = 0; k < kFeatureCount; ++k) has_sign &= free[k] <= 0;
  if (has_sign) {
    EXPECT_NEAR(mine, theirs, 1e-5);
  }
  EXPECT_LT(mine, 1.5 * theirs + 0.01);
}

TEST(HeldOut, JudgesALabelOnlyByWhatNeverSawItsFrames) {
  const FeatureSet set = testing::make_creature(400, 80);
  auto labels = bootstrap_labels(set, 400, 1);
  const Training before = train_on(set, labels);
  // Turning every label of one clip changes what is learned, but not how that clip is judged.
  const int clip = 2;
  const auto inside = [&](int s) { return set.rows[static_cast<std::size_t>(s)].clip == clip; };
  for (Label& l : labels)
    if (inside(l.i) && inside(l.j)) l.acceptable = !l.acceptable;
  const Training after = train_on(set, labels);
  ASSERT_NE(before.classifier.weights, after.classifier.weights);
  int judged = 0;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (!inside(labels[k].i) || before.checked.distance[k] < 0) continue;
    EXPECT_FLOAT_EQ(before.checked.distance[k], after.checked.distance[k]);
    ++judged;
  }
  EXPECT_GT(judged, 20);
}

TEST(HeldOut, RocRisesFromNothingToAll) {
  const FeatureSet set = testing::make_creature(320, 40);
  const HeldOut checked = train_on(set, bootstrap_labels(set, 400, 1)).checked;
  ASSERT_GT(checked.roc.size(), 2u);
  for (std::size_t k = 1; k < checked.roc.size(); ++k) {
    EXPECT_GE(checked.roc[k].at, checked.roc[k - 1].at);
    EXPECT_GE(checked.roc[k].accepted_good, checked.roc[k - 1].accepted_good);
    EXPECT_GE(checked.roc[k].accepted_bad, checked.roc[k - 1].accepted_bad);
  }
  EXPECT_EQ(checked.roc.back().accepted_good, 1);
  EXPECT_EQ(checked.roc.back().accepted_bad, 1);
  EXPECT_GT(checked.roc_area, 0.9);
  EXPECT_LE(checked.roc_area, 1);
}

TEST(HeldOut, APersonsAnswersMoveTheLineAndTheFilmsOwnFade) {
  const FeatureSet set = testing::make_creature(320, 80);
  std::vector<Label> labels = bootstrap_labels(set, 400, 1);
  const Training film = train_on(set, labels);
  // This person accepts whatever swims the same way, within a sixth of a turn.
  int asked = 0;
  for (int i = 0; i < 300; i += 3)
    for (int j = i + 17; j < 320 && asked < 400; j += 41, ++asked) {
      const int apart = std::min((j - i) % 64, 64 - (j - i) % 64);
      labels.push_back({i, j, apart <= 10, true, false});
    }
  const Training person = train_on(set, labels);
  const auto slack = [&](const Training& t) { return t.classifier.distance(features(set, 0, 72)); };
  EXPECT_LT(slack(person), slack(film));
  const Confusion& c = person.checked.person;
  EXPECT_GT(c.true_accept + c.true_reject, 9 * (c.false_accept + c.false_reject));
}

TEST(HeldOut, SaysWhichAnswersContradictOthers) {
  const FeatureSet set = testing::make_creature(320, 80);
  std::vector<Label> labels = bootstrap_labels(set, 200, 1);
  const std::size_t film = labels.size();
  for (int k = 0; k < 30; ++k)
    for (const bool smooth : {false, true}) labels.push_back({k, k + 70, smooth, true, false});
  const Training training = train_on(set, labels);
  EXPECT_EQ(count_contradictions(measure_pairs(
                set, {labels.begin() + static_cast<std::ptrdiff_t>(film), labels.end()})),
            60);
  ASSERT_FALSE(training.warnings.empty());
  EXPECT_NE(training.warnings[0].find("60 of 60"), std::string::npos) << training.warnings[0];
}

TEST(HeldOut, SaysWhereAnswersAreFew) {
  const FeatureSet set = testing::make_creature(320, 80);
  std::vector<Label> labels = bootstrap_labels(set, 200, 1);
  labels.push_back({0, 64, true, true, true});
  const Training training = train_on(set, labels);
  ASSERT_FALSE(training.warnings.empty());
  EXPECT_NE(training.warnings[0].find("1 smooth, 0 visible jumps"), std::string::npos);
}

TEST(HeldOut, LikelyShareIsWilsons) {
  EXPECT_NEAR(likely_at_most(0, 10), 0.2775, 1e-4);
  EXPECT_NEAR(likely_at_most(5, 100), 0.1118, 1e-4);
  EXPECT_EQ(likely_at_most(0, 0), 1);
}

}  // namespace
}  // namespace vsprite
