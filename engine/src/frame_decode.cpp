// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// From residuals to pixels, compiled once for each instruction set (Highway), chosen at the first
// call. Bytes are added modulo 256, so that every one of them gives the same picture.
//
// With x the pixel, u the one above it and d = x - u, a row holds d ("plain") or the difference of
// d from the d to its left ("smooth"): d is then the running sum of what is stored, sixteen bytes
// in four steps.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "frame_decode.cpp"
#include <hwy/foreach_target.h>
// after foreach_target
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

#include "frame_codec.h"

#ifndef VSPRITE_FRAME_DECODE_ONCE
#define VSPRITE_FRAME_DECODE_ONCE
namespace vsprite::detail {

constexpr std::size_t kStep = 16;  // pixels at a time

// Value i of a block of width w stands in bits i w to i w + w - 1. `shuffle` brings the two bytes
// that hold it into one 16-bit lane, `scale` moves its top bit to the lane's, and an arithmetic
// shift to the right by `down` extends its sign.
struct alignas(16) Unpacking {
  std::array<std::uint8_t, 16> shuffle;
  std::array<std::int16_t, kBlock> scale;
  int down, bytes;
  int padding[2];
};

constexpr Unpacking make_unpacking(int width) {
  Unpacking u{};
  u.bytes = width;
  u.down = width == 0 ? 15 : 16 - width;
  for (int i = 0; i < 8 && width != 0; ++i) {
    const int bit = i * width;
    u.shuffle[static_cast<std::size_t>(2 * i)] = static_cast<std::uint8_t>(bit / 8);
    u.shuffle[static_cast<std::size_t>(2 * i + 1)] = static_cast<std::uint8_t>(bit / 8 + 1);
    u.scale[static_cast<std::size_t>(i)] = static_cast<std::int16_t>(1 << (16 - width - bit % 8));
  }
  return u;
}

constexpr std::array<Unpacking, 8> kUnpacking{
    make_unpacking(kWidths[0]), make_unpacking(kWidths[1]), make_unpacking(kWidths[2]),
    make_unpacking(kWidths[3]), make_unpacking(kWidths[4]), make_unpacking(kWidths[5]),
    make_unpacking(kWidths[6]), make_unpacking(kWidths[7])};

// Planes in the scratch: residuals of all runs, and two rows.
inline std::size_t residual_stride(const FrameParts& p) { return (p.pixels / kStep + 2) * kStep; }
inline std::size_t row_stride(const FrameParts& p) {
  return (static_cast<std::size_t>(p.width) / kStep + 2) * kStep;
}

}  // namespace vsprite::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace vsprite::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// Plain loops: for CPUs without any of the above, and what the others are tested against.

HWY_INLINE void unpack(unsigned code, const std::uint8_t*& from, int* values) {
  const unsigned width = kWidths[code & 7];
  std::uint64_t bits = 0;
  for (unsigned k = 0; k < width; ++k) bits |= std::uint64_t{*from++} << (8 * k);
  for (std::size_t i = 0; i < kBlock; ++i, bits >>= width) {
    const auto low = static_cast<int>(bits & ((1u << width) - 1));
    values[i] = width != 0 && low >> (width - 1) != 0 ? low - (1 << width) : low;
    if (width == 0) values[i] = 0;
  }
}

void Unpack(const FrameParts& p, std::uint8_t* planes, std::size_t stride) {
  const std::uint8_t* from = p.residuals;
  for (std::size_t b = 0; b < (p.pixels + kBlock - 1) / kBlock; ++b) {
    const unsigned codes = block_codes(p.widths, b);
    int alpha[kBlock], red[kBlock], green[kBlock], blue[kBlock];
    unpack(codes, from, alpha);
    unpack(codes >> 3, from, red);
    unpack(codes >> 6, from, green);
    unpack(codes >> 9, from, blue);
    for (std::size_t i = 0; i < kBlock; ++i) {
      const auto share = [&](Channel c) { return alpha[i] * p.factors[c] >> kFactorShift; };
      const auto put = [&](Channel c, int value) {
        planes[c * stride + b * kBlock + i] = static_cast<std::uint8_t>(value);
      };
      const int g = green[i] + share(kGreen);
      put(kRed, red[i] + share(kRed) + g);
      put(kGreen, g);
      put(kBlue, blue[i] + share(kBlue) + g);
      put(kAlpha, alpha[i]);
    }
  }
}

