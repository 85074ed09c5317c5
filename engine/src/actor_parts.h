// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// actor_parts.h - the pieces of a tick that steering, actions and owners of the position share.
#pragma once

#include "pack_format.h"
#include "vsprite/actor.h"

namespace vsprite::detail {

struct Displacement {
  std::int64_t x = 0, y = 0;
};

// Wraps instead of overflowing, which a hostile pack could reach after some billion ticks.
inline std::int64_t moved(std::int64_t position, std::int64_t by) noexcept {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(position) +
                                   static_cast<std::uint64_t>(by));
}

inline void move_by(Actor& actor, Displacement by) noexcept {
  ++actor.tick;
  actor.position.x = moved(actor.position.x, by.x);
  actor.position.y = moved(actor.position.y, by.y);
}

/// What a tick moves as filmed: the step of the shown sample, and in the first tick after a sample
/// was left out, all of that one's.
Displacement recorded_step(const Sprite::Impl& impl, const Actor& actor) noexcept;

/// Keeps showing the sample, if its time is not over.
inline bool stays(const Sprite::Impl& impl, Actor& actor) noexcept {
  if (actor.shown >= impl.data.samples[actor.sample].duration) return false;
  ++actor.shown;
  actor.jumped = actor.skipped = 0;
  return true;
}

/// Shows what a table chose, or a near tie of it.
inline void show(Actor& actor, std::uint32_t table, std::uint32_t move) noexcept {
  actor.sample = move & kMoveSample;
  actor.shown = 1;
  actor.table = static_cast<std::uint8_t>(table);
  actor.stage = static_cast<std::uint8_t>(move >> kMoveStageShift & kMoveStage);
  actor.jumped = static_cast<std::uint8_t>(move >> kMoveJumpedShift & 1u);
  actor.skipped = static_cast<std::uint8_t>(move >> kMoveSkippedShift & 1u);
}

/// What the tables of the followed group show next.
inline void show_steered(const Sprite::Impl& impl, Actor& actor) noexcept {
  const TickTable& table = impl.ticks[actor.mode];
  const std::uint32_t move = table.record(actor.sample, actor.group)[2 + actor.stage];
  show(actor, actor.group * table.stages + actor.stage, move);
}

/// The film's tick of an actor that plays an action: what it shows next. Pre: actor.action != 0.
void advance_action(const Sprite::Impl& impl, Actor& actor) noexcept;
/// The same of one that is steered while the game moves it.
void advance_following(const Sprite::Impl& impl, Actor& actor) noexcept;
/// How the drawn character trails the body that the game moves, after this tick.
struct Trail {
  double x = 0, y = 0;  ///< of the drawn anchor from the position, 1/65536 px
  double slip = 0;      ///< what its feet slide in this tick, 1/65536 px
  void put(Actor& actor) const noexcept;
};
Trail trail(const Sprite::Impl& impl, const Actor& actor) noexcept;
inline constexpr double kOffsetUnit = 1024;  ///< of Actor::offset_x, in 1/65536 px

/// Film ticks, in 1/65536, that a tick of an actor plays which the game moves.
std::uint32_t clock_rate(const Sprite::Impl& impl, const Actor& actor) noexcept;

}  // namespace vsprite::detail
