// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/points_edit.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace vsprite {
namespace {

constexpr std::size_t kMostSteps = 500;

Error cannot(std::string why) { return {ErrorCode::BadSetting, std::move(why)}; }
std::string number(std::size_t value) { return std::to_string(value); }

float apart(Vec2 a, Vec2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

double turn(Vec2 a, Vec2 b, Vec2 c) {
  return (double{b.x} - a.x) * (double{c.y} - a.y) - (double{b.y} - a.y) * (double{c.x} - a.x);
}

/// Shares of the corners of a triangle at p; none where it is flat.
std::optional<std::array<double, 3>> shares(Vec2 a, Vec2 b, Vec2 c, Vec2 p) {
  const double whole = turn(a, b, c);
  if (whole == 0) return std::nullopt;
  return std::array{turn(b, c, p) / whole, turn(c, a, p) / whole, turn(a, b, p) / whole};
}

std::optional<std::array<double, 3>> inside(Vec2 a, Vec2 b, Vec2 c, Vec2 p) {
  const auto found = shares(a, b, c, p);
  if (!found || *std::min_element(found->begin(), found->end()) < -1e-6) return std::nullopt;
  return found;
}

/// Corners of the triangles of a face: a quad has two.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const Face& face) {
  std::vector<std::array<std::uint32_t, 3>> out{
      {face.corners[0], face.corners[1], face.corners[2]}};
  if (face.count == 4) out.push_back({face.corners[0], face.corners[2], face.corners[3]});
  return out;
}

/// Where `p` of one view lies in another: through the face that holds it, else beside the nearest
/// point.
Vec2 carried(const std::vector<Face>& faces, const std::vector<Vec2>& from,
             const std::vector<Vec2>& to, Vec2 p) {
  for (const Face& face : faces)
    for (const auto& [a, b, c] : triangles_of(face))
      if (const auto s = inside(from[a], from[b], from[c], p)) {
        const auto mixed = [&](float Vec2::*axis) {
          return static_cast<float>((*s)[0] * to[a].*axis + (*s)[1] * to[b].*axis +
                                    (*s)[2] * to[c].*axis);
        };
        return {mixed(&Vec2::x), mixed(&Vec2::y)};
      }
  std::size_t nearest = from.size();
  for (std::size_t k = 0; k < from.size(); ++k)
    if (nearest == from.size() || apart(from[k], p) < apart(from[nearest], p)) nearest = k;
  if (nearest == from.size()) return p;
  return {to[nearest].x + p.x - from[nearest].x, to[nearest].y + p.y - from[nearest].y};
}

/// A face becomes triangles about the last point, which lies in it; where that lies on an edge, so
/// does the face beyond.
void split_face(std::vector<Face>& faces, std::size_t index, const std::vector<Vec2>& points) {
  constexpr double kOnEdge = 0.5;  // px
  const auto last = static_cast<std::uint32_t>(points.size() - 1);
  const auto edge = [](const Face& face, std::uint32_t c) {
    return std::minmax(face.corners[c], face.corners[(c + 1) % face.count]);
  };
  const Face face = faces[index];
  faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(index));
  const auto fan = [&](const Face& of, std::uint32_t c) {
    faces.push_back({.corners = {of.corners[c], of.corners[(c + 1) % of.count], last}, .count = 3});
  };
  for (std::uint32_t c = 0; c < face.count; ++c) {
    const Vec2 a = points[face.corners[c]], b = points[face.corners[(c + 1) % face.count]];
    if (std::abs(turn(a, b, points[last])) > kOnEdge * apart(a, b)) {
      fan(face, c);
      continue;
    }
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const Face other = faces[f];
      std::uint32_t shared = other.count;
      for (std::uint32_t k = 0; k < other.count; ++k)
        if (edge(other, k) == edge(face, c)) shared = k;
      if (shared == other.count) continue;
      faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(f));
      for (std::uint32_t k = 0; k < other.count; ++k)
        if (k != shared) fan(other, k);
      break;
    }
  }
}

