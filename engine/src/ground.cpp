// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The section GRND (engine/PACK.md): read apart from the sprite, and written by copying a pack.
#include "vsprite/ground.h"

#include <algorithm>
#include <cmath>

#include "pack_copy.h"

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

Result<std::optional<Ground>> read_ground(const detail::ByteSource& source) {
  const auto content = detail::read_table(source);
  if (!content) return content.error();
  const detail::SectionEntry* entry = detail::find_section(*content, "GRND");
  if (entry == nullptr) return std::optional<Ground>();
  if (entry->bytes != kGroundBytes)
    return Error{ErrorCode::CorruptData,
                 source.name() + ": GRND: " + std::to_string(entry->bytes) + " bytes: 16 are due"};
  const auto bytes = detail::read_section(source, *entry);
  if (!bytes) return bytes.error();
  detail::Cursor cursor(*bytes);
  Ground ground;
  ground.horizon = cursor.get<float>();
  ground.line = cursor.get<float>();
  ground.center = cursor.get<float>();
  ground.focal = cursor.get<float>();
  if (auto checked = check(source.name(), ground); !checked) return checked.error();
  return std::optional<Ground>(ground);
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
  try {
    const auto source = detail::ByteSource::open(path);
    if (!source) return source.error();
    return read_ground(*source);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, path + ": out of memory while reading its floor"};
  }
}

Result<void> save_ground(const std::string& path, const Ground& ground) {
  try {
    if (auto checked = check(path, ground); !checked) return checked;
    const auto source = detail::ByteSource::open(path);
    if (!source) return source.error();
    detail::Bytes bytes;
    bytes.put(ground.horizon);
    bytes.put(ground.line);
    bytes.put(ground.center);
    bytes.put(ground.focal);
    return detail::copy_with_section(*source, path, "GRND", bytes.data);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, path + ": out of memory while writing its floor"};
  }
}

}  // namespace vsprite
