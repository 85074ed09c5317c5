// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/stream.h - decoded pictures within a byte budget, decoded ahead.
//
// One cache serves all actors of a sprite. Least recently used pictures go first. Pictures are held
// without the transparent margins of their rows (half the bytes of the bundled film), GPU-ready
// ones as blocks (a quarter), and handed out whole. A picture that fails its own sum is replaced by
// the last good one and counted; drawing never fails.
//
// What an actor will show is no secret: its tables name it. look_ahead (draw_actor calls it) steps
// a copy of the actor as it is commanded now, then copies of it commanded every other way, and
// hands the pictures that are not held to one background thread: those of the present command
// first. The game's thread takes over what was decoded when it next asks for a picture; it never
// waits for the background thread, and decodes a picture itself where that came too late: a miss.
// Built with VSPRITE_THREADS=OFF there is no such thread, and pictures are decoded when they are
// asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "vsprite/actor.h"
#include "vsprite/sprite.h"

namespace vsprite {

struct FrameCacheStats {
  std::uint64_t hits = 0;
  std::uint64_t misses = 0;   ///< decoded by the thread that asked
  std::uint64_t ahead = 0;    ///< decoded by the background thread
  std::uint64_t damaged = 0;  ///< pictures that were replaced
  std::size_t bytes = 0;      ///< held now
};

/// Borrows the Sprite, which must outlive it. To be called by one thread at a time.
class FrameCache {
 public:
  /// `budget` in bytes, of trimmed pictures and the two handed out last by each call, which are
  /// always held.
  FrameCache(const Sprite& sprite, std::size_t budget = std::size_t{64} << 20);
  ~FrameCache();
  FrameCache(const FrameCache&) = delete;
  FrameCache& operator=(const FrameCache&) = delete;

  /// The premultiplied picture, put together from its rows, or decoded if need be; empty only if no
  /// good one was ever decoded. Valid until the next call but one. Pre: sample < N.
  ImageView frame(std::uint32_t sample) noexcept;
  /// The same picture for a GPU, as the pack holds it; without bytes where the pack is not
  /// GPU-ready (Sprite::has_blocks) or no such picture can be had: ask frame() then. Valid until
  /// the next call but one. Pre: sample < N.
  BlockView blocks(std::uint32_t sample) noexcept;
  /// Has the pictures decoded that the actor shows next, under the present and any other command.
  /// Call it after a step, or once a drawn frame: an actor that has not changed since is passed
  /// over. Cost: some twenty steps, no decoding; the first call starts the thread.
  void look_ahead(const Actor& actor) noexcept;
  const FrameCacheStats& stats() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsprite
