// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// random.h - the tank's own dice and waves: the same on every machine, no libm.
#pragma once

#include <cstdint>

namespace aquarium {

/// SplitMix64: one add and three mixes a number.
struct Random {
  std::uint64_t state = 0;

  std::uint64_t next() noexcept {
    std::uint64_t z = (state += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  /// [0, count). Pre: count > 0. The bias of the remainder is below 2^-50 here.
  int below(int count) noexcept {
    return static_cast<int>((next() >> 11) % static_cast<std::uint64_t>(count));
  }
  /// [low, high).
  float between(float low, float high) noexcept {
    const float unit = static_cast<float>(next() >> 40) * (1.0f / 16777216.0f);
    return low + (high - low) * unit;
  }
};

/// A sine in all but name: period 1, range -1..1, two parabolas. Exact arithmetic, so replays
/// agree.
inline float wave(float turns) noexcept {
  const float t = 2.0f * (turns - static_cast<float>(static_cast<int>(turns))) - 1.0f;
  return -4.0f * t * (1.0f - (t < 0 ? -t : t));
}

}  // namespace aquarium
