// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// walls.h - how a fish is kept in the tank without ever being pushed.
//
// A filmed fish cannot be stopped or shifted without a visible lie, so it has to turn in time. An
// Actor is a few dozen bytes and its future is certain: for every command that might be given, the
// guard plays a copy forwards. A command is safe if, after one tick of it, some escape keeps the
// drawn body inside, or nearly (kSoftGlass), for the whole look-ahead. What was an escape in this
// tick is one in the next, so a fish that starts safe stays safe; where none lasts so long, the one
// that lasts longest counts.
#pragma once

#include <cstdint>

#include "vsprite/actor.h"

namespace aquarium {

/// Edges of the room for the drawn body, in the same pixels as Actor::position.
struct Box {
  float left = 0;
  float top = 0;
  float right = 0;
  float bottom = 0;
};

/// Body lengths that may stand out of the room while a fish turns: a guard that allows none has to
/// refuse three times as many commands of a player who feeds.
inline constexpr float kSoftGlass = 0.15f;

/// The drawn picture's box. O(1).
Box body_box(const vsprite::Sprite& sprite, const vsprite::Actor& actor) noexcept;

/// How far `body` stands out of `room`, pixels; 0 if inside.
float overhang(const Box& room, const Box& body) noexcept;

/// What the guard remembers of one fish between ticks.
struct Guard {
  vsprite::Direction wanted = vsprite::Direction::None;  ///< the command that was refused
  vsprite::Direction given = vsprite::Direction::None;   ///< what was commanded in its place
  std::uint8_t active = 0;                               ///< 1 while a command is replaced
};

/// Ticks within which this fish can turn back, with a margin: tried on the film from 16 poses in
/// each heading; at most two seconds. Some 20,000 steps: call it once.
int measure_look_ahead(const vsprite::Sprite& sprite) noexcept;

/// The command to give: `wanted` where that is safe, else the safe one nearest to it in angle (the
/// roomier one of two), else the one that stands out least. A replaced command stays replaced
/// until the player asks for something else or the fish is well clear of the wall. Call once a
/// tick.
vsprite::Direction guarded_command(const vsprite::Sprite& sprite, const vsprite::Actor& actor,
                                   const Box& glass, vsprite::Direction wanted, int look_ahead,
                                   Guard& guard) noexcept;

}  // namespace aquarium
