// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/coverage.h"

#include <algorithm>
#include <cmath>

#include "film/grid.h"

namespace vsprite::detail {
namespace {

constexpr int kSome = 8;   // alpha that makes a part; coded films tremble below
constexpr int kReach = 2;  // cells around it whose alpha belongs to it, however little
constexpr int kBorder = 51;
constexpr std::size_t kMostBlobs = 32;

struct Cells {
  Mask some, half;  // any pixel covered enough to tell; half of the cell covered
};

Cells cells_of(const Frame& frame) {
  const int w = frame.cell_width(), h = frame.cell_height();
  Cells cells{Mask(w, h), Mask(w, h)};
  for (int cy = 0; cy < h; ++cy)
    for (int cx = 0; cx < w; ++cx) {
      int most = 0, sum = 0, seen = 0;
      for (int y = 2 * cy; y < std::min(2 * cy + 2, frame.height); ++y)
        for (int x = 2 * cx; x < std::min(2 * cx + 2, frame.width); ++x, ++seen) {
          const int a =
              frame.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                              static_cast<std::size_t>(x)) +
                         3];
          most = std::max(most, a);
          sum += a;
        }
      cells.some.row(cy)[cx] = most >= kSome;
      cells.half.row(cy)[cx] = 2 * sum >= 255 * seen;
    }
  return cells;
}

struct Part {
  std::int64_t area = 0, weight = 0, x = 0, y = 0;  // x, y: of twice the pixel's centre
  int left = 1 << 30, top = 1 << 30, right = -1, bottom = -1, label = 0;
  bool border = false;
};

// Calls `with` for every pixel that is covered at all and lies in a labelled cell.
template <class With>
void each_pixel(const Frame& frame, const std::vector<int>& labels, With with) {
  const auto w = static_cast<std::size_t>(frame.cell_width());
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const std::size_t cell =
          static_cast<std::size_t>(y / 2) * w + static_cast<std::size_t>(x / 2);
      const int a =
          frame.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                          static_cast<std::size_t>(x)) +
                     3];
      if (labels[cell] != 0 && a != 0) with(x, y, cell, a);
    }
}

// Anchors: of the solid cells, opened until thin parts are gone, with the soft edge added back;
// where nothing is left of a part, opened by less.
void weigh(const Frame& frame, const Mask& half, const std::vector<int>& labels, int opening,
           std::vector<Part>& parts) {
  for (int radius = opening;; radius /= 2) {
    const Mask opened =
        radius > 0 ? dilate(dilate_disc(erode_disc(half, radius), radius), 1) : Mask();
    std::vector<Part> weighed = parts;
    each_pixel(frame, labels, [&](int x, int y, std::size_t cell, int a) {
      Part& part = weighed[static_cast<std::size_t>(labels[cell]) - 1];
      if (radius > 0 && !opened.in[cell]) return;
      part.weight += a;
      part.x += std::int64_t{a} * (2 * x + 1);
      part.y += std::int64_t{a} * (2 * y + 1);
    });
    bool missing = false;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (parts[k].weight == 0) parts[k] = weighed[k];
      missing |= parts[k].weight == 0;
    }
    if (!missing || radius == 0) return;
  }
}

// Areas and boxes by label; the largest first, labels made anew by that order.
std::vector<Part> find_parts(const Frame& frame, std::vector<int>& labels, int count) {
  std::vector<Part> parts(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) parts[static_cast<std::size_t>(k)].label = k + 1;
  each_pixel(frame, labels, [&](int x, int y, std::size_t cell, int a) {
    Part& part = parts[static_cast<std::size_t>(labels[cell]) - 1];
    part.area += a;
    part.left = std::min(part.left, x), part.right = std::max(part.right, x + 1);
    part.top = std::min(part.top, y), part.bottom = std::max(part.bottom, y + 1);
    part.border |=
        a > kBorder && (x == 0 || y == 0 || x + 1 == frame.width || y + 1 == frame.height);
  });
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return a.area != b.area ? a.area > b.area : a.label < b.label;
  });
  parts.resize(std::min(parts.size(), kMostBlobs));
  std::vector<int> renamed(static_cast<std::size_t>(count) + 1);
  for (std::size_t k = 0; k < parts.size(); ++k)
    renamed[static_cast<std::size_t>(parts[k].label)] = static_cast<int>(k) + 1;
  for (int& label : labels) label = renamed[static_cast<std::size_t>(label)];
  return parts;
}

