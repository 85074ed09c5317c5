// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/sprite.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "support/tiny_sprite.h"

namespace vsprite {
namespace {

using testing::tiny_sample;

TEST(Sprite, LooksUpTheCostOfEveryTransition) {
  const Sprite sprite = testing::tiny_sprite();
  std::size_t found = 0;
  for (std::uint32_t i = 0; i < testing::kTinySamples; ++i) {
    for (const Transition& t : sprite.transitions(i)) {
      EXPECT_EQ(sprite.transition_cost(i, t.to), t.cost);
      ++found;
    }
  }
  EXPECT_EQ(found, sprite.data().transitions.size());
  EXPECT_EQ(sprite.transition_cost(tiny_sample(0, 0), tiny_sample(4, 1)),
            std::numeric_limits<float>::infinity());
}

TEST(Sprite, TheFilmsOwnContinuationCostsNothing) {
  SpriteData data = testing::tiny_sprite_data();
  data.transitions.clear();  // not even when nothing says so
  data.row_start.assign(data.samples.size() + 1, 0);
  for (std::size_t i = 0; i < data.samples.size(); ++i) data.samples[i].clip = 1;
  data.samples[1].kept = 1;
  data.samples.resize(2);
  data.samples[0] = data.samples[1];
  for (Sample& s : data.samples) s.skip_cost = HUGE_VALF;
  data.row_start = {0, 0, 1};
  data.transitions = {{0, 0.25f}};
  for (ControlMode& mode : data.modes) {
    mode.next.clear();
    for (std::size_t t = 0; t < mode.tables(); ++t) mode.next.insert(mode.next.end(), {1, 0});
    mode.go.assign(mode.next.size(), 1);
    mode.arrived.resize(mode.by_state ? 2 : 0);
  }
  const auto sprite = make_sprite(data);
  ASSERT_TRUE(sprite) << sprite.error().message;
  EXPECT_TRUE(sprite->is_natural(0, 1));
  EXPECT_EQ(sprite->transition_cost(0, 1), 0);
  EXPECT_EQ(sprite->transition_cost(1, 0), 0.25f);
}

TEST(Sprite, FindsModesByName) {
  const Sprite sprite = testing::tiny_sprite();
  EXPECT_EQ(sprite.find_mode("paper"), 0);
  EXPECT_EQ(sprite.find_mode("responsive"), 1);
  EXPECT_EQ(sprite.find_mode("Paper"), -1);
  EXPECT_EQ(sprite.fps(), 30);
}

TEST(Sprite, WithoutPicturesDecodesToNothing) {
  Image image{1, 1, {1, 2, 3, 4}};
  ASSERT_TRUE(testing::tiny_sprite().decode_frame(3, image));
  EXPECT_EQ(image.width, 0);
  EXPECT_TRUE(image.rgba.empty());
}

TEST(Sprite, StepsAreVelocityOverRateRoundedToNearest) {
  EXPECT_EQ(step_per_tick(60, 30, 1), 2 * kFixedOne);
  EXPECT_EQ(step_per_tick(-60, 30, 1), -2 * kFixedOne);
  EXPECT_EQ(step_per_tick(1, 30000, 1001), 2187);  // 2186.72
  EXPECT_EQ(step_per_tick(0, 30, 1), 0);
  EXPECT_EQ(step_per_tick(1e30f, 30, 1), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(step_per_tick(-1e30f, 30, 1), -std::numeric_limits<std::int32_t>::max());
}

// Data that contradict themselves are refused with a sentence that names the place.
struct BadData {
  const char* due;  // part of the message
  std::function<void(SpriteData&)> damage;
};

TEST(Sprite, RefusesDataThatWouldFaultInPlay) {
  const float nan = std::nanf("");
  const BadData cases[] = {
      {"0 samples", [](SpriteData& d) { d.samples.clear(); }},
      {"rate of 30/0", [](SpriteData& d) { d.fps_denominator = 0; }},
      {"start sample 0 is not", [](SpriteData& d) { d.start_sample = 0; }},
      {"start sample 4000", [](SpriteData& d) { d.start_sample = 4000; }},
      {"sample 5: holds a number", [=](SpriteData& d) { d.samples[5].anchor.y = nan; }},
      {"sample 6: duration 0", [](SpriteData& d) { d.samples[6].duration = 0; }},
      {"sample 7: tag 2 of 2", [](SpriteData& d) { d.samples[7].tag = 2; }},
      {"the row starts", [](SpriteData& d) { d.row_start[3] += 100000; }},
      {"the row starts", [](SpriteData& d) { d.row_start.pop_back(); }},
      {"to sample 103 of 103", [](SpriteData& d) { d.transitions[0].to = 103; }},
      {"finite number >= 0", [=](SpriteData& d) { d.transitions[9].cost = -1; }},
      {"sample that was not kept", [](SpriteData& d) { d.transitions[0].to = 0; }},
      {"0 modes", [](SpriteData& d) { d.modes.clear(); }},
      {"mode 1: alpha", [](SpriteData& d) { d.modes[1].alpha = 1; }},
      {"mode 0: alpha", [=](SpriteData& d) { d.modes[0].alpha = nan; }},
      {"mode 1: 0 stages", [](SpriteData& d) { d.modes[1].stages = 0; }},
      {"mode 0: 4120 entries", [](SpriteData& d) { d.modes[0].stages = 2; }},
      {"mode 0: table 0, sample 0: was not kept", [](SpriteData& d) { d.modes[0].next[0] = 1; }},
      {"mode 0: table 0, sample 1: next is sample 103",
       [](SpriteData& d) { d.modes[0].next[1] = 103; }},
      {"sample 0, which was not kept", [](SpriteData& d) { d.modes[0].next[1] = 0; }},
      {"there is no such transition", [](SpriteData& d) { d.modes[0].next[1] = 60; }},
      {"mode 1: has the name of mode 0", [](SpriteData& d) { d.modes[1].name = "paper"; }},
      {"control character", [](SpriteData& d) { d.tags[0] = "a\nb"; }},
  };
  for (const BadData& bad : cases) {
    SpriteData data = testing::tiny_sprite_data();
    bad.damage(data);
    const auto sprite = make_sprite(std::move(data));
    ASSERT_FALSE(sprite) << bad.due;
    EXPECT_EQ(sprite.error().code, ErrorCode::CorruptData);
    EXPECT_NE(sprite.error().message.find(bad.due), std::string::npos) << sprite.error().message;
  }
}

}  // namespace
}  // namespace vsprite
