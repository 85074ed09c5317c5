// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// maze.h - corridors, and what may lie in them. No window, no drawing.
//
// The maze is that of assets/scripts/maze.txt with three shortcuts, in units of the sprite's size:
// a corridor is a line of kReach to either side, and the anchor stays in them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "vsprite/geometry.h"

namespace vsprite::maze {

inline constexpr float kBody = 144;  ///< px: of the sprite for which the maze is drawn
inline constexpr float kReach = 78;  ///< px: how far the anchor may leave a corridor's middle
inline constexpr float kWall = 118;  ///< px: where the wall begins
inline constexpr Vec2 kSize{2100, 900};

struct Corridor {
  Vec2 from, to;
};
inline constexpr std::array kScript{
    Vec2{150, 150},  Vec2{750, 150},  Vec2{750, 450},  Vec2{150, 450},  Vec2{150, 750},
    Vec2{1050, 750}, Vec2{1050, 150}, Vec2{1650, 150}, Vec2{1650, 450}, Vec2{1350, 450},
    Vec2{1350, 750}, Vec2{1950, 750}, Vec2{1950, 150}};

inline std::vector<Corridor> make_corridors() {
  std::vector<Corridor> out;
  for (std::size_t k = 1; k < kScript.size(); ++k) out.push_back({kScript[k - 1], kScript[k]});
  out.push_back({{1350, 150}, {1350, 450}});
  out.push_back({{450, 750}, {450, 600}});
  out.push_back({{1650, 750}, {1650, 600}});
  return out;
}

inline float distance(const Corridor& c, Vec2 p) {
  const float dx = c.to.x - c.from.x, dy = c.to.y - c.from.y;
  const float along = ((p.x - c.from.x) * dx + (p.y - c.from.y) * dy) / (dx * dx + dy * dy);
  const float t = std::clamp(along, 0.0f, 1.0f);
  return std::hypot(p.x - c.from.x - t * dx, p.y - c.from.y - t * dy);
}
inline bool is_free(std::span<const Corridor> corridors, Vec2 p) {
  return std::any_of(corridors.begin(), corridors.end(),
                     [p](const Corridor& c) { return distance(c, p) <= kReach; });
}
/// Where a step from `from` (free) to `to` ends: it slides along walls.
inline Vec2 slide(std::span<const Corridor> corridors, Vec2 from, Vec2 to) {
  if (is_free(corridors, to)) return to;
  if (is_free(corridors, {to.x, from.y})) return {to.x, from.y};
  if (is_free(corridors, {from.x, to.y})) return {from.x, to.y};
  return from;
}

/// Food: every 150 px of every corridor, but not where the player begins.
inline std::vector<Vec2> make_food(std::span<const Corridor> corridors) {
  std::vector<Vec2> out;
  for (const Corridor& c : corridors) {
    const float length = std::hypot(c.to.x - c.from.x, c.to.y - c.from.y);
    for (float at = 0; at <= length; at += 150) {
      const Vec2 p{c.from.x + (c.to.x - c.from.x) * at / length,
                   c.from.y + (c.to.y - c.from.y) * at / length};
      const bool is_new = std::none_of(
          out.begin(), out.end(), [p](Vec2 q) { return std::hypot(p.x - q.x, p.y - q.y) < 50; });
      if (is_new && std::hypot(p.x - kScript[0].x, p.y - kScript[0].y) > 50) out.push_back(p);
    }
  }
  return out;
}
/// Takes away what lies within reach of `mouth`; how much that was.
inline std::size_t eat(std::vector<Vec2>& food, Vec2 mouth) {
  return std::erase_if(
      food, [mouth](Vec2 p) { return std::hypot(p.x - mouth.x, p.y - mouth.y) < kReach; });
}

}  // namespace vsprite::maze
