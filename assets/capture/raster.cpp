// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// A plain rasterizer: edge functions over each triangle's box, attributes linear in the film plane.
#include "raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vsprite::capture {
namespace {

constexpr int kGrid = 2;                    // samples a pixel and side
constexpr Vec3 kKey{0, 0.80f, 0.60f};       // towards the light; neither left nor right
constexpr Vec3 kHalf{0, 0.4472f, 0.8944f};  // between that and the camera

struct Sample {
  float r = 0, g = 0, b = 0, a = 0;
};

float power32(float x) {
  x = std::max(x, 0.0f);
  for (int k = 0; k < 5; ++k) x *= x;
  return x;
}

/// Light that arrives on a matte surface: key, sky, floor and a fill beside the camera.
Vec3 irradiance(Vec3 n, float light) {
  const float key = 0.98f * std::max(0.0f, (dot(n, kKey) + 0.22f) / 1.22f);
  const float sky = 0.30f * (0.5f + 0.5f * n.y), floor = 0.16f * (0.5f - 0.5f * n.y);
  const float fill = 0.24f * std::max(0.0f, n.z);
  return light *
         (Vec3{key, 0.97f * key, 0.90f * key} + Vec3{0.92f * sky, 0.97f * sky, 1.05f * sky} +
          Vec3{floor, 0.95f * floor, 0.9f * floor} + Vec3{fill, 0.98f * fill, 0.95f * fill});
}

/// Screen light that the surface throws at the camera: a little everywhere, much at grazing angles.
Vec3 spill(Vec3 n, const Surroundings& around) {
  const float graze = 1 - std::clamp(n.z, 0.0f, 1.0f);
  const float g2 = graze * graze;
  return around.light * (0.035f + 0.42f * g2 * g2) * around.screen;
}

struct Interpolated {
  Vec3 normal, tangent;
  float u, v;
};

class Painter {
 public:
  Painter(const Skin& skin, const Surroundings& around) : skin_(skin), around_(around) {}

  Sample shade(const Interpolated& at, const Triangle& t) const {
    switch (t.material) {
      case Material::Body:
        return body(at);
      case Material::Eye:
        return eye(at);
      case Material::Fin:
        return fin(at, t.rays);
    }
    return {};
  }

 private:
  Sample opaque(Vec3 colour) const { return {colour.x, colour.y, colour.z, 1}; }

  Sample body(const Interpolated& at) const {
    const SkinPoint p = skin_.at(at.u, at.v);
    const Vec3 n0 = normalized(at.normal);
    // `across` runs from back to belly on both flanks.
    Vec3 across = cross(n0, at.tangent);
    if (across.y > 0) across = -1.0f * across;
    const Vec3 n = normalized(n0 + p.bump_along * at.tangent + p.bump_across * across);
    const float shine = power32(dot(n, kHalf)) * 0.42f * p.gloss;
    const float glow = std::max(0.0f, dot(n, kHalf)), glow2 = glow * glow;
    const float sheen = glow2 * glow2 * glow2 * 0.09f * p.gloss;
    return opaque(p.albedo * irradiance(n, around_.light) +
                  around_.light * shine * Vec3{1, 0.97f, 0.9f} +
                  around_.light * sheen * Vec3{1, 0.80f, 0.45f} + spill(n0, around_));
  }

  Sample eye(const Interpolated& at) const {
    const Vec3 n = normalized(at.normal);
    Vec3 colour{0.62f, 0.20f, 0.025f};  // the lid
    const float r = at.u;
    const float iris = smoothstep(0.80f, 0.74f, r);
    const float streak = 0.9f + 0.1f * std::sin(26 * std::numbers::pi_v<float> * at.v);
    colour = mix(colour, streak * Vec3{0.80f, 0.50f, 0.13f}, iris);
    const float ring = std::exp(-std::pow((r - 0.77f) / 0.07f, 2.0f));
    colour = mix(colour, {0.05f, 0.02f, 0.012f}, 0.8f * ring);
    colour = mix(colour, {0.006f, 0.006f, 0.008f}, smoothstep(0.50f, 0.43f, r));
    const float glint = smoothstep(0.955f, 0.985f, dot(n, normalized({0, 0.62f, 0.78f})));
    return opaque(colour * irradiance(n, around_.light) +
                  around_.light * 0.85f * glint * Vec3{1, 1, 1} + 0.4f * spill(n, around_));
  }

