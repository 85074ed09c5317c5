// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/contact.h"

#include <algorithm>

#include "film/color.h"
#include "film/light.h"

namespace vsprite {
namespace {

constexpr int kGap = 4;
constexpr int kColumns = 3;

// Linear light of what a cell shows at one film pixel.
struct Light {
  float rgb[3];
};

float linear_of(int code) { return detail::linear_of_sums()[static_cast<std::size_t>(4 * code)]; }

Light show(const Frame& frame, const KeyedFrame& keyed, int column, int x, int y) {
  if (x < 0 || y < 0 || x >= frame.width || y >= frame.height) return {{0.05f, 0.05f, 0.05f}};
  if (column == 0) {
    const auto rgb = rgb_at(frame, x, y);
    return {{linear_of(rgb[0]), linear_of(rgb[1]), linear_of(rgb[2])}};
  }
  const Rect& crop = keyed.crop;
  const std::uint8_t* pixel = nullptr;
  if (x >= crop.x && y >= crop.y && x < crop.x + crop.width && y < crop.y + crop.height)
    pixel = keyed.straight.rgba.data() +
            4 * (static_cast<std::size_t>(y - crop.y) * static_cast<std::size_t>(crop.width) +
                 static_cast<std::size_t>(x - crop.x));
  const float a = pixel ? static_cast<float>(pixel[3]) / 255 : 0.0f;
  if (column == 1) {
    const float level = linear_of(static_cast<int>(a * 255 + 0.5f));
    return {{level, level, level}};
  }
  const float board = (x / 8 + y / 8) % 2 ? 0.65f : 0.35f;
  Light light{};
  for (int p = 0; p < 3; ++p)
    light.rgb[p] = a * (pixel ? linear_of(pixel[p]) : 0.0f) + (1 - a) * board;
  return light;
}

// The window of a frame: `size` about its largest blob, inside the film.
Rect window_of(const Frame& frame, const KeyedFrame& keyed, int width, int height) {
  int x = (frame.width - width) / 2;
  int y = (frame.height - height) / 2;
  if (!keyed.blobs.empty()) {
    const Rect& box = keyed.blobs[0].box;
    x = box.x + (box.width - width) / 2;
    y = box.y + (box.height - height) / 2;
  }
  x = std::clamp(x, 0, std::max(frame.width - width, 0));
  y = std::clamp(y, 0, std::max(frame.height - height, 0));
  return {x, y, width, height};
}

void draw_cell(const Frame& frame, const KeyedFrame& keyed, int column, const Rect& window,
               double zoom, Image& sheet, int left, int top, int width, int height) {
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      // The mean of the film pixels under this one; at least the nearest.
      const int x0 = window.x + static_cast<int>(u / zoom);
      const int y0 = window.y + static_cast<int>(v / zoom);
      const int x1 = std::max(window.x + static_cast<int>((u + 1) / zoom), x0 + 1);
      const int y1 = std::max(window.y + static_cast<int>((v + 1) / zoom), y0 + 1);
      float sum[3] = {};
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
          const Light light = show(frame, keyed, column, x, y);
          for (int p = 0; p < 3; ++p) sum[p] += light.rgb[p];
        }
      std::uint8_t* out = sheet.rgba.data() + 4 * (static_cast<std::size_t>(top + v) *
                                                       static_cast<std::size_t>(sheet.width) +
                                                   static_cast<std::size_t>(left + u));
      for (int p = 0; p < 3; ++p)
        out[p] = detail::encoded_of(sum[p] / static_cast<float>((x1 - x0) * (y1 - y0)));
    }
  if (column != 1 || keyed.blobs.empty()) return;
  const int ax = static_cast<int>((keyed.blobs[0].anchor_x - window.x) * zoom);
  const int ay = static_cast<int>((keyed.blobs[0].anchor_y - window.y) * zoom);
  for (int k = -4; k <= 4; ++k)
    for (const auto& [u, v] : {std::pair{ax + k, ay}, std::pair{ax, ay + k}}) {
      if (u < 0 || v < 0 || u >= width || v >= height) continue;
      std::uint8_t* out = sheet.rgba.data() + 4 * (static_cast<std::size_t>(top + v) *
                                                       static_cast<std::size_t>(sheet.width) +
                                                   static_cast<std::size_t>(left + u));
      out[0] = 220;
      out[1] = 30;
      out[2] = 30;
    }
}

}  // namespace

Image make_contact_sheet(std::span<const Frame> frames, std::span<const KeyedFrame> keyed,
                         int cell_width, int cell_height) {
  const std::size_t rows = std::min(frames.size(), keyed.size());
  Image sheet;
  if (rows == 0) return sheet;
  // One window for all: the largest subject with a margin, in the cell's proportion.
  int width = 32;
  int height = 32;
  for (std::size_t f = 0; f < rows; ++f)
    if (!keyed[f].blobs.empty()) {
      width = std::max(width, keyed[f].blobs[0].box.width + 24);
      height = std::max(height, keyed[f].blobs[0].box.height + 24);
    }
  width = std::min(width, frames[0].width);
  height = std::min(height, frames[0].height);
  const double zoom = std::min(
      {static_cast<double>(cell_width) / width, static_cast<double>(cell_height) / height, 4.0});
  const int shown_width = std::max(static_cast<int>(width * zoom), 1);
  const int shown_height = std::max(static_cast<int>(height * zoom), 1);
  sheet.width = kColumns * (shown_width + kGap) + kGap;
  sheet.height = static_cast<int>(rows) * (shown_height + kGap) + kGap;
  sheet.rgba.assign(
      4 * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height), 40);
  for (std::size_t i = 3; i < sheet.rgba.size(); i += 4) sheet.rgba[i] = 255;
  for (std::size_t f = 0; f < rows; ++f) {
    const Rect window = window_of(frames[f], keyed[f], width, height);
    for (int column = 0; column < kColumns; ++column)
      draw_cell(frames[f], keyed[f], column, window, zoom, sheet,
                kGap + column * (shown_width + kGap),
                kGap + static_cast<int>(f) * (shown_height + kGap), shown_width, shown_height);
  }
  return sheet;
}

}  // namespace vsprite
