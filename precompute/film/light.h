// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/light.h - sRGB to linear light and back for the keyer: float, between the code values too,
// made without libm.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace vsprite::detail {

/// Linear light 0..1 of quarter code values: entry s is that of the encoded value s / 4 (the mean
/// of four pixels whose sum is s), s = 0..1020.
const std::array<float, 1021>& linear_of_sums() noexcept;

/// The nearest encoded byte of linear light i / 65535, i = 0..65535.
const std::array<std::uint8_t, 65536>& encoded_of_steps() noexcept;

/// The nearest encoded byte of linear light; clamps to 0..1.
inline std::uint8_t encoded_of(
    float linear, const std::array<std::uint8_t, 65536>& codes = encoded_of_steps()) noexcept {
  return codes[static_cast<std::size_t>(std::clamp(linear, 0.0f, 1.0f) * 65535.0f + 0.5f)];
}

}  // namespace vsprite::detail
