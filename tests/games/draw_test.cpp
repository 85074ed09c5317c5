// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "support/gl_stage.h"
#include "support/process.h"
#include "support/temp_folder.h"
#include "support/tiny_sprite.h"
#include "vsprite/compose.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

using testing::color_at;
using testing::largest_difference;
using testing::noise_picture;

class Draw : public testing::GlTest {
 protected:
  /// The picture on (40, 60, 90), drawn by both.
  int difference_to_compositor(const Image& picture, Vec2 at, float scale) {
    Image canvas = make_image(96, 80, 40, 60, 90);
    draw_picture(canvas, picture, at, {.scale = scale});
    renderer().begin_frame(96, 80);
    renderer().clear(srgb(0x283c5a));
    renderer().draw_sprite({.image = picture, .position = at, .scale = scale});
    renderer().end_frame();
    return largest_difference(renderer().read_pixels(), canvas);
  }
};

/// White, opaque up to a few pixels from its edge, and clear beyond it.
Image soft_disc(int side, float radius) {
  Image image = make_image(side, side, 255, 255, 255);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const float u = static_cast<float>(x) + 0.5f - static_cast<float>(side) / 2;
      const float v = static_cast<float>(y) + 0.5f - static_cast<float>(side) / 2;
      const float in = std::clamp((radius - std::sqrt(u * u + 4 * v * v)) / 8, 0.0f, 1.0f);
      std::fill_n(&image.rgba[std::size_t(y * side + x) * 4], 4,
                  static_cast<std::uint8_t>(std::lround(255 * in)));
    }
  }
  return image;
}

TEST_F(Draw, IsTheCompositorsPictureAtEverySubPixelPlace) {
  const Image picture = noise_picture(31, 27, 1);
  for (float x : {10.0f, 10.25f, 10.5f, 10.8125f}) {
    for (float y : {8.0f, 8.4375f, 8.75f}) {
      EXPECT_LE(difference_to_compositor(picture, {x, y}, 1), 2) << x << ", " << y;
    }
  }
}

TEST_F(Draw, CutsOffWhatLiesOutside) {
  const Image picture = noise_picture(31, 27, 2);
  for (Vec2 at : {Vec2{-12.5f, -3.25f}, Vec2{80.5f, 70.75f}, Vec2{500, 500}}) {
    EXPECT_LE(difference_to_compositor(picture, at, 1), 2) << at.x << ", " << at.y;
  }
}

TEST_F(Draw, KeepsTheEdgeColourOfAReducedPicture) {
  // Half covered everywhere: whatever the filter, inside the picture it stays the same colour.
  Image picture = make_image(64, 64, 200, 80, 20, 128);
  Image canvas = make_image(96, 80, 40, 60, 90);
  draw_picture(canvas, picture, {0, 0});
  for (float scale : {0.8f, 0.5f, 0.3f}) {
    renderer().begin_frame(96, 80);
    renderer().clear(srgb(0x283c5a));
    renderer().draw_sprite({.image = picture, .position = {10.3f, 10.7f}, .scale = scale});
    renderer().end_frame();
    const Image seen = renderer().read_pixels();
    EXPECT_EQ(color_at(seen, 19, 19), color_at(canvas, 20, 20)) << scale;
  }
}

// At a half, a quarter, an eighth every pixel is the mean of so many of the picture.
TEST_F(Draw, AReducedPictureIsTheMeanOfWhatLiesUnderEachPixel) {
  const Image picture = noise_picture(63, 50, 3);
  for (float scale : {0.5f, 0.25f, 0.125f})
    EXPECT_LE(difference_to_compositor(picture, {10, 8}, scale), 2) << scale;
}

