// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/random.h - SplitMix64 (Steele, Lea, Flood 2014): the same numbers on every machine, which
// the standard's distributions do not promise.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vsprite {

inline constexpr std::uint64_t kGoldenGamma = 0x9E3779B97F4A7C15u;

/// A good 64-bit hash of a counter.
inline std::uint64_t mix64(std::uint64_t z) noexcept {
  z += kGoldenGamma;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

struct Random {
  std::uint64_t state = 0;  ///< any seed will do

  std::uint64_t next() noexcept {
    const std::uint64_t number = mix64(state);
    state += kGoldenGamma;
    return number;
  }
  /// Uniform in [0, bound), bound > 0; the bias (bound / 2^64) does not matter here.
  std::size_t below(std::size_t bound) noexcept { return next() % bound; }
  /// Uniform in [0, 1), 53 bits.
  double unit() noexcept { return static_cast<double>(next() >> 11) / 9007199254740992.0; }
};

}  // namespace vsprite
