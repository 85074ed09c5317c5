// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The loop of the label window: keys become actions, an action is done before anything is drawn.
#include "window/label.h"

#include <algorithm>
#include <optional>

#include "vsprite/draw.h"
#include "vsprite/sdl.h"
#include "window/label_view.h"
#include "window/overlay.h"

namespace vsprite {
namespace {

using window::LabelAction;
using window::LabelKeys;
using window::LabelLook;

class Sitting : public window::Scene {
 public:
  Sitting(LabelSession& session, LabelKeys keys, const LabelWindowOptions& options)
      : session_(session), keys_(keys), options_(options), view_(session) {}

  /// Before the first picture.
  Result<void> begin() { return view_.show(); }
  bool is_closed() const override { return closed_; }
  Result<void> press(int key) override;
  void draw(Renderer& renderer, double passed, float ui_scale) override;
  Result<void> act_on_click() override;

 private:
  Result<void> act(LabelAction action);
  Result<void> answer(bool smooth);
  Result<void> step_back(bool undo);

  LabelSession& session_;
  LabelKeys keys_;
  const LabelWindowOptions& options_;
  window::LabelView view_;
  LabelLook look_;
  std::optional<LabelAction> clicked_;
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

Result<void> Sitting::press(int key) {
  const auto action = keys_.action_of(key);
  return action ? act(*action) : Result<void>();
}

void Sitting::draw(Renderer& renderer, double passed, float ui_scale) {
  clicked_ = view_.draw(renderer, keys_, look_, passed, ui_scale);
}

Result<void> Sitting::act_on_click() { return clicked_ ? act(*clicked_) : Result<void>(); }

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
  Sitting sitting(session, *keys, options);
  if (auto shown = sitting.begin(); !shown) return shown;
  return window::run_scene(*window, *renderer, sitting,
                           {options.headless, options.frames, options.screenshot});
}

}  // namespace vsprite
