// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// school.h - what a fish does that nobody steers: wander, glide, rest, come for food, keep apart.
#pragma once

#include "world.h"

namespace aquarium {

/// The command that fish `index` gives itself in this tick.
vsprite::Direction think(const vsprite::Sprite& sprite, World& world, std::size_t index);

}  // namespace aquarium
