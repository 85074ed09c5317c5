// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/actor.h - one character: a few dozen bytes that a game may copy, save, roll back and
// send.
//
// A tick is one frame of the film. At the end of a tick the actor moves by the `step` of the sample
// that was shown during it (so draw_position, which runs ahead along that same step, never jumps);
// then, when the sample has been shown for its duration, the table of the commanded direction names
// the next one. A command is read every tick and acted on at the next sample. On a change of
// command the paper's switching chain is entered at stage K and left one stage a sample:
//
//     V^k_i = min_j [T_ij + a V^(k-1)_j],  k = 1..K,   V^0 the constrained table  [NIPS
//     section 4.1]
//
// In the mode "responsive" a change of command enters the turning tables instead, and the first
// sample that goes the commanded way enters the cruising ones; the next sample may be left out
// (double rate), and then its displacement is made up for in the following tick, so that no foot
// slides; and the displacement, never the picture, is turned towards the command by up to
// ControlMode::bend.
//
// Same pack, same seed, same commands: the same states, for ever, on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "vsprite/geometry.h"
#include "vsprite/sprite.h"

namespace vsprite {

/// Plain state; only meaningful together with the Sprite that it was made for.
struct Actor {
  Position position;                      ///< of the anchor, 1/65536 px, game coordinates
  std::uint64_t tick = 0;                 ///< ticks since make_actor
  std::uint32_t random = 0;               ///< state of the generator; drives variety only
  std::uint32_t sample = 0;               ///< shown now
  std::uint16_t shown = 0;                ///< ticks that `sample` has been shown, 1..duration
  std::uint8_t mode = 0;                  ///< index into SpriteData::modes
  Direction direction = Direction::None;  ///< as commanded
  std::uint8_t group = 0;                 ///< of the tables that are followed (policy.h)
  std::uint8_t bent = 0;   ///< group towards which this tick's displacement is turned
  std::uint8_t stage = 0;  ///< free steps left; or 1 turning, 0 cruising
  std::uint8_t table = 0;  ///< table that chose `sample`: group * stages + stage
  std::uint8_t jumped =
      0;  ///< 1 if this tick shows a sample that is not its predecessor's successor
  std::uint8_t skipped = 0;   ///< 1 if that left out one sample of the clip
  std::uint8_t play = 0;      ///< what of `action` is being done (action.h)
  std::uint8_t owner = 0;     ///< who moves it (owner.h)
  std::uint16_t action = 0;   ///< played now: 1 + index into Sprite::actions(); 0 it is steered
  std::uint16_t queued = 0;   ///< played after it, likewise
  std::uint16_t due = 0;      ///< ticks until the action has to show; 0 there is no deadline
  std::uint16_t clock = 0;    ///< of the shown sample, what has passed of a tick, 1/65536
  std::int16_t offset_x = 0;  ///< of the drawn anchor from `position`, 1/64 px (owner.h)
  std::int16_t offset_y = 0;
  std::int32_t drive_x = 0;  ///< as the owner of the position says (owner.h)
  std::int32_t drive_y = 0;
};
static_assert(std::is_trivially_copyable_v<Actor> && sizeof(Actor) == 64);
static_assert(std::has_unique_object_representations_v<Actor>);  // may be compared as bytes

/// At (x, y), showing the sprite's start sample, direction None.
Actor make_actor(const Sprite& sprite, Vec2 position = {}, std::uint64_t seed = 0,
                 int mode = 0) noexcept;

/// Commands a direction. The same direction again, or another one that follows the same tables
/// (ControlMode::table_of), restarts nothing. O(1).
void set_direction(const Sprite& sprite, Actor& actor, Direction direction) noexcept;

/// Commands any direction, as a stick or a mouse gives it: the nearest heading that is served, if
/// one lies within 60 degrees, else Rest; None for (0, 0). Hysteresis: with eight headings one is
/// kept until it is 30 degrees off, and in proportion with more.
void set_heading(const Sprite& sprite, Actor& actor, Vec2 toward) noexcept;

/// Commands the direction that leads to `target`; Rest once within `arrive_radius` px, and
/// until 1.5 radii away. Call it every tick.
void set_target(const Sprite& sprite, Actor& actor, Vec2 target, float arrive_radius) noexcept;

/// One tick. Never fails, allocates, locks or logs. O(1).
void step(const Sprite& sprite, Actor& actor) noexcept;
/// The same for each of many, to the same states; a crowd is faster this way.
void step(const Sprite& sprite, std::span<Actor> actors) noexcept;

/// How fast, where the film leaves a choice.
enum class Pace : std::uint8_t { Any, Slow, Fast };

/// What a game may ask of a tick beyond the command: among transitions that are nearly as good as
/// the best one, another.
struct StepWish {
  /// How much dearer counts as nearly as good, in transition costs (1 = the classifier's
  /// threshold).
  float slack = 0;
  /// Room around a position, in any unit: of the near ties the one that leads, ten samples on, to
  /// the most room is taken. Null: one is drawn from Actor::random, so that a school does not move
  /// in lockstep; the same seed gives the same states.
  float (*clearance)(const void* world, Vec2 position) = nullptr;
  const void* world = nullptr;  ///< handed to `clearance`
  /// Without `clearance`: of the near ties the one that leads on slowest or fastest, over the next
  /// ten samples. A preference, not a command: with `slack` 0 it changes nothing.
  Pace pace = Pace::Any;
};
/// One tick, as above. Cost: one row of transitions where a sample ends. Never allocates.
void step(const Sprite& sprite, Actor& actor, const StepWish& wish) noexcept;

/// Where to draw the anchor between two ticks: `fraction` in [0, 1) of a tick after the last step,
/// px.
Vec2 draw_position(const Sprite& sprite, const Actor& actor, float fraction) noexcept;

/// T of the jump that brought the shown sample, given the one before; 0 for natural continuation.
/// (Actor keeps no past: pass the sample shown before the step.)
float shown_cost(const Sprite& sprite, std::uint32_t before, const Actor& after) noexcept;

/// Running XXH3-64 over ticks, as DESIGN section 4 defines states_hash. Not thread-safe.
class StateHash {
 public:
  static constexpr std::size_t kStateBytes = 640;
  StateHash() noexcept;
  StateHash(const StateHash&) = delete;
  StateHash& operator=(const StateHash&) = delete;
  /// Call it after every step. Appends, little-endian: tick u64, sample u32, x i64, y i64,
  /// direction u8, table u8.
  void add(const Actor& actor) noexcept;
  std::uint64_t digest() const noexcept;

 private:
  alignas(64) std::byte state_[kStateBytes];
};

}  // namespace vsprite
