// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Views to puppets: configurations about their barycentre (Poggio & Brunelli 1992, section 2), or
// about their joints (Darrell 1998, "Training", with its slips put right: angles by atan2, the
// forearm's from the upper arm's, one row an example).

#include "synthesis/puppet_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "synthesis/delaunay.h"

namespace vsprite {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

const std::vector<Vec2>& texture_points(const View& view) {
  return view.texture_points.empty() ? view.points : view.texture_points;
}
bool is_textured(const View& view) { return view.picture.width > 0; }

Vec2 mean(const std::vector<Vec2>& points) {
  double x = 0, y = 0;
  for (const Vec2 p : points) x += p.x, y += p.y;
  const auto n = static_cast<double>(points.size());
  return {static_cast<float>(x / n), static_cast<float>(y / n)};
}
std::vector<Vec2> about_mean(std::vector<Vec2> points) {
  const Vec2 middle = mean(points);
  for (Vec2& p : points) p = {p.x - middle.x, p.y - middle.y};
  return points;
}
double size_of(const std::vector<Vec2>& points) {
  double sum = 0;
  for (const Vec2 p : about_mean(points)) sum += double{p.x} * p.x + double{p.y} * p.y;
  return std::sqrt(sum);
}

// Angles of the links of one view, each from its parent's direction.
std::vector<double> link_angles(const ViewSet& set, const View& view) {
  std::vector<double> absolute, relative;
  for (const LinkMark& link : set.links) {
    const Vec2 a = view.points[static_cast<std::size_t>(link.pivot)],
               b = view.points[static_cast<std::size_t>(link.end)];
    absolute.push_back(std::atan2(double{b.y} - a.y, double{b.x} - a.x));
    const double from = link.parent < 0 ? 0 : absolute[static_cast<std::size_t>(link.parent)];
    double angle = absolute.back() - from;
    angle -= kTurn * std::floor(angle / kTurn + 0.5);
    relative.push_back(angle);
  }
  return relative;
}

// With links the parameters are their angles, each unwrapped to within half a turn of the view
// before; where all views span less than three quarters of a turn it is no cycle but a range, with
// a hull.
void find_link_parameters(ViewSet& set) {
  std::vector<std::vector<double>> angles;
  for (const View& view : set.views) angles.push_back(link_angles(set, view));
  set.parameters.clear();
  for (std::size_t l = 0; l < set.links.size(); ++l) {
    PuppetParameter p{.name = set.links[l].name, .low = angles[0][l], .high = angles[0][l]};
    for (std::size_t v = 1; v < angles.size(); ++v) {
      double& angle = angles[v][l];
      angle -= kTurn * std::floor((angle - angles[v - 1][l]) / kTurn + 0.5);
      p.low = std::min(p.low, angle), p.high = std::max(p.high, angle);
    }
    if (p.high - p.low > 0.75 * kTurn) p.period = kTurn;
    set.parameters.push_back(std::move(p));
  }
  for (std::size_t v = 0; v < set.views.size(); ++v) set.views[v].at = angles[v];
}

// A view's points as the network learns them, and its joints.
void local_shape(const ViewSet& set, const View& view, std::vector<double>& row,
                 std::vector<double>& joints) {
  const Vec2 middle = mean(view.points);
  if (set.links.empty()) {
    for (const Vec2 p : view.points)
      row.insert(row.end(), {double{p.x} - middle.x, double{p.y} - middle.y});
    return;
  }
  const auto turned = [](double x, double y, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return std::array<double, 2>{c * x + s * y, c * y - s * x};
  };
  std::vector<double> absolute;
  for (std::size_t l = 0; l < set.links.size(); ++l) {
    const LinkMark& link = set.links[l];
    const Vec2 pivot = view.points[static_cast<std::size_t>(link.pivot)];
    Vec2 origin = middle;
    double from = 0;
    if (link.parent >= 0) {
      const LinkMark& parent = set.links[static_cast<std::size_t>(link.parent)];
      origin = view.points[static_cast<std::size_t>(parent.pivot)];
      from = absolute[static_cast<std::size_t>(link.parent)];
    }
    absolute.push_back(from + view.at[l]);
    const auto joint = turned(double{pivot.x} - origin.x, double{pivot.y} - origin.y, from);
    joints.insert(joints.end(), joint.begin(), joint.end());
    for (int k = link.first; k < link.first + link.count; ++k) {
      const Vec2 p = view.points[static_cast<std::size_t>(k)];
      const auto at = turned(double{p.x} - pivot.x, double{p.y} - pivot.y, absolute.back());
      row.insert(row.end(), at.begin(), at.end());
    }
  }
}

std::vector<std::size_t> textured_views(const ViewSet& set) {
  std::vector<std::size_t> out;
  for (std::size_t v = 0; v < set.views.size(); ++v)
    if (is_textured(set.views[v])) out.push_back(v);
  return out;
}

PuppetView make_view(const View& view) {
  PuppetView out{.picture = view.picture, .points = texture_points(view), .light = {}};
  premultiply(out.picture);
  return out;
}

// Where a triangle shows nothing in any picture it is left out: arms stay apart from the body.
bool shows_something(const Face& face, const View& view) {
  const auto& points = texture_points(view);
  constexpr int kSteps = 12;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const float a = static_cast<float>(i) / kSteps, b = static_cast<float>(j) / kSteps;
      const Vec2 p = points[face.corners[0]], q = points[face.corners[1]],
                 r = points[face.corners[2]];
      const int x = static_cast<int>(std::floor(p.x + a * (q.x - p.x) + b * (r.x - p.x)));
      const int y = static_cast<int>(std::floor(p.y + a * (q.y - p.y) + b * (r.y - p.y)));
      if (x < 0 || y < 0 || x >= view.picture.width || y >= view.picture.height) continue;
      if (view.picture.rgba[4 * (static_cast<std::size_t>(y) *
                                     static_cast<std::size_t>(view.picture.width) +
                                 static_cast<std::size_t>(x)) +
                            3] > 0)
        return true;
    }
  }
  return false;
}

