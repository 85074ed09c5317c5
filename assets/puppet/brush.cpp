// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "puppet/brush.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vsprite::puppet_art {
namespace {

constexpr int kRows = 5;  // scan lines a pixel

Vec2 spline(Vec2 a, Vec2 b, Vec2 c, Vec2 d, float t) {
  const auto mix = [t](float p, float q, float r, float s) {
    return 0.5f * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t * t +
                   (3 * q - p - 3 * r + s) * t * t * t);
  };
  return {mix(a.x, b.x, c.x, d.x), mix(a.y, b.y, c.y, d.y)};
}

float channel(std::uint32_t rgb, int shift) {
  return static_cast<float>(rgb >> shift & 255u) / 255;
}

}  // namespace

Path smooth(const Path& knots, int steps) {
  Path out;
  const std::size_t n = knots.size();
  for (std::size_t i = 0; i < n; ++i)
    for (int k = 0; k < steps; ++k)
      out.push_back(spline(knots[(i + n - 1) % n], knots[i], knots[(i + 1) % n], knots[(i + 2) % n],
                           static_cast<float>(k) / static_cast<float>(steps)));
  return out;
}

Path smooth_line(const Path& knots, int steps) {
  Path out;
  const std::size_t n = knots.size();
  for (std::size_t i = 0; i + 1 < n; ++i)
    for (int k = 0; k < steps; ++k)
      out.push_back(spline(knots[i == 0 ? 0 : i - 1], knots[i], knots[i + 1],
                           knots[std::min(i + 2, n - 1)],
                           static_cast<float>(k) / static_cast<float>(steps)));
  out.push_back(knots.back());
  return out;
}

Path ellipse(Vec2 center, float rx, float ry, float angle) {
  Path out;
  for (int k = 0; k < 48; ++k) {
    const float a = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / 48;
    const float x = rx * std::cos(a), y = ry * std::sin(a);
    out.push_back({center.x + x * std::cos(angle) - y * std::sin(angle),
                   center.y + x * std::sin(angle) + y * std::cos(angle)});
  }
  return out;
}

Path stroke(const Path& line, float width, float width_end) {
  if (width_end < 0) width_end = width;
  Path left, right;
  const std::size_t n = line.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = line[i == 0 ? 0 : i - 1], b = line[std::min(i + 1, n - 1)];
    const float length = std::max(std::hypot(b.x - a.x, b.y - a.y), 1e-6f);
    const float part = static_cast<float>(i) / static_cast<float>(n - 1);
    const float half = 0.5f * (width + part * (width_end - width)) / length;
    const Vec2 side{(b.y - a.y) * half, -(b.x - a.x) * half};
    left.push_back({line[i].x + side.x, line[i].y + side.y});
    right.push_back({line[i].x - side.x, line[i].y - side.y});
  }
  const auto cap = [](Path& path, Vec2 center, Vec2 from) {  // half a turn to the other side
    const float x = from.x - center.x, y = from.y - center.y;
    for (int k = 1; k < 8; ++k) {
      const float a = std::numbers::pi_v<float> * static_cast<float>(k) / 8;
      path.push_back({center.x + x * std::cos(a) - y * std::sin(a),
                      center.y + x * std::sin(a) + y * std::cos(a)});
    }
  };
  Path out = left;
  cap(out, line.back(), left.back());
  out.insert(out.end(), right.rbegin(), right.rend());
  cap(out, line.front(), right.front());
  return out;
}

Paint flat(std::uint32_t rgb, float alpha) { return {.from = rgb, .to = rgb, .alpha = alpha}; }
Paint fade(std::uint32_t from, std::uint32_t to, Vec2 start, Vec2 end) {
  return {.from = from, .to = to, .start = start, .end = end};
}
Paint glow(std::uint32_t rgb, Vec2 center, float radius, float alpha) {
  return {
      .from = rgb, .to = rgb, .start = center, .radius = radius, .alpha = alpha, .alpha_end = 0};
}

Canvas::Canvas(int width, int height)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4, 0.0f) {}

void Canvas::fill(const Path& path, const Paint& paint) { blend(path, paint, false); }
void Canvas::shade(const Path& path, const Paint& paint) { blend(path, paint, true); }
void Canvas::outline(const Path& path, std::uint32_t rgb, float width) {
  Path closed = path;
  closed.push_back(path.front());
  const std::size_t piece = 8;  // short strokes: a whole loop would cross itself
  for (std::size_t i = 0; i + 1 < closed.size(); i += piece) {
    const auto end = std::min(i + piece + 1, closed.size());
    blend(stroke({closed.begin() + static_cast<std::ptrdiff_t>(i),
                  closed.begin() + static_cast<std::ptrdiff_t>(end)},
                 width),
          flat(rgb), false);
  }
}

// Non-zero winding; exact coverage along x on kRows lines a pixel.
void Canvas::blend(const Path& path, const Paint& paint, bool atop) {
  std::vector<float> cover(static_cast<std::size_t>(width_));
  struct Hit {
    float x;
    int turn;
  };
  std::vector<Hit> hits;
  const float dx = paint.end.x - paint.start.x, dy = paint.end.y - paint.start.y;
  const float length = std::max(dx * dx + dy * dy, 1e-6f);
  for (int y = 0; y < height_; ++y) {
    std::fill(cover.begin(), cover.end(), 0.0f);
    bool any = false;
    for (int r = 0; r < kRows; ++r) {
      const float at = static_cast<float>(y) + (static_cast<float>(r) + 0.5f) / kRows;
      hits.clear();
      for (std::size_t i = 0; i < path.size(); ++i) {
        const Vec2 a = path[i], b = path[(i + 1) % path.size()];
        if ((a.y <= at) == (b.y <= at)) continue;
        hits.push_back({a.x + (at - a.y) / (b.y - a.y) * (b.x - a.x), b.y > a.y ? 1 : -1});
      }
      std::sort(hits.begin(), hits.end(), [](const Hit& p, const Hit& q) { return p.x < q.x; });
      int winding = 0;
      for (std::size_t h = 0; h + 1 < hits.size(); ++h) {
        winding += hits[h].turn;
        if (winding == 0) continue;
        const float from = std::max(hits[h].x, 0.0f),
                    to = std::min(hits[h + 1].x, static_cast<float>(width_));
        for (int x = static_cast<int>(from); x < width_ && static_cast<float>(x) < to; ++x) {
          const float share =
              std::min(to, static_cast<float>(x + 1)) - std::max(from, static_cast<float>(x));
          if (share > 0) cover[static_cast<std::size_t>(x)] += share / kRows, any = true;
        }
      }
    }
    if (!any) continue;
    for (int x = 0; x < width_; ++x) {
      float c = std::min(cover[static_cast<std::size_t>(x)], 1.0f);
      if (c <= 0) continue;
      const float px = static_cast<float>(x) + 0.5f - paint.start.x,
                  py = static_cast<float>(y) + 0.5f - paint.start.y;
      float t = paint.radius > 0 ? std::hypot(px, py) / paint.radius : (px * dx + py * dy) / length;
      t = std::clamp(t, 0.0f, 1.0f);
      if (paint.radius > 0) t = t * t * (3 - 2 * t);
      const float last = paint.alpha_end < 0 ? paint.alpha : paint.alpha_end;
      float* out = &pixels_[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                 static_cast<std::size_t>(x))];
      const float a = c * (paint.alpha + t * (last - paint.alpha));
      const float by = atop ? a * out[3] : a;
      for (int k = 0; k < 3; ++k) {
        const float value = channel(paint.from, 16 - 8 * k) +
                            t * (channel(paint.to, 16 - 8 * k) - channel(paint.from, 16 - 8 * k));
        out[k] = value * by + (1 - a) * out[k];
      }
      out[3] = by + (1 - a) * out[3];
    }
  }
}

Image Canvas::picture() const {
  Image out{width_, height_, std::vector<std::uint8_t>(pixels_.size())};
  for (std::size_t i = 0; i < pixels_.size(); i += 4) {
    const float a = pixels_[i + 3];
    for (std::size_t c = 0; c < 3; ++c)
      out.rgba[i + c] = static_cast<std::uint8_t>(
          a > 0 ? std::clamp(pixels_[i + c] / a, 0.0f, 1.0f) * 255 + 0.5f : 0);
    out.rgba[i + 3] = static_cast<std::uint8_t>(std::min(a, 1.0f) * 255 + 0.5f);
  }
  return out;
}

}  // namespace vsprite::puppet_art