TEST_F(Draw, AReducedPictureIsCachedAtItsSizeAndAnyOtherApart) {
  const Image picture = noise_picture(31, 27, 4);
  const TextureKey key{7, 1};
  const auto draw = [&](float scale, bool with_pixels) {
    renderer().begin_frame(96, 80);
    renderer().clear(srgb(0x283c5a));
    renderer().draw_sprite({.image = with_pixels ? ImageView(picture) : ImageView(),
                            .key = key,
                            .position = {9.4f, 6.6f},
                            .scale = scale});
    renderer().end_frame();
    return renderer().read_pixels();
  };
  const Image first = draw(0.4f, true);
  EXPECT_FALSE(renderer().is_cached(key));
  EXPECT_TRUE(renderer().is_cached(reduced_key(key, 0.4f)));
  EXPECT_EQ(reduced_key(key, 0.4f), reduced_key(key, 0.5f));
  EXPECT_NE(reduced_key(key, 0.4f), reduced_key(key, 0.25f));
  EXPECT_EQ(reduced_key(key, 0.51f), key);
  EXPECT_EQ(largest_difference(draw(0.4f, false), first), 0);
  // Where the whole picture is there, it does for any size.
  (void)draw(1, true);
  EXPECT_TRUE(renderer().is_cached(key));
  const Image reduced = draw(0.2f, false);
  EXPECT_NE(color_at(reduced, 11, 8), color_at(reduced, 90, 70));
  renderer().forget(7);
}

TEST_F(Draw, EncodesEveryGreyExactly) {
  renderer().begin_frame(256, 4);
  for (int i = 0; i < 256; ++i) {
    const auto x = static_cast<float>(i);
    const auto grey = static_cast<std::uint32_t>(i * 0x010101);
    renderer().draw_shape(box({x, -1}, {x + 2, 5}, srgb(grey)));
  }
  renderer().end_frame();
  const Image seen = renderer().read_pixels();
  for (int i = 0; i < 256; ++i) {
    EXPECT_EQ(color_at(seen, i, 2), static_cast<std::uint32_t>(i * 0x010101));
  }
}

TEST_F(Draw, KeepsTheOrderOfTheCalls) {
  const Image red = make_image(8, 8, 255, 0, 0);
  const Color green = srgb(0x00ff00), blue = srgb(0x0000ff);
  const std::array<Vertex, 3> triangle = {{{{0, 0}, blue}, {{40, 0}, blue}, {{0, 40}, blue}}};
  const auto shot = [&](int last) {
    renderer().begin_frame(16, 16);
    for (int i = 1; i <= 3; ++i) {
      const int what = (last + i) % 3;
      if (what == 0) renderer().draw_sprite({.image = red, .position = {4, 4}});
      if (what == 1) renderer().draw_shape(box({0, 0}, {16, 16}, green));
      if (what == 2) renderer().draw_triangles(triangle);
    }
    renderer().end_frame();
    return color_at(renderer().read_pixels(), 7, 7);
  };
  EXPECT_EQ(shot(0), 0xff0000u);
  EXPECT_EQ(shot(1), 0x00ff00u);
  EXPECT_EQ(shot(2), 0x0000ffu);
}

TEST_F(Draw, DrawsManySpritesAsOneBatch) {
  const Image picture = noise_picture(20, 20, 3);
  renderer().begin_frame(96, 80);
  for (int i = 0; i < 100; ++i) {
    const auto sample = static_cast<std::uint32_t>(i % 10);
    const auto x = static_cast<float>(i % 80), y = static_cast<float>(i / 4);
    renderer().draw_sprite({.image = picture, .key = {7, sample}, .position = {x, y}});
  }
  renderer().end_frame();
  EXPECT_EQ(renderer().stats().sprites, 100u);
  EXPECT_EQ(renderer().stats().uploads, 10u);
  EXPECT_EQ(renderer().stats().batches, 1u);
}

// Pictures of two kinds in turn: one call for each kind where they stand apart, and in the order of
// the calls where they do not.
TEST_F(Draw, WhatLiesApartSharesABatchAndWhatMeetsKeepsItsOrder) {
  const Image red = make_image(8, 8, 255, 0, 0), blue = make_image(8, 8, 0, 0, 255);
  const auto shot = [&](float step) {
    renderer().begin_frame(192, 24);
    for (int i = 0; i < 8; ++i) {
      SpriteDraw s{.image = red, .key = {8, 1}, .position = {5 + step * static_cast<float>(i), 9}};
      if (i % 2 != 0) s.fade = {.image = blue, .key = {8, 2}, .share = 1};
      renderer().draw_sprite(s);
    }
    renderer().end_frame();
    return renderer().read_pixels();
  };
  const Image apart = shot(22);
  EXPECT_EQ(renderer().stats().batches, 2u);
  const Image meeting = shot(4);
  EXPECT_EQ(renderer().stats().batches, 8u);
  for (int i = 0; i < 8; ++i) {
    const std::uint32_t due = i % 2 != 0 ? 0x0000ffu : 0xff0000u;
    EXPECT_EQ(color_at(apart, 7 + 22 * i, 12), due) << i;
    EXPECT_EQ(color_at(meeting, 6 + 4 * i, 12), due) << i;
  }
}

