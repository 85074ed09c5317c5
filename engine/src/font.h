// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// font.h - a stroke font of our own: every sign is a few pen strokes, drawn at any size. Knows no
// GPU.
#pragma once

#include <string_view>

#include "vsprite/geometry.h"
#include "vsprite/image.h"

namespace vsprite::detail {

/// Takes one character off the front of UTF-8 text; U+FFFD for a byte that does not fit. Pre: not
/// empty.
char32_t take_character(std::string_view& text) noexcept;

/// From this pen position to the next, for a line height of 1.
float glyph_advance(char32_t character) noexcept;

/// The pixels that a glyph touches, from the pen position at the top of the line.
Rect glyph_box(char32_t character, float line_height, float weight) noexcept;

/// Its picture: white premultiplied with coverage, of the size of glyph_box.
Image draw_glyph(char32_t character, float line_height, float weight);

}  // namespace vsprite::detail
