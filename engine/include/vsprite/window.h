// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/window.h - a window with an OpenGL context, keys, mouse, game pad and sound: by SDL2 on a
// desktop.
//
// Opt-in: a game that has a window of its own needs only draw.h. Events go into `Input`, the
// engine's own state; held keys are never read from the device, so that a run can be recorded and
// replayed.
//
//     Window window = *Window::open({.title = "hello"});
//     while (window.pump()) { ... window.input().direction() ... window.swap(); }
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "vsprite/geometry.h"
#include "vsprite/input.h"
#include "vsprite/result.h"

namespace vsprite {

struct WindowConfig {
  std::string title = "vsprite";
  int width = 1280;  ///< in the units of the desktop
  int height = 720;
  bool full_screen = false;
  bool headless = false;  ///< no display is asked for: draws into memory (SDL's offscreen driver)
  bool vsync = true;
  bool es = false;  ///< OpenGL ES 3 is asked for first, as phones and browsers have it
};

/// Keys other than the steering ones: lower-case ASCII ('p', 'm', ' '), or one of these.
enum KeyCode : int { kKeyEnter = 13, kKeyEscape = 27, kKeyF1 = 0x101, kKeyF11 = 0x10b };

/// What the player does. Arrow keys, W A S D, pad stick and d-pad steer.
struct Input {
  KeyState keys;                      ///< arrows and W A S D
  Direction stick = Direction::None;  ///< of the pad, dead zone and hysteresis applied
  Vec2 pointer;                       ///< window pixels (drawable, not desktop units)
  bool pointer_held = false;          ///< left button, or a finger
  bool focused = true;
  std::vector<int> pressed;      ///< KeyCodes pressed since the last pump, repeats left out
  bool pointer_pressed = false;  ///< went down since the last pump

  /// The held keys, or else the pad; None if nothing is held.
  Direction direction() const noexcept;
  bool was_pressed(int key) const noexcept;
};

/// The sector of a stick at (x, y) in [-1, 1]: None inside the dead zone of radius 0.25, else one
/// of eight 45 degree sectors; `before` is kept until the stick is 5 degrees past its border.
Direction stick_direction(Vec2 stick, Direction before) noexcept;

/// One window and its context, current in the thread that opened it. Close the Renderer first.
class Window {
 public:
  /// Errors: Unavailable: no display, or no OpenGL 3.3 (the sentence says what to do).
  static Result<Window> open(const WindowConfig& config = {});
  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;
  ~Window();

  /// Takes the waiting events. False once the window was asked to close. Losing the focus releases
  /// every key. F11 toggles full screen by itself; pads may come and go.
  bool pump();
  const Input& input() const noexcept;
  void swap();
  void toggle_full_screen();
  void set_title(const std::string& title);

  int width() const noexcept;  ///< drawable pixels, also on displays of high density; may be 0
  int height() const noexcept;
  float pixel_scale() const noexcept;  ///< drawable pixels per desktop unit; scale text by it
  double seconds() const noexcept;     ///< monotonic, since the window was opened
  bool headless() const noexcept;
  void* handle() const noexcept;  ///< of the platform: see vsprite/sdl.h
  /// For make_renderer: functions of the current context.
  static void* gl_function(const char* name);

  struct Impl;
  explicit Window(std::unique_ptr<Impl> impl) noexcept;

 private:
  std::unique_ptr<Impl> impl_;
};

/// Sound: `fill` is called from a thread of its own for mono samples in [-1, 1] whenever the device
/// wants them.
class Audio {
 public:
  Audio() noexcept;
  Audio(Audio&&) noexcept;
  Audio& operator=(Audio&&) noexcept;
  ~Audio();  ///< stops the callback first

  /// False if the machine has no sound device: not an error. `rate` in samples per second.
  bool open(std::function<void(std::span<float>)> fill, int rate = 48000);
  bool is_open() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsprite
