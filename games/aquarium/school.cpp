// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The school: short plans, made anew when they end, dropped when another fish comes too close.
#include "school.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace aquarium {

using vsprite::Direction;
using vsprite::Sprite;
using vsprite::Vec2;

namespace {

constexpr float kSmellRange = 380;  // tank px within which a flake is noticed
constexpr float kSameDepth = 0.3f;  // fish further apart in depth pass each other

int ticks_of(const Sprite& sprite, float seconds) {
  return static_cast<int>(seconds * static_cast<float>(sprite.fps()));
}

float distance(Vec2 a, Vec2 b) {
  const float x = a.x - b.x;
  const float y = a.y - b.y;
  return std::sqrt(x * x + y * y);
}

const Flake* find_flake(const World& world, std::uint32_t id) {
  for (const Flake& flake : world.flakes)
    if (flake.id == id) return &flake;
  return nullptr;
}

const Flake* nearest_flake(const World& world, Vec2 from) {
  const Flake* best = nullptr;
  float least = kSmellRange;
  for (const Flake& flake : world.flakes) {
    const float way = distance(flake.at, from);
    if (way < least) {
      least = way;
      best = &flake;
    }
  }
  return best;
}

/// Level ways are usual, steep ones rare, as for any fish in a tank.
Direction random_direction(Random& dice) {
  constexpr std::array<Direction, 14> kHabit{
      Direction::Right,   Direction::Right,    Direction::Right,  Direction::Right,
      Direction::Left,    Direction::Left,     Direction::Left,   Direction::Left,
      Direction::RightUp, Direction::LeftDown, Direction::LeftUp, Direction::RightDown,
      Direction::Up,      Direction::Down};
  return kHabit[static_cast<std::size_t>(dice.below(static_cast<int>(kHabit.size())))];
}

void make_plan(const Sprite& sprite, World& world, std::size_t index) {
  Fish& fish = world.fish[index];
  Random& dice = world.dice;
  const int roll = dice.below(100);
  const Flake* smelt = nearest_flake(world, place_of(fish));
  const int greed = index == 0 ? 0 : 45;  // the player's own fish never eats without the player
  if (smelt != nullptr && roll < greed) {
    fish.mind = {Mind::Wish::Feed, Direction::None, ticks_of(sprite, 4), smelt->id};
  } else if (roll < 72) {
    const int ticks = ticks_of(sprite, dice.between(1.2f, 4.0f));
    fish.mind = {Mind::Wish::Swim, random_direction(dice), ticks, 0};
  } else if (roll < 86) {
    const int ticks = ticks_of(sprite, dice.between(1.0f, 3.0f));
    fish.mind = {Mind::Wish::Glide, Direction::None, ticks, 0};
  } else {
    const int ticks = ticks_of(sprite, dice.between(1.5f, 4.0f));
    fish.mind = {Mind::Wish::Rest, Direction::Rest, ticks, 0};
  }
}

/// Away from the nearest fish of about the same depth that is too close, else None.
Direction keep_apart(const Sprite& sprite, const World& world, std::size_t index) {
  const Fish& self = world.fish[index];
  const Vec2 here = place_of(self);
  Direction away = Direction::None;
  float least = 1.0f;
  for (std::size_t k = 0; k < world.fish.size(); ++k) {
    const Fish& other = world.fish[k];
    if (k == index || std::abs(other.depth - self.depth) > kSameDepth) continue;
    const Vec2 there = place_of(other);
    const float berth = 0.45f * sprite.data().body_length * (self.scale + other.scale);
    const float nearness = distance(here, there) / berth;
    if (nearness >= least) continue;
    least = nearness;
    away = vsprite::nearest_direction({here.x - there.x, 1.5f * (here.y - there.y)});
  }
  return away;
}

}  // namespace

Direction think(const Sprite& sprite, World& world, std::size_t index) {
  Fish& fish = world.fish[index];
  Mind& mind = fish.mind;
  if (mind.ticks_left-- <= 0) make_plan(sprite, world, index);

  const bool steady = mind.wish == Mind::Wish::Swim && mind.ticks_left > 0;
  const Direction away = keep_apart(sprite, world, index);
  if (away != Direction::None && !(steady && mind.direction == away)) {
    mind = {Mind::Wish::Swim, away, ticks_of(sprite, 0.8f), 0};
  }
  if (mind.wish != Mind::Wish::Feed) return mind.direction;

  const Flake* flake = find_flake(world, mind.flake);
  if (flake == nullptr) {
    mind.ticks_left = 0;
    return Direction::None;
  }
  const Vec2 mouth = mouth_of(sprite, fish);
  return vsprite::nearest_direction({flake->at.x - mouth.x, flake->at.y - mouth.y});
}

}  // namespace aquarium
