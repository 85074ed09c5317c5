// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/reload.h - takes a rebuilt pack over while the game runs.
//
//     PackWatch watch("hero.vsp");                          // before load_pack
//     ...
//     auto rebuilt = watch.poll();                          // between two frames
//     if (!rebuilt) say(rebuilt.error().message);           // the old one plays on
//     else if (*rebuilt) {
//       actor = carry_over(sprite, **rebuilt, actor);
//       fade = {};                                          // it names samples of the old one
//       forget(renderer, sprite);                           // draw.h: the old one's textures
//       frames.reset();                                     // a FrameCache borrows its Sprite
//       sprite = std::move(**rebuilt);
//       frames.emplace(sprite);
//     }
//
// A changed file is read and checked by a thread of its own, so that no frame is late, however
// large it is (built with VSPRITE_THREADS=OFF: by poll itself).
//
// Nothing of this can end the game: files are read, never mapped, so that no signal (SIGBUS) comes
// of one that is cut short, and a pack that was replaced by rename, as save_pack does, stays
// readable to who has it open. One that is rewritten in place costs the old Sprite pictures (their
// sums no longer fit) until it is taken over.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "vsprite/actor.h"
#include "vsprite/result.h"
#include "vsprite/sprite.h"

namespace vsprite {

/// Sees that a file has changed. Movable; for one thread at a time. Dropped, it lets go of a file
/// that it is checking.
class PackWatch {
 public:
  /// What lies at `path` now counts as known. May throw std::bad_alloc.
  explicit PackWatch(std::string path);
  PackWatch(PackWatch&&) noexcept;
  PackWatch& operator=(PackWatch&&) noexcept;
  ~PackWatch();

  /// The new pack, once a changed file was the same in two calls, so that one that is being written
  /// is left alone, and every byte of it was checked (verify_pack). Empty: nothing new yet; also
  /// while there is no file. Cost: a look at the file's date and size.
  /// Errors, once for each state of the file: as load_pack, and CorruptData with the first finding
  /// of verify_pack.
  Result<std::optional<Sprite>> poll();

 private:
  struct Check;
  /// Device, number, bytes, seconds and nanoseconds of the last change; zeros: no file.
  using Stamp = std::array<std::int64_t, 5>;
  Stamp look() const noexcept;

  std::string path_;
  Stamp known_{}, seen_{};
  std::unique_ptr<Check> check_;  ///< of the file in the state `known_`
};

/// The actor for another build of its pack: position, time, owner and command stay. It shows the
/// same frame of the film with the same tag, else the nearest frame with that tag, else the start
/// sample, in the mode of the same name, else in the first. An action that was being played is
/// left. Cost: O(N).
Actor carry_over(const Sprite& from, const Sprite& to, const Actor& actor) noexcept;

}  // namespace vsprite
