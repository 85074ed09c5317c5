// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Porter and Duff's "over" along rows. A matte is mostly clear and opaque runs: a vector of either
// kind costs a test, and only the pixels of an edge are mixed. Premultiplied codes of an edge, and
// the way from light back to codes, go through tables, one at a time.
#include "blend_rows.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "srgb_tables.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "blend_rows.cpp"
#include "hwy/cache_control.h"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace vsprite::detail::HWY_NAMESPACE {
namespace {

// canvas is opaque; the channels of `over` are premultiplied linear light.
HWY_INLINE void mix_linear(std::uint8_t* canvas, const Deep* over) {
  const std::uint32_t rest = 65535u - over[3];
  for (int c = 0; c < 3; ++c) {
    const std::uint32_t sum = over[c] + (kLight[canvas[c]] * rest >> 16);
    canvas[c] = kShortEncoded[short_index(std::min(65535u, sum))];
  }
}

HWY_INLINE void light_pixel(const std::uint8_t* picture, Deep* out) {
  const bool is_opaque = picture[3] == 255;
  const Deep* row = is_opaque ? kLight.data() : &kPremultipliedLinear[std::size_t{picture[3]} << 8];
  for (int c = 0; c < 3; ++c) out[c] = row[picture[c]];
  out[3] = static_cast<Deep>(picture[3] * 257u);
}

HWY_INLINE void mix_linear(std::uint8_t* canvas, const std::uint8_t* over) {
  Deep light[4];
  light_pixel(over, light);
  mix_linear(canvas, light);
}

std::size_t over_deep_pixels(std::uint8_t* canvas, const Deep* picture, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i, canvas += 4, picture += 4) {
    if (picture[3] == 0) continue;
    if (canvas[3] != 255) return i;
    mix_linear(canvas, picture);
  }
  return count;
}

void to_deep_pixels(const std::uint8_t* picture, Deep* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) light_pixel(picture + 4 * i, out + 4 * i);
}

#if HWY_TARGET == HWY_SCALAR  // a CPU without vectors: the same numbers, a byte at a time

std::size_t over_deep_row(std::uint8_t* canvas, const Deep* picture, std::size_t count) {
  return over_deep_pixels(canvas, picture, count);
}

void to_deep_row(const std::uint8_t* picture, Deep* out, std::size_t count) {
  to_deep_pixels(picture, out, count);
}

std::uint8_t over_255(std::uint32_t x) {
  return static_cast<std::uint8_t>((x + 128 + ((x + 128) >> 8)) >> 8);
}

void over_encoded_rows(CanvasRows canvas, PictureRows picture, std::size_t count,
                       std::size_t rows) {
  for (; rows > 0; --rows, canvas.first += canvas.stride, picture.first += picture.stride) {
    for (std::size_t i = 0; i < 4 * count; ++i) {
      const std::uint32_t rest = 255u - picture.first[i | 3];
      canvas.first[i] = static_cast<std::uint8_t>(
          std::min(255u, picture.first[i] + std::uint32_t{over_255(canvas.first[i] * rest)}));
    }
  }
}

std::size_t over_linear_row(std::uint8_t* canvas, const std::uint8_t* picture, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i, canvas += 4, picture += 4) {
    if (picture[3] == 0) continue;
    if (picture[3] == 255) {
      std::memcpy(canvas, picture, 4);
    } else if (canvas[3] == 255) {
      mix_linear(canvas, picture);
    } else {
      return i;
    }
  }
  return count;
}

// (w a + (256 - w) b) / 256, both products rounded down; b alone where w is 0.
std::uint32_t between(std::uint32_t a, std::uint32_t b, std::uint32_t w) {
  return w == 0 ? b : (a * (w << 8) >> 16) + (b * ((256 - w) << 8) >> 16);
}

std::uint32_t faded(std::uint32_t v, std::uint32_t opacity) {
  return opacity < 256 ? v * (opacity << 8) >> 16 : v;
}

