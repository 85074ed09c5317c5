// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/image.h - pictures, and the two ways of counting light.
//
// RGBA, 8 bits each, rows top to bottom. "Premultiplied" means the sRGB-encoded value times alpha;
// "straight" means not multiplied. Alpha is coverage in linear light. PNG files hold straight
// alpha, the engine draws premultiplied. The sRGB transfer (IEC 61966-2-1) is tabulated in 16-bit
// integers, made without libm, so that it is the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vsprite/result.h"

namespace vsprite {

/// Owns width x height x 4 bytes, row stride 4 * width.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
};

/// Borrows pixels. `stride` is bytes from row to row, at least 4 * width.
struct ImageView {
  const std::uint8_t* rgba = nullptr;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;

  ImageView() = default;
  ImageView(const std::uint8_t* pixels, int w, int h, std::ptrdiff_t row_stride)
      : rgba(pixels), width(w), height(h), stride(row_stride) {}
  ImageView(const Image& image)  // a view of a whole image is meant to be implicit
      : rgba(image.rgba.data()),
        width(image.width),
        height(image.height),
        stride(4 * image.width) {}

  const std::uint8_t* pixel(int x, int y) const noexcept { return rgba + y * stride + 4 * x; }
};

/// Borrows a GPU-ready picture: BC3 blocks (S3TC's DXT5) of 16 bytes, `columns()` by `rows()` of
/// them. The picture's first texel is the second of the second row of the first block; what lies
/// about the picture is clear. Colours are linear premultiplied light, encoded as sRGB: sample them
/// as an sRGB texture (GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT) and draw premultiplied.
struct BlockView {
  const std::uint8_t* bytes = nullptr;
  int width = 0;  ///< px of the picture itself
  int height = 0;

  int columns() const noexcept { return (width + 5) / 4; }
  int rows() const noexcept { return (height + 5) / 4; }
};

/// Encoded 0..255 -> linear 0..65535.
std::uint16_t linear_from_srgb(std::uint8_t encoded) noexcept;
/// Linear 0..65535 -> the nearest encoded 0..255.
std::uint8_t srgb_from_linear(std::uint16_t linear) noexcept;

/// In place; rounds to nearest. Alpha 0 makes (0, 0, 0, 0).
void premultiply(Image& image) noexcept;
/// In place; exact for pixels that premultiply() made of alpha 255, within rounding otherwise.
void unpremultiply(Image& image) noexcept;

/// Reads a PNG of any kind as straight sRGB RGBA (16-bit samples are scaled, no gamma is applied).
/// Errors: NotFound, CannotRead, BadFormat, CorruptData, LimitExceeded (over 65,535 a side),
/// OutOfMemory; Unavailable, like the next two, in a build without libpng (VSPRITE_PNG=OFF).
Result<Image> read_png(const std::string& path);
/// The same from memory; `name` stands in messages.
Result<Image> decode_png(std::span<const std::uint8_t> bytes, const std::string& name);
/// Straight RGBA to PNG bytes; the same pixels give the same bytes. Errors: OutOfMemory.
Result<std::vector<std::uint8_t>> encode_png(ImageView image);

}  // namespace vsprite
