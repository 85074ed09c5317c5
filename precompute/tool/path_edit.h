// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/path_edit.h - a path while it is drawn: its points, and every state that can be gone back
// to.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "vsprite/geometry.h"

namespace vsprite {

class PathEdit {
 public:
  explicit PathEdit(std::vector<Vec2> points = {}) : points_(points), saved_(std::move(points)) {}

  const std::vector<Vec2>& points() const { return points_; }
  /// Before `index`, which may be the number of points; one step of undo.
  void insert(std::size_t index, Vec2 point);
  void erase(std::size_t index);
  void clear();
  /// A drag: any number of moves between these two are one step of undo. `take` after an insert
  /// makes one step of both.
  void take(std::size_t index);
  void move(Vec2 point);
  void drop();
  std::optional<std::size_t> held() const { return held_; }

  /// False if there is nothing to go to. A held point is dropped first.
  bool undo();
  bool redo();

  bool is_saved() const { return points_ == saved_; }
  void mark_saved() { saved_ = points_; }

  /// The point within `reach` px of `at`, the nearest one.
  std::optional<std::size_t> point_at(Vec2 at, float reach) const;
  /// The segment (from point i to i + 1) within `reach` px of `at`, the nearest one.
  std::optional<std::size_t> segment_at(Vec2 at, float reach) const;

 private:
  void remember();
  std::vector<Vec2> points_, saved_;
  std::vector<std::vector<Vec2>> before_, after_;
  std::optional<std::size_t> held_;
  bool moved_ = false, fresh_ = false;
};

/// The script of a path, 1/10 px; `head`: comments and blank lines that stand before it.
std::string format_path(const std::vector<Vec2>& points, const std::string& head = {});
/// The comments and blank lines before a script's first point.
std::string head_of_path(const std::string& text);

}  // namespace vsprite
