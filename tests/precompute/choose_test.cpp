// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/choose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "control/response.h"
#include "support/tiny_sprite.h"

namespace vsprite {
namespace {

// Every mode with settings that it can be solved with again.
SpriteData tiny_sprite_data() {
  SpriteData data = testing::tiny_sprite_data();
  for (ControlMode& mode : data.modes) mode.exit_angle = 0.4f;
  return data;
}

ChoiceConfig at_most(double limit) {
  ChoiceConfig config;
  config.limit = limit;
  config.ticks = 6000;
  config.jobs = 1;
  return config;
}

TEST(Choose, EveryDirectionAndTagIsStillThereInThreeFifthsOfTheSamples) {
  const SpriteData full = tiny_sprite_data();
  const auto choice = choose_samples(full, at_most(60));
  ASSERT_TRUE(choice) << choice.error().message;
  EXPECT_LE(choice->data.samples.size(), 60u);
  const auto sprite = make_sprite(choice->data);
  ASSERT_TRUE(sprite) << sprite.error().message;
  EXPECT_EQ(choice->data.modes[0].served & 0xFFu, 0xFFu);
  for (const DirectionReport& report : measure_directions(*sprite, 0, 7))
    EXPECT_TRUE(report.reachable) << direction_name(report.direction);
  std::set<int> tags;
  for (const Sample& s : choice->data.samples) tags.insert(s.tag);
  EXPECT_EQ(tags, (std::set<int>{0, 1}));
}

// Whole runs go, so a limit may lie just below what is left and far above what comes next.
TEST(Choose, EveryLimitAboveOneThatIsMetIsMetToo) {
  const SpriteData full = tiny_sprite_data();
  ChoiceConfig config = at_most(0);
  config.ticks = 3000;
  config.weights.assign(full.samples.size(), 10);
  config.transition_weight = 4;
  const double all = 10.0 * static_cast<double>(full.samples.size()) +
                     4.0 * static_cast<double>(full.transitions.size());
  for (int percent = 98; percent > 60; percent -= 2) {
    config.limit = 0.01 * percent * all;
    const auto choice = choose_samples(full, config);
    ASSERT_TRUE(choice) << percent << ": " << choice.error().message;
  }
}

TEST(Choose, TheSameChoiceEveryTime) {
  const SpriteData full = tiny_sprite_data();
  const auto a = choose_samples(full, at_most(60)), b = choose_samples(full, at_most(60));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->from, b->from);
  EXPECT_EQ(a->data.modes[0].next, b->data.modes[0].next);
}

TEST(Choose, AGapEndsAClip) {
  const SpriteData full = tiny_sprite_data();
  std::vector<std::uint8_t> chosen(full.samples.size(), 1);
  chosen[0] = chosen[5] = 0;
  const SampleChoice choice = take_samples(full, chosen);
  ASSERT_EQ(choice.from[3], 4u);
  ASSERT_EQ(choice.from[4], 6u);
  EXPECT_EQ(choice.data.samples[2].clip, choice.data.samples[3].clip);
  EXPECT_NE(choice.data.samples[3].clip, choice.data.samples[4].clip);
  EXPECT_FALSE(std::isfinite(choice.data.samples[2].skip_cost));
}

TEST(Choose, WeightsCountAndAnEventIsKept) {
  SpriteData full = tiny_sprite_data();
  const std::uint32_t rare = testing::tiny_sample(3, 7);
  full.event_names = {"blink"};
  full.events = {{rare, 0}};
  ChoiceConfig config = at_most(600);
  config.weights.assign(full.samples.size(), 10);
  const auto choice = choose_samples(full, config);
  ASSERT_TRUE(choice) << choice.error().message;
  EXPECT_LE(choice->data.samples.size(), 60u);
  ASSERT_EQ(choice->data.events.size(), 1u);
  EXPECT_EQ(choice->from[choice->data.events[0].sample], rare);
}

TEST(Choose, TransitionsWeighToo) {
  const SpriteData full = tiny_sprite_data();
  ChoiceConfig config = at_most(0);
  config.weights.assign(full.samples.size(), 10);
  config.transition_weight = 2;
  const double all = 10.0 * static_cast<double>(full.samples.size()) +
                     2.0 * static_cast<double>(full.transitions.size());
  config.limit = 0.7 * all;
  const auto choice = choose_samples(full, config);
  ASSERT_TRUE(choice) << choice.error().message;
  EXPECT_LT(choice->data.samples.size(), full.samples.size());
  EXPECT_LE(10 * choice->data.samples.size() + 2 * choice->data.transitions.size(), config.limit);
}

TEST(Choose, WhatCannotServeEveryDirectionIsRefused) {
  const auto choice = choose_samples(tiny_sprite_data(), at_most(5));
  ASSERT_FALSE(choice);
  EXPECT_EQ(choice.error().code, ErrorCode::BadContent);
  EXPECT_NE(choice.error().message.find("5 samples at most are due"), std::string::npos);
}

}  // namespace
}  // namespace vsprite
