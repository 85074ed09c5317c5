// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// frame_codec.h - a picture as its pack holds it (engine/PACK.md, "FRAM").
//
// Runs of transparent pixels are left out. What is left is predicted, each channel from the pixels
// above and to the left and the colours from alpha and green as well, and the residuals are stored
// eight at a time with just enough bits. Decoding is adding and shuffling of bytes: several GB/s.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "block_codec.h"
#include "vsprite/image.h"

namespace vsprite::detail {

inline constexpr std::size_t kBlock = 8;                ///< residuals that share a width
inline constexpr std::size_t kFrameHead = 4;            ///< form and three factors
inline constexpr std::uint8_t kFrameForm = 1;           ///< the lossless one
inline constexpr int kFactorShift = 3, kMaxFactor = 8;  ///< factors of alpha are in eighths
/// Bits of a residual, by its 3-bit code. A 7 would cost a code and save little.
inline constexpr std::array<std::uint8_t, 8> kWidths{0, 1, 2, 3, 4, 5, 6, 8};

enum Channel { kRed, kGreen, kBlue, kAlpha };

/// Pixels that are stored, in one row.
struct Run {
  std::uint32_t begin = 0, end = 0;
};
/// Runs of a row and the way in which it is predicted.
struct RowHead {
  std::uint32_t runs = 0;
  bool is_smooth = false;  ///< the change from left to right is as in the row above
};
/// The parts of a compressed picture, checked: reading them cannot leave the bytes.
struct FrameParts {
  int width = 0, height = 0;
  std::array<std::int8_t, 3> factors{};  ///< of alpha, eighths: red, green, blue
  std::vector<RowHead> rows;
  std::vector<Run> runs;
  std::size_t pixels = 0;                   ///< of all runs
  const std::uint8_t* widths = nullptr;     ///< 12 bits a block: alpha, red, green, blue
  const std::uint8_t* residuals = nullptr;  ///< block after block, in the same order
};

/// The four 3-bit codes of a block's widths, alpha lowest; what lies above them is arbitrary.
inline unsigned block_codes(const std::uint8_t* widths, std::size_t block) {
  const std::uint8_t* at = widths + block * 12 / 8;
  return (unsigned{at[0]} | unsigned{at[1]} << 8) >> (block % 2 * 4);
}

/// A decoded picture without the transparent pixels left and right of each row's others: about half
/// the bytes.
struct TrimmedImage {
  int width = 0, height = 0;
  std::vector<Run> rows;           ///< (height), what is held of each
  std::vector<std::uint8_t> rgba;  ///< row after row
  std::vector<std::uint8_t> blocks;  ///< instead of both: a GPU-ready picture (block_codec.h)

  std::size_t bytes() const noexcept {
    return rgba.size() + rows.size() * sizeof(Run) + blocks.size();
  }
};
/// The whole picture. May throw std::bad_alloc.
void expand(const TrimmedImage& trimmed, Image& image);

/// Encodes and decodes; keeps its memory from picture to picture. One thread at a time.
class FrameCodec {
 public:
  /// `image` premultiplied and not empty. The result is valid until the next call.
  /// May throw std::bad_alloc.
  std::span<const std::uint8_t> encode(const Image& image);

  /// Where the compressed bytes of the next decode() go.
  std::span<std::uint8_t> input(std::size_t bytes);
  /// Fills `image` of the given size. False: not the compressed form of such a picture.
  /// May throw std::bad_alloc.
  bool decode(int width, int height, Image& image);
  bool decode(int width, int height, TrimmedImage& image);

 private:
  bool is_blocks() const { return size_ > 0 && buffer_[0] == kBlockForm; }
  std::span<const std::uint8_t> bytes() const { return {buffer_.data(), size_}; }
  bool read_parts(int width, int height);

  std::size_t size_ = 0;
  std::vector<std::uint8_t> buffer_;  ///< compressed bytes, and room to read beyond them
  FrameParts parts_;
  std::vector<std::uint8_t> scratch_;  ///< residuals while decoding
  Image whole_;                        ///< before it is trimmed
  std::vector<std::uint8_t> blocks_;
};

/// Bytes of scratch that decode_parts needs.
std::size_t decode_scratch(const FrameParts& parts);
/// The kernel, for the best instruction set of this CPU; `rgba`: 4 width height bytes.
void decode_parts(const FrameParts& parts, std::span<std::uint8_t> scratch, std::uint8_t* rgba);

/// For tests: the instruction sets this program was built for and can run; use one (-1: the best).
std::vector<const char*> frame_targets();
void use_frame_target(int k);

}  // namespace vsprite::detail
