// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/build_pack.h - from the stages' tables to the data of a pack, and which directions it
// serves.
//
// Lengths change from film pixels to sprite pixels here: anchors, velocities and areas are
// multiplied by the sample's scale. A direction is served where the engine's own actor was measured
// to travel it.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "control/response.h"
#include "tool/pictures.h"
#include "tool/project.h"
#include "vsprite/sprite.h"

namespace vsprite {

/// `boxes`: (N) of each picture; without them the body length is 1 and there are no body boxes.
/// Errors: BadContent (no sample was kept).
Result<SpriteData> make_sprite_data(const FilmFacts& film, const std::vector<SampleRow>& rows,
                                    const TransitionFile& file, const ValueFile& values,
                                    std::span<const OpaqueBox> boxes);

using DirectionReports = std::array<DirectionReport, kCompassCount>;

/// Why a direction cannot be travelled, and what to film; empty where it can.
std::string unserved_reason(const SpriteData& data, const DirectionReport& report);

}  // namespace vsprite
