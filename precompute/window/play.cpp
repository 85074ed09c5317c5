// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// What `vsprite play` shows.
#include "window/play.h"

#include "vsprite/sdl.h"

namespace vsprite {

std::string describe_directions(const Sprite&, const std::string&) { return {}; }

Result<void> play_window(const Sprite&, const PlayOptions& options) {
  Result<Window> window = Window::open({.title = options.title, .headless = options.headless});
  if (!window) return std::move(window).error();
  return {};
}

}  // namespace vsprite
