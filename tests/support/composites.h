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
#include <utility>
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

/// Screens other than those; chosen with since.
inline const std::vector<Condition>& more_conditions() {
  static const std::vector<Condition> all = {
      {"green cloth", {70, 140, 75}, 0.3, 2.5, 0.05, 20},
      {"deep green", {20, 110, 45}, 0.1, 2, 0.04, 18},
      {"sky blue", {110, 160, 215}, 0.2, 2, 0.03, 20},
      {"navy", {28, 40, 90}, 0.2, 2.5, 0.03, 18},
      {"turquoise", {70, 170, 165}, 0.15, 2, 0.05, 22},
      {"violet", {120, 80, 170}, 0.2, 2, 0.03, 18},
      {"red", {170, 45, 40}, 0.15, 2, 0.03, 18},
      {"grainy green", {60, 130, 70}, 0.2, 7, 0.03, 18},
      {"off-white", {205, 208, 214}, 0.15, 2, 0.0, 18},
      {"charcoal", {34, 36, 38}, 0.15, 2, 0.0, 18},
      {"middle grey", {98, 100, 104}, 0.15, 2, 0.0, 20},
      {"green, compressed", {60, 150, 80}, 0.15, 2, 0.06, 32},
  };
  return all;
}

/// Screens without a colour, for three subjects in turn; chosen with.
inline const std::vector<Condition>& plain_conditions() {
  static const std::vector<Condition> all = {
      {"bright white", {228, 229, 231}, 0.1, 1.5, 0.0, 18},
      {"dark slate", {58, 60, 64}, 0.2, 2, 0.0, 18},
      {"soot", {20, 20, 21}, 0.1, 1.5, 0.0, 18},
      {"bone", {212, 208, 200}, 0.15, 2, 0.0, 20},
      {"copy paper", {240, 240, 238}, 0.1, 1.5, 0.0, 18},
      {"silver grey", {186, 184, 182}, 0.15, 2, 0.0, 18},
      {"cement", {168, 170, 174}, 0.2, 2, 0.0, 18},
      {"coal", {44, 44, 46}, 0.15, 2, 0.0, 20},
      {"lead grey", {78, 80, 84}, 0.15, 2.5, 0.0, 18},
      {"white, compressed", {222, 221, 218}, 0.15, 2, 0.0, 29},
      {"uneven off-white", {216, 218, 214}, 0.3, 2, 0.0, 20},
      {"chalk", {232, 232, 228}, 0.1, 3, 0.0, 20},
  };
  return all;
}

