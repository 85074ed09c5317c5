// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/session.h - one run of a small game: a window, a renderer, ticks of the film's rate at
// any display rate, keys held or scripted, and a film of it all.
//
//     while (session.next_frame()) {
//       while (session.next_tick()) { set_direction(sprite, actor, session.direction());
//       step(sprite, actor); }
//       ... draw with session.renderer(), between two ticks at session.fraction() ...
//       session.show();
//     }
//     return session.finish();
//
// Headless, a frame is a tick and time does not matter: the same script gives the same film.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "vsprite/draw.h"
#include "vsprite/geometry.h"
#include "vsprite/result.h"
#include "vsprite/window.h"

namespace vsprite {

struct Actor;
class Sprite;

struct SessionConfig {
  std::string title = "vsprite";
  int width = 1280;  ///< of the window; headless and films: of the frame, pixels
  int height = 720;
  float resolution = 1;   ///< share of width and height that frames have at first, (0, 1]
  double fps = 30;        ///< ticks per second, Sprite::fps()
  bool headless = false;  ///< draws into memory
  bool full_screen = false;
  std::uint64_t frames = 0;  ///< ticks until it ends; 0: until closed (headless: 300)
  std::string keys{};    ///< a key script, or the name of a file with one; empty: the player's keys
  const Sprite* sprite = nullptr;  ///< whose actions the script plays: open() refuses any other
  std::string record{};  ///< .mp4: a film; .png: the last frame; empty: nothing
  RendererConfig renderer{};
};

class Session {
 public:
  /// Errors: those of Window::open, make_renderer, load_key_script, check_key_script and
  /// FilmWriter::open.
  static Result<Session> open(const SessionConfig& config);
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  /// Takes events and begins a frame of the window's size (while a film is written, of the film's).
  /// False when the run is over.
  bool next_frame();
  /// True once for every tick that is due before this frame: at most 5, so that a slow machine
  /// plays slower, not jerkier.
  bool next_tick();
  /// Encodes the frame, shows it, adds it to the film.
  void show();
  /// Ends the film. Errors: CannotWrite, also of what failed earlier.
  Result<void> finish();

  Direction direction() const noexcept;  ///< scripted, or the player's
  bool is_scripted() const noexcept;
  /// Does what the script says of actions in this tick: before the step. Without a script nothing.
  void play_actions(const Sprite& sprite, Actor& actor) const noexcept;
  std::uint64_t tick() const noexcept;  ///< the tick being made: 0 in the first next_tick()
  float fraction() const noexcept;      ///< of a tick that has passed since the last one, [0, 1)
  double seconds() const noexcept;      ///< of play: ticks and fraction
  double frame_ms() const noexcept;     ///< from frame to frame, smoothed
  double work_ms() const noexcept;      ///< of that, until show(), smoothed
  /// Frames of this share of the window's width and height, (0, 1], stretched over the window: for
  /// slow machines. From the next frame on; headless runs and films keep that of the config.
  void set_resolution(float share) noexcept;
  void set_paused(bool paused) noexcept;
  bool is_paused() const noexcept;
  void advance_one() noexcept;  ///< one tick although paused
  void close() noexcept;        ///< the next next_frame() is false
  const Input& input() const noexcept;
  Window& window() noexcept;
  Renderer& renderer() noexcept;

  struct Impl;
  explicit Session(std::unique_ptr<Impl> impl) noexcept;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsprite
