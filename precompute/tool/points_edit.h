// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/points_edit.h - the control points of views while they are placed, every state that can be
// gone back to, and the file that they are saved in.
//
// Point k is the same landmark in every view: a point that is added or taken out is so in all of
// them. Where it is added the mesh carries it to the other views, to be dragged to its place there.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "synthesis/puppet_fit.h"

namespace vsprite {

/// Which of a view's points: where its picture shows them, or where they lie in its pose. The same
/// but for a view with `texture_points`.
enum class PointLayer { Picture, Pose };

class PointsEdit {
 public:
  /// A view without points gets those of the view before it. Errors: BadContent (views with other
  /// numbers of points; a face of points that there are not).
  static Result<PointsEdit> make(ViewSet set);

  /// As it is now, pictures and all.
  const ViewSet& set() const { return set_; }
  /// The views, then the characters.
  std::size_t sheet_count() const { return set_.views.size() + set_.characters.size(); }
  const View& sheet(std::size_t index) const;
  bool has_pose(std::size_t sheet) const { return !this->sheet(sheet).texture_points.empty(); }
  const std::vector<Vec2>& points(std::size_t sheet, PointLayer layer) const;
  std::size_t point_count() const { return set_.views[0].points.size(); }
  /// Those of the file, else the ones that a fit would make.
  const std::vector<Face>& faces() const { return faces_; }
  bool has_own_faces() const { return !set_.faces.empty(); }

  /// Each is one step of undo. Errors: BadSetting, why it cannot be, for a person.
  Result<void> add(std::size_t sheet, PointLayer layer, Vec2 at);
  Result<void> erase(std::size_t point);
  Result<void> move_to(std::size_t sheet, PointLayer layer, std::size_t point, Vec2 at);
  Result<void> replace(std::size_t sheet, PointLayer layer, const std::vector<Vec2>& points);
  /// Writes the mesh as it is now into the file, to be changed by hand; then no point moves it.
  Result<void> keep_mesh();
  /// Gives the hand-made mesh up.
  Result<void> free_mesh();
  Result<void> cut_face(std::size_t face);
  /// The edge of two triangles becomes the other diagonal of the four corners.
  Result<void> flip(std::uint32_t a, std::uint32_t b);

  /// A drag: any number of moves between these two are one step of undo.
  void take(std::size_t sheet, PointLayer layer, std::size_t point);
  void move(Vec2 at);
  void drop() { held_.reset(); }
  std::optional<std::size_t> held() const { return held_; }

  bool undo();
  bool redo();
  bool is_saved() const { return state() == saved_; }
  void mark_saved() { saved_ = state(); }
  /// Counts up with every change.
  std::size_t version() const { return version_; }

  /// The point within `reach` px of `at`, the nearest one.
  std::optional<std::size_t> point_at(std::size_t sheet, PointLayer layer, Vec2 at,
                                      float reach) const;
  std::optional<std::size_t> face_at(std::size_t sheet, PointLayer layer, Vec2 at) const;
  /// The edge of a face within `reach` px, as its two points.
  std::optional<std::array<std::uint32_t, 2>> edge_at(std::size_t sheet, PointLayer layer, Vec2 at,
                                                      float reach) const;

  /// `text`, the file that was read, with the points, depths and faces that were changed since;
  /// everything else in it, comments too, stays. Errors: BadContent (no TOML).
  Result<std::string> written_into(const std::string& text, const std::string& path) const;

 private:
  struct Sheet {
    std::vector<Vec2> points, texture_points;
    std::vector<float> depth;
    bool operator==(const Sheet&) const = default;
  };
  struct State {
    std::vector<Sheet> sheets;
    std::vector<float> depth;
    std::vector<Face> faces;
    bool operator==(const State&) const = default;
  };
  explicit PointsEdit(ViewSet set);
  View& sheet_of(std::size_t index);
  std::vector<Vec2>& points_of(std::size_t sheet, PointLayer layer);
  State state() const;
  void go_to(State state);
  void remember();
  void changed();

  ViewSet set_;
  std::vector<Face> faces_;
  State read_, saved_;  ///< as the file had it; as it was saved last
  std::vector<State> before_, after_;
  std::optional<std::size_t> held_;
  std::size_t held_sheet_ = 0;
  PointLayer held_layer_ = PointLayer::Picture;
  bool moved_ = false;
  std::size_t version_ = 0;
};

/// The file that points are saved in.
class PointsFile {
 public:
  /// Errors: those of read_views_text.
  static Result<PointsFile> open(const std::string& path);
  const std::string& path() const { return path_; }
  const std::string& text() const { return read_; }

  /// Puts the edit's points into the file, whole or not at all, and marks it saved. A file that
  /// another program has changed meanwhile is left alone. Errors: BadContent, those of write_file.
  Result<void> save(PointsEdit& edit);
  /// Into a file beside it, whose name is returned.
  Result<std::string> save_aside(const PointsEdit& edit) const;

 private:
  std::string path_, read_, last_;
};

/// Does a script of edits, one a line: `move VIEW POINT X Y`, `add VIEW X Y`, `erase POINT`,
/// `mesh`, `automatic`, `cut FACE`, `flip A B`, `undo`, `redo`; views, points and faces from 1, `#`
/// starts a comment. Errors: BadContent, naming the line.
Result<void> run_points_script(const std::string& text, const std::string& path, PointsEdit& edit);

}  // namespace vsprite