/// The screens of the films that no choice has seen: six for each of two subjects, in turn.
inline const std::vector<Condition>& unseen_conditions() {
  static const std::vector<Condition> all = {
      {"chroma green", {15, 165, 30}, 0.1, 1.5, 0.04, 20},
      {"cobalt", {20, 50, 160}, 0.15, 2, 0.04, 18},
      {"pale blue", {140, 175, 205}, 0.15, 2, 0.03, 18},
      {"bottle green", {18, 62, 48}, 0.2, 2, 0.03, 20},
      {"steel blue", {72, 100, 128}, 0.25, 2, 0.03, 20},
      {"olive green", {96, 128, 62}, 0.2, 2.5, 0.04, 18},
      {"fuchsia", {190, 40, 120}, 0.1, 2, 0.03, 18},
      {"teal", {25, 120, 115}, 0.2, 2.5, 0.05, 24},
      {"light grey", {178, 180, 182}, 0.1, 2, 0.0, 18},
      {"paper white", {236, 234, 230}, 0.12, 1.5, 0.0, 20},
      {"near black", {24, 23, 22}, 0.1, 2, 0.0, 20},
      {"slate", {66, 70, 76}, 0.15, 2, 0.0, 18},
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

/// Parts laid over each other, from the back to the front.
class Layers {
 public:
  Layers(int width, int height) : out_{width, height, {}, {}} {
    out_.alpha.resize(static_cast<std::size_t>(width * height));
    out_.foreground.resize(3 * out_.alpha.size());
  }
  /// A point of a part: its coverage there and its linear colour.
  void over(std::size_t i, double cover, const double (&color)[3]) {
    const auto a = static_cast<float>(cover);
    out_.alpha[i] = a + (1 - a) * out_.alpha[i];
    for (std::size_t c = 0; c < 3; ++c) {
      float& f = out_.foreground[3 * i + c];
      f = a * static_cast<float>(color[c]) + (1 - a) * f;
    }
  }
  /// A curve of `steps` points, `at(t)` its place and `half(t)` half its width, 0 <= t <= 1.
  template <class At, class Half>
  void stroke(int steps, At at, Half half, const double (&color)[3]) {
    const int w = out_.width;
    std::vector<std::pair<std::size_t, double>> cover;
    for (int k = 0; k <= steps; ++k) {
      const double t = 1.0 * k / steps;
      const auto [x, y] = at(t);
      const int reach = static_cast<int>(half(t)) + 1;
      for (int v = static_cast<int>(y) - reach; v <= static_cast<int>(y) + reach; ++v)
        for (int u = static_cast<int>(x) - reach; u <= static_cast<int>(x) + reach; ++u) {
          if (u < 0 || v < 0 || u >= w || v >= out_.height) continue;
          const double in = std::clamp(half(t) + 0.5 - std::hypot(u + 0.5 - x, v + 0.5 - y), 0.0,
                                       std::min(2 * half(t), 1.0));
          if (in > 0) cover.emplace_back(static_cast<std::size_t>(v * w + u), in);
        }
    }
    std::sort(cover.begin(), cover.end());
    for (std::size_t k = 0; k < cover.size(); ++k)
      if (k + 1 == cover.size() || cover[k + 1].first != cover[k].first)
        over(cover[k].first, cover[k].second, color);
  }
  /// `paint(x, y, color)` says whether a part is at a place, and how much it covers there.
  template <class Paint>
  void area(double left, double top, double right, double bottom, Paint paint) {
    constexpr int kFine = 3;  // samples a pixel along each axis
    for (int y = std::max(static_cast<int>(top), 0);
         y <= std::min(static_cast<int>(bottom), out_.height - 1); ++y)
      for (int x = std::max(static_cast<int>(left), 0);
           x <= std::min(static_cast<int>(right), out_.width - 1); ++x) {
        double cover = 0;
        double mean[3] = {};
        for (int s = 0; s < kFine * kFine; ++s) {
          double color[3] = {};
          const double a =
              paint(x + (s % kFine + 0.5) / kFine, y + (s / kFine + 0.5) / kFine, color);
          cover += a;
          for (int c = 0; c < 3; ++c) mean[c] += a * color[c];
        }
        if (cover <= 0) continue;
        for (double& m : mean) m /= cover;
        over(static_cast<std::size_t>(y * out_.width + x), cover / (kFine * kFine), mean);
      }
  }
  CutOut finish() {
    for (std::size_t i = 0; i < out_.alpha.size(); ++i)
      for (std::size_t c = 0; c < 3 && out_.alpha[i] > 0; ++c)
        out_.foreground[3 * i + c] /= out_.alpha[i];
    return std::move(out_);
  }

 private:
  CutOut out_;  // colours times alpha until finished
};

/// A dragonfly from the side: an opaque banded body, thin legs, four clear wings with dark veins.
inline CutOut dragonfly(double time, int width, int height) {
  Layers layers(width, height);
  const double cx = width * (0.5 + 0.22 * std::sin(0.06 * time));
  const double cy = height * (0.5 + 0.15 * std::cos(0.11 * time));
  const double r = 0.035 * height;
  const double vein[3] = {0.05, 0.04, 0.03};
  const auto wing = [&](double root, double turn, double length) {
    const double ux = std::cos(turn), uy = std::sin(turn);
    const double x0 = cx + root, y0 = cy - 0.5 * r;
    const double reach = 1.1 * length;
    layers.area(x0 - reach, y0 - reach, x0 + reach, y0 + reach,
                [&](double x, double y, double(&color)[3]) {
                  const double along = ((x - x0) * ux + (y - y0) * uy) / length;
                  const double across = ((y - y0) * ux - (x - x0) * uy) / length;
                  if (along < 0 || along > 1) return 0.0;
                  if (std::abs(across) > 0.17 * std::sqrt(along * (1.02 - along) * 3)) return 0.0;
                  color[0] = 0.52, color[1] = 0.56, color[2] = 0.55;
                  return 0.16 + 0.14 * along;
                });
    for (int k = -3; k <= 3; ++k)
      layers.stroke(
          static_cast<int>(2 * length),
          [&](double t) {
            const double across = 0.05 * k * std::sqrt(t * (1.02 - t) * 3);
            return std::pair{x0 + length * (0.98 * t * ux - across * uy),
                             y0 + length * (0.98 * t * uy + across * ux)};
          },
          [&](double t) { return 0.55 - 0.35 * t; }, vein);
  };
  const double beat = 0.5 * std::sin(1.1 * time);
  wing(-0.3 * r, -2.0 - beat, 5.2 * r);
  wing(0.7 * r, -1.2 + beat, 5.6 * r);
  for (int k = 0; k < 6; ++k)
    layers.stroke(
        60,
        [&](double t) {
          return std::pair{cx + r * (0.35 * k - 0.9 + 0.5 * t * (k % 2 ? 1 : -1)),
                           cy + r * (0.6 + 1.5 * t - 0.5 * t * t)};
        },
        [](double t) { return 0.9 - 0.5 * t; }, vein);
  layers.area(cx - 9 * r, cy - 2 * r, cx + 4 * r, cy + 3 * r,
              [&](double x, double y, double(&color)[3]) {
                const double u = (x - cx) / r, v = (y - cy) / r;
                const double sag = v - 0.02 * u * u * (u < 0 ? 1 : 0);
                const bool tail = u < 0 && u > -8 && std::abs(sag) < 0.36 + 0.02 * u;
                const bool chest = u * u / 2.6 + v * v < 1;
                const bool head = std::hypot(u - 2.0, v + 0.1) < 0.75;
                if (!tail && !chest && !head) return 0.0;
                const bool dark = tail && std::sin(4.5 * u) > 0.2;
                const double light = 1 - 0.3 * v;
                color[0] = light * (dark ? 0.05 : head ? 0.16 : 0.42);
                color[1] = light * (dark ? 0.04 : head ? 0.22 : 0.24);
                color[2] = light * (dark ? 0.04 : head ? 0.10 : 0.07);
                return 1.0;
              });
  wing(-0.3 * r, -1.75 + beat, 5.4 * r);
  wing(0.7 * r, -0.95 - beat, 5.8 * r);
  return layers.finish();
}

/// A long-haired animal of white, ginger and black, on its way from the right to the left.
inline CutOut longhair(double time, int width, int height) {
  Layers layers(width, height);
  const double cx = width * (0.68 - 0.007 * time);
  const double cy = height * (0.48 + 0.03 * std::sin(0.5 * time));
  const double r = 0.11 * height;
  const auto coat = [&](double u, double v, double(&color)[3]) {
    const double patch = std::sin(2.1 * u + 0.4) + std::sin(1.7 * v - 0.9 * u);
    const double white[3] = {0.72, 0.69, 0.64}, ginger[3] = {0.44, 0.21, 0.08},
                 black[3] = {0.03, 0.028, 0.026};
    const double(&c)[3] = patch > 0.5 ? white : patch > -0.7 ? ginger : black;
    const double light = 1 - 0.18 * v;
    for (int p = 0; p < 3; ++p) color[p] = c[p] * light;
  };
  std::uint32_t state = 4711;
  const auto random = [&state] {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state >> 8) / (1 << 24);
  };
  const auto hair = [&](double u, double v, double du, double dv, double wide) {
    double color[3];
    coat(u, v, color);
    const double sway = 0.12 * std::sin(0.35 * time + 3 * u) + 0.25 * (random() - 0.5);
    layers.stroke(
        static_cast<int>(2.5 * r * std::hypot(du, dv)) + 4,
        [&](double t) {
          return std::pair{cx + r * (u + du * t + sway * t * t), cy + r * (v + dv * t)};
        },
        [&](double t) { return wide * (1 - 0.7 * t); }, color);
  };
  for (int k = 0; k < 420; ++k) {  // skirt
    const double u = -1.7 + 3.4 * random();
    hair(u, 0.75 * std::sqrt(std::max(1 - u * u / 3.2, 0.0)), 0.2 * (random() - 0.3),
         0.35 + 0.45 * random(), 0.2 + 0.35 * random());
  }
  for (int k = 0; k < 160; ++k)  // tail
    hair(1.65, -0.2 + 0.2 * random(), 0.6 + 0.9 * random(), 0.8 * random() - 0.1,
         0.2 + 0.4 * random());
  for (int k = 0; k < 200; ++k) {  // back and head
    const double turn = -3.6 + 3.2 * random();
    hair(1.72 * std::cos(turn), 0.92 * std::sin(turn), 0.12 * std::cos(turn),
         0.2 * std::sin(turn) * random(), 0.2 + 0.3 * random());
  }
  layers.area(cx - 3 * r, cy - 2 * r, cx + 2 * r, cy + 2 * r,
              [&](double x, double y, double(&color)[3]) {
                const double u = (x - cx) / r, v = (y - cy) / r;
                const bool body = u * u / 3.2 + v * v / 0.9 < 1;
                const bool head = std::hypot(u + 1.9, v + 0.5) < 0.62;
                const bool leg = v > 0 && v < 1.75 &&
                                 (std::abs(u + 1.1 + 0.15 * std::sin(0.5 * time) * v) < 0.17 ||
                                  std::abs(u - 1.0 - 0.15 * std::sin(0.5 * time) * v) < 0.17);
                if (!body && !head && !leg) return 0.0;
                coat(u, v, color);
                return 1.0;
              });
  return layers.finish();
}

/// A white bird in flight: pale grey wings with dark, frayed ends, a yellow bill.
inline CutOut gull(double time, int width, int height) {
  Layers layers(width, height);
  const double cx = width * (0.3 + 0.006 * time);
  const double cy = height * (0.5 + 0.1 * std::sin(0.13 * time));
  const double r = 0.085 * height;
  const double beat = std::sin(0.45 * time);
  std::uint32_t state = 5309;
  const auto random = [&state] {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state >> 8) / (1 << 24);
  };
  const auto wing = [&](double side, double shade) {
    const double coat[3] = {0.47 * shade, 0.5 * shade, 0.53 * shade};
    const double lift = (0.5 + 0.5 * side * 0.2) * beat;
    const auto bone = [&](double t) { return -lift * (1.9 * t - 0.9 * t * t) * 2.2; };
    const auto color_at = [&](double t, double light, double(&color)[3]) {
      const double base[3] = {0.46, 0.49, 0.52};
      const double dark = std::clamp((t - 0.72) * 8, 0.0, 1.0);
      for (int p = 0; p < 3; ++p) color[p] = shade * light * ((1 - dark) * base[p] + dark * 0.03);
    };
    for (int k = 0; k < 26; ++k) {  // the feathers behind the bone
      const double t = k / 25.0;
      double color[3];
      color_at(t, 0.9 + 0.2 * random(), color);
      const double length = r * (0.75 + 0.45 * t + 0.2 * random());
      layers.stroke(
          static_cast<int>(2 * length),
          [&](double s) {
            return std::pair{cx + side * 3.4 * r * t * (1 + 0.12 * s) - 0.35 * length * s,
                             cy + r * bone(t) + length * s * (1 - 0.35 * t)};
          },
          [&](double s) { return 0.075 * r * (1.3 - s); }, color);
    }
    layers.stroke(
        static_cast<int>(8 * r),
        [&](double t) {
          return std::pair{cx + side * 3.4 * r * t, cy + r * bone(t)};
        },
        [&](double t) { return r * (0.3 - 0.2 * t); }, coat);
  };
  wing(-1, 0.85);
  layers.area(cx - 3 * r, cy - 2 * r, cx + 3 * r, cy + 2 * r,
              [&](double x, double y, double(&color)[3]) {
                const double u = (x - cx) / r, v = (y - cy) / r;
                const bool body = u * u / 3.4 + v * v / 0.42 < 1;
                const bool head = std::hypot(u - 1.75, v + 0.25) < 0.46;
                const bool tail = u < -1.2 && u > -2.7 && std::abs(v) < 0.12 - 0.17 * (u + 1.2);
                const bool bill = u > 2.0 && u < 2.75 && std::abs(v + 0.2) < 0.13 * (2.85 - u);
                const bool eye = std::hypot(u - 1.9, v + 0.35) < 0.08;
                if (!body && !head && !tail && !bill) return 0.0;
                const double light = 0.82 - 0.22 * v - (tail ? 0.05 * std::sin(9 * v) : 0.0);
                color[0] = eye ? 0.02 : bill && !head ? 0.62 : light;
                color[1] = eye ? 0.02 : bill && !head ? 0.38 : 0.985 * light;
                color[2] = eye ? 0.02 : bill && !head ? 0.04 : 0.95 * light;
                return 1.0;
              });
  wing(1, 1);
  return layers.finish();
}

