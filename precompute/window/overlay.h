// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// overlay.h - Dear ImGui over a window of ours.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "vsprite/result.h"
#include "vsprite/sdl.h"

union SDL_Event;

namespace vsprite::window {

/// Sees the events that the window takes, and hands on the keys in the order in which they were
/// pressed. One at a time; the window outlives it.
class Overlay {
 public:
  explicit Overlay(Window& window);
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;
  ~Overlay();

  /// What lengths laid out for 1280 x 760 are multiplied by.
  static float ui_scale(const Window& window);
  void begin();
  /// Draws it over what is there.
  void end();
  std::vector<int> take_keys() { return std::exchange(keys_, {}); }  ///< SDL_Keycode

 private:
  static int watch(void* self, SDL_Event* event);
  std::vector<int> keys_;
};

/// What the window shows, words and all, as PNG. Errors: those of save_png.
Result<void> save_window(const Window& window, const std::string& path);

}  // namespace vsprite::window
