// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The section BODY (engine/PACK.md), boxes and hits.
#include "vsprite/body.h"

#include <algorithm>
#include <cmath>

#include "sections.h"

namespace vsprite {
namespace detail {
namespace {

constexpr std::size_t kBodyHeadBytes = 8, kBoxBytes = 20;

Finding bad_body(std::string_view code, const std::string& what, std::uint64_t offset = 0) {
  return finding(code, "BODY", offset, what);
}

}  // namespace

Bytes body_bytes(const SpriteData& data) {
  Bytes out;
  out.put(static_cast<std::uint32_t>(data.bodies.size()));
  out.put(std::uint32_t{0});
  for (const BodyBox& body : data.bodies) {
    out.put(body.tag);
    out.put(std::uint16_t{0});
    out.put(body.left);
    out.put(body.top);
    out.put(body.right);
    out.put(body.bottom);
  }
  return out;
}

Check read_bodies(std::span<const std::uint8_t> bytes, std::uint64_t offset, SpriteData& data) {
  Cursor cursor(bytes);
  const std::uint64_t count = bytes.size() < kBodyHeadBytes ? 0 : cursor.get<std::uint32_t>();
  if (count == 0 || bytes.size() != kBodyHeadBytes + count * kBoxBytes)
    return bad_body("body-size",
                    std::to_string(count) + " boxes do not make the section's " +
                        std::to_string(bytes.size()) + " bytes",
                    offset);
  if (cursor.get<std::uint32_t>() != 0)
    return bad_body("reserved", "reserved bytes are not 0", offset + 4);
  data.bodies.resize(count);
  for (BodyBox& body : data.bodies) {
    body.tag = cursor.get<std::uint16_t>();
    if (cursor.get<std::uint16_t>() != 0)
      return bad_body("reserved", "reserved bytes of a box are not 0", offset);
    body.left = cursor.get<float>();
    body.top = cursor.get<float>();
    body.right = cursor.get<float>();
    body.bottom = cursor.get<float>();
  }
  return {};
}

Check check_bodies(const SpriteData& data) {
  std::vector<std::uint8_t> has(data.tags.size(), 0);
  for (std::size_t k = 0; k < data.bodies.size(); ++k) {
    const BodyBox& b = data.bodies[k];
    const std::string at = "box " + std::to_string(k) + ": ";
    if (b.tag >= data.tags.size() || (k > 0 && b.tag <= data.bodies[k - 1].tag))
      return bad_body("body-tag", at + "tag " + std::to_string(b.tag) + " of " +
                                      std::to_string(data.tags.size()) + ", ascending, is due");
    const bool finite = std::isfinite(b.left) && std::isfinite(b.top) && std::isfinite(b.right) &&
                        std::isfinite(b.bottom);
    if (!finite || !(b.left <= b.right) || !(b.top <= b.bottom))
      return bad_body("body-box", at + "is not a box");
    has[b.tag] = 1;
  }
  for (const Sample& s : data.samples)
    if (s.kept != 0 && has[s.tag] == 0)
      return bad_body("body-tag", "tag " + std::to_string(s.tag) + " has samples but no box");
  return {};
}

}  // namespace detail

namespace {

Box about(const Actor& actor, float scale, float left, float top, float right, float bottom) {
  const Vec2 at = to_pixels(actor.position);
  return {at.x + scale * left, at.y + scale * top, at.x + scale * right, at.y + scale * bottom};
}

}  // namespace

Box body_box(const Sprite& sprite, const Actor& actor, float scale) noexcept {
  const SpriteData& data = sprite.data();
  const std::uint16_t tag = data.samples[actor.sample].tag;
  const auto found =
      std::lower_bound(data.bodies.begin(), data.bodies.end(), tag,
                       [](const BodyBox& body, std::uint16_t t) { return body.tag < t; });
  const float half = data.body_length / 2;
  if (found == data.bodies.end() || found->tag != tag)
    return about(actor, scale, -half, -half, half, half);
  return about(actor, scale, found->left, found->top, found->right, found->bottom);
}

Box drawn_box(const Sprite& sprite, const Actor& actor, float scale) noexcept {
  const Sample& s = sprite.samples()[actor.sample];
  return about(actor, scale, -s.anchor.x, -s.anchor.y, static_cast<float>(s.width) - s.anchor.x,
               static_cast<float>(s.height) - s.anchor.y);
}

bool hit(const Sprite& sprite, const Actor& actor, ImageView picture, Vec2 point, float scale,
         std::uint8_t alpha) noexcept {
  const Sample& s = sprite.samples()[actor.sample];
  if (picture.width != s.width || picture.height != s.height || !(scale > 0)) return false;
  const Box box = drawn_box(sprite, actor, scale);
  if (!box.contains(point)) return false;
  const int x = std::min(static_cast<int>((point.x - box.left) / scale), picture.width - 1);
  const int y = std::min(static_cast<int>((point.y - box.top) / scale), picture.height - 1);
  return picture.pixel(x, y)[3] >= alpha;
}

}  // namespace vsprite