void between_deep_row(const Deep* above, const Deep* row, Between at, std::uint16_t opacity,
                      Deep* out, std::size_t count) {
  for (std::size_t i = 0; i < 4 * count; ++i) {
    const std::uint32_t low = between(row[i], row[i + 4], at.left);
    const std::uint32_t high = at.above == 0 ? 0 : between(above[i], above[i + 4], at.left);
    out[i] = static_cast<Deep>(faded(between(high, low, at.above), opacity));
  }
}

void over_between_rows(CanvasRows canvas, PictureRows picture, Between at, std::uint16_t opacity,
                       std::size_t count, std::size_t rows) {
  const auto across = [&](const std::uint8_t* p) {
    return std::uint32_t{at.left} * p[0] + (256u - at.left) * p[4];
  };
  for (; rows > 0; --rows, canvas.first += canvas.stride, picture.first += picture.stride) {
    const std::uint8_t* above = picture.first;
    const auto deep = [&](std::size_t i) {
      const std::uint32_t high = at.above == 0 ? 0 : across(above + i);
      return faded(between(high, across(above + picture.stride + i), at.above), opacity);
    };
    for (std::size_t i = 0; i < 4 * count; ++i) {
      const std::uint32_t rest = 65280u - deep(i | 3);
      canvas.first[i] =
          static_cast<std::uint8_t>((deep(i) + (canvas.first[i] * 257u * rest >> 16) + 128) >> 8);
    }
  }
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::ScalableTag<std::uint32_t>;  // a lane is a pixel
using Bytes = hn::Repartition<std::uint8_t, Words>;
using Pairs = hn::Repartition<std::uint16_t, Words>;
using WordVector = hn::Vec<Words>;
using WordMask = hn::Mask<Words>;
using FewBytes = hn::Rebind<std::uint8_t, Pairs>;  // of as many pixels as Pairs holds
using FewWords = hn::Repartition<std::uint32_t, FewBytes>;

// A whole vector of pixels, or the first few of one at the end of a row.
struct Whole {
  WordVector load(const std::uint8_t* p) const {
    return hn::BitCast(Words(), hn::LoadU(Bytes(), p));
  }
  void store(WordVector v, std::uint8_t* p) const {
    hn::StoreU(hn::BitCast(Bytes(), v), Bytes(), p);
  }
};
struct First {
  WordMask mask;
  // vpmaskmov and its like touch no byte of an unset lane; pixels need no alignment there.
  WordVector load(const std::uint8_t* p) const {
    return hn::MaskedLoad(mask, Words(), reinterpret_cast<const std::uint32_t*>(p));
  }
  void store(WordVector v, std::uint8_t* p) const {
    hn::BlendedStore(v, mask, Words(), reinterpret_cast<std::uint32_t*>(p));
  }
};

// x / 255 to nearest, 0 <= x <= 255 * 255.
template <class V>
V over_255(V x) {
  const V t = hn::Add(x, hn::Set(Pairs(), std::uint16_t{128}));
  return hn::ShiftRight<8>(hn::Add(t, hn::ShiftRight<8>(t)));
}

// Even and odd bytes are mixed apart, so that nothing has to be shuffled.
WordVector mixed_encoded(WordVector canvas, WordVector picture) {
  const Pairs d;
  alignas(16) static constexpr std::uint8_t kAlphas[16] = {3,  3,  3,  3,  7,  7,  7,  7,
                                                           11, 11, 11, 11, 15, 15, 15, 15};
  const auto low = hn::Set(d, std::uint16_t{0x00FF});
  const auto bytes = hn::BitCast(Bytes(), picture);
  const auto alpha = hn::TableLookupBytes(bytes, hn::LoadDup128(Bytes(), kAlphas));
  const auto rest = hn::And(hn::Not(hn::BitCast(d, alpha)), low);
  const auto under = hn::BitCast(d, canvas);
  const auto even = over_255(hn::Mul(hn::And(under, low), rest));
  const auto odd = over_255(hn::Mul(hn::ShiftRight<8>(under), rest));
  const auto kept = hn::BitCast(Bytes(), hn::Or(even, hn::ShiftLeft<8>(odd)));
  return hn::BitCast(Words(), hn::SaturatedAdd(kept, bytes));
}

WordMask opaque(WordVector v) {
  const auto top = hn::Set(Words(), 0xFF000000u);
  return hn::Eq(hn::And(v, top), top);
}

// Opaque pixels go the way of mixed ones: a matte's edges are where branches are guessed wrong, and
// mixing costs less than that.
template <class Access>
HWY_INLINE void over_vector(const Access& access, std::uint8_t* canvas,
                            const std::uint8_t* picture) {
  const WordVector over = access.load(picture);
  if (hn::AllTrue(Words(), hn::Eq(over, hn::Zero(Words())))) return;
  access.store(mixed_encoded(access.load(canvas), over), canvas);
}

void over_encoded_rows(CanvasRows canvas, PictureRows picture, std::size_t count,
                       std::size_t rows) {
  const std::size_t lanes = hn::Lanes(Words());
  const WordMask tail = hn::FirstN(Words(), count % lanes);
  for (; rows > 0; --rows, canvas.first += canvas.stride, picture.first += picture.stride) {
    if (rows > 2) prefetch(canvas.first + 2 * canvas.stride, count);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
      over_vector(Whole{}, canvas.first + 4 * i, picture.first + 4 * i);
    if (i < count) over_vector(First{tail}, canvas.first + 4 * i, picture.first + 4 * i);
  }
}

// Opaque pixels are copied at once, then each of the mixed ones is visited. Returns the pixels
// done.
template <class Access>
HWY_INLINE std::size_t over_linear_vector(const Access& access, std::uint8_t* canvas,
                                          const std::uint8_t* picture, std::size_t lanes) {
  const Words d;
  const WordVector over = access.load(picture);
  const WordMask clear = hn::Eq(over, hn::Zero(d));
  if (hn::AllTrue(d, clear)) return lanes;
  const WordMask solid = opaque(over);
  if (hn::AllTrue(d, solid)) {
    access.store(over, canvas);
    return lanes;
  }
  access.store(hn::IfThenElse(solid, over, access.load(canvas)), canvas);
  std::uint64_t edge = 0;
  hn::StoreMaskBits(d, hn::Not(hn::Or(clear, solid)), reinterpret_cast<std::uint8_t*>(&edge));
  for (; edge != 0; edge &= edge - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(edge));
    if (k >= lanes) break;
    if (canvas[4 * k + 3] != 255) return k;  // what follows is copied again later, to no harm
    mix_linear(canvas + 4 * k, picture + 4 * k);
  }
  return lanes;
}

