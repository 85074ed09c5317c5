// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The chroma grid and the map operations of the keyer: integers, or float sums in a fixed order.
#include "film/grid.h"

#include <algorithm>

#include "film/color.h"

namespace vsprite::detail {

void make_grid(const Frame& frame, Grid& grid) {
  grid.width = frame.cell_width();
  grid.height = frame.cell_height();
  for (auto& plane : grid.plane) plane.resize(grid.cells());
  const RgbOfYcc m = rgb_of_ycc(frame.coding);
  const std::size_t stride = static_cast<std::size_t>(frame.width);
  std::size_t i = 0;
  for (int y = 0; y < grid.height; ++y) {
    const std::uint8_t* top = frame.y.data() + static_cast<std::size_t>(2 * y) * stride;
    const std::uint8_t* low = 2 * y + 1 < frame.height ? top + stride : top;
    for (int x = 0; x < grid.width; ++x, ++i) {
      const int left = 2 * x;
      const int right = std::min(left + 1, frame.width - 1);
      const int sum = top[left] + top[right] + low[left] + low[right];
      const auto rgb = m.sums(sum, frame.cb[i], frame.cr[i], 4);
      for (std::size_t c = 0; c < 3; ++c) grid.plane[2 - c][i] = static_cast<std::uint16_t>(rgb[c]);
    }
  }
}

namespace {

// One direction of a square dilation or erosion: `pick` keeps the larger or the smaller.
template <class Pick>
Mask spread(const Mask& mask, int radius, std::uint8_t outside, Pick pick) {
  const int w = mask.width;
  const int h = mask.height;
  Mask rows(w, h);
  for (int y = 0; y < h; ++y) {
    const std::uint8_t* in = mask.row(y);
    std::uint8_t* out = rows.row(y);
    std::copy(in, in + w, out);
    for (int k = 1; k <= radius; ++k) {
      for (int x = 0; x + k < w; ++x) out[x] = pick(out[x], in[x + k]);
      for (int x = k; x < w; ++x) out[x] = pick(out[x], in[x - k]);
    }
    for (int x = 0; x < std::min(radius, w); ++x) {
      out[x] = pick(out[x], outside);
      out[w - 1 - x] = pick(out[w - 1 - x], outside);
    }
  }
  Mask both = rows;
  for (int y = 0; y < h; ++y) {
    std::uint8_t* out = both.row(y);
    for (int k = -radius; k <= radius; ++k) {
      if (y + k < 0 || y + k >= h) {
        for (int x = 0; x < w; ++x) out[x] = pick(out[x], outside);
        continue;
      }
      const std::uint8_t* in = rows.row(y + k);
      for (int x = 0; x < w; ++x) out[x] = pick(out[x], in[x]);
    }
  }
  return both;
}

}  // namespace

Mask dilate(const Mask& mask, int radius) {
  return spread(mask, radius, 0, [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
}

Mask erode(const Mask& mask, int radius) {
  return spread(mask, radius, 1, [](std::uint8_t a, std::uint8_t b) { return std::min(a, b); });
}

std::vector<std::uint16_t> distance_to(const Mask& mask, std::uint8_t value) {
  constexpr int kFar = 30'000;
  const int w = mask.width;
  const int h = mask.height;
  std::vector<std::uint16_t> distance(mask.in.size());
  const auto at = [&](int x, int y) -> int {
    if (x < 0 || y < 0 || x >= w || y >= h) return kFar;
    return distance[static_cast<std::size_t>(y) * static_cast<std::size_t>(w) +
                    static_cast<std::size_t>(x)];
  };
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
      int best = mask.in[i] == value ? 0 : kFar;
      best = std::min(
          {best, at(x - 1, y) + 5, at(x, y - 1) + 5, at(x - 1, y - 1) + 7, at(x + 1, y - 1) + 7});
      distance[i] = static_cast<std::uint16_t>(best);
    }
  for (int y = h - 1; y >= 0; --y)
    for (int x = w - 1; x >= 0; --x) {
      const std::size_t i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
      const int best = std::min({static_cast<int>(distance[i]), at(x + 1, y) + 5, at(x, y + 1) + 5,
                                 at(x + 1, y + 1) + 7, at(x - 1, y + 1) + 7});
      distance[i] = static_cast<std::uint16_t>(best);
    }
  return distance;
}

Mask open_disc(const Mask& mask, int radius) {
  const auto depth = distance_to(mask, 0);
  Mask core(mask.width, mask.height);
  for (std::size_t i = 0; i < core.in.size(); ++i) core.in[i] = depth[i] > 5 * radius ? 1 : 0;
  const auto reach = distance_to(core, 1);
  for (std::size_t i = 0; i < core.in.size(); ++i)
    core.in[i] = mask.in[i] && reach[i] <= 5 * radius ? 1 : 0;
  return core;
}

namespace {

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

void blur(std::vector<float>& plane, int width, int height, int radius, int passes,
          std::vector<float>& scratch) {
  scratch.resize(plane.size());
  for (int pass = 0; pass < passes; ++pass) {
    blur_rows(plane.data(), scratch.data(), width, height, radius);
    blur_columns(scratch.data(), plane.data(), width, height, radius);
  }
}

int connected_parts(const Mask& mask, std::vector<int>& labels) {
  const int w = mask.width;
  labels.assign(mask.in.size(), 0);
  std::vector<int> todo;
  int count = 0;
  for (std::size_t first = 0; first < mask.in.size(); ++first) {
    if (!mask.in[first] || labels[first]) continue;
    labels[first] = ++count;
    todo.push_back(static_cast<int>(first));
    while (!todo.empty()) {
      const int cell = todo.back();
      todo.pop_back();
      const int cx = cell % w;
      const int cy = cell / w;
      for (int y = std::max(cy - 1, 0); y <= std::min(cy + 1, mask.height - 1); ++y)
        for (int x = std::max(cx - 1, 0); x <= std::min(cx + 1, w - 1); ++x) {
          const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(w) +
                                static_cast<std::size_t>(x);
          if (!mask.in[i] || labels[i]) continue;
          labels[i] = count;
          todo.push_back(static_cast<int>(i));
        }
    }
  }
  return count;
}

}  // namespace vsprite::detail
