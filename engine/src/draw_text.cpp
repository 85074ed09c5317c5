// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Text as pictures: every glyph is drawn once a size and weight, then kept on a texture page.
#include <algorithm>
#include <cmath>

#include "font.h"
#include "renderer.h"

namespace vsprite {
namespace {

constexpr std::uint64_t kFontSprite = ~std::uint64_t{0};

}  // namespace

void Renderer::Impl::draw_line_of_text(std::string_view text, Vec2 at, float size,
                                       const TextStyle& style) {
  const float baseline = std::round(at.y);  // whole pixels keep thin strokes sharp
  float pen = at.x;
  while (!text.empty()) {
    const char32_t character = detail::take_character(text);
    const Rect area = detail::glyph_box(character, size, style.weight);
    if (character != U' ') {
      // Size and weight in steps of 1/8 px and 1/16: one picture for all that look the same.
      const auto look = static_cast<std::uint32_t>(std::lround(size * 8)) << 8 |
                        static_cast<std::uint32_t>(std::lround(style.weight * 16));
      const TextureKey key{kFontSprite - (character & 0x1FFFFFu), look};
      auto slot = atlas.find(key);
      if (!slot) slot = store(key, detail::draw_glyph(character, size, style.weight));
      const Vec2 corner{std::round(pen) + static_cast<float>(area.x),
                        baseline + static_cast<float>(area.y)};
      if (slot) push_picture({.slot = *slot, .corner = corner, .tint = style.color, .fog = {}});
    }
    pen += detail::glyph_advance(character) * size;
  }
}

void Renderer::draw_text(std::string_view text, Vec2 position, const TextStyle& style) {
  Impl& m = *impl_;
  if (m.target == nullptr) return;
  const float size = std::clamp(std::round(style.size * m.camera.scale * 8) / 8, 4.0f, 400.0f);
  Vec2 at = m.to_frame(position);
  while (true) {
    const std::size_t end = text.find('\n');
    const std::string_view row = text.substr(0, end);
    TextStyle unit = style;
    unit.size = size;
    const float width = measure_text(row, unit).x;
    const float shift = style.align == Align::Left ? 0 : style.align == Align::Center ? 0.5f : 1;
    m.draw_line_of_text(row, {at.x - shift * width, at.y}, size, style);
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
    at.y += size;
  }
}

Vec2 measure_text(std::string_view text, const TextStyle& style) noexcept {
  Vec2 size{0, style.size};
  float width = 0;
  while (!text.empty()) {
    const char32_t character = detail::take_character(text);
    if (character == U'\n') {
      size.y += style.size;
      width = 0;
    } else {
      width += detail::glyph_advance(character) * style.size;
      size.x = std::max(size.x, width);
    }
  }
  return size;
}

}  // namespace vsprite
