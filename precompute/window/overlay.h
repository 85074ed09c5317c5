// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// overlay.h - Dear ImGui over a window of ours, and the loop that draws it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "vsprite/draw.h"
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

/// What a window of the tool shows, and what its keys do.
class Scene {
 public:
  virtual ~Scene() = default;
  virtual bool is_closed() const = 0;
  virtual Result<void> press(int key) = 0;  ///< SDL_Keycode
  /// Over an Overlay that was begun. `passed`: seconds since the last picture.
  virtual void draw(Renderer& renderer, double passed, float ui_scale) = 0;
  virtual Result<void> act_on_click() = 0;  ///< on what was clicked in the picture drawn last
};

struct LoopOptions {
  bool headless = false;     ///< a 60th of a second passes from picture to picture
  int frames = 0;            ///< pictures drawn until it ends; 0: until closed
  std::string screenshot{};  ///< PNG of the last picture; empty: none
};

/// Draws until the window or the scene is closed. Errors: those of the scene and of save_png.
Result<void> run_scene(Window& window, Renderer& renderer, Scene& scene,
                       const LoopOptions& options);

}  // namespace vsprite::window