// A crowd that covers the frame many times, at once (from front to back where it is solid) and one
// picture at a time.
TEST_F(Draw, WhatIsHiddenIsNotDrawnAndNobodySeesIt) {
  const Image fish = soft_disc(40, 26);
  std::mt19937 random(5);
  std::vector<SpriteDraw> crowd;
  for (int i = 0; i < 300; ++i) {
    const auto part = [&] { return static_cast<float>(random() % 1000) / 1000; };
    SpriteDraw s{.image = fish, .key = {6, 1}, .position = {96 * part(), 80 * part()}};
    s.anchor = {20, 20};
    s.angle = 6 * part();
    s.scale = 0.9f + part();
    s.tint = {part(), part(), part(), i % 5 == 0 ? 0.5f : 1.0f};
    crowd.push_back(s);
  }
  const auto shot = [&](bool at_once) {
    renderer().begin_frame(96, 80);
    for (const SpriteDraw& s : crowd) {
      renderer().draw_sprite(s);
      if (!at_once) renderer().take_backdrop();  // what waits is drawn
    }
    renderer().end_frame();
    return renderer().read_pixels();
  };
  const Image at_once = shot(true);
  EXPECT_EQ(renderer().stats().batches, 2u);  // what is solid, then all
  EXPECT_LE(largest_difference(at_once, shot(false)), 1);
}

// Half red and half blue is half the light of each; where only one of them lies, half is ground.
TEST_F(Draw, ACrossFadeMixesBeforeItCovers) {
  const Image red = make_image(16, 16, 255, 0, 0), blue = make_image(16, 16, 0, 0, 255);
  renderer().begin_frame(48, 32);
  renderer().clear(srgb(0x00ff00));
  renderer().draw_sprite({.image = red,
                          .position = {20, 16},
                          .anchor = {8, 8},
                          .fade = {.image = blue, .anchor = {16, 8}, .share = 0.5f}});
  renderer().end_frame();
  const Image seen = renderer().read_pixels();
  EXPECT_EQ(color_at(seen, 16, 16), 0xbc00bcu);  // both: no ground shines through
  EXPECT_EQ(color_at(seen, 24, 16), 0xbcbc00u);  // the new one alone
  EXPECT_EQ(color_at(seen, 6, 16), 0x00bcbcu);   // the old one alone
  EXPECT_EQ(color_at(seen, 2, 16), 0x00ff00u);
  EXPECT_EQ(renderer().stats().batches, 1u);
}

// The shadow's reference: each canvas pixel sampled from make_shadow through the ground's geometry.
TEST_F(Draw, AShadowIsTheBlurredSilhouetteLaidOnTheGround) {
  const Image picture = make_image(24, 32, 250, 20, 20);
  const Shadow shadow{.opacity = 0.5f, .squash = 0.5f, .slant = 0.25f, .blur = 4};
  renderer().begin_frame(96, 80);
  renderer().clear(srgb(0xffffff));
  renderer().draw_shadow({.image = picture, .position = {40, 60}, .anchor = {12, 32}}, shadow);
  renderer().end_frame();
  const Image seen = renderer().read_pixels();
  const SoftShadow soft = make_shadow(picture, shadow.blur);
  const auto coverage = [&](float x, float y) {  // bilinear, at a pixel's centre on the canvas
    const float dy = (y - 60) / shadow.squash;
    const float u = (x - 40 + shadow.slant * dy + 12 - soft.corner.x) / soft.scale - 0.5f;
    const float v = (dy + 32 - soft.corner.y) / soft.scale - 0.5f;
    const auto at = [&](float i, float j) {
      const bool inside = i >= 0 && j >= 0 && i < static_cast<float>(soft.image.width) &&
                          j < static_cast<float>(soft.image.height);
      if (!inside) return 0.0f;
      return static_cast<float>(
                 ImageView(soft.image).pixel(static_cast<int>(i), static_cast<int>(j))[3]) /
             255;
    };
    const float i = std::floor(u), j = std::floor(v);
    return (1 - (v - j)) * ((1 - (u - i)) * at(i, j) + (u - i) * at(i + 1, j)) +
           (v - j) * ((1 - (u - i)) * at(i, j + 1) + (u - i) * at(i + 1, j + 1));
  };
  int darkest = 255;
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 96; ++x) {
      const float light =
          1 - 0.5f * coverage(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const int due = srgb_from_linear(static_cast<std::uint16_t>(std::lround(65535 * light)));
      const int is = static_cast<int>(color_at(seen, x, y) & 0xff);
      ASSERT_NEAR(is, due, 2) << x << ", " << y;
      darkest = std::min(darkest, is);
    }
  }
  EXPECT_EQ(darkest, 188);  // half the light, where it is whole
}