/// A puppet on strings: a head of wood, a dark cloak in folds with a torn hem, a collar of lace.
inline CutOut puppet(double time, int width, int height) {
  Layers layers(width, height);
  const double cx = width * (0.5 + 0.22 * std::sin(0.07 * time));
  const double cy = height * (0.44 + 0.03 * std::sin(0.3 * time));
  const double r = 0.075 * height;
  const double swing = std::sin(0.17 * time);
  const double string[3] = {0.2, 0.19, 0.17}, wood[3] = {0.38, 0.22, 0.1};
  const double lace[3] = {0.6, 0.58, 0.52}, shoe[3] = {0.34, 0.03, 0.03};
  for (const double side : {-1.0, 0.0, 1.0})
    layers.stroke(
        height / 2,
        [&](double t) {
          return std::pair{cx + r * side * (2.4 - t) * (side != 0.0 ? 1.0 : 0.0),
                           cy - r * (2 + (5 + side) * t) + (side != 0.0 ? 1.6 * r * (1 - t) : 0)};
        },
        [](double) { return 0.35; }, string);
  for (const double side : {-1.0, 1.0}) {
    layers.stroke(
        120,
        [&](double t) {
          return std::pair{cx + r * side * (0.6 + 0.2 * t) + r * swing * side * t * 0.4,
                           cy + r * (2.6 + 1.9 * t)};
        },
        [&](double t) { return r * (t > 0.8 ? 0.32 : 0.2); }, shoe);
    layers.stroke(
        120,
        [&](double t) {
          return std::pair{cx + r * side * (0.7 + 1.7 * t),
                           cy + r * (-0.9 + 0.7 * t * (1 - swing * side))};
        },
        [&](double t) { return r * (0.34 - 0.16 * t); }, wood);
  }
  layers.area(
      cx - 3 * r, cy - 2 * r, cx + 3 * r, cy + 4 * r, [&](double x, double y, double(&color)[3]) {
        const double u = (x - cx) / r - 0.2 * swing * (y - cy) / r, v = (y - cy) / r;
        const double hem = 3.2 + 0.3 * std::sin(4 * u + 0.2 * time) + 0.12 * std::sin(17 * u);
        if (v < -1.3 || v > hem || std::abs(u) > 0.75 + 0.32 * (v + 1.3)) return 0.0;
        const double fold = 0.5 + 0.5 * std::sin(6.5 * u / (0.8 + 0.2 * v) + 0.8 * swing);
        const double light = 0.015 + 0.075 * fold * fold;
        color[0] = 0.95 * light, color[1] = light, color[2] = 1.2 * light;
        return 1.0;
      });
  layers.area(cx - 2 * r, cy - 3 * r, cx + 2 * r, cy + r,
              [&](double x, double y, double(&color)[3]) {
                const double u = (x - cx) / r, v = (y - cy) / r + 0.15 * std::abs(u);
                if (std::abs(u) > 1.5 || v < -1.5 || v > -0.8 + 0.1 * std::sin(9 * u)) return 0.0;
                for (int p = 0; p < 3; ++p) color[p] = lace[p];
                return std::sin(22 * u) * std::sin(22 * v) > 0.25 ? 0.9 : 0.3;
              });
  layers.area(cx - 2 * r, cy - 4 * r, cx + 2 * r, cy, [&](double x, double y, double(&color)[3]) {
    const double u = (x - cx) / r, v = (y - cy) / r + 2.2;
    const bool nose = u > 0 && u < 1.35 && std::abs(v - 0.1) < 0.16 * (1.45 - u);
    if (std::hypot(u / 0.8, v) > 1 && !nose) return 0.0;
    const double light = 1 - 0.3 * u + 0.08 * std::sin(8 * v + 2 * u);
    const bool paint = std::hypot(u - 0.3, v + 0.2) < 0.16 || (v < -0.55 + 0.1 * u);
    for (int p = 0; p < 3; ++p) color[p] = paint ? 0.04 : wood[p] * light;
    return 1.0;
  });
  return layers.finish();
}

