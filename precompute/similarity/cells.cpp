// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "similarity/cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "vsprite/random.h"

namespace vsprite {
namespace {

constexpr int kTellingPairs = 4000;
constexpr int kCoarse = 8;  // cells a side of a coarse square

// How much of each pixel lies in each cell along one axis, in 1/256 pixel.
struct Overlap {
  int first = 0;
  std::vector<int> weights;
};
std::vector<Overlap> axis_overlaps(double anchor, double cell, int grid, int size) {
  std::vector<int> edges;  // of the cells, 1/256 px of the image
  for (int g = 0; g <= grid; ++g) {
    const double edge = (anchor + (g - grid / 2) * cell) * 256;
    edges.push_back(static_cast<int>(std::floor(std::clamp(edge, -1e8, 1e8) + 0.5)));
  }
  std::vector<Overlap> cells(static_cast<std::size_t>(grid));
  for (std::size_t g = 0; g < cells.size(); ++g) {
    const int begin = std::max(edges[g], 0), end = std::min(edges[g + 1], 256 * size);
    cells[g].first = begin / 256;
    for (int p = begin / 256; 256 * p < end; ++p) {
      cells[g].weights.push_back(std::min(end, 256 * (p + 1)) - std::max(begin, 256 * p));
    }
  }
  return cells;
}

// One cell: coverage and colour, colour weighted by coverage.
struct CellSum {
  std::uint64_t alpha = 0, color[3] = {};
};
CellSum sum_cell(const Image& image, const Overlap& x, const Overlap& y) {
  CellSum sum;
  for (std::size_t r = 0; r < y.weights.size(); ++r) {
    const std::size_t row = static_cast<std::size_t>(y.first) + r;
    const std::size_t start =
        4 * (row * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x.first));
    for (std::size_t c = 0; c < x.weights.size(); ++c) {
      const std::uint8_t* p = image.rgba.data() + start + 4 * c;
      const auto weight = static_cast<std::uint64_t>(y.weights[r] * x.weights[c]) * p[3];
      sum.alpha += weight;
      for (int k = 0; k < 3; ++k) sum.color[k] += weight * p[k];
    }
  }
  return sum;
}

using BlockCells = std::array<std::uint8_t, kBlockBytes>;

// Calls visit(k, cells) for every block that shows something, ascending.
template <class Visit>
void for_each_block(const CellImage& image, Visit visit) {
  const std::uint8_t* cells = image.cells.data();
  for (std::size_t w = 0; w < image.seen.size(); ++w) {
    for (std::uint64_t bits = image.seen[w]; bits != 0; bits &= bits - 1) {
      visit(64 * w + static_cast<std::size_t>(std::countr_zero(bits)), cells);
      cells += kBlockBytes;
    }
  }
}

std::vector<const std::uint8_t*> find_blocks(const CellImage& image, std::size_t count) {
  std::vector<const std::uint8_t*> blocks(count, nullptr);
  for_each_block(image, [&](std::size_t k, const std::uint8_t* cells) { blocks[k] = cells; });
  return blocks;
}

std::uint64_t block_difference(const std::uint8_t* a, const std::uint8_t* b) noexcept {
  std::uint64_t sum = 0;
  for (int c = 0; c < kBlockCells; ++c) {
    int squares = 0;
    for (int k = 1; k < 4; ++k) {
      const int d = a[4 * c + k] - b[4 * c + k];
      squares += d * d;
    }
    sum += static_cast<std::uint64_t>(std::min(a[4 * c], b[4 * c])) * static_cast<std::uint64_t>(squares);
  }
  return sum;
}

}  // namespace

BlockOrder row_order(int grid) {
  BlockOrder order(static_cast<std::size_t>(grid / kBlockSide * (grid / kBlockSide)));
  std::iota(order.begin(), order.end(), std::uint16_t{0});
  return order;
}

