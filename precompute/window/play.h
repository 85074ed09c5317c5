// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// play.h - the window behind `vsprite play`: a character on a plain floor that answers keys, mouse
// and pad, so that a designer sees within seconds what a film is good for.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "vsprite/actor.h"
#include "vsprite/result.h"
#include "vsprite/show.h"
#include "vsprite/sprite.h"

namespace vsprite {

struct PlayOptions {
  std::string mode{};        ///< name of a ControlMode; empty: the pack's first
  bool headless = false;     ///< no display: draws into memory, one frame a tick
  std::uint64_t frames = 0;  ///< ticks until it ends; 0: until closed (headless: 300)
  std::string keys{};    ///< key script or the name of a file with one; empty: the player's keys
  std::string record{};  ///< film (.mp4) or picture of the last frame (.png); empty: nothing
  std::string screenshot{};  ///< picture of the last frame (.png), beside a film; empty: nothing
  std::uint64_t seed = 0;    ///< drives variety only
  int fade = kFadeAuto;      ///< ticks over which a jump is cross-faded (vsprite/show.h)
  std::string title{};       ///< of the window; empty: the sprite's name
  bool overlay = false;      ///< starts with the F1 overlay shown
  int width = 1280;          ///< px
  int height = 720;
  std::function<void(const Actor&)> after_tick{};  ///< told of every state; empty: nobody is
  std::string watched{};  ///< the pack's file, taken over when it is rebuilt; empty: it never is
  std::function<void(const std::string&)> tell{};  ///< told what came of a rebuilt pack
};

/// Which commands the mode cannot follow and what it does instead, a line each, for stdout; empty
/// if all eight directions are served. `mode` as in PlayOptions.
std::string describe_directions(const Sprite& sprite, const std::string& mode = {});

/// Opens the window and returns when it was closed.
/// Errors: BadSetting (no such mode, bad script), Unavailable (no display, no OpenGL, no ffmpeg),
/// CannotCreate, CannotWrite (recording).
Result<void> play_window(const Sprite& sprite, const PlayOptions& options);

}  // namespace vsprite
