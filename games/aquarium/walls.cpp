// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The guard at the glass: plays copies of an actor forwards and refuses what would leave the tank.
#include "walls.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace aquarium {

using vsprite::Actor;
using vsprite::Direction;
using vsprite::Sprite;
using vsprite::Vec2;

namespace {

constexpr float kLookAheadSeconds = 2.0f;  // longer than any turn of a fish on film
constexpr float kAfterSeconds = 0.6f;      // where it would drift to once the look-ahead has ended
constexpr float kClearBodies = 1.0f;       // a replaced command returns this far from the glass

int ahead_ticks(const Sprite& sprite) {
  return static_cast<int>(kLookAheadSeconds * static_cast<float>(sprite.fps()));
}

/// Largest overhang while `command` is held for `ticks`; stops early above `enough`.
float worst_overhang(const Sprite& sprite, Actor actor, const Box& room, Direction command,
                     int ticks, float enough) {
  float worst = 0;
  vsprite::set_direction(sprite, actor, command);
  for (int t = 0; t < ticks && worst <= enough; ++t) {
    vsprite::step(sprite, actor);
    worst = std::max(worst, overhang(room, body_box(sprite, actor)));
  }
  const Vec2 v = sprite.samples()[actor.sample].velocity;
  Box drifted = body_box(sprite, actor);
  drifted.left += v.x * kAfterSeconds;
  drifted.right += v.x * kAfterSeconds;
  drifted.top += v.y * kAfterSeconds;
  drifted.bottom += v.y * kAfterSeconds;
  return std::max(worst, overhang(room, drifted));
}

/// The eight directions, those that lead to the middle of the room first.
std::array<Direction, vsprite::kCompassCount> escapes(const Box& room, const Actor& actor) {
  const Vec2 at = vsprite::to_pixels(actor.position);
  const Vec2 inward{(room.left + room.right) / 2 - at.x, (room.top + room.bottom) / 2 - at.y};
  std::array<Direction, vsprite::kCompassCount> order;
  std::array<float, vsprite::kCompassCount> gain;
  for (int d = 0; d < vsprite::kCompassCount; ++d) {
    order[static_cast<std::size_t>(d)] = static_cast<Direction>(d);
    const Vec2 u = vsprite::unit_vector(static_cast<Direction>(d));
    gain[static_cast<std::size_t>(d)] = u.x * inward.x + u.y * inward.y;
  }
  std::stable_sort(order.begin(), order.end(), [&](Direction a, Direction b) {
    return gain[static_cast<std::size_t>(a)] > gain[static_cast<std::size_t>(b)];
  });
  return order;
}

/// Does some escape exist after one tick of `command`?
bool is_safe(const Sprite& sprite, Actor actor, const Box& room, Direction command) {
  vsprite::set_direction(sprite, actor, command);
  vsprite::step(sprite, actor);
  if (overhang(room, body_box(sprite, actor)) > 0) return false;
  const int ticks = ahead_ticks(sprite);
  if (worst_overhang(sprite, actor, room, command, ticks, 0) <= 0) return true;
  for (const Direction d : escapes(room, actor))
    if (worst_overhang(sprite, actor, room, d, ticks, 0) <= 0) return true;
  return false;
}

float turned_away(Direction from, Direction to) {
  const int steps = std::abs(static_cast<int>(from) - static_cast<int>(to));
  return static_cast<float>(std::min(steps, vsprite::kCompassCount - steps));
}

/// Free way from the body to the glass along `d`, pixels.
float free_way(const Box& room, const Box& body, Direction d) {
  const Vec2 u = vsprite::unit_vector(d);
  float way = 1e9f;
  if (u.x > 0.1f) way = std::min(way, (room.right - body.right) / u.x);
  if (u.x < -0.1f) way = std::min(way, (room.left - body.left) / u.x);
  if (u.y > 0.1f) way = std::min(way, (room.bottom - body.bottom) / u.y);
  if (u.y < -0.1f) way = std::min(way, (room.top - body.top) / u.y);
  return way;
}

bool is_compass(Direction d) { return static_cast<int>(d) < vsprite::kCompassCount; }

/// The replacement for a refused command: nearest in angle, then roomiest.
Direction replacement(const Sprite& sprite, const Actor& actor, const Box& room, Direction wanted) {
  const Box body = body_box(sprite, actor);
  std::array<Direction, vsprite::kCompassCount> order = escapes(room, actor);
  if (is_compass(wanted)) {
    std::stable_sort(order.begin(), order.end(), [&](Direction a, Direction b) {
      const float turn_a = turned_away(wanted, a);
      const float turn_b = turned_away(wanted, b);
      if (turn_a != turn_b) return turn_a < turn_b;
      return free_way(room, body, a) > free_way(room, body, b);
    });
  }
  const int ticks = ahead_ticks(sprite);
  Direction best = order[0];
  float least = 1e9f;
  for (const Direction d : order) {
    const float worst = worst_overhang(sprite, actor, room, d, ticks, least);
    if (worst < least) {
      least = worst;
      best = d;
    }
    if (least <= 0) break;
  }
  return best;
}

/// Too far from every wall for any film to reach it within the look-ahead.
bool is_far_from_walls(const Sprite& sprite, const Box& room, const Box& body) {
  const float reach = 2.0f * sprite.data().body_length * (kLookAheadSeconds + kAfterSeconds);
  return body.left - room.left > reach && room.right - body.right > reach &&
         body.top - room.top > reach && room.bottom - body.bottom > reach;
}

}  // namespace

Box body_box(const Sprite& sprite, const Actor& actor) noexcept {
  const vsprite::Sample& s = sprite.samples()[actor.sample];
  const Vec2 at = vsprite::to_pixels(actor.position);
  return {at.x - s.anchor.x, at.y - s.anchor.y, at.x - s.anchor.x + static_cast<float>(s.width),
          at.y - s.anchor.y + static_cast<float>(s.height)};
}

float overhang(const Box& room, const Box& body) noexcept {
  return std::max({0.0f, room.left - body.left, body.right - room.right, room.top - body.top,
                   body.bottom - room.bottom});
}

Direction guarded_command(const Sprite& sprite, const Actor& actor, const Box& room,
                          Direction wanted, Guard& guard) noexcept {
  const Box body = body_box(sprite, actor);
  const bool same_wish = guard.active && guard.wanted == wanted;
  const bool clear = !is_compass(wanted) ||
                     free_way(room, body, wanted) > kClearBodies * sprite.data().body_length;
  if (same_wish && !clear && is_safe(sprite, actor, room, guard.given)) return guard.given;
  guard.active = 0;
  if (is_far_from_walls(sprite, room, body) || is_safe(sprite, actor, room, wanted)) return wanted;
  guard = {wanted, replacement(sprite, actor, room, wanted), 1};
  return guard.given;
}

}  // namespace aquarium
