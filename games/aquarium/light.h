// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// light.h - the water between the eye and a thing, and the view of the tank; as in common.frag.
#pragma once

#include <algorithm>
#include <cmath>

#include "vsprite/draw.h"
#include "world.h"

namespace aquarium {

/// Frame pixel = tank pixel * scale + offset. The whole tank is always visible; a window of another
/// shape shows more water on the sides, or above and below.
struct View {
  float scale = 1;
  vsprite::Vec2 offset;
};

inline View make_view(int width, int height) noexcept {
  View view;
  const float w = static_cast<float>(width);
  const float h = static_cast<float>(height);
  view.scale = std::max(0.01f, std::min(w / kTankWidth, h / kTankHeight));
  view.offset = {(w - kTankWidth * view.scale) / 2, (h - kTankHeight * view.scale) * 0.6f};
  return view;
}

/// The camera that lets the renderer be used in tank pixels, `zoom` tank pixels a unit.
inline vsprite::Camera camera_of(const View& view, float zoom = 1) noexcept {
  return {{0, 0}, view.scale * zoom, view.offset};
}

inline float smooth_step(float low, float high, float x) noexcept {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

inline vsprite::Color mix(vsprite::Color a, vsprite::Color b, float t) noexcept {
  return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t,
          a.a + (b.a - a.a) * t};
}

inline vsprite::Color scaled(vsprite::Color c, float s) noexcept {
  return {c.r * s, c.g * s, c.b * s, c.a};
}

/// The colour of open water at a place in the tank: water_at of common.frag.
inline vsprite::Color water_at(vsprite::Vec2 p) noexcept {
  const float h = std::clamp(p.y / kTankHeight, -0.3f, 1.3f);
  vsprite::Color c =
      mix({0.085f, 0.43f, 0.50f, 1}, {0.012f, 0.160f, 0.260f, 1}, smooth_step(-0.1f, 0.45f, h));
  c = mix(c, {0.004f, 0.052f, 0.092f, 1}, smooth_step(0.35f, 1.0f, h));
  const float middle = (p.x - 540) / 700;
  return scaled(c, 0.42f + 0.70f * std::exp(-middle * middle));
}

/// What is left of a colour behind `depth` of water: through_water of common.frag.
inline vsprite::Color through_water(vsprite::Color c, float depth, vsprite::Vec2 p) noexcept {
  const vsprite::Color w = water_at(p);
  const float r = std::exp(-2.6f * depth);
  const float g = std::exp(-1.15f * depth);
  const float b = std::exp(-depth);
  return {c.r * r + w.r * (1 - r), c.g * g + w.g * (1 - g), c.b * b + w.b * (1 - b), c.a};
}

/// Light from the moving surface at a place, about 0.7..1.4: brighter high up and under the lamp.
inline float shimmer(vsprite::Vec2 p, float time) noexcept {
  const float a = std::sin(p.x * 0.021f + 0.8f * time + 0.011f * p.y);
  const float b = std::sin(p.x * 0.034f - 1.1f * time + 0.019f * p.y + 2.0f);
  const float net = std::max(0.0f, a * b);
  return 1.04f - 0.30f * p.y / kTankHeight + 0.42f * net;
}

}  // namespace aquarium