// One-hot scores of the pictures over their own configurations.
Result<RbfNetwork> fit_view_map(const ViewSet& set) {
  const std::vector<std::size_t> textured = textured_views(set);
  Examples e{.dims = static_cast<int>(2 * set.views[0].points.size()),
             .outputs = static_cast<int>(textured.size()),
             .x = {},
             .y = {}};
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i < textured.size(); ++i) {
    const auto shape = about_mean(set.views[textured[i]].points);
    for (const Vec2 p : shape) e.x.insert(e.x.end(), {double{p.x}, double{p.y}});
    for (std::size_t j = 0; j < textured.size(); ++j) e.y.push_back(i == j ? 1 : 0);
    for (std::size_t j = 0; j < i; ++j) {
      const auto other = about_mean(set.views[textured[j]].points);
      double s = 0;
      for (std::size_t k = 0; k < shape.size(); ++k)
        s += std::pow(double{shape[k].x} - other[k].x, 2) +
             std::pow(double{shape[k].y} - other[k].y, 2);
      nearest = std::min(nearest, std::sqrt(s));
    }
  }
  if (!(nearest > 0))
    return Error{ErrorCode::BadContent,
                 set.name + ": two views have the same control points: they cannot be told apart"};
  return fit_rbf(e, {.kernel = Kernel::Gaussian, .degree = 0, .width = nearest});
}

Puppet make_character(const ViewSet& set, const Puppet& prototype, const Character& character) {
  Puppet out = prototype;
  out.name = character.name;
  const View& like = set.views[static_cast<std::size_t>(character.like)];
  out.motion = character.modulate ? size_of(character.view.points) / size_of(like.points) : 1;
  const auto own = about_mean(character.view.points), reference = about_mean(like.points);
  const auto m = static_cast<float>(out.motion);
  out.offset.clear();
  for (std::size_t i = 0; i < own.size(); ++i)
    out.offset.push_back({own[i].x - m * reference[i].x, own[i].y - m * reference[i].y});
  out.views = {make_view(character.view)};
  out.view_map = {};
  // The prototype's shares of views are no outputs of this one.
  const std::size_t points = own.size(), views = prototype.views.size();
  const auto narrowed = [&](const std::vector<double>& rows) {
    std::vector<double> kept;
    const auto width = static_cast<std::size_t>(prototype.net.outputs);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::size_t column = i % width;
      if (column < 3 * points + 3 || column >= 3 * points + 2 + views) kept.push_back(rows[i]);
    }
    return kept;
  };
  out.net.weights = narrowed(prototype.net.weights);
  out.net.polynomial = narrowed(prototype.net.polynomial);
  out.net.outputs = prototype.net.outputs - static_cast<int>(views) + 1;
  return out;
}

