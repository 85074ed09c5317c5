// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/matte.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "support/keyed_alpha.h"
#include "support/synthetic_film.h"

namespace vsprite {
namespace {

using testing::alpha_of;
using testing::Disc;
using testing::SyntheticFilm;

// Sixteen frames of a disc on its way over a blue screen, and the screen measured from them.
struct Scene {
  SyntheticFilm film;
  std::vector<Disc> discs;
  std::vector<Frame> frames;
  ScreenModel screen;

  Scene() {
    for (int i = 0; i < 16; ++i) {
      discs.push_back({70.0 + 11.3 * i, 90.0 + 3.7 * i});
      frames.push_back(film.frame(i, {discs.back()}));
    }
    screen = *measure_screen(frames, {});
  }
};

const Scene& scene() {
  static const Scene made;
  return made;
}

TEST(Matte, IsNearTheKnownMatte) {
  double band = 0;
  double rest = 0;
  int band_count = 0;
  int rest_count = 0;
  for (std::size_t i = 0; i < scene().frames.size(); i += 3) {
    Keyer keyer(scene().screen, {});
    const KeyedFrame keyed = keyer.key(scene().frames[i], nullptr);
    SyntheticFilm wide = scene().film;
    wide.softness += 16;  // 8 px either side of the edge
    for (int y = 0; y < wide.height; ++y)
      for (int x = 0; x < wide.width; ++x) {
        const double truth = scene().film.alpha(scene().discs[i], x, y);
        const double reach = wide.alpha(scene().discs[i], x, y);
        const double error = std::abs(alpha_of(keyed, x, y) / 255.0 - truth);
        const bool near = reach > 0 && reach < 1;
        (near ? band : rest) += error;
        ++(near ? band_count : rest_count);
      }
    ASSERT_EQ(keyed.blobs.size(), 1u);
    EXPECT_NEAR(keyed.blobs[0].anchor_x, scene().discs[i].x, 0.3);
    EXPECT_NEAR(keyed.blobs[0].anchor_y, scene().discs[i].y, 0.3);
  }
  RecordProperty("band_error", std::to_string(band / band_count));
  EXPECT_LT(band / band_count, 0.02);
  EXPECT_LT(rest / rest_count, 0.0005);
}

// The frame with each channel's light times a gain, as an exposure or a white balance that steps.
Frame relit(const Image& image, const double (&gain)[3], int index) {
  Image lit = image;
  for (std::size_t i = 0; i < lit.rgba.size(); ++i)
    if (i % 4 < 3)
      lit.rgba[i] = static_cast<std::uint8_t>(
          SyntheticFilm::code(SyntheticFilm::linear(lit.rgba[i]) * gain[i % 4]) + 0.5);
  return to_frame(lit, index);
}

// Mean |alpha - truth| of a disc within 8 px of its edge.
double band_error(const KeyedFrame& keyed, const SyntheticFilm& film, const Disc& disc) {
  SyntheticFilm wide = film;
  wide.softness += 16;
  double error = 0;
  int count = 0;
  for (int y = 0; y < film.height; ++y)
    for (int x = 0; x < film.width; ++x) {
      const double reach = wide.alpha(disc, x, y);
      if (reach <= 0 || reach >= 1) continue;
      error += std::abs(alpha_of(keyed, x, y) / 255.0 - film.alpha(disc, x, y));
      ++count;
    }
  return error / count;
}

// Half of the film is lit otherwise, in one step: the plate is an average of both, and neither half
// is keyed much worse than a film that is lit as one.
TEST(Matte, FollowsAStepOfExposureAndOfWhiteBalance) {
  const double gains[][3] = {{1.15, 1.15, 1.15}, {0.85, 0.85, 0.85}, {1.08, 1, 0.92},
                             {1.7, 1.7, 1.7},    {0.55, 0.55, 0.55}, {1.3, 1, 0.75}};
  const double plain = band_error(Keyer(scene().screen, {}).key(scene().frames[12], nullptr),
                                  scene().film, scene().discs[12]);
  for (const auto& gain : gains) {
    std::vector<Frame> frames = scene().frames;
    for (std::size_t i = 8; i < frames.size(); ++i)
      frames[i] = relit(scene().film.image(static_cast<int>(i), {scene().discs[i]}), gain,
                        static_cast<int>(i));
    const auto screen = measure_screen(frames, {});
    ASSERT_TRUE(screen) << screen.error().message;
    for (const std::size_t i : {3, 7, 8, 12}) {
      const KeyedFrame keyed = Keyer(*screen, {}).key(frames[i], nullptr);
      ASSERT_EQ(keyed.blobs.size(), 1u) << "frame " << i;
      EXPECT_NEAR(keyed.blobs[0].anchor_x, scene().discs[i].x, 0.4) << "frame " << i;
      EXPECT_LT(band_error(keyed, scene().film, scene().discs[i]), plain + 0.015)
          << "frame " << i << ", gain " << gain[0] << " " << gain[2];
    }
  }
}

// What stands still looks the same in every frame but for the film's noise.
TEST(Matte, DoesNotFlickerAboutWhatStandsStill) {
  std::vector<KeyedFrame> keyed;
  const Disc& disc = scene().discs[6];
  for (int i = 0; i < 6; ++i)
    keyed.push_back(Keyer(scene().screen, {}).key(scene().film.frame(100 + i, {disc}), nullptr));
  double change = 0;
  int count = 0;
  for (std::size_t k = 1; k < keyed.size(); ++k)
    for (int y = 0; y < scene().film.height; ++y)
      for (int x = 0; x < scene().film.width; ++x) {
        const int a = alpha_of(keyed[k - 1], x, y);
        const int b = alpha_of(keyed[k], x, y);
        if ((a == 0 && b == 0) || (a == 255 && b == 255)) continue;
        change += std::abs(a - b) / 255.0;
        ++count;
      }
  ASSERT_GT(count, 0);
  RecordProperty("flicker_of_the_edge", std::to_string(change / count));
  EXPECT_LT(change / count, 0.035);
}

TEST(Matte, KeepsTheSubjectsOwnColor) {
  Keyer keyer(scene().screen, {});
  const KeyedFrame keyed = keyer.key(scene().frames[5], nullptr);
  for (std::size_t i = 0; i < keyed.labels.size(); ++i) {
    const std::uint8_t* p = keyed.straight.rgba.data() + 4 * i;
    if (p[3] < 128) continue;
    ASSERT_NEAR(p[0], 225, 30);
    ASSERT_NEAR(p[1], 120, 30);
    ASSERT_NEAR(p[2], 40, 40) << "the screen's blue is taken out";
  }
}

TEST(Matte, DropsSpecksAndFillsHoles) {
  const Disc& disc = scene().discs[8];
  Image image = scene().film.image(8, {disc});
  const auto put = [&](int x, int y, int r, int g, int b) {
    for (int k = 0; k < 4; ++k) {
      std::uint8_t* p = image.rgba.data() + 4 * ((y + k / 2) * image.width + x + k % 2);
      p[0] = static_cast<std::uint8_t>(r);
      p[1] = static_cast<std::uint8_t>(g);
      p[2] = static_cast<std::uint8_t>(b);
    }
  };
  put(20, 200, 120, 100, 80);
  const int cx = static_cast<int>(disc.x) & ~1;
  const int cy = static_cast<int>(disc.y) & ~1;
  put(cx, cy, 130, 125, 120);
  const Frame frame = to_frame(image, 8);
  Keyer keyer(scene().screen, {});
  const KeyedFrame keyed = keyer.key(frame, nullptr);
  EXPECT_EQ(keyed.blobs.size(), 1u);
  EXPECT_EQ(alpha_of(keyed, 20, 200), 0);
  EXPECT_EQ(alpha_of(keyed, cx, cy), 255);
}

TEST(Matte, EmptyFrameGivesNothing) {
  Keyer keyer(scene().screen, {});
  const KeyedFrame keyed = keyer.key(scene().film.frame(99, {}), nullptr);
  EXPECT_TRUE(keyed.blobs.empty());
  EXPECT_TRUE(keyed.straight.rgba.empty());
}

TEST(Matte, BorderContactIsSeen) {
  Keyer keyer(scene().screen, {});
  const KeyedFrame keyed = keyer.key(scene().film.frame(99, {{20, 120}}), nullptr);
  ASSERT_FALSE(keyed.blobs.empty());
  EXPECT_TRUE(keyed.blobs[0].touches_border);
}

// Lays a wing of a grey of this linear light over what is behind a body, in a rectangle.
void lay_wing(const SyntheticFilm& film, const Disc& body, const Rect& wing, double light,
              double cover, Image& image) {
  for (int v = wing.y; v < wing.y + wing.height; ++v)
    for (int u = wing.x; u < wing.x + wing.width; ++u)
      for (int c = 0; c < 3 && film.alpha(body, u, v) <= 0; ++c) {
        std::uint8_t& p = image.rgba[static_cast<std::size_t>(4 * (v * film.width + u) + c)];
        p = static_cast<std::uint8_t>(
            SyntheticFilm::code(cover * light + (1 - cover) * SyntheticFilm::linear(p)) + 0.5);
      }
}

// An orange body before a green screen with a clear, colourless wing above it: 36 px wide, 30 high,
// its lower edge in the body.
Frame with_a_wing(int index, double x, double cover) {
  SyntheticFilm film;
  film.screen[0] = 70, film.screen[1] = 140, film.screen[2] = 75;
  const Disc body{x, 150, 40, 22};
  Image made = film.image(index, {body});
  lay_wing(film, body, {static_cast<int>(x) - 18, 105, 36, 30}, 0.45, cover, made);
  return to_frame(made, index);
}

TEST(Matte, AColorlessWingOfAColoredBodyIsAsClearAsItIs) {
  std::vector<Frame> frames;
  for (int i = 0; i < 16; ++i) frames.push_back(with_a_wing(i, 60.0 + 12 * i, 0.4));
  const auto screen = measure_screen(frames, {});
  ASSERT_TRUE(screen) << screen.error().message;
  Keyer keyer(*screen, {});
  for (const double cover : {0.25, 0.4, 0.55}) {
    const KeyedFrame keyed = keyer.key(with_a_wing(40, 160, cover), nullptr);
    EXPECT_EQ(alpha_of(keyed, 160, 150), 255);
    double sum = 0;
    for (int v = 109; v < 123; ++v)
      for (int u = 148; u < 172; ++u) sum += alpha_of(keyed, u, v) / 255.0;
    EXPECT_NEAR(sum / (14 * 24), cover, 0.04);
  }
}

// A pale body before black with a wing of its own colour, wider than what is looked at around a
// place.
Frame with_a_pale_wing(int index, double x, double cover) {
  SyntheticFilm film;
  film.noise = 1;
  for (int c = 0; c < 3; ++c) film.screen[c] = 12, film.subject[c] = 205;
  const Disc body{x, 170, 44, 26};
  Image made = film.image(index, {body});
  lay_wing(film, body, {static_cast<int>(x) - 35, 80, 70, 75}, SyntheticFilm::linear(205), cover,
           made);
  return to_frame(made, index);
}

TEST(Matte, AWideFaintWingBeforeBlackIsNotOpaque) {
  std::vector<Frame> frames;
  for (int i = 0; i < 16; ++i) frames.push_back(with_a_pale_wing(i, 60.0 + 12 * i, 0.15));
  const auto screen = measure_screen(frames, {});
  ASSERT_TRUE(screen) << screen.error().message;
  ASSERT_LT(screen->key, 0) << screen->reason;
  const KeyedFrame keyed = Keyer(*screen, {}).key(with_a_pale_wing(40, 160, 0.15), nullptr);
  EXPECT_EQ(alpha_of(keyed, 160, 170), 255);
  double sum = 0;
  for (int v = 90; v < 120; ++v)
    for (int u = 135; u < 185; ++u) sum += alpha_of(keyed, u, v) / 255.0;
  EXPECT_NEAR(sum / (30 * 50), 0.15, 0.05);
}

// A pale body before dark grey with a cloth of 70 x 75 px above it, in folds darker and lighter
// than the screen.
Frame with_a_cloth(int index, double x) {
  SyntheticFilm film;
  film.noise = 1;
  for (int c = 0; c < 3; ++c) film.screen[c] = 62, film.subject[c] = 205;
  const Disc body{x, 170, 44, 26};
  Image made = film.image(index, {body});
  for (int k = 0; k < 70; ++k)
    lay_wing(film, body, {static_cast<int>(x) - 35 + k, 80, 1, 75},
             0.05 + 0.04 * std::sin(0.22 * k), 1, made);
  return to_frame(made, index);
}

TEST(Matte, FoldsAboutTheScreensOwnGreyAreOpaque) {
  std::vector<Frame> frames;
  for (int i = 0; i < 16; ++i) frames.push_back(with_a_cloth(i, 60.0 + 12 * i));
  const auto screen = measure_screen(frames, {});
  ASSERT_TRUE(screen) << screen.error().message;
  ASSERT_LT(screen->key, 0) << screen->reason;
  const KeyedFrame keyed = Keyer(*screen, {}).key(with_a_cloth(40, 160), nullptr);
  for (int v = 95; v < 140; v += 5)
    for (int u = 137; u < 183; ++u) EXPECT_GT(alpha_of(keyed, u, v), 250) << u << ", " << v;
}

// A large pale body before grey with a wing of its own colour above it that is hardly there.
Frame with_a_hint_of_a_wing(int index, double x) {
  SyntheticFilm film;
  film.noise = 1;
  for (int c = 0; c < 3; ++c) film.screen[c] = 128, film.subject[c] = 205;
  const Disc body{x, 165, 50, 40};
  Image made = film.image(index, {body});
  lay_wing(film, body, {static_cast<int>(x) - 30, 90, 60, 60}, SyntheticFilm::linear(205), 0.1,
           made);
  return to_frame(made, index);
}

TEST(Matte, WhatIsFaintButLighterThanAPlainScreenIsNoShadow) {
  std::vector<Frame> frames;
  for (int i = 0; i < 16; ++i) frames.push_back(with_a_hint_of_a_wing(i, 60.0 + 12 * i));
  const auto screen = measure_screen(frames, {});
  ASSERT_TRUE(screen) << screen.error().message;
  ASSERT_LT(screen->key, 0) << screen->reason;
  const KeyedFrame keyed = Keyer(*screen, {}).key(with_a_hint_of_a_wing(40, 160), nullptr);
  double sum = 0;
  for (int v = 95; v < 115; ++v)
    for (int u = 140; u < 180; ++u) sum += alpha_of(keyed, u, v) / 255.0;
  EXPECT_NEAR(sum / (20 * 40), 0.1, 0.04);
}

// A dark subject on a pale floor, at x = 205, and from x = 220 on a wall not much paler than it, in
// which a wider and fainter picture of it shows.
Frame before_a_glossy_wall(int index, double y) {
  SyntheticFilm film;
  film.noise = 1;
  for (int c = 0; c < 3; ++c) film.screen[c] = 140, film.subject[c] = 28;
  Image made = film.image(index, {{205, y, 14, 9}});
  for (int v = 0; v < film.height; ++v)
    for (int x = 220; x < film.width; ++x) {
      const double r = std::hypot((x + 0.5 - 235) / 24, (v + 0.5 - y) / 18);
      const double light = 1 - 0.63 * std::clamp(2 - 2 * r, 0.0, 1.0);
      const double code = SyntheticFilm::code(light * SyntheticFilm::linear(60));
      const auto at = static_cast<std::size_t>(4 * (v * film.width + x));
      std::fill_n(made.rgba.begin() + static_cast<std::ptrdiff_t>(at), 3,
                  static_cast<std::uint8_t>(code + 0.5 + (x * 7 + v * 3 + index) % 3 - 1));
    }
  return to_frame(made, index);
}

TEST(Matte, AReflectionInAWallLikeTheSubjectIsNoneOfIt) {
  std::vector<Frame> frames;
  for (int i = 0; i < 16; ++i) frames.push_back(before_a_glossy_wall(i, 30.0 + 12 * i));
  const auto screen = measure_screen(frames, {.kind = KeyKind::Plate});
  ASSERT_TRUE(screen) << screen.error().message;
  Keyer keyer(*screen, {});
  const KeyedFrame keyed = keyer.key(before_a_glossy_wall(40, 100), nullptr);
  EXPECT_EQ(alpha_of(keyed, 205, 100), 255);
  int most = 0;
  for (int y = 0; y < 240; ++y)
    for (int x = 232; x < 320; ++x) most = std::max(most, alpha_of(keyed, x, y));
  EXPECT_EQ(most, 0);
}

TEST(Matte, SameBytesFromAnyNumberOfThreads) {
  const auto& frames = scene().frames;
  const auto key_all = [&](std::size_t threads) {
    std::vector<KeyedFrame> keyed(frames.size());
    std::vector<std::thread> pool;
    for (std::size_t t = 0; t < threads; ++t)
      pool.emplace_back([&, t] {
        Keyer keyer(scene().screen, {});
        for (std::size_t i = t; i < frames.size(); i += threads)
          keyed[i] = keyer.key(frames[i], i > 0 ? &frames[i - 1] : nullptr);
      });
    for (std::thread& thread : pool) thread.join();
    return keyed;
  };
  const auto once = key_all(1);
  for (const std::size_t threads : {std::size_t{1}, std::size_t{2}, std::size_t{4}}) {
    const auto again = key_all(threads);
    for (std::size_t i = 0; i < once.size(); ++i) {
      EXPECT_EQ(once[i].straight.rgba, again[i].straight.rgba) << i << " of " << threads;
      EXPECT_EQ(once[i].labels, again[i].labels);
      EXPECT_EQ(once[i].blobs[0].anchor_x, again[i].blobs[0].anchor_x);
      EXPECT_EQ(once[i].difference, again[i].difference);
    }
  }
}

TEST(Matte, KeyNoneTakesTheWholeFrame) {
  const auto screen = measure_screen(scene().frames, *parse_key("none"));
  ASSERT_TRUE(screen);
  Keyer keyer(*screen, {});
  const KeyedFrame keyed = keyer.key(scene().frames[0], nullptr);
  ASSERT_EQ(keyed.blobs.size(), 1u);
  EXPECT_EQ(keyed.crop, (Rect{0, 0, 320, 240}));
  EXPECT_FALSE(keyed.blobs[0].touches_border);
  EXPECT_EQ(alpha_of(keyed, 0, 0), 255);
}

}  // namespace
}  // namespace vsprite
