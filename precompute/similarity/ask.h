// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/ask.h - which pair to show a person next.
//
// Of a film's millions of pairs nearly all are obvious. A pool of some thousand is drawn at random
// from those that are not: D <= `reach` by the film's own labels, never near neighbours. Then
//
//   * one question in `1 / random_share` is drawn at random from the pool. These answers keep the
//     estimate honest: among them the share of accepted pairs that a person calls a visible jump is
//     the share in the whole film;
//   * the others teach: of the pairs nearest to the line between smooth and jump, the one that
//     differs most from every pair answered so far, so that each way of being different is asked.
//
// What is asked follows from the film, the seed and the answers alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "similarity/classifier.h"
#include "similarity/features.h"

namespace vsprite {

struct AskConfig {
  int pool = 30000;           ///< pairs, >= 1
  double widest = 4;          ///< D by the film's own labels, >= 1
  double reach = 1.5;         ///< D by the answers so far, >= 1
  double random_share = 0.2;  ///< [0, 1]
  int near = 200;             ///< pairs that count as near the line, >= 1
  std::uint64_t seed = 1;
};

/// A pair that may be asked, with what makes it quick to weigh.
struct Candidate {
  int i = 0, j = 0;  ///< i < j
  FeatureVector vector{};
};

/// Pairs at D <= reach, none of one clip within 15 samples, no pair twice. Fewer where the film has
/// fewer; none for a film of a few samples.
std::vector<Candidate> draw_pool(const FeatureSet& set, const Classifier& classifier,
                                 const AskConfig& config);

struct Question {
  int candidate = -1;  ///< index in the pool; -1: everything has been asked
  bool at_random = false;
  float distance = 0;  ///< D by the classifier; the guess is "smooth" where D <= 1
};

/// The next question. `used` (pool): 1 for pairs answered or passed over. `answered`: how many have
/// been asked before. Cost O(pool x answers) at most.
Question next_question(std::span<const Candidate> pool, std::span<const std::uint8_t> used,
                       int answered, const Classifier& classifier, const AskConfig& config);

}  // namespace vsprite
