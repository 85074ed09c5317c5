// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/paint.h - what a Renderer draws with: colours, pictures, shapes, text, effects and
// layers. Values only; draw.h says what becomes of them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "vsprite/geometry.h"
#include "vsprite/image.h"

namespace vsprite {

/// Linear light, straight alpha; 1 is white. Values above 1 are allowed until the frame is encoded.
struct Color {
  float r = 1;
  float g = 1;
  float b = 1;
  float a = 1;
};

/// From the usual sRGB notation: srgb(0x3b82c4), srgb(0xffffff, 0.5f).
Color srgb(std::uint32_t rgb, float alpha = 1) noexcept;

/// How what is drawn meets what is there.
enum class BlendMode : std::uint8_t {
  Over,      ///< src + (1 - src.a) dst
  Add,       ///< src + dst: light
  Multiply,  ///< src dst: shade
  Replace,   ///< src
};

/// Frame pixels of a point p: (p - origin) scale + offset.
struct Camera {
  Vec2 origin{};  ///< game coordinates
  float scale = 1;
  Vec2 offset{};  ///< frame pixels
};

/// Names a picture in the texture cache; `sprite` 0 means: not cached, uploaded for this one
/// drawing.
struct TextureKey {
  std::uint64_t sprite = 0;
  std::uint32_t sample = 0;
  /// 0: the picture itself; else its shadow (shadow_key), or the picture made smaller
  /// (reduced_key).
  std::uint32_t variant = 0;
  friend bool operator==(const TextureKey&, const TextureKey&) = default;
};

/// A picture that another one is mixed with, anchor on anchor, for a cross-fade. What is opaque in
/// both stays opaque.
struct Fade {
  ImageView image{};
  TextureKey key{};
  Vec2 anchor{};    ///< px of this image
  float share = 0;  ///< of this picture, 0: not drawn at all, 1: alone
  BlockView blocks{};  ///< instead of the image, where Renderer::takes_blocks
};

/// One picture to draw. The anchor comes to lie at `position`, exactly, also between pixels.
struct SpriteDraw {
  /// Premultiplied sRGB; may be empty where is_cached(reduced_key(key, scale on the frame)).
  ImageView image{};
  TextureKey key{};      ///< the same key must always mean the same picture, until forget(sprite)
  Vec2 position{};       ///< game coordinates
  Vec2 anchor{};         ///< px of the image
  float scale = 1;       ///< game pixels per image pixel, > 0; shrinking is area-averaged
  float angle = 0;       ///< radians clockwise, about the anchor
  bool mirror = false;   ///< left and right exchanged, about the anchor
  Color tint{};          ///< multiplies colour; tint.a multiplies coverage
  Color fog{};           ///< colour of the water or air in between (its alpha is not used) ...
  float fog_amount = 0;  ///< ... 0 none, 1 a silhouette in that colour
  Fade fade{};           ///< the picture shown before
  float wrap = 0;        ///< light of the backdrop over the edge, 0 none .. 1, after take_backdrop
  float wrap_reach = 4;  ///< how far it reaches inwards, px of the image
  BlockView blocks{};    ///< instead of the image, where Renderer::takes_blocks; has no shadow
};

/// A soft shadow: the picture's silhouette on the ground, blurred. The anchor stays where it is, so
/// that a subject that stands there touches its shadow.
struct Shadow {
  float opacity = 0.4f;  ///< 0: none .. 1
  float squash = 0.3f;   ///< of heights: 1 seen from above, 0.3 from a low camera; < 0: towards it
  float slant = 0;       ///< game pixels to the right per game pixel of height
  float blur = 6;        ///< radius over which the edge fades, px of the picture, 0..64
  Vec2 offset{};         ///< from the subject, game pixels: how high it hovers
  Color color{0, 0, 0};
};
/// The name under which a picture is cached that is drawn at `scale`, frame pixels a pixel of its
/// own: from a half downwards it is kept at half its size, from a quarter at a quarter, and so on.
TextureKey reduced_key(const TextureKey& picture, float scale) noexcept;
/// The name under which the shadow of a picture is cached.
TextureKey shadow_key(const TextureKey& picture, const Shadow& shadow) noexcept;

/// A rounded box with a soft edge: also rectangles, discs, rings and thick lines.
struct Shape {
  Vec2 center{};      ///< game coordinates
  Vec2 half_size{};   ///< game pixels
  float radius = 0;   ///< of the corners, at most the smaller half size
  float angle = 0;    ///< radians clockwise
  float outline = 0;  ///< 0: filled; else the width of a line that lies inside the edge
  float feather = 0;  ///< width over which the edge fades, beyond one pixel
  Color color{};
  BlendMode blend = BlendMode::Over;
};
Shape disc(Vec2 center, float radius, Color color) noexcept;
Shape line(Vec2 from, Vec2 to, float width, Color color) noexcept;
/// The box from `from` (top left) to `to`.
Shape box(Vec2 from, Vec2 to, Color color, float radius = 0) noexcept;

struct Vertex {
  Vec2 position{};  ///< game coordinates
  Color color{};
};

enum class Align : std::uint8_t { Left, Center, Right };

struct TextStyle {
  float size = 16;  ///< height of a line, game pixels
  Color color{};
  float weight = 1;  ///< stroke width against the usual 0.085 of the size
  Align align = Align::Left;
};

/// A compiled effect; belongs to the Renderer that made it.
struct Effect {
  int id = -1;
};

/// What a layer holds: linear light as half floats, or four plain numbers in [0, 1] as bytes, for
/// what effects hand to each other. Software drivers read bytes two to three times as fast.
enum class LayerFormat : std::uint8_t { Light, Bytes };

/// A picture on the GPU, to draw into once and show often.
struct Layer {
  int id = -1;
};

/// A puppet's pictures on the GPU; belongs to the Renderer that made it.
struct PuppetSkin {
  int id = -1;
};

/// A named value for an effect: float, vec2, vec3, vec4, an array of them, or a layer (sampler2D).
/// `name` and array values are borrowed for the call. A name that the effect does not use is
/// ignored.
struct Uniform {
  std::string_view name;
  std::array<float, 4> value{};
  int components = 1;             ///< 1..4
  std::span<const float> values;  ///< arrays: components * length floats
  Layer layer;

  Uniform(std::string_view n, float x) : name(n), value{x} {}
  Uniform(std::string_view n, Vec2 v) : name(n), value{v.x, v.y}, components(2) {}
  Uniform(std::string_view n, float x, float y, float z) : name(n), value{x, y, z}, components(3) {}
  Uniform(std::string_view n, Color c) : name(n), value{c.r, c.g, c.b, c.a}, components(4) {}
  Uniform(std::string_view n, std::span<const float> array, int size)
      : name(n), components(size), values(array) {}
  Uniform(std::string_view n, Layer picture) : name(n), components(0), layer(picture) {}
};

struct EffectPass {
  Rect area{};  ///< frame pixels (the camera is not applied); width 0: the whole frame
  BlendMode blend = BlendMode::Over;
};

}  // namespace vsprite
