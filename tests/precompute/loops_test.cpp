// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/loops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "support/temp_folder.h"
#include "support/tiny_sprite.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

std::vector<std::uint8_t> range(std::uint32_t first, std::uint32_t count) {
  std::vector<std::uint8_t> allowed(testing::kTinySamples, 0);
  std::fill_n(allowed.begin() + first, count, std::uint8_t{1});
  return allowed;
}

/// Sum of T around the loop; infinity where a step is no transition or leaves what is allowed.
double walk_cost(const Sprite& sprite, const SeamlessLoop& loop,
                 const std::vector<std::uint8_t>& allowed, int& ticks) {
  double cost = 0;
  ticks = 0;
  for (std::size_t k = 0; k < loop.samples.size(); ++k) {
    const std::uint32_t from = loop.samples[k], to = loop.samples[(k + 1) % loop.samples.size()];
    if (allowed[from] == 0) return std::numeric_limits<double>::infinity();
    cost += double{sprite.transition_cost(from, to)};
    ticks += sprite.samples()[from].duration;
  }
  return cost;
}

/// The same without leaving anything out: every start, every sample, every tick.
double plain_least_cost(const Sprite& sprite, const std::vector<std::uint8_t>& allowed,
                        LoopLength length) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const std::size_t n = allowed.size();
  double least = kNever;
  for (std::size_t start = 0; start < n; ++start) {
    if (allowed[start] == 0) continue;
    std::vector<std::vector<double>> cost(static_cast<std::size_t>(length.most) + 1,
                                          std::vector<double>(n, kNever));
    cost[0][start] = 0;
    for (std::size_t t = 0; t < cost.size(); ++t) {
      if (t >= static_cast<std::size_t>(length.least)) least = std::min(least, cost[t][start]);
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::size_t then = t + sprite.samples()[i].duration;
        if (cost[t][i] == kNever || then >= cost.size()) continue;
        for (const Transition& way : sprite.transitions(i))
          if (allowed[way.to] != 0)
            cost[then][way.to] = std::min(cost[then][way.to], cost[t][i] + double{way.cost});
      }
    }
  }
  return least;
}

// A heading's clip of 12 samples, the third of them shown for two ticks, closes at 0.1.
TEST(Loops, AClipThatClosesIsItsOwnLoopBegunBehindTheSeam) {
  const Sprite sprite = testing::tiny_sprite();
  const auto loop =
      find_loop(sprite, range(testing::tiny_sample(3, 0), testing::kTinyClip), {13, 13});
  ASSERT_TRUE(loop);
  EXPECT_EQ(loop->samples.size(), testing::kTinyClip);
  EXPECT_EQ(loop->samples.front(), testing::tiny_sample(3, 0));
  EXPECT_EQ(loop->ticks, 13);
  EXPECT_EQ(loop->jumps, 1);
  EXPECT_NEAR(loop->cost, 0.1, 1e-6);
}

TEST(Loops, NoneIsNone) {
  const Sprite sprite = testing::tiny_sprite();
  EXPECT_FALSE(find_loop(sprite, range(testing::tiny_sample(3, 0), testing::kTinyClip), {2, 12}));
  EXPECT_FALSE(find_loop(sprite, range(1, 0), {1, 40}));
}

TEST(Loops, AreAsCheapAsAnyOfTheirLength) {
  const Sprite sprite = testing::tiny_sprite();
  const std::vector<std::uint8_t> some[] = {
      range(1, 3 * testing::kTinyClip), range(1, testing::kTinySamples - 1),
      range(1 + 4 * testing::kTinyClip, testing::kTinySamples - 1 - 4 * testing::kTinyClip)};
  int found = 0;
  for (const auto& allowed : some) {
    for (const LoopLength length : {LoopLength{5, 5}, LoopLength{6, 9}, LoopLength{13, 13},
                                    LoopLength{17, 19}, LoopLength{26, 26}}) {
      const double due = plain_least_cost(sprite, allowed, length);
      const auto loop = find_loop(sprite, allowed, length);
      ASSERT_EQ(loop.has_value(), due < 1e9) << length.least;
      if (!loop) continue;
      ++found;
      int ticks = 0;
      EXPECT_NEAR(walk_cost(sprite, *loop, allowed, ticks), due, 1e-6) << length.least;
      EXPECT_NEAR(loop->cost, due, 1e-6);
      EXPECT_EQ(ticks, loop->ticks);
      EXPECT_GE(ticks, length.least);
      EXPECT_LE(ticks, length.most);
    }
  }
  EXPECT_GE(found, 8);
}

TEST(Loops, TowardsADirectionAreTheSamplesThatGoThere) {
  const Sprite sprite = testing::tiny_sprite();
  EXPECT_EQ(samples_towards(sprite, Direction::Left),
            range(testing::tiny_sample(4, 0), testing::kTinyClip));
  EXPECT_EQ(samples_towards(sprite, Direction::Rest),
            range(testing::kTinyFirstIdle, testing::kTinyIdle));
}

// Opaque greys that grow by 8 a sample: 6 of 4 channels' mean a step, 66 back over the jump.
TEST(Loops, TheSeamIsTheJumpOverTheLoopsOwnMotion) {
  const testing::TempFolder room;
  SpriteData data = testing::tiny_sprite_data();
  for (Sample& s : data.samples)
    if (s.kept == 1) s.width = s.height = 20, s.anchor = {10, 10};
  const auto picture = [](std::uint32_t i) -> Result<Image> {
    Image image{20, 20, std::vector<std::uint8_t>(1600, 255)};
    for (std::size_t k = 0; k < 1600; ++k)
      if (k % 4 != 3) image.rgba[k] = static_cast<std::uint8_t>(8 * ((i - 1) % testing::kTinyClip));
    return image;
  };
  ASSERT_TRUE(save_pack(room.file("grey.vsp"), data, picture));
  const auto sprite = load_pack(room.file("grey.vsp"));
  ASSERT_TRUE(sprite);
  const auto loop = find_loop(*sprite, range(1, testing::kTinyClip), {13, 13});
  ASSERT_TRUE(loop);
  const auto seam = measure_seam(*sprite, *loop);
  ASSERT_TRUE(seam);
  EXPECT_NEAR(*seam, (66 + 0.5) / (6 + 0.5), 1e-9);
}

}  // namespace
}  // namespace vsprite
