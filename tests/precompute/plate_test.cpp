// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/plate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "film/silhouette.h"
#include "support/synthetic_film.h"

namespace vsprite {
namespace {

using testing::Disc;
using testing::SyntheticFilm;

std::vector<Frame> crossing(const SyntheticFilm& scene, int count = 16) {
  std::vector<Frame> frames;
  for (int i = 0; i < count; ++i) frames.push_back(scene.frame(i, {{60.0 + 12 * i, 90.0 + 4 * i}}));
  return frames;
}

double mean_plate_error(const SyntheticFilm& scene, const ScreenModel& screen) {
  double sum = 0;
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      const auto rgb = rgb_at(screen.plate, x, y);
      for (std::size_t c = 0; c < 3; ++c)
        sum += std::abs(rgb[c] - scene.plate(static_cast<int>(c), x, y));
    }
  return sum / (3.0 * scene.width * scene.height);
}

TEST(Plate, ParsesTheKey) {
  EXPECT_EQ(parse_key("auto")->kind, KeyKind::Auto);
  EXPECT_EQ(parse_key("plate")->kind, KeyKind::Plate);
  EXPECT_EQ(parse_key("none")->kind, KeyKind::None);
  const auto color = parse_key("#12aBf0");
  ASSERT_TRUE(color);
  EXPECT_EQ(color->red, 0x12);
  EXPECT_EQ(color->green, 0xAB);
  EXPECT_EQ(color->blue, 0xF0);
  for (const char* bad : {"", "green", "#12345", "#12345G", "#1234567"})
    EXPECT_EQ(parse_key(bad).error().code, ErrorCode::BadSetting) << bad;
}

TEST(Plate, FindsTheUnevenBlueScreen) {
  const SyntheticFilm scene;
  const auto screen = measure_screen(crossing(scene), {});
  ASSERT_TRUE(screen) << screen.error().message;
  EXPECT_EQ(screen->kind, KeyKind::Color);
  EXPECT_EQ(screen->key, 2) << screen->reason;
  EXPECT_LT(mean_plate_error(scene, *screen), 0.6);
}

// A phone that lets more light in: what lies between two exposures is neither's screen.
TEST(Plate, IsThatOfTheMostUsualExposure) {
  const SyntheticFilm scene;
  std::vector<Frame> frames = crossing(scene, 20);
  for (std::size_t f = 12; f < frames.size(); ++f)
    for (std::uint8_t& y : frames[f].y) y = static_cast<std::uint8_t>(std::min(y + 34, 235));
  const auto screen = measure_screen(frames, {});
  ASSERT_TRUE(screen) << screen.error().message;
  EXPECT_EQ(screen->kind, KeyKind::Color);
  EXPECT_LT(mean_plate_error(scene, *screen), 0.8);
  const auto drift = detail::fit_drift(*screen, frames.back(), screen->threshold);
  for (int p = 0; p < 3; ++p) EXPECT_NEAR(drift.at(p, 0, 0), 34 * 255.0 / 219, 1.5);
}

// The prior of the screen's colour: a plain temporal median would show the subject.
TEST(Plate, SeesBehindASubjectThatRests) {
  const SyntheticFilm scene;
  std::vector<Frame> frames;
  for (int i = 0; i < 16; ++i)
    frames.push_back(scene.frame(i, {i < 12 ? Disc{160, 120} : Disc{60.0 + 4 * i, 60}}));
  const auto screen = measure_screen(frames, {});
  ASSERT_TRUE(screen) << screen.error().message;
  EXPECT_LT(mean_plate_error(scene, *screen), 0.8);
}

// The spread of all samples is then that of the subject, and says nothing of the screen.
TEST(Plate, KeepsOutASubjectThatFillsMoreThanHalfOfThePicture) {
  const SyntheticFilm scene;
  std::vector<Frame> frames;
  for (int i = 0; i < 16; ++i) {
    const Disc disc{100.0 + i, 150, 150, 110};
    Image image = scene.image(i, {disc});
    // Of many colours: the most frequent one is the screen's.
    for (int y = 0; y < scene.height; ++y)
      for (int x = 0; x < scene.width; ++x) {
        if (scene.alpha(disc, x, y) < 1) continue;
        std::uint8_t* p = image.rgba.data() + 4 * (y * scene.width + x);
        p[0] = static_cast<std::uint8_t>(110 + 40 * ((x + y) / 16 % 3));
        p[1] = static_cast<std::uint8_t>(80 + 35 * (x / 16 % 3));
        p[2] = static_cast<std::uint8_t>(50 + 30 * (y / 16 % 3));
      }
    frames.push_back(to_frame(image, i));
  }
  const auto screen = measure_screen(frames, {});
  ASSERT_TRUE(screen) << screen.error().message;
  EXPECT_LT(mean_plate_error(scene, *screen), 3);
}

// Stripes of many colours behind everything: no single screen.
std::array<int, 3> stripes(int x, int y) {
  const int stripe = x / 16 * 37 % 160;
  return {60 + y / 30 * 20, 200 - stripe, 40 + stripe};
}

Frame before_stripes(const SyntheticFilm& scene, int index, const Disc& disc) {
  Image image = scene.image(index, {disc});
  std::uint32_t state = 99u + 31u * static_cast<std::uint32_t>(index);
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      if (scene.alpha(disc, x, y) > 0.5) continue;
      state = state * 1664525u + 1013904223u;
      const auto rgb = stripes(x, y);
      for (std::size_t c = 0; c < 3; ++c)
        image.rgba[static_cast<std::size_t>(4 * (y * scene.width + x)) + c] =
            static_cast<std::uint8_t>(rgb[c] + static_cast<int>(state >> 30) - 1);
    }
  return to_frame(image, index);
}

