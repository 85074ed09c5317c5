// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// draw_scene.h - what the drawing benchmarks draw: 2,000 places on a frame of 1280 x 720 and 64
// mattes of 64 x 64, a body with fins: about a third of the box is clear, half is opaque.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "vsprite/geometry.h"
#include "vsprite/image.h"

namespace vsprite::bench {

constexpr int kFrameWidth = 1280, kFrameHeight = 720;
constexpr int kSide = 64, kMattes = 64, kPlaces = 2000;

/// Premultiplied. Each of the mattes bends another way.
inline Image make_matte(int which) {
  Image image{kSide, kSide, std::vector<std::uint8_t>(std::size_t{kSide} * kSide * 4)};
  const float bend = 5 * std::sin(6.2832f * static_cast<float>(which) / kMattes);
  const auto soft = [](float d, float width) { return std::min(1.0f, std::max(0.0f, d / width)); };
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const float u = (static_cast<float>(x) - 31.5f) / 32;
      const float v = (static_cast<float>(y) - 31.5f - bend * u * u) / 32;
      const float body = soft(1 - std::sqrt(u * u * 1.12f + v * v * 2.0f), 0.05f);
      const float fin = 0.55f * soft(0.97f - std::sqrt(u * u * 1.3f + v * v * 1.06f), 0.08f) *
                        soft(0.3f - std::abs(u + 0.2f), 0.1f);
      const float a = std::max(body, fin);
      const float scales = 0.5f + 0.5f * std::sin(0.9f * static_cast<float>(x + which)) *
                                      std::sin(0.7f * static_cast<float>(y));
      std::uint8_t* p = &image.rgba[static_cast<std::size_t>((y * kSide + x) * 4)];
      p[0] = static_cast<std::uint8_t>(a * (200 + 50 * scales) + 0.5f);
      p[1] = static_cast<std::uint8_t>(a * (90 + 60 * scales) + 0.5f);
      p[2] = static_cast<std::uint8_t>(a * (20 + 40 * scales) + 0.5f);
      p[3] = static_cast<std::uint8_t>(a * 255 + 0.5f);
    }
  }
  return image;
}

inline const std::vector<Image>& mattes() {
  static const std::vector<Image> all = [] {
    std::vector<Image> made;
    for (int i = 0; i < kMattes; ++i) made.push_back(make_matte(i));
    return made;
  }();
  return all;
}

/// Top left corners, wholly inside the frame, between pixels.
inline const std::vector<Vec2>& places() {
  static const std::vector<Vec2> all = [] {
    std::mt19937 random(7);
    std::vector<Vec2> made;
    const auto within = [&](int most) {
      return static_cast<float>(random() % static_cast<unsigned>(16 * most)) / 16;
    };
    for (int i = 0; i < kPlaces; ++i) {
      const float x = within(kFrameWidth - kSide - 1);
      made.push_back({x, within(kFrameHeight - kSide - 1)});
    }
    return made;
  }();
  return all;
}

}  // namespace vsprite::bench