/// A jellyfish: a clear bell with a denser rim and opaque organs, arms like veils, fine threads.
inline CutOut jellyfish(double time, int width, int height) {
  Layers layers(width, height);
  const double cx = width * (0.42 + 0.003 * time);
  const double cy = height * (0.42 - 0.08 * std::sin(0.06 * time));
  const double pulse = std::sin(0.3 * time);
  const double wide = 0.19 * height * (1 - 0.08 * pulse), high = 0.15 * height * (1 + 0.08 * pulse);
  const double thread[3] = {0.5, 0.44, 0.46};
  for (int k = 0; k < 22; ++k) {
    const double u = -0.95 + 1.9 * k / 21;
    const double length = height * (0.22 + 0.12 * std::sin(5.3 * k));
    layers.stroke(
        static_cast<int>(2 * length),
        [&](double t) {
          return std::pair{cx + wide * u + 9 * std::sin(5 * t + 0.25 * time + k) * t,
                           cy + 0.2 * high + length * t};
        },
        [](double t) { return 0.5 - 0.3 * t; }, thread);
  }
  for (int k = -1; k <= 1; ++k)
    layers.area(
        cx - wide, cy, cx + wide, cy + 0.42 * height, [&](double x, double y, double(&color)[3]) {
          const double v = (y - cy) / (0.36 * height);
          const double u = (x - cx) / wide - 0.35 * k - 0.1 * std::sin(6 * v + 0.25 * time + k);
          const double half = 0.13 * (1 - v) * (1 + 0.3 * std::sin(25 * v));
          if (v < 0 || v > 1 || std::abs(u) > half) return 0.0;
          color[0] = 0.62, color[1] = 0.46, color[2] = 0.42;
          return 0.35 + 0.3 * std::sin(30 * u) * std::sin(30 * u);
        });
  layers.area(cx - 1.1 * wide, cy - 1.1 * high, cx + 1.1 * wide, cy + 0.4 * high,
              [&](double x, double y, double(&color)[3]) {
                const double u = (x - cx) / wide, v = (y - cy) / high;
                const double far = std::hypot(u, v);
                if (far > 1 || v > 0.25 + 0.05 * std::sin(20 * u)) return 0.0;
                for (const double at : {-0.36, -0.12, 0.14, 0.38})
                  if (std::hypot((u - at) / 0.1, (v + 0.35) / 0.2) < 1) {
                    color[0] = 0.55, color[1] = 0.2, color[2] = 0.27;
                    return 0.92;
                  }
                color[0] = 0.6, color[1] = 0.55, color[2] = 0.58;
                return 0.16 + 0.5 * std::pow(far, 6) + 0.05 * std::sin(12 * u);
              });
  return layers.finish();
}

