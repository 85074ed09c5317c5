// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/kernels.h - the inner loops of all pairs, in whatever registers this processor has.
//
// Integer sums, so every instruction set gives the same bits; the float bounds only refuse pairs
// with a margin above their rounding, so what they let through does not matter either.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "similarity/cells.h"

namespace vsprite::detail {

/// What two pictures have in common.
struct PairSums {
  std::uint64_t color = 0;    ///< sum of min(a_i, a_j) |c_i - c_j|^2, in steps
  std::uint32_t overlap = 0;  ///< sum of min(a_i, a_j); sum |a_i - a_j| = coverage - 2 overlap
};
PairSums compare_cells(const CellImage& a, const CellImage& b) noexcept;

/// All samples, one column a quantity, in units of D: what a row of pairs is filtered by. Columns
/// end in kPadding entries more.
struct PairTable {
  static constexpr std::size_t kPadding = 16;
  std::vector<float> speed, angle, area, red, green, blue, coverage;
  std::vector<std::int16_t> coarse;  ///< (N, coarse_size) coverage of 8 x 8 cells
  std::size_t coarse_size = 0;       ///< a multiple of 32, padded with 0
  /// (N, mean_size) of the most telling blocks, as cells of a block: the least coverage in each,
  /// then its mean red, green, blue, rounded.
  std::vector<std::uint8_t, LineAllocator<std::uint8_t>> means;
  std::size_t mean_size = 0;  ///< a multiple of kBlockBytes
  std::vector<const CellImage*> cells;
  float speed_weight = 0, angle_weight = 0, area_weight = 0, mean_weight = 0;
  float alpha_weight = 0;   ///< per unit of the sum of |a_i - a_j|
  double color_weight = 0;  ///< per root of a unit of the colour sum
  float fade = 1;           ///< v0, px/s
  float limit = 1;          ///< pairs whose bound is above it are refused, margin included
  bool per_area = false;    ///< divide by the mean area of the pair, see features.h
};

/// A pair that no bound refused.
struct Candidate {
  std::uint32_t j = 0;
  PairSums sums;
};

/// Columns that filter_row takes at once; its `out` holds as many.
inline constexpr std::size_t kRowPart = 256;

/// Pairs (i, j), begin <= j < end <= begin + kRowPart, that may be within the limit; ascending.
/// Returns their count; adds to `compared` those whose cells were looked at.
std::size_t filter_row(const PairTable& table, std::size_t i, std::size_t begin, std::size_t end,
                       Candidate* out, std::uint64_t& compared) noexcept;

/// The instruction set in use, for reports: "AVX2".
const char* kernel_target() noexcept;
/// Every instruction set that this build holds and this processor runs, widest first; a test
/// calls use_kernel_target(k) for each and -1 to return to the best. Not while kernels run.
std::vector<const char*> kernel_targets();
void use_kernel_target(int k);

}  // namespace vsprite::detail
