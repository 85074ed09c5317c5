// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "similarity/ask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "support/creature.h"

namespace vsprite {
namespace {

Classifier learn(const FeatureSet& set) {
  return train(set, bootstrap_labels(set, 400, 1), {})->classifier;
}

TEST(Ask, PoolHoldsDoubtfulPairsOnceAndNoNeighbours) {
  const FeatureSet set = testing::make_creature(320, 80);
  const Classifier classifier = learn(set);
  AskConfig config;
  config.pool = 500;
  const auto pool = draw_pool(set, classifier, config);
  ASSERT_GT(pool.size(), 100u);
  std::set<std::pair<int, int>> seen;
  for (const Candidate& c : pool) {
    EXPECT_LT(c.i, c.j);
    EXPECT_TRUE(set.rows[static_cast<std::size_t>(c.i)].clip !=
                    set.rows[static_cast<std::size_t>(c.j)].clip ||
                c.j - c.i >= 15);
    EXPECT_TRUE(seen.insert({c.i, c.j}).second);
    EXPECT_LE(classifier.distance(c.vector), 4);
    EXPECT_EQ(c.vector, features(set, c.i, c.j));
  }
}

TEST(Ask, AFilmOfAFewSamplesHasNothingToAsk) {
  for (int count : {1, 2, 8}) {
    const FeatureSet set = testing::make_creature(count, count);
    EXPECT_TRUE(draw_pool(set, Classifier{}, {}).empty()) << count;
  }
}

TEST(Ask, EveryFifthIsDrawnAtRandomAndTheOthersLieNearTheLine) {
  const FeatureSet set = testing::make_creature(320, 80);
  const Classifier classifier = learn(set);
  AskConfig config;
  config.near = 20;
  const auto pool = draw_pool(set, classifier, config);
  std::vector<std::uint8_t> used(pool.size(), 0);
  int random = 0;
  for (int n = 0; n < 50; ++n) {
    const Question q = next_question(pool, used, n, classifier, config);
    ASSERT_GE(q.candidate, 0);
    random += q.at_random;
    EXPECT_EQ(used[static_cast<std::size_t>(q.candidate)], 0);
    if (!q.at_random) {
      int nearer = 0;
      for (std::size_t k = 0; k < pool.size(); ++k)
        nearer += used[k] == 0 &&
                  std::abs(classifier.distance(pool[k].vector) - 1) < std::abs(q.distance - 1);
      EXPECT_LT(nearer, 20);
    }
    used[static_cast<std::size_t>(q.candidate)] = 1;
  }
  EXPECT_EQ(random, 10);
}

TEST(Ask, EndsWhenEverythingHasBeenAsked) {
  const FeatureSet set = testing::make_creature(320, 80);
  AskConfig few;
  few.pool = 3;
  const auto pool = draw_pool(set, learn(set), few);
  const std::vector<std::uint8_t> used(pool.size(), 1);
  EXPECT_EQ(next_question(pool, used, 3, learn(set), {}).candidate, -1);
}

}  // namespace
}  // namespace vsprite
