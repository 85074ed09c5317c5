// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/body.h - where a character is: the constant box to collide with, the box that is drawn,
// and whether a point hits what one sees. Boxes are in game pixels, x right, y down.
#pragma once

#include <cstdint>

#include "vsprite/actor.h"
#include "vsprite/image.h"
#include "vsprite/sprite.h"

namespace vsprite {

struct Box {
  float left = 0, top = 0, right = 0, bottom = 0;
  bool contains(Vec2 p) const noexcept {
    return p.x >= left && p.x < right && p.y >= top && p.y < bottom;
  }
  bool overlaps(const Box& b) const noexcept {
    return left < b.right && b.left < right && top < b.bottom && b.top < bottom;
  }
};

/// The body of the shown tag about the actor's position (BodyBox): it does not change while the tag
/// is played. Of a pack without boxes: a square of the body length about the anchor. `scale`: as
/// the sprite is drawn.
Box body_box(const Sprite& sprite, const Actor& actor, float scale = 1) noexcept;

/// The shown picture's, which changes with every sample.
Box drawn_box(const Sprite& sprite, const Actor& actor, float scale = 1) noexcept;

/// True if `point` lies on a pixel of the shown picture with at least this alpha. `picture`: the
/// shown sample's, as FrameCache or decode_frame hands it out; another size hits nothing.
bool hit(const Sprite& sprite, const Actor& actor, ImageView picture, Vec2 point, float scale = 1,
         std::uint8_t alpha = 128) noexcept;

}  // namespace vsprite
