// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// A picture as its pack holds it: every row less the row above, byte by byte modulo 256, then zstd.
// Neighbouring rows of a matte are alike, so that the differences compress far better.
#include <xxhash.h>
#include <zstd.h>

#include <new>

#include "pack_format.h"

namespace vsprite::detail {
namespace {

constexpr int kLevel = 9;

void subtract_rows(std::span<const std::uint8_t> pixels, std::size_t stride,
                   std::span<std::uint8_t> delta) {
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const unsigned above = i < stride ? 0u : pixels[i - stride];
    delta[i] = static_cast<std::uint8_t>(pixels[i] - above);
  }
}

void add_rows(std::span<std::uint8_t> pixels, std::size_t stride) {
  for (std::size_t i = stride; i < pixels.size(); ++i) {
    pixels[i] = static_cast<std::uint8_t>(pixels[i] + pixels[i - stride]);
  }
}

}  // namespace

FrameCodec::FrameCodec() = default;

FrameCodec::~FrameCodec() {
  ZSTD_freeCCtx(static_cast<ZSTD_CCtx*>(compressor_));
  ZSTD_freeDCtx(static_cast<ZSTD_DCtx*>(decompressor_));
}

Result<std::span<const std::uint8_t>> FrameCodec::encode(const Image& image) {
  const Error no_memory{ErrorCode::OutOfMemory, "out of memory while compressing a picture"};
  if (!compressor_) compressor_ = ZSTD_createCCtx();
  if (!compressor_) return no_memory;
  const std::size_t bytes = image.rgba.size();
  delta_.resize(bytes);
  subtract_rows(image.rgba, 4 * static_cast<std::size_t>(image.width), delta_);
  buffer.resize(ZSTD_compressBound(bytes));
  const std::size_t size = ZSTD_compressCCtx(static_cast<ZSTD_CCtx*>(compressor_), buffer.data(),
                                             buffer.size(), delta_.data(), bytes, kLevel);
  if (ZSTD_isError(size)) return no_memory;
  return std::span<const std::uint8_t>(buffer.data(), size);
}

bool FrameCodec::decode(std::span<const std::uint8_t> bytes, int width, int height, Image& image) {
  const std::size_t stride = 4 * static_cast<std::size_t>(width);
  const std::size_t due = stride * static_cast<std::size_t>(height);
  // The size is claimed twice, by the sample and by the frame; memory is taken only if they agree.
  if (ZSTD_getFrameContentSize(bytes.data(), bytes.size()) != due) return false;
  if (ZSTD_findFrameCompressedSize(bytes.data(), bytes.size()) != bytes.size()) return false;
  if (!decompressor_) decompressor_ = ZSTD_createDCtx();
  if (!decompressor_) throw std::bad_alloc();
  image.rgba.resize(due);
  image.width = width;
  image.height = height;
  const std::size_t got = ZSTD_decompressDCtx(static_cast<ZSTD_DCtx*>(decompressor_),
                                              image.rgba.data(), due, bytes.data(), bytes.size());
  if (ZSTD_isError(got) || got != due) return false;
  add_rows(image.rgba, stride);
  return true;
}

std::uint64_t hash_bytes(std::span<const std::uint8_t> bytes) noexcept {
  return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace vsprite::detail