  Sample fin(const Interpolated& at, int rays) const {
    Vec3 n = normalized(at.normal);
    if (n.z < 0) n = -1.0f * n;
    // Rays fork half way out; the skin between them is thin.
    const float across = at.v * static_cast<float>(rays);
    const auto ridge = [](float x) {
      return 0.5f + 0.5f * std::cos(2 * std::numbers::pi_v<float> * x);
    };
    const float ray = mix(ridge(across), ridge(2 * across), smoothstep(0.45f, 0.7f, at.u));
    const float thin = smoothstep(0.0f, 1.0f, at.u);
    float alpha = mix(0.88f, 0.46f, thin) + mix(0.04f, 0.19f, thin) * (2 * ray - 1);
    alpha *= smoothstep(1.0f, 0.965f, at.u) * 0.85f + 0.15f;
    // Seen along its surface the sheet is thicker.
    alpha = 1 - std::pow(1 - std::min(alpha, 0.95f), 1 / std::max(0.35f, n.z));
    Vec3 albedo = mix(Vec3{0.88f, 0.19f, 0.012f}, Vec3{0.98f, 0.50f, 0.15f}, at.u);
    albedo = (0.74f + 0.34f * ray) * albedo;
    const float through = 0.34f + 0.5f * std::abs(dot(n, kKey));
    const float shine = power32(dot(n, kHalf)) * 0.10f;
    const Vec3 c = albedo * (0.55f * irradiance(n, around_.light) +
                             around_.light * through * Vec3{0.62f, 0.58f, 0.5f}) +
                   around_.light * shine * Vec3{1, 1, 1} + around_.light * 0.10f * around_.screen +
                   spill(n, around_);
    return {alpha * c.x, alpha * c.y, alpha * c.z, alpha};
  }

  const Skin& skin_;
  const Surroundings& around_;
};

/// The samples of one moment.
class Canvas {
 public:
  void reset(const Rect& box) {
    box_ = box;
    const auto count =
        static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height) * kGrid * kGrid;
    samples_.assign(count, {});
    depth_.assign(count, -1e9f);
  }

  void draw(const Mesh& mesh, const Triangle& t, const Painter& painter, Vec2 shift);
  void add_to(Coverage& sum, float weight) const;

 private:
  Rect box_;
  std::vector<Sample> samples_;
  std::vector<float> depth_;
};

void Canvas::draw(const Mesh& mesh, const Triangle& t, const Painter& painter, Vec2 shift) {
  const std::array<const Vertex*, 3> p = {&mesh.vertices[t.corner[0]], &mesh.vertices[t.corner[1]],
                                          &mesh.vertices[t.corner[2]]};
  const bool solid = t.material != Material::Fin;
  if (solid && p[0]->normal.z < -0.25f && p[1]->normal.z < -0.25f && p[2]->normal.z < -0.25f) {
    return;  // the far flank is hidden by the near one
  }
  // Grid units: sample (i, j) lies at the whole numbers.
  std::array<float, 3> x, y;
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = (p[k]->x - static_cast<float>(box_.x)) * kGrid - shift.x;
    y[k] = (p[k]->y - static_cast<float>(box_.y)) * kGrid - shift.y;
  }
  const float area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (std::abs(area) < 1e-6f) return;
  const float inverse = 1 / area;
  const int columns = box_.width * kGrid, rows = box_.height * kGrid;
  const int left = std::max(0, static_cast<int>(std::ceil(std::min({x[0], x[1], x[2]}))));
  const int right =
      std::min(columns - 1, static_cast<int>(std::floor(std::max({x[0], x[1], x[2]}))));
  const int above = std::max(0, static_cast<int>(std::ceil(std::min({y[0], y[1], y[2]}))));
  const int below = std::min(rows - 1, static_cast<int>(std::floor(std::max({y[0], y[1], y[2]}))));
  for (int j = above; j <= below; ++j) {
    const auto sy = static_cast<float>(j);
    for (int i = left; i <= right; ++i) {
      const auto sx = static_cast<float>(i);
      const float w0 = ((x[1] - sx) * (y[2] - sy) - (x[2] - sx) * (y[1] - sy)) * inverse;
      const float w1 = ((x[2] - sx) * (y[0] - sy) - (x[0] - sx) * (y[2] - sy)) / area;
      const float w2 = 1 - w0 - w1;
      if (w0 < 0 || w1 < 0 || w2 < 0) continue;
      const float z = w0 * p[0]->z + w1 * p[1]->z + w2 * p[2]->z;
      const auto at = static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(i);
      if (z <= depth_[at]) continue;
      const auto blend = [&](Vec3 Vertex::*m) {
        return w0 * (p[0]->*m) + w1 * (p[1]->*m) + w2 * (p[2]->*m);
      };
      const Sample s = painter.shade(
          {blend(&Vertex::normal), blend(&Vertex::tangent),
           w0 * p[0]->u + w1 * p[1]->u + w2 * p[2]->u, w0 * p[0]->v + w1 * p[1]->v + w2 * p[2]->v},
          t);
      Sample& d = samples_[at];
      const float keep = 1 - s.a;
      d = {s.r + keep * d.r, s.g + keep * d.g, s.b + keep * d.b, s.a + keep * d.a};
      if (solid) depth_[at] = z;
    }
  }
}

