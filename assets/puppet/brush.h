// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// brush.h - paints smooth shapes, antialiased, into a picture with alpha.
#pragma once

#include <cstdint>
#include <vector>

#include "vsprite/geometry.h"
#include "vsprite/image.h"

namespace vsprite::puppet_art {

using Path = std::vector<Vec2>;  ///< a closed outline

/// Through the knots, round the corner (Catmull-Rom).
Path smooth(const Path& knots, int steps = 10);
/// The same, open.
Path smooth_line(const Path& knots, int steps = 10);
Path ellipse(Vec2 center, float rx, float ry, float angle = 0);
/// The outline of a line of this width with round ends; `width_end` at its other end.
Path stroke(const Path& line, float width, float width_end = -1);

/// sRGB 0xrrggbb to another along a line; with `radius` from a centre outwards.
struct Paint {
  std::uint32_t from = 0, to = 0;
  Vec2 start{}, end{};
  float radius = 0;                 ///< > 0: from `start` outwards to here
  float alpha = 1, alpha_end = -1;  ///< -1: as alpha
};
Paint flat(std::uint32_t rgb, float alpha = 1);
Paint fade(std::uint32_t from, std::uint32_t to, Vec2 start, Vec2 end);
Paint glow(std::uint32_t rgb, Vec2 center, float radius, float alpha);

class Canvas {
 public:
  Canvas(int width, int height);
  void fill(const Path& path, const Paint& paint);
  /// Only where something was painted before: shade inside a shape.
  void shade(const Path& path, const Paint& paint);
  /// Along the outline, centred on it.
  void outline(const Path& path, std::uint32_t rgb, float width);
  Image picture() const;  ///< straight alpha

 private:
  void blend(const Path& path, const Paint& paint, bool atop);
  int width_, height_;
  std::vector<float> pixels_;  // premultiplied, encoded
};

}  // namespace vsprite::puppet_art
