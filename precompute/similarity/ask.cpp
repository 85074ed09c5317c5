// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Uncertainty sampling with a spread: pairs at the line teach a linear classifier most, and many of
// them teach the same.
#include "similarity/ask.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "similarity/random.h"

namespace vsprite {
namespace {

constexpr int kNear = 15;                        // samples of one clip: no jump, stutter
constexpr std::int64_t kMostDraws = 20'000'000;  // a few seconds

bool is_askable(const FeatureSet& set, int i, int j) {
  const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
  return i < j && (set.rows[a].clip != set.rows[b].clip || j - i >= kNear);
}

// What each feature adds to D.
using Parts = std::array<double, kFeatureCount>;
Parts parts_of(const Classifier& classifier, const FeatureVector& f) {
  Parts parts;
  for (std::size_t k = 0; k < parts.size(); ++k)
    parts[k] = classifier.weights[k] * static_cast<double>(f[k]) / classifier.threshold;
  return parts;
}

double apart(const Parts& a, const Parts& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += std::abs(a[k] - b[k]);
  return sum;
}

}  // namespace

std::vector<Candidate> draw_pool(const FeatureSet& set, const Classifier& classifier,
                                 const AskConfig& config) {
  std::vector<Candidate> pool;
  std::set<std::pair<int, int>> seen;
  Random random{config.seed ^ 0x706F6F6Cu};
  const std::size_t n = set.samples.size();
  const auto pairs = static_cast<std::int64_t>(n * (n - std::min<std::size_t>(n, 1)) / 2);
  // A film of few samples has every pair drawn many times over; a large one is not read out.
  const std::int64_t draws = std::min(kMostDraws, 20 * pairs);
  for (std::int64_t d = 0; d < draws && std::ssize(pool) < config.pool; ++d) {
    int i = static_cast<int>(random.below(n)), j = static_cast<int>(random.below(n));
    if (i > j) std::swap(i, j);
    if (!is_askable(set, i, j)) continue;
    const auto reach = static_cast<float>(config.widest);
    if (classifier.distance(cheap_features(set, i, j)) > reach) continue;  // a lower bound of D
    const FeatureVector f = features(set, i, j);
    if (classifier.distance(f) > reach || !seen.insert({i, j}).second) continue;
    pool.push_back({i, j, f});
  }
  return pool;
}

Question next_question(std::span<const Candidate> pool, std::span<const std::uint8_t> used,
                       int answered, const Classifier& classifier, const AskConfig& config) {
  std::vector<int> open;
  for (std::size_t k = 0; k < pool.size(); ++k)
    if (used[k] == 0) open.push_back(static_cast<int>(k));
  if (open.empty()) return {};
  const auto distance = [&](int k) {
    return classifier.distance(pool[static_cast<std::size_t>(k)].vector);
  };
  // Evenly spread over the questions: the n-th is random where n share passes a whole number.
  const bool at_random =
      std::floor((answered + 1) * config.random_share) > std::floor(answered * config.random_share);
  if (at_random) {
    Random random{config.seed + 0x9E3779B97F4A7C15u * static_cast<std::uint64_t>(answered + 1)};
    std::vector<int> within;
    for (const int k : open)
      if (double{distance(k)} <= config.reach) within.push_back(k);
    if (within.empty()) within = open;
    const int k = within[random.below(within.size())];
    return {k, true, distance(k)};
  }
  const auto off = [&](int k) { return std::abs(distance(k) - 1); };
  const auto near = std::min<std::ptrdiff_t>(config.near, std::ssize(open));
  std::vector<std::pair<float, int>> ranked;
  for (const int k : open) ranked.emplace_back(off(k), k);
  std::partial_sort(ranked.begin(), ranked.begin() + near, ranked.end());
  ranked.resize(static_cast<std::size_t>(near));

  std::vector<Parts> known;
  for (std::size_t k = 0; k < pool.size(); ++k)
    if (used[k] != 0) known.push_back(parts_of(classifier, pool[k].vector));
  int best = ranked.front().second;
  double best_apart = -1;
  for (const auto& [ignored, k] : ranked) {
    if (known.empty()) break;  // the first is the nearest to the line
    const Parts parts = parts_of(classifier, pool[static_cast<std::size_t>(k)].vector);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Parts& other : known) nearest = std::min(nearest, apart(parts, other));
    if (nearest > best_apart) best = k, best_apart = nearest;
  }
  return {best, false, distance(best)};
}

}  // namespace vsprite
