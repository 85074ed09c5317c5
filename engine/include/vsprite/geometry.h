// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/geometry.h - points, rectangles and the ten commands that a sprite understands.
//
// Pixels, x right, y down, origin top left; pixel (0,0) covers [0,1) x [0,1). Angles are radians,
// clockwise from +x. Positions that must stay exact for ever are fixed point (`Position`).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace vsprite {

/// A point or displacement, pixels.
struct Vec2 {
  float x = 0;
  float y = 0;
  friend bool operator==(const Vec2&, const Vec2&) = default;
};

/// Whole pixels; covers [x, x + width) x [y, y + height).
struct Rect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  friend bool operator==(const Rect&, const Rect&) = default;
};

/// 1 pixel = 65,536 units: exact under addition, the same on every machine.
inline constexpr std::int64_t kFixedOne = 65536;

/// A position that does not drift: 1/65536 px.
struct Position {
  std::int64_t x = 0;
  std::int64_t y = 0;
  friend bool operator==(const Position&, const Position&) = default;
};

/// Fixed point to pixels (rounds to float).
inline Vec2 to_pixels(Position p) noexcept {
  return {static_cast<float>(static_cast<double>(p.x) / kFixedOne),
          static_cast<float>(static_cast<double>(p.y) / kFixedOne)};
}

/// Pixels to fixed point, rounded to nearest; NaN counts as 0, and beyond 2^46 px as 2^46.
Position to_position(Vec2 pixels) noexcept;

/// What a sprite is told to do: one of eight compass directions (clockwise from right), to carry on
/// by itself, or to come to rest. The numbers stand in packs and replays and never change.
enum class Direction : std::uint8_t {
  Right,
  RightDown,
  Down,
  LeftDown,
  Left,
  LeftUp,
  Up,
  RightUp,
  None,
  Rest
};
inline constexpr int kCompassCount = 8;     ///< the first eight
inline constexpr int kDirectionCount = 10;  ///< with None and Rest

/// "right", "right+down", ... "right+up", "none", "rest".
std::string_view direction_name(Direction direction) noexcept;

/// The inverse; order does not matter in a pair ("down+right"), opposites cancel. Empty: no such
/// name.
std::optional<Direction> parse_direction(std::string_view name) noexcept;

/// The unit vector of a compass direction; (0, 0) for None and Rest.
Vec2 unit_vector(Direction direction) noexcept;

/// The unit vector of heading h = 0..31, clockwise from right in steps of 11.25 degrees, in 2^-30:
/// whole numbers, so that what is computed with them is the same everywhere.
struct UnitVector {
  std::int32_t x = 0;
  std::int32_t y = 0;
};
UnitVector heading_vector(std::uint32_t h) noexcept;

/// From held keys: x and y are -1, 0 or 1; (0, 0) is None.
Direction direction_from_axes(int x, int y) noexcept;

/// The compass direction whose 45 degree sector holds (x, y); None for (0, 0). Any finite length.
Direction nearest_direction(Vec2 toward) noexcept;

}  // namespace vsprite