RbfConfig network_config(const ViewSet& set) {
  RbfConfig config = choose_config(set);
  if (!set.rbf) return config;
  RbfConfig own = *set.rbf;
  own.metric = std::move(config.metric), own.period = std::move(config.period);
  return own;
}

Result<RbfNetwork> fit_network(const ViewSet& set, const Examples& examples) {
  if (!set.hyper) return fit_rbf(examples, network_config(set));
  HyperConfig config = *set.hyper;
  config.rbf = network_config(set);
  auto fit = fit_hyperbf(examples, config);
  if (!fit) return fit.error();
  return std::move(fit->net);
}

Examples examples_of(const Examples& all, const std::vector<int>& rows) {
  Examples out{.dims = all.dims, .outputs = all.outputs, .x = {}, .y = {}};
  for (const int row : rows) {
    const auto x = all.x.begin() + std::ptrdiff_t{row} * all.dims;
    const auto y = all.y.begin() + std::ptrdiff_t{row} * all.outputs;
    out.x.insert(out.x.end(), x, x + all.dims);
    out.y.insert(out.y.end(), y, y + all.outputs);
  }
  return out;
}

// Of every parameter by itself.
std::vector<double> median_of(const Examples& examples) {
  const auto dims = static_cast<std::size_t>(examples.dims);
  std::vector<double> out;
  for (std::size_t d = 0; d < dims; ++d) {
    std::vector<double> values;
    for (std::size_t i = d; i < examples.x.size(); i += dims) values.push_back(examples.x[i]);
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    out.push_back((values[(n - 1) / 2] + values[n / 2]) / 2);
  }
  return out;
}

// One network, or one a set; a reader that knows no sets plays the first.
Result<void> fit_networks(const ViewSet& set, Puppet& puppet) {
  const Examples all = puppet_examples(set);
  for (const SetMark& mark : set.sets) {
    const Examples own = examples_of(all, mark.views);
    auto net = fit_network(set, own);
    if (!net) return Error{net.error().code, "set " + mark.name + ": " + net.error().message};
    puppet.sets.push_back(
        {std::move(*net), median_of(own), {mark.joins.begin(), mark.joins.end()}});
  }
  if (!puppet.sets.empty()) {
    puppet.net = puppet.sets[0].net;
    return {};
  }
  auto net = fit_network(set, all);
  if (!net) return net.error();
  puppet.net = std::move(*net);
  return {};
}

}  // namespace

std::vector<Face> make_mesh(const ViewSet& set) {
  if (!set.faces.empty()) return set.faces;
  const std::vector<std::size_t> textured = textured_views(set);
  if (textured.empty()) return {};
  const auto& points = texture_points(set.views[textured[0]]);
  std::vector<LinkMark> parts = set.links;
  if (parts.empty()) parts.push_back({.name = {}, .count = static_cast<int>(points.size())});
  std::vector<Face> out;
  for (const LinkMark& part : parts) {
    const std::span<const Vec2> own(points.data() + part.first,
                                    static_cast<std::size_t>(part.count));
    for (Face face : triangulate(own)) {
      for (std::uint32_t& c : face.corners) c += static_cast<std::uint32_t>(part.first);
      bool shows = false;
      for (const std::size_t v : textured) shows |= shows_something(face, set.views[v]);
      if (shows) out.push_back(face);
    }
  }
  return out;
}

RbfConfig choose_config(const ViewSet& set) {
  RbfConfig config;
  const std::size_t dims = set.parameters.size();
  bool cyclic = false;
  for (std::size_t i = 0; i < dims; ++i) {
    for (std::size_t j = 0; j < dims; ++j) {
      const double range = set.parameters[i].high - set.parameters[i].low;
      config.metric.push_back(i == j && range > 0 ? 1 / range : i == j ? 1.0 : 0.0);
    }
    config.period.push_back(set.parameters[i].period);
    cyclic |= set.parameters[i].period > 0;
  }
  if (!cyclic) config.period.clear();
  std::size_t views = set.views.size();
  for (const SetMark& part : set.sets) views = std::min(views, part.views.size());
  // Darrell's network for limbs; few views do not span a plane.
  if (cyclic || !set.links.empty() || views < dims + 2) {
    config.kernel = Kernel::Linear;
    config.degree = 0;
    config.pseudo_inverse = !set.links.empty();
  }
  return config;
}

