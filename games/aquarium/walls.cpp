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

constexpr float kLongestLookAhead = 2.0f;  // seconds; for films of fish that never turn
constexpr std::size_t kInwards = 3;        // directions that lead to the middle
constexpr float kClearBodies = 1.0f;       // a replaced command returns this far from the glass

/// Sum over `ticks` of `command` of how far the body stands out, pixels; stops once above `enough`.
float total_overhang(const Sprite& sprite, Actor actor, const Box& room, Direction command,
                     int ticks, float enough) {
  float sum = 0;
  vsprite::set_direction(sprite, actor, command);
  for (int t = 0; t < ticks && sum <= enough; ++t) {
    vsprite::step(sprite, actor);
    sum += overhang(room, body_box(sprite, actor));
  }
  return sum;
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

/// Does some escape exist after one tick of `command`? Only what leads inwards is an escape: to
/// stay inside for a while is not enough if the fish ends up nose to the glass.
bool is_safe(const Sprite& sprite, Actor actor, const Box& room, Direction command, int ticks) {
  vsprite::set_direction(sprite, actor, command);
  vsprite::step(sprite, actor);
  if (overhang(room, body_box(sprite, actor)) > 0) return false;
  const std::array<Direction, vsprite::kCompassCount> order = escapes(room, actor);
  for (std::size_t k = 0; k < kInwards; ++k)
    if (total_overhang(sprite, actor, room, order[k], ticks, 0) <= 0) return true;
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
Direction replacement(const Sprite& sprite, const Actor& actor, const Box& room, Direction wanted,
                      int ticks) {
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
  for (const Direction d : order)
    if (is_safe(sprite, actor, room, d, ticks)) return d;
  Direction best = order[0];
  float least = 1e30f;
  for (const Direction d : order) {
    const float sum = total_overhang(sprite, actor, room, d, 2 * ticks, least);
    if (sum >= least) continue;
    least = sum;
    best = d;
  }
  return best;
}

/// Ticks until an actor that swims towards `from` has begun to swim towards `to`.
int ticks_to_turn(const Sprite& sprite, Actor actor, Direction from, Direction to, int most) {
  vsprite::set_direction(sprite, actor, from);
  for (int t = 0; t < most; ++t) vsprite::step(sprite, actor);
  vsprite::set_direction(sprite, actor, to);
  const Vec2 u = vsprite::unit_vector(to);
  const float brisk = 0.25f * sprite.data().body_length;  // px/s
  for (int t = 0; t < most; ++t) {
    vsprite::step(sprite, actor);
    const Vec2 v = sprite.samples()[actor.sample].velocity;
    if (v.x * u.x + v.y * u.y > brisk) return t;
  }
  return most;
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

int measure_look_ahead(const Sprite& sprite) noexcept {
  const int most = static_cast<int>(kLongestLookAhead * static_cast<float>(sprite.fps()));
  int longest = 0;
  for (int from = 0; from < vsprite::kCompassCount; ++from) {
    Actor actor = vsprite::make_actor(sprite);
    for (int start = 0; start < 16; ++start) {
      for (int t = 0; t < 7; ++t) vsprite::step(sprite, actor);
      for (const int turn : {3, 4, 5}) {
        const int to = (from + turn) % vsprite::kCompassCount;
        longest = std::max(longest, ticks_to_turn(sprite, actor, static_cast<Direction>(from),
                                                  static_cast<Direction>(to), most));
      }
    }
  }
  return std::min(longest + longest / 4 + 4, most);
}

Direction guarded_command(const Sprite& sprite, const Actor& actor, const Box& glass,
                          Direction wanted, int look_ahead, Guard& guard) noexcept {
  const float soft = kSoftGlass * sprite.data().body_length;
  const Box room{glass.left - soft, glass.top - soft, glass.right + soft, glass.bottom + soft};
  const Box body = body_box(sprite, actor);
  const bool same_wish = guard.active && guard.wanted == wanted;
  const bool clear = !is_compass(wanted) ||
                     free_way(room, body, wanted) > kClearBodies * sprite.data().body_length;
  if (same_wish && !clear && is_safe(sprite, actor, room, guard.given, look_ahead))
    return guard.given;
  guard.active = 0;
  if (is_safe(sprite, actor, room, wanted, look_ahead)) return wanted;
  guard = {wanted, replacement(sprite, actor, room, wanted, look_ahead), 1};
  return guard.given;
}

}  // namespace aquarium
