// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The four corrections of a matte, each on a film whose subject is known: it does what its name
// says, more of it where it is set higher, and nothing where it is left alone.
#include "film/touch_up.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "film/matte.h"
#include "support/synthetic_film.h"

namespace vsprite {
namespace {

using testing::Disc;
using testing::SyntheticFilm;

// A ball before blue: orange, or a light grey whose rim and a spot in whose middle are tinted.
struct Scene {
  SyntheticFilm film;
  Disc disc{150, 110, 40, 40};
  bool tinted;
  Frame frame;
  ScreenModel screen;

  explicit Scene(bool is_tinted) : tinted(is_tinted) {
    if (tinted) film.subject[0] = film.subject[1] = film.subject[2] = 200;
    std::vector<Frame> frames;
    for (int i = 0; i < 16; ++i) frames.push_back(picture(i, {60.0 + 12 * i, 110, 40, 40}));
    screen = *measure_screen(frames, {});
    frame = picture(40, disc);
  }
  Frame picture(int index, const Disc& ball) const {
    Image image = film.image(index, {ball});
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const double r = std::hypot(x + 0.5 - ball.x, y + 0.5 - ball.y);
        if (tinted && r < 39 && (r > 34 || r < 8))
          image.rgba[static_cast<std::size_t>(4 * (y * image.width + x) + 2)] = 235;
      }
    return to_frame(image, index);
  }
  KeyedFrame key(const MatteConfig& config) const {
    return Keyer(screen, config).key(frame, nullptr);
  }
};

const Scene& scene() {
  static const Scene made(false);
  return made;
}

// R, G, B, alpha at a pixel of the film.
std::array<int, 4> pixel(const KeyedFrame& keyed, int x, int y) {
  x -= keyed.crop.x;
  y -= keyed.crop.y;
  if (x < 0 || y < 0 || x >= keyed.crop.width || y >= keyed.crop.height) return {};
  const std::uint8_t* p = keyed.straight.rgba.data() + 4 * (y * keyed.crop.width + x);
  return {p[0], p[1], p[2], p[3]};
}

// By how much the screen's channel is above the others, summed over the subject, by coverage.
double tint(const KeyedFrame& keyed, double within) {
  double sum = 0;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      if (std::hypot(x + 0.5 - scene().disc.x, y + 0.5 - scene().disc.y) > within) continue;
      const auto [r, g, b, a] = pixel(keyed, x, y);
      sum += std::max(b - std::max(r, g), 0) * a / 255.0;
    }
  return sum;
}

TEST(TouchUp, EdgeMovesByThePixelsAskedFor) {
  const KeyedFrame plain = scene().key({});
  const double radius = std::sqrt(plain.blobs[0].area / std::numbers::pi);
  EXPECT_NEAR(radius, 40, 0.5);
  double before = 0;
  for (const float px : {-8.0f, -4.0f, -2.5f, -1.0f, -0.5f, 0.0f, 0.5f, 1.0f, 2.5f, 4.0f}) {
    const KeyedFrame keyed = scene().key({.edge = px});
    ASSERT_EQ(keyed.blobs.size(), 1u) << px;
    const double now = std::sqrt(keyed.blobs[0].area / std::numbers::pi);
    EXPECT_NEAR(now - radius, px, 0.1 + 0.08 * std::abs(px)) << px;
    EXPECT_GT(now, before) << px;
    before = now;
    EXPECT_NEAR(keyed.blobs[0].anchor_x, 150, 0.3) << px;
    EXPECT_NEAR(keyed.blobs[0].anchor_y, 110, 0.3) << px;
    EXPECT_EQ(keyed.straight.rgba.size(), 4 * keyed.labels.size());
  }
}

TEST(TouchUp, WhatTheEdgeGrowsOverHasTheSubjectsColor) {
  const KeyedFrame plain = scene().key({});
  const KeyedFrame keyed = scene().key({.edge = 4});
  int grown = 0;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      const auto [r, g, b, a] = pixel(keyed, x, y);
      if (a == 0 || pixel(plain, x, y)[3] > 0) continue;
      ++grown;
      EXPECT_NEAR(r, 225, 30) << x << " " << y;
      EXPECT_NEAR(g, 120, 30) << x << " " << y;
      EXPECT_NEAR(b, 40, 50) << x << " " << y;
    }
  EXPECT_GT(grown, 500);
}