std::size_t over_linear_row(std::uint8_t* canvas, const std::uint8_t* picture, std::size_t count) {
  const std::size_t lanes = hn::Lanes(Words());
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const std::size_t done = over_linear_vector(Whole{}, canvas + 4 * i, picture + 4 * i, lanes);
    if (done < lanes) return i + done;
  }
  if (i == count) return i;
  return i + over_linear_vector(First{hn::FirstN(Words(), count - i)}, canvas + 4 * i,
                                picture + 4 * i, count - i);
}

// kLight of every lane.
template <class V>
HWY_INLINE V light_of(V code) {
  const Pairs d;
  const hn::RebindToSigned<Pairs> numbers;
  const auto& p = kLightPolynomial;
  const V x = hn::Mul(code, hn::Set(d, std::uint16_t{257}));
  V curve = hn::Sub(hn::Set(d, p[3]), hn::MulHigh(x, hn::Set(d, p[4])));
  for (const std::uint16_t next : {p[2], p[1], p[0]})
    curve = hn::Add(hn::Set(d, next), hn::MulHigh(x, curve));
  const auto below =
      hn::Lt(hn::BitCast(numbers, code), hn::Set(numbers, static_cast<std::int16_t>(kLightKnee)));
  return hn::IfThenElse(hn::RebindMask(d, below), hn::Mul(code, hn::Set(d, kLightBelow)), curve);
}