void cut(const Frame& frame, const std::vector<int>& labels, KeyedFrame& result) {
  Rect& crop = result.crop = result.blobs[0].box;
  for (const Blob& blob : result.blobs) {
    const int right = std::max(crop.x + crop.width, blob.box.x + blob.box.width);
    const int bottom = std::max(crop.y + crop.height, blob.box.y + blob.box.height);
    crop.x = std::min(crop.x, blob.box.x), crop.y = std::min(crop.y, blob.box.y);
    crop.width = right - crop.x, crop.height = bottom - crop.y;
  }
  const auto width = static_cast<std::size_t>(crop.width);
  const std::size_t pixels = width * static_cast<std::size_t>(crop.height);
  result.straight = {crop.width, crop.height, std::vector<std::uint8_t>(4 * pixels)};
  result.labels.assign(pixels, 0);
  each_pixel(frame, labels, [&](int x, int y, std::size_t cell, int) {
    const std::size_t to =
        static_cast<std::size_t>(y - crop.y) * width + static_cast<std::size_t>(x - crop.x);
    const std::size_t from = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                             static_cast<std::size_t>(x);
    std::copy_n(frame.rgba.data() + 4 * from, 4, result.straight.rgba.data() + 4 * to);
    result.labels[to] = static_cast<std::uint8_t>(labels[cell]);
  });
}

}  // namespace

bool carries_coverage(std::span<const Frame> frames) {
  for (const Frame& frame : frames)
    for (std::size_t i = 3; i < frame.rgba.size(); i += 4)
      if (frame.rgba[i] != 255) return true;
  return false;
}

ScreenModel coverage_model(std::span<const Frame> frames) {
  ScreenModel screen;
  screen.kind = KeyKind::Alpha;
  screen.reason = "alpha: the film brings its own coverage, nothing is keyed";
  screen.width = frames[0].width;
  screen.height = frames[0].height;
  std::vector<double> areas;
  for (const Frame& frame : frames) {
    KeyedFrame keyed;
    if (!frame.rgba.empty()) take_coverage(frame, 0, keyed);
    if (!keyed.blobs.empty()) areas.push_back(keyed.blobs[0].area / 4);
  }
  if (areas.empty()) return screen;
  std::nth_element(areas.begin(), areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2),
                   areas.end());
  screen.opening = std::max(1, static_cast<int>(0.1 * std::sqrt(areas[areas.size() / 2]) + 0.5));
  return screen;
}

void take_coverage(const Frame& frame, int opening, KeyedFrame& result) {
  const Cells cells = cells_of(frame);
  std::vector<int> labels;
  const int count = connected_parts(dilate(cells.some, kReach), labels);
  if (count == 0) return;
  std::vector<Part> parts = find_parts(frame, labels, count);
  weigh(frame, cells.half, labels, opening, parts);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Part& part = parts[k];
    Blob blob;
    blob.box = {part.left, part.top, part.right - part.left, part.bottom - part.top};
    blob.area = static_cast<double>(part.area) / 255;
    blob.anchor_x = 0.5 * static_cast<double>(part.x) / static_cast<double>(part.weight);
    blob.anchor_y = 0.5 * static_cast<double>(part.y) / static_cast<double>(part.weight);
    blob.touches_border = part.border;
    blob.label = static_cast<int>(k) + 1;
    result.blobs.push_back(blob);
  }
  cut(frame, labels, result);
}

}  // namespace vsprite::detail
