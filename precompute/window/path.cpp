// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The loop of the path window: keys and mouse change the path, a changed path is searched anew.
#include "window/path.h"

#include <SDL_keycode.h>

#include <cmath>
#include <optional>

#include "tool/files.h"
#include "vsprite/draw.h"
#include "vsprite/sdl.h"
#include "window/overlay.h"
#include "window/path_view.h"

namespace vsprite {
namespace {

using window::PathAction;
using window::PathLook;

/// With Ctrl or without.
std::optional<PathAction> action_of(int key) {
  switch (key) {
    case SDLK_SPACE:
      return PathAction::Play;
    case SDLK_LEFT:
      return PathAction::Back;
    case SDLK_RIGHT:
      return PathAction::On;
    case SDLK_u:
    case SDLK_z:
      return PathAction::Undo;
    case SDLK_r:
    case SDLK_y:
      return PathAction::Redo;
    case SDLK_c:
      return PathAction::Clear;
    case SDLK_DELETE:
    case SDLK_BACKSPACE:
      return PathAction::Erase;
    case SDLK_s:
      return PathAction::Save;
    case SDLK_F1:
      return PathAction::Help;
    case SDLK_ESCAPE:
      return PathAction::Quit;
    default:
      return std::nullopt;
  }
}

/// A path of the picture as it runs on the floor, where there is one.
std::vector<Vec2> on_floor(std::vector<Vec2> points, const PathPicture& picture) {
  if (picture.floor)
    for (Vec2& p : points) p = to_ground(*picture.floor, p);
  return points;
}

class Drawing : public window::Scene {
 public:
  Drawing(const Sprite& sprite, PathEdit& edit, const PathWindowOptions& options)
      : edit_(edit),
        options_(options),
        view_(sprite, options),
        search_(sprite, options.weights, options.beam, options.jobs) {}

  bool is_closed() const override { return closed_; }
  Result<void> press(int key) override;
  void draw(Renderer& renderer, double passed, float ui_scale) override;
  Result<void> act_on_click() override;

 private:
  void act(PathAction action);
  void step(int by);
  void save();
  void follow_search();

  PathEdit& edit_;
  const PathWindowOptions& options_;
  window::PathView view_;
  window::PathSearch search_;
  PathLook look_;
  std::optional<PathAction> clicked_;
  std::vector<Vec2> asked_;  ///< the path that is searched
  bool pending_ = false;     ///< nothing was found for it yet
  bool warned_ = false, closed_ = false;
};

void Drawing::save() {
  const std::string count = std::to_string(edit_.points().size()) + " points";
  if (auto wrote = write_file(options_.script, format_path(edit_.points(), options_.head));
      !wrote) {
    look_.said = "Not saved: " + wrote.error().message;
    return;
  }
  edit_.mark_saved();
  look_.said = "Saved: " + options_.script + ", " + count + ".";
  if (options_.saved) options_.saved(options_.script + ": " + count + " saved");
}

void Drawing::step(int by) {
  look_.playing = false;
  const std::size_t count = look_.found ? look_.found->clip.ticks.size() : 0;
  if (count == 0) return;
  const auto all = static_cast<double>(count);
  look_.tick = std::fmod(std::floor(look_.tick) + by + all, all);
}

void Drawing::act(PathAction action) {
  const bool asks_again = warned_;
  warned_ = false;
  look_.said.clear();
  switch (action) {
    case PathAction::Play:
      look_.playing = !look_.playing;
      break;
    case PathAction::Back:
    case PathAction::On:
      step(action == PathAction::On ? 1 : -1);
      break;
    case PathAction::Undo:
      look_.selected.reset();
      look_.said = edit_.undo() ? "Taken back." : "There is nothing to undo.";
      break;
    case PathAction::Redo:
      look_.selected.reset();
      look_.said = edit_.redo() ? "Done again." : "There is nothing to redo.";
      break;
    case PathAction::Clear:
      look_.selected.reset();
      edit_.clear();
      break;
    case PathAction::Erase:
      if (look_.selected && *look_.selected < edit_.points().size()) edit_.erase(*look_.selected);
      look_.selected.reset();
      break;
    case PathAction::Save:
      save();
      break;
    case PathAction::Help:
      look_.help = !look_.help;
      break;
    case PathAction::Quit:
      closed_ = edit_.is_saved() || asks_again;
      warned_ = !closed_;
      if (!closed_) look_.said = "The path is not saved: S saves it, Escape again ends without.";
      break;
  }
}

void Drawing::follow_search() {
  // A drag waits for what was found for where it was.
  if (edit_.points() != asked_ && !(edit_.held() && pending_)) {
    asked_ = edit_.points();
    pending_ = asked_.size() >= 2;
    if (pending_)
      search_.ask(on_floor(asked_, options_.picture));
    else
      look_.found.reset();
  }
  if (auto found = search_.take(); found && asked_.size() >= 2) {
    look_.found = std::move(found);
    pending_ = false;
  }
  look_.progress = search_.progress();
}

Result<void> Drawing::press(int key) {
  if (const auto action = action_of(key)) act(*action);
  return {};
}

void Drawing::draw(Renderer& renderer, double passed, float ui_scale) {
  follow_search();
  clicked_ = view_.draw(renderer, edit_, look_, passed, ui_scale);
}

Result<void> Drawing::act_on_click() {
  if (clicked_) act(*clicked_);
  return {};
}

}  // namespace

Result<void> path_window(const Sprite& sprite, PathEdit& edit, const PathWindowOptions& options) {
  auto window = Window::open({.title = "vsprite path",
                              .width = options.width,
                              .height = options.height,
                              .headless = options.headless});
  if (!window)
    return Error{window.error().code, window.error().message +
                                          "; or write the path without one: a line `x y` a point, "
                                          "--script FILE"};
  auto renderer = make_renderer(Window::gl_function);
  if (!renderer) return renderer.error();
  Drawing drawing(sprite, edit, options);
  return window::run_scene(*window, *renderer, drawing,
                           {options.headless, options.frames, options.screenshot});
}

}  // namespace vsprite
