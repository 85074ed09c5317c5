// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "control/joint.h"
#include "control/response.h"
#include "support/random_film.h"
#include "vsprite/actor.h"

namespace vsprite {
namespace {

constexpr int kFilmed = 64, kClip = 32, kGait = 16;

// A walk to the right, filmed twice, and its mirror images; nobody ever turned.
FeatureSet make_walk() {
  std::vector<SampleRow> rows;
  for (int i = 0; i < 2 * kFilmed; ++i) {
    const bool mirrored = i >= kFilmed;
    SampleRow r;
    r.sample = i;
    r.frame = i % kFilmed;
    r.clip = i / kClip;
    r.width = r.height = 24;
    r.anchor_x = r.anchor_y = 12;
    r.velocity_x = mirrored ? -60 : 60;
    r.area = 100;
    r.mirror_of = mirrored ? i - kFilmed : -1;
    rows.push_back(r);
  }
  return make_feature_set(rows, 30, 16, [](int) {
    Image image{24, 24, std::vector<std::uint8_t>(4 * 24 * 24, 255)};
    return image;
  });
}

// Like phases of the gait look alike, on one side.
std::vector<PairDistance> pairs_of_walk() {
  std::vector<PairDistance> pairs;
  for (std::uint32_t i = 0; i < 2 * kFilmed; ++i) {
    for (std::uint32_t j = i + kGait; j < 2 * kFilmed; j += kGait) {
      if (i / kFilmed == j / kFilmed) pairs.push_back({i, j, 0.3f});
    }
  }
  return pairs;
}

TEST(Flip, AWalkThatNeverTurnedKeepsOneSideOnly) {
  const FeatureSet set = make_walk();
  TransitionStats stats;
  const auto costs = make_cost_table(set, pairs_of_walk(), {}, stats);
  ASSERT_TRUE(costs) << costs.error().message;
  EXPECT_FALSE(turns_by_itself(set.rows, costs->kept));
}

TEST(Flip, JoinsEverySampleToTheMirrorImageOfTheNextAtThePrice) {
  const FeatureSet set = make_walk();
  auto pairs = pairs_of_walk();
  pairs.push_back({kFilmed - 1, 2 * kFilmed - 1, 0.9f});  // one there is already
  std::sort(pairs.begin(), pairs.end(),
            [](auto& a, auto& b) { return std::tie(a.i, a.j) < std::tie(b.i, b.j); });
  const std::size_t before = pairs.size();
  add_flips(set.rows, 0.4f, pairs);
  EXPECT_EQ(pairs.size(), before + kFilmed - 1);
  TransitionStats stats;
  const auto costs = make_cost_table(set, pairs, {}, stats);
  ASSERT_TRUE(costs) << costs.error().message;
  EXPECT_TRUE(turns_by_itself(set.rows, costs->kept));
  for (std::uint32_t i = 1; i + 2 < kClip; ++i) {
    bool found = false;
    for (std::uint32_t e = costs->row_start[i]; e < costs->row_start[i + 1]; ++e) {
      if (costs->transitions[e].to != kFilmed + i + 1) continue;
      found = true;
      EXPECT_FLOAT_EQ(costs->transitions[e].cost, 0.4f);
    }
    EXPECT_TRUE(found) << i;
  }
}

TEST(Flip, TheMirroredWalkerTurnsRoundWithinTwoFrames) {
  const FeatureSet set = make_walk();
  auto pairs = pairs_of_walk();
  add_flips(set.rows, 0.4f, pairs);
  TransitionStats stats;
  const auto costs = make_cost_table(set, pairs, {}, stats);
  ASSERT_TRUE(costs);
  testing::RandomFilm film(1, 1);  // only to make a sprite of
  film.costs = *costs;
  film.velocities.clear();
  for (const SampleRow& r : set.rows)
    film.velocities.push_back({static_cast<float>(r.velocity_x), static_cast<float>(r.velocity_y)});
  film.skip_costs.assign(set.rows.size(), std::numeric_limits<float>::infinity());
  auto solution = solve_joint(*costs, {film.velocities, film.skip_costs, set.v0}, {}, 0x11);
  ASSERT_TRUE(solution) << solution.error().message;
  SpriteData data = film.data(solution->mode);
  while (data.samples[data.start_sample].kept == 0) ++data.start_sample;
  const auto sprite = make_sprite(std::move(data));
  ASSERT_TRUE(sprite) << sprite.error().message;
  Actor actor = make_actor(*sprite);
  for (int turn = 0; turn < 40; ++turn) {
    const auto wanted = turn % 2 == 0 ? Direction::Left : Direction::Right;
    set_direction(*sprite, actor, wanted);
    step(*sprite, actor);
    step(*sprite, actor);
    const float along = sprite->samples()[actor.sample].velocity.x;
    EXPECT_EQ(along < 0, wanted == Direction::Left) << "turn " << turn;
    for (int t = 0; t < 7 + turn; ++t) step(*sprite, actor);
    EXPECT_EQ(sprite->samples()[actor.sample].velocity.x, along) << "it stays";
  }
}

}  // namespace
}  // namespace vsprite
