// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// srgb_tables.h - the sRGB transfer for loops over pixels; made at compile time in image.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace vsprite::detail {

/// Encoded 0..255 -> linear 0..65535.
extern const std::array<std::uint16_t, 256> kLinear;
/// Linear 0..65535 -> the nearest encoded 0..255.
extern const std::array<std::uint8_t, 65536> kEncoded;
/// [alpha << 8 | premultiplied encoded] -> premultiplied linear, 65535 (alpha / 255) where opaque
/// white. Values above alpha, which no picture holds, count as alpha.
extern const std::array<std::uint16_t, 65536> kPremultipliedLinear;

/// The curve above its knee as 16-bit lanes compute it, x = 257 code:
///     p0 + x (p1 + x (p2 + x (p3 - x p4))),  products / 65536, rounded down
/// Within a tenth of a code of kLinear.
constexpr std::array<std::uint16_t, 5> kLightPolynomial = {69, 1840, 36913, 34027, 7313};
constexpr std::uint16_t kLightKnee = 11;  ///< codes below it are worth kLightBelow each
constexpr std::uint16_t kLightBelow = 20;
/// Encoded 0..255 -> linear 0..65535 by that polynomial.
extern const std::array<std::uint16_t, 256> kLight;

/// Index into kShortEncoded of a linear value: beyond the dark ones every sixteenth will do.
constexpr std::size_t short_index(std::uint32_t linear) {
  return std::min(linear, (linear >> 4) + 3840);
}
/// The code of a linear value, at most a twelfth of a code before it is rounded from kEncoded.
extern const std::array<std::uint8_t, short_index(65535) + 1> kShortEncoded;

}  // namespace vsprite::detail
