// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Compiled once for each instruction set (Highway), chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "similarity/kernels.cpp"
#include <hwy/foreach_target.h>
// after foreach_target
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>

#include "similarity/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace vsprite::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A block is 16 cells: one register, or two or four where they are short.
using Cells = hn::CappedTag<std::int16_t, kBlockCells>;
using Sums = hn::RepartitionToWide<Cells>;

constexpr int kBlocksBetweenChecks = 4;  // 4 blocks add less than 2^32: a 32-bit sum is exact

// Sum of w d^2 in 16-bit products: d^2 < 2^16 is taken as d^2 - 2^15, which is signed, and the
// bias 3 x 2^15 x sum of w is put back when the lanes are added up.
constexpr int kBias = 3 << 15;

struct Accumulator {
  hn::Vec<Sums> color, color_odd, weight, weight_odd;
};

HWY_INLINE void clear(Accumulator& sum) {
  sum.color = sum.color_odd = sum.weight = sum.weight_odd = hn::Zero(Sums());
}

HWY_INLINE void add_block(const std::int16_t* HWY_RESTRICT a, const std::int16_t* HWY_RESTRICT b,
                          Accumulator& sum) {
  const Cells d;
  const Sums d32;
  const auto one = hn::Set(d, std::int16_t{1});
  const auto sign = hn::Set(d, std::int16_t{-0x8000});
  for (std::size_t c = 0; c < kBlockCells; c += hn::Lanes(d)) {
    const auto w = hn::Min(hn::Load(d, a + c), hn::Load(d, b + c));
    sum.weight = hn::ReorderWidenMulAccumulate(d32, w, one, sum.weight, sum.weight_odd);
    for (std::size_t k = kBlockCells; k < 4 * kBlockCells; k += kBlockCells) {
      const auto difference = hn::Sub(hn::Load(d, a + k + c), hn::Load(d, b + k + c));
      const auto square = hn::Xor(hn::Mul(difference, difference), sign);
      sum.color = hn::ReorderWidenMulAccumulate(d32, w, square, sum.color, sum.color_odd);
    }
  }
}

// Moves the lanes into `sums`.
HWY_INLINE void take_sums(Accumulator& sum, PairSums& sums) {
  const Sums d32;
  const auto weight = hn::Add(sum.weight, sum.weight_odd);
  const auto color = hn::Add(hn::Add(sum.color, sum.color_odd),
                             hn::Mul(weight, hn::Set(d32, std::int32_t{kBias})));
  sums.color += static_cast<std::uint32_t>(hn::GetLane(hn::SumOfLanes(d32, color)));
  sums.overlap += static_cast<std::uint32_t>(hn::GetLane(hn::SumOfLanes(d32, weight)));
  clear(sum);
}

// False as soon as the colour sum exceeds `budget`.
HWY_INLINE bool compare(const CellImage& a, const CellImage& b, double budget, PairSums& sums) {
  const std::int16_t* cells_a = a.cells.data();
  const std::int16_t* cells_b = b.cells.data();
  Accumulator sum;
  clear(sum);
  int pending = 0;
  for (std::size_t w = 0; w < a.seen.size(); ++w) {
    const std::uint64_t in_a = a.seen[w], in_b = b.seen[w];
    for (std::uint64_t both = in_a & in_b; both != 0; both &= both - 1) {
      const std::uint64_t below = (both & (~both + 1)) - 1;
      add_block(cells_a + 4 * kBlockCells * std::popcount(in_a & below),
                cells_b + 4 * kBlockCells * std::popcount(in_b & below), sum);
      if (++pending < kBlocksBetweenChecks) continue;
      pending = 0;
      take_sums(sum, sums);
      if (static_cast<double>(sums.color) > budget) return false;
    }
    cells_a += 4 * kBlockCells * std::popcount(in_a);
    cells_b += 4 * kBlockCells * std::popcount(in_b);
  }
  take_sums(sum, sums);
  return static_cast<double>(sums.color) <= budget;
}

PairSums CompareCells(const CellImage& a, const CellImage& b) {
  PairSums sums;
  compare(a, b, std::numeric_limits<double>::infinity(), sums);
  return sums;
}

// Sum of |A_i - A_j| over coarse squares, a lower bound of the sum of |a_i - a_j|.
HWY_INLINE std::uint32_t coarse_difference(const std::int16_t* HWY_RESTRICT a,
                                           const std::int16_t* HWY_RESTRICT b, std::size_t count) {
  const Cells d;
  const Sums d32;
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
  std::size_t count = 0;
};

template <bool kPerArea>
HWY_INLINE void filter_cheap(const PairTable& t, std::size_t i, std::size_t begin, std::size_t end,
                             Left& left) {
  const hn::ScalableTag<float> d;
  const hn::RebindToUnsigned<decltype(d)> du;
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
    const auto in = hn::And(hn::Le(bound, limit), hn::FirstN(d, end - j));
    if (hn::AllFalse(d, in)) continue;
    const auto column = hn::Iota(du, static_cast<std::uint32_t>(j));
    hn::CompressStore(column, hn::RebindMask(du, in), du, left.column.data() + left.count);
    left.count += hn::CompressStore(bound, in, d, left.bound.data() + left.count);
  }
}

std::size_t FilterRow(const PairTable& t, std::size_t i, std::size_t begin, std::size_t end,
                      Candidate* out, std::uint64_t& compared) {
  Left left;
  if (t.per_area) {
    filter_cheap<true>(t, i, begin, end, left);
  } else {
    filter_cheap<false>(t, i, begin, end, left);
  }
  const CellImage& a = *t.cells[i];
  const std::int16_t* coarse = t.coarse.data() + i * t.coarse_size;
  std::size_t count = 0;
  for (std::size_t n = 0; n < left.count; ++n) {
    const std::size_t j = left.column[n];
    const CellImage& b = *t.cells[j];
    float alpha_weight = t.alpha_weight;
    double color_scale = 1;
    if (t.per_area) {
      const auto mean = static_cast<float>(a.coverage + b.coverage) / 2;
      alpha_weight = mean > 0 ? alpha_weight / mean : 0;
      color_scale = static_cast<double>(mean);
    }
    const auto alpha = static_cast<float>(
        coarse_difference(coarse, t.coarse.data() + j * t.coarse_size, t.coarse_size));
    const float rest = t.limit - left.bound[n] - alpha_weight * alpha;
    if (rest < 0) continue;
    ++compared;
    const double most = static_cast<double>(rest) / t.color_weight;
    Candidate& candidate = out[count];
    candidate = {static_cast<std::uint32_t>(j), {}};
    if (compare(a, b, most * most * color_scale, candidate.sums)) ++count;
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
