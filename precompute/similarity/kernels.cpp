// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Compiled once for each instruction set (Highway), chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "similarity/kernels.cpp"
#include <hwy/foreach_target.h>
// after foreach_target
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>

#include "similarity/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace vsprite::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Squares = hn::CappedTag<std::int16_t, 32>;  // coarse ones, see coarse_difference

constexpr std::size_t kAhead = 4;  // pairs between a prefetch and its use
constexpr int kBlocksBetweenChecks = 8;

#if HWY_TARGET == HWY_SCALAR  // which cannot see four bytes as one lane

struct Accumulator {
  std::uint64_t color;
  std::uint32_t overlap;
};

HWY_INLINE void clear(Accumulator& sum) { sum = {}; }

template <int kLess>
HWY_INLINE void add_block(const std::uint8_t* a, const std::uint8_t* b, Accumulator& sum) {
  for (std::size_t c = 0; c < kBlockBytes; c += 4) {
    const std::uint32_t weight = std::min(a[c], b[c]);
    std::uint32_t squares = 0;
    for (std::size_t k = c + 1; k < c + 4; ++k) {
      const int apart = std::max(std::abs(a[k] - b[k]) - kLess, 0);
      squares += static_cast<std::uint32_t>(apart * apart);
    }
    sum.color += weight * squares;
    sum.overlap += weight;
  }
}

HWY_INLINE void widen(Accumulator&) {}
HWY_INLINE std::uint64_t color_sum(const Accumulator& sum) { return sum.color; }
HWY_INLINE std::uint32_t overlap_sum(const Accumulator& sum) { return sum.overlap; }

#else

// A block is 16 cells of four bytes: one register, or two or four where registers are short.
using Bytes = hn::CappedTag<std::uint8_t, kBlockBytes>;
using Cells = hn::Repartition<std::uint32_t, Bytes>;  // a lane a cell
using Halves = hn::Repartition<std::uint16_t, Bytes>;
using Totals = hn::Repartition<std::uint64_t, Bytes>;

// A cell adds at most 255 x 3 x 127^2 of colour and 255 of overlap to a lane: 256 stay below 2^32
// and 2^16, which is every block where a register holds one, else a word of CellImage::seen.
constexpr bool kWiden = hn::MaxLanes(Bytes()) < kBlockBytes;

struct Accumulator {
  hn::Vec<Cells> color;
  hn::Vec<Halves> overlap;  // every weight twice
  hn::Vec<Totals> wide_color;
  hn::Vec<Cells> wide_overlap;
};

HWY_INLINE void clear(Accumulator& sum) {
  sum.color = sum.wide_overlap = hn::Zero(Cells());
  sum.overlap = hn::Zero(Halves());
  sum.wide_color = hn::Zero(Totals());
}

// Squares of neighbouring bytes, added up by two. Each is at most 127, so a sum is a positive i16.
HWY_INLINE hn::Vec<Halves> squares_by_two(hn::Vec<Bytes> v) {
  const Halves d;
#if HWY_TARGET == HWY_AVX3
  return hn::Vec<Halves>{_mm512_maddubs_epi16(v.raw, v.raw)};
#elif HWY_TARGET == HWY_AVX2
  return hn::Vec<Halves>{_mm256_maddubs_epi16(v.raw, v.raw)};
#elif HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_SSSE3
  return hn::Vec<Halves>{_mm_maddubs_epi16(v.raw, v.raw)};
#else
  const auto pairs = hn::BitCast(d, v);
  const auto even = hn::And(pairs, hn::Set(d, 0xffu)), odd = hn::ShiftRight<8>(pairs);
  return hn::Add(hn::Mul(even, even), hn::Mul(odd, odd));
#endif
}

// `kLess`: taken off every difference, in steps of colour.
template <int kLess>
HWY_INLINE void add_block(const std::uint8_t* HWY_RESTRICT a, const std::uint8_t* HWY_RESTRICT b,
                          Accumulator& sum) {
  const Bytes d;
  const Halves halves;
  const hn::RebindToSigned<Halves> i16;
  const hn::RebindToSigned<Cells> i32;
  alignas(16) static constexpr std::uint8_t kWeightTwice[16] = {0, 0x80, 0, 0x80, 4,  0x80, 4,  0x80,
                                                                8, 0x80, 8, 0x80, 12, 0x80, 12, 0x80};
  const auto twice = hn::LoadDup128(d, kWeightTwice);
  const auto colors = hn::BitCast(d, hn::Set(Cells(), 0xffffff00u));
  for (std::size_t c = 0; c < kBlockBytes; c += hn::Lanes(d)) {
    const auto x = hn::Load(d, a + c), y = hn::Load(d, b + c);
    const auto smaller = hn::Min(x, y);
    auto apart = hn::And(hn::Sub(hn::Max(x, y), smaller), colors);
    if constexpr (kLess > 0) apart = hn::SaturatedSub(apart, hn::Set(d, std::uint8_t{kLess}));
    const auto weight = hn::BitCast(halves, hn::TableLookupBytesOr0(smaller, twice));
    auto odd = hn::Zero(i32);
    const auto color = hn::ReorderWidenMulAccumulate(
        i32, hn::BitCast(i16, squares_by_two(apart)), hn::BitCast(i16, weight),
        hn::BitCast(i32, sum.color), odd);
    sum.color = hn::BitCast(Cells(), hn::Add(color, odd));
    sum.overlap = hn::Add(sum.overlap, weight);
  }
}

HWY_INLINE hn::Vec<Totals> wide_color(const Accumulator& sum) {
  const Totals d;
  const auto color = hn::BitCast(d, sum.color);
  return hn::Add(hn::And(color, hn::Set(d, 0xffffffffu)), hn::ShiftRight<32>(color));
}

HWY_INLINE hn::Vec<Cells> wide_overlap(const Accumulator& sum) {
  return hn::And(hn::BitCast(Cells(), sum.overlap), hn::Set(Cells(), 0xffffu));
}

// After 64 blocks.
HWY_INLINE void widen(Accumulator& sum) {
  if constexpr (kWiden) {
    sum.wide_color = hn::Add(sum.wide_color, wide_color(sum));
    sum.wide_overlap = hn::Add(sum.wide_overlap, wide_overlap(sum));
    sum.color = hn::Zero(Cells());
    sum.overlap = hn::Zero(Halves());
  }
}

HWY_INLINE std::uint64_t color_sum(const Accumulator& sum) {
  auto color = wide_color(sum);
  if constexpr (kWiden) color = hn::Add(color, sum.wide_color);
  return hn::GetLane(hn::SumOfLanes(Totals(), color));
}

HWY_INLINE std::uint32_t overlap_sum(const Accumulator& sum) {
  auto overlap = wide_overlap(sum);
  if constexpr (kWiden) overlap = hn::Add(overlap, sum.wide_overlap);
  return hn::GetLane(hn::SumOfLanes(Cells(), overlap));
}

#endif

// False as soon as the colour sum exceeds `budget`; `sums` are then of no use.
template <bool kBudget>
HWY_INLINE bool compare(const CellImage& a, const CellImage& b, std::uint64_t budget,
                        PairSums& sums) {
  const std::uint8_t *cells_a = a.cells.data(), *cells_b = b.cells.data();
  Accumulator sum;
  clear(sum);
  int pending = 0;
  for (std::size_t w = 0; w < a.seen.size(); ++w) {
    const std::uint64_t in_a = a.seen[w], in_b = b.seen[w];
    for (std::uint64_t both = in_a & in_b; both != 0; both &= both - 1) {
      const std::uint64_t below = (both & (~both + 1)) - 1;
      add_block<0>(cells_a + kBlockBytes * std::popcount(in_a & below),
                   cells_b + kBlockBytes * std::popcount(in_b & below), sum);
      if (!kBudget || ++pending < kBlocksBetweenChecks) continue;
      pending = 0;
      if (color_sum(sum) > budget) return false;
    }
    widen(sum);
    cells_a += kBlockBytes * std::popcount(in_a);
    cells_b += kBlockBytes * std::popcount(in_b);
  }
  sums.color = color_sum(sum);
  sums.overlap = overlap_sum(sum);
  return sums.color <= budget;
}

PairSums CompareCells(const CellImage& a, const CellImage& b) {
  PairSums sums;
  compare<false>(a, b, ~std::uint64_t{0}, sums);
  return sums;
}

// Sum of |A_i - A_j| over coarse squares, a lower bound of the sum of |a_i - a_j|.
HWY_INLINE std::uint32_t coarse_difference(const std::int16_t* HWY_RESTRICT a,
                                           const std::int16_t* HWY_RESTRICT b, std::size_t count) {
  const Squares d;
  const hn::RepartitionToWide<Squares> d32;
  const auto one = hn::Set(d, std::int16_t{1});
  auto sum = hn::Zero(d32), odd = hn::Zero(d32);
  for (std::size_t c = 0; c < count; c += hn::Lanes(d)) {
    const auto x = hn::LoadU(d, a + c), y = hn::LoadU(d, b + c);
    const auto difference = hn::Sub(hn::Max(x, y), hn::Min(x, y));
    sum = hn::ReorderWidenMulAccumulate(d32, difference, one, sum, odd);
  }
  return static_cast<std::uint32_t>(hn::GetLane(hn::SumOfLanes(d32, hn::Add(sum, odd))));
}