TEST(TouchUp, ClipBlackTakesOffWhatIsBelowAndNothingIsMoreThanBefore) {
  const KeyedFrame plain = scene().key({});
  double before = 1e9;
  for (const float black : {0.0f, 0.1f, 0.3f, 0.6f, 0.9f}) {
    const KeyedFrame keyed = scene().key({.clip_black = black});
    ASSERT_EQ(keyed.blobs.size(), 1u);
    EXPECT_LT(keyed.blobs[0].area, before) << black;
    before = keyed.blobs[0].area;
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 320; ++x) {
        const int was = pixel(plain, x, y)[3], is = pixel(keyed, x, y)[3];
        ASSERT_LE(is, was);
        if (was <= 255 * double{black}) {
          ASSERT_EQ(is, 0);
        }
        if (was == 255) {
          ASSERT_EQ(is, 255);
        }
      }
  }
}

TEST(TouchUp, ClipWhiteMakesWholeWhatIsAbove) {
  const KeyedFrame plain = scene().key({});
  double before = 0;
  for (const float white : {1.0f, 0.9f, 0.6f, 0.3f, 0.1f}) {
    const KeyedFrame keyed = scene().key({.clip_white = white});
    ASSERT_EQ(keyed.blobs.size(), 1u);
    EXPECT_GT(keyed.blobs[0].area, before) << white;
    before = keyed.blobs[0].area;
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 320; ++x) {
        const int was = pixel(plain, x, y)[3], is = pixel(keyed, x, y)[3];
        ASSERT_GE(is, was);
        if (was >= 255 * double{white}) {
          ASSERT_EQ(is, 255);
        }
        if (was == 0) {
          ASSERT_EQ(is, 0);
        }
      }
  }
}

// Up to 1 at the rim, where the measured colour has the screen in it; beyond it inside as well.
TEST(TouchUp, DespillTakesTheScreensTintOff) {
  const Scene grey(true);
  double before = 1e9;
  double inside_at_one = 0;
  for (const float despill : {0.0f, 0.5f, 1.0f, 1.5f, 2.0f}) {
    const KeyedFrame keyed = grey.key({.despill = despill});
    const double now = tint(keyed, 60);
    EXPECT_LT(now, before) << despill;
    before = now;
    const double inside = tint(keyed, 10);
    if (despill == 1) inside_at_one = inside;
    if (despill < 1) continue;
    EXPECT_NEAR(inside, inside_at_one * (2 - despill), 0.05 * inside_at_one) << despill;
  }
  EXPECT_GT(inside_at_one, 1000);
  EXPECT_LT(before, 1);
}

// The values at which nothing is asked for, whatever else is.
TEST(TouchUp, NeutralValuesLeaveEveryByte) {
  const KeyedFrame plain = scene().key({});
  const KeyedFrame asked = scene().key({.clip_black = 0, .clip_white = 1, .edge = 0, .despill = 1});
  EXPECT_EQ(plain.straight.rgba, asked.straight.rgba);
  // The way through the corrections itself changes nothing where they come to nothing.
  std::vector<std::uint8_t> ramp(256);
  for (std::size_t i = 0; i < 256; ++i) ramp[i] = static_cast<std::uint8_t>(i);
  auto same = ramp;
  detail::stretch(0, 1, same);
  detail::move_edge(0, 16, 16, 16, same);
  EXPECT_EQ(same, ramp);
}

TEST(TouchUp, TheFilmsBorderIsNoEdge) {
  std::vector<std::uint8_t> alpha(20 * 20, 255);
  detail::move_edge(-5, 20, 20, 20, alpha);
  EXPECT_EQ(alpha, std::vector<std::uint8_t>(20 * 20, 255));
}

}  // namespace
}  // namespace vsprite
