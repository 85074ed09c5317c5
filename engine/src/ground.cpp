// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The section GRND (engine/PACK.md): read apart from the sprite.
#include "vsprite/ground.h"

#include <algorithm>
#include <cmath>

#include "pack_format.h"

namespace vsprite {
namespace {

constexpr std::size_t kGroundBytes = 16;
constexpr float kFurthest = 1.0f / 1024;

Result<void> check(const std::string& path, const Ground& g) {
  const bool fine = std::isfinite(g.horizon) && std::isfinite(g.line) && std::isfinite(g.center) &&
                    std::isfinite(g.focal) && g.line > g.horizon && g.focal > 0;
  if (fine) return {};
  return Error{ErrorCode::CorruptData,
               path +
                   ": GRND: four finite numbers, the line below the horizon and a focal length "
                   "above 0 are due"};
}

}  // namespace

float scale_at(const Ground& g, Vec2 p) noexcept {
  return std::min(g.focal / std::max(g.focal - p.y, g.focal / kNearest), kNearest);
}

Vec2 to_screen(const Ground& g, Vec2 p) noexcept {
  const float s = scale_at(g, p);
  return {g.center + p.x * s, g.horizon + (g.line - g.horizon) * s};
}

Vec2 to_ground(const Ground& g, Vec2 p) noexcept {
  const float s = std::clamp((p.y - g.horizon) / (g.line - g.horizon), kFurthest, kNearest);
  return {(p.x - g.center) / s, g.focal * (1 - 1 / s)};
}

Ground scaled(const Ground& g, float factor) noexcept {
  return {g.horizon * factor, g.line * factor, g.center * factor, g.focal * factor};
}

Result<std::optional<Ground>> load_ground(const std::string& path) {
  const auto bytes = load_extra(path, "GRND");
  if (!bytes) return bytes.error();
  if (bytes->empty()) return std::optional<Ground>();
  if (bytes->size() != kGroundBytes)
    return Error{ErrorCode::CorruptData,
                 path + ": GRND: " + std::to_string(bytes->size()) + " bytes: 16 are due"};
  detail::Cursor cursor(*bytes);
  Ground ground;
  ground.horizon = cursor.get<float>();
  ground.line = cursor.get<float>();
  ground.center = cursor.get<float>();
  ground.focal = cursor.get<float>();
  if (auto checked = check(path, ground); !checked) return checked.error();
  return std::optional<Ground>(ground);
}

Result<std::vector<std::uint8_t>> encode_ground(const Ground& ground) {
  if (auto checked = check("a floor", ground); !checked) return checked.error();
  detail::Bytes bytes;
  for (const float number : {ground.horizon, ground.line, ground.center, ground.focal})
    bytes.put(number);
  return std::move(bytes.data);
}

}  // namespace vsprite
