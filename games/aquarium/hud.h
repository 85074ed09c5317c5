// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// hud.h - what lies on the glass: key hints, score, time, pause, end of a round, overlay.
#pragma once

#include <array>
#include <string>

#include "light.h"
#include "scene.h"
#include "vsprite/draw.h"

namespace aquarium {

/// Frame times of the last two seconds or so, for the overlay and the choice of quality.
class FrameTimes {
 public:
  static constexpr std::size_t kCount = 120;
  void add(float milliseconds) noexcept;
  float mean(std::size_t last) const noexcept;
  float worst() const noexcept;
  /// How many of the `last` took longer than that.
  std::size_t slower_than(float milliseconds, std::size_t last) const noexcept;
  /// `age` 0 is the newest.
  float at(std::size_t age) const noexcept;
  std::size_t count() const noexcept { return filled_; }
  void clear() noexcept { filled_ = 0; }

 private:
  std::array<float, kCount> ring_{};
  std::size_t next_ = 0;
  std::size_t filled_ = 0;
};

/// What the HUD shows beside the world.
struct HudState {
  bool overlay = false;
  bool muted = false;
  int best = 0;
  bool new_best = false;
  float hint_seconds = -1;  ///< since the first key was pressed; below 0: not yet
  float transition_cost = 0;
  FrameTimes frame_times;
};

void draw_hud(vsprite::Renderer& renderer, const Moment& moment, const HudState& state,
              Quality quality);

}  // namespace aquarium
