// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/actions.h"

#include <gtest/gtest.h>

#include <random>

#include "control/action_bench.h"
#include "support/naive_actions.h"

namespace vsprite {
namespace {

CostTable costs_of(const SpriteData& data) {
  CostTable costs{data.row_start, data.transitions, {}, {}};
  for (const Sample& s : data.samples) costs.kept.push_back(static_cast<std::uint8_t>(s.kept));
  return costs;
}

// Costs and durations anew, so that ways differ and ties are rare.
SpriteData shuffled(std::uint32_t seed) {
  SpriteData data = testing::tagged_sprite_data();
  std::mt19937 random(seed);
  for (Transition& t : data.transitions) t.cost = static_cast<float>(random() % 1000) / 700.0f;
  for (Sample& s : data.samples) s.duration = static_cast<std::uint16_t>(1 + random() % 3);
  return data;
}

std::vector<Cut> cuts_of(const SpriteData& data, std::uint16_t tag, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto firsts = first_samples(data.samples, tag);
  std::vector<Cut> cuts;
  for (std::size_t i = 0; i < data.samples.size(); ++i)
    cuts.push_back(
        {firsts[random() % firsts.size()], static_cast<float>(random() % 1000) / 400.0f});
  return cuts;
}

TEST(Actions, TheWayIsTheExactSolutionOfItsEquation) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const SpriteData data = shuffled(seed);
    for (std::uint16_t tag = 1; tag < data.tags.size(); ++tag) {
      const auto table =
          solve_action(costs_of(data), data.samples, tag, cuts_of(data, tag, seed), {});
      ASSERT_TRUE(table);
      const std::vector<double> due = testing::naive_way(data, tag, 0.05);
      for (std::size_t i = 1; i < data.samples.size(); ++i)
        ASSERT_EQ(table->value[i], static_cast<float>(due[i])) << seed << " " << tag << " " << i;
    }
  }
}

TEST(Actions, UnderADeadlineItIsTheSmoothestOfAllThatComeInTime) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const SpriteData data = shuffled(seed);
    const std::size_t n = data.samples.size();
    const auto table =
        *solve_action(costs_of(data), data.samples, testing::kAirTag, cuts_of(data, 3, seed), {});
    for (std::uint32_t i = 1; i < n; ++i) {
      for (int m = 1; m <= 8; ++m) {
        std::uint32_t due = kNoSample;
        testing::naive_in_time(data, table, i, m, &due);
        ASSERT_EQ(table.in_time[static_cast<std::size_t>(m - 1) * n + i], due) << i << " " << m;
      }
    }
  }
}

TEST(Actions, WhatStaysInATagNeverLeavesItAndLoopsWhereItCan) {
  const SpriteData data = testing::tagged_sprite_data();
  const auto solve = [&](std::uint16_t tag) {
    return *solve_action(costs_of(data), data.samples, tag, cuts_of(data, tag, 1), {});
  };
  const ActionTable wave = solve(testing::kWaveTag), air = solve(testing::kAirTag);
  for (std::uint32_t phase = 0; phase < testing::kTinyClip; ++phase)
    EXPECT_EQ(wave.stay[testing::tiny_sample(6, phase)],
              testing::tiny_sample(6, (phase + 1) % testing::kTinyClip));
  EXPECT_EQ(air.stay[testing::tiny_sample(2, 6)], testing::tiny_sample(2, 7));
  EXPECT_EQ(air.stay[testing::tiny_sample(2, 7)], testing::tiny_sample(2, 7));  // held
  EXPECT_EQ(air.stay[testing::tiny_sample(0, 0)], kNoSample);
}

TEST(Actions, APlayedTagIsNeverLaterThanAsked) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    SpriteData data = shuffled(seed);
    for (std::uint16_t tag = 1; tag < data.tags.size(); ++tag)
      data.actions.push_back(
          *solve_action(costs_of(data), data.samples, tag, cuts_of(data, tag, seed), {}));
    const auto sprite = make_sprite(std::move(data));
    ASSERT_TRUE(sprite) << sprite.error().message;
    const auto reports = measure_actions(*sprite);
    EXPECT_EQ(reports.size(), 5 * sprite->data().actions.size());
    for (const ActionReport& r : reports) EXPECT_EQ(r.late, 0u) << r.tag << " within " << r.within;
  }
}

TEST(Actions, SaysWhatIsWrongWithItsInput) {
  const SpriteData data = testing::tagged_sprite_data();
  const auto cuts = cuts_of(data, 1, 1);
  const auto code = [&](const CostTable& costs, std::uint16_t tag, const ActionConfig& config) {
    const auto table = solve_action(costs, data.samples, tag, cuts, config);
    return table ? ErrorCode::Unavailable : table.error().code;
  };
  EXPECT_EQ(code(costs_of(data), 1, {.tau = 0}), ErrorCode::BadSetting);
  EXPECT_EQ(code(costs_of(data), 1, {.tau = std::nan("")}), ErrorCode::BadSetting);
  EXPECT_EQ(code(costs_of(data), 1, {.horizon = 65}), ErrorCode::BadSetting);
  EXPECT_EQ(code(costs_of(data), 9, {}), ErrorCode::BadContent);
  CostTable apart = costs_of(data);  // nothing leads to the idle clip
  for (Transition& t : apart.transitions)
    if (t.to >= testing::kTinyFirstIdle) t.to = 1;
  EXPECT_EQ(code(apart, 1, {}), ErrorCode::BadContent);
}

}  // namespace
}  // namespace vsprite
