// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/cast_shadow.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "film/extract.h"
#include "support/synthetic_film.h"

namespace vsprite {
namespace {

using testing::Disc;
using testing::SyntheticFilm;

// A disc all over a screen, its soft shadow below it.
struct Walk {
  SyntheticFilm film;
  std::vector<Disc> discs;
  std::vector<Frame> frames;
  ScreenModel screen;

  explicit Walk(double shade, const double (&color)[3] = {70, 90, 165}, double wide = 44) {
    film.shade = shade;
    std::copy(color, color + 3, film.screen);
    for (int i = 0; i < 16; ++i) {
      discs.push_back({58.0 + 57.3 * (i % 4), 48.0 + 31.7 * (5 * i % 16 / 4), wide, 0.68 * wide});
      frames.push_back(film.frame(i, {discs.back()}));
    }
    screen = *measure_screen(frames, {});
  }
  KeyedFrame keyed(std::size_t i) const {
    return Keyer(screen, {.shadow = true}).key(frames[i], nullptr);
  }
};

double shade_of(const KeyedFrame& keyed, int x, int y) {
  const Rect& cells = keyed.shade_cells;
  const int u = x / 2 - cells.x, v = y / 2 - cells.y;
  if (u < 0 || v < 0 || u >= cells.width || v >= cells.height) return 0;
  return keyed.shade[static_cast<std::size_t>(v * cells.width + u)] / 255.0;
}

// Errors of the shade where the subject does not hide it.
struct ShadeError {
  double inside = 0, outside = 0;  // means, where there is shade and where there is none
};

ShadeError error_of(const Walk& walk, std::size_t i) {
  const KeyedFrame keyed = walk.keyed(i);
  ShadeError error;
  int in = 0, out = 0;
  for (int y = 0; y < walk.film.height; ++y)
    for (int x = 0; x < walk.film.width; ++x) {
      if (walk.film.alpha(walk.discs[i], x, y) > 0) continue;
      const double truth = walk.film.shade_at(walk.discs[i], x, y);
      const double off = std::abs(shade_of(keyed, x, y) - truth);
      (truth > 0 ? error.inside : error.outside) += off;
      ++(truth > 0 ? in : out);
    }
  error.inside /= std::max(in, 1);
  error.outside /= std::max(out, 1);
  return error;
}

TEST(CastShadow, IsNearTheKnownShade) {
  for (const double shade : {0.25, 0.5}) {
    const Walk walk(shade);
    for (const std::size_t i : {2u, 8u, 13u}) {
      const ShadeError error = error_of(walk, i);
      EXPECT_LT(error.inside, 0.025) << shade << " frame " << i;
      EXPECT_LT(error.outside, 0.0015) << shade << " frame " << i;
    }
  }
}

// A small one: a broad dark area of a screen without a colour is taken for a part of the subject.
TEST(CastShadow, AGreyFloorWithoutAKeyShowsItToo) {
  const Walk walk(0.4, {150, 150, 148}, 24);
  ASSERT_LT(walk.screen.key, 0);
  EXPECT_LT(error_of(walk, 8).inside, 0.05);
  EXPECT_LT(error_of(walk, 8).outside, 0.0015);
}

TEST(CastShadow, AFilmWithoutOneHasNone) {
  for (const auto& color : {std::array{70.0, 90.0, 165.0}, std::array{150.0, 150.0, 148.0},
                            std::array{40.0, 160.0, 60.0}}) {
    const Walk walk(0, {color[0], color[1], color[2]});
    for (std::size_t i = 0; i < walk.frames.size(); i += 5)
      EXPECT_EQ(walk.keyed(i).shade_cells.width, 0) << color[0] << " frame " << i;
  }
}

// Sum of |alpha - truth|, px.
double matte_error(const Walk& walk, const KeyedFrame& keyed, std::size_t i) {
  double sum = 0;
  for (int y = 0; y < walk.film.height; ++y)
    for (int x = 0; x < walk.film.width; ++x) {
      const int u = x - keyed.crop.x, v = y - keyed.crop.y;
      const bool inside = u >= 0 && v >= 0 && u < keyed.crop.width && v < keyed.crop.height;
      const std::size_t at = static_cast<std::size_t>(4 * (v * keyed.crop.width + u) + 3);
      const double alpha = inside ? keyed.straight.rgba[at] / 255.0 : 0;
      sum += std::abs(alpha - walk.film.alpha(walk.discs[i], x, y));
    }
  return sum;
}

// The matte is the subject's alone: about as near to the truth as that of the same film without a
// shadow, which --shadow hardly changes.
TEST(CastShadow, IsNoPartOfTheMatte) {
  const Walk plain(0), shaded(0.4);
  const KeyedFrame without = Keyer(plain.screen, {}).key(plain.frames[8], nullptr);
  EXPECT_TRUE(without.shade.empty());
  const double due = matte_error(plain, without, 8);
  EXPECT_LT(matte_error(plain, plain.keyed(8), 8), 1.05 * due);
  EXPECT_LT(matte_error(shaded, shaded.keyed(8), 8), 1.3 * due);
}

// Deep behind the subject nothing is known; at its edge the shade goes on under it.
TEST(CastShadow, GoesOnUnderTheEdgeAndNoFurther) {
  const Walk walk(0.4);
  const KeyedFrame keyed = walk.keyed(8);
  const Disc& disc = walk.discs[8];
  const int x = static_cast<int>(disc.x), low = static_cast<int>(disc.y + disc.high);
  EXPECT_EQ(shade_of(keyed, x, static_cast<int>(disc.y)), 0);
  EXPECT_GT(shade_of(keyed, x, low - 1), 0.2);
}

// The cut picture lies anchor on anchor over the sample's, at half its size, whatever that is.
TEST(CastShadow, IsCutToTheScaleOfItsSample) {
  const Walk walk(0.4);
  const KeyedFrame keyed = walk.keyed(8);
  const Blob& blob = keyed.blobs[0];
  for (const double scale : {1.0, 0.37}) {
    SampleRow row;
    row.scale = scale;
    row.anchor_x = blob.anchor_x, row.anchor_y = blob.anchor_y;
    const CutShadow cut = cut_shadow(keyed, blob.label, row);
    double sum = 0, x = 0, y = 0, truth = 0, true_x = 0, true_y = 0;
    for (int v = 0; v < cut.image.height; ++v)
      for (int u = 0; u < cut.image.width; ++u) {
        const double a =
            cut.image.rgba[static_cast<std::size_t>(4 * (v * cut.image.width + u) + 3)];
        const bool border =
            u == 0 || v == 0 || u == cut.image.width - 1 || v == cut.image.height - 1;
        EXPECT_TRUE(!border || a == 0);
        sum += a, x += a * (u + 0.5 - cut.anchor_x), y += a * (v + 0.5 - cut.anchor_y);
      }
    for (int v = 0; v < keyed.shade_cells.height; ++v)
      for (int u = 0; u < keyed.shade_cells.width; ++u) {
        const double a = keyed.shade[static_cast<std::size_t>(v * keyed.shade_cells.width + u)];
        truth += a;
        true_x += a * (2 * (keyed.shade_cells.x + u + 0.5) - row.anchor_x);
        true_y += a * (2 * (keyed.shade_cells.y + v + 0.5) - row.anchor_y);
      }
    EXPECT_NEAR(x / sum * 2 / scale, true_x / truth, 0.3) << scale;
    EXPECT_NEAR(y / sum * 2 / scale, true_y / truth, 0.3) << scale;
    EXPECT_NEAR(sum / (scale * scale) / truth, 1, 0.02) << scale;
    EXPECT_EQ(cut_shadow(keyed, blob.label + 1, row).image.width, 0);
  }
}

}  // namespace
}  // namespace vsprite
