// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Textured meshes, mapped backwards: a pixel's centre is found in exactly one face along a shared
// edge (corners on a grid of 1/256 px, whole-number edge functions, the top-left rule), then looked
// up in the views. A quad is covered as two triangles and textured by the inverse of the bilinear
// map, which is straight along its edges, so that neighbours of either kind meet without a crack.
//
// Faces go from far to near and mix by coverage; a nearer opaque pixel hides what comes later.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "vsprite/puppet.h"

namespace vsprite {
namespace {

struct Grid {
  std::int64_t x = 0, y = 0;  // 1/256 px
};

struct Corner {
  Grid at;
  double x = 0, y = 0;  // the same in px
  float depth = 0;
  std::uint32_t point = 0;
};

std::int64_t cross(Grid a, Grid b, Grid p) noexcept {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// Clockwise on the screen: an edge belongs to its face if it is a top or a left one.
bool owns_edge(Grid a, Grid b) noexcept { return a.y == b.y ? b.x > a.x : b.y < a.y; }

using Light = std::array<float, 4>;

// Bilinear, of linear premultiplied light; nothing beyond the border.
void add_sample(const PuppetView& view, double u, double v, float share, Light& sum) noexcept {
  u -= 0.5, v -= 0.5;
  const double fu = std::floor(u), fv = std::floor(v);
  if (!(fu >= -1 && fv >= -1 && fu < view.picture.width && fv < view.picture.height)) return;
  const int x = static_cast<int>(fu), y = static_cast<int>(fv);
  const float a = static_cast<float>(u - fu), b = static_cast<float>(v - fv);
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      if (x + dx < 0 || y + dy < 0 || x + dx >= view.picture.width || y + dy >= view.picture.height)
        continue;
      const float w = share * (dx ? a : 1 - a) * (dy ? b : 1 - b);
      const float* texel = &view.light[4 * (static_cast<std::size_t>(y + dy) *
                                                static_cast<std::size_t>(view.picture.width) +
                                            static_cast<std::size_t>(x + dx))];
      for (std::size_t c = 0; c < 4; ++c) sum[c] += w * texel[c];
    }
  }
}

// Weights of a face's corners at a point of the canvas.
using Weights = std::array<double, 4>;

Weights affine_weights(const Corner& a, const Corner& b, const Corner& c, double x,
                       double y) noexcept {
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  const double wb = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
  const double wc = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
  return {1 - wb - wc, wb, wc, 0};
}

// The (s, t) in [0, 1]^2 with p = (1-s)(1-t) A + s (1-t) B + s t C + (1-s) t D: a quadratic in t.
bool bilinear_weights(const std::array<Corner, 4>& q, double x, double y, Weights& out) noexcept {
  const double ex = q[1].x - q[0].x, ey = q[1].y - q[0].y;
  const double fx = q[3].x - q[0].x, fy = q[3].y - q[0].y;
  const double gx = q[0].x - q[1].x + q[2].x - q[3].x, gy = q[0].y - q[1].y + q[2].y - q[3].y;
  const double hx = x - q[0].x, hy = y - q[0].y;
  const double k2 = gx * fy - gy * fx, k1 = ex * fy - ey * fx + hx * gy - hy * gx,
               k0 = hx * ey - hy * ex;
  const auto try_t = [&](double t) {
    const double dx = ex + gx * t, dy = ey + gy * t;
    const double s = std::abs(dx) > std::abs(dy) ? (hx - fx * t) / dx : (hy - fy * t) / dy;
    constexpr double kSlack = 1e-3;
    if (!(t >= -kSlack && t <= 1 + kSlack && s >= -kSlack && s <= 1 + kSlack)) return false;
    out = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
    return true;
  };
  if (std::abs(k2) < 1e-9 * std::abs(k1)) return try_t(-k0 / k1);
  const double square = k1 * k1 - 4 * k0 * k2;
  if (square < 0) return false;
  // The stable pair of roots.
  const double r = -0.5 * (k1 + (k1 < 0 ? -std::sqrt(square) : std::sqrt(square)));
  return (r != 0 && try_t(k0 / r)) || try_t(r / k2);
}

struct Canvas {
  int width = 0, height = 0;
  float* light = nullptr;
  float* depth = nullptr;
};

class FacePainter {
 public:
  FacePainter(const Puppet& puppet, const PuppetPose& pose, Canvas canvas, Vec2 center, float scale)
      : puppet_(puppet), pose_(pose), canvas_(canvas), center_(center), scale_(scale) {}

  void paint(const Face& face) noexcept {
    for (std::uint32_t c = 0; c < face.count; ++c) quad_[c] = corner(face.corners[c]);
    count_ = face.count;
    if (count_ == 3) return cover(0, 1, 2);
    // Of the two diagonals the one that splits the quad into two of its own turn.
    const auto turn = [&](int a, int b, int c) {
      return cross(quad_[std::size_t(a)].at, quad_[std::size_t(b)].at, quad_[std::size_t(c)].at) >
             0;
    };
    is_convex_ = turn(0, 1, 2) == turn(2, 3, 0) && turn(0, 1, 3) == turn(1, 2, 3) &&
                 turn(0, 1, 2) == turn(0, 1, 3);
    if (turn(0, 1, 2) == turn(2, 3, 0)) {
      cover(0, 1, 2);
      cover(0, 2, 3);
    } else {
      cover(0, 1, 3);
      cover(1, 2, 3);
    }
  }

 private:
  Corner corner(std::uint32_t point) const noexcept {
    Corner out;
    constexpr float kFar = 1 << 20;
    const Vec2 p = pose_.points[point];
    out.at.x = std::llround(std::clamp(center_.x + scale_ * p.x, -kFar, kFar) * 256);
    out.at.y = std::llround(std::clamp(center_.y + scale_ * p.y, -kFar, kFar) * 256);
    out.x = static_cast<double>(out.at.x) / 256;
    out.y = static_cast<double>(out.at.y) / 256;
    out.depth = pose_.depth[point];
    out.point = point;
    return out;
  }

