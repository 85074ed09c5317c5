// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// blend_rows.h - the compositor's kernels: runs of premultiplied RGBA, in lanes of the CPU's widest
// kind. Integers throughout: every instruction set gives the same bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace vsprite::detail {

/// Four 16-bit channels a pixel: linear light, premultiplied, 65535 is one.
using Deep = std::uint16_t;

/// Rows of pixels, `stride` bytes apart.
struct CanvasRows {
  std::uint8_t* first = nullptr;
  std::ptrdiff_t stride = 0;
};
struct PictureRows {
  const std::uint8_t* first = nullptr;
  std::ptrdiff_t stride = 0;
};

/// canvas = picture + (1 - a) canvas, as the numbers stand, `count` pixels of each row.
void over_encoded(CanvasRows canvas, PictureRows picture, std::size_t count,
                  std::size_t rows) noexcept;

/// The same in linear light onto pixels that are opaque. Returns the number of leading pixels done:
/// fewer than `count` if it met a canvas pixel that is not opaque, at which it stopped.
std::size_t over_linear(std::uint8_t* canvas, const std::uint8_t* picture,
                        std::size_t count) noexcept;
std::size_t over_deep(std::uint8_t* canvas, const Deep* picture, std::size_t count) noexcept;

/// Asks for what is about to be drawn on: a canvas is wider than what a cache foresees.
void prefetch(const std::uint8_t* row, std::size_t count) noexcept;

/// Premultiplied encoded to premultiplied linear.
void to_deep(const std::uint8_t* picture, Deep* out, std::size_t count) noexcept;

/// Weights of one sub-pixel place, in 1/256: of the pixel to the left, and of the one above.
struct Between {
  std::uint16_t left = 0;
  std::uint16_t above = 0;
};
/// out[i] = bilinear mean of above[i], above[i + 1], row[i], row[i + 1]: both rows hold count + 1
/// pixels, and a vector more that is read and not used. Then times opacity / 256 (0..256).
void between_deep(const Deep* above, const Deep* row, Between at, std::uint16_t opacity, Deep* out,
                  std::size_t count) noexcept;
/// The same of encoded values, and at once over the canvas. The picture begins one row and one
/// pixel earlier: `rows` + 1 rows of `count` + 1 pixels, and a vector more that is read and not
/// used.
void over_between(CanvasRows canvas, PictureRows picture, Between at, std::uint16_t opacity,
                  std::size_t count, std::size_t rows) noexcept;

}  // namespace vsprite::detail
