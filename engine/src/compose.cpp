// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Porter & Duff, "Compositing digital images", SIGGRAPH 1984, in linear light. One canvas pixel at
// a time, in float; fast enough for sheets and headless films.
#include "vsprite/compose.h"

#include <algorithm>
#include <cmath>

namespace vsprite {
namespace {

// Colour times coverage and coverage, both 0..1. Colour counts linear light or encoded values.
struct Light {
  float r = 0, g = 0, b = 0, a = 0;
};

float linear_from_premultiplied(unsigned value, unsigned alpha) {
  const unsigned straight =
      alpha == 255 ? value : std::min(255u, (value * 255u + alpha / 2) / alpha);
  return static_cast<float>(linear_from_srgb(static_cast<std::uint8_t>(straight))) * (1 / 65535.0f);
}

// Adds a pixel, weighted.
void accumulate(Light& sum, const std::uint8_t* pixel, float weight, Blend blend) {
  if (pixel[3] == 0) return;
  const float a = static_cast<float>(pixel[3]) * (1 / 255.0f) * weight;
  sum.a += a;
  if (blend == Blend::LinearLight) {
    sum.r += a * linear_from_premultiplied(pixel[0], pixel[3]);
    sum.g += a * linear_from_premultiplied(pixel[1], pixel[3]);
    sum.b += a * linear_from_premultiplied(pixel[2], pixel[3]);
  } else {
    sum.r += weight * static_cast<float>(pixel[0]) / 255.0f;
    sum.g += weight * static_cast<float>(pixel[1]) / 255.0f;
    sum.b += weight * static_cast<float>(pixel[2]) / 255.0f;
  }
}

// 0..1 -> 0..most, to nearest; anything outside is cut off.
unsigned quantised(float value, float most) {
  return static_cast<unsigned>(std::clamp(value, 0.0f, 1.0f) * most + 0.5f);
}

// Linear 0..1 -> encoded 0..255 with its fraction, between the two codes that enclose it.
float encoded_from_linear(float linear) {
  const float l = std::clamp(linear, 0.0f, 1.0f) * 65535.0f;
  const auto near = srgb_from_linear(static_cast<std::uint16_t>(l));
  const auto code = static_cast<std::uint8_t>(linear_from_srgb(near) > l ? near - 1 : near);
  if (code == 255) return 255;
  const auto below = static_cast<float>(linear_from_srgb(code));
  const auto above = static_cast<float>(linear_from_srgb(static_cast<std::uint8_t>(code + 1)));
  return static_cast<float>(code) + (l - below) / (above - below);
}

std::uint8_t store_channel(float colour, float a, unsigned alpha, Blend blend) {
  if (alpha == 255 && blend == Blend::LinearLight) {
    return srgb_from_linear(static_cast<std::uint16_t>(quantised(colour, 65535)));
  }
  const float encoded =
      blend == Blend::Encoded ? colour : encoded_from_linear(colour / a) / 255.0f * a;
  return static_cast<std::uint8_t>(std::min(quantised(encoded, 255), alpha));
}

void store(std::uint8_t* pixel, const Light& light, Blend blend) {
  const unsigned alpha = quantised(light.a, 255);
  if (alpha == 0) {
    std::fill(pixel, pixel + 4, std::uint8_t{0});
    return;
  }
  pixel[0] = store_channel(light.r, light.a, alpha, blend);
  pixel[1] = store_channel(light.g, light.a, alpha, blend);
  pixel[2] = store_channel(light.b, light.a, alpha, blend);
  pixel[3] = static_cast<std::uint8_t>(alpha);
}

// The picture pixels under one canvas pixel along one axis: [first, last], where pixel k weighs
// what it shares with [from, from + width).
struct Footprint {
  int first = 0, last = -1;
  float from = 0, width = 1;