HWY_INLINE void add_run(const std::uint8_t* residuals, const std::uint8_t* above, std::uint8_t* row,
                        std::size_t count, bool is_smooth) {
  unsigned before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned change = residuals[i] + (is_smooth ? before : 0);
    row[i] = static_cast<std::uint8_t>(above[i] + change);
    before = change;
  }
}

HWY_INLINE void interleave(const std::uint8_t* row, std::size_t stride, std::size_t begin,
                           std::size_t end, std::uint8_t* out, const std::uint8_t*) {
  for (std::size_t x = begin; x < end; ++x)
    for (std::size_t c = 0; c < 4; ++c) out[4 * x + c] = row[c * stride + x];
}

#else

using Bytes = hn::CappedTag<std::uint8_t, kStep>;
using Half = hn::CappedTag<std::uint8_t, kBlock>;
using Lanes = hn::CappedTag<std::int16_t, kBlock>;

HWY_INLINE hn::Vec<Lanes> unpack(unsigned code, const std::uint8_t*& from) {
  const Lanes lanes;
  const Bytes bytes;
  const Unpacking& u = kUnpacking[code & 7];
  const auto raw = hn::ZeroExtendVector(bytes, hn::LoadU(Half(), from));
  from += u.bytes;
  const auto pairs = hn::TableLookupBytes(raw, hn::Load(bytes, u.shuffle.data()));
  const auto top = hn::Mul(hn::BitCast(lanes, pairs), hn::Load(lanes, u.scale.data()));
  return hn::ShiftRightSame(top, u.down);
}

HWY_INLINE void store(hn::Vec<Lanes> value, std::uint8_t* to) {
  const hn::RebindToUnsigned<Lanes> unsigned_lanes;
  hn::StoreU(hn::TruncateTo(Half(), hn::BitCast(unsigned_lanes, value)), Half(), to);
}

void Unpack(const FrameParts& p, std::uint8_t* planes, std::size_t stride) {
  const Lanes lanes;
  const auto of_red = hn::Set(lanes, p.factors[kRed]);
  const auto of_green = hn::Set(lanes, p.factors[kGreen]);
  const auto of_blue = hn::Set(lanes, p.factors[kBlue]);
  const std::uint8_t* from = p.residuals;
  const std::size_t blocks = (p.pixels + kBlock - 1) / kBlock;
  for (std::size_t b = 0; b < blocks; ++b) {
    const unsigned codes = block_codes(p.widths, b);
    const auto alpha = unpack(codes, from);
    const auto red = unpack(codes >> 3, from);
    const auto green_rest = unpack(codes >> 6, from);
    const auto blue = unpack(codes >> 9, from);
    const auto share = [&](auto factor) HWY_ATTR {
      return hn::ShiftRight<kFactorShift>(hn::Mul(alpha, factor));
    };
    const auto green = hn::Add(green_rest, share(of_green));
    std::uint8_t* to = planes + b * kBlock;
    store(hn::Add(hn::Add(red, share(of_red)), green), to + kRed * stride);
    store(green, to + kGreen * stride);
    store(hn::Add(hn::Add(blue, share(of_blue)), green), to + kBlue * stride);
    store(alpha, to + kAlpha * stride);
  }
}

// One run of one channel. Writes whole steps: what follows the run is garbage until cleared.
HWY_INLINE void add_run(const std::uint8_t* residuals, const std::uint8_t* above, std::uint8_t* row,
                        std::size_t count, bool is_smooth) {
  const Bytes bytes;
  if (!is_smooth) {
    for (std::size_t i = 0; i < count; i += kStep) {
      hn::StoreU(hn::Add(hn::LoadU(bytes, residuals + i), hn::LoadU(bytes, above + i)), bytes,
                 row + i);
    }
    return;
  }
  const auto last = hn::Set(bytes, kStep - 1);
  auto before = hn::Zero(bytes);
  for (std::size_t i = 0; i < count; i += kStep) {
    auto sum = hn::LoadU(bytes, residuals + i);
    sum = hn::Add(sum, hn::ShiftLeftBytes<1>(sum));
    sum = hn::Add(sum, hn::ShiftLeftBytes<2>(sum));
    sum = hn::Add(sum, hn::ShiftLeftBytes<4>(sum));
    sum = hn::Add(sum, hn::ShiftLeftBytes<8>(sum));
    sum = hn::Add(sum, before);
    before = hn::TableLookupBytes(sum, last);
    hn::StoreU(hn::Add(sum, hn::LoadU(bytes, above + i)), bytes, row + i);
  }
}

