// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/build_pack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vsprite {
namespace {

/// Four samples of one clip that run to the right for ever; the last one was not kept.
struct Tables {
  FilmFacts film{"walk.mp4", 30000, 1001};
  std::vector<SampleRow> rows;
  TransitionFile file;
  CostTable& costs = file.costs;
  ValueFile values;
  std::vector<OpaqueBox> boxes{{0, 0, 10, 4}, {1, 2, 31, 8}, {2, 1, 22, 6}, {0, 0, 99, 9}};

  Tables() {
    for (int i = 0; i < 4; ++i) {
      SampleRow row;
      row.sample = i;
      row.frame = i;
      row.left = 100, row.top = 50;
      row.width = 40, row.height = 20;
      row.anchor_x = 118.5, row.anchor_y = 61.25;
      row.velocity_x = 60, row.velocity_y = -30;
      row.area = 400;
      row.scale = 0.5;
      row.duration = i == 1 ? 2 : 1;
      rows.push_back(row);
    }
    costs.row_start = {0, 1, 2, 3, 3};
    costs.transitions = {{1, 0}, {2, 0}, {0, 0.5f}};
    costs.kept = {1, 1, 1, 0};
    Solution solution = detail::empty_solution("paper", 8, 1, 4, {});
    for (std::size_t k = 0; k < solution.mode.next.size(); k += 4) {
      solution.mode.next[k] = 1;
      solution.mode.next[k + 1] = 2;
      solution.mode.next[k + 2] = 0;
    }
    values.modes.push_back(std::move(solution));
    file.skip_costs = {0.25f, HUGE_VALF, HUGE_VALF, HUGE_VALF};
  }
  Result<SpriteData> data() const { return make_sprite_data(film, rows, file, values, boxes); }
};

TEST(BuildPack, LengthsAreInSpritePixels) {
  const auto data = Tables().data();
  ASSERT_TRUE(data) << data.error().message;
  const Sample& sample = data->samples[1];
  EXPECT_EQ(sample.anchor, (Vec2{9.25f, 5.625f}));
  EXPECT_EQ(sample.velocity, (Vec2{30, -15}));
  EXPECT_EQ(sample.width, 20);
  EXPECT_EQ(sample.height, 10);
  EXPECT_EQ(sample.area, 100);
  EXPECT_EQ(sample.duration, 2);
  EXPECT_EQ(data->samples[0].skip_cost, 0.25f);
  // 30 px/s at 30000/1001 ticks a second: 1.001 px a tick.
  EXPECT_EQ(sample.step_x, 65602);
  EXPECT_EQ(sample.step_y, -32801);
  EXPECT_EQ(data->body_length, 20) << "the median over kept samples";
  EXPECT_EQ(data->name, "walk");
}

TEST(BuildPack, TheBodyEndsWhereNineTenthsOfThePicturesDo) {
  const Tables tables;
  const auto data = tables.data();
  ASSERT_TRUE(data);
  for (const BodyBox& body : data->bodies) {
    std::vector<float> left, bottom;
    for (std::size_t i = 0; i < 4; ++i) {
      if (data->samples[i].kept == 0 || data->samples[i].tag != body.tag) continue;
      left.push_back(static_cast<float>(tables.boxes[i].left) - data->samples[i].anchor.x);
      bottom.push_back(static_cast<float>(tables.boxes[i].bottom) - data->samples[i].anchor.y);
    }
    std::sort(left.begin(), left.end());
    std::sort(bottom.begin(), bottom.end());
    ASSERT_FALSE(left.empty());
    EXPECT_EQ(body.left, left[(left.size() - 1) * 5 / 100]);
    EXPECT_EQ(body.bottom, bottom[(bottom.size() - 1) * 95 / 100]);
  }
  EXPECT_FALSE(data->bodies.empty());
}

TEST(BuildPack, WhatItMakesIsASprite) {
  const auto data = Tables().data();
  ASSERT_TRUE(data);
  EXPECT_EQ(data->start_sample, 0u);
  EXPECT_EQ(data->samples[3].kept, 0u);
  EXPECT_EQ(data->samples[3].width, 0);
  const auto sprite = make_sprite(*data);
  EXPECT_TRUE(sprite) << sprite.error().message;
}

TEST(BuildPack, NothingKeptIsRefused) {
  Tables tables;
  tables.costs.kept = {0, 0, 0, 0};
  const auto data = tables.data();
  ASSERT_FALSE(data);
  EXPECT_EQ(data.error().code, ErrorCode::BadContent);
}

TEST(BuildPack, AnUnservedDirectionSaysWhy) {
  auto data = Tables().data();
  ASSERT_TRUE(data);
  DirectionReport right, down;
  down.direction = Direction::Down;
  EXPECT_NE(unserved_reason(*data, down).find("never moves down"), std::string::npos);
  EXPECT_NE(unserved_reason(*data, right).find("3 samples move that way, but none for long"),
            std::string::npos);
  right.speed = 30;
  EXPECT_NE(unserved_reason(*data, right).find("no run of them keeps to it"), std::string::npos);
  for (Sample& sample : data->samples) sample.kept = 0;
  EXPECT_NE(unserved_reason(*data, right).find("no smooth jump leads to them"), std::string::npos);
  // 34 px/s is a sway for a subject of 400 px: a tenth of its size a second.
  for (Sample& sample : data->samples) sample.area = 160000;
  EXPECT_EQ(unserved_reason(*data, right),
            "it only sways: 34 px/s at most, and 100 count as moving");
  right.reachable = true;
  EXPECT_EQ(unserved_reason(*data, right), "");
}

}  // namespace
}  // namespace vsprite