// What the four features without pixels leave: columns and lower bounds of D.
struct Left {
  std::array<std::uint32_t, kRowPart + 64> column;
  std::array<float, kRowPart + 64> bound;
  std::array<std::uint64_t, kRowPart + 64> budget;  // of colour
  std::size_t count;
};

template <bool kPerArea>
HWY_NOINLINE void filter_cheap(const PairTable& t, std::size_t i, std::size_t begin,
                               std::size_t end, Left& left) {
  const hn::ScalableTag<float> d;
  const auto circle = hn::Set(d, 6.28318530717958647692f), zero = hn::Zero(d);
  const auto slack = hn::Set(d, 1e-6f);  // two roundings of an angle
  const auto one = hn::Set(d, 1.0f), fade = hn::Set(d, 1.0f / t.fade);
  const auto limit = hn::Set(d, t.limit);
  const auto speed = hn::Set(d, t.speed[i]), angle = hn::Set(d, t.angle[i]);
  const auto area = hn::Set(d, t.area[i]), red = hn::Set(d, t.red[i]);
  const auto green = hn::Set(d, t.green[i]), blue = hn::Set(d, t.blue[i]);
  for (std::size_t j = begin; j < end; j += hn::Lanes(d)) {
    const auto other = hn::LoadU(d, t.speed.data() + j);
    auto speed_part = hn::Abs(hn::Sub(speed, other));
    const auto apart = hn::Abs(hn::Sub(angle, hn::LoadU(d, t.angle.data() + j)));
    const auto turn = hn::Max(hn::Sub(hn::Min(apart, hn::Sub(circle, apart)), slack), zero);
    const auto faded = hn::Min(hn::Mul(hn::Min(speed, other), fade), one);
    const auto other_area = hn::LoadU(d, t.area.data() + j);
    auto area_part = hn::Abs(hn::Sub(area, other_area));
    if constexpr (kPerArea) {
      const auto mean = hn::Mul(hn::Add(area, other_area), hn::Set(d, 0.5f));
      const auto any = hn::Gt(mean, zero);
      speed_part = hn::IfThenElseZero(any, hn::Div(speed_part, hn::Sqrt(mean)));
      area_part = hn::IfThenElseZero(any, hn::Div(area_part, mean));
    }
    const auto r = hn::Sub(red, hn::LoadU(d, t.red.data() + j));
    const auto g = hn::Sub(green, hn::LoadU(d, t.green.data() + j));
    const auto b = hn::Sub(blue, hn::LoadU(d, t.blue.data() + j));
    const auto mean_part = hn::Sqrt(hn::Add(hn::Add(hn::Mul(r, r), hn::Mul(g, g)), hn::Mul(b, b)));
    auto bound = hn::Mul(speed_part, hn::Set(d, t.speed_weight));
    bound = hn::Add(bound, hn::Mul(hn::Mul(faded, turn), hn::Set(d, t.angle_weight)));
    bound = hn::Add(bound, hn::Mul(mean_part, hn::Set(d, t.mean_weight)));
    bound = hn::Add(bound, hn::Mul(area_part, hn::Set(d, t.area_weight)));
    if (hn::AllFalse(d, hn::Le(bound, limit))) continue;
    // Highway's Compress copies its tables to the stack here (1.0.3, GCC 12).
    HWY_ALIGN float bounds[hn::MaxLanes(d)];
    hn::Store(bound, d, bounds);
    const std::size_t lanes = std::min(hn::Lanes(d), end - j);
    for (std::size_t k = 0; k < lanes; ++k) {
      left.column[left.count] = static_cast<std::uint32_t>(j + k);
      left.bound[left.count] = bounds[k];
      left.count += bounds[k] <= t.limit ? 1 : 0;
    }
  }
}

// Takes coarse coverage into the bounds.
HWY_NOINLINE void filter_coarse(const PairTable& t, std::size_t i, Left& left) {
  const std::int16_t* coarse = t.coarse.data() + i * t.coarse_size;
  std::size_t count = 0;
  for (std::size_t n = 0; n < left.count; ++n) {
    const std::uint32_t j = left.column[n];
    float weight = t.alpha_weight;
    if (t.per_area) weight /= std::max(t.coverage[i] + t.coverage[j], 1.0f) / 2;
    const float bound =
        left.bound[n] + weight * static_cast<float>(coarse_difference(
                                     coarse, t.coarse.data() + j * t.coarse_size, t.coarse_size));
    left.column[count] = j;
    left.bound[count] = bound;
    count += bound <= t.limit ? 1 : 0;
  }
  left.count = count;
}

