// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/draw.h - draws sprites, shapes, text and full-screen effects, in linear light.
//
// A frame is drawn into a picture of half floats that hold linear, premultiplied light, so that a
// soft edge keeps the colour it was filmed with:  out = src + (1 - src.a) dst.  Sprite pictures
// come as sRGB-encoded premultiplied bytes and are made linear premultiplied half floats once, when
// they are uploaded, so that bilinear sampling between pixels is correct too. `end_frame` encodes
// the frame as sRGB for the window, `read_pixels` for a file.
//
//     renderer.begin_frame(window.width(), window.height());
//     renderer.run_effect(water, std::array{Uniform("time", seconds)});
//     draw_actor(renderer, sprite, frames, actor);
//     renderer.draw_text("score 12", {16, 16}, {.size = 24});
//     renderer.end_frame();
//
// Positions are frame pixels, y down, moved and scaled by the camera. Everything appears in the
// order of the calls; what is of one kind goes to the GPU as one batch, also past others that it
// does not meet, and where a batch covers the frame more than once, parts that are hidden for
// certain are not drawn. A Renderer needs an OpenGL 3.3 core or ES 3 (WebGL 2) context that is
// current in its thread from make_renderer until the destructor has run; it calls no window system
// and links no OpenGL library. A context that is lost (a driver's reset) takes its Renderer along:
// close it and the window and make both anew; what a FrameCache holds is sent again, effects and
// layers are the game's to make.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "vsprite/actor.h"
#include "vsprite/geometry.h"
#include "vsprite/image.h"
#include "vsprite/paint.h"
#include "vsprite/result.h"
#include "vsprite/show.h"
#include "vsprite/sprite.h"
#include "vsprite/stream.h"

namespace vsprite {

struct Puppet;
struct PuppetPose;

/// The address of an OpenGL function of the current context, by its whole name; null if there is
/// none: Window::gl_function, SDL_GL_GetProcAddress, eglGetProcAddress, ...
using GlLoader = void* (*)(const char* name);

struct RendererConfig {
  std::size_t texture_budget = std::size_t{128} << 20;  ///< bytes of cached pictures on the GPU
  bool blocks = true;   ///< send GPU-ready pictures as they are where the driver takes them
  bool dither = false;  ///< +-half a step of noise when encoding: no bands in dark gradients
};

struct RendererStats {
  std::uint64_t sprites = 0;      ///< since the last begin_frame
  std::uint64_t batches = 0;      ///< draw calls since the last begin_frame
  std::uint64_t uploads = 0;      ///< pictures sent to the GPU since the last begin_frame
  std::uint64_t evictions = 0;    ///< cache pages emptied, ever
  std::size_t texture_bytes = 0;  ///< held by the texture cache
};

/// Movable, not copyable; one thread. Drawing calls outside begin_frame .. end_frame do nothing,
/// and neither does a frame without pixels (a window may be dragged to nothing).
class Renderer {
 public:
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// `width`, `height`: pixels of the frame, which need not be those of the window.
  void begin_frame(int width, int height);
  void clear(Color color);
  void set_camera(const Camera& camera);  ///< back to none at begin_frame
  const Camera& camera() const noexcept;

  void draw_sprite(const SpriteDraw& sprite);
  /// Keeps a small blurred copy of what was drawn so far in this frame or layer. Sprites with
  /// SpriteDraw::wrap drawn after it get its light over their edges:  out += wrap a (1 - b) light,
  /// with the coverage a and its mean b within `wrap_reach`. Cost: three reductions of the frame,
  /// and eight more texels a pixel of such a sprite.
  void take_backdrop();
  /// The shadow of a sprite, to be drawn before what stands on it. `sprite.image` may be empty
  /// where is_cached(shadow_key(sprite.key, shadow)); tint and fog do not count.
  void draw_shadow(const SpriteDraw& sprite, const Shadow& shadow);
  bool is_cached(const TextureKey& key) const noexcept;
  /// True if SpriteDraw::blocks can be drawn: the driver samples BC3 as sRGB. draw_actor then sends
  /// the pictures of a GPU-ready pack as they are, an eighth of what the half floats take.
  bool takes_blocks() const noexcept;
  /// Drops the cached pictures of one sprite, e.g. after its pack was loaded anew.
  void forget(std::uint64_t sprite);

  void draw_shape(const Shape& shape);
  /// Three vertices a triangle, filled, edges not smoothed.
  void draw_triangles(std::span<const Vertex> vertices, BlendMode blend = BlendMode::Over);
  /// A convex polygon with smooth edges, corners in clockwise order (y down).
  void draw_polygon(std::span<const Vec2> corners, Color color);
  /// `position`: left end (or centre, or right end) of the first line's top. ASCII, arrows
  /// (U+2190..2193) and a few more signs; a new line starts a line; unknown characters show a box.
  void draw_text(std::string_view text, Vec2 position, const TextStyle& style = {});