float hundredth(float value) { return std::round(value * 100) / 100; }

}  // namespace

PointsEdit::PointsEdit(ViewSet set) : set_(std::move(set)) {}

Result<PointsEdit> PointsEdit::make(ViewSet set) {
  PointsEdit edit(std::move(set));
  edit.read_ = edit.state();
  const View* whole = nullptr;
  for (std::size_t k = 0; k < edit.sheet_count() && whole == nullptr; ++k)
    if (!edit.sheet(k).points.empty()) whole = &edit.sheet(k);
  const std::size_t due = whole == nullptr ? 0 : whole->points.size();
  const auto other_count = [&](const View& view, std::size_t count) {
    return Error{ErrorCode::BadContent, view.name + ": " + number(count) + " control points, " +
                                            whole->name + " has " + number(due) +
                                            ": every view needs all of them, in the same order"};
  };
  std::vector<Vec2> last = whole == nullptr ? std::vector<Vec2>{} : whole->points;
  for (std::size_t k = 0; k < edit.sheet_count(); ++k) {
    View& view = edit.sheet_of(k);
    if (view.points.empty()) view.points = last;
    if (view.points.size() != due) return other_count(view, view.points.size());
    if (!view.texture_points.empty() && view.texture_points.size() != due)
      return other_count(view, view.texture_points.size());
    last = view.points;
  }
  for (std::size_t f = 0; f < edit.set_.faces.size(); ++f)
    for (std::uint32_t c = 0; c < edit.set_.faces[f].count; ++c)
      if (edit.set_.faces[f].corners[c] >= due)
        return Error{ErrorCode::BadContent,
                     edit.set_.name + ": face " + number(f + 1) + " has control point " +
                         number(edit.set_.faces[f].corners[c] + 1) + ", there are " + number(due)};
  edit.saved_ = edit.read_;
  edit.changed();
  return edit;
}

const View& PointsEdit::sheet(std::size_t index) const {
  const std::size_t views = set_.views.size();
  return index < views ? set_.views[index] : set_.characters[index - views].view;
}
View& PointsEdit::sheet_of(std::size_t index) { return const_cast<View&>(sheet(index)); }

const std::vector<Vec2>& PointsEdit::points(std::size_t index, PointLayer layer) const {
  const View& view = sheet(index);
  return layer == PointLayer::Picture && !view.texture_points.empty() ? view.texture_points
                                                                      : view.points;
}
std::vector<Vec2>& PointsEdit::points_of(std::size_t index, PointLayer layer) {
  return const_cast<std::vector<Vec2>&>(points(index, layer));
}

PointsEdit::State PointsEdit::state() const {
  State out{.sheets = {}, .depth = set_.depth, .faces = set_.faces};
  for (std::size_t k = 0; k < sheet_count(); ++k)
    out.sheets.push_back({sheet(k).points, sheet(k).texture_points, sheet(k).depth});
  return out;
}

void PointsEdit::go_to(State state) {
  for (std::size_t k = 0; k < sheet_count(); ++k) {
    View& view = sheet_of(k);
    view.points = std::move(state.sheets[k].points);
    view.texture_points = std::move(state.sheets[k].texture_points);
    view.depth = std::move(state.sheets[k].depth);
  }
  set_.depth = std::move(state.depth);
  set_.faces = std::move(state.faces);
  changed();
}

void PointsEdit::changed() {
  ++version_;
  faces_ = make_mesh(set_);
}

void PointsEdit::remember() {
  drop();
  before_.push_back(state());
  if (before_.size() > kMostSteps) before_.erase(before_.begin());
  after_.clear();
}

bool PointsEdit::undo() {
  drop();
  if (before_.empty()) return false;
  after_.push_back(state());
  State state = std::move(before_.back());
  before_.pop_back();
  go_to(std::move(state));
  return true;
}

