// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// light_table.h - sRGB-encoded premultiplied bytes to linear premultiplied half floats.
//
// A picture is stored sRGB-encoded and multiplied by alpha, c = a f(l); linear premultiplied light
// is a f^-1(c / a), tabulated for all 65,536 pairs (a, c). Filtering before this conversion would
// darken soft edges.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vsprite::detail {

inline float linear_value(float encoded) noexcept {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

/// IEEE 754 binary16 of x in [0, 1], rounded to nearest.
inline std::uint16_t half_from_float(float x) noexcept {
  // Adding a power of two makes the float unit drop the bits that a half has no room for.
  if (x < 6.103515625e-5f) return static_cast<std::uint16_t>(x * 16777216.0f + 0.5f);
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x) + 0x1000u;
  return static_cast<std::uint16_t>((bits >> 13) - ((127u - 15u) << 10));
}

/// Back again. Pre: x in [0, 1].
inline float float_from_half(std::uint16_t x) noexcept {
  if (x < 0x400) return static_cast<float>(x) * (1 / 16777216.0f);
  return std::bit_cast<float>((std::uint32_t{x} << 13) + ((127u - 15u) << 23));
}

/// (alpha, encoded premultiplied value) -> linear premultiplied value.
class LightTable {
 public:
  LightTable() : halves_(65536) {
    for (unsigned a = 1; a < 256; ++a) {
      for (unsigned c = 0; c < 256; ++c) {
        const float straight = std::min(1.0f, static_cast<float>(c) / static_cast<float>(a));
        const float light = linear_value(straight) * static_cast<float>(a) / 255.0f;
        halves_[a << 8 | c] = half_from_float(light);
      }
    }
  }
  void convert(const std::uint8_t* rgba, std::uint16_t* out) const noexcept {
    const std::uint16_t* row = &halves_[std::size_t{rgba[3]} << 8];
    out[0] = row[rgba[0]];
    out[1] = row[rgba[1]];
    out[2] = row[rgba[2]];
    out[3] = row[rgba[3]];  // f^-1(a / a) a = a
  }

 private:
  std::vector<std::uint16_t> halves_;
};

}  // namespace vsprite::detail
