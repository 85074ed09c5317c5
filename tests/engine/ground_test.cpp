// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "support/temp_folder.h"
#include "support/tiny_sprite.h"
#include "vsprite/compose.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

constexpr Ground kFloor{.horizon = 100, .line = 400, .center = 320, .focal = 500};

std::string tiny_pack(const testing::TempFolder& folder, std::vector<std::uint8_t> floor = {}) {
  const SpriteData data = testing::tiny_sprite_data();
  const std::string path = folder.file("tiny.vsp");
  const auto picture = [&](std::uint32_t i) -> Result<Image> {
    return make_image(data.samples[i].width, data.samples[i].height, 9, 9, 9, 255);
  };
  const PackExtra extras[] = {{"GRND", std::move(floor)}, {"GAME", {1, 2, 3}}};
  EXPECT_TRUE(save_pack(path, data, picture, extras));
  return path;
}

TEST(Ground, OnTheLineTheSpriteHasItsOwnSizeAndFurtherAwayLess) {
  EXPECT_EQ(to_ground(kFloor, {350, 400}), (Vec2{30, 0}));
  EXPECT_FLOAT_EQ(scale_at(kFloor, to_ground(kFloor, {0, 400})), 1);
  EXPECT_FLOAT_EQ(scale_at(kFloor, to_ground(kFloor, {0, 250})), 0.5f);
  EXPECT_FLOAT_EQ(scale_at(kFloor, to_ground(kFloor, {0, 550})), 1.5f);
  // Half the size is twice as far from the camera: a focal length beyond the line.
  EXPECT_FLOAT_EQ(to_ground(kFloor, {320, 250}).y, -500);
}

TEST(Ground, ThereAndBack) {
  for (float y = 110; y < 900; y += 37)
    for (float x = -200; x < 900; x += 53) {
      const Vec2 back = to_screen(kFloor, to_ground(kFloor, {x, y}));
      EXPECT_NEAR(back.x, x, 0.02f);
      EXPECT_NEAR(back.y, y, 0.02f);
    }
}

TEST(Ground, StraightLinesStayStraight) {
  const Vec2 a{-300, -900}, b{200, 150};
  const Vec2 from = to_screen(kFloor, a), to = to_screen(kFloor, b);
  for (float t = 0.1f; t < 1; t += 0.1f) {
    const Vec2 p = to_screen(kFloor, {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    const float off = (p.x - from.x) * (to.y - from.y) - (p.y - from.y) * (to.x - from.x);
    EXPECT_NEAR(off / std::hypot(to.x - from.x, to.y - from.y), 0, 0.01f);
  }
}

TEST(Ground, TheHorizonAndTheCameraAreKeptAway) {
  EXPECT_TRUE(std::isfinite(to_ground(kFloor, {320, 0}).y));
  EXPECT_LE(scale_at(kFloor, {0, 500}), kNearest);
  EXPECT_LE(scale_at(kFloor, {0, 1e9f}), kNearest);
  const Ground half = scaled(kFloor, 0.5f);
  const Vec2 small = to_screen(half, {10, -40}), large = to_screen(kFloor, {20, -80});
  EXPECT_NEAR(small.x, large.x / 2, 1e-3f);
  EXPECT_NEAR(small.y, large.y / 2, 1e-3f);
}

TEST(Ground, LiesInThePackAndComesBack) {
  const testing::TempFolder folder;
  const auto none = load_ground(tiny_pack(folder));
  ASSERT_TRUE(none);
  EXPECT_FALSE(none->has_value());
  const std::string path = tiny_pack(folder, *encode_ground(kFloor));
  const auto loaded = load_ground(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_TRUE(loaded->has_value());
  EXPECT_EQ((*loaded)->horizon, 100);
  EXPECT_EQ((*loaded)->line, 400);
  EXPECT_EQ((*loaded)->center, 320);
  EXPECT_EQ((*loaded)->focal, 500);
  EXPECT_TRUE(load_pack(path));  // which skips it
  EXPECT_TRUE(verify_pack(path)->empty());
  EXPECT_EQ(*load_extra(path, "GAME"), (std::vector<std::uint8_t>{1, 2, 3}));
}

TEST(Ground, RefusesWhatIsNoFloor) {
  const testing::TempFolder folder;
  EXPECT_FALSE(encode_ground({400, 400, 0, 500}));
  EXPECT_FALSE(encode_ground({100, 400, 0, 0}));
  EXPECT_FALSE(encode_ground({100, std::nanf(""), 0, 500}));
  EXPECT_FALSE(load_ground(folder.file("absent.vsp")));
  EXPECT_FALSE(load_ground(tiny_pack(folder, {1, 2, 3})));
  const std::string path = tiny_pack(folder, *encode_ground(kFloor));
  // Any changed byte of the section is found.
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const float line = 400;
  const auto at = bytes.rfind(std::string(reinterpret_cast<const char*>(&line), sizeof line));
  ASSERT_NE(at, std::string::npos);
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
  std::ofstream(path, std::ios::binary) << bytes;
  const auto damaged = load_ground(path);
  ASSERT_FALSE(damaged);
  EXPECT_EQ(damaged.error().code, ErrorCode::CorruptData);
}

}  // namespace
}  // namespace vsprite
