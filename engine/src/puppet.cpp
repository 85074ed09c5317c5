// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// From parameters to a configuration of control points (Poggio & Brunelli 1992, section 2; Darrell
// 1998 for links). Angles use libm's sine and cosine: a picture may differ by a rounding between
// machines, a pack does not.

#include "vsprite/puppet.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vsprite {
namespace {

Error bad_puppet(const Puppet& puppet, const std::string& what) {
  return {ErrorCode::CorruptData, "puppet " + puppet.name + ": " + what};
}

std::size_t outputs_due(const Puppet& puppet) {
  return 3 * puppet.point_count() + 2 + puppet.views.size() + 2 * puppet.links.size();
}

Result<void> check_views(Puppet& puppet) {
  const std::size_t points = puppet.point_count();
  if (points < 3 || points > 65535)
    return bad_puppet(puppet, std::to_string(points) + " control points, 3 to 65535 are due");
  for (PuppetView& view : puppet.views) {
    const auto bytes = static_cast<std::size_t>(view.picture.width) * 4 *
                       static_cast<std::size_t>(view.picture.height);
    if (view.picture.width < 1 || view.picture.height < 1 || view.picture.rgba.size() != bytes)
      return bad_puppet(puppet, "a view without a picture");
    if (view.points.size() != points)
      return bad_puppet(puppet, "a view of " + std::to_string(view.points.size()) +
                                    " control points, " + std::to_string(points) + " are due");
    for (const Vec2 p : view.points)
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || std::abs(p.x) > 65535 ||
          std::abs(p.y) > 65535)
        return bad_puppet(puppet, "a control point that is no place in a picture");
  }
  return {};
}

Result<void> check_mesh(const Puppet& puppet) {
  for (const Face& face : puppet.faces) {
    if (face.count != 3 && face.count != 4)
      return bad_puppet(puppet, "a face of " + std::to_string(face.count) + " corners");
    for (std::uint32_t c = 0; c < face.count; ++c)
      if (face.corners[c] >= puppet.point_count())
        return bad_puppet(puppet, "a face at control point " + std::to_string(face.corners[c]));
  }
  std::size_t next = 0;
  for (std::size_t l = 0; l < puppet.links.size(); ++l) {
    const PuppetLink& link = puppet.links[l];
    if (link.first != next || link.parameter >= puppet.parameters.size() || link.parent < -1 ||
        link.parent >= static_cast<std::int32_t>(l))
      return bad_puppet(puppet, "link " + std::to_string(l) + " does not follow the one before");
    next += link.count;
  }
  if (!puppet.links.empty() && next != puppet.point_count())
    return bad_puppet(puppet, "links of " + std::to_string(next) + " control points");
  return {};
}

Result<void> check_sets(Puppet& puppet) {
  const std::size_t count = puppet.sets.size();
  if (count == 1 || count > kMostSets)
    return bad_puppet(puppet, std::to_string(count) + " example sets, none or 2 to 64 are due");
  for (std::size_t s = 0; s < count; ++s) {
    ExampleSet& set = puppet.sets[s];
    const std::string name = "example set " + std::to_string(s);
    auto net = make_rbf_network(std::move(set.net));
    if (!net) return bad_puppet(puppet, name + ": " + net.error().message);
    set.net = std::move(*net);
    if (set.net.dims != puppet.net.dims || set.net.outputs != puppet.net.outputs)
      return bad_puppet(puppet, name + ": a network of other parameters and control points");
    if (set.net.hull.empty()) return bad_puppet(puppet, name + " has no hull");
    if (set.median.size() != puppet.parameters.size())
      return bad_puppet(puppet, name + ": a median of other parameters");
    for (const double m : set.median)
      if (!std::isfinite(m)) return bad_puppet(puppet, name + ": a median that is not finite");
    for (const std::uint32_t join : set.joins)
      if (join >= count) return bad_puppet(puppet, name + " joins set " + std::to_string(join));
  }
  return {};
}

