// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/compose.h - draws pictures onto pictures on the CPU: contact sheets, headless games,
// tests.
//
// The operator is Porter and Duff's "over", with C premultiplied by coverage a:
//
//     C = C_picture + (1 - a_picture) C_canvas,   a = a_picture + (1 - a_picture) a_canvas
//
// Alpha is coverage in linear light, so by default C counts linear light: the values are taken out
// of their sRGB encoding, mixed, and encoded again. The encoded option mixes the numbers as they
// are, as most 2D programs do; soft edges then look too dark on light ground and too light on dark.
//
// The picture is sampled at any sub-pixel place: bilinear when enlarged, averaged over the area
// that a canvas pixel covers when reduced (at scale 1 the two are the same, and places count in
// 1/256 px).
#pragma once

#include <cstdint>

#include "vsprite/image.h"
#include "vsprite/sprite.h"

namespace vsprite {

enum class Blend : std::uint8_t { LinearLight, Encoded };

struct DrawOptions {
  Blend blend = Blend::LinearLight;
  float scale = 1;    ///< canvas pixels per picture pixel, > 0
  float opacity = 1;  ///< 0..1, times the picture's alpha
};

/// A picture of one colour. `r`, `g`, `b` straight sRGB; width and height >= 0.
Image make_image(int width, int height, std::uint8_t r, std::uint8_t g, std::uint8_t b,
                 std::uint8_t a = 255);

/// Two opaque greys in squares of `cell` px: shows what is transparent. Pre: cell > 0.
Image make_checkerboard(int width, int height, int cell = 8);

/// Draws `picture` (premultiplied) onto `canvas` (premultiplied) with its top left corner at
/// `top_left`, canvas pixels; what lies outside is cut off, a place that is not finite draws
/// nothing. Both may be of any size, also empty. Does not allocate.
void draw_picture(Image& canvas, ImageView picture, Vec2 top_left,
                  const DrawOptions& options = {}) noexcept;

/// The same with the sample's anchor at `position`.
void draw_sample(Image& canvas, ImageView picture, const Sample& sample, Vec2 position,
                 const DrawOptions& options = {}) noexcept;

/// The sample's filmed shadow (shadow.h) under its anchor at `position`, where it has one; drawn
/// before the sample. May allocate: out of memory it draws nothing.
void draw_shadow(Image& canvas, const Sprite& sprite, std::uint32_t sample, Vec2 position,
                 const DrawOptions& options = {}) noexcept;

/// A silhouette, blurred and reduced: pixel p of `image` lies at p scale + corner of the picture.
struct SoftShadow {
  Image image;      ///< white, premultiplied: every channel is the coverage
  Vec2 corner{};    ///< of the image, px of the picture
  float scale = 1;  ///< px of the picture per pixel of the image: 1..8
};

/// The shadow of a picture (premultiplied or not: alpha counts) on the plane behind it. `blur`: the
/// radius over which its edge fades, px, 0..64. Draw it with a tint, enlarged by `scale`. Cost:
/// about that of reading the picture. May throw std::bad_alloc.
SoftShadow make_shadow(ImageView picture, float blur);

}  // namespace vsprite
