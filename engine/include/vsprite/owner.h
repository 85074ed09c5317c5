// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/owner.h - who moves the actor: the film, the film times a factor, or the game.
//
// A game whose physics own the position says each tick how fast its body really goes; the engine
// then shows samples that go so. The drawn character moves as filmed, at up to 1.25 times the pace
// (0.8 at least), so that its feet stand where they stand, and trails the body like a dog on a
// leash: it is drawn back by at most a tenth of the speed, and never further away than a third of
// a body length. What it is drawn back by is all that the feet slide. Of the transitions at hand
// the one is taken that leads to the least of it,
//
//     min_j  p(T_ij) + w sum_k |o_k| + g go_(j+L),   o_k = o_(k-1) + d_k - v / r,   k = 1..L,
//
// o being the way from the body to the drawn anchor, d_k what the k-th sample from j on moves, v
// the body's displacement a tick, r the pace; and go what the mode's own tables expect from there
// on, between the two headings beside v. At the end of the leash and not getting on it follows the
// mode's tables until it does.
//
//     follow(sprite, actor, body.velocity());   // every tick, px/s
//     step(sprite, actor);                      // position moves by exactly that
#pragma once

#include "vsprite/actor.h"

namespace vsprite {

enum class PositionOwner : std::uint8_t {
  Recorded,  ///< moves as filmed, turned by up to ControlMode::bend
  Scaled,    ///< the same times Actor::drive, in 1/65536
  Game       ///< moves by Actor::drive, 1/65536 px a tick
};

/// Actor::owner: who, and whether the last tick showed nothing new.
inline constexpr std::uint8_t kOwnerKind = 0x7F, kOwnerStill = 0x80;

/// How much slower or faster than filmed a sample is played at most, when the game moves it.
inline constexpr double kSlowestRate = 0.8, kFastestRate = 1.25;

/// Moves as filmed again.
void own_recorded(Actor& actor) noexcept;
/// Moves as filmed times a factor, -16..16 for each axis: a larger world, or no walking at all (0).
void own_scaled(Actor& actor, Vec2 factor) noexcept;
/// The game moves it by `velocity`, px/s, from the next step on until told otherwise. A velocity
/// below a quarter of the speed at which the sprite's samples usually move commands Rest.
void follow(const Sprite& sprite, Actor& actor, Vec2 velocity) noexcept;

/// How fast the feet slide over the ground in the coming tick, px/s, where the game moves the
/// actor.
double foot_slip(const Sprite& sprite, const Actor& actor) noexcept;

}  // namespace vsprite
