// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// From residuals to pixels, compiled once for each instruction set (Highway), chosen at the first
// call. Bytes are added modulo 256, so that every one of them gives the same picture.
//
// First all blocks are unpacked, to the four bytes of each pixel side by side; then, with x the
// pixel, u the one above it and d = x - u, a row holds d ("plain") or the difference of d from the
// d to its left ("smooth"): d is then the running sum of what is stored, taken inside a vector in
// steps of 1, 2, 4 .. pixels. The picture itself is the row above.
#define HWY_WANT_AVX3_DL  // AVX-512 with VBMI: two blocks are unpacked at once
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

constexpr std::size_t kMostStep = 16;  // pixels at a time

// Value i of a block of width w stands in bits i w to i w + w - 1. `shuffle` brings the two bytes
// that hold it into one 16-bit lane, `scale` moves its top bit to the lane's, and the upper half of
// the product with 2^w brings it down again with its sign.
struct alignas(16) Unpacking {
  std::array<std::uint8_t, 16> shuffle;
  std::array<std::int16_t, kBlock> scale, down;
};

constexpr Unpacking make_unpacking(int width) {
  Unpacking u{};
  for (int i = 0; i < 8 && width != 0; ++i) {
    const int bit = i * width;
    u.shuffle[static_cast<std::size_t>(2 * i)] = static_cast<std::uint8_t>(bit / 8);
    u.shuffle[static_cast<std::size_t>(2 * i + 1)] = static_cast<std::uint8_t>(bit / 8 + 1);
    u.scale[static_cast<std::size_t>(i)] = static_cast<std::int16_t>(1 << (16 - width - bit % 8));
    u.down[static_cast<std::size_t>(i)] = static_cast<std::int16_t>(1 << width);
  }
  return u;
}

[[maybe_unused]] constexpr std::array<Unpacking, 8> kUnpacking{
    make_unpacking(kWidths[0]), make_unpacking(kWidths[1]), make_unpacking(kWidths[2]),
    make_unpacking(kWidths[3]), make_unpacking(kWidths[4]), make_unpacking(kWidths[5]),
    make_unpacking(kWidths[6]), make_unpacking(kWidths[7])};

// The same eight bytes at a time, by code: bit offsets of the values, their bits, their signs, and
// the bytes of a block that are stored.
struct alignas(64) WideUnpacking {
  std::array<std::array<std::uint8_t, 8>, 8> offsets, bits, signs, stored;
};

[[maybe_unused]] constexpr WideUnpacking kWide = [] {
  WideUnpacking u{};
  for (std::size_t code = 0; code < 8; ++code) {
    const unsigned width = kWidths[code];
    for (std::size_t i = 0; i < 8; ++i) {
      u.offsets[code][i] = static_cast<std::uint8_t>(i * width);
      u.bits[code][i] = static_cast<std::uint8_t>((1u << width) - 1);
      u.signs[code][i] = static_cast<std::uint8_t>(width == 0 ? 0 : 1u << (width - 1));
      u.stored[code][i] = i < width ? 0xFF : 0;
    }
  }
  return u;
}();

// Where the bytes of 16 pixels come from: two blocks, each eight bytes of alpha, red, green, blue.
struct alignas(64) Places {
  std::array<std::uint8_t, 64> red_blue_alpha, green, alpha;
};

[[maybe_unused]] constexpr Places kPlaces = [] {
  Places places{};
  for (std::size_t i = 0; i < 64; ++i) {
    const std::size_t pixel = i / 4, alpha = pixel / 8 * 32 + pixel % 8;
    constexpr std::array<std::size_t, 4> kPart{8, 16, 24, 0};  // of red, green, blue, alpha
    places.red_blue_alpha[i] = static_cast<std::uint8_t>(alpha + kPart[i % 4]);
    places.green[i] = static_cast<std::uint8_t>(alpha + kPart[1]);
    places.alpha[i] = static_cast<std::uint8_t>(alpha);
  }
  return places;
}();

// In the scratch: residuals of all runs, and the row above the first.
inline std::size_t residual_size(const FrameParts& p) {
  return 4 * kMostStep * (p.pixels / kMostStep + 2);
}

}  // namespace vsprite::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace vsprite::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// One run, pixel after pixel, from `i` on.
HWY_INLINE void add_rest(const std::uint8_t* residuals, const std::uint8_t* above, std::uint8_t* to,
                         std::size_t i, std::size_t count, bool is_smooth) {
  for (std::size_t k = 4 * i; k < 4 * count; ++k) {
    const int left = is_smooth && k >= 4 ? to[k - 4] - above[k - 4] : 0;
    to[k] = static_cast<std::uint8_t>(above[k] + residuals[k] + left);
  }
}