TEST_F(Draw, AShadowIsCachedApartFromItsPictureAndFadesWithIt) {
  const Image picture = make_image(16, 16, 250, 20, 20);
  const TextureKey key{3, 1};
  const Shadow shadow{};
  const auto shot = [&](const SpriteDraw& s) {
    renderer().begin_frame(48, 48);
    renderer().clear(srgb(0xffffff));
    renderer().draw_shadow(s, shadow);
    renderer().end_frame();
    return color_at(renderer().read_pixels(), 24, 22) & 0xff;
  };
  const SpriteDraw whole{.image = picture, .key = key, .position = {24, 24}, .anchor = {8, 16}};
  const auto once = shot(whole);
  EXPECT_LT(once, 0xf0u);
  EXPECT_FALSE(renderer().is_cached(key));
  EXPECT_TRUE(renderer().is_cached(shadow_key(key, shadow)));
  SpriteDraw again = whole;
  again.image = {};
  EXPECT_EQ(shot(again), once);
  EXPECT_EQ(renderer().stats().uploads, 0u);
  again.fade = {.key = {9, 9}, .share = 0.5f};  // there is no such picture: half of the shadow
  EXPECT_GT(shot(again), once);
  renderer().forget(3);
  EXPECT_FALSE(renderer().is_cached(shadow_key(key, shadow)));
  renderer().draw_shadow({.key = {4, 4}}, {.opacity = 0});  // neither picture nor shadow: nothing
}

class DrawActors : public testing::GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    const SpriteData data = testing::tiny_sprite_data();
    const auto picture = [&](std::uint32_t i) -> Result<Image> {
      return testing::tiny_picture(data, i);
    };
    ASSERT_TRUE(save_pack(folder_.file("tiny.vsp"), data, picture));
    sprite_.emplace(*load_pack(folder_.file("tiny.vsp")));
    frames_.emplace(*sprite_, std::size_t{1} << 20);
  }
  ActorDraw entry(const Actor& actor) { return {&*sprite_, &*frames_, &actor}; }
  Image shot(std::span<const ActorDraw> actors, const Shadow* shadow = nullptr) {
    renderer().begin_frame(96, 80);
    renderer().clear(srgb(0xffffff));
    draw_actors(renderer(), actors, 0, shadow);
    renderer().end_frame();
    return renderer().read_pixels();
  }
  testing::TempFolder folder_;
  std::optional<Sprite> sprite_;
  std::optional<FrameCache> frames_;
};

// Blocks that the GPU decodes against the same decoded here: interpolation differs by a step of
// eight bits or so between drivers.
TEST_F(DrawActors, APackForTheGpuIsDrawnFromItsBlocks) {
  const SpriteData data = testing::tiny_sprite_data();
  const auto picture = [&](std::uint32_t i) -> Result<Image> {
    return testing::tiny_picture(data, i);
  };
  ASSERT_TRUE(save_pack(folder_.file("gpu.vsp"), data, picture, {}, PictureForm::Blocks));
  sprite_.emplace(*load_pack(folder_.file("gpu.vsp")));
  if (!renderer().takes_blocks()) GTEST_SKIP() << "no S3TC here: " << renderer().device();
  std::vector<Actor> actors;
  for (int k = 0; k < 8; ++k) {
    actors.push_back(make_actor(
        *sprite_, {12.3f + 9 * static_cast<float>(k), 20.0f + 5.7f * static_cast<float>(k)}));
    actors.back().sample = testing::tiny_sample(k, 3);
  }
  std::array<Image, 2> seen;
  std::array<std::size_t, 2> bytes{};
  for (const bool blocks : {false, true}) {
    open({.blocks = blocks});
    frames_.emplace(*sprite_, std::size_t{1} << 20);
    std::vector<ActorDraw> all;
    for (const Actor& actor : actors) all.push_back(entry(actor));
    seen[blocks] = shot(all);
    bytes[blocks] = renderer().stats().texture_bytes;
    EXPECT_EQ(renderer().stats().uploads, 8u);
    EXPECT_EQ(renderer().stats().batches, 1u);
  }
  EXPECT_EQ(bytes[1] * 8, bytes[0]);
  EXPECT_LE(testing::largest_difference(seen[0], seen[1]), 4);
  EXPECT_NE(color_at(seen[1], 40, 38), 0xffffffu);
}

