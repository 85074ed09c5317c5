// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Names, unit vectors and sectors of the ten commands.
#include "vsprite/geometry.h"

#include <array>
#include <cmath>

#include "text.h"

namespace vsprite {
namespace {

constexpr std::array<std::string_view, kDirectionCount> kNames{
    "right",   "right+down", "down",     "left+down", "left",
    "left+up", "up",         "right+up", "none",      "rest"};

using detail::trim;

// Far beyond any game, and far from the end of int64 in 1/65536 px.
constexpr double kFarthest = 140737488355328.0 / 2;  // 2^46 px

std::int64_t to_fixed(float pixels) noexcept {
  if (!(std::fabs(pixels) < kFarthest)) {
    if (std::isnan(pixels)) return 0;
    return static_cast<std::int64_t>(pixels < 0 ? -kFarthest : kFarthest) * kFixedOne;
  }
  return static_cast<std::int64_t>(std::floor(static_cast<double>(pixels) * kFixedOne + 0.5));
}

}  // namespace

Position to_position(Vec2 pixels) noexcept { return {to_fixed(pixels.x), to_fixed(pixels.y)}; }

std::string_view direction_name(Direction direction) noexcept {
  return kNames[static_cast<std::size_t>(direction)];
}

std::optional<Direction> parse_direction(std::string_view name) noexcept {
  name = trim(name);
  if (name == "none") return Direction::None;
  if (name == "rest") return Direction::Rest;
  bool left = false, right = false, up = false, down = false;
  for (;;) {
    const std::size_t plus = name.find('+');
    const std::string_view part = trim(name.substr(0, plus));
    if (part == "left") {
      left = true;
    } else if (part == "right") {
      right = true;
    } else if (part == "up") {
      up = true;
    } else if (part == "down") {
      down = true;
    } else {
      return std::nullopt;
    }
    if (plus == std::string_view::npos) break;
    name.remove_prefix(plus + 1);
  }
  return direction_from_axes(int{right} - int{left}, int{down} - int{up});
}

Vec2 unit_vector(Direction direction) noexcept {
  constexpr float h = 0.70710678f;
  constexpr std::array<Vec2, kDirectionCount> kUnits{
      {{1, 0}, {h, h}, {0, 1}, {-h, h}, {-1, 0}, {-h, -h}, {0, -1}, {h, -h}, {0, 0}, {0, 0}}};
  return kUnits[static_cast<std::size_t>(direction)];
}

UnitVector heading_vector(std::uint32_t h) noexcept {
  // cos(h pi / 16) and sin(h pi / 16), times 2^30, rounded.
  static constexpr UnitVector kVectors[32] = {
      {1073741824, 0},          {1053110176, 209476638},  {992008094, 410903207},
      {892783698, 596538995},   {759250125, 759250125},   {596538995, 892783698},
      {410903207, 992008094},   {209476638, 1053110176},  {0, 1073741824},
      {-209476638, 1053110176}, {-410903207, 992008094},  {-596538995, 892783698},
      {-759250125, 759250125},  {-892783698, 596538995},  {-992008094, 410903207},
      {-1053110176, 209476638}, {-1073741824, 0},         {-1053110176, -209476638},
      {-992008094, -410903207}, {-892783698, -596538995}, {-759250125, -759250125},
      {-596538995, -892783698}, {-410903207, -992008094}, {-209476638, -1053110176},
      {0, -1073741824},         {209476638, -1053110176}, {410903207, -992008094},
      {596538995, -892783698},  {759250125, -759250125},  {892783698, -596538995},
      {992008094, -410903207},  {1053110176, -209476638}};
  return kVectors[h % 32];
}

Direction direction_from_axes(int x, int y) noexcept {
  constexpr std::array<Direction, 9> kGrid{
      Direction::LeftUp,   Direction::Up,   Direction::RightUp,
      Direction::Left,     Direction::None, Direction::Right,
      Direction::LeftDown, Direction::Down, Direction::RightDown};
  const int column = (x > 0) - (x < 0);
  const int row = (y > 0) - (y < 0);
  return kGrid[static_cast<std::size_t>(3 * (row + 1) + column + 1)];
}

Direction nearest_direction(Vec2 toward) noexcept {
  constexpr float kTanHalfSector = 0.41421356f;  // tan(22.5 degrees)
  const float ax = std::fabs(toward.x);
  const float ay = std::fabs(toward.y);
  const int x = ax > ay * kTanHalfSector ? (toward.x > 0 ? 1 : -1) : 0;
  const int y = ay > ax * kTanHalfSector ? (toward.y > 0 ? 1 : -1) : 0;
  return direction_from_axes(x, y);
}

}  // namespace vsprite