#if HWY_TARGET == HWY_SCALAR
// Plain loops: for CPUs without any of the others, and what those are tested against.

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

void Unpack(const FrameParts& p, std::uint8_t* to) {
  const std::uint8_t* from = p.residuals;
  for (std::size_t b = 0; b < (p.pixels + kBlock - 1) / kBlock; ++b) {
    const unsigned codes = block_codes(p.widths, b);
    int alpha[kBlock], red[kBlock], green[kBlock], blue[kBlock];
    unpack(codes, from, alpha);
    unpack(codes >> 3, from, red);
    unpack(codes >> 6, from, green);
    unpack(codes >> 9, from, blue);
    for (std::size_t i = 0; i < kBlock; ++i, to += 4) {
      const auto share = [&](Channel c) { return alpha[i] * p.factors[c] >> kFactorShift; };
      const int g = green[i] + share(kGreen);
      to[kRed] = static_cast<std::uint8_t>(red[i] + share(kRed) + g);
      to[kGreen] = static_cast<std::uint8_t>(g);
      to[kBlue] = static_cast<std::uint8_t>(blue[i] + share(kBlue) + g);
      to[kAlpha] = static_cast<std::uint8_t>(alpha[i]);
    }
  }
}

HWY_INLINE void add_run(const std::uint8_t* residuals, const std::uint8_t* above, std::uint8_t* to,
                        std::size_t count, bool is_smooth, const std::uint8_t*) {
  add_rest(residuals, above, to, 0, count, is_smooth);
}

#elif HWY_TARGET == HWY_AVX3_DL

// With unsigned factors of alpha, f + 8, a share is (f + 8) a / 8 - a, rounded down.
void Unpack(const FrameParts& p, std::uint8_t* to) {
  const auto table = [](const auto& bytes) HWY_ATTR { return _mm512_load_si512(bytes.data()); };
  const __m512i offsets = table(kWide.offsets), bits = table(kWide.bits),
                signs = table(kWide.signs);
  const __m512i stored = table(kWide.stored);
  const __m512i places = table(kPlaces.red_blue_alpha), green_places = table(kPlaces.green);
  const __m512i alpha_places = table(kPlaces.alpha);
  const __m512i shifts = _mm512_set_epi64(21, 18, 15, 12, 9, 6, 3, 0);
  const auto factor = [&](Channel c) { return p.factors[c] + kMaxFactor; };
  const __m512i red_blue = _mm512_set1_epi32(factor(kRed) | factor(kBlue) << 16);
  const __m512i of_green = _mm512_set1_epi32(factor(kGreen) | factor(kGreen) << 16);
  const __m512i low_bytes = _mm512_set1_epi16(0xFF);
  constexpr __mmask64 kColors = 0x7777777777777777u, kRedBlue = 0x5555555555555555u;
  constexpr __mmask64 kNotGreen = 0xDDDDDDDDDDDDDDDDu;
  const std::size_t blocks = (p.pixels + kBlock - 1) / kBlock;
  const std::uint8_t* from = p.residuals;
  for (std::size_t b = 0; b < blocks; b += 2, to += 64) {
    std::uint32_t codes = 0;
    std::memcpy(&codes, p.widths + b / 2 * 3, sizeof codes);
    if (b + 1 == blocks) codes &= 0xFFF;
    const __m512i index = _mm512_srlv_epi64(_mm512_set1_epi64(codes), shifts);
    const __mmask64 is_stored = _mm512_movepi8_mask(_mm512_permutexvar_epi64(index, stored));
    const __m512i raw = _mm512_maskz_expand_epi8(is_stored, _mm512_loadu_si512(from));
    from += static_cast<unsigned>(__builtin_popcountll(_cvtmask64_u64(is_stored)));
    const __m512i sign = _mm512_permutexvar_epi64(index, signs);
    __m512i values = _mm512_multishift_epi64_epi8(_mm512_permutexvar_epi64(index, offsets), raw);
    values = _mm512_and_si512(values, _mm512_permutexvar_epi64(index, bits));
    values = _mm512_sub_epi8(_mm512_xor_si512(values, sign), sign);
    const __m512i alpha = _mm512_permutexvar_epi8(alpha_places, values);
    const __m512i shares = _mm512_srai_epi16(_mm512_maddubs_epi16(red_blue, alpha), kFactorShift);
    const __m512i green_share =
        _mm512_srai_epi16(_mm512_maddubs_epi16(of_green, alpha), kFactorShift);
    const __m512i greens = _mm512_or_si512(_mm512_and_si512(green_share, low_bytes),
                                           _mm512_slli_epi16(green_share, 8));
    __m512i pixels = _mm512_maskz_permutexvar_epi8(kNotGreen, places, values);
    pixels = _mm512_add_epi8(pixels, _mm512_and_si512(shares, low_bytes));
    pixels = _mm512_mask_sub_epi8(pixels, kRedBlue, pixels, alpha);
    __m512i green = _mm512_maskz_permutexvar_epi8(kColors, green_places, values);
    green = _mm512_mask_add_epi8(green, kColors, green, _mm512_sub_epi8(greens, alpha));
    _mm512_storeu_si512(to, _mm512_add_epi8(pixels, green));
  }
}