TEST_F(DrawActors, ThePagesOfBothFormsShareTheBudget) {
  const Image picture = noise_picture(300, 300, 1);
  std::vector<std::uint8_t> blocks(16 * 76 * 76);
  if (!renderer().takes_blocks()) GTEST_SKIP() << "no S3TC here: " << renderer().device();
  open({.texture_budget = std::size_t{64} << 20});
  for (std::uint32_t i = 0; i < 400; ++i) {
    renderer().begin_frame(320, 240);
    const bool form = i / 50 % 2 != 0;
    renderer().draw_sprite({.image = form ? ImageView() : ImageView(picture),
                            .key = {1, i},
                            .blocks = form ? BlockView{blocks.data(), 300, 300} : BlockView{}});
    renderer().end_frame();
    ASSERT_LE(renderer().stats().texture_bytes, std::size_t{64} << 20);
    ASSERT_TRUE(renderer().is_cached({1, i}));
  }
  EXPECT_GT(renderer().stats().evictions, 2u);
}

TEST_F(DrawActors, TheLowerOneStandsInFrontAndEqualOnesKeepTheirOrder) {
  Actor red = make_actor(*sprite_, {40, 30}), green = red;
  red.sample = testing::tiny_sample(0, 3);
  green.sample = testing::tiny_sample(3, 3);
  const auto red_on_top = [](const Image& seen) {
    const std::uint32_t c = color_at(seen, 40, 30);
    return (c >> 16 & 0xff) > (c >> 8 & 0xff);
  };
  std::array<ActorDraw, 2> both{entry(red), entry(green)};
  EXPECT_FALSE(red_on_top(shot(both)));
  red.position.y += kFixedOne;  // nearer
  EXPECT_TRUE(red_on_top(shot(both)));
  both[1].depth = 1000;
  EXPECT_FALSE(red_on_top(shot(both)));
  both[0].depth = 1000;
  EXPECT_FALSE(red_on_top(shot(both)));  // a tie: the later one
  std::swap(both[0], both[1]);
  EXPECT_TRUE(red_on_top(shot(both)));
}

TEST_F(DrawActors, NoShadowFallsOnAnActor) {
  Actor near = make_actor(*sprite_, {40, 42}), far = make_actor(*sprite_, {40, 30});
  near.sample = far.sample = testing::tiny_sample(0, 3);
  const std::array<ActorDraw, 2> both{entry(near), entry(far)};
  const Shadow shadow{.opacity = 1, .squash = 1};
  const Image with = shot(both, &shadow), without = shot(both);
  EXPECT_EQ(color_at(with, 40, 30), color_at(without, 40, 30));
  EXPECT_NE(color_at(with, 40, 22), color_at(without, 40, 22));
  EXPECT_EQ(renderer().stats().sprites, 2u);
}

// The CPU's draw_shadow is the reference; the actor stands over its shadow, which takes the place
// of a made one and falls on no actor.
TEST_F(DrawActors, AFilmedShadowLiesUnderItsActor) {
  SpriteData data = testing::tiny_sprite_data();
  const std::uint32_t sample = testing::tiny_sample(0, 3);
  ASSERT_TRUE(add_shadow(data, sample, make_image(20, 9, 0, 0, 0, 128), {10, 3}));
  const auto picture = [&](std::uint32_t i) -> Result<Image> {
    return testing::tiny_picture(data, i);
  };
  ASSERT_TRUE(save_pack(folder_.file("shaded.vsp"), data, picture));
  const Sprite shaded = *load_pack(folder_.file("shaded.vsp"));
  FrameCache frames(shaded, std::size_t{1} << 20);
  Actor actor = make_actor(shaded, {40, 30});
  actor.sample = sample;
  const std::array<ActorDraw, 1> one{ActorDraw{&shaded, &frames, &actor}};
  Image due = make_image(96, 80, 255, 255, 255);
  draw_shadow(due, shaded, sample, {40, 30});
  draw_sample(due, frames.frame(sample), shaded.samples()[sample], {40, 30});
  const Image seen = shot(one);
  EXPECT_LE(largest_difference(seen, due), 2);
  const Shadow made{.opacity = 1, .squash = 1};
  EXPECT_EQ(largest_difference(shot(one, &made), seen), 0);
  renderer().begin_frame(96, 80);
  renderer().clear(srgb(0xffffff));
  draw_actor(renderer(), shaded, frames, actor);
  renderer().end_frame();
  EXPECT_EQ(largest_difference(renderer().read_pixels(), seen), 0);
  Actor other = make_actor(shaded, {40, 42});
  other.sample = testing::tiny_sample(3, 3);
  const std::array<ActorDraw, 2> both{ActorDraw{&shaded, &frames, &other, nullptr, {}, -1}, one[0]};
  const std::array<ActorDraw, 1> alone{both[0]};
  EXPECT_EQ(color_at(shot(both), 40, 46), color_at(shot(alone), 40, 46));
}

