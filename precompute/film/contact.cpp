// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/contact.h"

#include <algorithm>
#include <string>
#include <vector>

#include "film/color.h"
#include "film/light.h"

namespace vsprite {
namespace {

constexpr int kGap = 4;
constexpr int kShownWidth = 640;

enum class View { Overview, Film, Matte, Checker, Background };

// Linear light of what a cell shows at one film pixel.
struct Light {
  float rgb[3];
};

using Color = std::uint8_t[3];
constexpr Color kMark = {220, 30, 30};

float linear_of(int code) { return detail::linear_of_sums()[static_cast<std::size_t>(4 * code)]; }

std::size_t offset(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(x);
}

Light film_light(const Frame& frame, int x, int y) {
  const auto rgb = rgb_at(frame, x, y);
  return {{linear_of(rgb[0]), linear_of(rgb[1]), linear_of(rgb[2])}};
}

Light background_light(const Frame& frame, const Image& background, int x, int y) {
  const std::uint8_t* p =
      background.rgba.data() + 4 * offset(x * background.width / frame.width,
                                          y * background.height / frame.height, background.width);
  return {{linear_of(p[0]), linear_of(p[1]), linear_of(p[2])}};
}

Light show(const Frame& frame, const KeyedFrame& keyed, View view, const Image& background, int x,
           int y) {
  if (x < 0 || y < 0 || x >= frame.width || y >= frame.height) return {{0.05f, 0.05f, 0.05f}};
  if (view == View::Overview || view == View::Film) return film_light(frame, x, y);
  const Rect& crop = keyed.crop;
  const std::uint8_t* pixel = nullptr;
  if (x >= crop.x && y >= crop.y && x < crop.x + crop.width && y < crop.y + crop.height)
    pixel = keyed.straight.rgba.data() + 4 * offset(x - crop.x, y - crop.y, crop.width);
  const float a = pixel ? static_cast<float>(pixel[3]) / 255 : 0.0f;
  if (view == View::Matte) {
    const float level = linear_of(static_cast<int>(a * 255 + 0.5f));
    return {{level, level, level}};
  }
  const float board = (x / 8 + y / 8) % 2 ? 0.65f : 0.35f;
  Light light = view == View::Background ? background_light(frame, background, x, y)
                                         : Light{{board, board, board}};
  const Rect& cells = keyed.shade_cells;
  const int u = x / 2 - cells.x, v = y / 2 - cells.y;
  if (u >= 0 && v >= 0 && u < cells.width && v < cells.height)
    for (float& channel : light.rgb)
      channel *= 1 - static_cast<float>(keyed.shade[offset(u, v, cells.width)]) / 255;
  for (int p = 0; p < 3; ++p)
    light.rgb[p] = a * (pixel ? linear_of(pixel[p]) : 0.0f) + (1 - a) * light.rgb[p];
  return light;
}

// A picture's place on the sheet.
struct Cell {
  Image& sheet;
  int left, top, width, height;

