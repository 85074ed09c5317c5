// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "similarity/transitions.h"

#include <gtest/gtest.h>

#include "support/creature.h"

namespace vsprite {
namespace {

Classifier trained(const FeatureSet& set) {
  return train(set, bootstrap_labels(set, 400, 1), {})->classifier;
}

TEST(Transitions, FollowTheEquationAndTheBanAndAreStronglyConnected) {
  const FeatureSet set = testing::make_creature(320, 80);
  const Classifier classifier = trained(set);
  const auto pairs = accepted_pairs(set, classifier, 1);
  for (int limit : {1, 3, 100}) {
    TransitionStats stats;
    const auto costs = make_cost_table(set, pairs, {limit, 15, 1}, stats);
    ASSERT_TRUE(costs);
    const Components parts = find_components(*costs);
    std::uint32_t part = parts.count;
    for (std::uint32_t i = 0; i < 320; ++i) {
      if (!costs->kept[i]) continue;
      if (part == parts.count) part = parts.of[i];
      EXPECT_EQ(parts.of[i], part);
      for (std::uint32_t e = costs->row_start[i]; e < costs->row_start[i + 1]; ++e) {
        const Transition& t = costs->transitions[e];
        const int a = static_cast<int>(i), b = static_cast<int>(t.to);
        EXPECT_TRUE(costs->kept[t.to]);
        EXPECT_FALSE(b <= a && a - b < 15 && a / 80 == b / 80);
        const float due = b == a + 1 ? 0
                                     : (classifier.distance(features(set, a, b - 1)) +
                                        classifier.distance(features(set, a + 1, b))) /
                                           2;
        EXPECT_EQ(t.cost, due);
      }
    }
    EXPECT_EQ(stats.kept + stats.lost_clip_end + stats.lost_dead_end + stats.lost_unreachable, 320);
  }
}

TEST(Transitions, RefusesAFilmWithoutAnEndlessRun) {
  const FeatureSet set = testing::make_creature(30, 30);
  TransitionStats stats;
  const auto costs = make_cost_table(set, {}, {}, stats);
  ASSERT_FALSE(costs);
  EXPECT_EQ(costs.error().code, ErrorCode::BadContent);
}

}  // namespace
}  // namespace vsprite