// Mean over a square about a place, of all channels, of |plate - stripes|.
double stripes_error(const ScreenModel& screen, int cx, int cy, int radius) {
  double sum = 0;
  for (int y = cy - radius; y <= cy + radius; ++y)
    for (int x = cx - radius; x <= cx + radius; ++x) {
      const auto rgb = rgb_at(screen.plate, x, y);
      const auto truth = stripes(x, y);
      for (std::size_t c = 0; c < 3; ++c) sum += std::abs(rgb[c] - truth[c]);
    }
  return sum / (3.0 * (2 * radius + 1) * (2 * radius + 1));
}

TEST(Plate, TakesAStandingCameraForAPlate) {
  const SyntheticFilm scene;
  std::vector<Frame> frames;
  for (int i = 0; i < 16; ++i)
    frames.push_back(before_stripes(scene, i, {60.0 + 12 * i, 90.0 + 4 * i}));
  const auto screen = measure_screen(frames, {});
  ASSERT_TRUE(screen) << screen.error().message;
  EXPECT_EQ(screen->kind, KeyKind::Plate) << screen->reason;
}

// No colour to go by: the median over time would show the subject.
TEST(Plate, SeesBehindASubjectThatRestsBeforeAPlainPlate) {
  const SyntheticFilm scene;
  std::vector<Frame> frames;
  for (int i = 0; i < 16; ++i)
    frames.push_back(before_stripes(scene, i, i % 3 ? Disc{160, 120} : Disc{60.0 + 4 * i, 60}));
  const auto screen = measure_screen(frames, {});
  ASSERT_TRUE(screen) << screen.error().message;
  EXPECT_EQ(screen->kind, KeyKind::Plate) << screen->reason;
  EXPECT_LT(stripes_error(*screen, 160, 120, 12), 8);
}

// Light plays on it, so it is not a part of the plate: what lies behind is made up, unlike it.
TEST(Plate, DoesNotTakeWhatIsNeverGoneForThePlate) {
  SyntheticFilm scene;
  std::vector<Frame> frames;
  for (int i = 0; i < 16; ++i) {
    scene.subject[0] = 225 + 8 * std::sin(1.7 * i);
    scene.subject[1] = 120 + 8 * std::sin(1.7 * i);
    frames.push_back(before_stripes(scene, i, {160 + 12 * std::sin(0.9 * i), 120}));
  }
  const auto screen = measure_screen(frames, {});
  ASSERT_TRUE(screen) << screen.error().message;
  const auto rgb = rgb_at(screen->plate, 160, 120);
  EXPECT_GT(std::abs(rgb[0] - 225) + std::abs(rgb[1] - 120) + std::abs(rgb[2] - 40), 60);
  EXPECT_GT(screen->hidden, 0);
}

TEST(Plate, RefusesAFilmWithoutABackground) {
  std::vector<Frame> frames;
  std::uint32_t state = 7;
  for (int i = 0; i < 12; ++i) {
    Image image{160, 120, std::vector<std::uint8_t>(4 * 160 * 120)};
    for (int y = 0; y < 120; y += 8)
      for (int x = 0; x < 160; x += 8) {
        state = state * 1664525u + 1013904223u;
        for (int k = 0; k < 64; ++k)
          for (int c = 0; c < 3; ++c)
            image.rgba[static_cast<std::size_t>(4 * ((y + k / 8) * 160 + x + k % 8) + c)] =
                static_cast<std::uint8_t>(state >> (8 * c));
      }
    frames.push_back(to_frame(image, i));
  }
  const auto screen = measure_screen(frames, {});
  ASSERT_FALSE(screen) << screen->reason;
  EXPECT_EQ(screen.error().code, ErrorCode::BadContent);
}

}  // namespace
}  // namespace vsprite
