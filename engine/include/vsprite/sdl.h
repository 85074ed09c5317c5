// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/sdl.h - the way from a Window to SDL2, for games that ask SDL for more: the one header
// that names it, opt-in.
#pragma once

#include "vsprite/window.h"

struct SDL_Window;

namespace vsprite {

inline SDL_Window* sdl_window(const Window& window) noexcept {
  return static_cast<SDL_Window*>(window.handle());
}

}  // namespace vsprite
