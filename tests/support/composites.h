// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// composites.h - known cut-outs before screens of every condition, mixed in linear light, with
// noise, then encoded: films whose matte is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "support/synthetic_film.h"

namespace vsprite::testing {

/// A subject alone: coverage and linear R, G, B, per pixel.
struct CutOut {
  int width = 0, height = 0;
  std::vector<float> alpha;       ///< (height, width)
  std::vector<float> foreground;  ///< (height, width, 3)
};

struct Condition {
  const char* name;
  double screen[3];  ///< R G B, code values
  double gradient;   ///< share of the light lost from the upper left to the lower right corner
  double noise;      ///< sigma, code values
  double spill;      ///< share of the screen's light on the subject
  int crf;           ///< of x264
};

inline const std::vector<Condition>& conditions() {
  static const std::vector<Condition> all = {
      {"saturated blue", {30, 60, 200}, 0.1, 1.5, 0.03, 18},
      {"saturated green", {40, 180, 60}, 0.1, 1.5, 0.03, 18},
      {"grey blue", {75, 92, 135}, 0.15, 2, 0.03, 18},
      {"grey green", {85, 112, 80}, 0.15, 2, 0.03, 18},
      {"dim green", {25, 58, 30}, 0.15, 2, 0.03, 18},
      {"uneven blue", {60, 90, 170}, 0.5, 2, 0.03, 18},
      {"noisy blue", {60, 90, 170}, 0.15, 6, 0.03, 18},
      {"spill of blue", {60, 90, 170}, 0.15, 2, 0.12, 18},
      {"compressed blue", {60, 90, 170}, 0.15, 2, 0.03, 30},
      {"cyan", {60, 150, 160}, 0.15, 2, 0.03, 18},
      {"magenta", {165, 60, 150}, 0.15, 2, 0.03, 18},
      {"white", {225, 225, 222}, 0.1, 1.5, 0.0, 18},
      {"black", {16, 16, 18}, 0.1, 1.5, 0.0, 18},
      {"grey", {128, 126, 122}, 0.1, 1.5, 0.0, 18},
  };
  return all;
}

/// A grey and brown ball of fur with a pale translucent veil, on its way over the picture.
inline CutOut furry_ball(int frame, int width, int height) {
  constexpr int kFine = 3;  // samples a pixel along each axis
  const double cx = width * (0.25 + 0.5 * (0.5 - 0.5 * std::cos(frame * 0.045)));
  const double cy = height * (0.5 + 0.16 * std::sin(frame * 0.07));
  const double radius = 0.13 * height;
  std::vector<float> cover(static_cast<std::size_t>(width * height));
  CutOut out{width, height, std::vector<float>(cover.size()), std::vector<float>(3 * cover.size())};
  // Hairs: short curved strokes, half a pixel to a pixel and a half wide.
  std::uint32_t state = 99;
  const auto random = [&state] {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state >> 8) / (1 << 24);
  };
  std::vector<float> hair(cover.size());
  for (int k = 0; k < 360; ++k) {
    const double turn = 6.2831853 * (k + random()) / 360 + 0.02 * frame;
    const double curl = (random() - 0.5) * 0.9 + 0.15 * std::sin(frame * 0.2 + k);
    const double length = radius * (0.25 + 0.35 * random());
    const double wide = 0.25 + 0.5 * random();
    for (double t = 0; t < 1; t += 0.3 / length) {
      const double a = turn + curl * t * 0.4;
      const double x = cx + (radius * 0.95 + length * t) * std::cos(a);
      const double y = cy + (radius * 0.95 + length * t) * std::sin(a);
      for (int v = static_cast<int>(y) - 1; v <= static_cast<int>(y) + 1; ++v)
        for (int u = static_cast<int>(x) - 1; u <= static_cast<int>(x) + 1; ++u) {
          if (u < 0 || v < 0 || u >= width || v >= height) continue;
          const double far = std::hypot(u + 0.5 - x, v + 0.5 - y);
          const double in = std::clamp(wide * (1 - 0.6 * t) + 0.5 - far, 0.0, 1.0);
          float& h = hair[static_cast<std::size_t>(v * width + u)];
          h = std::max(h, static_cast<float>(in));
        }
    }
  }
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y * width + x);
      double body = 0;
      double veil = 0;
      for (int s = 0; s < kFine * kFine; ++s) {
        const double u = x + (s % kFine + 0.5) / kFine - cx;
        const double v = y + (s / kFine + 0.5) / kFine - cy;
        body += std::hypot(u, v) < radius;
        const bool tail = u < 0 && u > -2.2 * radius && std::abs(v) < 0.5 * radius * (-u / radius);
        veil += tail ? 0.25 + 0.15 * std::sin(0.35 * v) : 0;
      }
      body = std::max(body / (kFine * kFine), static_cast<double>(hair[i]));
      veil /= kFine * kFine;
      const double a = body + (1 - body) * veil;
      out.alpha[i] = static_cast<float>(a);
      if (!(a > 0)) continue;
      const double spot = std::sin(0.05 * (x - cx)) * std::sin(0.06 * (y - cy));
      const double fur[3] = {0.22 + 0.12 * spot, 0.19 + 0.08 * spot, 0.17 + 0.02 * spot};
      const double pale[3] = {0.62, 0.45, 0.40};
      for (std::size_t c = 0; c < 3; ++c)
        out.foreground[3 * i + c] =
            static_cast<float>((body * fur[c] + (1 - body) * veil * pale[c]) / a);
    }
  return out;
}

