// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/light.h"

namespace vsprite::detail {
namespace {

// v^(12/5) = v^2 (v^2)^(1/5); the fifth root by Newton's rounds, the same on every machine.
double transfer(double encoded) {
  if (encoded <= 0.04045) return encoded / 12.92;
  const double v = (encoded + 0.055) / 1.055;
  const double square = v * v;
  double root = 1;
  for (int round = 0; round < 40; ++round) {
    const double fourth = root * root * root * root;
    root = (4 * root + square / fourth) / 5;
  }
  return square * root;
}

}  // namespace

const std::array<float, 1021>& linear_of_sums() noexcept {
  static const std::array<float, 1021> table = [] {
    std::array<float, 1021> made{};
    for (int s = 0; s <= 1020; ++s)
      made[static_cast<std::size_t>(s)] = static_cast<float>(transfer(s / 1020.0));
    return made;
  }();
  return table;
}

const std::array<std::uint8_t, 65536>& encoded_of_steps() noexcept {
  static const std::array<std::uint8_t, 65536> table = [] {
    std::array<std::uint8_t, 65536> made{};
    int code = 0;
    for (int i = 0; i < 65536; ++i) {
      while (code < 255 && transfer((code + 0.5) / 255) < i / 65535.0) ++code;
      made[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(code);
    }
    return made;
  }();
  return table;
}

}  // namespace vsprite::detail
