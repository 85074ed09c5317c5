// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "capture/choreography.h"
#include "capture/goldfish.h"
#include "capture/statistics.h"
#include "film/color.h"
#include "film/video.h"
#include "vsprite/image.h"

namespace vsprite::capture {
namespace {

const GoldfishFilm& film() {
  static const GoldfishFilm one;
  return one;
}

const FilmStatistics& statistics() {
  static const FilmStatistics one = measure(film());
  return one;
}

/// Columns in which the fish is more than half there, from the first to the last.
int silhouette_width(const TruthFrame& t) {
  int left = t.width, right = -1;
  for (int y = 0; y < t.height; ++y) {
    for (int x = 0; x < t.width; ++x) {
      if (t.alpha[static_cast<std::size_t>(y * t.width + x)] < 0.5f) continue;
      left = std::min(left, x);
      right = std::max(right, x);
    }
  }
  return right - left + 1;
}

double code_of(double linear) {
  return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

TEST(Capture, AlphaLiesInTheUnitRangeAndSumsToTheArea) {
  TruthFrame t;
  for (const int frame : {100, 1500, 4000}) {
    film().render(frame, t);
    double sum = 0;
    for (const float a : t.alpha) {
      ASSERT_GE(a, 0);
      ASSERT_LE(a, 1);
      sum += a;
    }
    EXPECT_NEAR(sum, t.area, 1e-6 * sum + 1e-9);
    if (!film().bounds(frame).touches_border) {
      EXPECT_GT(sum, 500) << "frame " << frame;
    }
  }
}

// C = alpha F + (1 - alpha) B in linear light, then noise of 2.0 to 2.8 code values and rounding.
TEST(Capture, TheFrameIsItsForegroundOverItsPlate) {
  TruthFrame t;
  film().render(700, t);
  double sum = 0, sum_of_squares = 0, worst = 0;
  for (std::size_t i = 0; i < t.foreground.size(); ++i) {
    const double a = t.alpha[i / 3];
    const double linear = a * t.foreground[i] + (1 - a) * t.plate[i];
    const double error = t.composite.rgba[i / 3 * 4 + i % 3] - code_of(std::min(linear, 1.0));
    sum += error;
    sum_of_squares += error * error;
    worst = std::max(worst, std::abs(error));
  }
  const auto count = static_cast<double>(t.foreground.size());
  EXPECT_NEAR(sum / count, 0, 0.05);
  EXPECT_NEAR(std::sqrt(sum_of_squares / count), 2.4, 0.2);
  EXPECT_LT(worst, 11);  // the noise ends at 3.5 sigma
}

TEST(Capture, AnyFrameAloneIsTheSameAsInTheFilm) {
  TruthFrame in_order, alone;
  for (const int frame : {41, 42}) film().render(frame, in_order);
  GoldfishFilm().render(42, alone);
  EXPECT_EQ(in_order.alpha, alone.alpha);
  EXPECT_EQ(in_order.foreground, alone.foreground);
  EXPECT_EQ(in_order.composite.rgba, alone.composite.rgba);
}

TEST(Capture, EveryHeadingIsTravelledOften) {
  const FilmStatistics& s = statistics();
  EXPECT_GE(s.frames, 3 * 60 * 30);
  EXPECT_GE(s.whole, s.frames * 85 / 100);
  for (std::size_t d = 0; d < s.sector.size(); ++d) {
    EXPECT_GE(s.sector[d], s.whole * 6 / 100) << "direction " << d;
  }
  EXPECT_GE(s.slow, s.whole * 4 / 100);
}

TEST(Capture, EveryHeadingTurnsIntoEveryOther) {
  const FilmStatistics& s = statistics();
  for (std::size_t a = 0; a < 8; ++a) {
    for (std::size_t b = 0; b < 8; ++b) {
      if (a != b) {
        EXPECT_GE(s.turns[a][b], 1) << a << " to " << b;
      }
    }
  }
  EXPECT_GE(s.facing_turns, 40);
  EXPECT_LE(s.fastest_pitch, 8);
}

TEST(Capture, TurnsShowTheFrontalView) {
  TruthFrame before, middle;
  int seen = 0;
  for (int k = 20; k + 20 < film().frame_count() && seen < 6; ++k) {
    const FishPose &a = film().pose(k - 1), &b = film().pose(k);
    const bool turns = (std::cos(a.yaw) > 0) != (std::cos(b.yaw) > 0) && !a.away && !b.away;
    const bool level = std::abs(b.pitch) < 0.3 && std::abs(film().pose(k - 12).pitch) < 0.3;
    if (!turns || !level || film().bounds(k - 12).touches_border) continue;
    film().render(k - 12, before);
    film().render(k, middle);
    EXPECT_LT(silhouette_width(middle), 0.6 * silhouette_width(before)) << "frame " << k;
    EXPECT_LT(std::abs(std::remainder(b.yaw - a.yaw, 2 * std::numbers::pi)), 0.35);
    ++seen;
  }
  EXPECT_GE(seen, 4);
}

TEST(Capture, TheFishMovesAsItsVelocitySays) {
  for (int k = 1; k + 1 < film().frame_count(); ++k) {
    const FishPose &a = film().pose(k - 1), &b = film().pose(k + 1), &p = film().pose(k);
    if (a.away || b.away || p.away) continue;
    ASSERT_NEAR((b.x - a.x) * film().fps() / 2, p.velocity_x, 1e-9) << "frame " << k;
    ASSERT_LT(std::hypot(p.velocity_x, p.velocity_y), 270) << "frame " << k;
    ASSERT_LT(std::abs(p.tail_phase - a.tail_phase), 0.15) << "frame " << k;
  }
}

TEST(Capture, BoundsHoldWhatIsDrawn) {
  TruthFrame t;
  for (const int frame : {300, 2222, 5100}) {
    film().render(frame, t);
    const FishBounds b = film().bounds(frame);
    for (int y = 0; y < t.height; ++y) {
      for (int x = 0; x < t.width; ++x) {
        if (t.alpha[static_cast<std::size_t>(y * t.width + x)] <= 0) continue;
        ASSERT_TRUE(x + 1 > b.left && x < b.right && y + 1 > b.top && y < b.bottom);
      }
    }
  }
}

/// Peak signal to noise of a decoded frame against what went to the encoder, dB.
double psnr(const Frame& decoded, const Image& filmed) {
  const Image image = to_image(decoded);
  double sum = 0;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    const double d = image.rgba[i] - filmed.rgba[i];
    sum += d * d;
  }
  return 10 * std::log10(255.0 * 255 * 0.75 * static_cast<double>(image.rgba.size()) / sum);
}

TEST(Capture, TheBundledFilmIsThisFilm) {
  Result<FilmReader> reader = FilmReader::open(VSPRITE_SOURCE_DIR "/assets/goldfish.mp4");
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(reader->info().fps_numerator, 30 * reader->info().fps_denominator);
  Frame frame;
  TruthFrame truth;
  int frames = 0;
  for (;; ++frames) {
    const Result<bool> more = reader->read(frame);
    ASSERT_TRUE(more) << more.error().message;
    if (!*more) break;
    if (frames % 480 != 7) continue;
    film().render(frames, truth);
    ASSERT_EQ(frame.width, truth.width);
    ASSERT_EQ(frame.height, truth.height);
    EXPECT_GT(psnr(frame, truth.composite), 30) << "frame " << frames;
  }
  EXPECT_EQ(frames, film().frame_count());
}

}  // namespace
}  // namespace vsprite::capture
