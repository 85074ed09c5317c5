// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The loop of the label window: keys become actions, an action is done before anything is drawn.
#include "window/label.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "vsprite/draw.h"
#include "vsprite/sdl.h"
#include "window/label_view.h"
#include "window/overlay.h"

namespace vsprite {
namespace {

using window::LabelAction;
using window::LabelKeys;
using window::LabelLook;
using window::Overlay;

constexpr double kShortestFrame = 1.0 / 61;
class Sitting {
 public:
  Sitting(LabelSession& session, LabelKeys keys, const LabelWindowOptions& options)
      : session_(session), keys_(keys), options_(options), view_(session) {}

  Result<void> run(Window& window, Renderer& renderer);

 private:
  Result<void> act(LabelAction action);
  Result<void> answer(bool smooth);
  Result<void> step_back(bool undo);

  LabelSession& session_;
  LabelKeys keys_;
  const LabelWindowOptions& options_;
  window::LabelView view_;
  LabelLook look_;
  bool closed_ = false;
};

Result<void> Sitting::answer(bool smooth) {
  if (!session_.current()) return {};
  const auto pair = *session_.current();
  if (auto kept = session_.answer(smooth); !kept) return kept;
  const std::string what = std::to_string(pair.i) + "," + std::to_string(pair.j) +
                           (smooth ? " smooth" : " visible jump");
  if (options_.kept) options_.kept(what);
  look_.said = "Saved: " + std::string(smooth ? "smooth" : "a visible jump") + ".";
  return view_.show();
}

Result<void> Sitting::step_back(bool undo) {
  const auto done = undo ? session_.undo() : session_.redo();
  if (!done) return done.error();
  look_.said = *done ? (undo ? "Taken back." : "Given again.")
                     : (undo ? "There is nothing to undo." : "There is nothing to redo.");
  return *done ? view_.show() : Result<void>();
}

Result<void> Sitting::act(LabelAction action) {
  const bool guess = session_.current() && session_.current()->guess_smooth();
  switch (action) {
    case LabelAction::Accept:
      return answer(guess);
    case LabelAction::Flip:
      return answer(!guess);
    case LabelAction::Undo:
    case LabelAction::Redo:
      return step_back(action == LabelAction::Undo);
    case LabelAction::Skip:
      session_.skip();
      look_.said = "Passed over.";
      return view_.show();
    case LabelAction::Slower:
    case LabelAction::Faster: {
      const float by = action == LabelAction::Faster ? 1.25f : 0.8f;
      look_.speed = std::clamp(look_.speed * by, window::kSlowest, window::kFastest);
      return {};
    }
    case LabelAction::Background:
      look_.ground = (look_.ground + 1) % window::kLabelGrounds;
      return {};
    case LabelAction::Help:
      look_.help = !look_.help;
      return {};
    case LabelAction::Quit:
      closed_ = true;
      return {};
  }
  return {};
}

Result<void> Sitting::run(Window& window, Renderer& renderer) {
  Overlay overlay(window);
  if (auto shown = view_.show(); !shown) return shown;
  double last = window.seconds();
  for (int drawn = 0; window.pump() && !closed_; ++drawn) {
    if (options_.frames > 0 && drawn >= options_.frames) break;
    for (const int key : overlay.take_keys())
      if (const auto action = keys_.action_of(key))
        if (auto done = act(*action); !done) return done;
    const double now = window.seconds();
    const double passed = options_.headless ? 1.0 / 60 : std::min(now - last, 0.1);
    last = now;
    renderer.begin_frame(window.width(), window.height());
    overlay.begin();
    const auto clicked = view_.draw(renderer, keys_, look_, passed, Overlay::ui_scale(window));
    renderer.end_frame(window.width(), window.height());
    overlay.end();
    const bool last_picture = options_.frames > 0 && drawn + 1 == options_.frames;
    if (last_picture && !options_.screenshot.empty())
      if (auto saved = window::save_window(window, options_.screenshot); !saved) return saved;
    window.swap();
    if (clicked)
      if (auto done = act(*clicked); !done) return done;
    const double spent = window.seconds() - now;
    if (!options_.headless && spent < kShortestFrame)
      std::this_thread::sleep_for(std::chrono::duration<double>(kShortestFrame - spent));
  }
  return {};
}

}  // namespace

Result<void> label_window(LabelSession& session, const LabelWindowOptions& options) {
  auto keys = LabelKeys::parse(options.bind);
  if (!keys) return keys.error();
  auto window = Window::open({.title = "vsprite label",
                              .width = options.width,
                              .height = options.height,
                              .headless = options.headless});
  if (!window)
    return Error{window.error().code,
                 window.error().message + "; or give the answers without one: --answers FILE"};
  auto renderer = make_renderer(Window::gl_function);
  if (!renderer) return renderer.error();
  return Sitting(session, *keys, options).run(*window, *renderer);
}

}  // namespace vsprite
