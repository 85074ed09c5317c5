// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// What makes a set of views unfit, each in a sentence that names the view and the point.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "synthesis/puppet_fit.h"

namespace vsprite {
namespace {

std::string number(std::size_t value) { return std::to_string(value); }

std::string plain(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

Error bad(const View& view, const std::string& what) {
  return {ErrorCode::BadContent, view.name + ": " + what};
}

// Parts that a picture shows apart may meet in a pose: `may_meet`.
Result<void> check_points(const View& view, const std::vector<Vec2>& points, std::size_t due,
                          bool may_meet) {
  if (points.size() != due)
    return bad(view, number(points.size()) + " control points, the first view has " + number(due) +
                         ": every view needs all of them, in the same order");
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y) ||
        std::abs(points[i].x) > 30000 || std::abs(points[i].y) > 30000)
      return bad(view, "control point " + number(i + 1) +
                           " is no place: two numbers from -30000 to 30000 are due");
  if (may_meet) return {};
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto less = [&](std::size_t a, std::size_t b) {
    if (points[a].x != points[b].x) return points[a].x < points[b].x;
    return points[a].y != points[b].y ? points[a].y < points[b].y : a < b;
  };
  std::sort(order.begin(), order.end(), less);
  for (std::size_t k = 1; k < order.size(); ++k)
    if (points[order[k]] == points[order[k - 1]])
      return bad(view, "control points " + number(order[k - 1] + 1) + " and " +
                           number(order[k] + 1) + " lie at the same place: move one of them");
  return {};
}

bool on_a_line(const std::vector<Vec2>& points) {
  std::size_t far = 0;
  double most = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double d =
        std::hypot(double{points[i].x} - points[0].x, double{points[i].y} - points[0].y);
    if (d > most) most = d, far = i;
  }
  for (const Vec2 p : points) {
    const double off = (double{points[far].x} - points[0].x) * (double{p.y} - points[0].y) -
                       (double{points[far].y} - points[0].y) * (double{p.x} - points[0].x);
    if (std::abs(off) > 0.01 * most) return false;
  }
  return true;
}

double area(const std::vector<Vec2>& points, const Face& face) {
  double sum = 0;
  for (std::uint32_t c = 0; c < face.count; ++c) {
    const Vec2 p = points[face.corners[c]], q = points[face.corners[(c + 1) % face.count]];
    sum += double{p.x} * q.y - double{p.y} * q.x;
  }
  return sum / 2;
}

Result<void> check_faces(const ViewSet& set, const View& view) {
  const auto& texture = view.texture_points.empty() ? view.points : view.texture_points;
  for (std::size_t f = 0; f < set.faces.size(); ++f) {
    const Face& face = set.faces[f];
    for (std::uint32_t c = 0; c < face.count; ++c)
      if (face.corners[c] >= view.points.size())
        return bad(view, "face " + number(f + 1) + " has control point " +
                             number(face.corners[c] + 1) + " of " + number(view.points.size()));
    const double a = area(texture, face), b = area(view.points, face);
    const double first = area(set.views[0].points, face);
    if (!set.allow_folds && (a * b <= 0 || b * first <= 0))
      return bad(view, "face " + number(f + 1) +
                           " is folded over or flat here: move its control points, or set "
                           "allow_folds = true where it really turns away");
  }
  return {};
}

Result<void> check_parameters(const ViewSet& set, const View& view) {
  if (view.at.size() != set.parameters.size())
    return bad(view, number(view.at.size()) + " parameters, " + number(set.parameters.size()) +
                         " are due");
  for (std::size_t d = 0; d < view.at.size(); ++d) {
    const PuppetParameter& p = set.parameters[d];
    if (!std::isfinite(view.at[d])) return bad(view, p.name + " is not a number");
    if (p.period <= 0 && (view.at[d] < p.low || view.at[d] > p.high))
      return bad(view, p.name + " = " + plain(view.at[d]) + " lies outside " + plain(p.low) +
                           " to " + plain(p.high));
  }
  return {};
}

// Of one set, or of all where there are none.
Result<void> check_pairs(const ViewSet& set, const std::vector<int>& views) {
  for (std::size_t i = 0; i < views.size(); ++i)
    for (std::size_t j = i + 1; j < views.size(); ++j) {
      const View& a = set.views[static_cast<std::size_t>(views[i])];
      const View& b = set.views[static_cast<std::size_t>(views[j])];
      if (a.at == b.at)
        return bad(b, "has the same parameters as " + a.name +
                          ": one of the two has to go, to say what differs, or to stand in "
                          "another [[set]]");
    }
  return {};
}

