// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// One tick of a character: move by the shown sample, then perhaps look up the next one.
#include "vsprite/actor.h"

#define XXH_STATIC_LINKING_ONLY  // the size of the streaming state
#include <xxhash.h>

#include <array>
#include <cmath>
#include <new>

#include "vsprite/policy.h"

namespace vsprite {
namespace {

const ControlMode& mode_of(const Sprite& sprite, const Actor& actor) noexcept {
  return sprite.data().modes[actor.mode];
}

Direction followed(const ControlMode& mode, Direction command) noexcept {
  return mode.table_of[static_cast<std::size_t>(command)];
}

// Wraps instead of overflowing, which a hostile pack could reach after some billion ticks.
std::int64_t moved(std::int64_t position, std::int32_t step) noexcept {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(position) +
                                   static_cast<std::uint64_t>(std::int64_t{step}));
}

void show_next(const Sprite& sprite, Actor& actor) noexcept {
  const Policy policy = make_policy(sprite, actor.mode);
  const Direction direction = followed(mode_of(sprite, actor), actor.direction);
  const std::uint32_t table = table_index(policy, direction, actor.stage);
  const std::uint32_t next = next_sample(policy, table, actor.sample);
  actor.jumped = sprite.is_natural(actor.sample, next) ? 0 : 1;
  actor.sample = next;
  actor.shown = 1;
  actor.table = static_cast<std::uint8_t>(table);
  if (actor.stage > 0) --actor.stage;
}

}  // namespace

Actor make_actor(const Sprite& sprite, Vec2 position, std::uint64_t seed, int mode) noexcept {
  Actor actor;
  actor.position = to_position(position);
  actor.random = seed;
  actor.sample = sprite.data().start_sample;
  actor.shown = 1;
  actor.mode = static_cast<std::uint8_t>(mode);
  const Policy policy = make_policy(sprite, mode);
  const Direction none = followed(mode_of(sprite, actor), Direction::None);
  actor.table = static_cast<std::uint8_t>(table_index(policy, none, 0));
  return actor;
}

void set_direction(const Sprite& sprite, Actor& actor, Direction direction) noexcept {
  if (direction == actor.direction) return;
  const ControlMode& mode = mode_of(sprite, actor);
  const bool same_tables = followed(mode, direction) == followed(mode, actor.direction);
  actor.direction = direction;
  if (!same_tables) actor.stage = static_cast<std::uint8_t>(mode.stages - 1);
}

void set_target(const Sprite& sprite, Actor& actor, Vec2 target, float arrive_radius) noexcept {
  // A sector is 22.5 degrees to either side; the one in force is left only beyond 30, and an actor
  // that has arrived starts again only beyond 1.5 radii, so that neither border makes it dither.
  constexpr double kCosLeave = 0.86602540378443865;
  constexpr double kLeaveRadius = 1.5;
  const double dx =
      static_cast<double>(target.x) - static_cast<double>(actor.position.x) / kFixedOne;
  const double dy =
      static_cast<double>(target.y) - static_cast<double>(actor.position.y) / kFixedOne;
  const double distance = std::sqrt(dx * dx + dy * dy);
  const bool resting = actor.direction == Direction::Rest;
  const double radius = arrive_radius * (resting ? kLeaveRadius : 1.0);
  if (!(distance > radius)) return set_direction(sprite, actor, Direction::Rest);
  const Vec2 unit = unit_vector(actor.direction);
  if (unit.x * dx + unit.y * dy >= kCosLeave * distance) return;
  set_direction(
      sprite, actor,
      nearest_direction({static_cast<float>(dx / distance), static_cast<float>(dy / distance)}));
}

void step(const Sprite& sprite, Actor& actor) noexcept {
  const Sample& sample = sprite.data().samples[actor.sample];
  ++actor.tick;
  actor.position.x = moved(actor.position.x, sample.step_x);
  actor.position.y = moved(actor.position.y, sample.step_y);
  if (actor.shown < sample.duration) {
    ++actor.shown;
    actor.jumped = 0;
  } else {
    show_next(sprite, actor);
  }
}

Vec2 draw_position(const Sprite& sprite, const Actor& actor, float fraction) noexcept {
  const Sample& sample = sprite.data().samples[actor.sample];
  const double x =
      static_cast<double>(actor.position.x) + static_cast<double>(fraction) * sample.step_x;
  const double y =
      static_cast<double>(actor.position.y) + static_cast<double>(fraction) * sample.step_y;
  return {static_cast<float>(x / kFixedOne), static_cast<float>(y / kFixedOne)};
}

float shown_cost(const Sprite& sprite, std::uint32_t before, const Actor& after) noexcept {
  return after.jumped ? sprite.transition_cost(before, after.sample) : 0;
}

static_assert(sizeof(XXH3_state_t) <= StateHash::kStateBytes);
static_assert(alignof(XXH3_state_t) <= alignof(StateHash));

StateHash::StateHash() noexcept { XXH3_64bits_reset(new (state_) XXH3_state_t); }

void StateHash::add(const Actor& actor) noexcept {
  std::array<std::uint8_t, 30> row;
  std::size_t at = 0;
  const auto put = [&](std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) row[at++] = static_cast<std::uint8_t>(value >> (8 * i));
  };
  put(actor.tick, 8);
  put(actor.sample, 4);
  put(static_cast<std::uint64_t>(actor.position.x), 8);
  put(static_cast<std::uint64_t>(actor.position.y), 8);
  put(static_cast<std::uint64_t>(actor.direction), 1);
  put(actor.table, 1);
  XXH3_64bits_update(std::launder(reinterpret_cast<XXH3_state_t*>(state_)), row.data(), row.size());
}

std::uint64_t StateHash::digest() const noexcept {
  return XXH3_64bits_digest(std::launder(reinterpret_cast<const XXH3_state_t*>(state_)));
}

}  // namespace vsprite