HWY_INLINE bool all_opaque(hn::Vec<FewWords> v) {
  const auto top = hn::Set(FewWords(), 0xFF000000u);
  return hn::AllTrue(FewWords(), hn::Eq(hn::And(v, top), top));
}

void to_deep_row(const std::uint8_t* picture, Deep* out, std::size_t count) {
  const Pairs d;
  const FewWords pixels;
  const std::size_t step = hn::Lanes(pixels);
  const auto top = hn::Set(pixels, 0xFF000000u);
  const auto alphas =
      hn::BitCast(d, hn::Set(hn::Repartition<std::uint64_t, Pairs>(), std::uint64_t{0xFFFF} << 48));
  std::size_t i = 0;
  for (; i + step <= count; i += step) {
    const auto bytes = hn::LoadU(FewBytes(), picture + 4 * i);
    const auto v = hn::BitCast(pixels, bytes);
    const auto hard = hn::Or(hn::Eq(hn::And(v, top), top), hn::Eq(v, hn::Zero(pixels)));
    if (!hn::AllTrue(pixels, hard)) {
      to_deep_pixels(picture + 4 * i, out + 4 * i, step);
      continue;
    }
    const auto code = hn::PromoteTo(d, bytes);
    const auto alpha = hn::And(hn::Mul(code, hn::Set(d, std::uint16_t{257})), alphas);
    hn::StoreU(hn::Or(alpha, hn::AndNot(alphas, light_of(code))), d, out + 4 * i);
  }
  to_deep_pixels(picture + 4 * i, out + 4 * i, count - i);
}

// Lanes mix; the way back to codes is a table's.
std::size_t over_deep_row(std::uint8_t* canvas, const Deep* picture, std::size_t count) {
  const Pairs d;
  const std::size_t step = hn::Lanes(FewWords());
  alignas(16) static constexpr std::uint8_t kAlphas[16] = {6,  7,  6,  7,  6,  7,  6,  7,
                                                           14, 15, 14, 15, 14, 15, 14, 15};
  const auto spread = hn::BitCast(d, hn::LoadDup128(Bytes(), kAlphas));
  const auto full = hn::Set(d, std::uint16_t{65535});
  HWY_ALIGN std::uint16_t places[hn::MaxLanes(d)];
  std::size_t i = 0;
  for (; i + step <= count; i += step) {
    const auto over = hn::LoadU(d, picture + 4 * i);
    if (hn::AllTrue(d, hn::Eq(over, hn::Zero(d)))) continue;
    std::uint8_t* here = canvas + 4 * i;
    const auto bytes = hn::LoadU(FewBytes(), here);
    if (!all_opaque(hn::BitCast(FewWords(), bytes))) {
      const std::size_t done = over_deep_pixels(here, picture + 4 * i, step);
      if (done < step) return i + done;
      continue;
    }
    const auto alpha = hn::TableLookupBytes(over, spread);
    auto sum = over;
    if (!hn::AllTrue(d, hn::Eq(alpha, full))) {
      const auto under = light_of(hn::PromoteTo(d, bytes));
      sum = hn::SaturatedAdd(over, hn::MulHigh(under, hn::Not(alpha)));
    }
    const auto thin = hn::Add(hn::ShiftRight<4>(sum), hn::Set(d, std::uint16_t{3840}));
    hn::Store(hn::Min(sum, thin), d, places);  // short_index
    for (std::size_t k = 0; k < step; ++k) {
      const std::uint16_t* at = places + 4 * k;
      here[4 * k] = kShortEncoded[at[0]];
      here[4 * k + 1] = kShortEncoded[at[1]];
      here[4 * k + 2] = kShortEncoded[at[2]];
    }
  }
  return i + over_deep_pixels(canvas + 4 * i, picture + 4 * i, count - i);
}