/// A seed head on a stalk in the wind: a brown heart, rays with parasols of hairs on their ends,
/// some of them gone on a way of their own.
inline CutOut seed_head(double time, int width, int height) {
  Layers layers(width, height);
  const double sway = 0.5 * std::sin(0.08 * time) + 0.08 * std::sin(0.5 * time);
  const double foot = width * (0.45 + 0.1 * std::sin(0.03 * time));
  const double r = 0.19 * height;
  const double cx = foot + 0.55 * height * std::sin(0.6 * sway), cy = 0.46 * height;
  const double stalk[3] = {0.16, 0.22, 0.07}, heart[3] = {0.20, 0.11, 0.05};
  const double ray[3] = {0.46, 0.38, 0.27}, down[3] = {0.74, 0.73, 0.69};
  layers.stroke(
      height,
      [&](double t) {
        return std::pair{foot + (cx - foot) * t * t, height * 0.98 + (cy - 0.98 * height) * t};
      },
      [](double t) { return 2.4 - 0.9 * t; }, stalk);
  std::uint32_t state = 20261;
  const auto random = [&state] {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state >> 8) / (1 << 24);
  };
  const auto seed = [&](double x, double y, double turn, double length) {
    const double ux = std::cos(turn), uy = std::sin(turn);
    const double ex = x + length * ux, ey = y + length * uy;
    layers.stroke(
        static_cast<int>(2 * length),
        [&](double t) {
          return std::pair{x + (ex - x) * t, y + (ey - y) * t};
        },
        [](double t) { return t < 0.15 ? 0.8 : 0.28; }, ray);
    for (int k = -5; k <= 5; ++k) {
      const double spread = turn + 0.24 * k;
      layers.stroke(
          28,
          [&](double t) {
            return std::pair{ex + 0.3 * r * t * std::cos(spread),
                             ey + 0.3 * r * t * std::sin(spread)};
          },
          [](double t) { return 0.32 - 0.2 * t; }, down);
    }
  };
  for (int k = 0; k < 46; ++k) {
    const double turn = 6.2831853 * (k + 0.6 * random()) / 46 + 0.4 * sway;
    const double length = r * (0.45 + 0.5 * random());
    const double start = 18 + 60 * random();  // when it leaves
    const double away = k % 6 == 0 && time > start ? time - start : 0;
    seed(cx + 3.1 * away, cy - 1.4 * away + 6 * std::sin(0.2 * away), turn, length);
  }
  layers.area(cx - r, cy - r, cx + r, cy + r, [&](double x, double y, double(&color)[3]) {
    const double far = std::hypot(x - cx, y - cy) / (0.13 * r);
    if (far > 1) return 0.0;
    const double light =
        1 - 0.35 * (y - cy) / (0.13 * r) + 0.2 * std::sin(1.9 * x) * std::sin(2.3 * y);
    for (int p = 0; p < 3; ++p) color[p] = heart[p] * light;
    return 1.0;
  });
  return layers.finish();
}

