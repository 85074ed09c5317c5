// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Porter & Duff, "Compositing digital images", SIGGRAPH 1984, in linear light. Pictures at their
// own size go by rows, in integers (blend_rows.h); enlarged and reduced ones, and pixels of a
// canvas that is not opaque, one at a time in float: fast enough for sheets and headless films.
#include "vsprite/compose.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "blend_rows.h"

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

// The canvas pixel under `over`.
void put_over(std::uint8_t* pixel, const Light& over, Blend blend) {
  Light under;
  accumulate(under, pixel, 1, blend);
  const float rest = 1 - over.a;
  store(pixel,
        {over.r + rest * under.r, over.g + rest * under.g, over.b + rest * under.b,
         over.a + rest * under.a},
        blend);
}

void draw_scaled(Image& canvas, ImageView picture, Vec2 top_left, const DrawOptions& options) {
  const double scale = options.scale;
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
      put_over(pixel, {over.r * opacity, over.g * opacity, over.b * opacity, a}, options.blend);
    }
  }
}

// One axis of a picture at a place between pixels, in 1/256: canvas pixel `first` + i lies between
// the picture's pixels i - 1, which weighs `left`, and i.
struct Place {
  int first = 0, count = 0;
  std::uint16_t left = 0;
};

Place place_of(float top_left, int picture, int beyond) {
  const auto fixed = static_cast<int>(std::lround(double{top_left} * 256));
  Place out{fixed >> 8, picture, static_cast<std::uint16_t>(fixed & 255)};
  if (out.left != 0) out.count += beyond;
  return out;
}

constexpr int kChunk = 256;                       // pixels of a row that are worked on at a time
constexpr std::size_t kRoom = 4 * (kChunk + 32);  // with what a vector may read and write beyond

// The picture's pixels [from - 1, from + count) of row `y`, clear ones outside.
void take_row(const ImageView& picture, int y, int from, int count, std::uint8_t* out) {
  const int left = from - 1;
  const int first = std::max(left, 0);
  const int last = std::min(from + count, picture.width);
  if (y < 0 || y >= picture.height || first >= last) {
    std::memset(out, 0, 4 * static_cast<std::size_t>(count + 1));
    return;
  }
  if (first > left) std::memset(out, 0, 4);
  std::memcpy(out + 4 * (first - left), picture.pixel(first, y),
              4 * static_cast<std::size_t>(last - first));
  if (last < from + count) std::memset(out + 4 * (last - left), 0, 4);
}

void put_deep(std::uint8_t* canvas, const detail::Deep* over, std::size_t count) {
  for (std::size_t done = 0; done < count; ++done) {
    done += detail::over_deep(canvas + 4 * done, over + 4 * done, count - done);
    if (done == count) return;
    const detail::Deep* p = over + 4 * done;  // the canvas is not opaque here
    const auto part = [](detail::Deep v) { return static_cast<float>(v) * (1 / 65535.0f); };
    put_over(canvas + 4 * done, {part(p[0]), part(p[1]), part(p[2]), part(p[3])},
             Blend::LinearLight);
  }
}

void put_linear(std::uint8_t* canvas, const std::uint8_t* over, std::size_t count) {
  for (std::size_t done = 0; done < count; ++done) {
    done += detail::over_linear(canvas + 4 * done, over + 4 * done, count - done);
    if (done == count) return;
    Light light;
    accumulate(light, over + 4 * done, 1, Blend::LinearLight);
    if (light.a > 0) put_over(canvas + 4 * done, light, Blend::LinearLight);
  }
}

// What draw_unscaled needs for a column of at most kChunk canvas pixels.
struct Column {
  int from = 0;           // picture pixel under the first canvas pixel
  std::size_t count = 0;  // canvas pixels
  detail::Between between;
  std::uint16_t opacity = 256;
};

constexpr int kBand = 16;  // rows that are made ready at a time
constexpr int kAhead = 4;  // rows of the canvas that are on their way