bool PointsEdit::redo() {
  drop();
  if (after_.empty()) return false;
  before_.push_back(state());
  State state = std::move(after_.back());
  after_.pop_back();
  go_to(std::move(state));
  return true;
}

Result<void> PointsEdit::add(std::size_t sheet, PointLayer layer, Vec2 at) {
  if (!set_.links.empty())
    return cannot("the points of limbs belong to their links: points are added in the file");
  at = {hundredth(at.x), hundredth(at.y)};
  if (point_at(sheet, layer, at, 0)) return cannot("a point lies there already");
  if (point_count() >= 65535) return cannot("65535 points are the most");
  remember();
  const std::vector<Vec2> from = points(sheet, layer);
  std::optional<std::size_t> hit;
  if (has_own_faces()) hit = face_at(sheet, layer, at);
  const auto nearest = point_at(sheet, layer, at, HUGE_VALF);
  const auto rounded = [&](const std::vector<Vec2>& to) {
    const Vec2 p = carried(faces_, from, to, at);
    return Vec2{hundredth(p.x), hundredth(p.y)};
  };
  for (std::size_t k = 0; k < sheet_count(); ++k) {
    View& view = sheet_of(k);
    const Vec2 pose = rounded(view.points);
    if (!view.texture_points.empty()) view.texture_points.push_back(rounded(view.texture_points));
    view.points.push_back(pose);
    if (!view.depth.empty()) view.depth.push_back(nearest ? view.depth[*nearest] : 0);
  }
  points_of(sheet, layer).back() = at;
  if (!set_.depth.empty()) set_.depth.push_back(nearest ? set_.depth[*nearest] : 0);
  if (hit.has_value()) split_face(set_.faces, *hit, points(sheet, layer));
  changed();
  return {};
}

Result<void> PointsEdit::erase(std::size_t point) {
  if (point >= point_count())
    return cannot("there is no point " + number(point + 1) + ", there are " +
                  number(point_count()));
  if (!set_.links.empty())
    return cannot("the points of limbs belong to their links: points are taken out in the file");
  remember();
  const auto at = static_cast<std::ptrdiff_t>(point);
  for (std::size_t k = 0; k < sheet_count(); ++k) {
    View& view = sheet_of(k);
    view.points.erase(view.points.begin() + at);
    if (!view.texture_points.empty()) view.texture_points.erase(view.texture_points.begin() + at);
    if (!view.depth.empty()) view.depth.erase(view.depth.begin() + at);
  }
  if (!set_.depth.empty()) set_.depth.erase(set_.depth.begin() + at);
  std::erase_if(set_.faces, [&](const Face& face) {
    return std::find(face.corners.begin(), face.corners.begin() + face.count, point) !=
           face.corners.begin() + face.count;
  });
  for (Face& face : set_.faces)
    for (std::uint32_t c = 0; c < face.count; ++c)
      if (face.corners[c] > point) --face.corners[c];
  changed();
  return {};
}

Result<void> PointsEdit::move_to(std::size_t sheet, PointLayer layer, std::size_t point, Vec2 at) {
  if (point >= point_count())
    return cannot("there is no point " + number(point + 1) + ", there are " +
                  number(point_count()));
  remember();
  points_of(sheet, layer)[point] = {hundredth(at.x), hundredth(at.y)};
  changed();
  return {};
}

Result<void> PointsEdit::replace(std::size_t sheet, PointLayer layer,
                                 const std::vector<Vec2>& points) {
  const bool is_first = point_count() == 0;
  if (!is_first && points.size() != point_count())
    return cannot(number(points.size()) + " points, the views have " + number(point_count()) +
                  ": every view needs all of them, in the same order");
  if (is_first && (!set_.links.empty() || !set_.faces.empty()))
    return cannot("links or faces of no points stand in the file");
  remember();
  if (is_first)
    for (std::size_t k = 0; k < sheet_count(); ++k) sheet_of(k).points = points;
  points_of(sheet, layer) = points;
  changed();
  return {};
}