/// A person turning: bare arms, a patterned top, a skirt of net over dark legs, loose brown hair.
inline CutOut dancer(double time, int width, int height) {
  Layers layers(width, height);
  const double cx = width * (0.5 + 0.2 * std::sin(0.05 * time + 0.6));
  const double cy = 0.52 * height;
  const double r = 0.06 * height;
  const double turn = std::sin(0.22 * time);
  const double skin[3] = {0.50, 0.29, 0.20}, hose[3] = {0.03, 0.03, 0.04};
  const double thread[3] = {0.33, 0.05, 0.12}, hair[3] = {0.09, 0.045, 0.02};
  for (const double side : {-1.0, 1.0}) {
    layers.stroke(
        200,
        [&](double t) {
          return std::pair{cx + r * side * (0.4 + 0.5 * t + 0.5 * turn * side * t * t),
                           cy + r * (1.4 + 4.6 * t)};
        },
        [&](double t) { return r * (0.42 - 0.2 * t); }, hose);
    layers.stroke(
        160,
        [&](double t) {
          return std::pair{cx + r * side * (0.8 + 2.3 * t),
                           cy + r * (-1.6 - 1.5 * t * std::sin(0.19 * time + side) + 0.8 * t * t)};
        },
        [&](double t) { return r * (0.3 - 0.14 * t); }, skin);
  }
  // The net: a pale haze of threads too fine to see, and two families of those that are seen.
  const double wide = 2.6 + 0.5 * std::abs(turn);
  const auto hem = [&](double u) { return 3.6 + 0.25 * std::sin(3 * u + 0.4 * time); };
  layers.area(cx - 3.2 * r, cy + 0.8 * r, cx + 3.2 * r, cy + 4.2 * r,
              [&](double x, double y, double(&color)[3]) {
                const double u = (x - cx) / r, v = (y - cy) / r;
                if (v < 1 || v > hem(u)) return 0.0;
                if (std::abs(u) > 0.9 + (wide - 0.9) * std::sqrt((v - 1) / 2.6)) return 0.0;
                const double fold = 0.5 + 0.5 * std::sin(5 * u / (0.4 + 0.3 * v) + 2 * turn);
                for (int p = 0; p < 3; ++p) color[p] = thread[p] * (1 + 0.5 * fold);
                return 0.14 + 0.2 * fold * fold;
              });
  for (int k = -9; k <= 9; ++k)
    for (const double lean : {-0.12, 0.12})
      layers.stroke(
          static_cast<int>(6 * r),
          [&](double t) {
            const double v = 1 + t * (hem(0.1 * k) - 1);
            const double u = (0.1 * k + lean * t) * (0.9 + (wide - 0.9) * std::sqrt((v - 1) / 2.6));
            return std::pair{cx + r * u, cy + r * v};
          },
          [](double) { return 0.3; }, thread);
  layers.area(cx - 2 * r, cy - 5 * r, cx + 2 * r, cy + 2 * r,
              [&](double x, double y, double(&color)[3]) {
                const double u = (x - cx) / r, v = (y - cy) / r;
                const bool top = v > -2 && v < 1.5 && std::abs(u) < 0.95 - 0.12 * (v + 1) * (1 - v);
                const bool face = std::hypot((u - 0.15 * turn) / 0.72, (v + 3.1) / 0.92) < 1;
                const bool neck = std::abs(u) < 0.28 && v > -2.5 && v < -1.9;
                if (!top && !face && !neck) return 0.0;
                const double check = std::sin(9 * u) * std::sin(7 * v) > 0.1 ? 1.0 : 0.45;
                const double cloth[3] = {0.55 * check, 0.50 * check, 0.12 * check};
                const double light = 1 - 0.22 * u;
                for (int p = 0; p < 3; ++p)
                  color[p] = light * (top && v > -1.9 ? cloth[p] : skin[p]);
                return 1.0;
              });
  std::uint32_t state = 86028;
  const auto random = [&state] {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state >> 8) / (1 << 24);
  };
  for (int k = 0; k < 260; ++k) {
    const double at = -3.3 + 3.5 * random();
    const double drop = 0.6 + 1.9 * random();
    const double fly = 0.9 * (random() - 0.5) - 0.9 * std::cos(0.22 * time) * random();
    const double thick = 0.2 + 0.45 * random();
    const double x0 = 0.15 * turn + 0.74 * std::cos(at), y0 = -3.2 + 0.92 * std::sin(at);
    layers.stroke(
        static_cast<int>(3 * r * drop),
        [&](double t) {
          return std::pair{cx + r * (x0 + fly * t * t + 0.3 * x0 * t), cy + r * (y0 + drop * t)};
        },
        [&](double t) { return thick * (1 - 0.65 * t); }, hair);
  }
  return layers.finish();
}

/// What an open shutter sees: `make(time, width, height)` over a share of the time of a frame.
template <class Make>
CutOut shuttered(Make make, int frame, int width, int height, double share) {
  constexpr int kMoments = 3;
  CutOut sum{width, height, {}, {}};
  for (int k = 0; k < kMoments; ++k) {
    const CutOut one = make(frame + share * k / kMoments, width, height);
    sum.alpha.resize(one.alpha.size());
    sum.foreground.resize(one.foreground.size());
    for (std::size_t i = 0; i < one.alpha.size(); ++i) {
      sum.alpha[i] += one.alpha[i] / kMoments;
      for (std::size_t c = 0; c < 3; ++c)
        sum.foreground[3 * i + c] += one.alpha[i] * one.foreground[3 * i + c] / kMoments;
    }
  }
  for (std::size_t i = 0; i < sum.alpha.size(); ++i)
    for (std::size_t c = 0; c < 3 && sum.alpha[i] > 0; ++c)
      sum.foreground[3 * i + c] /= sum.alpha[i];
  return sum;
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
