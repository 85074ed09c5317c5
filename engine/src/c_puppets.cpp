// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Puppets by the C interface: what a pack has of them, their poses and pictures.
#include "c_parts.h"

using namespace vsprite;
using namespace vsprite::c;

static_assert(sizeof(Vec2) == 2 * sizeof(float) && offsetof(Vec2, y) == sizeof(float));

namespace {

constexpr const char* kNoPuppets = "open puppets are due";

vsprite_status check_puppet(const char* call, const vsprite_puppets* puppets,
                            std::uint32_t index) noexcept {
  if (!is_open(puppets)) return bad(call, kNoPuppets);
  const std::size_t count = puppets->puppets.size();
  return index < count ? VSPRITE_OK : bad_index(call, "puppet", index, count);
}

vsprite_status check_values(const char* call, const Puppet& puppet, const double* values,
                            std::uint32_t count) noexcept {
  const std::size_t due = puppet.parameters.size();
  if (count != due) return bad_index(call, "values", count, due);
  if (values == nullptr && count > 0) return bad(call, "values are due, null was found");
  for (std::uint32_t k = 0; k < count; ++k)
    if (!std::isfinite(values[k])) return bad(call, kNotFinite);
  return VSPRITE_OK;
}

std::uint32_t count_of(std::size_t count) noexcept { return static_cast<std::uint32_t>(count); }

}  // namespace

vsprite_status vsprite_load_puppets(const char* path, vsprite_puppets** puppets) {
  if (puppets == nullptr) return bad(__func__, kNoResult);
  *puppets = nullptr;
  if (path == nullptr) return bad(__func__, kNoPath);
  return guarded([&]() -> vsprite_status {
    auto loaded = load_puppets(path);
    if (!loaded) return fail(loaded.error());
    auto handle = std::make_unique<vsprite_puppets>();
    handle->puppets = std::move(*loaded);
    for (const Puppet& puppet : handle->puppets) handle->poses.push_back(make_pose(puppet));
    *puppets = handle.release();
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_close_puppets(vsprite_puppets** puppets) {
  return close_handle(__func__, puppets, [](vsprite_puppets* p) { delete p; });
}

vsprite_status vsprite_count_puppets(const vsprite_puppets* puppets, std::uint32_t* count) {
  if (!is_open(puppets)) return bad(__func__, kNoPuppets);
  if (count == nullptr) return bad(__func__, kNoResult);
  *count = count_of(puppets->puppets.size());
  return VSPRITE_OK;
}

vsprite_status vsprite_find_puppet(const vsprite_puppets* puppets, const char* name,
                                   std::uint32_t* puppet) {
  if (!is_open(puppets)) return bad(__func__, kNoPuppets);
  if (name == nullptr || puppet == nullptr) return bad(__func__, kNoResult);
  for (std::uint32_t i = 0; i < puppets->puppets.size(); ++i) {
    if (puppets->puppets[i].name != name) continue;
    *puppet = i;
    return VSPRITE_OK;
  }
  return say(VSPRITE_NOT_FOUND, "%s: no `%.200s` among %zu puppets", __func__, name,
             puppets->puppets.size());
}

vsprite_status vsprite_get_puppet(const vsprite_puppets* puppets, std::uint32_t index,
                                  vsprite_puppet_info* out) {
  if (const vsprite_status wrong = check_puppet(__func__, puppets, index)) return wrong;
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  const Puppet& puppet = puppets->puppets[index];
  vsprite_puppet_info info{};
  info.parameters = count_of(puppet.parameters.size());
  info.points = count_of(puppet.point_count());
  info.faces = count_of(puppet.faces.size());
  info.views = count_of(puppet.views.size());
  info.links = count_of(puppet.links.size());
  info.name = puppet.name.c_str();
  hand_out(info, size, out);
  return VSPRITE_OK;
}

vsprite_status vsprite_get_parameter(const vsprite_puppets* puppets, std::uint32_t index,
                                     std::uint32_t parameter, vsprite_parameter* out) {
  if (const vsprite_status wrong = check_puppet(__func__, puppets, index)) return wrong;
  const auto& parameters = puppets->puppets[index].parameters;
  if (parameter >= parameters.size())
    return bad_index(__func__, "parameter", parameter, parameters.size());
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  const PuppetParameter& p = parameters[parameter];
  hand_out(vsprite_parameter{size, p.name.c_str(), p.low, p.high, p.period}, size, out);
  return VSPRITE_OK;
}

vsprite_status vsprite_pose_puppet(vsprite_puppets* puppets, std::uint32_t index,
                                   const double* values, std::uint32_t count, vsprite_pose* out) {
  if (const vsprite_status wrong = check_puppet(__func__, puppets, index)) return wrong;
  const Puppet& puppet = puppets->puppets[index];
  if (const vsprite_status wrong = check_values(__func__, puppet, values, count)) return wrong;
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  PuppetPose& pose = puppets->poses[index];
  pose_puppet(puppet, {values, count}, pose);
  vsprite_pose posed{};
  posed.points = count_of(pose.points.size());
  posed.xy = pose.points.empty() ? nullptr : &pose.points.front().x;
  posed.center_x = pose.center.x;
  posed.center_y = pose.center.y;
  posed.outside = pose.outside;
  hand_out(posed, size, out);
  return VSPRITE_OK;
}

vsprite_status vsprite_draw_puppet(vsprite_canvas* canvas, vsprite_puppets* puppets,
                                   std::uint32_t index, const double* values, std::uint32_t count,
                                   float x, float y, float scale) {
  if (!is_open(canvas)) return bad(__func__, kNoCanvas);
  if (const vsprite_status wrong = check_puppet(__func__, puppets, index)) return wrong;
  const Puppet& puppet = puppets->puppets[index];
  if (const vsprite_status wrong = check_values(__func__, puppet, values, count)) return wrong;
  if (!is_finite(x, y) || !(scale > 0 && scale <= 1000)) return bad(__func__, kNotFinite);
  return guarded([&] {
    PuppetPose& pose = puppets->poses[index];
    pose_puppet(puppet, {values, count}, pose);
    render_puppet(puppet, pose, puppets->painter, canvas->image, {x, y}, scale);
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_reach_for(float shoulder_x, float shoulder_y, float target_x, float target_y,
                                 double upper, double lower, std::int32_t bend, double* shoulder,
                                 double* elbow) {
  if (shoulder == nullptr || elbow == nullptr) return bad(__func__, kNoResult);
  const auto is_link = [](double length) { return length >= 1e-3 && length <= 1e6; };
  if (!is_finite(shoulder_x, shoulder_y, target_x) || !is_finite(target_y) || !is_link(upper) ||
      !is_link(lower))
    return bad(__func__, kNotFinite);
  if (bend == 0) return bad(__func__, "a bend over or under 0 is due");
  const ArmReach reach =
      reach_for({shoulder_x, shoulder_y}, {target_x, target_y}, upper, lower, bend);
  *shoulder = reach.shoulder;
  *elbow = reach.elbow;
  return VSPRITE_OK;
}
