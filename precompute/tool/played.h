// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/played.h - what formats play that cannot be steered: runs of samples, one after the other.
//
// Under a solved table every sample has one next sample, so whoever holds a direction ends in a
// loop. Of several such loops the one is taken into which most samples lead: what a player sees
// most of. It is the playing order of that direction. A run can also be a clip as it was filmed, or
// a loop that was searched (control/loops.h).
//
// All pictures of an export share one canvas, with the anchor at its centre, so that one can be put
// in the place of another and a game that draws pictures centred needs no offsets.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vsprite/sprite.h"

namespace vsprite {

struct PlayedRun {
  std::string name;                    ///< unique in an export: "right-down", "film", a tag
  std::vector<std::uint32_t> samples;  ///< >= 1, in playing order
  bool loops = true;                   ///< the first follows the last
  std::optional<double> seam{};        ///< of a searched loop
};

/// For every compass direction that the default mode serves, then none and rest, the loop that it
/// plays, e.g. "left-up"; then for every named tag its samples as filmed, which do not loop.
std::vector<PlayedRun> direction_runs(const SpriteData& data);

/// Every clip as it was filmed, called by its tag, or "film"; "film-2" and so on where there are
/// several. They do not loop. Samples that were not kept are left out.
std::vector<PlayedRun> film_runs(const SpriteData& data);

/// The loop of `next`, (N), with kNoSample for samples that are not there, into which most samples
/// lead, from its lowest sample on. Empty if there is none.
std::vector<std::uint32_t> most_travelled_loop(const std::vector<std::uint32_t>& next);

/// Whole pixels; both sides are even, and the anchor is the centre.
struct Canvas {
  int width = 2;
  int height = 2;
  int left(const Sample& s) const noexcept;  ///< of a sample's picture, px from the left edge
  int top(const Sample& s) const noexcept;
};
Canvas canvas_of(const SpriteData& data, const std::vector<PlayedRun>& runs);

}  // namespace vsprite