// (w a + (256 - w) b) / 256 in 16 bits, 0 < w < 256.
template <class V>
V between(V a, V b, std::uint16_t w) {
  const Pairs d;
  return hn::Add(hn::MulHigh(a, hn::Set(d, static_cast<std::uint16_t>(w << 8))),
                 hn::MulHigh(b, hn::Set(d, static_cast<std::uint16_t>((256 - w) << 8))));
}

void between_deep_row(const Deep* above, const Deep* row, Between at, std::uint16_t opacity,
                      Deep* out, std::size_t count) {
  const Pairs d;
  const auto across = [&](const Deep* p) {
    const auto right = hn::LoadU(d, p + 4);
    return at.left == 0 ? right : between(hn::LoadU(d, p), right, at.left);
  };
  for (std::size_t i = 0; i < 4 * count; i += hn::Lanes(d)) {
    auto v = across(row + i);
    if (at.above != 0) v = between(across(above + i), v, at.above);
    if (opacity < 256) v = hn::MulHigh(v, hn::Set(d, static_cast<std::uint16_t>(opacity << 8)));
    hn::StoreU(v, d, out + i);
  }
}

// Even and odd bytes of one row, times 256, mixed between neighbours: at most 65280.
template <class V>
HWY_INLINE void across_row(const std::uint8_t* p, V left, V right, V& even, V& odd) {
  const Pairs d;
  const auto low = hn::Set(d, std::uint16_t{0x00FF});
  const auto a = hn::BitCast(d, hn::LoadU(Bytes(), p));
  const auto b = hn::BitCast(d, hn::LoadU(Bytes(), p + 4));
  even = hn::Add(hn::Mul(hn::And(a, low), left), hn::Mul(hn::And(b, low), right));
  odd = hn::Add(hn::Mul(hn::ShiftRight<8>(a), left), hn::Mul(hn::ShiftRight<8>(b), right));
}

// Sums of bytes times weights of 256, kept at 16 bits until canvas and picture are added: the bytes
// come out as if they had been rounded once.
template <class Access, class V>
HWY_INLINE void over_halves(const Access& access, std::uint8_t* canvas, V even, V odd) {
  const Pairs d;
  alignas(16) static constexpr std::uint8_t kAlphas[16] = {2,  3,  2,  3,  6,  7,  6,  7,
                                                           10, 11, 10, 11, 14, 15, 14, 15};
  const auto low = hn::Set(d, std::uint16_t{0x00FF});
  const auto alpha = hn::TableLookupBytes(odd, hn::BitCast(d, hn::LoadDup128(Bytes(), kAlphas)));
  const auto rest = hn::Sub(hn::Set(d, std::uint16_t{65280}), alpha);
  const auto under = hn::BitCast(d, access.load(canvas));
  const auto scale = hn::Set(d, std::uint16_t{257});
  const auto mixed = [&](auto over, auto kept) HWY_ATTR {
    const auto sum = hn::Add(over, hn::MulHigh(hn::Mul(kept, scale), rest));
    return hn::ShiftRight<8>(hn::Add(sum, hn::Set(d, std::uint16_t{128})));
  };
  const auto out_even = mixed(even, hn::And(under, low));
  const auto out_odd = mixed(odd, hn::ShiftRight<8>(under));
  access.store(hn::BitCast(Words(), hn::Or(out_even, hn::ShiftLeft<8>(out_odd))), canvas);
}

