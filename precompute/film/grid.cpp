// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The chroma grid and the map operations of the keyer: integers, or float sums in a fixed order.
#include "film/grid.h"

#include <algorithm>
#include <cstring>

#include "film/color.h"
#include "film/lanes.h"

namespace vsprite::detail {

void make_grid(const Frame& frame, const Window& window, Grid& grid) {
  grid.left = window.left;
  grid.top = window.top;
  grid.width = window.width;
  grid.height = window.height;
  for (auto& plane : grid.plane) plane.resize(grid.cells());
  const RgbOfYcc m = rgb_of_ycc(frame.coding);
  const auto stride = static_cast<std::size_t>(frame.width);
  const auto cell_stride = static_cast<std::size_t>(frame.cell_width());
  const int whole = std::min(window.width, frame.width / 2 - window.left);
  for (int y = 0; y < grid.height; ++y) {
    const int pixel_row = 2 * (window.top + y);
    const std::uint8_t* top = frame.y.data() + static_cast<std::size_t>(pixel_row) * stride +
                              2 * static_cast<std::size_t>(window.left);
    const std::uint8_t* low = pixel_row + 1 < frame.height ? top + stride : top;
    const std::size_t from = static_cast<std::size_t>(window.top + y) * cell_stride +
                             static_cast<std::size_t>(window.left);
    const std::size_t to = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width);
    const auto out = [&](std::size_t p) { return grid.plane[p].data() + to; };
    lanes().sum_cells(m, top, low, frame.cb.data() + from, frame.cr.data() + from, whole, out(0),
                      out(1), out(2));
    for (int x = whole; x < window.width; ++x) {
      const auto i = static_cast<std::size_t>(x);
      const auto rgb =
          m.sums(2 * (top[2 * x] + low[2 * x]), frame.cb[from + i], frame.cr[from + i], 4);
      for (std::size_t p = 0; p < 3; ++p) out(p)[x] = static_cast<std::uint16_t>(rgb[p]);
    }
  }
}

void make_grid(const Frame& frame, Grid& grid) {
  make_grid(frame, {0, 0, frame.cell_width(), frame.cell_height()}, grid);
}

namespace {

// Columns: each row with those up to `radius` above and below.
void spread_columns(const Mask& in, int radius, bool larger, Mask& out) {
  const auto width = static_cast<std::size_t>(in.width);
  for (int y = 0; y < in.height; ++y) {
    std::uint8_t* row = out.row(y);
    std::memcpy(row, in.row(y), width);
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, in.height - 1); ++v)
      if (v != y) lanes().spread_into(in.row(v), width, larger, row);
  }
}

Mask spread(const Mask& mask, int radius, bool larger) {
  Mask rows(mask.width, mask.height);
  for (int y = 0; y < mask.height; ++y)
    lanes().spread_row(mask.row(y), mask.width, radius, larger, rows.row(y));
  Mask both(mask.width, mask.height);
  spread_columns(rows, radius, larger, both);
  return both;
}

// One step to the four neighbours.
Mask spread_cross(const Mask& mask, bool larger) {
  Mask out(mask.width, mask.height);
  const auto width = static_cast<std::size_t>(mask.width);
  for (int y = 0; y < mask.height; ++y) {
    lanes().spread_row(mask.row(y), mask.width, 1, larger, out.row(y));
    if (y > 0) lanes().spread_into(mask.row(y - 1), width, larger, out.row(y));
    if (y + 1 < mask.height) lanes().spread_into(mask.row(y + 1), width, larger, out.row(y));
  }
  return out;
}

// Squares and crosses in the proportion that makes an octagon.
Mask spread_disc(const Mask& mask, int radius, bool larger) {
  const int square = (5 * radius + 6) / 12;
  Mask out = spread(mask, square, larger);
  for (int k = square; k < radius; ++k) out = spread_cross(out, larger);
  return out;
}

// Rows: a running sum in double, so that what leaves the box leaves nothing behind; small boxes
// directly.
void blur_rows(const float* in, float* out, int width, int height, int radius) {
  const float scale = 1.0f / static_cast<float>(2 * radius + 1);
  if (radius <= 2 && width > 2 * radius) {
    for (int y = 0; y < height; ++y, in += width, out += width) {
      for (int x = 0; x < width; ++x) out[x] = in[x];
      for (int k = 1; k <= radius; ++k) {
        for (int x = 0; x < width - k; ++x) out[x] += in[x + k];
        for (int x = k; x < width; ++x) out[x] += in[x - k];
      }
      for (int x = 0; x < width; ++x) out[x] *= scale;
    }
    return;
  }
  for (int y = 0; y < height; ++y, in += width, out += width) {
    double sum = 0;
    for (int x = 0; x < std::min(radius, width); ++x) sum += static_cast<double>(in[x]);
    for (int x = 0; x < width; ++x) {
      if (x + radius < width) sum += static_cast<double>(in[x + radius]);
      if (x - radius - 1 >= 0) sum -= static_cast<double>(in[x - radius - 1]);
      out[x] = static_cast<float>(sum) * scale;
    }
  }
}

