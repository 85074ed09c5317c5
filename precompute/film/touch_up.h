// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/touch_up.h - what a person changes about a matte: the four usual corrections of a keyer.
#pragma once

#include <cstdint>
#include <vector>

#include "film/lanes.h"
#include "vsprite/image.h"

namespace vsprite::detail {

/// Alpha `black` (0..1) and what is below becomes 0, `white` and above 255, linear between.
/// Pre: black < white.
void stretch(float black, float white, std::vector<std::uint8_t>& alpha);

/// Moves the edge by `px` outwards, below 0 inwards: for each whole pixel the largest (least) alpha
/// of four neighbours is taken, every third time of eight, so that a point grows to an octagon; a
/// fraction is mixed. What lies beyond the map counts for nothing: at its border no edge moves.
/// `alpha` is (height, stride). Cost O(width height |px|).
void move_edge(float px, int stride, int width, int height, std::vector<std::uint8_t>& alpha);

/// Pixels where `grown` take the mean colour of those beside them that have one, from ring to ring;
/// those of alpha 0 have none. `grown` is all 0 afterwards, except where no colour reaches.
void spread_color(std::vector<std::uint8_t>& grown, Image& straight);

/// `share` (0..1) of what the screen's channels are above the others is taken off them.
void take_tint_out(KeyShape screen, float share, Image& straight);

}  // namespace vsprite::detail