void draw_column_encoded(std::uint8_t* canvas, std::ptrdiff_t stride, const ImageView& picture,
                         int first_row, int rows, const Column& column) {
  alignas(64) std::uint8_t band[kBand + 1][kRoom];
  for (int done = 0; done < rows; done += kBand) {
    const int here = std::min(kBand, rows - done);
    for (int r = 0; r <= here; ++r) {
      take_row(picture, first_row + done + r - 1, column.from, static_cast<int>(column.count),
               band[r]);
    }
    detail::over_between({canvas + done * stride, stride}, {band[0], kRoom}, column.between,
                         column.opacity, column.count, static_cast<std::size_t>(here));
  }
}

void draw_column_linear(std::uint8_t* canvas, std::ptrdiff_t stride, const ImageView& picture,
                        int first_row, int rows, const Column& column) {
  alignas(64) std::uint8_t bytes[kRoom];
  alignas(64) detail::Deep deep[2][kRoom], mixed[kRoom];
  const auto take = [&](int y, int slot) {
    take_row(picture, y, column.from, static_cast<int>(column.count), bytes);
    detail::to_deep(bytes, deep[slot], column.count + 1);
  };
  if (column.between.above != 0) take(first_row - 1, 1);
  for (int r = 0; r < rows; ++r, canvas += stride) {
    const int slot = r & 1;
    if (rows - r > kAhead) detail::prefetch(canvas + kAhead * stride, column.count);
    take(first_row + r, slot);
    detail::between_deep(deep[1 - slot], deep[slot], column.between, column.opacity, mixed,
                         column.count);
    put_deep(canvas, mixed, column.count);
  }
}

void draw_unscaled(Image& canvas, const ImageView& picture, Vec2 top_left,
                   const DrawOptions& options) {
  const auto opacity =
      static_cast<std::uint16_t>(std::lround(std::clamp(options.opacity, 0.0f, 1.0f) * 256));
  if (opacity == 0) return;
  const Place across = place_of(top_left.x, picture.width, 1);
  const Place down = place_of(top_left.y, picture.height, 1);
  const int x0 = std::max(across.first, 0), y0 = std::max(down.first, 0);
  const int x1 = std::min(across.first + across.count, canvas.width);
  const int y1 = std::min(down.first + down.count, canvas.height);
  if (x0 >= x1 || y0 >= y1) return;
  const std::ptrdiff_t stride = 4 * std::ptrdiff_t{canvas.width};
  const auto at = [&](int x, int y) {
    return canvas.rgba.data() + y * stride + 4 * std::ptrdiff_t{x};
  };
  const bool linear = options.blend == Blend::LinearLight;
  if (across.left == 0 && down.left == 0 && opacity == 256) {
    const auto count = static_cast<std::size_t>(x1 - x0);
    const int left = x0 - across.first;
    if (!linear) {
      detail::over_encoded({at(x0, y0), stride},
                           {picture.pixel(left, y0 - down.first), picture.stride}, count,
                           static_cast<std::size_t>(y1 - y0));
      return;
    }
    for (int y = y0; y < y1; ++y) {
      if (y1 - y > kAhead) detail::prefetch(at(x0, y + kAhead), count);
      put_linear(at(x0, y), picture.pixel(left, y - down.first), count);
    }
    return;
  }
  for (int x = x0; x < x1; x += kChunk) {
    const Column column{x - across.first,
                        static_cast<std::size_t>(std::min(kChunk, x1 - x)),
                        {across.left, down.left},
                        opacity};
    const auto draw = linear ? draw_column_linear : draw_column_encoded;
    draw(at(x, y0), stride, picture, y0 - down.first, y1 - y0, column);
  }
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
  constexpr double kFar = 1e6;  // canvas pixels: nothing there would be seen
  const double scale = options.scale;
  const bool drawable = std::abs(top_left.x) < kFar && std::abs(top_left.y) < kFar &&
                        std::isfinite(scale) && scale > 0 && picture.width > 0 &&
                        picture.height > 0;
  if (!drawable) return;
  if (options.scale == 1) {
    draw_unscaled(canvas, picture, top_left, options);
  } else {
    draw_scaled(canvas, picture, top_left, options);
  }
}

