// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/stream.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "pack_format.h"
#include "support/temp_folder.h"
#include "support/tiny_sprite.h"

namespace vsprite {
namespace {

class FrameCacheTest : public ::testing::Test {
 protected:
  FrameCacheTest() {
    const testing::TempFolder folder;
    const SpriteData data = testing::tiny_sprite_data();
    const auto saved = save_pack(folder.file("tiny.vsp"), data, [&](std::uint32_t sample) {
      return Result<Image>(testing::tiny_picture(data, sample));
    });
    EXPECT_TRUE(saved);
    bytes_ = testing::read_bytes(folder.file("tiny.vsp"));
  }
  Sprite load() const {
    return *detail::load_pack_from(detail::ByteSource::borrow(bytes_, "tiny"));
  }

  std::vector<std::uint8_t> bytes_;
};

std::vector<std::uint8_t> copy(ImageView view) {
  return {view.rgba, view.rgba + 4 * view.width * view.height};
}

TEST_F(FrameCacheTest, ServesThePremultipliedPictureAndDecodesItOnce) {
  const Sprite sprite = load();
  FrameCache cache(sprite);
  Image due = testing::tiny_picture(sprite.data(), 7);
  premultiply(due);
  EXPECT_EQ(copy(cache.frame(7)), due.rgba);
  EXPECT_EQ(copy(cache.frame(7)), due.rgba);
  EXPECT_EQ(cache.stats().misses, 1u);
  EXPECT_EQ(cache.stats().hits, 1u);
}

TEST_F(FrameCacheTest, HandsOutTheBlocksOfAPackForTheGpuAndItsPictures) {
  const testing::TempFolder folder;
  const SpriteData data = testing::tiny_sprite_data();
  const auto picture = [&](std::uint32_t sample) -> Result<Image> {
    return testing::tiny_picture(data, sample);
  };
  ASSERT_TRUE(save_pack(folder.file("a.vsp"), data, picture, {}, PictureForm::Blocks));
  const Sprite sprite = *load_pack(folder.file("a.vsp"));
  FrameCache cache(sprite);
  Image due = testing::tiny_picture(data, 7);
  premultiply(due);
  const auto blocks = detail::encode_blocks(due);
  const BlockView first = cache.blocks(7), second = cache.blocks(8);
  ASSERT_NE(second.bytes, nullptr);
  ASSERT_EQ(first.width, due.width);
  ASSERT_EQ(static_cast<std::size_t>(16 * first.columns() * first.rows()), blocks.size());
  EXPECT_TRUE(std::equal(blocks.begin(), blocks.end(), first.bytes));  // still valid
  detail::decode_blocks(blocks, due.width, due.height, due);
  EXPECT_EQ(copy(cache.frame(7)), due.rgba);
  EXPECT_EQ(cache.stats().misses, 2u);
  EXPECT_EQ(cache.stats().hits, 1u);
  const Sprite exact = load();
  EXPECT_EQ(FrameCache(exact).blocks(7).bytes, nullptr);
}

TEST_F(FrameCacheTest, DropsTheLeastRecentlyUsedAndKeepsToItsBudget) {
  const Sprite sprite = load();
  const std::size_t budget = 10'000;  // five pictures
  FrameCache cache(sprite, budget);
  for (std::uint32_t sample = 1; sample < 60; ++sample) {
    cache.frame(sample);
    cache.frame(1);  // always wanted, never dropped
    ASSERT_LE(cache.stats().bytes, budget);
  }
  EXPECT_EQ(cache.stats().misses, 59u);
}

TEST_F(FrameCacheTest, HoldsTheTwoNewestWhateverTheBudget) {
  const Sprite sprite = load();
  FrameCache cache(sprite, 0);
  const ImageView first = cache.frame(1);
  const auto pixels = copy(first);
  cache.frame(2);
  EXPECT_EQ(copy(first), pixels);
}

TEST_F(FrameCacheTest, ADamagedPictureIsReplacedByTheLastGoodOneAndCounted) {
  bytes_[bytes_.size() - 1] ^= 1;  // in the last picture
  const std::uint32_t last = testing::kTinySamples - 1;
  const Sprite sprite = load();
  for (std::size_t budget : {std::size_t{0}, std::size_t{1} << 20}) {
    FrameCache cache(sprite, budget);
    EXPECT_EQ(cache.frame(last).width, 0) << "no good one yet";
    const auto good = copy(cache.frame(5));
    EXPECT_EQ(copy(cache.frame(last)), good);
    EXPECT_EQ(copy(cache.frame(last)), good);
    EXPECT_EQ(cache.stats().damaged, 3u);
  }
}

// The next sample, however long this one is shown.
void step_on(const Sprite& sprite, Actor& actor) {
  const std::uint32_t before = actor.sample;
  for (int tick = 0; tick < 32 && actor.sample == before; ++tick) step(sprite, actor);
}

TEST_F(FrameCacheTest, WhatAnActorWillShowIsThereBeforeItIsAskedFor) {
  const Sprite sprite = load();
  FrameCache cache(sprite);
  Actor actor = make_actor(sprite);
  set_direction(sprite, actor, Direction::Right);
  std::uint64_t before = ~std::uint64_t{0};
  for (int i = 0; i < 200 && cache.stats().ahead != before; ++i) {  // until nothing new comes
    before = cache.stats().ahead > 0 ? cache.stats().ahead : before;
    cache.look_ahead(actor);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    cache.look_ahead(actor);
  }
  if (cache.stats().ahead == 0) GTEST_SKIP() << "built without threads";
  Actor turned = actor;
  set_direction(sprite, turned, Direction::Down);  // no command before said so
  for (Actor* a : {&actor, &turned}) {
    step_on(sprite, *a);
    Image due = testing::tiny_picture(sprite.data(), a->sample);
    premultiply(due);
    EXPECT_EQ(copy(cache.frame(a->sample)), due.rgba);
  }
  EXPECT_EQ(cache.stats().misses, 0u);
}

TEST_F(FrameCacheTest, LooksAheadWithinItsBudgetAndEndsInTheMiddleOfIt) {
  const Sprite sprite = load();
  const std::size_t budget = 10'000;  // five pictures
  for (int round = 0; round < 50; ++round) {
    FrameCache cache(sprite, budget);
    Actor actor = make_actor(sprite);
    for (int tick = 0; tick < 40; ++tick) {
      set_direction(sprite, actor, static_cast<Direction>((tick / 5 + round) % 8));
      step(sprite, actor);
      cache.look_ahead(actor);
      Image due = testing::tiny_picture(sprite.data(), actor.sample);
      premultiply(due);
      const ImageView view = cache.frame(actor.sample);
      cache.look_ahead(actor);
      ASSERT_EQ(copy(view), due.rgba);  // still there
      ASSERT_LE(cache.stats().bytes, budget);
    }
  }
}

}  // namespace
}  // namespace vsprite
