// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/stream.h - decoded pictures within a byte budget.
//
// One cache serves all actors of a sprite. Least recently used pictures go first. A picture that
// fails its own sum is replaced by the last good one and counted; drawing never fails.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "vsprite/sprite.h"

namespace vsprite {

struct FrameCacheStats {
  std::uint64_t hits = 0;
  std::uint64_t misses = 0;
  std::uint64_t damaged = 0;  ///< pictures that were replaced
  std::size_t bytes = 0;      ///< held now
};

/// Borrows the Sprite, which must outlive it. One thread at a time.
class FrameCache {
 public:
  /// `budget` in bytes of RGBA; at least the two newest pictures are always held.
  FrameCache(const Sprite& sprite, std::size_t budget = std::size_t{64} << 20);
  ~FrameCache();
  FrameCache(const FrameCache&) = delete;
  FrameCache& operator=(const FrameCache&) = delete;

  /// The premultiplied picture, decoded if need be; empty only if no good one was ever decoded.
  /// Valid until the next call but one. Pre: sample < N.
  ImageView frame(std::uint32_t sample) noexcept;
  const FrameCacheStats& stats() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsprite
