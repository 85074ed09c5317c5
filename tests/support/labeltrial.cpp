// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// labeltrial WORK [SEEDS [SLIP]] - what answers are worth: the bundled film's true pose answers in
// place of a person, and the classifier is judged by it on 400,000 random pairs of the film.
// WORK: a work folder of assets/goldfish.mp4 whose stage `segment` has run. SLIP: share of wrong
// answers. Exit 1 where a goal is missed. Per row the mean over the seeds of:
//
//   accepted wrongly   of the accepted pairs, those that the true pose calls a visible jump
//   of all jumps       of the pairs that are visible jumps, those accepted
//   missed             of the acceptable pairs, those refused
//   cost               10 x accepted wrongly + missed, per 1,000 pairs: what training minimises
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numeric>
#include <string>

#include "similarity/ask.h"
#include "support/pose_truth.h"
#include "tool/pictures.h"
#include "vsprite/random.h"

using namespace vsprite;

namespace {

constexpr int kTestPairs = 400000, kNear = 15, kFilmLabels = 3000, kMost = 1000;

enum class Way { Active, Doubtful, AnyPair };
constexpr const char* kWayNames[] = {"asked by `label`", "random doubtful", "random of the film"};

struct Pair {
  int i = 0, j = 0;
  FeatureVector vector{};
  bool acceptable = false;
};

struct Rates {
  double accepted_wrongly = 0, of_jumps = 0, missed = 0, cost = 0;
  int seeds = 0;
};

/// Random pairs of the film, none of one clip within kNear samples.
std::vector<Pair> draw_pairs(const FeatureSet& set, const testing::PoseTruth& truth, int count,
                             std::uint64_t seed) {
  std::vector<Pair> pairs;
  Random random{seed};
  while (static_cast<int>(pairs.size()) < count) {
    const std::size_t a = random.below(set.rows.size()), b = random.below(set.rows.size());
    const int i = static_cast<int>(std::min(a, b)), j = static_cast<int>(std::max(a, b));
    if (i == j || (set.rows[a].clip == set.rows[b].clip && j - i < kNear)) continue;
    pairs.push_back({i, j, features(set, i, j), truth.acceptable(i, j)});
  }
  return pairs;
}

void judge(const std::vector<Pair>& test, const Classifier& classifier, Rates& sum) {
  double good = 0, accepted = 0, wrong = 0;
  for (const Pair& p : test) {
    const bool yes = classifier.distance(p.vector) <= 1;
    good += p.acceptable, accepted += yes, wrong += yes && !p.acceptable;
  }
  const auto all = static_cast<double>(test.size());
  const double missed = good - (accepted - wrong);
  sum.accepted_wrongly += wrong / std::max(accepted, 1.0);
  sum.of_jumps += wrong / (all - good);
  sum.missed += missed / good;
  sum.cost += 1000 * (10 * wrong + missed) / all;
  ++sum.seeds;
}

Classifier learn(const LabelledPairs& pairs) {
  std::vector<int> all(pairs.labels.size());
  std::iota(all.begin(), all.end(), 0);
  return fit_classifier(pairs, all, measure_spread(pairs.vectors), {});
}

/// What a player is shown: of the folder's transitions at T <= `cap`, how many are a visible jump, by
/// the pair that is dearer to the eye of the two that T is the mean of.
void print_transitions(const TransitionFile& file, const testing::PoseTruth& truth, float cap) {
  std::size_t jumps = 0, visible = 0;
  double worst = 0;
  for (std::size_t i = 0; i + 1 < file.costs.row_start.size(); ++i) {
    for (std::uint32_t t = file.costs.row_start[i]; t < file.costs.row_start[i + 1]; ++t) {
      const Transition& jump = file.costs.transitions[t];
      if (jump.cost <= 0 || jump.cost > cap) continue;
      const int from = static_cast<int>(i), to = static_cast<int>(jump.to);
      const double apart = std::max(truth.difference(from, to - 1), truth.difference(from + 1, to));
      ++jumps, visible += apart > truth.limit(), worst = std::max(worst, apart);
    }
  }
  std::printf("transitions at T <= %.2f: %zu jumps, %.2f %% visible, the worst %.1f px off\n",
              double{cap}, jumps, 100 * static_cast<double>(visible) / static_cast<double>(jumps),
              worst);
}

/// Answers up to kMost questions; `judged(n, classifier)` after each of the counts in the table.
template <class Judged>
void run(const FeatureSet& set, const testing::PoseTruth& truth, Way way, std::uint64_t seed,
         double slips, Judged judged) {
  LabelledPairs pairs = measure_pairs(set, bootstrap_labels(set, kFilmLabels, seed));
  Classifier classifier = learn(pairs);
  AskConfig ask;
  ask.seed = seed;
  if (way == Way::Doubtful) ask.random_share = 1;
  const std::vector<Candidate> pool = draw_pool(set, classifier, ask);
  const std::vector<Pair> any = draw_pairs(set, truth, kMost, 1000 + seed);
  std::vector<std::uint8_t> used(pool.size(), 0);
  Random slip{seed};
  judged(0, classifier);
  for (int n = 1; n <= kMost; ++n) {
    const Question question = next_question(pool, used, n - 1, classifier, ask);
    if (question.candidate < 0) return;
    const auto at = static_cast<std::size_t>(question.candidate);
    used[at] = 1;
    Pair pair{pool[at].i, pool[at].j, pool[at].vector, false};
    if (way == Way::AnyPair) pair = any[static_cast<std::size_t>(n - 1)];
    const bool answer = truth.acceptable(pair.i, pair.j) != (slip.unit() < slips);
    pairs.labels.push_back({pair.i, pair.j, answer, true, question.at_random});
    pairs.vectors.push_back(pair.vector);
    const bool shown = n == 50 || n == 100 || n == 300 || n == kMost;
    if (shown || (way == Way::Active && n < 300)) classifier = learn(pairs);
    if (shown) judged(n, classifier);
  }
}

void print(const char* name, int answers, const Rates& sum) {
  const double n = std::max(sum.seeds, 1);
  std::printf("%-20s %6d  %15.2f %%  %10.2f %%  %6.1f %%  %6.1f\n", name, answers,
              100 * sum.accepted_wrongly / n, 100 * sum.of_jumps / n, 100 * sum.missed / n,
              sum.cost / n);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fputs("usage: labeltrial WORK [SEEDS [SLIP]]\n", stderr), 2;
  const int seeds = argc > 2 ? std::atoi(argv[2]) : 5;
  const double slips = argc > 3 ? std::atof(argv[3]) : 0;
  const auto project = Project::look(argv[1]);
  if (!project) return std::fprintf(stderr, "%s\n", project.error().message.c_str()), 1;
  const auto sprites = load_sprites(*project);
  if (!sprites) return std::fprintf(stderr, "%s\n", sprites.error().message.c_str()), 1;
  const FeatureSet& set = sprites->features;
  const testing::PoseTruth truth(capture::GoldfishFilm(), set);
  const std::vector<Pair> test = draw_pairs(set, truth, kTestPairs, 99);

  double good = 0;
  for (const Pair& p : test) good += p.acceptable;
  std::printf("acceptable: within %.2f px of the true pose, %.2f %% of the pairs\n", truth.limit(),
              100 * good / kTestPairs);
  std::printf("%-20s %6s  %17s  %12s  %8s  %6s\n", "pairs", "labels", "accepted wrongly",
              "of all jumps", "missed", "cost");
  // Without a person, at stricter lines (`train --threshold`): what the designer can choose.
  for (const double move : {1.0, 0.9, 0.8, 0.7, 0.6}) {
    Rates sum;
    for (int s = 1; s <= seeds; ++s) {
      Classifier classifier = learn(
          measure_pairs(set, bootstrap_labels(set, kFilmLabels, static_cast<std::uint64_t>(s))));
      classifier.threshold *= move;
      judge(test, classifier, sum);
    }
    char name[32];
    std::snprintf(name, sizeof name, "bootstrap x %.1f", move);
    print(name, 0, sum);
  }
  std::fflush(stdout);
  std::map<int, Rates> tables[3];
  for (const Way way : {Way::Active, Way::Doubtful, Way::AnyPair}) {
    std::map<int, Rates>& table = tables[static_cast<int>(way)];
    for (int s = 1; s <= seeds; ++s)
      run(set, truth, way, static_cast<std::uint64_t>(s), slips,
          [&](int n, const Classifier& c) { judge(test, c, table[n]); });
    for (const auto& [answers, sum] : table) {
      if (answers == 0 && way != Way::Active) continue;
      print(answers == 0 ? "none: bootstrap" : kWayNames[static_cast<int>(way)], answers, sum);
    }
  }
  const auto cost = [&](Way way, int answers) {
    return tables[static_cast<int>(way)][answers].cost;
  };
  const bool as_good = cost(Way::Active, 100) <= cost(Way::AnyPair, kMost) &&
                       cost(Way::Active, 100) <= 1.05 * cost(Way::Doubtful, kMost);
  const bool few = tables[0][0].of_jumps <= 0.02 * tables[0][0].seeds;
  if (const auto file = project->transitions(set.rows.size()))
    for (const float cap : {1.0f, 0.8f, 0.75f, 0.7f}) print_transitions(*file, truth, cap);
  std::printf("100 asked do as well as 1,000 random: %s\n", as_good ? "yes" : "NO");
  std::printf("bootstrap accepts at most 2 %% of the jumps: %s\n", few ? "yes" : "NO");
  return as_good && few ? 0 : 1;
}
