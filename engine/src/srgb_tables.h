// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// srgb_tables.h - the sRGB transfer for loops over pixels; made at compile time in image.cpp.
#pragma once

#include <array>
#include <cstdint>

namespace vsprite::detail {

/// Encoded 0..255 -> linear 0..65535.
extern const std::array<std::uint16_t, 256> kLinear;
/// Linear 0..65535 -> the nearest encoded 0..255.
extern const std::array<std::uint8_t, 65536> kEncoded;
/// [alpha << 8 | premultiplied encoded] -> premultiplied linear, 65535 (alpha / 255) where opaque
/// white. Values above alpha, which no picture holds, count as alpha.
extern const std::array<std::uint16_t, 65536> kPremultipliedLinear;

}  // namespace vsprite::detail
