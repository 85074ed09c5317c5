// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The loop of the points window: keys and mouse change the points, changed points are fitted anew.
#include "window/points.h"

#include <SDL_keycode.h>

#include <filesystem>
#include <optional>

#include "vsprite/draw.h"
#include "vsprite/sdl.h"
#include "window/overlay.h"
#include "window/points_view.h"

namespace vsprite {
namespace {

using window::PointsAction;

/// With Ctrl or without.
std::optional<PointsAction> action_of(int key) {
  switch (key) {
    case SDLK_u:
    case SDLK_z:
      return PointsAction::Undo;
    case SDLK_r:
    case SDLK_y:
      return PointsAction::Redo;
    case SDLK_DELETE:
    case SDLK_BACKSPACE:
      return PointsAction::Erase;
    case SDLK_f:
      return PointsAction::Flip;
    case SDLK_m:
      return PointsAction::Mesh;
    case SDLK_g:
      return PointsAction::Grid;
    case SDLK_t:
      return PointsAction::Layer;
    case SDLK_s:
      return PointsAction::Save;
    case SDLK_SPACE:
      return PointsAction::Play;
    case SDLK_F1:
      return PointsAction::Help;
    case SDLK_ESCAPE:
      return PointsAction::Quit;
    default:
      return std::nullopt;
  }
}

class Placing : public window::Scene {
 public:
  Placing(PointsFile& file, PointsEdit& edit, const PointsWindowOptions& options)
      : file_(file), edit_(edit), options_(options), view_("Place the points") {
    look_.sheet = options.first_sheet;
  }

  bool is_closed() const override { return closed_; }
  Result<void> press(int key) override;
  void draw(Renderer& renderer, double passed, float ui_scale) override;
  Result<void> act_on_click() override;

 private:
  void act(PointsAction action);
  void go_to_sheet(int by);
  void nudge(float x, float y);
  void save();
  bool say(const Result<void>& done, const char* what);

  PointsFile& file_;
  PointsEdit& edit_;
  const PointsWindowOptions& options_;
  window::PointsView view_;
  window::PuppetPreview preview_;
  window::PointsLook look_;
  std::optional<PointsAction> clicked_;
  bool warned_ = false, closed_ = false;
};

bool Placing::say(const Result<void>& done, const char* what) {
  look_.said = done ? what : done.error().message;
  return static_cast<bool>(done);
}

void Placing::save() {
  if (edit_.is_saved()) {
    look_.said = "Nothing has changed since " + file_.path() + " was saved.";
    return;
  }
  if (auto saved = file_.save(edit_); !saved) {
    look_.said = "Not saved: " + saved.error().message;
    return;
  }
  const std::string count = std::to_string(edit_.point_count()) + " points in " +
                            std::to_string(edit_.sheet_count()) + " views";
  look_.said = "Saved: " + file_.path() + ", " + count + ".";
  if (options_.saved) options_.saved(file_.path() + ": " + count + " saved");
}

void Placing::go_to_sheet(int by) {
  const std::size_t count = edit_.sheet_count();
  look_.sheet = (look_.sheet + (by > 0 ? 1 : count - 1)) % count;
  look_.said.clear();
}

void Placing::nudge(float x, float y) {
  if (!look_.selected || *look_.selected >= edit_.point_count() || edit_.held()) return;
  const Vec2 at = edit_.points(look_.sheet, look_.layer)[*look_.selected];
  say(edit_.move_to(look_.sheet, look_.layer, *look_.selected, {at.x + x, at.y + y}), "");
}

void Placing::act(PointsAction action) {
  const bool asks_again = warned_;
  warned_ = false;
  look_.said.clear();
  switch (action) {
    case PointsAction::Undo:
      look_.said = edit_.undo() ? "Taken back." : "There is nothing to undo.";
      break;
    case PointsAction::Redo:
      look_.said = edit_.redo() ? "Done again." : "There is nothing to redo.";
      break;
    case PointsAction::Erase:
      if (look_.selected && say(edit_.erase(*look_.selected), "")) look_.selected.reset();
      break;
    case PointsAction::Flip:
      if (const auto edge = edit_.edge_at(look_.sheet, look_.layer, look_.mouse, view_.reach());
          edge && look_.is_over)
        say(edit_.flip((*edge)[0], (*edge)[1]), "The edge is flipped, and the mesh kept.");
      else
        look_.said = "No edge lies under the mouse.";
      break;
    case PointsAction::Mesh:
      if (edit_.has_own_faces())
        say(edit_.free_mesh(), "The mesh is made from the points again.");
      else
        say(edit_.keep_mesh(), "The mesh is kept: no point changes it, F and Ctrl+click do.");
      break;
    case PointsAction::Grid:
      look_.mesh = !look_.mesh;
      break;
    case PointsAction::Layer:
      look_.layer = look_.layer == PointLayer::Picture ? PointLayer::Pose : PointLayer::Picture;
      if (!edit_.has_pose(look_.sheet)) look_.said = "In this view the two are the same.";
      break;
    case PointsAction::Save:
      save();
      break;
    case PointsAction::Play:
      preview_.playing = !preview_.playing;
      break;
    case PointsAction::Help:
      look_.help = !look_.help;
      break;
    case PointsAction::Quit:
      closed_ = edit_.is_saved() || asks_again;
      warned_ = !closed_;
      if (!closed_)
        look_.said = "The points are not saved: S saves them, Escape again ends without.";
      break;
  }
}

Result<void> Placing::press(int key) {
  if (const auto action = action_of(key)) act(*action);
  switch (key) {
    case SDLK_PAGEUP:
      go_to_sheet(-1);
      break;
    case SDLK_PAGEDOWN:
      go_to_sheet(1);
      break;
    case SDLK_LEFT:
      nudge(-1, 0);
      break;
    case SDLK_RIGHT:
      nudge(1, 0);
      break;
    case SDLK_UP:
      nudge(0, -1);
      break;
    case SDLK_DOWN:
      nudge(0, 1);
      break;
    default:
      break;
  }
  return {};
}

void Placing::draw(Renderer& renderer, double passed, float ui_scale) {
  preview_.follow(renderer, edit_, passed);
  clicked_ = view_.draw(renderer, edit_, preview_, look_, ui_scale);
}

Result<void> Placing::act_on_click() {
  if (clicked_) act(*clicked_);
  return {};
}

}  // namespace

Result<void> points_window(PointsFile& file, PointsEdit& edit, const PointsWindowOptions& options) {
  auto window = Window::open({.title = "vsprite points",
                              .width = options.width,
                              .height = options.height,
                              .headless = options.headless});
  if (!window)
    return Error{window.error().code,
                 window.error().message +
                     "; or place the points without one: in the file, by --import or --script"};
  auto renderer = make_renderer(Window::gl_function);
  if (!renderer) return renderer.error();
  Placing placing(file, edit, options);
  return window::run_scene(*window, *renderer, placing,
                           {options.headless, options.frames, options.screenshot});
}

}  // namespace vsprite
