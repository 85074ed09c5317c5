// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "similarity/transitions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "control/lanes.h"
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
    const auto costs = make_cost_table(set, pairs, {limit, 15}, stats);
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

float cost_of(const CostTable& t, std::uint32_t from, std::uint32_t to) {
  for (std::uint32_t e = t.row_start[from]; e < t.row_start[from + 1]; ++e) {
    if (t.transitions[e].to == to) return t.transitions[e].cost;
  }
  return -1;
}

TEST(Transitions, NearMissesCostMoreThanAnyCapAndKeepNothingAlive) {
  const FeatureSet set = testing::make_creature(320, 80);
  const Classifier classifier = trained(set);
  TransitionStats plain_stats, stats;
  TransitionConfig config;
  config.max_per_sample = 1000;
  const auto plain = make_cost_table(set, accepted_pairs(set, classifier, 1), config, plain_stats);
  config.near_miss = 0.5f;
  const auto pairs = accepted_pairs(set, classifier, 1, nullptr, {}, 1.5f);
  const auto costs = make_cost_table(set, pairs, config, stats);
  ASSERT_TRUE(plain && costs);
  EXPECT_GT(stats.near_misses, 0u);
  EXPECT_EQ(stats.accepted, plain_stats.accepted);
  EXPECT_EQ(costs->kept, plain->kept);
  std::uint64_t dear = 0;
  for (std::uint32_t i = 0; i < 320; ++i) {
    for (std::uint32_t e = costs->row_start[i]; e < costs->row_start[i + 1]; ++e) {
      const Transition& t = costs->transitions[e];
      if (t.cost <= 1) {
        EXPECT_EQ(t.cost, cost_of(*plain, i, t.to));
      } else {
        EXPECT_GT(t.cost, config.near_miss_price);
        ++dear;
      }
    }
  }
  EXPECT_EQ(stats.transitions, plain_stats.transitions + dear);
}

TEST(Transitions, MinimaLeaveOneOfARunOfJumps) {
  const FeatureSet set = testing::make_creature(320, 80);
  const auto pairs = accepted_pairs(set, trained(set), 1);
  TransitionStats all_stats, stats;
  const auto all = make_cost_table(set, pairs, {1000, 15}, all_stats);
  const auto costs = make_cost_table(set, pairs, {1000, 15, true}, stats);
  ASSERT_TRUE(all && costs);
  EXPECT_LT(2 * stats.transitions, all_stats.transitions);
  EXPECT_EQ(stats.kept, all_stats.kept);
  EXPECT_EQ(find_components(*costs).count, find_components(*all).count);
}

// Four clips made apart: a body whose size, pace and light differ, moving through one cycle.
FeatureSet make_cast() {
  struct Clip {
    const char* tag;
    int frames, reach;
    double speed;
  };
  constexpr Clip kClips[] = {
      {"idle", 10, 8, 0}, {"walk", 24, 9, 40}, {"run", 30, 11, 120}, {"jump", 36, 6, 80}};
  std::vector<SampleRow> rows;
  std::vector<Image> images;
  for (int c = 0; c < 4; ++c) {
    for (int k = 0; k < kClips[c].frames; ++k) {
      SampleRow r;
      r.sample = r.frame = static_cast<int>(rows.size());
      r.clip = c, r.tag = kClips[c].tag;
      r.width = r.height = 32, r.anchor_x = r.anchor_y = 16;
      r.velocity_x = kClips[c].speed, r.area = 3 * kClips[c].reach * kClips[c].reach;
      rows.push_back(r);
      Image image{32, 32, std::vector<std::uint8_t>(4 * 32 * 32, 0)};
      const double swing =
          std::sin(2 * kPi * k / (kClips[c].frames - (c < 3 ? 0 : 18))) / (c == 0 ? 3 : 1);
      for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
          const double u = (x - 15.5) / kClips[c].reach, v = (y - 15.5 - 3 * swing) / (5 + c);
          if (u * u + v * v > 1) continue;
          std::uint8_t* p = image.rgba.data() + 4 * (32 * y + x);
          p[0] = static_cast<std::uint8_t>(90 + 30 * c), p[1] = 120, p[2] = 60, p[3] = 255;
        }
      }
      images.push_back(std::move(image));
    }
  }
  return make_feature_set(rows, 30, 32, [&](int i) { return images[static_cast<std::size_t>(i)]; });
}

// Steps from each sample of `tag` to every tag, through the table alone.
TEST(Casts, LoseNoSampleAndReachEveryTagFromEveryTag) {
  const FeatureSet set = make_cast();
  const Classifier strict{{0.02, 0.3, 0.004, 0.02, 0.02, 0.004}, 1};
  const auto pairs = accepted_pairs(set, strict, 1);
  for (const int limit : {1, 100}) {
    TransitionStats stats;
    const auto costs = make_cost_table(set, pairs, {limit, 15}, stats, &strict);
    ASSERT_TRUE(costs) << costs.error().message;
    EXPECT_EQ(stats.kept, static_cast<int>(set.rows.size()));
    const Components parts = find_components(*costs);
    EXPECT_EQ(parts.count, 1u);
    std::map<std::pair<std::string, std::string>, float> joined;
    for (const TagJoin& join : stats.joins) {
      EXPECT_EQ(cost_of(*costs, join.from, join.to), join.cost);
      joined[{join.from_tag, join.to_tag}] = join.cost;
    }
    EXPECT_GT((joined[{"jump", "idle"}]), 1);
    EXPECT_GE(joined.size(), 12u);  // nothing else leads from tag to tag here
  }
}

TEST(Casts, ATaggedLoopOfTenFramesCloses) {
  const FeatureSet set = make_cast();
  const Classifier strict{{0.02, 0.3, 0.004, 0.02, 0.02, 0.004}, 1};
  TransitionStats stats;
  const auto costs = make_cost_table(set, accepted_pairs(set, strict, 1), {}, stats, &strict);
  ASSERT_TRUE(costs);
  float cheapest = 1e9f;
  for (std::uint32_t i = 5; i < 10; ++i) {
    for (std::uint32_t j = 0; j + 5 <= i; ++j) {
      const float cost = cost_of(*costs, i, j);
      if (cost >= 0) cheapest = std::min(cheapest, cost);
    }
  }
  EXPECT_LE(cheapest, 1);  // back to the start, over nine samples at most
}

TEST(Casts, AJoinIsTheCheapestThereIs) {
  const FeatureSet set = make_cast();
  const Classifier strict{{0.02, 0.3, 0.004, 0.02, 0.02, 0.004}, 1};
  TransitionStats stats;
  ASSERT_TRUE(make_cost_table(set, accepted_pairs(set, strict, 1), {}, stats, &strict));
  const auto d = [&](int i, int j) { return strict.distance(features(set, i, j)); };
  float best = 1e9f, kept = 1e9f;  // idle is 0..9, jump 64..99
  for (int i = 64; i < 100; ++i) {
    for (int j = 0; j < 10; ++j) {
      const float both = i < 99 && j > 0 ? (d(i, j - 1) + d(i + 1, j)) / 2
                         : i < 99        ? d(i + 1, j)
                         : j > 0         ? d(i, j - 1)
                                         : d(i, j);
      best = std::min(best, both);
    }
  }
  for (const TagJoin& join : stats.joins) {
    if (join.from_tag == "jump" && join.to_tag == "idle") kept = std::min(kept, join.cost);
  }
  EXPECT_EQ(kept, best);
}

// However low a mode's cap: every sample stays in reach of every other, with tags and without.
TEST(Casts, NoCapCutsTheWaysThatAreNeeded) {
  const FeatureSet set = make_cast();
  const Classifier strict{{0.02, 0.3, 0.004, 0.02, 0.02, 0.004}, 1};
  TransitionStats stats;
  auto costs = make_cost_table(set, accepted_pairs(set, strict, 1), {}, stats, &strict);
  ASSERT_TRUE(costs);
  std::vector<std::string> tags;
  for (const SampleRow& row : set.rows) tags.push_back(row.tag);
  const auto parts_under_cap = [&] {
    const Edges edges = make_edges(*costs, {}, {.cap = 0.001});
    CostTable graph{edges.row_start, {}, costs->kept, {}};
    for (const std::uint32_t to : edges.to) graph.transitions.push_back({to, 0});
    return find_components(graph).count;
  };
  EXPECT_GT(parts_under_cap(), 1u);
  costs->needed = needed_transitions(*costs, tags);
  EXPECT_EQ(parts_under_cap(), 1u);
  costs->needed = needed_transitions(*costs, std::vector<std::string>(tags.size()));
  EXPECT_EQ(parts_under_cap(), 1u);
}

}  // namespace
}  // namespace vsprite
