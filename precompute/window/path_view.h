// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// path_view.h - what the path window shows, and what the mouse does to the path.
#pragma once

#include <optional>
#include <string>

#include "tool/path_edit.h"
#include "vsprite/draw.h"
#include "window/path.h"
#include "window/path_search.h"

namespace vsprite::window {

enum class PathAction { Play, Back, On, Undo, Redo, Clear, Erase, Save, Help, Quit };

/// What the window knows beside the path itself.
struct PathLook {
  std::optional<PathFound> found;  ///< for the path as it is, or the last that was whole
  double progress = -1;            ///< of the search; below 0: it is done
  double tick = 0;                 ///< of the clip, that is shown
  bool playing = true;
  bool help = false;
  std::string said;                     ///< about the last action
  std::optional<std::size_t> selected;  ///< point
};

class PathView {
 public:
  PathView(const Sprite& sprite, const PathWindowOptions& options);

  /// Draws all of it, and lets the mouse change the path. `seconds`: since the last picture.
  /// Pre: between begin_frame and end_frame, and in a frame of Dear ImGui.
  std::optional<PathAction> draw(Renderer& renderer, PathEdit& edit, PathLook& look, double seconds,
                                 float ui);

 private:
  Vec2 to_window(Vec2 script) const;
  Vec2 to_script(Vec2 window) const;
  void lay_out(const Renderer& renderer, float ui);
  void draw_ground(Renderer& renderer, double tick);
  void draw_path(Renderer& renderer, const PathEdit& edit, const PathLook& look, float ui) const;
  void draw_sprite(Renderer& renderer, const PathLook& look);
  void take_mouse(PathEdit& edit, PathLook& look, float ui);
  std::optional<PathAction> draw_side(const PathEdit& edit, PathLook& look, float ui) const;
  void draw_time(PathLook& look, float ui) const;

  const Sprite& sprite_;
  const PathWindowOptions& options_;
  FrameCache frames_;
  Image still_;                       ///< premultiplied backdrop
  std::size_t shown_ = SIZE_MAX;      ///< frame of the backdrop film that `still_` is
  Rect picture_{}, side_{}, time_{};  ///< window px
  float scale_ = 1;                   ///< window px per script px
};

}  // namespace vsprite::window