Result<void> check_networks(Puppet& puppet) {
  auto net = make_rbf_network(std::move(puppet.net));
  if (!net) return bad_puppet(puppet, net.error().message);
  puppet.net = std::move(*net);
  const std::size_t points = puppet.point_count(), views = puppet.views.size();
  if (static_cast<std::size_t>(puppet.net.dims) != puppet.parameters.size() ||
      static_cast<std::size_t>(puppet.net.outputs) != outputs_due(puppet))
    return bad_puppet(puppet, "a network of other parameters and control points");
  if (auto ok = check_sets(puppet); !ok) return ok;
  if (!puppet.offset.empty() && puppet.offset.size() != points)
    return bad_puppet(puppet, "an offset of other control points");
  for (const Vec2 o : puppet.offset)
    if (!std::isfinite(o.x) || !std::isfinite(o.y)) return bad_puppet(puppet, "a bad offset");
  if (!std::isfinite(puppet.motion)) return bad_puppet(puppet, "motion is not finite");
  for (const PuppetParameter& p : puppet.parameters)
    if (p.name.empty() || p.name.size() > 255 || !std::isfinite(p.low) || !std::isfinite(p.high) ||
        !std::isfinite(p.period))
      return bad_puppet(puppet, "a parameter without name or range");
  if (views < 2 || puppet.blends) return {};
  auto map = make_rbf_network(std::move(puppet.view_map));
  if (!map) return bad_puppet(puppet, map.error().message);
  puppet.view_map = std::move(*map);
  if (static_cast<std::size_t>(puppet.view_map.dims) != 2 * points ||
      static_cast<std::size_t>(puppet.view_map.outputs) != views)
    return bad_puppet(puppet, "a view map of other control points or views");
  return {};
}

// Linear, premultiplied: what filtering and mixing are right in.
void make_light(PuppetView& view) {
  const std::vector<std::uint8_t>& rgba = view.picture.rgba;
  view.light.resize(rgba.size());
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    const unsigned a = rgba[i + 3];
    for (std::size_t c = 0; c < 3; ++c) {
      const unsigned straight = a == 0 ? 0 : std::min(255u, (rgba[i + c] * 255u + a / 2) / a);
      view.light[i + c] =
          static_cast<float>(linear_from_srgb(static_cast<std::uint8_t>(straight))) / 65535 *
          static_cast<float>(a) / 255;
    }
    view.light[i + 3] = static_cast<float>(a) / 255;
  }
}

Vec2 turned(Vec2 p, double c, double s) noexcept {
  return {static_cast<float>(c * p.x - s * p.y), static_cast<float>(s * p.x + c * p.y)};
}

// Every link to its place: turned by the angles of all links up to it, about its pivot.
void place_links(const Puppet& puppet, std::span<const double> x, const double* joints,
                 PuppetPose& pose) noexcept {
  constexpr std::size_t kMost = 64;
  std::array<double, kMost> angle{};
  std::array<Vec2, kMost> pivot{};
  for (std::size_t l = 0; l < std::min(puppet.links.size(), kMost); ++l) {
    const PuppetLink& link = puppet.links[l];
    const Vec2 joint{static_cast<float>(joints[2 * l]), static_cast<float>(joints[2 * l + 1])};
    angle[l] = x[link.parameter];
    pivot[l] = joint;
    if (link.parent >= 0) {
      const auto p = static_cast<std::size_t>(link.parent);
      const Vec2 at = turned(joint, std::cos(angle[p]), std::sin(angle[p]));
      angle[l] += angle[p];
      pivot[l] = {pivot[p].x + at.x, pivot[p].y + at.y};
    }
    const double c = std::cos(angle[l]), s = std::sin(angle[l]);
    for (std::uint32_t k = link.first; k < link.first + link.count; ++k) {
      const Vec2 at = turned(pose.points[k], c, s);
      pose.points[k] = {pivot[l].x + at.x, pivot[l].y + at.y};
    }
  }
}

// The learned map from the barycentric configuration to the view that shows it best.
void choose_view(const Puppet& puppet, PuppetPose& pose) noexcept {
  Vec2 middle{};
  for (const Vec2 p : pose.points) middle = {middle.x + p.x, middle.y + p.y};
  const auto count = static_cast<float>(pose.points.size());
  for (std::size_t i = 0; i < pose.points.size(); ++i) {
    pose.shape[2 * i] = pose.points[i].x - middle.x / count;
    pose.shape[2 * i + 1] = pose.points[i].y - middle.y / count;
  }
  const std::size_t views = puppet.views.size();
  predict(puppet.view_map, pose.shape, std::span(pose.scratch).first(views));
  const auto best = std::max_element(pose.scratch.begin(),
                                     pose.scratch.begin() + static_cast<std::ptrdiff_t>(views));
  std::fill(pose.shares.begin(), pose.shares.end(), 0.0f);
  pose.shares[static_cast<std::size_t>(best - pose.scratch.begin())] = 1;
}

}  // namespace

