// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// plain_distance.h - all pairs as anyone would write them: the reference that the kernels are held
// to, and the rivals of the benchmark.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "similarity/distance.h"
#include "vsprite/random.h"

namespace vsprite::testing {

/// A sample's grid in full: (4, grid, grid) coverage, red, green, blue in steps; 0 where nothing shows.
inline std::vector<std::uint8_t> dense_cells(const FeatureSet& set, std::size_t i) {
  const CellImage& image = set.samples[i].cells;
  const auto side = static_cast<std::size_t>(set.grid), across = side / kBlockSide;
  std::vector<std::uint8_t> planes(4 * side * side, 0);
  std::size_t stored = 0;
  for (std::size_t k = 0; k < set.block_order.size(); ++k) {
    if ((image.seen[k / 64] >> k % 64 & 1) == 0) continue;
    const std::size_t block = set.block_order[k];
    for (std::size_t c = 0; c < 4 * kBlockCells; ++c) {
      const std::size_t cell = c / 4;
      const std::size_t y = block / across * kBlockSide + cell / kBlockSide;
      const std::size_t x = block % across * kBlockSide + cell % kBlockSide;
      planes[c % 4 * side * side + y * side + x] = image.cells[stored + c];
    }
    stored += 4 * kBlockCells;
  }
  return planes;
}

/// The other way round, into row order; the set is to be put in order by put_in_order.
inline CellImage pack_cells(const std::vector<std::uint8_t>& planes, int grid) {
  SampleRow row;
  row.anchor_x = row.anchor_y = grid / 2;
  Image image{grid, grid, std::vector<std::uint8_t>(planes.size())};
  for (std::size_t p = 0; p < planes.size() / 4; ++p) {
    for (std::size_t k = 0; k < 3; ++k) {
      image.rgba[4 * p + k] =
          static_cast<std::uint8_t>(kColorStep * planes[(k + 1) * (planes.size() / 4) + p]);
    }
    image.rgba[4 * p + 3] = planes[p];
  }
  return make_cells(row, image, 1, grid);
}

inline void put_in_order(FeatureSet& set) {
  std::vector<const CellImage*> images;
  for (const FeatureSample& s : set.samples) images.push_back(&s.cells);
  set.block_order = telling_order(images, set.grid);
  for (FeatureSample& s : set.samples) reorder(s.cells, set.block_order);
}

/// The two features of the pixels, integer for integer, from dense cells.
struct PlainSums {
  std::uint64_t color = 0;
  std::uint32_t alpha = 0;
};
inline PlainSums plain_sums(const std::uint8_t* a, const std::uint8_t* b, int plane) {
  PlainSums sums;
  for (int p = 0; p < plane; ++p) {
    std::uint64_t squares = 0;
    for (int k = 1; k < 4; ++k) {
      const int d = a[k * plane + p] - b[k * plane + p];
      squares += static_cast<std::uint64_t>(d * d);
    }
    sums.color += static_cast<std::uint64_t>(std::min(a[p], b[p])) * squares;
    sums.alpha += static_cast<std::uint32_t>(std::abs(a[p] - b[p]));
  }
  return sums;
}

/// Every pair within the limit, by the loop over all.
inline std::vector<PairDistance> plain_pairs(const FeatureSet& set, const Classifier& classifier,
                                             float limit = 1) {
  std::vector<std::vector<std::uint8_t>> cells;
  for (std::size_t i = 0; i < set.samples.size(); ++i) cells.push_back(dense_cells(set, i));
  std::vector<PairDistance> pairs;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t j = i + 1; j < cells.size(); ++j) {
      const int a = static_cast<int>(i), b = static_cast<int>(j);
      const PlainSums sums = plain_sums(cells[i].data(), cells[j].data(), set.grid * set.grid);
      FeatureVector f = cheap_features(set, a, b);
      detail::set_pixel_features(set, a, b, sums.color, sums.alpha, f);
      const float d = classifier.distance(f);
      if (d <= limit) {
        pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), d});
      }
    }
  }
  return pairs;
}

/// `set` made larger: seen in a mirror first, then further takes of it, each with its own light,
/// grain and pace. Deterministic.
inline FeatureSet grown(const FeatureSet& set, std::size_t count) {
  FeatureSet large;
  large.grid = set.grid, large.cell = set.cell, large.scale = set.scale;
  large.moving_speed = set.moving_speed, large.v0 = set.v0, large.fps = set.fps;
  const auto side = static_cast<std::size_t>(set.grid);
  const int clips = set.rows.back().clip + 1;
  Random random{7};
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t take = n / set.samples.size(), i = n % set.samples.size();
    FeatureSample s = set.samples[i];
    auto planes = dense_cells(set, i);
    if (take % 2 == 1) {
      for (std::size_t y = 0; y < 4 * side; ++y) {
        std::reverse(planes.begin() + static_cast<std::ptrdiff_t>(y * side),
                     planes.begin() + static_cast<std::ptrdiff_t>((y + 1) * side));
      }
      s.velocity_x = -s.velocity_x;
    }
    if (take >= 2) {
      const int gain = 97 + static_cast<int>(3 * take % 7);
      for (std::size_t p = side * side; p < planes.size(); ++p) {
        if (planes[p % (side * side)] == 0) continue;
        const int value = planes[p] * gain / 100 + static_cast<int>(random.below(5)) - 2;
        planes[p] = static_cast<std::uint8_t>(std::clamp(value, 0, 127));
      }
      const float pace = 0.9f + 0.02f * static_cast<float>(take % 10);
      s.velocity_x *= pace, s.velocity_y *= pace;
    }
    s.speed = std::sqrt(s.velocity_x * s.velocity_x + s.velocity_y * s.velocity_y);
    s.heading = static_cast<float>(
        angle_of(static_cast<double>(s.velocity_x), static_cast<double>(s.velocity_y)));
    s.cells = pack_cells(planes, set.grid);
    large.rows.push_back(set.rows[i]);
    large.rows.back().clip += static_cast<int>(take) * clips;
    large.samples.push_back(std::move(s));
  }
  put_in_order(large);
  return large;
}

}  // namespace vsprite::testing
