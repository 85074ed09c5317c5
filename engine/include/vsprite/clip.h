// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/clip.h - scripted runs that lie in a pack beside its sprite, played back sample by
// sample.
//
// `vsprite path PACK --script FILE -o OTHER.vsp` searches a run and stores it: a start and one
// sample after the other. Nothing else is needed, because a sprite moves by the `step` of the
// sample that it shows: a clip takes 4 bytes a sample, and ends exactly where the search ended.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vsprite/geometry.h"
#include "vsprite/result.h"
#include "vsprite/sprite.h"

namespace vsprite {

/// A scripted run of one sprite.
struct PackClip {
  std::string name;                    ///< 1..255 bytes, one of its kind in a pack
  Position start;                      ///< of the anchor at the first tick
  std::vector<std::uint32_t> samples;  ///< one after the other, each shown for its duration
};

/// The clips of the pack at `path`, in the order of the file; none is no error. Every sample is
/// checked to be a kept one of `sprite`, which came from that pack.
/// Errors: those of load_pack; CorruptData.
Result<std::vector<PackClip>> load_clips(const std::string& path, const Sprite& sprite);

/// Writes the pack at `from` with these clips, in place of those it has, to `to` (which may be
/// `from`): everything else stays byte for byte; `to` appears complete, or not at all.
/// Errors: those of load_pack; CorruptData (a clip that load_clips would refuse), CannotCreate,
/// CannotWrite.
Result<void> save_clips(const std::string& from, const std::string& to,
                        std::span<const PackClip> clips);

/// Where a clip is played: copyable state, like an Actor. Pre: the clip belongs to the sprite.
struct ClipPlayer {
  Position position;        ///< of the anchor now
  std::uint32_t index = 0;  ///< into PackClip::samples
  std::uint32_t shown = 1;  ///< ticks that this sample has been shown, 1..duration
};
/// At the clip's first tick. Pre: the clip has a sample.
ClipPlayer start_clip(const PackClip& clip) noexcept;
/// One tick; false, and nothing moves, where the last one is shown. Never allocates. O(1).
bool step(const Sprite& sprite, const PackClip& clip, ClipPlayer& player) noexcept;

}  // namespace vsprite
