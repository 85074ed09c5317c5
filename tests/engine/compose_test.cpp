// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/compose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "blend_rows.h"
#include "srgb_tables.h"

namespace vsprite {
namespace {

Image random_picture(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Image image = make_image(width, height, 0, 0, 0, 0);
  for (auto& byte : image.rgba) byte = static_cast<std::uint8_t>(random() >> 24);
  premultiply(image);
  return image;
}

// The naive reference: straight colour and alpha of a pixel in double, transparent outside.
struct Straight {
  double colour = 0, alpha = 0;
};

double decode(double e, Blend blend) {
  if (blend == Blend::Encoded) return e;
  return e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
}
double encode(double l, Blend blend) {
  if (blend == Blend::Encoded) return l;
  return l <= 0.0031308 ? l * 12.92 : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
}

Straight straight_pixel(const Image& image, int x, int y, int channel, Blend blend) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return {};
  const std::uint8_t* p = ImageView(image).pixel(x, y);
  if (p[3] == 0) return {};
  const double encoded = blend == Blend::Encoded
                             ? double(p[channel]) / p[3]
                             : std::floor(255.0 * p[channel] / p[3] + 0.5) / 255;
  return {decode(encoded, blend), p[3] / 255.0};
}

// Bilinear interpolation of premultiplied light, then over, as the header writes it.
double reference(const Image& canvas, const Image& picture, Vec2 at, int x, int y, int channel,
                 Blend blend, double opacity = 1) {
  const double u = x - double{at.x}, v = y - double{at.y};
  const int x0 = static_cast<int>(std::floor(u)), y0 = static_cast<int>(std::floor(v));
  double light = 0, a = 0;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const double w = opacity * (i ? u - x0 : 1 - (u - x0)) * (j ? v - y0 : 1 - (v - y0));
      const Straight tap = straight_pixel(picture, x0 + i, y0 + j, channel, blend);
      light += w * tap.alpha * tap.colour;
      a += w * tap.alpha;
    }
  }
  const Straight under = straight_pixel(canvas, x, y, channel, blend);
  const double out_a = a + (1 - a) * under.alpha;
  if (channel == 3) return 255 * out_a;
  if (out_a == 0) return 0;
  return 255 * out_a * encode((light + (1 - a) * under.alpha * under.colour) / out_a, blend);
}

TEST(Compose, OverIsTheNaiveReferenceWithinOneStep) {
  for (Blend blend : {Blend::LinearLight, Blend::Encoded}) {
    for (Vec2 at : {Vec2{3, 2}, Vec2{2.25f, 3.75f}, Vec2{-4.5f, -2.125f}, Vec2{20.5f, 10}}) {
      const Image picture = random_picture(9, 7, 1);
      const Image before = random_picture(24, 16, 2);
      Image canvas = before;
      draw_picture(canvas, picture, at, {.blend = blend});
      for (int y = 0; y < canvas.height; ++y) {
        for (int x = 0; x < canvas.width; ++x) {
          for (int c = 0; c < 4; ++c) {
            const double due = reference(before, picture, at, x, y, c, blend);
            ASSERT_NEAR(ImageView(canvas).pixel(x, y)[c], due, 1)
                << x << "," << y << " channel " << c;
          }
        }
      }
    }
  }
}

// Clear, opaque and soft runs of random length: what the vector paths tell apart.
Image matte_of_runs(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Image image = random_picture(width, height, seed + 1);
  unsigned left = 0, kind = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4, --left) {
    if (left == 0) {
      kind = static_cast<unsigned>(random() % 3);
      left = 1 + static_cast<unsigned>(random() % 40);
    }
    if (kind == 0) std::fill_n(&image.rgba[i], 4, std::uint8_t{0});
    if (kind == 1) image.rgba[i + 3] = 255;
  }
  return image;
}

TEST(Compose, RunsOfEveryLengthAreTheNaiveReference) {
  for (int round = 0; round < 48; ++round) {
    const Blend blend = round % 2 == 0 ? Blend::LinearLight : Blend::Encoded;
    const Image picture = matte_of_runs(1 + round * 13, 5, static_cast<unsigned>(round));
    Image before = random_picture(600, 12, 77);
    for (std::size_t i = 3; i < before.rgba.size(); i += 4) {
      if (i % 52 != 3) before.rgba[i] = 255;  // here and there not opaque
    }
    const Vec2 at{static_cast<float>(round % 7) * 0.25f - 20 + static_cast<float>(round),
                  static_cast<float>(round % 3) * 0.5f + 2};
    const float opacity = round % 5 == 0 ? 0.5f : 1.0f;
    Image canvas = before;
    draw_picture(canvas, picture, at, {.blend = blend, .opacity = opacity});
    for (int k = 0; k < canvas.width * canvas.height * 4; ++k) {
      const int x = k / 4 % canvas.width, y = k / 4 / canvas.width, c = k % 4;
      const double due = reference(before, picture, at, x, y, c, blend, double{opacity});
      ASSERT_NEAR(canvas.rgba[static_cast<std::size_t>(k)], due, 1)
          << "round " << round << " at " << x << "," << y << " channel " << c;
    }
  }
}

// Whatever the lanes of this CPU, the numbers are those of one pixel after the other by the tables.
TEST(Compose, LinesInLinearLightAreThoseOfTheTables) {
  constexpr std::size_t kCount = 5003;
  const Image picture = matte_of_runs(kCount, 1, 3);
  const Image ground = random_picture(kCount, 1, 4);
  std::vector<detail::Deep> deep(4 * kCount);
  detail::to_deep(picture.rgba.data(), deep.data(), kCount);
  Image canvas = ground;
  for (std::size_t i = 3; i < canvas.rgba.size(); i += 4) canvas.rgba[i] = 255;
  Image due = canvas;
  for (std::size_t i = 0; i < 4 * kCount; ++i) {
    const unsigned value = picture.rgba[i], alpha = picture.rgba[i | 3];
    const unsigned light = i % 4 == 3     ? 257 * alpha
                           : alpha == 255 ? detail::kLight[value]
                                          : detail::kPremultipliedLinear[alpha << 8 | value];
    ASSERT_EQ(deep[i], light) << i;
    if (i % 4 == 3 || alpha == 0) continue;
    const unsigned under = detail::kLight[canvas.rgba[i]] * (65535 - 257 * alpha) >> 16;
    const unsigned sum = std::min(65535u, light + under);
    due.rgba[i] = detail::kShortEncoded[detail::short_index(sum)];
  }
  ASSERT_EQ(detail::over_deep(canvas.rgba.data(), deep.data(), kCount), kCount);
  EXPECT_EQ(canvas.rgba, due.rgba);
  canvas.rgba[4 * 4001 + 3] =
      254;  // stops where the canvas is not opaque, and the picture is there
  deep[4 * 4001 + 3] = 1;
  EXPECT_EQ(detail::over_deep(canvas.rgba.data(), deep.data(), kCount), 4001u);
}

TEST(Compose, TheShortTablesAreWithinATenthOfACode) {
  for (unsigned code = 0; code < 256; ++code) {
    const unsigned light = detail::kLinear[code];
    const unsigned step = code < 255 ? detail::kLinear[code + 1] - light : 600u;
    EXPECT_NEAR(detail::kLight[code], light, 0.1 * step + 0.5) << code;
    for (const unsigned near : {light, unsigned{detail::kLight[code]}})
      EXPECT_EQ(detail::kShortEncoded[detail::short_index(near)], code);
  }
}

TEST(Compose, OpaqueReplacesAndTransparentLeavesAlone) {
  const Image before = random_picture(8, 8, 3);
  Image canvas = before;
  draw_picture(canvas, make_image(8, 8, 9, 9, 9, 0), {0, 0});
  EXPECT_EQ(canvas.rgba, before.rgba);
  draw_picture(canvas, random_picture(8, 8, 4), {0, 0}, {.opacity = 0});
  EXPECT_EQ(canvas.rgba, before.rgba);
  Image opaque = random_picture(8, 8, 5);
  unpremultiply(opaque);
  for (std::size_t i = 3; i < opaque.rgba.size(); i += 4) opaque.rgba[i] = 255;
  draw_picture(canvas, opaque, {0, 0});
  EXPECT_EQ(canvas.rgba, opaque.rgba);
}

// Half coverage of white over black is half the light, which is encoded as 188, not 128.
TEST(Compose, HalfCoverageIsHalfTheLight) {
  Image canvas = make_image(1, 1, 0, 0, 0);
  draw_picture(canvas, make_image(1, 1, 255, 255, 255, 128), {0, 0});
  EXPECT_NEAR(canvas.rgba[0], 188, 1);
  canvas = make_image(1, 1, 0, 0, 0);
  draw_picture(canvas, make_image(1, 1, 255, 255, 255, 128), {0, 0}, {.blend = Blend::Encoded});
  EXPECT_EQ(canvas.rgba[0], 128);
}

