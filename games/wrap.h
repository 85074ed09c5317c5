// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// wrap.h - a world without walls.
#pragma once

#include <cstdint>

#include "vsprite/actor.h"
#include "vsprite/sprite.h"

namespace vsprite::games {

/// A character that leaves a picture of width x height px comes back on the other side.
inline void wrap(const Sprite& sprite, Actor& actor, int width, int height) {
  const auto edge = static_cast<std::int64_t>(sprite.data().body_length / 2) * kFixedOne;
  const auto around = [edge](std::int64_t& value, int size) {
    const std::int64_t far = size * kFixedOne + edge;
    if (value < -edge) value = far;
    if (value > far) value = -edge;
  };
  around(actor.position.x, width);
  around(actor.position.y, height);
}

}  // namespace vsprite::games