/// An opaque grey animal with large pink ears and a pink tail: against a screen its grey looks like
/// half of its pink.
inline CutOut grey_mouse(int frame, int width, int height) {
  constexpr int kFine = 3;  // samples a pixel along each axis
  const double cx = width * (0.5 + 0.25 * std::sin(frame * 0.05));
  const double cy = height * (0.55 + 0.12 * std::sin(frame * 0.08));
  const double r = 0.12 * height;
  const float grey[3] = {0.19f, 0.185f, 0.18f}, pink[3] = {0.60f, 0.24f, 0.26f};
  CutOut out{width, height, {}, {}};
  out.alpha.resize(static_cast<std::size_t>(width * height));
  out.foreground.resize(3 * out.alpha.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      int grey_count = 0, pink_count = 0;
      for (int s = 0; s < kFine * kFine; ++s) {
        const double u = (x + (s % kFine + 0.5) / kFine - cx) / r;
        const double v = (y + (s / kFine + 0.5) / kFine - cy) / r;
        const double ear = std::min(std::hypot(u - 0.9, v + 0.95), std::hypot(u - 0.1, v + 1.05));
        const double swing = 0.35 * std::sin(2.2 * u + 0.3 * frame);
        if (ear < 0.42 || (u < -1.2 && u > -3.4 && std::abs(v - swing) < 0.28))
          ++pink_count;
        else if (u * u / 2.2 + v * v < 1 || ear < 0.55)
          ++grey_count;
      }
      const int count = grey_count + pink_count;
      if (count == 0) continue;
      const auto i = static_cast<std::size_t>(y * width + x);
      out.alpha[i] = static_cast<float>(count) / (kFine * kFine);
      const float share = static_cast<float>(pink_count) / static_cast<float>(count);
      const float coat = 1 + 0.15f * static_cast<float>(std::sin(0.21 * x) * std::sin(0.17 * y));
      for (std::size_t c = 0; c < 3; ++c)
        out.foreground[3 * i + c] = share * pink[c] + (1 - share) * grey[c] * coat;
    }
  return out;
}

/// What the camera sees of a cut-out under a condition.
inline Image composite(const CutOut& cut, const Condition& c, int frame) {
  static const std::vector<float> encoded = [] {
    std::vector<float> table(4097);
    for (int i = 0; i <= 4096; ++i)
      table[static_cast<std::size_t>(i)] =
          static_cast<float>(SyntheticFilm::code(i / 4096.0 * (i / 4096.0)));
    return table;
  }();
  Image image{cut.width, cut.height, {}};
  image.rgba.reserve(4 * cut.alpha.size());
  std::uint32_t state = 7u + 7919u * static_cast<std::uint32_t>(frame);
  const auto random = [&state] {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state >> 8) / (1 << 24) - 0.5;
  };
  double linear[3];
  for (int p = 0; p < 3; ++p) linear[p] = SyntheticFilm::linear(c.screen[p]);
  for (int y = 0; y < cut.height; ++y)
    for (int x = 0; x < cut.width; ++x) {
      const auto i = static_cast<std::size_t>(y * cut.width + x);
      const double lit =
          1 - c.gradient * 0.5 * (1.0 * x / cut.width + 1.0 * y * y / cut.height / cut.height);
      const double a = static_cast<double>(cut.alpha[i]);
      for (std::size_t p = 0; p < 3; ++p) {
        const double b = linear[p] * lit;
        const double f =
            (1 - c.spill) * static_cast<double>(cut.foreground[3 * i + p]) + c.spill * b;
        const double mixed = std::clamp(a * f + (1 - a) * b, 0.0, 1.0);
        const double code =
            static_cast<double>(encoded[static_cast<std::size_t>(std::sqrt(mixed) * 4096 + 0.5)]);
        const double grain = c.noise * 2 * (random() + random() + random());  // variance 1
        image.rgba.push_back(static_cast<std::uint8_t>(std::clamp(code + grain + 0.5, 0.0, 255.0)));
      }
      image.rgba.push_back(255);
    }
  return image;
}

}  // namespace vsprite::testing