  void put(int u, int v, const Color& color) const {
    if (u < 0 || v < 0 || u >= width || v >= height) return;
    std::uint8_t* out = sheet.rgba.data() + 4 * offset(left + u, top + v, sheet.width);
    std::copy(color, color + 3, out);
  }
  void frame(int u0, int v0, int u1, int v1) const {
    for (int u = u0; u <= u1; ++u) put(u, v0, kMark), put(u, v1, kMark);
    for (int v = v0; v <= v1; ++v) put(u0, v, kMark), put(u1, v, kMark);
  }
};

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

void draw_cell(const Frame& frame, const KeyedFrame& keyed, View view, const Image& background,
               const Rect& window, double zoom, const Cell& cell) {
  for (int v = 0; v < cell.height; ++v)
    for (int u = 0; u < cell.width; ++u) {
      // The mean of the film pixels under this one; at least the nearest.
      const int x0 = window.x + static_cast<int>(u / zoom);
      const int y0 = window.y + static_cast<int>(v / zoom);
      const int x1 = std::max(window.x + static_cast<int>((u + 1) / zoom), x0 + 1);
      const int y1 = std::max(window.y + static_cast<int>((v + 1) / zoom), y0 + 1);
      float sum[3] = {};
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
          const Light light = show(frame, keyed, view, background, x, y);
          for (int p = 0; p < 3; ++p) sum[p] += light.rgb[p];
        }
      Color color;
      for (int p = 0; p < 3; ++p)
        color[p] = detail::encoded_of(sum[p] / static_cast<float>((x1 - x0) * (y1 - y0)));
      cell.put(u, v, color);
    }
  if (view != View::Matte || keyed.blobs.empty()) return;
  const int ax = static_cast<int>((keyed.blobs[0].anchor_x - window.x) * zoom);
  const int ay = static_cast<int>((keyed.blobs[0].anchor_y - window.y) * zoom);
  for (int k = -4; k <= 4; ++k) cell.put(ax + k, ay, kMark), cell.put(ax, ay + k, kMark);
}

// Digits of 3 x 5, a row of three bits each.
void draw_number(const Cell& cell, int u, int v, int number) {
  constexpr std::uint8_t kDigits[10][5] = {
      {7, 5, 5, 5, 7}, {2, 6, 2, 2, 7}, {7, 1, 7, 4, 7}, {7, 1, 3, 1, 7}, {5, 5, 7, 1, 1},
      {7, 4, 7, 1, 7}, {7, 4, 7, 5, 7}, {7, 1, 2, 2, 2}, {7, 5, 7, 5, 7}, {7, 5, 7, 1, 7}};
  constexpr int kDot = 3;
  constexpr Color kPaper = {255, 255, 255};
  const std::string text = std::to_string(number);
  const int width = static_cast<int>(text.size()) * 4 * kDot + kDot;
  for (int y = -kDot; y < 6 * kDot; ++y)
    for (int x = -kDot; x < width; ++x) cell.put(u + x, v + y, kPaper);
  for (std::size_t k = 0; k < text.size(); ++k)
    for (int y = 0; y < 5 * kDot; ++y)
      for (int x = 0; x < 3 * kDot; ++x)
        if (kDigits[text[k] - '0'][y / kDot] >> (2 - x / kDot) & 1)
          cell.put(u + static_cast<int>(k) * 4 * kDot + x, v + y, kMark);
}

// Pixels of the largest subject's box with a margin, inside the film.
Rect window_size(std::span<const Frame> frames, std::span<const KeyedFrame> keyed) {
  Rect window{0, 0, 32, 32};
  for (const KeyedFrame& frame : keyed)
    if (!frame.blobs.empty()) {
      window.width = std::max(window.width, frame.blobs[0].box.width + 24);
      window.height = std::max(window.height, frame.blobs[0].box.height + 24);
    }
  window.width = std::min(window.width, frames[0].width);
  window.height = std::min(window.height, frames[0].height);
  return window;
}

Image make_sheet(int width, int height) {
  Image sheet;
  sheet.width = width;
  sheet.height = height;
  sheet.rgba.assign(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 40);
  for (std::size_t i = 3; i < sheet.rgba.size(); i += 4) sheet.rgba[i] = 255;
  return sheet;
}

// A view and how large it stands on the sheet.
struct Column {
  View view;
  double zoom;
  int left, width, height;
};

std::vector<Column> plan_columns(const Frame& frame, const Rect& window,
                                 const ContactConfig& config) {
  std::vector<View> views = {View::Film, View::Matte, View::Checker};
  if (config.overview) views.insert(views.begin(), View::Overview);
  if (!config.background.rgba.empty()) views.push_back(View::Background);
  std::vector<Column> columns;
  int left = kGap;
  for (const View view : views) {
    const bool whole = view == View::Overview;
    const double width = whole ? frame.width : window.width;
    const double height = whole ? frame.height : window.height;
    const double zoom =
        std::min({config.cell_width / width, config.cell_height / height, whole ? 1.0 : 4.0});
    columns.push_back({view, zoom, left, std::max(static_cast<int>(width * zoom), 1),
                       std::max(static_cast<int>(height * zoom), 1)});
    left += columns.back().width + kGap;
  }
  return columns;
}

}  // namespace

Image make_contact_sheet(std::span<const Frame> frames, std::span<const KeyedFrame> keyed,
                         const ContactConfig& config) {
  const std::size_t rows = std::min(frames.size(), keyed.size());
  if (rows == 0) return {};
  const Rect size = window_size(frames, keyed.first(rows));
  const auto columns = plan_columns(frames[0], size, config);
  int height = 0;
  for (const Column& column : columns) height = std::max(height, column.height);
  Image sheet = make_sheet(columns.back().left + columns.back().width + kGap,
                           static_cast<int>(rows) * (height + kGap) + kGap);
  for (std::size_t f = 0; f < rows; ++f) {
    const Rect window = window_of(frames[f], keyed[f], size.width, size.height);
    const int top = kGap + static_cast<int>(f) * (height + kGap);
    for (const Column& column : columns) {
      const Cell cell{sheet, column.left, top, column.width, column.height};
      const bool whole = column.view == View::Overview;
      const Rect all{0, 0, frames[f].width, frames[f].height};
      draw_cell(frames[f], keyed[f], column.view, config.background, whole ? all : window,
                column.zoom, cell);
      const auto at = [&](int film) { return static_cast<int>(film * column.zoom); };
      if (whole && size.width < all.width)
        cell.frame(at(window.x), at(window.y), at(window.x + window.width) - 1,
                   at(window.y + window.height) - 1);
    }
  }
  return sheet;
}

Image show_parts(const KeyedFrame& keyed, int film_width, int film_height,
                 std::span<const Blob> parts) {
  Frame frame;  // its size alone: no pixel of it is shown
  frame.width = film_width;
  frame.height = film_height;
  const double zoom = std::min(1.0, static_cast<double>(kShownWidth) / film_width);
  const int width = std::max(static_cast<int>(film_width * zoom), 1);
  const int height = std::max(static_cast<int>(film_height * zoom), 1);
  Image picture = make_sheet(width, height);
  const Cell cell{picture, 0, 0, width, height};
  draw_cell(frame, keyed, View::Background, Image{1, 1, {128, 128, 128, 255}},
            {0, 0, film_width, film_height}, zoom, cell);
  const auto at = [zoom](int film) { return static_cast<int>(film * zoom); };
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Rect& box = parts[k].box;
    for (int grow : {1, 2})  // along the border where the part reaches it
      cell.frame(std::max(at(box.x) - grow, 2 - grow), std::max(at(box.y) - grow, 2 - grow),
                 std::min(at(box.x + box.width) + grow, width - 3 + grow),
                 std::min(at(box.y + box.height) + grow, height - 3 + grow));
    if (parts.size() > 1)
      draw_number(cell, std::clamp(at(box.x) + 3, 3, std::max(width - 40, 3)),
                  std::clamp(at(box.y) + 3, 3, std::max(height - 20, 3)), static_cast<int>(k) + 1);
  }
  return picture;
}

}  // namespace vsprite