  void cover(std::size_t i, std::size_t j, std::size_t k) noexcept {
    Grid a = quad_[i].at, b = quad_[j].at, c = quad_[k].at;
    const std::int64_t area = cross(a, b, c);
    if (area == 0) return;
    if (area < 0) std::swap(b, c);
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
    const int x0 = std::max(0, static_cast<int>(left >> 8)),
              x1 = std::min(canvas_.width - 1, static_cast<int>(right >> 8));
    const int y0 = std::max(0, static_cast<int>(top >> 8)),
              y1 = std::min(canvas_.height - 1, static_cast<int>(bottom >> 8));
    const std::int64_t ab = owns_edge(a, b) ? 0 : 1, bc = owns_edge(b, c) ? 0 : 1,
                       ca = owns_edge(c, a) ? 0 : 1;
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const Grid p{256 * std::int64_t{x} + 128, 256 * std::int64_t{y} + 128};
        if (cross(a, b, p) < ab || cross(b, c, p) < bc || cross(c, a, p) < ca) continue;
        Weights w{};
        const double px = x + 0.5, py = y + 0.5;
        if (count_ == 3 || !is_convex_ || !bilinear_weights(quad_, px, py, w)) {
          const Weights t = affine_weights(quad_[i], quad_[j], quad_[k], px, py);
          w = {};
          w[i] = t[0], w[j] = t[1], w[k] = t[2];
        }
        shade(x, y, w);
      }
    }
  }

  void shade(int x, int y, const Weights& w) noexcept {
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(canvas_.width) +
                           static_cast<std::size_t>(x);
    float depth = 0;
    for (std::size_t c = 0; c < count_; ++c) depth += static_cast<float>(w[c]) * quad_[c].depth;
    if (depth < canvas_.depth[at] - 1e-4f) return;
    Light sum{};
    for (std::size_t v = 0; v < puppet_.views.size(); ++v) {
      if (pose_.shares[v] <= 0) continue;
      const PuppetView& view = puppet_.views[v];
      double tx = 0, ty = 0;
      for (std::size_t c = 0; c < count_; ++c) {
        const Vec2 p = view.points[quad_[c].point];
        tx += w[c] * p.x, ty += w[c] * p.y;
      }
      add_sample(view, tx, ty, pose_.shares[v], sum);
    }
    float* out = canvas_.light + 4 * at;
    for (std::size_t c = 0; c < 4; ++c) out[c] = sum[c] + (1 - sum[3]) * out[c];
    if (sum[3] > 0.5f) canvas_.depth[at] = std::max(canvas_.depth[at], depth);
  }

  const Puppet& puppet_;
  const PuppetPose& pose_;
  Canvas canvas_;
  Vec2 center_;
  float scale_;
  std::array<Corner, 4> quad_{};
  std::size_t count_ = 3;
  bool is_convex_ = false;
};

float encoded(float light) noexcept {
  return static_cast<float>(
      srgb_from_linear(static_cast<std::uint16_t>(std::clamp(light, 0.0f, 1.0f) * 65535 + 0.5f)));
}

// Over what the canvas holds, in linear light.
void lay_over(const float* light, std::uint8_t* pixel) noexcept {
  const float a = std::min(light[3], 1.0f);
  if (a <= 0) return;
  const float below = static_cast<float>(pixel[3]) / 255;
  const float alpha = a + (1 - a) * below;
  for (int c = 0; c < 3; ++c) {
    float under = 0;
    if (pixel[3] > 0) {
      const unsigned straight = std::min(255u, (pixel[c] * 255u + pixel[3] / 2u) / pixel[3]);
      under =
          static_cast<float>(linear_from_srgb(static_cast<std::uint8_t>(straight))) / 65535 * below;
    }
    const float mixed = std::max(0.0f, light[c]) + (1 - a) * under;
    pixel[c] = static_cast<std::uint8_t>(encoded(mixed / alpha) * alpha + 0.5f);
  }
  pixel[3] = static_cast<std::uint8_t>(std::min(alpha, 1.0f) * 255 + 0.5f);
}

}  // namespace

void render_puppet(const Puppet& puppet, const PuppetPose& pose, PuppetPainter& painter,
                   Image& canvas, Vec2 center, float scale) {
  const std::size_t pixels =
      static_cast<std::size_t>(canvas.width) * static_cast<std::size_t>(canvas.height);
  painter.light.assign(4 * pixels, 0);
  painter.depth.assign(pixels, -HUGE_VALF);
  painter.order.resize(puppet.faces.size());
  painter.keys.resize(puppet.faces.size());
  for (std::size_t f = 0; f < puppet.faces.size(); ++f) {
    const Face& face = puppet.faces[f];
    float sum = 0;
    for (std::uint32_t c = 0; c < face.count; ++c) sum += pose.depth[face.corners[c]];
    painter.keys[f] = sum / static_cast<float>(face.count);
  }
  std::iota(painter.order.begin(), painter.order.end(), 0u);
  std::sort(painter.order.begin(), painter.order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return painter.keys[a] != painter.keys[b] ? painter.keys[a] < painter.keys[b] : a < b;
  });
  FacePainter faces(puppet, pose,
                    {canvas.width, canvas.height, painter.light.data(), painter.depth.data()},
                    center, scale);
  for (const std::uint32_t f : painter.order) faces.paint(puppet.faces[f]);
  for (std::size_t i = 0; i < pixels; ++i) lay_over(&painter.light[4 * i], &canvas.rgba[4 * i]);
}

}  // namespace vsprite