Result<Puppet> make_puppet(Puppet parts) {
  if (parts.parameters.empty() || parts.parameters.size() > kMaxHullDims)
    return bad_puppet(parts,
                      std::to_string(parts.parameters.size()) + " parameters, 1 to 8 are due");
  if (parts.links.size() > 64) return bad_puppet(parts, "more than 64 links");
  if (auto ok = check_views(parts); !ok) return ok.error();
  if (auto ok = check_mesh(parts); !ok) return ok.error();
  if (auto ok = check_networks(parts); !ok) return ok.error();
  for (PuppetView& view : parts.views) make_light(view);
  return parts;
}

PuppetPose make_pose(const Puppet& puppet) {
  PuppetPose pose;
  const std::size_t points = puppet.point_count();
  pose.points.resize(points);
  pose.depth.resize(points);
  pose.shares.assign(puppet.views.size(), 0);
  pose.shares[0] = 1;
  pose.scratch.resize(std::max(outputs_due(puppet), puppet.views.size()));
  pose.shape.resize(2 * points);
  return pose;
}

void pose_puppet(const Puppet& puppet, std::span<const double> parameters,
                 PuppetPose& pose) noexcept {
  assert(parameters.size() == puppet.parameters.size());
  std::array<double, kMaxHullDims> at{};
  std::copy(parameters.begin(), parameters.end(), at.begin());
  const std::span<double> x = std::span(at).first(parameters.size());
  if (!puppet.sets.empty()) pose.set = choose_set(puppet.sets, x, pose.set);
  const RbfNetwork& net =
      puppet.sets.empty() ? puppet.net : puppet.sets[static_cast<std::size_t>(pose.set)].net;
  pose.outside = clamp_to_hull(net, x);
  const std::size_t points = puppet.point_count(), views = puppet.views.size();
  predict(net, x, std::span(pose.scratch).first(outputs_due(puppet)));
  // Far outside what they were made for networks may yield anything; no pose leaves the numbers.
  constexpr double kFar = 1e6;
  for (double& value : pose.scratch) value = value > -kFar ? std::min(value, kFar) : -kFar;
  const double* out = pose.scratch.data();
  const auto m = static_cast<float>(puppet.motion);
  for (std::size_t i = 0; i < points; ++i) {
    pose.points[i] = {m * static_cast<float>(out[2 * i]), m * static_cast<float>(out[2 * i + 1])};
    if (!puppet.offset.empty())
      pose.points[i] = {pose.points[i].x + puppet.offset[i].x,
                        pose.points[i].y + puppet.offset[i].y};
    pose.depth[i] = static_cast<float>(out[2 * points + 2 + i]);
  }
  pose.center = {m * static_cast<float>(out[2 * points]),
                 m * static_cast<float>(out[2 * points + 1])};
  if (!puppet.links.empty()) place_links(puppet, x, out + 3 * points + 2 + views, pose);
  if (views == 1) return;
  if (!puppet.blends) return choose_view(puppet, pose);
  double sum = 0;
  for (std::size_t v = 0; v < views; ++v) sum += std::max(0.0, out[3 * points + 2 + v]);
  for (std::size_t v = 0; v < views; ++v)
    pose.shares[v] = sum > 0 ? static_cast<float>(std::max(0.0, out[3 * points + 2 + v]) / sum)
                             : (v == 0 ? 1.0f : 0.0f);
}

ArmReach reach_for(Vec2 shoulder, Vec2 target, double upper, double lower, int bend) noexcept {
  const double x = double{target.x} - shoulder.x, y = double{target.y} - shoulder.y;
  const double far = std::sqrt(x * x + y * y);
  const double d = std::clamp(far, std::abs(upper - lower) + 1e-9, upper + lower - 1e-9);
  // atan2 of a sine found from the cosine: the sign says which way the elbow goes.
  const double cosine =
      std::clamp((d * d - upper * upper - lower * lower) / (2 * upper * lower), -1.0, 1.0);
  const double sine = (bend < 0 ? -1 : 1) * std::sqrt(1 - cosine * cosine);
  ArmReach out;
  out.elbow = std::atan2(sine, cosine);
  out.shoulder =
      (far > 0 ? std::atan2(y, x) : 0) - std::atan2(lower * sine, upper + lower * cosine);
  return out;
}

}  // namespace vsprite
