// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/lanes.h - the keyer's inner loops, compiled for every instruction set through Highway and
// chosen at run time.
//
// Every function works on runs of cells or pixels, in integers, or in single floats of which each
// result depends on its own inputs in a fixed order, without fused multiply-add and without libm:
// the same bytes on every machine (tests/precompute/lanes_test.cpp holds them to it).
#pragma once

#include <cstddef>
#include <cstdint>

#include "film/color.h"

namespace vsprite::detail {

using Planes = float* const (&)[3];             ///< R, G, B side by side
using ConstPlanes = const float* const (&)[3];  ///< the same, to read

/// A quadratic along a row of cells: a + u (b + u c) at u = first + step i.
struct RowTerms {
  float a, b, c;
};
struct RowScale {
  float first, step;
};

/// What a row of cells may differ from the plate before it is not screen: sums of four Y, Cb, Cr;
/// each after a shift, the drift of the frame.
struct RowLimits {
  std::int16_t shift_y, limit_y, shift_cb, shift_cr, limit_c;
};

/// A colour difference: `main` less the larger of the other two channels (single), or the lesser of
/// the other two less `main`.
struct KeyShape {
  int main, one, two;
  bool single;
};

/// 1, r, g, b, rr, rg, rb, gg, gb, bb of a colour.
inline constexpr int kMoments = 10;

/// A row of cells and those about it; zeros where there is none.
struct RowsAround {
  const float *above, *middle, *below;
};

/// One row of cells for the projection. `mode` 0: not wanted, 1: mean only, 2: alpha too.
struct ProjectionRow {
  const std::uint8_t* mode;
  const float* moment[kMoments];
  const float* frame[3];
  const float* plate[3];
  const float* noise[3];
  const float* bound;
  float* mean[3];
  float* alpha;
  float* residual;  ///< may be null
};

/// Evidence of coverage: the larger of key times `inverse` and 1.15 times the bound, in the region.
struct ScoreRow {
  const float *key, *bound;
  const std::uint8_t* region;
  float inverse, sure, likely;
};

/// One row of pixels, all bilinear from cells but `detail`: alpha + gain (detail - guide).
struct AlphaRow {
  const float *alpha, *gain, *guide, *detail;
  float shade, low, high;
};

/// One row of pixels to paint. `color` is weight times encoded own colour, `weight` the bilinear
/// alpha; `expected` is the linear luma of the mixture less the plate's, `detail` that of the film.
struct PaintRow {
  const std::uint8_t* alpha;
  const float* weight;
  const float* color[3];
  const float* detail;
  const float* plate;  ///< linear luma
  float red, green, blue;
};

struct Lanes {
  /// Adds to each count how many of a run of `block` cells differ from the plate by more than that
  /// run's limits; n cells in all.
  void (*count_different)(const std::uint8_t* top, const std::uint8_t* low, const std::uint8_t* cb,
                          const std::uint8_t* cr, const std::uint16_t* plate_y,
                          const std::uint8_t* plate_cb, const std::uint8_t* plate_cr, int n,
                          int block, const RowLimits* limits, int* counts);
  /// Sums of four encoded R, G, B, 0..1020, of whole cells.
  void (*sum_cells)(const RgbOfYcc& matrix, const std::uint8_t* top, const std::uint8_t* low,
                    const std::uint8_t* cb, const std::uint8_t* cr, int n, std::uint16_t* red,
                    std::uint16_t* green, std::uint16_t* blue);
  /// Distance to plate + drift, code values.
  void (*contrast)(const std::uint16_t* const (&sums)[3], ConstPlanes plate,
                   const RowTerms (&drift)[3], RowScale u, int n, float* out);
  /// out = table[index].
  void (*look_up)(const float* table, const std::uint16_t* index, int n, float* out);
  /// base + slope (a + u (b + u c)), bounded to 0..1.
  void (*shift)(const float* base, const float* slope, RowTerms drift, RowScale u, int n,
                float* out);
  /// Contrast becomes 0 where C = s B within 12 %, 0.35 < s < 1.3: the screen in shade.
  void (*forgive_shadows)(ConstPlanes frame, ConstPlanes plate, std::size_t n, float* contrast);
  /// out = 1 where value > limit, else 0.
  void (*above)(const float* values, float limit, std::size_t n, std::uint8_t* out);
  /// inout = the larger (the lesser) of two.
  void (*spread_into)(const std::uint8_t* in, std::size_t n, bool larger, std::uint8_t* inout);
  /// A bit a cell, where `in` is not 0 or, of the complement, where it is; and back to 0 and 1.
  /// `bits`: whole words, what is left of the last is 0; eight bytes more may be read.
  void (*pack_bits)(const std::uint8_t* in, int n, bool complement, std::uint64_t* bits);
  void (*unpack_bits)(const std::uint64_t* bits, int n, bool complement, std::uint8_t* out);
  /// Sums of five values `stride` apart times `scale`, n of them; two before and behind are read.
  void (*sum5)(const float* in, std::ptrdiff_t stride, std::size_t n, float scale, float* out);
  /// Sums of three neighbours, n of them; one before and behind is read.
  void (*sum3)(const float* in, std::size_t n, float* out);
  /// out = mean of nine, given three rows' sums of three, + far + whole.
  void (*add_far)(const float* above, const float* middle, const float* below, const float* far,
                  float whole, int n, float* out);
  /// Means over 3 x 3 of the cells begin..end of a row of `width`; to its left and right is 0.
  void (*blur3)(const RowsAround& in, int width, int begin, int end, float* out);
  /// Alpha below this puts F outside the gamut; two sigma of noise are taken off.
  void (*gamut_bound)(ConstPlanes frame, ConstPlanes plate, ConstPlanes noise, std::size_t n,
                      float* bound);
  /// v = 1 - K(C) / K(B); |C - B| where the plate has no key.
  void (*key_share)(ConstPlanes frame, ConstPlanes plate, KeyShape shape, std::size_t n,
                    float* share);
  void (*distance)(ConstPlanes frame, ConstPlanes plate, std::size_t n, float* out);
  /// 1 where the score is above `sure`, above `likely`.
  void (*score)(const ScoreRow& row, std::size_t n, std::uint8_t* sure, std::uint8_t* likely);
  /// Means over squares of 2 x 2 cells of weight times moment; `n` cells of two rows (the second
  /// may be absent: null).
  void (*moments)(const float* top_weight, const float* low_weight, ConstPlanes top,
                  ConstPlanes low, int n, float* const (&out)[kMoments]);
  /// Bilinear doubling of a row of n, a first + b second: 2 n out.
  void (*double_row)(const float* first, float a, const float* second, float b, int n, float* out);
  /// The cells of a row from `begin` to `end`; blocks of lanes reach over them inside 0..n.
  void (*project)(const ProjectionRow& row, float spill, int begin, int end, int n);
  /// Modes of a row (above): seeds are known, the rest of the region is not; of seeds the mean is
  /// wanted where `means` (may be null), their alpha is 1, else 0. False where nothing is wanted.
  bool (*modes)(const std::uint8_t* seeds, const std::uint8_t* region, const std::uint8_t* means,
                std::size_t n, std::uint8_t* mode, float* alpha);
  /// values = 1 where `seeds`.
  void (*set_sure)(const std::uint8_t* seeds, std::size_t n, float* values);
  /// Alpha of a colourless part, C = g (1, 1, 1) + (1 - alpha) B, and how surely (0..1) that is
  /// one: where the foreground nearby is a colour and `residual`, what it leaves unexplained, is
  /// more. From alpha = `most` on it is none.
  void (*colorless)(ConstPlanes frame, ConstPlanes plate, ConstPlanes noise, ConstPlanes mean,
                    const float* bound, const float* residual, float most, std::size_t n,
                    float* alpha, float* share);
  /// The weight of a cell's colour in its neighbourhood by how opaque the rim is, and that colour.
  void (*weigh_rim)(const std::uint8_t* seeds, const float* soft, const float* alpha,
                    ConstPlanes frame, ConstPlanes plate, std::size_t n, float* weight,
                    Planes color);
  /// The drift of linear luma for the two pixels of each of n cells, from cell `first` of a row on:
  /// slope of the transfer times the code's drift, at u = step cell - 1.
  void (*luma_drift)(const float* slope, const RowTerms (&drift)[3], const float (&weights)[3],
                     int first, double step, int n, float* out);
  /// Linear luma of n pixels less the plate's and the drift, linear too.
  void (*detail)(const std::uint8_t* y, const float* light, const std::uint16_t* plate,
                 const float* drift, int n, float* out, float* out_plate);
  /// Mean of two rows of 2 n pixels by cells.
  void (*halve)(const float* top, const float* low, int n, float* out);
  /// cov(a, g) / (var(g) + ridge) over 3 x 3, as in blur3.
  void (*gain)(const RowsAround& a, const RowsAround& g, int width, int begin, int end, float* out);
  /// inner = 2 where not `some`, else `full`; the gain of inner cells is 0.
  void (*inner)(const std::uint8_t* some, const std::uint8_t* full, std::size_t n,
                std::uint8_t* inner, float* gain);
  void (*raise_alpha)(const AlphaRow& row, int n, std::uint8_t* out);
  /// Two pixels a cell: 255 where it is inner (1), 0 where it is outer (2).
  void (*settle)(const std::uint8_t* inner, int n, std::uint8_t* alpha);
  /// The subject's own linear colour: unmixed where there is enough of it, else its
  /// neighbourhood's; the screen's hue is taken out as far as the neighbourhood has none of it.
  void (*own_color)(const float* alpha, ConstPlanes frame, ConstPlanes plate, ConstPlanes mean,
                    const std::uint8_t* inner, bool keyed, KeyShape shape, std::size_t n,
                    Planes own);
  /// Linear own colour becomes weight times encoded own colour, code values.
  void (*encode)(const float* weight, float* plane, std::size_t n);
  /// Straight RGBA of n pixels, as filmed and of the subject's own colour.
  void (*paint_filmed)(const RgbOfYcc& matrix, const std::uint8_t* y, const std::uint8_t* cb,
                       const std::uint8_t* cr, int n, std::uint8_t* rgba);
  void (*paint_own)(const PaintRow& row, int n, std::uint8_t* rgba);
  /// Of n cells of two rows of pixels: 1 where any of the four has alpha, where they have half of
  /// it.
  void (*cover)(const std::uint8_t* top, const std::uint8_t* low, int n, std::uint8_t* some,
                std::uint8_t* half);
  /// Two pixels a cell: the cell's label where there is alpha, else 0.
  void (*name_pixels)(const std::uint8_t* alpha, const int* label, int n, std::uint8_t* out);
  /// Sum of |a - b|.
  std::uint32_t (*difference)(const std::uint8_t* a, const std::uint8_t* b, int n);
};

/// The set for this machine's best instructions.
const Lanes& lanes();

}  // namespace vsprite::detail