TEST(Compose, AnyScaleKeepsTheCoverage) {
  for (float scale : {0.1f, 0.37f, 0.5f, 1.0f, 1.7f, 4.0f}) {
    Image canvas = make_image(100, 100, 0, 0, 0, 0);
    draw_picture(canvas, make_image(20, 20, 200, 100, 50), {9.3f, 5.8f}, {.scale = scale});
    double sum = 0;
    for (std::size_t i = 3; i < canvas.rgba.size(); i += 4) sum += canvas.rgba[i] / 255.0;
    EXPECT_NEAR(sum, 400 * scale * scale, 0.01 * 400 * scale * scale + 0.1) << scale;
  }
}

TEST(Compose, AFlatColourStaysThatColourAtAnyScale) {
  for (float scale : {0.3f, 1.0f, 2.5f}) {
    Image canvas = make_image(60, 60, 0, 0, 0, 0);
    draw_picture(canvas, make_image(20, 20, 200, 100, 50), {0.4f, 0.7f}, {.scale = scale});
    unpremultiply(canvas);
    for (std::size_t i = 0; i < canvas.rgba.size(); i += 4) {
      if (canvas.rgba[i + 3] < 128) continue;
      ASSERT_NEAR(canvas.rgba[i], 200, 1);
      ASSERT_NEAR(canvas.rgba[i + 1], 100, 1);
    }
  }
}

TEST(Compose, TheAnchorLiesAtThePosition) {
  Sample sample;
  sample.anchor = {1.5f, 0.5f};
  Image canvas = make_image(9, 9, 0, 0, 0);
  Image dot = make_image(3, 1, 0, 0, 0, 0);
  std::fill(dot.rgba.begin() + 4, dot.rgba.begin() + 8, std::uint8_t{255});
  draw_sample(canvas, dot, sample, {4.5f, 6.5f});
  EXPECT_EQ(ImageView(canvas).pixel(4, 6)[0], 255);
  EXPECT_EQ(ImageView(canvas).pixel(3, 6)[0], 0);
  draw_sample(canvas, dot, sample, {1.5f, 1.5f}, {.scale = 3});
  EXPECT_EQ(ImageView(canvas).pixel(1, 1)[0], 255);
}

TEST(Compose, PlacesBeyondReasonDrawNothing) {
  const float inf = std::numeric_limits<float>::infinity();
  const Image before = make_checkerboard(16, 16);
  Image canvas = before;
  const Image picture = make_image(4, 4, 1, 2, 3);
  for (float bad : {inf, -inf, std::nanf(""), 1e30f, -1e30f})
    draw_picture(canvas, picture, {bad, 0});
  for (float scale : {0.0f, -1.0f, std::nanf(""), inf})
    draw_picture(canvas, picture, {0, 0}, {.scale = scale});
  draw_picture(canvas, Image{}, {0, 0});
  Image none;
  draw_picture(none, picture, {0, 0});
  EXPECT_EQ(canvas.rgba, before.rgba);
}

TEST(Compose, AShadowKeepsTheAreaOfThePictureAndIsEvenAboutIt) {
  const Image picture = make_image(40, 24, 10, 200, 30);
  for (const float blur : {0.0f, 1.0f, 3.0f, 8.0f, 40.0f, 64.0f}) {
    const SoftShadow shadow = make_shadow(picture, blur);
    double area = 0, x_mean = 0;
    const ImageView view(shadow.image);
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        const std::uint8_t* p = view.pixel(x, y);
        EXPECT_EQ(p[0], p[3]);
        area += p[3] / 255.0;
        x_mean += p[3] / 255.0 * (x + 0.5);
      }
    }
    const double scale = double{shadow.scale};
    EXPECT_NEAR(area * scale * scale, 40 * 24, 40 * 24 * 0.03) << blur;
    EXPECT_NEAR(x_mean / area * scale + double{shadow.corner.x}, 20, 0.3) << blur;
  }
}

TEST(Compose, AShadowOfNothingIsNothing) {
  EXPECT_EQ(make_shadow({}, 6).image.width, 0);
  const SoftShadow clear = make_shadow(make_image(9, 9, 0, 0, 0, 0), 6);
  for (const std::uint8_t v : clear.image.rgba) EXPECT_EQ(v, 0);
  EXPECT_GT(make_shadow(make_image(1, 1, 0, 0, 0), 1e9f).image.width, 0);
}

TEST(Compose, CheckerboardAlternates) {
  const Image board = make_checkerboard(32, 16, 8);
  EXPECT_NE(ImageView(board).pixel(7, 7)[0], ImageView(board).pixel(8, 7)[0]);
  EXPECT_EQ(ImageView(board).pixel(0, 0)[0], ImageView(board).pixel(8, 8)[0]);
}

}  // namespace
}  // namespace vsprite
