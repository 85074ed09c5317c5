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

/// The nearest encoded byte of linear light; clamps to 0..1.
std::uint8_t encoded_of(float linear) noexcept;

}  // namespace vsprite::detail
