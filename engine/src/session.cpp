// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The loop that every small game shares.
#include "vsprite/session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include "vsprite/input.h"
#include "vsprite/record.h"

namespace vsprite {
namespace {

constexpr std::uint64_t kHeadlessFrames = 300;
constexpr int kMostTicks = 5;
constexpr double kShortestFrame = 1.0 / 125;  // drivers without vsync shall not burn a core

bool ends_with(const std::string& text, std::string_view ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

void smooth(double& value, double seen) { value += 0.1 * (seen - value); }

}  // namespace

struct Session::Impl {
  SessionConfig config;
  Window window;  // outlives the renderer
  Renderer renderer;
  FilmWriter film;
  std::optional<KeyScript> script;
  std::optional<Error> failure;
  std::uint64_t tick = 0;  // ticks made
  int due = 0, made = 0;   // ticks of this frame
  double owed = 0;         // seconds of play not yet made into ticks
  double frame_start = 0, frame_ms = 0, work_ms = 0;
  float resolution = 1;
  bool paused = false, step_once = false, closed = false, first = true;

  Impl(SessionConfig c, Window w, Renderer r)
      : config(std::move(c)), window(std::move(w)), renderer(std::move(r)) {}
  bool is_over() const { return config.frames > 0 && tick >= config.frames; }
  void count_due(double elapsed);
  void record();
};

Result<Session> Session::open(const SessionConfig& wanted) {
  SessionConfig config = wanted;
  if (config.headless && config.frames == 0) config.frames = kHeadlessFrames;
  std::optional<KeyScript> script;
  if (!config.keys.empty()) {
    Result<KeyScript> loaded = load_key_script(config.keys, config.fps);
    if (!loaded) return std::move(loaded).error();
    if (config.sprite != nullptr) {
      if (auto known = check_key_script(*config.sprite, *loaded); !known) return known.error();
    }
    script = std::move(*loaded);
  }
  const bool film = ends_with(config.record, ".mp4");
  if (!film && !config.record.empty() && !ends_with(config.record, ".png")) {
    return Error{ErrorCode::BadSetting, "--record " + config.record +
                                            ": a name that ends in .mp4 (film) or .png (last "
                                            "frame) is due"};
  }
  Result<Window> window = Window::open({.title = config.title,
                                        .width = config.width,
                                        .height = config.height,
                                        .full_screen = config.full_screen,
                                        .headless = config.headless});
  if (!window) return std::move(window).error();
  Result<Renderer> renderer = make_renderer(Window::gl_function, config.renderer);
  if (!renderer) return std::move(renderer).error();
  auto impl = std::make_unique<Impl>(config, std::move(*window), std::move(*renderer));
  impl->resolution = config.resolution;
  // The size of what is drawn into memory and filmed; films want even sides.
  const auto even = [&](int side) {
    const auto part = static_cast<int>(std::lround(config.resolution * static_cast<float>(side)));
    return config.resolution < 1 ? std::max(2, part / 2 * 2) : side;
  };
  impl->config.width = even(config.width);
  impl->config.height = even(config.height);
  impl->script = std::move(script);
  if (film) {
    auto opened =
        impl->film.open(config.record, impl->config.width, impl->config.height, config.fps);
    if (!opened) return std::move(opened).error();
  }
  return Session(std::move(impl));
}

Session::Session(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

void Session::Impl::count_due(double elapsed) {
  made = 0;
  due = std::exchange(step_once, false) ? 1 : 0;
  if (paused) return;
  if (config.headless) {
    due = 1;
    return;
  }
  owed += first ? 1 / config.fps : elapsed;
  first = false;
  due = static_cast<int>(std::min(owed * config.fps, double{kMostTicks}));
  owed = std::fmod(owed - due / config.fps, 1 / config.fps);
}

bool Session::next_frame() {
  Impl& m = *impl_;
  if (!m.window.pump() || m.closed || m.failure || m.is_over()) return false;
  const double now = m.window.seconds();
  const double elapsed = now - std::exchange(m.frame_start, now);
  smooth(m.frame_ms, elapsed * 1e3);
  m.count_due(elapsed);
  const bool own_size = m.config.headless || m.film.is_open();
  const auto part = [&](int side) {
    return side > 0 ? std::max(1, static_cast<int>(std::lround(m.resolution * float(side)))) : 0;
  };
  m.renderer.begin_frame(own_size ? m.config.width : part(m.window.width()),
                         own_size ? m.config.height : part(m.window.height()));
  return true;
}

bool Session::next_tick() {
  Impl& m = *impl_;
  if (m.made > 0) ++m.tick;  // the one before is done
  if (m.made == m.due || m.is_over()) {
    m.due = m.made;
    m.made = 0;
    return false;
  }
  ++m.made;
  return true;
}

void Session::Impl::record() {
  if (!film.is_open()) return;
  const Image picture = renderer.read_pixels();
  if (picture.width == 0) return;
  for (int i = 0; i < due && !failure; ++i) {
    if (auto added = film.add(picture); !added) failure = std::move(added).error();
  }
}

void Session::show() {
  Impl& m = *impl_;
  m.renderer.end_frame(m.window.width(), m.window.height());
  m.record();
  const double work = m.window.seconds() - m.frame_start;
  smooth(m.work_ms, work * 1e3);
  m.window.swap();
  const double spent = m.window.seconds() - m.frame_start;
  if (!m.config.headless && spent < kShortestFrame) {
    std::this_thread::sleep_for(std::chrono::duration<double>(kShortestFrame - spent));
  }
}

Result<void> Session::finish() {
  Impl& m = *impl_;
  if (m.failure) return *m.failure;
  if (m.film.is_open()) return m.film.close();
  if (m.config.record.empty()) return {};
  const Image picture = m.renderer.read_pixels();
  if (picture.width == 0) return {};
  return save_png(m.config.record, picture);
}

Direction Session::direction() const noexcept {
  return impl_->script ? impl_->script->at(impl_->tick) : impl_->window.input().direction();
}

bool Session::is_scripted() const noexcept { return impl_->script.has_value(); }
void Session::play_actions(const Sprite& sprite, Actor& actor) const noexcept {
  if (impl_->script) play_script(sprite, *impl_->script, impl_->tick, actor);
}

std::uint64_t Session::tick() const noexcept { return impl_->tick; }

float Session::fraction() const noexcept {
  return static_cast<float>(std::clamp(impl_->owed * impl_->config.fps, 0.0, 0.999));
}

double Session::seconds() const noexcept {
  return static_cast<double>(impl_->tick) / impl_->config.fps + impl_->owed;
}

double Session::frame_ms() const noexcept { return impl_->frame_ms; }
double Session::work_ms() const noexcept { return impl_->work_ms; }
void Session::set_resolution(float share) noexcept { impl_->resolution = share; }
void Session::set_paused(bool paused) noexcept { impl_->paused = paused; }
bool Session::is_paused() const noexcept { return impl_->paused; }
void Session::advance_one() noexcept { impl_->step_once = true; }
void Session::close() noexcept { impl_->closed = true; }
const Input& Session::input() const noexcept { return impl_->window.input(); }
Window& Session::window() noexcept { return impl_->window; }
Renderer& Session::renderer() noexcept { return impl_->renderer; }

}  // namespace vsprite