TEST_F(DrawActors, AFadingActorIsDrawnFromBothPictures) {
  Actor actor = make_actor(*sprite_, {40, 30});
  ActorFade fade;
  actor.sample = testing::tiny_sample(0, 3);
  follow(*sprite_, actor, fade);
  const std::array<ActorDraw, 1> before{entry(actor)};
  const std::uint32_t old_color = color_at(shot(before), 40, 30);
  actor.sample = testing::tiny_sample(5, 4);
  follow(*sprite_, actor, fade, 3);
  const std::array<ActorDraw, 1> alone{entry(actor)};
  const std::uint32_t new_color = color_at(shot(alone), 40, 30);
  std::array<ActorDraw, 1> fading{entry(actor)};
  fading[0].fade = &fade;
  const std::uint32_t mixed = color_at(shot(fading), 40, 30);
  for (const unsigned shift : {0u, 8u, 16u}) {
    const auto light = [&](std::uint32_t c) {
      return linear_from_srgb(static_cast<std::uint8_t>(c >> shift & 0xff)) / 65535.0;
    };
    EXPECT_NEAR(light(mixed), 0.75 * light(old_color) + 0.25 * light(new_color), 0.02);
  }
}

TEST_F(Draw, TheBackdropsLightReachesOverTheEdgeAndNoFurther) {
  Image grey{40, 40, std::vector<std::uint8_t>(6400, 0)};  // a square with a clear margin of 4
  for (int y = 4; y < 36; ++y)
    for (int x = 4; x < 36; ++x)
      for (int c = 0; c < 4; ++c)
        grey.rgba[static_cast<std::size_t>(4 * (40 * y + x) + c)] = c == 3 ? 255 : 60;
  const auto shot = [&](float wrap, bool takes) {
    renderer().begin_frame(80, 80);
    renderer().clear(srgb(0x2040ff));
    if (takes) renderer().take_backdrop();
    renderer().draw_sprite({.image = grey, .key = {5, 1}, .position = {20, 20}, .wrap = wrap});
    renderer().end_frame();
    return renderer().read_pixels();
  };
  const Image plain = shot(0, true), wrapped = shot(0.8f, true);
  EXPECT_EQ(shot(0.8f, false).rgba, plain.rgba);  // without a backdrop there is no light
  EXPECT_EQ(color_at(wrapped, 40, 40), 0x3c3c3cu);
  EXPECT_EQ(color_at(wrapped, 10, 10), 0x2040ffu);
  const auto blue = [](const Image& image, int x) { return color_at(image, x, 40) & 255; };
  EXPECT_GT(blue(wrapped, 24), blue(plain, 24) + 60);  // the outermost column
  EXPECT_GT(blue(wrapped, 24), blue(wrapped, 26));
  EXPECT_GT(blue(wrapped, 26), blue(wrapped, 29));
  EXPECT_EQ(blue(wrapped, 29), 60u);  // beyond the reach of four
}

TEST_F(Draw, AThousandSizesLeaveNothingBehind) {
  const Image picture = noise_picture(20, 20, 3);
  long before = 0;
  for (int i = 0; i < 1000; ++i) {
    if (i == 200) before = testing::resident_pages();
    renderer().begin_frame(16 + i * 7 % 61, 16 + i * 5 % 53);
    renderer().take_backdrop();
    renderer().draw_sprite({.image = picture, .key = {7, 1}, .position = {4, 4}, .wrap = 1});
    renderer().end_frame(64 + i % 3, 48);
  }
  EXPECT_LT(testing::resident_pages(), before + 1024);
  EXPECT_EQ(renderer().stats().uploads, 0u);
}

TEST_F(DrawActors, ALostContextCostsNoPicture) {
  const Actor actor = make_actor(*sprite_, {40, 30});
  const std::array<ActorDraw, 1> one{entry(actor)};
  const Shadow shadow{};
  const Image before = shot(one, &shadow);
  const std::uint64_t decoded = frames_->stats().misses;
  open({});  // window, context and renderer go, and come anew
  EXPECT_EQ(largest_difference(shot(one, &shadow), before), 0);
  EXPECT_GT(renderer().stats().uploads, 0u);
  EXPECT_EQ(frames_->stats().misses, decoded);
}

TEST_F(Draw, ShowsTheRightPictureAfterPagesWereEmptied) {
  open({.texture_budget = 1});
  std::vector<Image> pictures;
  for (unsigned i = 0; i < 6; ++i) pictures.push_back(noise_picture(32, 32, i));
  const Image large = make_image(1500, 1500, 9, 9, 9);
  for (std::uint32_t round = 0; round < 12; ++round) {
    const Image& picture = pictures[round % 6];
    Image canvas = make_image(96, 80, 0, 0, 0);
    draw_picture(canvas, picture, {5, 6});
    renderer().begin_frame(96, 80);
    renderer().draw_sprite({.image = picture, .key = {1, round % 6}, .position = {5, 6}});
    renderer().draw_sprite({.image = large, .position = {2000, 0}});
    renderer().end_frame();
    EXPECT_LE(largest_difference(renderer().read_pixels(), canvas), 2) << round;
  }
  EXPECT_GT(renderer().stats().evictions, 3u);
}

TEST_F(Draw, ForgetsAPackThatWasLoadedAnew) {
  const Image before = make_image(8, 8, 255, 0, 0), after = make_image(8, 8, 0, 0, 255);
  const TextureKey key{5, 0};
  const auto shot = [&](const Image& picture) {
    renderer().begin_frame(8, 8);
    renderer().draw_sprite({.image = picture, .key = key});
    renderer().end_frame();
    return color_at(renderer().read_pixels(), 4, 4);
  };
  EXPECT_EQ(shot(before), 0xff0000u);
  EXPECT_TRUE(renderer().is_cached(key));
  renderer().forget(5);
  EXPECT_FALSE(renderer().is_cached(key));
  EXPECT_EQ(shot(after), 0x0000ffu);
}

TEST_F(Draw, MayBeResizedToNothingAndBack) {
  const Image picture = make_image(8, 8, 255, 0, 0);
  for (int size : {16, 0, 24, -3, 16}) {
    renderer().begin_frame(size, size);
    renderer().clear({});
    renderer().draw_text("text", {0, 0}, {.color = srgb(0xffffff)});
    renderer().draw_sprite({.image = picture});
    renderer().end_frame(size, size);
    const Image seen = renderer().read_pixels();
    EXPECT_EQ(seen.width, std::max(size, 0));
    if (size > 0) {
      EXPECT_EQ(color_at(seen, 7, 7), 0xff0000u);
      EXPECT_EQ(color_at(seen, 15, 15), 0xffffffu);
    }
  }
}

TEST_F(Draw, FitsTheFrameIntoAnyWindowAndFindsThePointerInIt) {
  renderer().begin_frame(200, 100);
  renderer().end_frame(400, 400);  // bars above and below, 100 px each
  const Vec2 middle = renderer().frame_from_window({200, 200});
  const Vec2 corner = renderer().frame_from_window({400, 300});
  EXPECT_EQ(middle, (Vec2{100, 50}));
  EXPECT_EQ(corner, (Vec2{200, 100}));
}

TEST_F(Draw, EverySignOfTheFontHasItsOwnInk) {
  std::set<std::string> seen;
  std::string signs;
  for (char c = 33; c < 127; ++c) signs += c;
  for (const char c : signs) {
    renderer().begin_frame(40, 40);
    renderer().draw_text(std::string(1, c), {4, 0}, {.size = 32});
    renderer().end_frame();
    const Image picture = renderer().read_pixels();
    std::string ink;
    for (int i = 0; i < 40 * 40; ++i)
      ink += color_at(picture, i % 40, i / 40) > 0x808080 ? '#' : ' ';
    EXPECT_NE(ink.find('#'), std::string::npos) << c;
    EXPECT_TRUE(seen.insert(ink).second) << c;
  }
}

