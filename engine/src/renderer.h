// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// renderer.h - what a Renderer holds; shared by draw.cpp, draw_*.cpp.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "atlas.h"
#include "gl.h"
#include "light_table.h"
#include "vsprite/draw.h"

namespace vsprite {
namespace detail {

struct Program {
  std::string name;
  gl::Id id = 0;
  std::map<std::string, int, std::less<>> locations;
  const gl::Device* device = nullptr;  // the renderer's

  int location(std::string_view uniform) {
    const auto found = locations.find(uniform);
    if (found != locations.end()) return found->second;
    std::string key(uniform);
    const int place = gl::find_uniform(*device, id, key.c_str());
    return locations.emplace(std::move(key), place).first->second;
  }
  void set(std::string_view uniform, std::initializer_list<float> values) {
    gl::set(*device, location(uniform), static_cast<int>(values.size()),
            {values.begin(), values.size()});
  }
};

/// What is drawn into: the frame or a layer, with a copy for effects that look at it.
struct Surface {
  gl::Target main;
  gl::Target copy;
  void free(const gl::Device& device) {
    gl::free_target(device, main);
    gl::free_target(device, copy);
  }
};

constexpr int kPageSide = 2048;
constexpr std::size_t kHalvings = 3;  // of the frame, for the backdrop's light
constexpr int kMostTaps = 4;  // samples along a pixel's footprint

enum class Kind { Nothing, Sprites, Shapes, Triangles, Puppets };

/// What the GPU holds of a puppet.
struct Skin {
  gl::Id page = 0;    // its views, each with a border of zeros
  gl::Id places = 0;  // for every view its control points, texels of the page; then its rectangle
  int width = 0, height = 0;
  std::size_t views = 0, points = 0;
};

/// All that is kept for drawing puppets, made with the first skin.
struct PuppetBrush {
  Program program;
  gl::Stream stream;
  gl::Id shares_texture = 0;
  std::vector<Skin> skins;
  std::vector<float> shares;  // of the batch, a texel each
  std::vector<Vec2> placed;   // control points of the puppet at hand, frame pixels
  std::vector<float> steps;   // their depths
  std::vector<std::uint32_t> order;
  std::vector<float> keys;
  int slices = 0;  // of depth, used since it was cleared; 0: it has to be
};

/// One instance of the sprite shader, whose words these are.
struct Picture {
  AtlasSlot slot;
  Vec2 corner;
  Vec2 x_axis{1, 0}, y_axis{0, 1};
  Color tint;
  Color fog;
  float fog_amount = 0;
  float footprint = 1;  ///< pixels
  std::optional<AtlasSlot> old{};
  Vec2 shift{};
  float share = 0;
  float wrap = 0, wrap_reach = 0;
};

}  // namespace detail

struct Renderer::Impl {
  RendererConfig config;
  RendererStats stats;
  detail::gl::Device device;
  detail::LightTable light;
  detail::Atlas atlas;
  std::vector<detail::gl::Id> pages;
  /// [taps - 1][fading + 2 wrapped]; those beyond the first are compiled when they are needed.
  std::array<std::array<detail::Program, 4>, detail::kMostTaps> sprite_programs;
  detail::Program shape_program, flat_program, window_program, file_program;
  detail::gl::Stream sprite_stream, shape_stream, flat_stream, empty_stream;
  std::vector<detail::Program> effects;
  Effect layer_effect;
  std::vector<detail::Surface> layers;
  detail::Surface frame;
  detail::PuppetBrush puppets;
  detail::gl::Target encoded;
  detail::Surface* target = nullptr;  // null: drawing does nothing
  bool in_frame = false;
  detail::gl::Id window_framebuffer = 0;
  Rect window_fit;
  Camera camera;

  detail::Kind kind = detail::Kind::Nothing;
  BlendMode blend = BlendMode::Over;
  int page = -1, old_page = -1;  // of a batch of sprites; old_page -1: none of them fades
  int taps = 1;
  bool wrapped = false;
  std::array<detail::gl::Target, detail::kHalvings> backdrop{};  ///< each half of the one before
  bool has_backdrop = false;                                     ///< of the present surface
  std::vector<float> batch;
  std::vector<std::uint16_t> staging;
  std::uint32_t uncached = 0;

  explicit Impl(const RendererConfig& c, detail::gl::Device d)
      : config(c),
        device(std::move(d)),
        atlas(std::min(detail::kPageSide, device.max_size), device.max_size, c.texture_budget) {}
  ~Impl();

  Result<void> set_up();
  void flush();
  void flush_puppets();
  Result<void> set_up_puppets();
  void free_puppets();
  void select(detail::Kind wanted, BlendMode mode, int wanted_page = -1, int wanted_old = -1,
              int wanted_taps = 1, bool wanted_wrap = false);
  void use_surface(detail::Surface* surface);
  void drop_frame();
  std::optional<detail::AtlasSlot> place(const TextureKey& key, int width, int height,
                                         detail::PageForm form);
  std::optional<detail::AtlasSlot> store(const TextureKey& key, ImageView image, int side = 1);
  std::optional<detail::AtlasSlot> store(const TextureKey& key, BlockView blocks);
  void push(std::initializer_list<float> values) {
    batch.insert(batch.end(), values.begin(), values.end());
  }
  void set_axes(const SpriteDraw& sprite, detail::Picture& picture) const;
  /// So that `texel` of the picture comes to lie at `position`.
  void put_at(Vec2 position, Vec2 texel, detail::Picture& picture) const;
  void push_shadow(const SpriteDraw& sprite, const Fade& of, const Shadow& shadow);
  void push_picture(const detail::Picture& picture);
  /// The picture's place on a page; it is sent there if need be, of squares of `side` pixels one
  /// texel each (blocks as they are). Nothing if there is no picture.
  std::optional<detail::AtlasSlot> find_or_store(const TextureKey& key, ImageView image,
                                                 int side = 1, BlockView blocks = {});
  bool takes_blocks() const noexcept { return config.blocks && device.block_format != 0; }
  /// Null if the driver refuses the variant.
  detail::Program* sprite_program(int taps, bool fading, bool wrapped);
  Vec2 to_frame(Vec2 p) const noexcept {
    return {(p.x - camera.origin.x) * camera.scale + camera.offset.x,
            (p.y - camera.origin.y) * camera.scale + camera.offset.y};
  }
  /// The whole frame into the current viewport, of the same size.
  void encode(detail::Program& program, bool flip);
  /// The same into `encoded`. False if the GPU has no memory for it.
  bool encode_apart(detail::Program& program);
  void draw_line_of_text(std::string_view text, Vec2 at, float size, const TextStyle& style);
};

}  // namespace vsprite
