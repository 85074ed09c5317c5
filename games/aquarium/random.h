// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// random.h - the tank's own dice and waves: the same on every machine, no libm.
#pragma once

#include "vsprite/random.h"

namespace aquarium {

struct Random : vsprite::Random {
  /// [0, count). Pre: count > 0.
  int below(int count) noexcept {
    return static_cast<int>(vsprite::Random::below(static_cast<std::size_t>(count)));
  }
  /// [low, high).
  float between(float low, float high) noexcept {
    return low + (high - low) * (static_cast<float>(next() >> 40) * (1.0f / 16777216.0f));
  }
};

/// A sine in all but name: period 1, range -1..1, two parabolas. Exact arithmetic, so replays
/// agree.
inline float wave(float turns) noexcept {
  const float t = 2.0f * (turns - static_cast<float>(static_cast<int>(turns))) - 1.0f;
  return -4.0f * t * (1.0f - (t < 0 ? -t : t));
}

}  // namespace aquarium