// Planes of a row to pixels [begin, end), which may write up to a step beyond, but not past `stop`.
HWY_INLINE void interleave(const std::uint8_t* row, std::size_t stride, std::size_t begin,
                           std::size_t end, std::uint8_t* out, const std::uint8_t* stop) {
  const Bytes bytes;
  for (std::size_t x = begin; x < end; x += kStep) {
    const auto plane = [&](Channel c) HWY_ATTR { return hn::LoadU(bytes, row + c * stride + x); };
    std::uint8_t* to = out + 4 * x;
    const auto left = static_cast<std::size_t>(stop - to);
    if (left >= 4 * kStep) {
      hn::StoreInterleaved4(plane(kRed), plane(kGreen), plane(kBlue), plane(kAlpha), bytes, to);
    } else {
      alignas(16) std::uint8_t last[4 * kStep];
      hn::StoreInterleaved4(plane(kRed), plane(kGreen), plane(kBlue), plane(kAlpha), bytes, last);
      std::memcpy(to, last, left);
    }
  }
}

#endif

void DecodeParts(const FrameParts& p, std::uint8_t* scratch, std::uint8_t* rgba) {
  const std::size_t plane = residual_stride(p), stride = row_stride(p);
  const auto width = static_cast<std::size_t>(p.width);
  std::uint8_t* residuals = scratch;
  std::uint8_t* row = scratch + 4 * plane;
  std::uint8_t* above = row + 4 * stride;
  Unpack(p, residuals, plane);
  std::memset(row, 0, 8 * stride);
  const std::uint8_t* stop = rgba + 4 * width * static_cast<std::size_t>(p.height);
  const Run* run = p.runs.data();
  for (const RowHead& head : p.rows) {
    const std::size_t first = head.runs == 0 ? width : run->begin;
    std::size_t end = 0;
    for (std::uint32_t k = 0; k < head.runs; ++k, ++run) {
      const std::size_t count = run->end - run->begin;
      for (std::size_t c = 0; c < 4; ++c) {
        std::uint8_t* to = row + c * stride;
        std::memset(to + end, 0, run->begin - end);
        add_run(residuals + c * plane, above + c * stride + run->begin, to + run->begin, count,
                head.is_smooth);
      }
      residuals += count;
      end = run->end;
    }
    for (std::size_t c = 0; c < 4; ++c) std::memset(row + c * stride + end, 0, stride - end);
    std::memset(rgba, 0, 4 * first);
    interleave(row, stride, first, end, rgba, stop);
    if (end > first) std::memset(rgba + 4 * end, 0, 4 * (width - end));
    rgba += 4 * width;
    std::swap(row, above);
  }
}

}  // namespace vsprite::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vsprite::detail {

HWY_EXPORT(DecodeParts);

std::size_t decode_scratch(const FrameParts& parts) {
  return 4 * residual_stride(parts) + 8 * row_stride(parts);
}

void decode_parts(const FrameParts& parts, std::span<std::uint8_t> scratch, std::uint8_t* rgba) {
  HWY_DYNAMIC_DISPATCH(DecodeParts)(parts, scratch.data(), rgba);
}

#if HWY_TARGETS == HWY_STATIC_TARGET  // nothing to choose, and no library of Highway's is linked

std::vector<const char*> frame_targets() { return {"the only one"}; }
void use_frame_target(int) {}

#else

std::vector<const char*> frame_targets() {
  std::vector<const char*> names;
  hwy::SetSupportedTargetsForTest(0);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    names.push_back(hwy::TargetName(target));
  return names;
}

void use_frame_target(int k) {
  hwy::SetSupportedTargetsForTest(0);
  if (k >= 0) {
    hwy::SetSupportedTargetsForTest(
        hwy::SupportedAndGeneratedTargets()[static_cast<std::size_t>(k)]);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

#endif

}  // namespace vsprite::detail
#endif  // HWY_ONCE
