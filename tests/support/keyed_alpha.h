// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// keyed_alpha.h - a keyed frame's alpha at a place of the film.
#pragma once

#include "film/matte.h"

namespace vsprite::testing {

/// 0..255; 0 outside the crop.
inline int alpha_of(const KeyedFrame& keyed, int x, int y) {
  x -= keyed.crop.x;
  y -= keyed.crop.y;
  if (x < 0 || y < 0 || x >= keyed.crop.width || y >= keyed.crop.height) return 0;
  return keyed.straight.rgba[static_cast<std::size_t>(4 * (y * keyed.crop.width + x) + 3)];
}

}  // namespace vsprite::testing
