// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// An arm as links see it: outlines of the upper arm and the forearm, both round the elbow, so that
// they overlap there at every angle. The muscle swells as the elbow bends, which no turning does.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "puppet/art.h"
#include "puppet/brush.h"

namespace vsprite::puppet_art {
namespace {

constexpr float kUpper = 120, kFore = 112;
constexpr int kOutline = 18;  // control points of a link's outline; then its two joints

// Round the bone from `pivot` along +x: half width at each place, caps at both ends.
Path outline(float length, float start, float end, float swell, float under) {
  Path out;
  const auto half = [&](float x, float bulge) {
    const float t = std::clamp(x / length, 0.0f, 1.0f);
    return start + t * (end - start) + bulge * std::exp(-(t - 0.48f) * (t - 0.48f) / 0.05f);
  };
  for (int k = 0; k < 6; ++k) {
    const float x = length * static_cast<float>(k) / 5;
    out.push_back({x, -half(x, swell)});
  }
  for (int k = 1; k <= 3; ++k) {
    const float a = std::numbers::pi_v<float> * (static_cast<float>(k) / 4 - 0.5f);
    out.push_back({length + end * std::cos(a), end * std::sin(a)});
  }
  for (int k = 5; k >= 0; --k) {
    const float x = length * static_cast<float>(k) / 5;
    out.push_back({x, half(x, under)});
  }
  for (int k = 1; k <= 3; ++k) {
    const float a = std::numbers::pi_v<float> * (static_cast<float>(k) / 4 + 0.5f);
    out.push_back({start * std::cos(a), start * std::sin(a)});
  }
  return out;
}

Path placed(const Path& path, Vec2 pivot, double angle) {
  Path out;
  const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
  for (const Vec2 p : path)
    out.push_back({pivot.x + c * p.x - s * p.y, pivot.y + s * p.x + c * p.y});
  return out;
}

struct Shapes {
  Path upper, fore;
};
Shapes shapes(double elbow) {
  const auto bend = static_cast<float>(std::sin(std::clamp(-elbow / 2, 0.0, 1.3)));
  return {outline(kUpper, 31, 23, 4 + 17 * bend, 5 - 2 * bend),
          outline(kFore, 23, 15, 7 - 2 * bend, 5 + 3 * bend)};
}

// The mesh lies round what is painted, its round ends too.
Path grown(Path path, float length) {
  constexpr float kGrow = 1.12f;
  for (Vec2& p : path) {
    p.y *= kGrow;
    p.x += (kGrow - 1) * (p.x - std::clamp(p.x, 0.0f, length));
  }
  return path;
}

// Both links with their joints, at these pivots and angles.
Path points(const Shapes& s, Vec2 shoulder, double a, Vec2 elbow, double b) {
  Path out = placed(grown(s.upper, kUpper), shoulder, a);
  const auto end = placed({{0, 0}, {kUpper, 0}}, shoulder, a);
  out.insert(out.end(), end.begin(), end.end());
  const Path fore = placed(grown(s.fore, kFore), elbow, b);
  out.insert(out.end(), fore.begin(), fore.end());
  const auto tip = placed({{0, 0}, {kFore, 0}, {kFore + 46, -24}, {kFore + 46, 24}}, elbow, b);
  out.insert(out.end(), tip.begin(), tip.end());
  return out;
}

void paint_link(Canvas& c, const Path& knots, Vec2 pivot, float length, bool sleeve, float bend) {
  const Path shape = smooth(knots);
  c.fill(shape, fade(0xf6caa2, 0xcf8d62, {pivot.x, pivot.y - 30}, {pivot.x, pivot.y + 34}));
  c.shade(shape, glow(0xffffff, {pivot.x + length * 0.5f, pivot.y - 20 - 8 * bend}, 46,
                      0.25f + 0.2f * bend));
  c.shade(shape, glow(0xb06a44, {pivot.x + length * 0.5f, pivot.y + 24}, 50, 0.35f));
  if (sleeve) {
    c.shade(smooth({{pivot.x - 40, pivot.y - 48},
                    {pivot.x + 34, pivot.y - 48},
                    {pivot.x + 42, pivot.y},
                    {pivot.x + 36, pivot.y + 48},
                    {pivot.x - 40, pivot.y + 48}}),
            fade(0x4f9a86, 0x2f6b60, {pivot.x, pivot.y - 34}, {pivot.x, pivot.y + 34}));
    c.shade(stroke(smooth_line({{pivot.x + 34, pivot.y - 46},
                                {pivot.x + 42, pivot.y},
                                {pivot.x + 36, pivot.y + 46}}),
                   5),
            flat(0x24544b));
  }
}

void paint_fist(Canvas& c, Vec2 wrist) {
  const Path fist = smooth({{wrist.x - 8, wrist.y - 14},
                            {wrist.x + 12, wrist.y - 21},
                            {wrist.x + 34, wrist.y - 17},
                            {wrist.x + 41, wrist.y + 2},
                            {wrist.x + 33, wrist.y + 19},
                            {wrist.x + 10, wrist.y + 20},
                            {wrist.x - 8, wrist.y + 14}});
  c.fill(fist, fade(0xf8d0aa, 0xcf8d62, {wrist.x, wrist.y - 20}, {wrist.x, wrist.y + 22}));
  for (int k = 0; k < 3; ++k)
    c.fill(stroke(smooth_line({{wrist.x + 22, wrist.y - 9 + 9 * static_cast<float>(k)},
                               {wrist.x + 32, wrist.y - 8 + 9 * static_cast<float>(k)},
                               {wrist.x + 39, wrist.y - 6 + 8 * static_cast<float>(k)}}),
                  2),
           flat(0x8a4f35));
  c.fill(stroke(smooth_line({{wrist.x + 4, wrist.y - 13},
                             {wrist.x + 18, wrist.y - 8},
                             {wrist.x + 24, wrist.y + 2}}),
                2),
         flat(0x8a4f35));
  c.outline(fist, 0x5a3227, 2.5f);
}

}  // namespace

View draw_arm(double shoulder, double elbow) {
  const Shapes s = shapes(elbow);
  View view;
  constexpr Vec2 kShoulder{300, 300};
  const auto c = static_cast<float>(std::cos(shoulder)), n = static_cast<float>(std::sin(shoulder));
  view.points = points(s, kShoulder, shoulder, {kShoulder.x + kUpper * c, kShoulder.y + kUpper * n},
                       shoulder + elbow);
  // The picture shows the links apart, both straight.
  constexpr Vec2 kUpperAt{60, 70}, kForeAt{60, 190};
  view.texture_points = points(s, kUpperAt, 0, kForeAt, 0);
  Canvas canvas(280, 260);
  const auto bend = static_cast<float>(std::sin(std::clamp(-elbow / 2, 0.0, 1.3)));
  paint_link(canvas, placed(s.upper, kUpperAt, 0), kUpperAt, kUpper, true, bend);
  paint_link(canvas, placed(s.fore, kForeAt, 0), kForeAt, kFore, false, bend * 0.4f);
  paint_fist(canvas, {kForeAt.x + kFore + 2, kForeAt.y});
  view.picture = canvas.picture();
  return view;
}

ViewSet arm_views() {
  ViewSet set;
  set.name = "arm";
  set.links = {{"upper", 0, kOutline + 2, -1, kOutline, kOutline + 1},
               {"forearm", kOutline + 2, kOutline + 4, 0, 2 * kOutline + 2, 2 * kOutline + 3}};
  set.depth.assign(kOutline + 2, 0);
  set.depth.insert(set.depth.end(), kOutline + 4, 1.0f);
  for (const double a : {-2.6, -0.6, 1.4})
    for (const double e : {0.0, -1.2, -2.3}) {
      set.views.push_back(draw_arm(a, e));
      set.views.back().name = "arm_" + std::to_string(set.views.size()) + ".png";
    }
  return set;
}

}  // namespace vsprite::puppet_art
