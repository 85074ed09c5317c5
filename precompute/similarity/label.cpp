// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Labels from the film itself. The paper's authors corrected a rough guess by hand; this is the
// guess, made so that a first run needs nobody.
#include "similarity/label.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "vsprite/random.h"

namespace vsprite {
namespace {

constexpr int kNear = 15;  // samples; closer than this is neither sure nor needed
constexpr double kRepeatShare =
    0.75;  // a random pair nearer than this share of neighbours: a repeat

struct Pair {
  int i = 0, j = 0;
  FeatureVector f{};
  double rough = 0;
};

template <class T>
void shuffle(std::vector<T>& values, Random& random) {
  for (std::size_t k = values.size(); k > 1; --k) std::swap(values[k - 1], values[random.below(k)]);
}

bool moves(const FeatureSet& set, int i) {
  return static_cast<double>(set.samples[static_cast<std::size_t>(i)].speed) > set.moving_speed;
}

// Neighbours one and two samples apart, two thirds moving where the film has so many.
std::vector<Pair> neighbours(const FeatureSet& set, std::size_t count, Random& random) {
  std::vector<Pair> moving, resting;
  const int n = static_cast<int>(set.samples.size());
  for (int i = 0; i + 1 < n; ++i) {
    if (!follows(set, i, i + 1)) continue;
    auto& group = moves(set, i) ? moving : resting;
    group.push_back({i, i + 1, {}, 0});
    if (follows(set, i + 1, i + 2)) group.push_back({i, i + 2, {}, 0});
  }
  shuffle(moving, random);
  shuffle(resting, random);
  const std::size_t rest =
      std::min(resting.size(), std::max(count / 3, count - std::min(count, moving.size())));
  moving.resize(std::min(moving.size(), count - std::min(count, rest)));
  moving.insert(moving.end(), resting.begin(), resting.begin() + static_cast<std::ptrdiff_t>(rest));
  return moving;
}

// Random pairs, never within kNear samples of one clip.
std::vector<Pair> strangers(const FeatureSet& set, std::size_t count, Random& random) {
  std::vector<Pair> pairs;
  std::set<std::pair<int, int>> seen;
  const std::size_t n = set.samples.size();
  for (std::size_t tries = 0; n > 1 && tries < 20 * count && pairs.size() < count; ++tries) {
    int i = static_cast<int>(random.below(n)), j = static_cast<int>(random.below(n));
    if (i > j) std::swap(i, j);
    const bool one_clip =
        set.rows[static_cast<std::size_t>(i)].clip == set.rows[static_cast<std::size_t>(j)].clip;
    if (i == j || (one_clip && j - i < kNear) || !seen.insert({i, j}).second) continue;
    pairs.push_back({i, j, {}, 0});
  }
  return pairs;
}

void measure(const FeatureSet& set, std::vector<Pair>& pairs) {
  for (Pair& p : pairs) p.f = features(set, p.i, p.j);
}

// Sum of the features, each over its mean among random pairs.
void set_rough_distance(const std::vector<Pair>& random_pairs, std::vector<Pair>& pairs) {
  std::array<double, kFeatureCount> mean{};
  for (const Pair& p : random_pairs) {
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += static_cast<double>(p.f[k]);
  }
  for (Pair& p : pairs) {
    p.rough = 0;
    for (std::size_t k = 0; k < mean.size(); ++k) {
      if (mean[k] > 0) p.rough += static_cast<double>(p.f[k]) / mean[k];
    }
  }
}

}  // namespace

std::vector<Label> bootstrap_labels(const FeatureSet& set, int count, std::uint64_t seed) {
  Random random{seed};
  const auto half = static_cast<std::size_t>(std::max(count, 2)) / 2;
  std::vector<Pair> near = neighbours(set, half, random);
  std::vector<Pair> far = strangers(set, 2 * half, random);
  measure(set, near);
  measure(set, far);
  set_rough_distance(far, near);
  set_rough_distance(far, far);

  // Farthest first, so that a film of little variety still gives its least alike pairs.
  std::vector<double> rough;
  for (const Pair& p : near) rough.push_back(p.rough);
  std::sort(rough.begin(), rough.end());
  const double repeat =
      rough.empty()
          ? 0
          : rough[static_cast<std::size_t>(kRepeatShare * static_cast<double>(rough.size() - 1))];
  const auto is_repeat = [&](const Pair& p) { return p.rough <= repeat; };
  std::vector<Pair> chosen = far;
  std::erase_if(chosen, is_repeat);
  if (chosen.size() < far.size() / 10) {
    chosen = far;
    std::stable_sort(chosen.begin(), chosen.end(),
                     [](const Pair& a, const Pair& b) { return a.rough > b.rough; });
    chosen.resize(std::min(chosen.size(), far.size() / 10 + 1));
  }
  chosen.resize(std::min(chosen.size(), half));

  std::vector<Label> labels;
  for (const Pair& p : near) labels.push_back({p.i, p.j, true, false});
  for (const Pair& p : chosen) labels.push_back({p.i, p.j, false, false});
  return labels;
}

}  // namespace vsprite