Result<void> check_sets(const ViewSet& set) {
  std::vector<int> all(set.views.size());
  std::iota(all.begin(), all.end(), 0);
  if (set.sets.empty()) return set.links.empty() ? check_pairs(set, all) : Result<void>();
  const auto wrong = [&](const std::string& what) {
    return Error{ErrorCode::BadContent, set.name + ": " + what};
  };
  if (set.sets.size() < 2 || set.sets.size() > kMostSets)
    return wrong("sets of views: " + number(set.sets.size()) + ", none or 2 to " +
                 number(kMostSets) + " are due");
  bool may_leave = !set.links.empty();
  for (const PuppetParameter& p : set.parameters) may_leave |= p.period <= 0;
  if (!may_leave)
    return wrong("sets of views need a parameter that is not cyclic to tell them apart");
  std::vector<bool> used(set.views.size(), false);
  for (const SetMark& mark : set.sets) {
    if (mark.views.size() < 2) return wrong("set " + mark.name + ": at least two views are due");
    for (const int v : mark.views) used[static_cast<std::size_t>(v)] = true;
    if (set.links.empty())
      if (auto ok = check_pairs(set, mark.views); !ok) return ok;
  }
  for (std::size_t v = 0; v < used.size(); ++v)
    if (!used[v]) return bad(set.views[v], "stands in no set: put it into one, or leave it out");
  return {};
}

Result<void> check_links(const ViewSet& set) {
  int next = 0;
  for (std::size_t l = 0; l < set.links.size(); ++l) {
    const LinkMark& link = set.links[l];
    const int points = static_cast<int>(set.views[0].points.size());
    const bool fits = link.first == next && link.count >= 3 && link.first + link.count <= points &&
                      link.pivot >= 0 && link.pivot < points && link.end >= 0 &&
                      link.end < points && link.pivot != link.end &&
                      link.parent < static_cast<int>(l);
    if (!fits)
      return Error{ErrorCode::BadContent,
                   set.name + ": link " + link.name +
                       ": it has to follow the link before it, with at least three control points "
                       "and two joints among them"};
    next += link.count;
  }
  if (!set.links.empty() && static_cast<std::size_t>(next) != set.views[0].points.size())
    return Error{ErrorCode::BadContent, set.name + ": the links hold " + std::to_string(next) +
                                            " control points of " +
                                            number(set.views[0].points.size())};
  return {};
}

}  // namespace

Result<void> check_views(const ViewSet& set) {
  if (set.views.size() < 2)
    return Error{ErrorCode::BadContent,
                 set.name + ": " + number(set.views.size()) +
                     " view: at least two are due, so that something lies between them"};
  const std::size_t points = set.views[0].points.size();
  if (points < 3) return bad(set.views[0], number(points) + " control points, at least 3 are due");
  const View* pictured = nullptr;
  bool apart = false;
  for (const View& view : set.views) apart |= !view.texture_points.empty();
  for (const View& view : set.views) {
    if (auto ok = check_points(view, view.points, points, apart); !ok) return ok;
    if (!view.texture_points.empty())
      if (auto ok = check_points(view, view.texture_points, points, false); !ok) return ok;
    if (on_a_line(view.points)) return bad(view, "all control points lie on one line");
    if (set.links.empty())
      if (auto ok = check_parameters(set, view); !ok) return ok;
    if (auto ok = check_faces(set, view); !ok) return ok;
    for (const float d : view.depth)
      if (!std::isfinite(d)) return bad(view, "a depth is not a number");
    if (view.picture.width == 0) continue;
    if (pictured != nullptr && (view.picture.width != pictured->picture.width ||
                                view.picture.height != pictured->picture.height))
      return bad(view, number(static_cast<std::size_t>(view.picture.width)) + " x " +
                           number(static_cast<std::size_t>(view.picture.height)) + " px, " +
                           pictured->name + " has " +
                           number(static_cast<std::size_t>(pictured->picture.width)) + " x " +
                           number(static_cast<std::size_t>(pictured->picture.height)) +
                           ": views of one size are due");
    if (pictured == nullptr) pictured = &view;
  }
  if (pictured == nullptr)
    return Error{ErrorCode::BadContent, set.name + ": no view has a picture"};
  if (auto ok = check_sets(set); !ok) return ok;
  for (const Character& character : set.characters)
    if (auto ok = check_points(character.view, character.view.points, points, apart); !ok)
      return ok;
  return check_links(set);
}

}  // namespace vsprite