TEST_F(Draw, TextStaysInTheBoxThatWasMeasured) {
  const TextStyle style{.size = 20};
  const Vec2 size = measure_text("Wide jig\n|@gy", style);
  renderer().begin_frame(200, 100);
  renderer().draw_text("Wide jig\n|@gy", {20, 20}, style);
  renderer().end_frame();
  const Image seen = renderer().read_pixels();
  for (int y = 0; y < seen.height; ++y) {
    for (int x = 0; x < seen.width; ++x) {
      const bool inside = x >= 19 && y >= 19 && static_cast<float>(x) <= 21 + size.x &&
                          static_cast<float>(y) <= 21 + size.y;
      if (!inside) {
        ASSERT_EQ(color_at(seen, x, y), 0u) << x << ", " << y;
      }
    }
  }
}

TEST_F(Draw, AnEffectGetsItsUniformsAndTheScene) {
  const Result<Effect> swap = renderer().make_effect(
      "swap",
      "uniform float gain;\nuniform vec4 points[2];\n"
      "void main() { color = vec4(scene_at(pixel).bgr * gain, 1.0) + points[1]; }\n");
  ASSERT_TRUE(swap) << swap.error().message;
  const std::array<float, 8> points = {9, 9, 9, 9, 0, 1, 0, 0};
  const std::array<Uniform, 3> uniforms = {Uniform("gain", 1.0f), Uniform("points", points, 4),
                                           Uniform("unused", Vec2{1, 2})};
  renderer().begin_frame(16, 16);
  renderer().clear(srgb(0xff0000));
  renderer().run_effect(*swap, uniforms, {.area = {0, 0, 8, 16}, .blend = BlendMode::Replace});
  renderer().end_frame();
  const Image seen = renderer().read_pixels();
  EXPECT_EQ(color_at(seen, 3, 8), 0x00ffffu);
  EXPECT_EQ(color_at(seen, 12, 8), 0xff0000u);
}

TEST_F(Draw, ALayerIsDrawnOnceAndShownOften) {
  const Result<Layer> layer = renderer().make_layer(8, 8);
  ASSERT_TRUE(layer);
  renderer().begin_layer(*layer);
  renderer().clear({0, 0, 0, 0});
  renderer().draw_shape(box({-1, -1}, {9, 4}, srgb(0x00ff00)));
  renderer().end_layer();
  renderer().begin_frame(16, 16);
  renderer().clear(srgb(0xff0000));
  renderer().draw_layer(*layer);
  renderer().end_frame();
  const Image seen = renderer().read_pixels();
  EXPECT_EQ(color_at(seen, 8, 2), 0x00ff00u);
  EXPECT_EQ(color_at(seen, 8, 13), 0xff0000u);
}

TEST_F(Draw, NamesTheLineOfABadShader) {
  const Result<Effect> bad = renderer().make_effect("bad", "\nvoid main() { color = nonsense; }\n");
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, ErrorCode::BadContent);
  EXPECT_EQ(bad.error().message.rfind("bad.frag: ", 0), 0u) << bad.error().message;
  EXPECT_NE(bad.error().message.find("2"), std::string::npos) << bad.error().message;
  EXPECT_NE(bad.error().message.find("nonsense"), std::string::npos) << bad.error().message;
}

TEST_F(Draw, OpensAndClosesAHundredTimesWithoutGrowth) {
  const Image picture = noise_picture(200, 200, 5);
  long before = 0;
  for (int i = 0; i < 100; ++i) {
    open({});
    renderer().begin_frame(64, 64);
    renderer().draw_sprite({.image = picture});
    renderer().draw_text("again", {0, 0});
    renderer().end_frame();
    if (i == 30) before = testing::resident_pages();
  }
  EXPECT_LT(testing::resident_pages() - before, 1024) << "pages of 4 KiB in 69 rounds";
}

TEST(DrawWithoutContext, SaysSo) {
  const Result<Renderer> renderer = make_renderer(Window::gl_function);
  ASSERT_FALSE(renderer);
  EXPECT_EQ(renderer.error().code, ErrorCode::Unavailable);
}

}  // namespace
}  // namespace vsprite
