// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/show.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "support/temp_folder.h"
#include "support/tiny_sprite.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

using testing::tiny_sample;

class Fading : public ::testing::Test {
 protected:
  /// The actor shows `sample` now.
  void show(std::uint32_t sample, int ticks = kFadeAuto) {
    actor_.sample = sample;
    follow(sprite_, actor_, fade_, ticks);
  }
  const Sprite sprite_ = testing::tiny_sprite();
  Actor actor_;
  ActorFade fade_;
};

TEST_F(Fading, LeavesWhatLooksRightAloneAndGrowsWithTheCost) {
  EXPECT_EQ(fade_length(0), 0);
  EXPECT_EQ(fade_length(1), 0);
  EXPECT_EQ(fade_length(1.01f), 2);
  EXPECT_EQ(fade_length(2), 4);
  EXPECT_EQ(fade_length(3), 6);
  EXPECT_EQ(fade_length(std::numeric_limits<float>::infinity()), 6);
  EXPECT_EQ(fade_length(std::numeric_limits<float>::quiet_NaN()), 6);
}

TEST_F(Fading, NeverTouchesTheFilmsOwnOrder) {
  for (std::uint32_t phase = 0; phase < 8; ++phase) {
    show(tiny_sample(0, phase));
    EXPECT_EQ(fade_share(fade_), 0) << phase;
  }
  show(tiny_sample(0, 9));  // played through
  EXPECT_EQ(fade_share(fade_), 0);
  show(tiny_sample(0, 9));  // held
  EXPECT_EQ(fade_share(fade_), 0);
}

TEST_F(Fading, GivesWayEvenlyOverAJumpWhileTheOldRunPlaysOn) {
  show(tiny_sample(0, 4));
  for (std::uint32_t k = 0; k < 4; ++k) {
    show(tiny_sample(1, 5 + k), 4);
    EXPECT_EQ(fade_.before, tiny_sample(0, 5 + k));
    for (float fraction : {0.0f, 0.5f})
      EXPECT_FLOAT_EQ(fade_share(fade_, fraction), 1 - (static_cast<float>(k) + fraction + 1) / 5);
  }
  EXPECT_NEAR(fade_share(fade_, 0.9999f), 0, 1e-4f);  // no step at the end
  show(tiny_sample(1, 9), 4);
  EXPECT_EQ(fade_share(fade_), 0);
}

TEST_F(Fading, TheOldRunKeepsItsDurationsAndStandsAtItsEnd) {
  show(tiny_sample(0, 1));
  show(tiny_sample(1, 2), 6);
  EXPECT_EQ(fade_.before, tiny_sample(0, 2));  // of two ticks
  show(tiny_sample(1, 2), 6);
  EXPECT_EQ(fade_.before, tiny_sample(0, 2));
  show(tiny_sample(1, 3), 6);
  EXPECT_EQ(fade_.before, tiny_sample(0, 3));
  fade_ = {};
  show(tiny_sample(0, 11));
  show(tiny_sample(1, 0), 6);
  show(tiny_sample(1, 1), 6);
  EXPECT_EQ(fade_.before, tiny_sample(0, 11));
}

TEST_F(Fading, TakesTheLengthFromTheCost) {
  show(tiny_sample(0, 4));
  show(tiny_sample(1, 5));  // T = 0.3
  EXPECT_EQ(fade_share(fade_), 0);
  show(tiny_sample(5, 5));  // no transition: a cut
  EXPECT_EQ(fade_.length, 6);
}

TEST_F(Fading, AJumpInAFadeGoesOnFromTheStrongerPicture) {
  show(tiny_sample(0, 4));
  show(tiny_sample(1, 5), 6);
  show(tiny_sample(2, 6), 6);  // 5/7 of the old one are left
  EXPECT_EQ(fade_.before, tiny_sample(0, 6));
  EXPECT_FLOAT_EQ(fade_share(fade_), 5.0f / 7);  // no step back
  for (std::uint32_t k = 7; k < 11; ++k) show(tiny_sample(2, k), 6);
  show(tiny_sample(1, 11), 6);  // little is left
  EXPECT_EQ(fade_.before, tiny_sample(2, 11));
}

TEST_F(Fading, CanBeOffAndTakesAnyNumber) {
  show(tiny_sample(0, 4));
  show(tiny_sample(1, 5), kFadeOff);
  EXPECT_EQ(fade_share(fade_), 0);
  for (const auto& [asked, due] : {std::pair{1, 2}, std::pair{3, 3}, std::pair{99, 6}}) {
    fade_ = {};
    show(tiny_sample(0, 4));
    show(tiny_sample(1, 5), asked);
    EXPECT_EQ(fade_.length, due);
  }
}

TEST(Show, ReadsTheLengthOfAFadeAsItIsTyped) {
  EXPECT_EQ(parse_fade("auto"), kFadeAuto);
  EXPECT_EQ(parse_fade("off"), kFadeOff);
  EXPECT_EQ(parse_fade("2"), 2);
  EXPECT_EQ(parse_fade("6"), 6);
  for (const char* bad : {"", "0", "1", "7", "22", "-2", "Auto"})
    EXPECT_FALSE(parse_fade(bad)) << bad;
}

// The whole of what an engine with a renderer of its own needs.
TEST(Show, GivesThePictureAndWhereItsCornerGoes) {
  const testing::TempFolder folder;
  const SpriteData data = testing::tiny_sprite_data();
  const auto picture = [&](std::uint32_t i) -> Result<Image> {
    return testing::tiny_picture(data, i);
  };
  const std::string path = folder.file("tiny.vsp");
  ASSERT_TRUE(save_pack(path, data, picture));
  const Result<Sprite> sprite = load_pack(path);
  ASSERT_TRUE(sprite);
  FrameCache frames(*sprite);
  Actor actor = make_actor(*sprite, {100, 50});
  for (int tick = 0; tick < 5; ++tick) step(*sprite, actor);
  const ActorPicture shown = actor_picture(*sprite, frames, actor, 0.5f);
  const Sample& sample = sprite->samples()[actor.sample];
  const Vec2 at = draw_position(*sprite, actor, 0.5f);
  EXPECT_EQ(shown.sample, actor.sample);
  EXPECT_FLOAT_EQ(shown.top_left.x, at.x - sample.anchor.x);
  EXPECT_FLOAT_EQ(shown.top_left.y, at.y - sample.anchor.y);
  Image due;
  ASSERT_TRUE(sprite->decode_frame(actor.sample, due));
  ASSERT_EQ(shown.pixels.width, due.width);
  ASSERT_EQ(shown.pixels.height, due.height);
  for (int y = 0; y < due.height; ++y)
    EXPECT_EQ(std::memcmp(shown.pixels.pixel(0, y), ImageView(due).pixel(0, y),
                          static_cast<std::size_t>(4 * due.width)),
              0);
}

}  // namespace
}  // namespace vsprite
