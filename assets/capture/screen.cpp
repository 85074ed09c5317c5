// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
#include "screen.h"

#include <array>
#include <cmath>
#include <numbers>

#include "random.h"

namespace vsprite::capture {
namespace {

constexpr int kTable = 4096;

float linear_of(float code) {
  const float e = code / 255;
  return e <= 0.04045f ? e / 12.92f : std::pow((e + 0.055f) / 1.055f, 2.4f);
}

/// Code values (0..255, fractional) over the square root of linear light, where the curve is mild.
const std::array<float, kTable + 2>& code_table() {
  static const std::array<float, kTable + 2> table = [] {
    std::array<float, kTable + 2> t{};
    for (int i = 0; i < kTable + 2; ++i) {
      const double root = static_cast<double>(i) / kTable, linear = root * root;
      const double code =
          linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
      t[static_cast<std::size_t>(i)] = static_cast<float>(255 * code);
    }
    return t;
  }();
  return table;
}

float code_of(float linear) {
  const float p = std::sqrt(std::clamp(linear, 0.0f, 1.0f)) * kTable;
  const auto i = static_cast<std::size_t>(p);
  const float t = p - static_cast<float>(i);
  const auto& table = code_table();
  return table[i] + t * (table[i + 1] - table[i]);
}

/// Smooth noise in [-1, 1] on a lattice of the given pitch, px.
float folds(float x, float y, float pitch, std::uint64_t seed) {
  const float fx = std::floor(x / pitch), fy = std::floor(y / pitch);
  const auto corner = [&](int i, int j) {
    const auto a = static_cast<std::uint64_t>(static_cast<std::int64_t>(fx) + i);
    const auto b = static_cast<std::uint64_t>(static_cast<std::int64_t>(fy) + j);
    return static_cast<float>(mix64(seed + 7919 * a + 104729 * b) >> 40) * 0x1p-23f - 1;
  };
  const float u = smoothstep(0, 1, x / pitch - fx), v = smoothstep(0, 1, y / pitch - fy);
  return mix(mix(corner(0, 0), corner(1, 0), u), mix(corner(0, 1), corner(1, 1), u), v);
}

float evenness(float x, float y) {
  const float from_middle = (x - 0.5f) * (x - 0.5f) + 0.7f * (y - 0.5f) * (y - 0.5f);
  const float hot_x = (x - 0.36f) / 0.30f, hot_y = (y - 0.30f) / 0.34f;
  return 1.0f + 0.05f * (0.5f - y) - 0.03f * (x - 0.5f) - 0.30f * from_middle +
         0.10f * std::exp(-0.5f * (hot_x * hot_x + hot_y * hot_y));
}

}  // namespace

std::vector<float> paint_screen(int width, int height, std::uint64_t seed) {
  const std::array<float, 3> cloth = {linear_of(68), linear_of(105), linear_of(158)};
  std::vector<float> plate;
  plate.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const auto x = static_cast<float>(i), y = static_cast<float>(j);
      float k = evenness(x / static_cast<float>(width), y / static_cast<float>(height));
      k *= 1 + 0.012f * folds(x + 0.35f * y, 0.25f * y, 90, seed) +
           0.006f * folds(x, y, 23, seed + 1);
      // The weave: warp and weft of about two pixels, beating softly with the pixel grid.
      k *= 1 + 0.005f * std::sin(2.51f * x + 0.03f * y) + 0.005f * std::sin(2.37f * y - 0.02f * x) +
           0.008f * folds(x, y, 2.3f, seed + 2);
      const float warm = 1 + 0.02f * (x / static_cast<float>(width) - 0.5f);
      plate.push_back(k * warm * cloth[0]);
      plate.push_back(k * cloth[1]);
      plate.push_back(k / warm * cloth[2]);
    }
  }
  return plate;
}

Vec3 mean_colour(std::span<const float> plate) {
  std::array<double, 3> sum{};
  for (std::size_t i = 0; i < plate.size(); ++i) sum[i % 3] += plate[i];
  const double count = static_cast<double>(plate.size()) / 3;
  return {static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count),
          static_cast<float>(sum[2] / count)};
}

float light_at(int frame) {
  return 1 + 0.004f * std::sin(2 * std::numbers::pi_v<float> * static_cast<float>(frame) / 2300);
}

void expose(std::span<const float> linear, std::uint64_t seed, Image& out) {
  // The sum of four uniform 16-bit numbers is normal enough; its deviation is 65536 / sqrt(3).
  constexpr std::array<float, 3> sigma = {2.3f, 2.0f, 2.8f};
  constexpr float unit = 1.7320508f / 65536;
  const std::uint64_t stream = mix64(seed) << 24;
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const std::uint64_t h = mix64(stream + i);
    const auto sum =
        static_cast<float>((h & 0xffff) + ((h >> 16) & 0xffff) + ((h >> 32) & 0xffff) + (h >> 48));
    const float noise = (sum - 131070.0f) * unit * sigma[i % 3];
    const float code = std::clamp(code_of(linear[i]) + noise, 0.0f, 255.0f);
    out.rgba[i / 3 * 4 + i % 3] = static_cast<std::uint8_t>(code + 0.5f);
  }
}

}  // namespace vsprite::capture
