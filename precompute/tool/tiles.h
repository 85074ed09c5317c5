// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/tiles.h - what a long search over all pairs has found so far, so that a killed one goes on.
//
// pairs/000012.bin, one file a tile: eight bytes of magic, the search's key (u64), u64 considered,
// u64 compared, u64 pairs, (u32 i, u32 j, f32 distance)[pairs], XXH3-64 of all before it. A file
// that does not fit is as good as none. The folder goes when the stage is done.
#pragma once

#include <cstdint>
#include <string>

#include "similarity/distance.h"

namespace vsprite {

/// Searches of more pairs than this keep their tiles, and say beforehand what they need.
inline constexpr std::uint64_t kLongSearch = 100'000'000;

/// Reads and writes tiles in `folder`, which is made; a tile that cannot be written is not kept.
/// `key`: a sum of everything that the tiles depend on.
TileStore keep_tiles(const std::string& folder, std::uint64_t key);

/// A sentence on what the search will need: "450 million pairs: about 8 s on one core, 1.2 GB".
/// Errors: OutOfMemory, where more is due than is free.
Result<std::string> foresee(const PairFinder& finder, std::size_t samples);

}  // namespace vsprite
