// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// What a window's input means, on every platform.
#include <algorithm>
#include <cmath>

#include "vsprite/window.h"

namespace vsprite {
namespace {

constexpr float kDeadZone = 0.25f;
constexpr float kRelease = 0.20f;  // a held stick may sink this far before it counts as let go
constexpr float kKeepCosine = 0.88701f;  // cos(22.5 + 5 degrees)

}  // namespace

Direction Input::direction() const noexcept {
  const Direction from_keys = keys.direction();
  return from_keys != Direction::None ? from_keys : stick;
}

bool Input::was_pressed(int key) const noexcept {
  return std::find(pressed.begin(), pressed.end(), key) != pressed.end();
}

Direction stick_direction(Vec2 stick, Direction before) noexcept {
  const float length = std::sqrt(stick.x * stick.x + stick.y * stick.y);
  const bool held = before != Direction::None && before != Direction::Rest;
  if (!(length >= (held ? kRelease : kDeadZone))) return Direction::None;
  if (held) {
    const Vec2 unit = unit_vector(before);
    if (stick.x * unit.x + stick.y * unit.y >= kKeepCosine * length) return before;
  }
  return nearest_direction(stick);
}

}  // namespace vsprite