  float weight(int k) const {
    const auto left = static_cast<float>(k);
    return (std::min(left + 1, from + width) - std::max(left, from)) / width;
  }
};

Footprint footprint(int canvas_pixel, double origin, double scale, int count) {
  const double width = std::max(1.0, 1.0 / scale);
  const double from = (canvas_pixel + 0.5 - origin) / scale - width / 2;
  Footprint out{.from = static_cast<float>(from), .width = static_cast<float>(width)};
  out.first = static_cast<int>(std::clamp(std::floor(from), 0.0, static_cast<double>(count)));
  out.last = static_cast<int>(
      std::clamp(std::ceil(from + width) - 1.0, -1.0, static_cast<double>(count) - 1));
  return out;
}

Light sample_picture(const ImageView& picture, const Footprint& across, const Footprint& down,
                     Blend blend) {
  Light sum;
  for (int y = down.first; y <= down.last; ++y) {
    const float row = down.weight(y);
    for (int x = across.first; x <= across.last; ++x) {
      const float weight = row * across.weight(x);
      if (weight > 0) accumulate(sum, picture.pixel(x, y), weight, blend);
    }
  }
  return sum;
}

// The canvas pixels [first, last) that a picture of `count` pixels touches along one axis.
struct Reach {
  int first = 0, last = 0;
};

Reach reach(double origin, double scale, int count, int canvas) {
  const double soft = std::max(1.0, scale) / 2;  // bilinear weights reach half a pixel beyond
  const auto inside = [&](double v) {
    return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(canvas)));
  };
  return {inside(std::floor(origin - soft)), inside(std::ceil(origin + count * scale + soft))};
}

}  // namespace

Image make_image(int width, int height, std::uint8_t r, std::uint8_t g, std::uint8_t b,
                 std::uint8_t a) {
  Image image{width, height,
              std::vector<std::uint8_t>(std::size_t{4} * static_cast<std::size_t>(width) *
                                        static_cast<std::size_t>(height))};
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    image.rgba[i] = r;
    image.rgba[i + 1] = g;
    image.rgba[i + 2] = b;
    image.rgba[i + 3] = a;
  }
  premultiply(image);
  return image;
}

Image make_checkerboard(int width, int height, int cell) {
  constexpr std::uint8_t kLight = 204, kDark = 153;
  Image image = make_image(width, height, kLight, kLight, kLight);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if ((x / cell + y / cell) % 2 == 0) continue;
      std::uint8_t* pixel = image.rgba.data() + (std::ptrdiff_t{y} * width + x) * 4;
      std::fill(pixel, pixel + 3, kDark);
    }
  }
  return image;
}

void draw_picture(Image& canvas, ImageView picture, Vec2 top_left,
                  const DrawOptions& options) noexcept {
  const double scale = options.scale;
  const bool drawable = std::isfinite(top_left.x) && std::isfinite(top_left.y) &&
                        std::isfinite(scale) && scale > 0 && picture.width > 0 &&
                        picture.height > 0;
  if (!drawable) return;
  const float opacity = std::clamp(options.opacity, 0.0f, 1.0f);
  const Reach columns = reach(top_left.x, scale, picture.width, canvas.width);
  const Reach rows = reach(top_left.y, scale, picture.height, canvas.height);
  for (int y = rows.first; y < rows.last; ++y) {
    const Footprint down = footprint(y, top_left.y, scale, picture.height);
    for (int x = columns.first; x < columns.last; ++x) {
      const Footprint across = footprint(x, top_left.x, scale, picture.width);
      const Light over = sample_picture(picture, across, down, options.blend);
      const float a = over.a * opacity;
      if (a <= 0) continue;
      std::uint8_t* pixel = canvas.rgba.data() + (std::ptrdiff_t{y} * canvas.width + x) * 4;
      Light under;
      accumulate(under, pixel, 1, options.blend);
      const float rest = 1 - a;
      store(pixel,
            {over.r * opacity + rest * under.r, over.g * opacity + rest * under.g,
             over.b * opacity + rest * under.b, a + rest * under.a},
            options.blend);
    }
  }
}

void draw_sample(Image& canvas, ImageView picture, const Sample& sample, Vec2 position,
                 const DrawOptions& options) noexcept {
  const Vec2 top_left{position.x - sample.anchor.x * options.scale,
                      position.y - sample.anchor.y * options.scale};
  draw_picture(canvas, picture, top_left, options);
}

}  // namespace vsprite
