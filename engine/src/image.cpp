// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The sRGB transfer as tables (IEC 61966-2-1), and premultiplication.
//
// The tables are compile-time constants: x^2.4 = x^2 (x^2)^(1/5), the fifth root by Newton's method
// in IEEE double, so that no libm, compiler or CPU has a say in them.
#include "vsprite/image.h"

#include <array>

#include "srgb_tables.h"

namespace vsprite {
namespace {

// r^5 = y by r <- (4 r + y / r^4) / 5, from above, 0 < y <= 1. From 1 it falls monotonically; the
// smallest y here needs 12 rounds to the last bit.
constexpr double fifth_root(double y) {
  double r = 1.0;
  for (int round = 0; round < 24; ++round) {
    const double r2 = r * r;
    r = (4.0 * r + y / (r2 * r2)) / 5.0;
  }
  return r;
}

// Encoded 0..1 -> linear 0..1.
constexpr double decode_srgb(double encoded) {
  if (encoded <= 0.04045) return encoded / 12.92;
  const double z = (encoded + 0.055) / 1.055;
  return z * z * fifth_root(z * z);
}

constexpr std::array<std::uint16_t, 256> make_linear_table() {
  std::array<std::uint16_t, 256> table{};
  for (int e = 0; e < 256; ++e) {
    table[static_cast<std::size_t>(e)] =
        static_cast<std::uint16_t>(decode_srgb(e / 255.0) * 65535.0 + 0.5);
  }
  return table;
}

// Entry l is the code e with decode(e - 1/2) <= l < decode(e + 1/2): nearest as encoded.
constexpr std::array<std::uint8_t, 65536> make_encoded_table() {
  std::array<std::uint8_t, 65536> table{};
  int linear = 0;
  for (int e = 0; e < 256; ++e) {
    const double end = e == 255 ? 65536.0 : decode_srgb((e + 0.5) / 255.0) * 65535.0;
    for (; linear < end; ++linear) {
      table[static_cast<std::size_t>(linear)] = static_cast<std::uint8_t>(e);
    }
  }
  return table;
}

constexpr std::array<std::uint16_t, 65536> make_premultiplied_table() {
  const std::array<std::uint16_t, 256> linear = make_linear_table();
  std::array<std::uint16_t, 65536> table{};
  for (unsigned a = 1; a < 256; ++a) {
    for (unsigned c = 0; c < 256; ++c) {
      const unsigned straight = c > a ? 255u : (c * 255u + a / 2) / a;
      table[a << 8 | c] = static_cast<std::uint16_t>((linear[straight] * a + 127) / 255);
    }
  }
  return table;
}

constexpr std::array<std::uint16_t, 256> make_light_table() {
  const auto times = [](std::uint32_t a, std::uint32_t b) { return a * b >> 16; };
  const auto& p = detail::kLightPolynomial;
  std::array<std::uint16_t, 256> table{};
  for (std::uint32_t e = 0; e < 256; ++e) {
    const std::uint32_t x = 257 * e;
    const std::uint32_t curve =
        p[0] + times(x, p[1] + times(x, p[2] + times(x, p[3] - times(x, p[4]))));
    table[e] = static_cast<std::uint16_t>(e < detail::kLightKnee ? detail::kLightBelow * e : curve);
  }
  return table;
}

// Of values that share an entry the middle one gives its code.
constexpr auto make_short_encoded_table(const std::array<std::uint8_t, 65536>& encoded) {
  std::array<std::uint8_t, detail::short_index(65535) + 1> table{};
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = encoded[i < 4096 ? i : 16 * (i - 3840) + 8];
  return table;
}

}  // namespace

namespace detail {
constexpr std::array<std::uint16_t, 256> kLinear = make_linear_table();
constexpr std::array<std::uint8_t, 65536> kEncoded = make_encoded_table();
constexpr std::array<std::uint16_t, 65536> kPremultipliedLinear = make_premultiplied_table();
constexpr std::array<std::uint16_t, 256> kLight = make_light_table();
constexpr std::array<std::uint8_t, short_index(65535) + 1> kShortEncoded =
    make_short_encoded_table(kEncoded);
}  // namespace detail

std::uint16_t linear_from_srgb(std::uint8_t encoded) noexcept { return detail::kLinear[encoded]; }

std::uint8_t srgb_from_linear(std::uint16_t linear) noexcept { return detail::kEncoded[linear]; }

void premultiply(Image& image) noexcept {
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
    const unsigned alpha = image.rgba[i + 3];
    for (std::size_t c = i; c < i + 3; ++c) {
      image.rgba[c] = static_cast<std::uint8_t>((image.rgba[c] * alpha + 127) / 255);
    }
  }
}

void unpremultiply(Image& image) noexcept {
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
    const unsigned alpha = image.rgba[i + 3];
    for (std::size_t c = i; c < i + 3; ++c) {
      const unsigned straight = alpha == 0 ? 0 : (image.rgba[c] * 255u + alpha / 2) / alpha;
      image.rgba[c] = static_cast<std::uint8_t>(straight > 255 ? 255 : straight);
    }
  }
}

}  // namespace vsprite
