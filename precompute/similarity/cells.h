// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/cells.h - a sample's picture as the features see it: coverage and colour on a grid.
//
// The grid is `side` x `side` cells, the anchor at its centre. It is cut into blocks of 4 x 4
// cells, and blocks that show nothing are not stored: a subject fills a tenth to a third of its
// grid, and where one of two pictures is empty the weight min(a_i, a_j) is 0 and the difference in
// coverage is the other's coverage. So a pair is compared only in blocks that both pictures fill.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <new>
#include <vector>

#include "film/extract.h"
#include "vsprite/image.h"

namespace vsprite {

inline constexpr int kBlockSide = 4;                         ///< cells
inline constexpr int kBlockCells = kBlockSide * kBlockSide;  ///< 16
inline constexpr int kBlockBytes = 4 * kBlockCells;          ///< a cache line
inline constexpr int kMaxGrid = 64;                          ///< cells a side
inline constexpr int kColorStep = 2;                         ///< code values a step of a cell's colour
inline constexpr int kBlockWords = kMaxGrid * kMaxGrid / kBlockCells / 64;

/// Storage that starts on a cache line, so that no block straddles two.
template <class T>
struct LineAllocator {
  using value_type = T;
  LineAllocator() noexcept = default;
  template <class U>
  explicit LineAllocator(const LineAllocator<U>&) noexcept {}
  T* allocate(std::size_t n) {
    if (n > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_alloc();
    return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{64}));
  }
  void deallocate(T* p, std::size_t) noexcept { ::operator delete (p, std::align_val_t{64}); }
  friend bool operator==(const LineAllocator&, const LineAllocator&) noexcept { return true; }
};

/// One picture. Blocks are numbered along the set's block order.
struct CellImage {
  std::array<std::uint64_t, kBlockWords> seen{};  ///< bit k: block k shows something
  /// (blocks seen, 16, 4): coverage 0..255, then red, green, blue, straight, in whole steps 0..127
  /// so that two squares fit an i16; 0 where nothing shows.
  std::vector<std::uint8_t, LineAllocator<std::uint8_t>> cells;
  std::uint32_t coverage = 0;  ///< sum of coverage
};

/// Where each block lies: position k -> block number along the rows of the grid.
using BlockOrder = std::vector<std::uint16_t>;
BlockOrder row_order(int grid);

/// The picture on a grid of cells of `cell` film pixels, blocks in row order. `image`: straight
/// alpha, row.scale image pixels a film pixel. Integer sums: the same cells on every machine.
CellImage make_cells(const SampleRow& row, const Image& image, double cell, int grid);

/// Blocks sorted by how much they tell samples apart (over pairs drawn with a fixed seed), most
/// telling first, so that a comparison that can stop early does. Pre: `images` are in row order.
BlockOrder telling_order(const std::vector<const CellImage*>& images, int grid);
/// From row order to `order`.
void reorder(CellImage& image, const BlockOrder& order);

/// Coverage summed over the squares of 8 x 8 cells, in row order: (grid / 8)^2, each <= 16320.
std::vector<std::int16_t> coarse_coverage(const CellImage& image, const BlockOrder& order,
                                          int grid);

/// Of the first `count` blocks of the order, a block as a cell, padded to whole blocks: the least
/// coverage in the block, then its mean red, green, blue, rounded; 0 where a cell shows nothing.
std::vector<std::uint8_t> block_means(const CellImage& image, std::size_t count);

}  // namespace vsprite
