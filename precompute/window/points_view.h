// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// points_view.h - what the points window shows, and what the mouse does to the points.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "vsprite/draw.h"
#include "window/points.h"
#include "window/puppet_preview.h"

namespace vsprite::window {

enum class PointsAction { Undo, Redo, Erase, Flip, Mesh, Save, Play, Grid, Layer, Help, Quit };

/// What the window knows beside the points themselves.
struct PointsLook {
  std::size_t sheet = 0;
  PointLayer layer = PointLayer::Picture;
  bool mesh = true;  ///< is shown
  bool help = false;
  std::string said{};                     ///< about the last action
  std::optional<std::size_t> selected{};  ///< point
  std::optional<std::size_t> over{};      ///< point under the mouse
  Vec2 mouse{};                           ///< px of the view
  bool is_over = false;                   ///< the mouse lies over the view
  float zoom = 1;                         ///< 1: the whole view
  Vec2 middle{};                          ///< px of the view, in the middle where zoom > 1
};

class PointsView {
 public:
  explicit PointsView(std::string title) : title_(std::move(title)) {}

  /// Draws all of it, and lets the mouse change the points.
  /// Pre: between begin_frame and end_frame, and in a frame of Dear ImGui.
  std::optional<PointsAction> draw(Renderer& renderer, PointsEdit& edit, PuppetPreview& preview,
                                   PointsLook& look, float ui);
  /// px of the view within which a point or edge is meant.
  float reach() const { return reach_; }

 private:
  void lay_out(const Renderer& renderer, const PointsEdit& edit, const PointsLook& look, float ui);
  Vec2 to_window(Vec2 p) const;
  Vec2 to_view(Vec2 w) const;
  void draw_view(Renderer& renderer, const PointsEdit& edit, const PointsLook& look);
  void draw_mesh(Renderer& renderer, const PointsEdit& edit, const PointsLook& look, float ui);
  void draw_points(Renderer& renderer, const PointsEdit& edit, const PointsLook& look, float ui);
  void take_mouse(PointsEdit& edit, PointsLook& look, float ui);
  std::optional<PointsAction> draw_side(PointsEdit& edit, PuppetPreview& preview, PointsLook& look,
                                        float ui) const;

  std::string title_;
  Rect area_{}, view_{}, preview_{}, side_{};  ///< window px
  Vec2 corner_{};                              ///< window px of the view's corner
  float scale_ = 1;                            ///< window px per px of the view
  float reach_ = 1;
  std::set<std::size_t> premultiplied_;
  std::vector<Image> pictures_;
};

}  // namespace vsprite::window
