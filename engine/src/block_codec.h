// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// block_codec.h - GPU-ready pictures (engine/PACK.md, "FRAM", form 2): BC3, that is S3TC's DXT5.
//
// A block holds 4 x 4 texels: two alphas and the steps between them, two colours of 5, 6 and 5 bits
// and the steps between them. Colours are linear premultiplied light, encoded as sRGB: a GPU that
// samples the blocks as sRGB gets what the renderer draws with, ready to be filtered. Lossy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vsprite/image.h"

namespace vsprite::detail {

inline constexpr std::uint8_t kBlockForm = 2;
inline constexpr std::size_t kBlockBytes = 16;

/// Blocks of a picture with the clear texels about it: one above and to the left, one or more below
/// and to the right.
struct BlockGrid {
  std::size_t columns = 0, rows = 0;
  BlockGrid(int width, int height)
      : columns((static_cast<std::size_t>(width) + 5) / 4),
        rows((static_cast<std::size_t>(height) + 5) / 4) {}
  std::size_t count() const { return columns * rows; }
};

/// How far decoded pictures are from what was encoded: sums over the pixels that are not clear
/// before or after, values 0..255. Colours count premultiplied.
struct BlockLoss {
  std::uint64_t pixels = 0, colour = 0, alpha = 0;
  void add(const Image& before, const Image& after);
};

/// `image` premultiplied and not empty. All choices are integers or floats in a fixed order.
std::vector<std::uint8_t> encode_blocks(const Image& image);
/// Pre: `blocks` holds those of such a picture. No colour exceeds its alpha.
void decode_blocks(std::span<const std::uint8_t> blocks, int width, int height, Image& out);

/// The stored form: clear blocks cost 2 bits, opaque ones 66, others 130.
void squeeze_blocks(std::span<const std::uint8_t> blocks, std::vector<std::uint8_t>& out);
/// False: not the stored form of such a picture. Safe on any bytes.
bool unsqueeze_blocks(std::span<const std::uint8_t> bytes, int width, int height,
                      std::vector<std::uint8_t>& blocks);

}  // namespace vsprite::detail