// Whether the colour sum of the most telling blocks stays within `budget`, by their means: with
// least coverages u, v and 16 cells a block, sum of min(a, b) |c - d|^2 >= 16 min(u, v) |mean c -
// mean d|^2 (Jensen). Two rounded means may lie one step further apart than the means do.
HWY_NOINLINE bool within_by_means(const std::uint8_t* HWY_RESTRICT a,
                                  const std::uint8_t* HWY_RESTRICT b, std::size_t size,
                                  std::uint64_t budget) {
  Accumulator sum;
  clear(sum);
  for (std::size_t block = 0; block < size; block += kBlockBytes) {
    add_block<1>(a + block, b + block, sum);
  }
  return kBlockCells * color_sum(sum) <= budget;
}

// The largest colour sum that keeps the bound within the limit.
HWY_INLINE std::uint64_t color_budget(const PairTable& t, std::size_t i, std::size_t j,
                                      float bound) {
  const double most = static_cast<double>(t.limit - bound) / t.color_weight;
  const double unit =
      t.per_area ? static_cast<double>(std::max(t.coverage[i] + t.coverage[j], 1.0f)) / 2 : 1;
  return static_cast<std::uint64_t>(std::min(most * most * unit, 9e18));
}

// Takes the means of the most telling blocks into account, and leaves budgets.
HWY_NOINLINE void filter_means(const PairTable& t, std::size_t i, Left& left) {
  const std::uint8_t* means = t.means.data() + i * t.mean_size;
  std::size_t count = 0;
  for (std::size_t n = 0; n < left.count; ++n) {
    const std::uint32_t j = left.column[n];
    const std::uint64_t budget = color_budget(t, i, j, left.bound[n]);
    left.column[count] = j;
    left.budget[count] = budget;
    count += within_by_means(means, t.means.data() + j * t.mean_size, t.mean_size, budget) ? 1 : 0;
  }
  left.count = count;
}

std::size_t FilterRow(const PairTable& t, std::size_t i, std::size_t begin, std::size_t end,
                      Candidate* out, std::uint64_t& compared) {
  Left left;
  left.count = 0;
  if (t.per_area) {
    filter_cheap<true>(t, i, begin, end, left);
  } else {
    filter_cheap<false>(t, i, begin, end, left);
  }
  filter_coarse(t, i, left);
  filter_means(t, i, left);
  compared += left.count;
  if (left.count == 0) return 0;
  const CellImage& a = *t.cells[i];
  std::size_t count = 0;
  for (std::size_t n = 0; n < left.count; ++n) {
    if (n + kAhead < left.count) {
      const std::uint8_t* next = t.cells[left.column[n + kAhead]]->cells.data();
      for (int k = 0; k < kBlocksBetweenChecks; ++k) hwy::Prefetch(next + k * kBlockBytes);
    }
    const std::size_t j = left.column[n];
    Candidate& candidate = out[count];
    candidate.j = left.column[n];
    if (compare<true>(a, *t.cells[j], left.budget[n], candidate.sums)) ++count;
  }
  return count;
}

}  // namespace vsprite::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vsprite::detail {

HWY_EXPORT(CompareCells);
HWY_EXPORT(FilterRow);

PairSums compare_cells(const CellImage& a, const CellImage& b) noexcept {
  return HWY_DYNAMIC_DISPATCH(CompareCells)(a, b);
}

std::size_t filter_row(const PairTable& table, std::size_t i, std::size_t begin, std::size_t end,
                       Candidate* out, std::uint64_t& compared) noexcept {
  return HWY_DYNAMIC_DISPATCH(FilterRow)(table, i, begin, end, out, compared);
}

std::vector<const char*> kernel_targets() {
  std::vector<const char*> names;
  hwy::SetSupportedTargetsForTest(0);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    names.push_back(hwy::TargetName(target));
  }
  return names;
}

void use_kernel_target(int k) {
  hwy::SetSupportedTargetsForTest(0);
  if (k >= 0) {
    hwy::SetSupportedTargetsForTest(
        hwy::SupportedAndGeneratedTargets()[static_cast<std::size_t>(k)]);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

const char* kernel_target() noexcept {
  const auto targets = hwy::SupportedAndGeneratedTargets();
  return targets.empty() ? "none" : hwy::TargetName(targets.front());
}

}  // namespace vsprite::detail
#endif  // HWY_ONCE