Examples puppet_examples(const ViewSet& set) {
  const std::vector<std::size_t> textured = textured_views(set);
  Examples e{.dims = static_cast<int>(set.parameters.size()), .outputs = 0, .x = {}, .y = {}};
  for (std::size_t v = 0; v < set.views.size(); ++v) {
    const View& view = set.views[v];
    e.x.insert(e.x.end(), view.at.begin(), view.at.end());
    std::vector<double> row, joints;
    local_shape(set, view, row, joints);
    const Vec2 middle = mean(view.points);
    row.insert(row.end(), {double{middle.x}, double{middle.y}});
    for (std::size_t i = 0; i < view.points.size(); ++i)
      row.push_back(!view.depth.empty() ? view.depth[i] : !set.depth.empty() ? set.depth[i] : 0.0f);
    // A view without a picture is shown by all of them alike.
    for (const std::size_t t : textured)
      row.push_back(is_textured(view) ? (t == v ? 1.0 : 0.0)
                                      : 1.0 / static_cast<double>(textured.size()));
    row.insert(row.end(), joints.begin(), joints.end());
    e.outputs = static_cast<int>(row.size());
    e.y.insert(e.y.end(), row.begin(), row.end());
  }
  return e;
}

double fit_error(const ViewSet& given, const Puppet& puppet) {
  ViewSet set = given;
  if (!set.links.empty()) find_link_parameters(set);
  const Examples e = puppet_examples(set);
  const std::size_t shape = 2 * puppet.point_count();
  std::vector<double> out(static_cast<std::size_t>(e.outputs));
  double sum = 0;
  std::size_t count = 0;
  const auto add = [&](const RbfNetwork& net, std::size_t view) {
    predict(net, set.views[view].at, out);
    for (std::size_t m = 0; m < shape; ++m, ++count) {
      const double off = out[m] - e.y[view * out.size() + m];
      sum += off * off;
    }
  };
  for (std::size_t v = 0; puppet.sets.empty() && v < set.views.size(); ++v) add(puppet.net, v);
  for (std::size_t s = 0; s < puppet.sets.size(); ++s)
    for (const int v : set.sets[s].views) add(puppet.sets[s].net, static_cast<std::size_t>(v));
  return std::sqrt(sum / static_cast<double>(count));
}

Result<std::vector<Puppet>> fit_puppets(const ViewSet& given) {
  if (auto ok = check_views(given); !ok) return ok.error();
  ViewSet set = given;
  if (!set.links.empty()) find_link_parameters(set);
  Puppet puppet;
  if (auto fitted = fit_networks(set, puppet); !fitted)
    return Error{fitted.error().code, set.name + ": " + fitted.error().message};
  puppet.name = set.name;
  puppet.parameters = set.parameters;
  puppet.faces = make_mesh(set);
  puppet.blends = set.blends;
  for (const std::size_t v : textured_views(set)) puppet.views.push_back(make_view(set.views[v]));
  for (std::size_t l = 0; l < set.links.size(); ++l)
    puppet.links.push_back({static_cast<std::uint32_t>(set.links[l].first),
                            static_cast<std::uint32_t>(set.links[l].count), set.links[l].parent,
                            static_cast<std::uint32_t>(l)});
  if (!set.blends && puppet.views.size() > 1) {
    auto map = fit_view_map(set);
    if (!map) return map.error();
    puppet.view_map = std::move(*map);
  }
  std::vector<Puppet> out;
  for (const Character& character : set.characters)
    out.push_back(make_character(set, puppet, character));
  out.insert(out.begin(), std::move(puppet));
  for (Puppet& each : out) {
    auto made = make_puppet(std::move(each));
    if (!made) return made.error();
    each = std::move(*made);
  }
  return out;
}

}  // namespace vsprite
