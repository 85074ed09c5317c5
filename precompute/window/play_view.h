// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// play_view.h - what the play window shows, and the code that draws it. Decides nothing.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "vsprite/actor.h"
#include "vsprite/draw.h"
#include "vsprite/result.h"
#include "vsprite/session.h"
#include "vsprite/sprite.h"
#include "vsprite/stream.h"

namespace vsprite::window {

inline constexpr int kGroundCount = 4;
inline constexpr std::size_t kHistory = 150;

/// One frame's worth of facts.
struct PlayState {
  Actor actor{};
  ActorFade fade{};
  Vec2 camera{};   ///< world px in the middle of the frame
  float zoom = 1;  ///< frame px per world px
  int ground = 0;  ///< kind of background, 0..kGroundCount-1
  bool overlay = false;
  bool has_target = false;  ///< the pointer is held
  Vec2 target{};            ///< world px
  Direction command = Direction::None;
  float hint = 1;                       ///< how much of the drawn keys is seen
  std::array<float, kHistory> costs{};  ///< of the last ticks, ring; negative: natural continuation
  std::size_t cost_head = 0;
  std::uint64_t jumps = 0;
  float last_cost = 0;  ///< of the last jump
  std::string title;
  std::string subtitle;
  std::string warning;  ///< directions that cannot be steered, one line
  std::string notice;   ///< about the command that is held, or empty
};

/// Grid spacing, world px: a whole number, and the world may be shifted by 4 of them unseen.
int grid_spacing(const Sprite& sprite) noexcept;

class PlayView {
 public:
  static Result<PlayView> make(Renderer& renderer);
  void draw(Session& session, const Sprite& sprite, FrameCache& frames, const PlayState& state);

 private:
  Effect floor_{};
};

}  // namespace vsprite::window
