// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The tank's rules, one tick at a time: think, swim, drop food, eat, count.
#include "world.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "school.h"

namespace aquarium {

using vsprite::Direction;
using vsprite::Sprite;
using vsprite::Vec2;

namespace {

constexpr float kPlayerBody = 130;  // tank px from nose to tail
constexpr float kBite = 36;         // tank px around the mouth of the player's fish
constexpr float kFlakeFloor = 652;  // tank px
constexpr float kComboSeconds = 3.0f;
constexpr float kFlakeRestSeconds = 5.0f;
constexpr std::size_t kMostFlakes = 9;

float fps_of(const Sprite& sprite) { return static_cast<float>(sprite.fps()); }

int ticks_of(const Sprite& sprite, float seconds) {
  return static_cast<int>(seconds * fps_of(sprite) + 0.5f);
}

void set_phase(World& world, Phase phase) {
  world.phase = phase;
  world.phase_ticks = 0;
}

void start_round(const Sprite& sprite, World& world) {
  set_phase(world, Phase::Playing);
  world.round_ticks = ticks_of(sprite, kRoundSeconds);
  world.until_drop = 0;
  world.since_bite = ticks_of(sprite, kComboSeconds);
  world.score = world.eaten = world.stolen = world.combo = world.best_combo = 0;
  world.flakes.clear();
  world.events.push_back({EventKind::Start, {kTankWidth / 2, 0}, 0, 0});
}

void end_round(World& world) {
  set_phase(world, Phase::Over);
  world.events.push_back({EventKind::End, {kTankWidth / 2, 0}, world.score, world.combo});
  world.combo = 0;
}

/// Where the player's fish is to swim; by itself before and after a round.
Direction player_command(const Sprite& sprite, World& world, const Input& input) {
  Fish& fish = world.fish[0];
  if (world.phase != Phase::Playing) return think(sprite, world, 0);
  if (!input.target) return input.direction;
  vsprite::Actor trial = fish.actor;
  if (fish.guard.active) trial.direction = fish.guard.wanted;
  const Vec2 target{input.target->x / fish.scale, input.target->y / fish.scale};
  vsprite::set_target(sprite, trial, target, 0.3f * sprite.data().body_length);
  return trial.direction;
}

/// Low-passed direction of travel: a resting fish keeps looking where it looked.
void update_heading(const Sprite& sprite, Fish& fish) {
  const Vec2 v = sprite.samples()[fish.actor.sample].velocity;
  const float pace = 1.0f / std::max(1.0f, sprite.data().body_length);
  const Vec2 h{fish.heading.x + 0.5f * v.x * pace, fish.heading.y + 0.5f * v.y * pace};
  const float length = std::sqrt(h.x * h.x + h.y * h.y);
  if (length > 0.05f) fish.heading = {h.x / length, h.y / length};
}

/// The last resort for films whose fish cannot turn everywhere: it drifts no further out than a
/// fifth of its length.
void hold_back(const Sprite& sprite, Fish& fish) {
  const Box room = room_of(fish);
  const Box body = body_box(sprite, fish.actor);
  const float most = 0.2f * sprite.data().body_length;
  const auto back = [most](float below, float above) {
    const float low = below - most;
    const float high = above - most;
    return static_cast<std::int64_t>((low > 0    ? low
                                      : high > 0 ? -high
                                                 : 0.0f) *
                                     static_cast<float>(vsprite::kFixedOne));
  };
  fish.actor.position.x += back(room.left - body.left, body.right - room.right);
  fish.actor.position.y += back(room.top - body.top, body.bottom - room.bottom);
}

/// Of the film, sprite px.
Vec2 way_of_a_tick(const Sprite& sprite, const Fish& fish) {
  const Vec2 v = sprite.samples()[fish.actor.sample].velocity;
  return {v.x / fps_of(sprite), v.y / fps_of(sprite)};
}

void swim(const Sprite& sprite, Fish& fish, Direction wanted, int look_ahead) {
  const Direction command =
      guarded_command(sprite, fish.actor, room_of(fish), wanted, look_ahead, fish.guard);
  vsprite::set_direction(sprite, fish.actor, command);
  const Vec2 extra = glide_of(sprite, fish);
  const Vec2 own = way_of_a_tick(sprite, fish);
  vsprite::step(sprite, fish.actor);
  const auto one = static_cast<float>(vsprite::kFixedOne);
  fish.actor.position.x += static_cast<std::int64_t>(extra.x * one);
  fish.actor.position.y += static_cast<std::int64_t>(extra.y * one);
  fish.glide = {own.x + extra.x, own.y + extra.y};
  hold_back(sprite, fish);
  update_heading(sprite, fish);
}

void drop_flake(const Sprite& sprite, World& world) {
  Random& dice = world.dice;
  world.until_drop = ticks_of(sprite, dice.between(0.7f, 1.5f));
  if (world.flakes.size() >= kMostFlakes) return;
  Flake flake;
  flake.id = world.next_id++;
  flake.column = dice.between(110, kTankWidth - 110);
  flake.at = {flake.column, 6};
  flake.dainty = dice.below(7) == 0 ? 1 : 0;
  flake.fall = dice.between(36, 62) * (flake.dainty ? 1.5f : 1.0f) / fps_of(sprite);
  flake.phase = dice.between(0, 1);
  flake.size = dice.between(7, 11);
  world.flakes.push_back(flake);
  world.events.push_back({EventKind::Splash, flake.at, 0, 0});
}

void sink(const Sprite& sprite, Flake& flake) {
  ++flake.age;
  if (flake.at.y >= kFlakeFloor) {
    ++flake.rested;
    return;
  }
  const float turns = flake.phase + 0.28f * static_cast<float>(flake.age) / fps_of(sprite);
  const float reach = std::min(26.0f, 0.25f * flake.at.y);
  flake.at = {flake.column + reach * wave(turns), flake.at.y + flake.fall};
}

bool can_bite(const Sprite& sprite, const Fish& fish, const Flake& flake, float reach) {
  const Vec2 mouth = mouth_of(sprite, fish);
  const float x = mouth.x - flake.at.x;
  const float y = mouth.y - flake.at.y;
  return x * x + y * y < reach * reach;
}

void bite(const Sprite& sprite, World& world, const Flake& flake) {
  const bool quick = world.since_bite < ticks_of(sprite, kComboSeconds);
  world.combo = quick ? std::min(world.combo + 1, kMaxCombo) : 1;
  world.best_combo = std::max(world.best_combo, world.combo);
  world.since_bite = 0;
  const int points = (flake.dainty ? 30 : 10) * world.combo;
  world.score += points;
  ++world.eaten;
  world.events.push_back({EventKind::Bite, flake.at, points, world.combo});
}

/// Who bites first: the player, then the others from near to far.
bool is_eaten(const Sprite& sprite, World& world, const Flake& flake) {
  if (can_bite(sprite, world.fish[0], flake, kBite)) {
    bite(sprite, world, flake);
    return true;
  }
  for (std::size_t k = 1; k < world.fish.size(); ++k) {
    const Fish& other = world.fish[k];
    const bool hungry = other.mind.wish == Mind::Wish::Feed && other.mind.flake == flake.id;
    if (!hungry || !can_bite(sprite, other, flake, 0.6f * kBite)) continue;
    ++world.stolen;
    world.events.push_back({EventKind::Stolen, flake.at, 0, 0});
    return true;
  }
  return false;
}

void feed(const Sprite& sprite, World& world) {
  if (--world.until_drop <= 0) drop_flake(sprite, world);
  const int dissolved = ticks_of(sprite, kFlakeRestSeconds);
  for (Flake& flake : world.flakes) sink(sprite, flake);
  std::erase_if(world.flakes, [&](const Flake& flake) {
    return flake.rested > dissolved || is_eaten(sprite, world, flake);
  });
  if (++world.since_bite >= ticks_of(sprite, kComboSeconds)) world.combo = 0;
}

void run_round(const Sprite& sprite, World& world) {
  feed(sprite, world);
  const int second = ticks_of(sprite, 1);
  --world.round_ticks;
  if (world.round_ticks > 0 && world.round_ticks <= 5 * second && world.round_ticks % second == 0)
    world.events.push_back({EventKind::LastSeconds, {kTankWidth / 2, 0}, 0, 0});
  if (world.round_ticks <= 0) end_round(world);
}

Fish make_fish(const Sprite& sprite, Random& dice, Vec2 at, float body, float depth) {
  Fish fish;
  fish.scale = body / std::max(1.0f, sprite.data().body_length);
  fish.depth = depth;
  fish.actor = vsprite::make_actor(sprite, {at.x / fish.scale, at.y / fish.scale}, dice.next());
  return fish;
}

/// A second of swimming by itself, so that no two fish show the same frame of the film.
void shuffle_pose(const Sprite& sprite, Random& dice, Fish& fish) {
  const vsprite::Position at = fish.actor.position;
  const auto way = static_cast<Direction>(dice.below(vsprite::kCompassCount));
  const int ticks = ticks_of(sprite, dice.between(0.5f, 4.0f));
  vsprite::set_direction(sprite, fish.actor, way);
  for (int t = 0; t < ticks; ++t) vsprite::step(sprite, fish.actor);
  fish.actor.position = at;
  fish.actor.tick = 0;
  update_heading(sprite, fish);
}

}  // namespace

World make_world(const Sprite& sprite, std::uint64_t seed, int others) {
  World world;
  world.dice.state = seed;
  world.look_ahead = measure_look_ahead(sprite);
  world.fish.push_back(make_fish(sprite, world.dice, {kTankWidth / 2, 350}, kPlayerBody, 0));
  const int count = std::clamp(others, 0, 6);
  for (int k = 0; k < count; ++k) {
    const float depth =
        0.25f + 0.6f * static_cast<float>(k) / static_cast<float>(std::max(1, count - 1));
    const Vec2 at{kTankWidth * (0.2f + 0.6f * world.dice.between(0, 1)),
                  world.dice.between(180, 480)};
    Fish fish = make_fish(sprite, world.dice, at, kPlayerBody * (1 - 0.62f * depth), depth);
    shuffle_pose(sprite, world.dice, fish);
    world.fish.push_back(fish);
  }
  return world;
}

void step(const Sprite& sprite, World& world, const Input& input) {
  world.events.clear();
  if (world.paused) return;
  ++world.tick;
  ++world.phase_ticks;
  const bool steered = input.target || static_cast<int>(input.direction) < vsprite::kCompassCount;
  if (world.phase == Phase::Ready && (steered || input.start)) start_round(sprite, world);
  if (world.phase == Phase::Over && input.start) start_round(sprite, world);

  swim(sprite, world.fish[0], player_command(sprite, world, input), world.look_ahead);
  if (world.phase == Phase::Playing) {
    ++world.steered_ticks;
    world.refused_ticks += world.fish[0].guard.active;
  }
  for (std::size_t k = 1; k < world.fish.size(); ++k)
    swim(sprite, world.fish[k], think(sprite, world, k), world.look_ahead);
  if (world.phase == Phase::Playing) run_round(sprite, world);
}

Box room_of(const Fish& fish) noexcept {
  // A far fish swims above the far pebbles, and the glass on either side is further off.
  const float floor = kFloor - 70 * fish.depth;
  const float side = -40 * fish.depth;
  const float s = fish.scale;
  return {(side + 14) / s, 26 / s, (kTankWidth - side - 14) / s, floor / s};
}

Vec2 glide_of(const Sprite& sprite, const Fish& fish) noexcept {
  constexpr float kLeft = 0.86f;  // of the way, a tick
  const Vec2 own = way_of_a_tick(sprite, fish);
  const Vec2 kept{kLeft * fish.glide.x, kLeft * fish.glide.y};
  const bool slower = own.x * own.x + own.y * own.y < kept.x * kept.x + kept.y * kept.y;
  if (fish.actor.direction != Direction::Rest || !slower) return {};
  return {kept.x - own.x, kept.y - own.y};
}

Vec2 place_of(const Fish& fish) noexcept {
  const Vec2 at = vsprite::to_pixels(fish.actor.position);
  return {at.x * fish.scale, at.y * fish.scale};
}

Vec2 mouth_of(const Sprite& sprite, const Fish& fish) noexcept {
  const Vec2 at = place_of(fish);
  const float reach = 0.4f * sprite.data().body_length * fish.scale;
  return {at.x + reach * fish.heading.x, at.y + reach * fish.heading.y};
}

int seconds_left(const Sprite& sprite, const World& world) noexcept {
  return static_cast<int>(std::ceil(static_cast<double>(world.round_ticks) / sprite.fps()));
}

std::uint64_t states_hash(const World& world) noexcept {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  const auto add = [&hash](std::uint64_t value) {
    for (int k = 0; k < 8; ++k) hash = (hash ^ ((value >> (8 * k)) & 255u)) * 0x100000001b3ull;
  };
  const auto add_float = [&add](float value) { add(std::bit_cast<std::uint32_t>(value)); };
  add(world.tick);
  add(static_cast<std::uint64_t>(world.phase));
  add(static_cast<std::uint64_t>(world.score));
  add(static_cast<std::uint64_t>(world.round_ticks));
  add(world.dice.state);
  for (const Fish& fish : world.fish) {
    add(static_cast<std::uint64_t>(fish.actor.position.x));
    add(static_cast<std::uint64_t>(fish.actor.position.y));
    add(fish.actor.sample);
    add(static_cast<std::uint64_t>(fish.actor.direction));
    add(fish.actor.table);
  }
  for (const Flake& flake : world.flakes) {
    add(flake.id);
    add_float(flake.at.x);
    add_float(flake.at.y);
  }
  return hash;
}

}  // namespace aquarium
