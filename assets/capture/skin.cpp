// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Layers, from below: a gradient from back to belly with soft mottling, overlapping scales behind
// the gill cover, the gill cover's edge, the mouth, the nostril.
#include "skin.h"

#include <cmath>

#include "random.h"

namespace vsprite::capture {
namespace {

/// Smooth value noise in [-1, 1].
float noise(float x, float y, std::uint64_t seed) {
  const float fx = std::floor(x), fy = std::floor(y);
  const auto corner = [&](int i, int j) {
    const auto a = static_cast<std::uint64_t>(static_cast<std::int64_t>(fx) + i + 4096);
    const auto b = static_cast<std::uint64_t>(static_cast<std::int64_t>(fy) + j + 4096);
    return static_cast<float>(mix64(seed ^ (a << 20) ^ b) >> 40) * 0x1p-23f - 1;
  };
  const float u = smoothstep(0, 1, x - fx), v = smoothstep(0, 1, y - fy);
  return mix(mix(corner(0, 0), corner(1, 0), u), mix(corner(0, 1), corner(1, 1), u), v);
}

Vec3 ground_colour(float s, float t) {
  const Vec3 back{0.50f, 0.070f, 0.007f}, flank{0.87f, 0.215f, 0.013f}, low{0.94f, 0.40f, 0.06f},
      belly{0.93f, 0.72f, 0.46f};
  const float edge = t + 0.05f * noise(9 * s, 5 * t, 11) + 0.03f * noise(31 * s, 13 * t, 12);
  Vec3 c = mix(back, flank, smoothstep(0.04f, 0.36f, edge));
  c = mix(c, low, smoothstep(0.48f, 0.72f, edge));
  c = mix(
      c, belly,
      smoothstep(0.66f, 0.86f, edge) * smoothstep(0.02f, 0.10f, s) * smoothstep(1.0f, 0.78f, s));
  // The cheek is paler and more golden, the snout darker.
  const float cheek = smoothstep(0.09f, 0.15f, s) * smoothstep(0.245f, 0.20f, s) *
                      smoothstep(0.42f, 0.58f, t) * smoothstep(0.86f, 0.7f, t);
  c = mix(c, {0.95f, 0.50f, 0.11f}, 0.6f * cheek);
  const float mottle = 1 + 0.08f * noise(14 * s, 9 * t, 13) + 0.05f * noise(40 * s, 24 * t, 14);
  return mottle * c;
}

/// Overlapping discs in rows; a disc nearer the head lies over those behind it.
void add_scales(SkinPoint& p, float s, float t) {
  const float cover = smoothstep(0.235f, 0.275f, s) * smoothstep(1.0f, 0.93f, s);
  if (cover <= 0) return;
  const float a = 21.5f * s, b = 10.5f * t;
  constexpr float radius = 1.04f;
  for (int back = 2; back >= 0; --back) {  // the row farthest ahead first: it lies on top
    const float row = std::floor(a) - static_cast<float>(back) + 1;
    const float shift = std::fmod(row, 2.0f) == 0 ? 0.0f : 0.5f;
    const float column = std::round(b - shift) + shift;
    const float da = a - row, db = (b - column) * 1.28f;
    const float d = std::sqrt(da * da + db * db);
    if (d > radius || da < -0.2f) continue;
    const float rim = smoothstep(radius - 0.34f, radius, d);
    const float heart = smoothstep(0.9f, 0.2f, d);
    const float tone = 1 - 0.46f * rim * cover + 0.16f * heart * cover;
    p.albedo = tone * p.albedo;
    p.albedo = mix(p.albedo, {0.98f, 0.62f, 0.20f}, 0.14f * heart * cover);
    p.bump_along = cover * (0.34f * da - 0.12f);
    p.bump_across = cover * 0.38f * db;
    p.gloss = mix(p.gloss, 0.55f + 0.45f * heart - 0.4f * rim, cover);
    return;
  }
}

void add_gill_cover(SkinPoint& p, float s, float t) {
  const float bow = t - 0.52f;
  const float edge = 0.242f - 0.26f * bow * bow;
  const float inside = smoothstep(0.22f, 0.34f, t) * smoothstep(0.90f, 0.80f, t);
  const float behind = s - edge;
  const float line = std::exp(-behind * behind / (0.0055f * 0.0055f));
  const float shade = behind > 0 ? std::exp(-behind / 0.022f) : 0;
  p.albedo = (1 - inside * (0.62f * line + 0.22f * shade)) * p.albedo;
  p.bump_along += inside * 0.55f * std::exp(-std::pow((behind + 0.008f) / 0.010f, 2.0f));
  // The plate before the gill cover, a faint second bow.
  const float second = s - (0.185f - 0.22f * bow * bow);
  p.albedo = (1 - 0.2f * inside * std::exp(-second * second / (0.006f * 0.006f))) * p.albedo;
}

void add_face(SkinPoint& p, float s, float t) {
  const float slit = t - (0.60f + 1.6f * s);
  const float mouth = std::exp(-slit * slit / (0.035f * 0.035f)) * smoothstep(0.046f, 0.030f, s);
  p.albedo = mix(p.albedo, {0.16f, 0.030f, 0.012f}, 0.85f * mouth);
  const float lip =
      std::exp(-std::pow((std::abs(slit) - 0.085f) / 0.05f, 2.0f)) * smoothstep(0.052f, 0.030f, s);
  p.albedo = mix(p.albedo, {0.95f, 0.50f, 0.22f}, 0.55f * lip);
  const float ds = (s - 0.060f) / 0.0085f, dt = (t - 0.27f) / 0.030f;
  p.albedo = (1 - 0.7f * std::exp(-ds * ds - dt * dt)) * p.albedo;
  // A darker ring where the eye sits.
  const float ex = (s - 0.118f) / 0.052f, ey = (t - 0.40f) / 0.135f;
  const float socket = std::sqrt(ex * ex + ey * ey);
  p.albedo = (1 - 0.42f * std::exp(-std::pow((socket - 0.95f) / 0.22f, 2.0f))) * p.albedo;
}

SkinPoint paint(float s, float t) {
  SkinPoint p;
  p.albedo = ground_colour(s, t);
  p.gloss = 0.62f;
  p.bump_along = 0.05f * noise(60 * s, 30 * t, 21);
  p.bump_across = 0.05f * noise(60 * s, 30 * t, 22);
  add_scales(p, s, t);
  add_gill_cover(p, s, t);
  add_face(p, s, t);
  return p;
}

}  // namespace

Skin::Skin() {
  points_.reserve(static_cast<std::size_t>(kColumns * kRows));
  for (int j = 0; j < kRows; ++j) {
    for (int i = 0; i < kColumns; ++i) {
      points_.push_back(
          paint(static_cast<float>(i) / (kColumns - 1), static_cast<float>(j) / (kRows - 1)));
    }
  }
}

SkinPoint Skin::at(float along, float across) const {
  const float x = std::clamp(along, 0.0f, 0.99999f) * (kColumns - 1);
  const float y = std::clamp(across, 0.0f, 0.99999f) * (kRows - 1);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
  const SkinPoint* row = points_.data() + static_cast<std::ptrdiff_t>(j) * kColumns + i;
  const SkinPoint &a = row[0], &b = row[1], &c = row[kColumns], &d = row[kColumns + 1];
  const auto value = [&](float SkinPoint::*m) {
    return mix(mix(a.*m, b.*m, u), mix(c.*m, d.*m, u), v);
  };
  SkinPoint p;
  p.albedo = mix(mix(a.albedo, b.albedo, u), mix(c.albedo, d.albedo, u), v);
  p.bump_along = value(&SkinPoint::bump_along);
  p.bump_across = value(&SkinPoint::bump_across);
  p.gloss = value(&SkinPoint::gloss);
  return p;
}

}  // namespace vsprite::capture