  /// Compiles a fragment shader. The text comes without #version and finds ready, y down:
  ///   in vec2 pixel;             centre of the pixel, frame pixels        out vec4 color;  linear,
  ///   premultiplied uniform vec2 frame_size;   frame pixels                             uniform
  ///   sampler2D scene; vec4 scene_at(vec2 pixel)  what was drawn before this pass (only if the
  ///   text uses it: a copy)
  /// Errors: BadContent, with the compiler's words and the line of the text.
  Result<Effect> make_effect(std::string_view name, std::string_view fragment);
  void run_effect(Effect effect, std::span<const Uniform> uniforms, const EffectPass& pass = {});

  /// Errors: Unavailable (no memory on the GPU for width x height).
  Result<Layer> make_layer(int width, int height, LayerFormat format = LayerFormat::Light);
  void free_layer(Layer layer);
  /// Between these two, drawing goes to the layer, whose size is then that of the frame. Not
  /// nested.
  void begin_layer(Layer layer);
  void end_layer();
  /// Stretches the layer over `area` (frame pixels; width 0: the whole frame).
  void draw_layer(Layer layer, const EffectPass& pass = {});

  /// Sends a puppet's views and mesh to the GPU (puppet.h), to be drawn any number of times.
  /// Errors: Unavailable (its views are too large for the GPU; no room for them).
  Result<PuppetSkin> make_skin(const Puppet& puppet);
  void free_skin(PuppetSkin skin);
  /// What render_puppet draws, on the GPU: the barycentre at `center`, game coordinates, `scale`
  /// game pixels a puppet px. The same faces, edges, bilinear quads and mixed views, up to the
  /// rounding of floats; of parts that pierce each other a soft edge hides as well as a solid one.
  /// Puppets of one skin that follow each other are one batch; nothing allocates once it has grown.
  /// Pre: `skin` was made of this puppet, `pose` of one with as many control points and views.
  void draw_puppet(const Puppet& puppet, const PuppetPose& pose, PuppetSkin skin, Vec2 center,
                   float scale = 1);

  /// Encodes and sends the frame to the current framebuffer of that size (0: that of the frame),
  /// fitted into its middle with black bars. Then swap the window.
  void end_frame(int window_width = 0, int window_height = 0);
  /// Returns once the GPU has drawn everything: for measuring.
  void wait();
  /// A point of the window in frame pixels, undoing the fit of the last end_frame.
  Vec2 frame_from_window(Vec2 point) const noexcept;

  /// The frame as straight sRGB RGBA, top down: inside a frame what was drawn so far, after
  /// end_frame the whole. Empty for a frame without pixels.
  Image read_pixels();

  int width() const noexcept;  ///< of the frame or layer being drawn
  int height() const noexcept;
  const RendererStats& stats() const noexcept;
  /// "OpenGL 4.5, llvmpipe", for overlays and reports; it says "8 bits a channel" where the driver
  /// cannot draw half floats: the same pictures, with coarser gradients.
  const std::string& device() const noexcept;

  struct Impl;
  explicit Renderer(std::unique_ptr<Impl> impl) noexcept;

 private:
  std::unique_ptr<Impl> impl_;
};

/// Asks `load` for the functions of the current context, now and never again.
/// Errors: Unavailable (no current context, or older than OpenGL 3.3 / ES 3).
Result<Renderer> make_renderer(GlLoader load, const RendererConfig& config = {});

/// Width of the longest line and height of all, game pixels.
Vec2 measure_text(std::string_view text, const TextStyle& style = {}) noexcept;

/// Draws an actor where it is, `fraction` of a tick after its last step, over its filmed shadow
/// where the pack has one (shadow.h). `look` may set scale, angle, mirror, tint and fog, and move
/// it: its position is added.
void draw_actor(Renderer& renderer, const Sprite& sprite, FrameCache& frames, const Actor& actor,
                float fraction = 0, const SpriteDraw& look = {});
/// The same, its jumps faded (show.h): call follow(sprite, actor, fade) after every step.
void draw_actor(Renderer& renderer, const Sprite& sprite, FrameCache& frames, const Actor& actor,
                const ActorFade& fade, float fraction = 0, const SpriteDraw& look = {});

/// Drops the cached pictures of a sprite, before another takes its place (reload.h).
void forget(Renderer& renderer, const Sprite& sprite);

/// One of many actors. The pointers are borrowed for the call; `fade` may be null.
struct ActorDraw {
  const Sprite* sprite = nullptr;
  FrameCache* frames = nullptr;
  const Actor* actor = nullptr;
  const ActorFade* fade = nullptr;
  SpriteDraw look{};  ///< as for draw_actor
  /// Greater is nearer and drawn later; NaN: where it stands, y of its position.
  float depth = std::numeric_limits<float>::quiet_NaN();
};

/// All shadows, then all actors from far to near; those of one depth in the order given. A sprite's
/// shadow is the filmed one where its pack has them, else `shadow`, or with null none.
void draw_actors(Renderer& renderer, std::span<const ActorDraw> actors, float fraction = 0,
                 const Shadow* shadow = nullptr);

}  // namespace vsprite
