// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/shadow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "sections.h"
#include "support/pack_bytes.h"
#include "vsprite/compose.h"

namespace vsprite {
namespace {

using testing::ByteVector;
using testing::PackParts;

constexpr int kWide = 12, kHigh = 7;

int shade_at(std::uint32_t sample, int x, int y) {
  return (static_cast<int>(sample) * 7 + 3 * x * y + x) % 160;
}

Image shade_of(std::uint32_t sample) {
  Image image = make_image(kWide, kHigh, 0, 0, 0, 0);
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x < kWide; ++x)
      image.rgba[static_cast<std::size_t>(4 * (y * kWide + x) + 3)] =
          static_cast<std::uint8_t>(shade_at(sample, x, y));
  return image;
}

// Every third sample casts one.
SpriteData shaded_data() {
  SpriteData data = testing::tiny_sprite_data();
  for (std::uint32_t i = 1; i < data.samples.size(); i += 3)
    EXPECT_TRUE(add_shadow(data, i, shade_of(i), {5.5f, 2.25f}));
  return data;
}

const ByteVector& shaded_pack() {
  static const ByteVector bytes = [] {
    const testing::TempFolder folder;
    const SpriteData data = shaded_data();
    const auto saved = save_pack(folder.file("s.vsp"), data, [&](std::uint32_t sample) {
      return Result<Image>(testing::tiny_picture(data, sample));
    });
    return saved ? testing::read_bytes(folder.file("s.vsp")) : ByteVector();
  }();
  return bytes;
}

TEST(Shadow, ComesBackFromAPackExactly) {
  const auto sprite = testing::load_bytes(shaded_pack());
  ASSERT_TRUE(sprite);
  EXPECT_TRUE(testing::verify_bytes(shaded_pack()).empty());
  EXPECT_EQ(sprite->data().shadow_scale, 2);
  Image image;
  for (std::uint32_t i = 0; i < sprite->samples().size(); ++i) {
    const FilmedShadow* shadow = find_shadow(*sprite, i);
    ASSERT_EQ(shadow != nullptr, i % 3 == 1) << i;
    if (shadow == nullptr) continue;
    EXPECT_EQ(shadow->anchor.x, 5.5f);
    EXPECT_EQ(shadow->anchor.y, 2.25f);
    ASSERT_TRUE(decode_shadow(*shadow, image));
    EXPECT_EQ(image.width, kWide);
    EXPECT_EQ(image.rgba, shade_of(i).rgba) << i;
  }
}

TEST(Shadow, ASpriteWithoutHasNoSectionAndItsOldBytes) {
  SpriteData data = testing::tiny_sprite_data();
  EXPECT_TRUE(data.shadows.empty());
  const auto sprite = testing::load_bytes(testing::tiny_pack_bytes());
  EXPECT_EQ(find_shadow(*sprite, 4), nullptr);
  for (const auto& part : PackParts::split(testing::tiny_pack_bytes()).parts)
    EXPECT_NE(part.name, "SHDW");
}

TEST(Shadow, OnlyItsCoverageCountsAndItsSizeIsChecked) {
  SpriteData data = testing::tiny_sprite_data();
  ASSERT_TRUE(add_shadow(data, 1, make_image(3, 2, 200, 100, 50, 90), {}));
  Image image;
  ASSERT_TRUE(decode_shadow(data.shadows[0], image));
  for (std::size_t i = 0; i < image.rgba.size(); ++i) EXPECT_EQ(image.rgba[i], i % 4 == 3 ? 90 : 0);
  for (const auto& [w, h] : {std::pair{0, 4}, std::pair{65536, 1}, std::pair{5000, 5000}}) {
    const auto bad = add_shadow(data, 2, Image{w, h, {}}, {});
    ASSERT_FALSE(bad);
    EXPECT_EQ(bad.error().code, ErrorCode::CorruptData);
    EXPECT_NE(bad.error().message.find("sample 2"), std::string::npos);
  }
}

// On the CPU: what lies below keeps 1 - a of its light, twice as large, anchor on anchor.
TEST(Shadow, DarkensWhatLiesBelow) {
  SpriteData data = testing::tiny_sprite_data();
  ASSERT_TRUE(add_shadow(data, 1, make_image(6, 4, 0, 0, 0, 128), {3, 1}));
  const auto sprite = make_sprite(data);
  ASSERT_TRUE(sprite);
  Image canvas = make_image(40, 40, 188, 188, 188);  // half of the light
  draw_shadow(canvas, *sprite, 1, {20, 20});
  const auto value = [&](int x, int y) { return int{ImageView(canvas).pixel(x, y)[0]}; };
  EXPECT_NEAR(value(20, 20), 137, 1);  // a quarter
  EXPECT_NEAR(value(16, 24), 137, 1);
  EXPECT_EQ(value(12, 20), 188);  // 20 - 2 x 3 = 14 is its left end
  EXPECT_EQ(value(20, 16), 188);
  EXPECT_EQ(value(20, 27), 188);
  const Image before = canvas;
  draw_shadow(canvas, *sprite, 2, {20, 20});
  EXPECT_EQ(canvas.rgba, before.rgba);
}

TEST(Shadow, EveryFaultHasItsCode) {
  const auto code = [](const std::function<void(SpriteData&)>& spoil) {
    SpriteData data = shaded_data();
    spoil(data);
    const auto bad = detail::check_sprite_data(data);
    return bad ? bad->issue.code : std::string();
  };
  using S = SpriteData;
  EXPECT_EQ(code([](S&) {}), "");
  EXPECT_EQ(code([](S& d) { d.shadow_scale = 0; }), "shadow-value");
  EXPECT_EQ(code([](S& d) { d.shadow_scale = std::nanf(""); }), "shadow-value");
  EXPECT_EQ(code([](S& d) { d.shadows[1].sample = d.shadows[0].sample; }), "shadow-sample");
  EXPECT_EQ(code([](S& d) { d.shadows[0].sample = 0; }), "shadow-sample");  // not kept
  EXPECT_EQ(code([](S& d) { d.shadows.back().sample = 1u << 30; }), "shadow-sample");
  EXPECT_EQ(code([](S& d) { d.shadows[2].anchor.y = std::nanf(""); }), "shadow-value");
  EXPECT_EQ(code([](S& d) { d.shadows[2].width = 0; }), "shadow-value");
  EXPECT_EQ(code([](S& d) { d.shadows[2].width = d.shadows[2].height = 65535; }), "shadow-value");
}

TEST(Shadow, ADamagedPictureIsNamedAndDrawsNothing) {
  PackParts parts = PackParts::split(shaded_pack());
  const std::size_t first = 8 + 24 * shaded_data().shadows.size();
  parts["SHDW"].bytes[first] = 9;  // a form that is none
  const auto bytes = parts.join();
  ASSERT_EQ(testing::verify_bytes(bytes).size(), 1u);
  EXPECT_EQ(testing::verify_bytes(bytes)[0].code, "shadow-picture");
  const auto damaged = testing::load_bytes(bytes);
  ASSERT_TRUE(damaged);
  Image canvas = make_image(20, 20, 90, 90, 90);
  const Image before = canvas;
  draw_shadow(canvas, *damaged, 1, {10, 10});
  EXPECT_EQ(canvas.rgba, before.rgba);
}

TEST(Shadow, AnyTruncationAndNoHostileSectionIsAccepted) {
  const PackParts good = PackParts::split(shaded_pack());
  std::mt19937 random(5);
  for (int trial = 0; trial < 1500; ++trial) {
    PackParts parts = good;
    ByteVector& bytes = parts["SHDW"].bytes;
    if (trial % 2 == 0) {
      bytes.resize(random() % bytes.size());
      EXPECT_FALSE(testing::load_bytes(parts.join()));
      continue;
    }
    bytes[trial % 4 == 1 ? random() % 200 : random() % bytes.size()] =
        static_cast<std::uint8_t>(random());
    const auto sprite = testing::load_bytes(parts.join());
    if (!sprite) continue;
    Image canvas = make_image(16, 16, 9, 9, 9);
    for (const FilmedShadow& shadow : sprite->data().shadows)
      draw_shadow(canvas, *sprite, shadow.sample, {8, 8});
  }
}

}  // namespace
}  // namespace vsprite
