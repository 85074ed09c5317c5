// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// key.h - the window behind `vsprite segment --window`: the film beside what is cut out of it, the
// screen's colour and four corrections, and the command line that does the same.
#pragma once

#include <functional>
#include <string>

#include "tool/settings.h"
#include "vsprite/image.h"

namespace vsprite {

struct KeyWindowOptions {
  Image background{};        ///< what the cut-out lies over at first; stretched over the frame
  bool headless = false;     ///< draws into memory, and waits for what is keyed
  int frames = 0;            ///< pictures drawn until it ends; 0: until closed
  std::string screenshot{};  ///< PNG of the last picture; empty: none
  int width = 1280;          ///< desktop units
  int height = 760;
  /// Called when a cut-out was saved, with a line about it.
  std::function<void(const std::string&)> saved{};
};

struct KeyChoice {
  Settings settings;  ///< as they were when the window was closed
  bool run = false;   ///< the film is to be cut with them
};

/// The command line that keys as `settings` say.
std::string key_command(const Settings& settings);

/// Returns when the window was closed. `settings`: film and where it begins.
/// Errors: Unavailable (no display), those of sample_frames, CannotWrite (the screenshot),
/// BadSetting.
Result<KeyChoice> key_window(const Settings& settings, const KeyWindowOptions& options);

}  // namespace vsprite
