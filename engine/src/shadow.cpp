// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The section SHDW (engine/PACK.md), and its pictures.
#include "vsprite/shadow.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "sections.h"

namespace vsprite {
namespace detail {
namespace {

constexpr std::size_t kShadowHeadBytes = 8, kShadowBytes = 24;
constexpr int kMaxSide = 65535;

Finding bad_shadow(std::string_view code, const std::string& what, std::uint64_t offset = 0) {
  return finding(code, "SHDW", offset, what);
}

bool is_black(const Image& image) {
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    if (image.rgba[i] != 0 || image.rgba[i + 1] != 0 || image.rgba[i + 2] != 0) return false;
  return true;
}

}  // namespace

Bytes shadow_bytes(const SpriteData& data) {
  Bytes out;
  out.put(static_cast<std::uint32_t>(data.shadows.size()));
  out.put(data.shadow_scale);
  for (const FilmedShadow& shadow : data.shadows) {
    out.put(shadow.sample);
    out.put(shadow.anchor.x);
    out.put(shadow.anchor.y);
    out.put(shadow.width);
    out.put(shadow.height);
    out.put(static_cast<std::uint32_t>(shadow.picture.size()));
    out.put(std::uint32_t{0});
  }
  for (const FilmedShadow& shadow : data.shadows)
    out.data.insert(out.data.end(), shadow.picture.begin(), shadow.picture.end());
  return out;
}

Check read_shadows(std::span<const std::uint8_t> bytes, std::uint64_t offset, SpriteData& data) {
  Cursor cursor(bytes);
  const std::uint64_t count = bytes.size() < kShadowHeadBytes ? 0 : cursor.get<std::uint32_t>();
  if (count == 0 || count > (bytes.size() - kShadowHeadBytes) / kShadowBytes)
    return bad_shadow("shadow-size",
                      std::to_string(count) + " shadows do not fit the section's " +
                          std::to_string(bytes.size()) + " bytes",
                      offset);
  data.shadow_scale = cursor.get<float>();
  data.shadows.resize(count);
  std::uint64_t left = cursor.left() - count * kShadowBytes;
  std::vector<std::uint32_t> sizes;
  for (FilmedShadow& shadow : data.shadows) {
    shadow.sample = cursor.get<std::uint32_t>();
    shadow.anchor.x = cursor.get<float>();
    shadow.anchor.y = cursor.get<float>();
    shadow.width = cursor.get<std::uint16_t>();
    shadow.height = cursor.get<std::uint16_t>();
    sizes.push_back(cursor.get<std::uint32_t>());
    if (cursor.get<std::uint32_t>() != 0)
      return bad_shadow("reserved", "reserved bytes of a shadow are not 0", offset);
    if (sizes.back() > left)
      return bad_shadow("shadow-size",
                        "a picture of " + std::to_string(sizes.back()) + " bytes, " +
                            std::to_string(left) + " are left",
                        offset);
    left -= sizes.back();
  }
  if (left != 0)
    return bad_shadow("shadow-size",
                      std::to_string(left) + " bytes too many after the last picture", offset);
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const auto picture = cursor.take(sizes[k]);
    data.shadows[k].picture.assign(picture.begin(), picture.end());
  }
  return {};
}

Check check_shadows(const SpriteData& data) {
  if (!std::isfinite(data.shadow_scale) || !(data.shadow_scale > 0))
    return bad_shadow("shadow-value", "a scale above 0 is due");
  for (std::size_t k = 0; k < data.shadows.size(); ++k) {
    const FilmedShadow& s = data.shadows[k];
    const std::string at = "shadow " + std::to_string(k) + ": ";
    const bool follows = k == 0 || s.sample > data.shadows[k - 1].sample;
    if (!follows || s.sample >= data.samples.size() || data.samples[s.sample].kept == 0)
      return bad_shadow("shadow-sample", at + "sample " + std::to_string(s.sample) +
                                             ": kept ones, ascending, are due");
    if (!std::isfinite(s.anchor.x) || !std::isfinite(s.anchor.y))
      return bad_shadow("shadow-value", at + "its anchor is not finite");
    if (s.width == 0 || s.height == 0 || std::uint32_t{s.width} * s.height > kMaxPixels)
      return bad_shadow("shadow-value", at + std::to_string(s.width) + " x " +
                                            std::to_string(s.height) +
                                            " px, 1 to 2^24 pixels are due");
  }
  return {};
}

Check verify_shadow(const FilmedShadow& shadow) {
  Image image;
  if (decode_shadow(shadow, image) && is_black(image)) return {};
  return bad_shadow("shadow-picture", "shadow of sample " + std::to_string(shadow.sample) +
                                          ": its bytes are not a black picture of " +
                                          std::to_string(shadow.width) + " x " +
                                          std::to_string(shadow.height) + " pixels");
}

}  // namespace detail

Result<void> add_shadow(SpriteData& data, std::uint32_t sample, const Image& shade, Vec2 anchor) {
  const bool fits =
      shade.width > 0 && shade.height > 0 && shade.width <= detail::kMaxSide &&
      shade.height <= detail::kMaxSide &&
      static_cast<std::uint64_t>(shade.width) * static_cast<std::uint64_t>(shade.height) <=
          detail::kMaxPixels;
  if (!fits)
    return Error{ErrorCode::CorruptData, "the shadow of sample " + std::to_string(sample) +
                                             " has " + std::to_string(shade.width) + " x " +
                                             std::to_string(shade.height) +
                                             " px, 1 to 2^24 pixels are due"};
  try {
    Image black = shade;
    for (std::size_t i = 0; i < black.rgba.size(); i += 4)
      std::fill_n(black.rgba.begin() + static_cast<std::ptrdiff_t>(i), 3, std::uint8_t{0});
    detail::FrameCodec codec;
    const auto bytes = codec.encode(black);
    data.shadows.push_back({.sample = sample,
                            .anchor = anchor,
                            .width = static_cast<std::uint16_t>(shade.width),
                            .height = static_cast<std::uint16_t>(shade.height),
                            .picture = {bytes.begin(), bytes.end()}});
    return {};
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, "out of memory for a shadow"};
  }
}

const FilmedShadow* find_shadow(const Sprite& sprite, std::uint32_t sample) noexcept {
  const auto& shadows = sprite.data().shadows;
  const auto found =
      std::lower_bound(shadows.begin(), shadows.end(), sample,
                       [](const FilmedShadow& s, std::uint32_t n) { return s.sample < n; });
  return found != shadows.end() && found->sample == sample ? &*found : nullptr;
}

bool decode_shadow(const FilmedShadow& shadow, Image& out) noexcept {
  try {
    detail::FrameCodec codec;
    const auto input = codec.input(shadow.picture.size());
    std::copy(shadow.picture.begin(), shadow.picture.end(), input.begin());
    return codec.decode(shadow.width, shadow.height, out);
  } catch (const std::bad_alloc&) {
    return false;
  }
}

}  // namespace vsprite