Result<void> PointsEdit::keep_mesh() {
  if (has_own_faces()) return cannot("the mesh is kept already");
  if (faces_.empty()) return cannot("there is no mesh yet: three points over the picture make one");
  remember();
  set_.faces = faces_;
  changed();
  return {};
}

Result<void> PointsEdit::free_mesh() {
  if (!has_own_faces()) return cannot("the mesh is made anew from the points already");
  remember();
  set_.faces.clear();
  changed();
  return {};
}

Result<void> PointsEdit::cut_face(std::size_t face) {
  if (face >= faces_.size())
    return cannot("there is no face " + number(face + 1) + ", there are " + number(faces_.size()));
  if (faces_.size() == 1) return cannot("a mesh needs at least one face");
  remember();
  set_.faces = faces_;
  set_.faces.erase(set_.faces.begin() + static_cast<std::ptrdiff_t>(face));
  changed();
  return {};
}

Result<void> PointsEdit::flip(std::uint32_t a, std::uint32_t b) {
  std::vector<std::size_t> beside;
  std::vector<std::uint32_t> across;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (faces_[f].count != 3) continue;
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t p = faces_[f].corners[c], q = faces_[f].corners[(c + 1) % 3];
      if ((p != a || q != b) && (p != b || q != a)) continue;
      beside.push_back(f);
      across.push_back(faces_[f].corners[(c + 2) % 3]);
    }
  }
  if (beside.size() != 2)
    return cannot("points " + number(a + 1) + " and " + number(b + 1) +
                  " are no edge between two triangles");
  // The quad a, across, b, across has to be convex in every view.
  for (std::size_t k = 0; k < sheet_count(); ++k) {
    const auto& p = points(k, PointLayer::Picture);
    const double one = turn(p[across[0]], p[across[1]], p[a]),
                 other = turn(p[across[0]], p[across[1]], p[b]);
    if (one * other >= 0)
      return cannot(sheet(k).name + ": the other diagonal would lie outside of the two triangles");
  }
  remember();
  set_.faces = faces_;
  // Each new triangle turns as the old ones do: from `across` the edge a, b was met in order.
  Face& first = set_.faces[beside[0]];
  Face& second = set_.faces[beside[1]];
  const std::uint32_t p = across[0], q = across[1];
  const auto at = std::find(first.corners.begin(), first.corners.begin() + 3, p);
  const std::uint32_t next =
      first.corners[static_cast<std::size_t>(at - first.corners.begin() + 1) % 3];
  const std::uint32_t last = next == a ? b : a;
  first = {.corners = {p, next, q}, .count = 3};
  second = {.corners = {q, last, p}, .count = 3};
  changed();
  return {};
}

void PointsEdit::take(std::size_t sheet, PointLayer layer, std::size_t point) {
  held_ = point, held_sheet_ = sheet, held_layer_ = layer;
  moved_ = false;
}

void PointsEdit::move(Vec2 at) {
  if (!held_) return;
  at = {hundredth(at.x), hundredth(at.y)};
  if (points(held_sheet_, held_layer_)[*held_] == at) return;
  if (!moved_) {
    const auto held = held_;
    remember();
    held_ = held;
  }
  moved_ = true;
  points_of(held_sheet_, held_layer_)[*held_] = at;
  changed();
}

std::optional<std::size_t> PointsEdit::point_at(std::size_t sheet, PointLayer layer, Vec2 at,
                                                float reach) const {
  const auto& all = points(sheet, layer);
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const float off = apart(all[k], at);
    if (off > reach || (best && off == reach)) continue;
    reach = off;
    best = k;
  }
  return best;
}

std::optional<std::size_t> PointsEdit::face_at(std::size_t sheet, PointLayer layer, Vec2 at) const {
  const auto& p = points(sheet, layer);
  for (std::size_t f = faces_.size(); f-- > 0;)  // later ones lie on top
    for (const auto& [a, b, c] : triangles_of(faces_[f]))
      if (inside(p[a], p[b], p[c], at)) return f;
  return std::nullopt;
}