HWY_INLINE void add_run(const std::uint8_t* residuals, const std::uint8_t* above, std::uint8_t* to,
                        std::size_t count, bool is_smooth, const std::uint8_t*) {
  const auto lanes = [&](std::size_t i) HWY_ATTR {
    const std::size_t left = count - i;
    return static_cast<__mmask16>(left >= kMostStep ? 0xFFFF : (1u << left) - 1);
  };
  if (!is_smooth) {
    for (std::size_t i = 0; i < count; i += kMostStep) {
      const __m512i up = _mm512_maskz_loadu_epi32(lanes(i), above + 4 * i);
      _mm512_mask_storeu_epi32(to + 4 * i, lanes(i),
                               _mm512_add_epi8(_mm512_loadu_si512(residuals + 4 * i), up));
    }
    return;
  }
  const __m512i last = _mm512_set1_epi32(kMostStep - 1), zero = _mm512_setzero_si512();
  __m512i before = zero;
  for (std::size_t i = 0; i < count; i += kMostStep) {
    __m512i sum = _mm512_loadu_si512(residuals + 4 * i);
    sum = _mm512_add_epi8(sum, _mm512_alignr_epi32(sum, zero, 15));
    sum = _mm512_add_epi8(sum, _mm512_alignr_epi32(sum, zero, 14));
    sum = _mm512_add_epi8(sum, _mm512_alignr_epi32(sum, zero, 12));
    sum = _mm512_add_epi8(sum, _mm512_alignr_epi32(sum, zero, 8));
    sum = _mm512_add_epi8(sum, before);
    before = _mm512_permutexvar_epi32(last, sum);
    const __m512i up = _mm512_maskz_loadu_epi32(lanes(i), above + 4 * i);
    _mm512_mask_storeu_epi32(to + 4 * i, lanes(i), _mm512_add_epi8(sum, up));
  }
}

#else

using Bytes = hn::CappedTag<std::uint8_t, 16>;
using Half = hn::CappedTag<std::uint8_t, kBlock>;
using Lanes = hn::CappedTag<std::int16_t, kBlock>;
using Pixels = hn::CappedTag<std::uint32_t, 4>;

HWY_INLINE hn::Vec<Lanes> unpack(unsigned code, const std::uint8_t*& from) {
  const Lanes lanes;
  const Bytes bytes;
  const Unpacking& u = kUnpacking[code & 7];
  const auto raw = hn::ZeroExtendVector(bytes, hn::LoadU(Half(), from));
  from += kWidths[code & 7];
  const auto pairs = hn::TableLookupBytes(raw, hn::Load(bytes, u.shuffle.data()));
  const auto top = hn::Mul(hn::BitCast(lanes, pairs), hn::Load(lanes, u.scale.data()));
  return hn::MulHigh(top, hn::Load(lanes, u.down.data()));
}

void Unpack(const FrameParts& p, std::uint8_t* to) {
  const Lanes lanes;
  const Bytes bytes;
  const auto of_red = hn::Set(lanes, p.factors[kRed]);
  const auto of_green = hn::Set(lanes, p.factors[kGreen]);
  const auto of_blue = hn::Set(lanes, p.factors[kBlue]);
  const auto low = hn::Set(lanes, 0xFF);
  const std::uint8_t* from = p.residuals;
  const std::size_t blocks = (p.pixels + kBlock - 1) / kBlock;
  for (std::size_t b = 0; b < blocks; ++b, to += 4 * kBlock) {
    const unsigned codes = block_codes(p.widths, b);
    const auto alpha = unpack(codes, from);
    const auto red_rest = unpack(codes >> 3, from);
    const auto green_rest = unpack(codes >> 6, from);
    const auto blue_rest = unpack(codes >> 9, from);
    const auto share = [&](auto factor) HWY_ATTR {
      return hn::ShiftRight<kFactorShift>(hn::Mul(alpha, factor));
    };
    const auto green = hn::Add(green_rest, share(of_green));
    const auto red = hn::Add(hn::Add(red_rest, share(of_red)), green);
    const auto blue = hn::Add(hn::Add(blue_rest, share(of_blue)), green);
    const auto red_green = hn::Or(hn::And(red, low), hn::ShiftLeft<8>(green));
    const auto blue_alpha = hn::Or(hn::And(blue, low), hn::ShiftLeft<8>(alpha));
    hn::StoreU(hn::BitCast(bytes, hn::InterleaveLower(lanes, red_green, blue_alpha)), bytes, to);
    hn::StoreU(hn::BitCast(bytes, hn::InterleaveUpper(lanes, red_green, blue_alpha)), bytes,
               to + 16);
  }
}

// Writes whole steps up to `stop`: what follows the run is garbage until cleared.
HWY_INLINE void add_run(const std::uint8_t* residuals, const std::uint8_t* above, std::uint8_t* to,
                        std::size_t count, bool is_smooth, const std::uint8_t* stop) {
  const Bytes bytes;
  constexpr std::size_t kStep = 4;
  const std::size_t room = static_cast<std::size_t>(stop - to) / 4 / kStep * kStep;
  std::size_t i = 0;
  if (!is_smooth) {
    for (; i < std::min(count, room); i += kStep) {
      hn::StoreU(hn::Add(hn::LoadU(bytes, residuals + 4 * i), hn::LoadU(bytes, above + 4 * i)),
                 bytes, to + 4 * i);
    }
  } else {
    const Pixels pixels;
    auto before = hn::Zero(bytes);
    for (; i < std::min(count, room); i += kStep) {
      auto sum = hn::LoadU(bytes, residuals + 4 * i);
      sum = hn::Add(sum, hn::ShiftLeftBytes<4>(sum));
      sum = hn::Add(sum, hn::ShiftLeftBytes<8>(sum));
      sum = hn::Add(sum, before);
      before = hn::BitCast(bytes, hn::Broadcast<3>(hn::BitCast(pixels, sum)));
      hn::StoreU(hn::Add(sum, hn::LoadU(bytes, above + 4 * i)), bytes, to + 4 * i);
    }
  }
  add_rest(residuals, above, to, i, count, is_smooth);
}

#endif

void DecodeParts(const FrameParts& p, std::uint8_t* scratch, std::uint8_t* rgba) {
  const std::size_t row_bytes = 4 * static_cast<std::size_t>(p.width);
  const std::uint8_t* residuals = scratch;
  std::uint8_t* zeros = scratch + residual_size(p);
  Unpack(p, scratch);
  std::memset(zeros, 0, row_bytes + 4 * kMostStep);
  const std::uint8_t* stop = rgba + row_bytes * static_cast<std::size_t>(p.height);
  const Run* run = p.runs.data();
  const std::uint8_t* above = zeros;
  std::uint8_t *row = rgba, *clear = rgba;
  for (const RowHead& head : p.rows) {
    for (std::uint32_t k = 0; k < head.runs; ++k, ++run) {
      const std::size_t at = 4 * std::size_t{run->begin}, count = run->end - run->begin;
      std::memset(clear, 0, static_cast<std::size_t>(row + at - clear));
      add_run(residuals, above + at, row + at, count, head.is_smooth, stop);
      residuals += 4 * count;
      clear = row + at + 4 * count;
    }
    above = row;
    row += row_bytes;
  }
  std::memset(clear, 0, static_cast<std::size_t>(stop - clear));
}

}  // namespace vsprite::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vsprite::detail {

HWY_EXPORT(DecodeParts);

std::size_t decode_scratch(const FrameParts& parts) {
  return residual_size(parts) + 4 * static_cast<std::size_t>(parts.width) + 4 * kMostStep;
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