namespace {

// One binomial pass [1 2 1] / 4 along lines of `count` values, `step` apart.
void blur_lines(std::vector<std::uint16_t>& v, int lines, std::size_t line, int count,
                std::size_t step) {
  for (int k = 0; k < lines; ++k) {
    std::uint16_t* p = v.data() + static_cast<std::size_t>(k) * line;
    unsigned before = 0;
    for (int i = 0; i < count; ++i, p += step) {
      const unsigned here = *p, after = i + 1 < count ? p[step] : 0u;
      *p = static_cast<std::uint16_t>((before + 2 * here + after + 2) / 4);
      before = here;
    }
  }
}

}  // namespace

SoftShadow make_shadow(ImageView picture, float blur) {
  constexpr float kMostBlur = 64;
  constexpr int kMostReduction = 8;
  const float radius = blur > 0 ? std::min(blur, kMostBlur) : 0.0f;
  // The radius is two standard deviations; a pass adds half a (reduced) pixel of variance.
  const int reduction = std::clamp(static_cast<int>(radius / 2), 1, kMostReduction);
  const float deviation = radius / 2 / static_cast<float>(reduction);
  const int passes = static_cast<int>(std::lround(2 * deviation * deviation));
  const auto side = [&](int n) { return (n + reduction - 1) / reduction + 2 * passes; };
  SoftShadow out;
  out.scale = static_cast<float>(reduction);
  out.corner = {-out.scale * static_cast<float>(passes), -out.scale * static_cast<float>(passes)};
  if (picture.width <= 0 || picture.height <= 0) return out;
  const int width = side(picture.width), height = side(picture.height);
  const auto stride = static_cast<std::size_t>(width);
  std::vector<std::uint32_t> sums(stride * static_cast<std::size_t>(height), 0);
  for (int y = 0; y < picture.height; ++y) {
    std::uint32_t* row = sums.data() + static_cast<std::size_t>(y / reduction + passes) * stride;
    for (int x = 0; x < picture.width; ++x) row[x / reduction + passes] += picture.pixel(x, y)[3];
  }
  std::vector<std::uint16_t> soft(sums.size());
  const auto cell = static_cast<std::uint32_t>(reduction * reduction);
  for (std::size_t i = 0; i < sums.size(); ++i)
    soft[i] = static_cast<std::uint16_t>(sums[i] * 256 / cell);
  for (int pass = 0; pass < passes; ++pass) {
    blur_lines(soft, height, stride, width, 1);
    blur_lines(soft, width, 1, height, stride);
  }
  out.image = Image{width, height, std::vector<std::uint8_t>(4 * soft.size())};
  for (std::size_t i = 0; i < soft.size(); ++i)
    std::memset(&out.image.rgba[4 * i], (soft[i] + 128) >> 8, 4);
  return out;
}

void draw_sample(Image& canvas, ImageView picture, const Sample& sample, Vec2 position,
                 const DrawOptions& options) noexcept {
  const Vec2 top_left{position.x - sample.anchor.x * options.scale,
                      position.y - sample.anchor.y * options.scale};
  draw_picture(canvas, picture, top_left, options);
}

void draw_shadow(Image& canvas, const Sprite& sprite, std::uint32_t sample, Vec2 position,
                 const DrawOptions& options) noexcept {
  const FilmedShadow* shadow = find_shadow(sprite, sample);
  Image picture;
  if (shadow == nullptr || !decode_shadow(*shadow, picture)) return;
  DrawOptions enlarged = options;
  enlarged.scale *= sprite.data().shadow_scale;
  draw_picture(canvas, picture,
               {position.x - shadow->anchor.x * enlarged.scale,
                position.y - shadow->anchor.y * enlarged.scale},
               enlarged);
}

}  // namespace vsprite
