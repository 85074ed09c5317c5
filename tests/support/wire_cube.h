// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// wire_cube.h - the memo's Appendix 2: views of a wire-frame cube, learned pixel by pixel and by
// control points.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "puppet/brush.h"
#include "synthesis/rbf_fit.h"
#include "vsprite/compose.h"

namespace vsprite::wire_cube {

inline constexpr int kSide = 96;

/// The eight corners for yaw and pitch (radians), px.
inline std::vector<Vec2> corners(double yaw, double pitch) {
  std::vector<Vec2> out;
  for (int k = 0; k < 8; ++k) {
    const double x = (k & 1) != 0 ? 1 : -1, y = (k & 2) != 0 ? 1 : -1, z = (k & 4) != 0 ? 1 : -1;
    const double xx = std::cos(yaw) * x + std::sin(yaw) * z,
                 zz = std::cos(yaw) * z - std::sin(yaw) * x;
    const double yy = std::cos(pitch) * y - std::sin(pitch) * zz,
                 depth = std::cos(pitch) * zz + std::sin(pitch) * y;
    const double scale = 110 / (5 + depth);
    out.push_back(
        {static_cast<float>(kSide / 2 + scale * xx), static_cast<float>(kSide / 2 + scale * yy)});
  }
  return out;
}

/// White lines on black, 0..1 a pixel.
inline std::vector<double> draw(const std::vector<Vec2>& at) {
  puppet_art::Canvas canvas(kSide, kSide);
  canvas.fill({{0, 0}, {kSide, 0}, {kSide, kSide}, {0, kSide}}, puppet_art::flat(0));
  for (int a = 0; a < 8; ++a)
    for (int bit = 1; bit < 8; bit *= 2)
      if ((a & bit) == 0)
        canvas.fill(
            puppet_art::stroke(
                {at[static_cast<std::size_t>(a)], at[static_cast<std::size_t>(a | bit)]}, 2.2f),
            puppet_art::flat(0xffffff));
  const Image picture = canvas.picture();
  std::vector<double> out;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) out.push_back(picture.rgba[i] / 255.0);
  return out;
}

/// 5 x 3 views, evenly spread; outputs are pixels, or the corners.
inline Examples examples(bool pixels) {
  Examples e{.dims = 2, .outputs = pixels ? kSide * kSide : 16, .x = {}, .y = {}};
  for (int y = 0; y < 5; ++y)
    for (int p = 0; p < 3; ++p) {
      const double yaw = 0.35 * y, pitch = 0.15 + 0.35 * p;
      e.x.insert(e.x.end(), {yaw, pitch});
      const auto at = corners(yaw, pitch);
      if (pixels) {
        const auto picture = draw(at);
        e.y.insert(e.y.end(), picture.begin(), picture.end());
      } else {
        for (const Vec2 c : at) e.y.insert(e.y.end(), {double{c.x}, double{c.y}});
      }
    }
  return e;
}

/// Half way between the examples.
inline std::vector<std::array<double, 2>> between() {
  std::vector<std::array<double, 2>> out;
  for (int y = 0; y < 4; ++y)
    for (int p = 0; p < 2; ++p) out.push_back({0.175 + 0.35 * y, 0.325 + 0.35 * p});
  return out;
}

inline std::vector<double> predicted(const RbfNetwork& net, std::array<double, 2> at) {
  std::vector<double> out(static_cast<std::size_t>(net.outputs));
  predict(net, at, out);
  return out;
}

inline std::vector<Vec2> to_corners(const std::vector<double>& numbers) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < numbers.size(); i += 2)
    out.push_back({static_cast<float>(numbers[i]), static_cast<float>(numbers[i + 1])});
  return out;
}

/// Light of a picture beside the truth's, and how alike they are (correlation; 1: the same).
struct Likeness {
  double light = 0, correlation = 0;
};
inline Likeness compare(const std::vector<double>& picture, const std::vector<double>& truth) {
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  const auto n = static_cast<double>(picture.size());
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const double p = std::min(1.0, std::max(0.0, picture[i])), t = truth[i];
    a += p, b += t, aa += p * p, bb += t * t, ab += p * t;
  }
  const double da = aa - a * a / n, db = bb - b * b / n;
  return {a / b, da > 0 ? (ab - a * b / n) / std::sqrt(da * db) : 0};
}

}  // namespace vsprite::wire_cube