void blur_columns(const float* in, float* out, int width, int height, int radius) {
  const float scale = 1.0f / static_cast<float>(2 * radius + 1);
  if (radius <= 2) {
    for (int y = 0; y < height; ++y, out += width) {
      const float* middle = in + static_cast<std::ptrdiff_t>(y) * width;
      for (int x = 0; x < width; ++x) out[x] = middle[x];
      for (int k = 1; k <= radius; ++k) {
        const float* above = middle - static_cast<std::ptrdiff_t>(k) * width;
        const float* below = middle + static_cast<std::ptrdiff_t>(k) * width;
        if (y >= k)
          for (int x = 0; x < width; ++x) out[x] += above[x];
        if (y + k < height)
          for (int x = 0; x < width; ++x) out[x] += below[x];
      }
      for (int x = 0; x < width; ++x) out[x] *= scale;
    }
    return;
  }
  std::vector<double> sums(static_cast<std::size_t>(width), 0.0);
  const auto row = [&](int y) { return in + static_cast<std::ptrdiff_t>(y) * width; };
  for (int y = 0; y < std::min(radius, height); ++y)
    for (int x = 0; x < width; ++x)
      sums[static_cast<std::size_t>(x)] += static_cast<double>(row(y)[x]);
  for (int y = 0; y < height; ++y, out += width) {
    if (y + radius < height)
      for (int x = 0; x < width; ++x)
        sums[static_cast<std::size_t>(x)] += static_cast<double>(row(y + radius)[x]);
    if (y - radius - 1 >= 0)
      for (int x = 0; x < width; ++x)
        sums[static_cast<std::size_t>(x)] -= static_cast<double>(row(y - radius - 1)[x]);
    for (int x = 0; x < width; ++x)
      out[x] = static_cast<float>(sums[static_cast<std::size_t>(x)]) * scale;
  }
}

}  // namespace

Mask dilate(const Mask& mask, int radius) { return spread(mask, radius, true); }
Mask erode(const Mask& mask, int radius) { return spread(mask, radius, false); }
Mask dilate_disc(const Mask& mask, int radius) { return spread_disc(mask, radius, true); }
Mask erode_disc(const Mask& mask, int radius) { return spread_disc(mask, radius, false); }

void blur(std::vector<float>& plane, int width, int height, int radius, int passes,
          std::vector<float>& scratch) {
  scratch.resize(plane.size());
  for (int pass = 0; pass < passes; ++pass) {
    blur_rows(plane.data(), scratch.data(), width, height, radius);
    blur_columns(scratch.data(), plane.data(), width, height, radius);
  }
}

namespace {

struct Run {
  int begin, end, part;
};

int root_of(std::vector<int>& parent, int part) {
  while (parent[static_cast<std::size_t>(part)] != part) {
    auto& up = parent[static_cast<std::size_t>(part)];
    up = parent[static_cast<std::size_t>(up)];
    part = up;
  }
  return part;
}

// Runs of a row; those that touch a run of the row above, corners too, are of its part.
void join_row(const std::uint8_t* in, int width, const std::vector<Run>& above,
              std::vector<Run>& runs, std::vector<int>& parent) {
  runs.clear();
  std::size_t first = 0;
  for (int x = 0; x < width;) {
    const auto left = static_cast<std::size_t>(width - x);
    const void* found = std::memchr(in + x, 1, left);
    if (!found) return;
    const int begin = static_cast<int>(static_cast<const std::uint8_t*>(found) - in);
    const void* out = std::memchr(in + begin, 0, static_cast<std::size_t>(width - begin));
    const int end = out ? static_cast<int>(static_cast<const std::uint8_t*>(out) - in) : width;
    int part = -1;
    while (first < above.size() && above[first].end < begin) ++first;
    for (std::size_t k = first; k < above.size() && above[k].begin <= end; ++k) {
      const int other = root_of(parent, above[k].part);
      if (part < 0) {
        part = other;
      } else if (other != part) {
        parent[static_cast<std::size_t>(std::max(part, other))] = std::min(part, other);
        part = std::min(part, other);
      }
    }
    if (part < 0) {
      part = static_cast<int>(parent.size());
      parent.push_back(part);
    }
    runs.push_back({begin, end, part});
    x = end;
  }
}

}  // namespace

int connected_parts(const Mask& mask, std::vector<int>& labels) {
  labels.assign(mask.in.size(), 0);
  std::vector<int> parent{0};
  std::vector<std::vector<Run>> rows(static_cast<std::size_t>(mask.height));
  const std::vector<Run> none;
  for (int y = 0; y < mask.height; ++y) {
    const auto row = static_cast<std::size_t>(y);
    join_row(mask.row(y), mask.width, y > 0 ? rows[row - 1] : none, rows[row], parent);
  }
  std::vector<int> number(parent.size());
  int count = 0;
  for (std::size_t part = 1; part < parent.size(); ++part)
    number[part] = parent[part] == static_cast<int>(part)
                       ? ++count
                       : number[static_cast<std::size_t>(root_of(parent, static_cast<int>(part)))];
  for (std::size_t y = 0; y < rows.size(); ++y)
    for (const Run& run : rows[y]) {
      int* row = labels.data() + y * static_cast<std::size_t>(mask.width);
      std::fill(row + run.begin, row + run.end, number[static_cast<std::size_t>(run.part)]);
    }
  return count;
}

}  // namespace vsprite::detail