// One vector wide from the top down: what a row gave across is kept for the row below it.
template <class Access>
HWY_INLINE void over_between_strip(const Access& access, CanvasRows canvas, PictureRows picture,
                                   Between at, std::uint16_t opacity, std::size_t rows) {
  const Pairs d;
  const auto left = hn::Set(d, at.left);
  const auto right = hn::Set(d, static_cast<std::uint16_t>(256 - at.left));
  const auto fade = hn::Set(d, static_cast<std::uint16_t>(opacity << 8));
  auto above_even = left, above_odd = left;
  across_row(picture.first, left, right, above_even, above_odd);
  for (; rows > 0; --rows, canvas.first += canvas.stride) {
    picture.first += picture.stride;
    auto here_even = left, here_odd = left;
    across_row(picture.first, left, right, here_even, here_odd);
    auto even = here_even, odd = here_odd;
    if (at.above != 0) {
      even = between(above_even, even, at.above);
      odd = between(above_odd, odd, at.above);
    }
    above_even = here_even;
    above_odd = here_odd;
    const auto any = hn::BitCast(Words(), hn::Or(even, odd));
    if (hn::AllTrue(Words(), hn::Eq(any, hn::Zero(Words())))) continue;
    if (opacity < 256) {
      even = hn::MulHigh(even, fade);
      odd = hn::MulHigh(odd, fade);
    }
    over_halves(access, canvas.first, even, odd);
  }
}

void over_between_rows(CanvasRows canvas, PictureRows picture, Between at, std::uint16_t opacity,
                       std::size_t count, std::size_t rows) {
  const std::size_t lanes = hn::Lanes(Words());
  for (std::size_t row = 0; row < rows; ++row)
    prefetch(canvas.first + static_cast<std::ptrdiff_t>(row) * canvas.stride, count);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    over_between_strip(Whole{}, {canvas.first + 4 * i, canvas.stride},
                       {picture.first + 4 * i, picture.stride}, at, opacity, rows);
  }
  if (i == count) return;
  over_between_strip(First{hn::FirstN(Words(), count - i)}, {canvas.first + 4 * i, canvas.stride},
                     {picture.first + 4 * i, picture.stride}, at, opacity, rows);
}

#endif

}  // namespace
}  // namespace vsprite::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vsprite::detail {

HWY_EXPORT(over_encoded_rows);
HWY_EXPORT(over_linear_row);
HWY_EXPORT(over_deep_row);
HWY_EXPORT(to_deep_row);
HWY_EXPORT(over_between_rows);
HWY_EXPORT(between_deep_row);

void over_encoded(CanvasRows canvas, PictureRows picture, std::size_t count,
                  std::size_t rows) noexcept {
  HWY_DYNAMIC_DISPATCH(over_encoded_rows)(canvas, picture, count, rows);
}

std::size_t over_linear(std::uint8_t* canvas, const std::uint8_t* picture,
                        std::size_t count) noexcept {
  return HWY_DYNAMIC_DISPATCH(over_linear_row)(canvas, picture, count);
}

std::size_t over_deep(std::uint8_t* canvas, const Deep* picture, std::size_t count) noexcept {
  return HWY_DYNAMIC_DISPATCH(over_deep_row)(canvas, picture, count);
}

void prefetch(const std::uint8_t* row, std::size_t count) noexcept {
  constexpr std::size_t kLine = 64;
  for (std::size_t i = 0; i < 4 * count; i += kLine) hwy::Prefetch(row + i);
}

void to_deep(const std::uint8_t* picture, Deep* out, std::size_t count) noexcept {
  HWY_DYNAMIC_DISPATCH(to_deep_row)(picture, out, count);
}

void over_between(CanvasRows canvas, PictureRows picture, Between at, std::uint16_t opacity,
                  std::size_t count, std::size_t rows) noexcept {
  HWY_DYNAMIC_DISPATCH(over_between_rows)(canvas, picture, at, opacity, count, rows);
}

void between_deep(const Deep* above, const Deep* row, Between at, std::uint16_t opacity, Deep* out,
                  std::size_t count) noexcept {
  HWY_DYNAMIC_DISPATCH(between_deep_row)(above, row, at, opacity, out, count);
}

}  // namespace vsprite::detail
#endif  // HWY_ONCE