CellImage make_cells(const SampleRow& row, const Image& image, double cell, int grid) {
  const double scale = row.scale > 0 ? row.scale : 1;
  const auto xs = axis_overlaps((row.anchor_x - row.left) * scale, cell * scale, grid, image.width);
  const auto ys = axis_overlaps((row.anchor_y - row.top) * scale, cell * scale, grid, image.height);
  const auto full = static_cast<std::uint64_t>(
      std::max(std::floor(cell * scale * cell * scale * 65536 + 0.5), 1.0));
  const auto across = static_cast<std::size_t>(grid / kBlockSide);
  CellImage result;
  for (std::size_t block = 0; block < across * across; ++block) {
    BlockCells cells{};
    bool shows = false;
    for (std::size_t c = 0; c < kBlockCells; ++c) {
      const std::size_t y = block / across * kBlockSide + c / kBlockSide;
      const std::size_t x = block % across * kBlockSide + c % kBlockSide;
      const CellSum sum = sum_cell(image, xs[x], ys[y]);
      const std::uint64_t alpha = std::min<std::uint64_t>((sum.alpha + full / 2) / full, 255);
      if (alpha == 0) continue;
      shows = true;
      result.coverage += static_cast<std::uint32_t>(alpha);
      cells[4 * c] = static_cast<std::uint8_t>(alpha);
      for (std::size_t k = 0; k < 3; ++k) {
        cells[4 * c + k + 1] = static_cast<std::uint8_t>(sum.color[k] / (kColorStep * sum.alpha));
      }
    }
    if (!shows) continue;
    result.seen[block / 64] |= std::uint64_t{1} << block % 64;
    result.cells.insert(result.cells.end(), cells.begin(), cells.end());
  }
  result.cells.shrink_to_fit();
  return result;
}

BlockOrder telling_order(const std::vector<const CellImage*>& images, int grid) {
  BlockOrder order = row_order(grid);
  if (images.size() < 2) return order;
  std::vector<std::uint64_t> told(order.size(), 0);
  Random random{1};
  for (int n = 0; n < kTellingPairs; ++n) {
    const auto a = find_blocks(*images[random.below(images.size())], order.size());
    const auto b = find_blocks(*images[random.below(images.size())], order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (a[k] && b[k]) told[k] += block_difference(a[k], b[k]);
    }
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint16_t a, std::uint16_t b) { return told[a] > told[b]; });
  return order;
}

void reorder(CellImage& image, const BlockOrder& order) {
  const auto blocks = find_blocks(image, order.size());
  CellImage sorted;
  sorted.coverage = image.coverage;
  sorted.cells.reserve(image.cells.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::uint8_t* cells = blocks[order[k]];
    if (!cells) continue;
    sorted.seen[k / 64] |= std::uint64_t{1} << k % 64;
    sorted.cells.insert(sorted.cells.end(), cells, cells + kBlockBytes);
  }
  image = std::move(sorted);
}

std::vector<std::int16_t> coarse_coverage(const CellImage& image, const BlockOrder& order,
                                          int grid) {
  const int across = grid / kBlockSide, squares = grid / kCoarse;
  std::vector<std::int16_t> sums(static_cast<std::size_t>(squares * squares), 0);
  for_each_block(image, [&](std::size_t k, const std::uint8_t* cells) {
    const int y = order[k] / across * kBlockSide / kCoarse;
    const int x = order[k] % across * kBlockSide / kCoarse;
    std::int16_t& sum = sums[static_cast<std::size_t>(y * squares + x)];
    for (int c = 0; c < kBlockBytes; c += 4) sum = static_cast<std::int16_t>(sum + cells[c]);
  });
  return sums;
}

std::vector<std::uint8_t> block_means(const CellImage& image, std::size_t count) {
  std::vector<std::uint8_t> means((count + kBlockCells - 1) / kBlockCells * kBlockBytes, 0);
  for_each_block(image, [&](std::size_t k, const std::uint8_t* cells) {
    if (k >= count) return;
    std::uint8_t least = 255;
    int sums[3] = {};
    for (int c = 0; c < kBlockBytes; c += 4) {
      least = std::min(least, cells[c]);
      for (int n = 0; n < 3; ++n) sums[n] += cells[c + n + 1];
    }
    if (least == 0) return;
    std::uint8_t* mean = means.data() + 4 * k;
    *mean++ = least;
    for (const int sum : sums) {
      *mean++ = static_cast<std::uint8_t>((sum + kBlockCells / 2) / kBlockCells);
    }
  });
  return means;
}

}  // namespace vsprite