std::optional<std::array<std::uint32_t, 2>> PointsEdit::edge_at(std::size_t sheet, PointLayer layer,
                                                                Vec2 at, float reach) const {
  const auto& all = points(sheet, layer);
  std::optional<std::array<std::uint32_t, 2>> best;
  for (const Face& face : faces_)
    for (std::uint32_t c = 0; c < face.count; ++c) {
      const std::uint32_t i = face.corners[c], j = face.corners[(c + 1) % face.count];
      const Vec2 a = all[i], d{all[j].x - a.x, all[j].y - a.y};
      const float square = d.x * d.x + d.y * d.y;
      const float along =
          square > 0 ? std::clamp(((at.x - a.x) * d.x + (at.y - a.y) * d.y) / square, 0.0f, 1.0f)
                     : 0;
      const float off = apart(at, {a.x + along * d.x, a.y + along * d.y});
      if (off > reach) continue;
      reach = off;
      best = {i, j};
    }
  return best;
}

Result<void> run_points_script(const std::string& text, const std::string& path, PointsEdit& edit) {
  std::istringstream lines(text);
  std::string line;
  for (int row = 1; std::getline(lines, line); ++row) {
    line = line.substr(0, line.find('#'));
    std::istringstream words(line);
    std::string verb;
    if (!(words >> verb)) continue;
    std::vector<double> given;
    std::string word, fault;
    while (words >> word) {
      double value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc{} || end != word.data() + word.size() || !(std::abs(value) <= 65535))
        fault = "`" + word + "`: a number is due";
      given.push_back(value);
    }
    const auto takes = [&](std::size_t count, const char* form) {
      if (fault.empty() && given.size() != count) fault = "`" + std::string(form) + "` is due";
      return fault.empty();
    };
    // From 1 in the script; 0 and less become too large.
    const auto index = [&](std::size_t k) {
      return given[k] >= 1 ? static_cast<std::size_t>(given[k]) - 1 : std::size_t{65536};
    };
    const auto sheet = [&] {
      if (index(0) < edit.sheet_count()) return true;
      fault = "there are " + number(edit.sheet_count()) + " views";
      return false;
    };
    Result<void> done;
    if (verb == "move") {
      if (takes(4, "move VIEW POINT X Y") && sheet())
        done = edit.move_to(index(0), PointLayer::Picture, index(1),
                            {static_cast<float>(given[2]), static_cast<float>(given[3])});
    } else if (verb == "add") {
      if (takes(3, "add VIEW X Y") && sheet())
        done = edit.add(index(0), PointLayer::Picture,
                        {static_cast<float>(given[1]), static_cast<float>(given[2])});
    } else if (verb == "erase") {
      if (takes(1, "erase POINT")) done = edit.erase(index(0));
    } else if (verb == "mesh") {
      if (takes(0, "mesh")) done = edit.keep_mesh();
    } else if (verb == "automatic") {
      if (takes(0, "automatic")) done = edit.free_mesh();
    } else if (verb == "cut") {
      if (takes(1, "cut FACE")) done = edit.cut_face(index(0));
    } else if (verb == "flip") {
      if (takes(2, "flip A B"))
        done =
            edit.flip(static_cast<std::uint32_t>(index(0)), static_cast<std::uint32_t>(index(1)));
    } else if (verb == "undo") {
      if (takes(0, "undo") && !edit.undo()) fault = "there is nothing to undo";
    } else if (verb == "redo") {
      if (takes(0, "redo") && !edit.redo()) fault = "there is nothing to redo";
    } else {
      fault = "`" + verb + "`: move, add, erase, mesh, automatic, cut, flip, undo or redo is due";
    }
    if (!done) fault = done.error().message;
    if (!fault.empty())
      return Error{ErrorCode::BadContent, path + ":" + std::to_string(row) + ": " + fault};
  }
  return {};
}

}  // namespace vsprite