void Canvas::add_to(Coverage& sum, float weight) const {
  const int columns = box_.width * kGrid;
  for (int y = 0; y < box_.height; ++y) {
    for (int x = 0; x < box_.width; ++x) {
      Sample total;
      for (int j = 0; j < kGrid; ++j) {
        const Sample* row = samples_.data() + static_cast<std::ptrdiff_t>(y * kGrid + j) * columns +
                            static_cast<std::ptrdiff_t>(x) * kGrid;
        for (int i = 0; i < kGrid; ++i) {
          total.r += row[i].r, total.g += row[i].g, total.b += row[i].b, total.a += row[i].a;
        }
      }
      const auto at = static_cast<std::size_t>(y * box_.width + x);
      sum.alpha[at] += weight * total.a;
      sum.colour[3 * at] += weight * total.r;
      sum.colour[3 * at + 1] += weight * total.g;
      sum.colour[3 * at + 2] += weight * total.b;
    }
  }
}

Rect covered_box(const std::vector<Mesh>& moments, int width, int height) {
  float left = 1e9f, top = 1e9f, right = -1e9f, bottom = -1e9f;
  for (const Mesh& mesh : moments) {
    for (const Vertex& p : mesh.vertices) {
      left = std::min(left, p.x), right = std::max(right, p.x);
      top = std::min(top, p.y), bottom = std::max(bottom, p.y);
    }
  }
  const int x0 = std::clamp(static_cast<int>(std::floor(left)) - 1, 0, width);
  const int y0 = std::clamp(static_cast<int>(std::floor(top)) - 1, 0, height);
  const int x1 = std::clamp(static_cast<int>(std::ceil(right)) + 1, 0, width);
  const int y1 = std::clamp(static_cast<int>(std::ceil(bottom)) + 1, 0, height);
  return {x0, y0, std::max(0, x1 - x0), std::max(0, y1 - y0)};
}

}  // namespace

void rasterize(const std::vector<Mesh>& moments, const Skin& skin, const Surroundings& around,
               int width, int height, Coverage& out) {
  out.box = covered_box(moments, width, height);
  const auto pixels =
      static_cast<std::size_t>(out.box.width) * static_cast<std::size_t>(out.box.height);
  out.alpha.assign(pixels, 0);
  out.colour.assign(3 * pixels, 0);
  if (pixels == 0) return;
  // Offsets inside a sample's cell: the moments' grids interleave.
  constexpr std::array<Vec2, 4> shifts = {
      {{0.125f, 0.625f}, {0.375f, 0.125f}, {0.625f, 0.875f}, {0.875f, 0.375f}}};
  const float weight = 1.0f / (kGrid * kGrid * static_cast<float>(moments.size()));
  const Painter painter(skin, around);
  Canvas canvas;
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const Mesh& mesh = moments[k];
    canvas.reset(out.box);
    for (const Triangle& t : mesh.opaque) canvas.draw(mesh, t, painter, shifts[k % 4]);
    for (const Triangle& t : mesh.fins) canvas.draw(mesh, t, painter, shifts[k % 4]);
    canvas.add_to(out, weight);
  }
  for (float& a : out.alpha) a = std::min(a, 1.0f);
}

}  // namespace vsprite::capture
