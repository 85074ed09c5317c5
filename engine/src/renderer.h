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
constexpr int kMostTaps = 4;          // samples along a pixel's footprint
constexpr int kSpriteVectors = 9;     // of an instance

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

/// Cells of the frame, 64 to a side, a bit each: what a batch is drawn on.
struct Cells {
  static constexpr int kSide = 64;
  /// Inclusive; the least there is where nothing is said.
  struct Span {
    int left = 0, top = 0, right = kSide - 1, bottom = kSide - 1;
    std::uint64_t columns() const { return ~std::uint64_t{0} >> (63 - right + left) << left; }
  };
  std::array<std::uint64_t, kSide> rows{};

  bool meet(const Span& span) const {
    for (int y = span.top; y <= span.bottom; ++y)
      if ((rows[static_cast<std::size_t>(y)] & span.columns()) != 0) return true;
    return false;
  }
  void add(const Span& span) {
    for (int y = span.top; y <= span.bottom; ++y)
      rows[static_cast<std::size_t>(y)] |= span.columns();
  }
};

/// What all instances of a batch have in common.
struct BatchState {
  Kind kind = Kind::Nothing;
  BlendMode blend = BlendMode::Over;
  int page = -1;      // of puppets: their skin
  int old_page = -1;  // -1: nothing fades
  int taps = 1;
  bool wrapped = false;
  friend bool operator==(const BatchState&, const BatchState&) = default;
};

struct Batch {
  BatchState state;
  Cells cells;
  std::vector<float> words;
  /// Of sprites: the same instances, each no larger than what it hides for certain.
  std::vector<float> cores;
  float hidden = 0;  ///< pixels of all cores
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

  std::array<detail::gl::Target, detail::kHalvings> backdrop{};  ///< each half of the one before
  bool has_backdrop = false;                                     ///< of the present surface
  std::vector<detail::Batch> batches;  ///< the first `waiting` of them are still to be drawn
  std::size_t waiting = 0;
  std::vector<std::uint16_t> staging;
  std::vector<float> turned;  ///< the cores of a batch, the last one first
  std::uint32_t uncached = 0;

  explicit Impl(const RendererConfig& c, detail::gl::Device d)
      : config(c),
        device(std::move(d)),
        atlas(std::min(detail::kPageSide, device.max_size), device.max_size, c.texture_budget) {}
  ~Impl();

  Result<void> set_up();
  /// Draws what waits.
  void flush();
  void flush(const detail::Batch& sprites_or_shapes);
  /// Cores from front to back and then all, which depth keeps from what is hidden. False if that
  /// is not worth it.
  bool draw_by_depth(const detail::Batch& sprites, detail::Program& program);
  void flush_puppets(const detail::Batch& batch);
  Result<void> set_up_puppets();
  void free_puppets();
  /// The batch that takes what is drawn next, within `where`. What shares no cell with it may be
  /// drawn earlier or later: few changes of state, and pictures that come up while it waits are
  /// sent before anything is drawn from their pages. Valid until the next call.
  detail::Batch& open(const detail::BatchState& state, const detail::Cells::Span& where = {});
  detail::Cells::Span cells_of(Vec2 center, Vec2 half_size) const noexcept;
  void use_surface(detail::Surface* surface);
  void drop_frame();
  std::optional<detail::AtlasSlot> place(const TextureKey& key, int width, int height,
                                         detail::PageForm form);
  std::optional<detail::AtlasSlot> store(const TextureKey& key, ImageView image, int side = 1);
  std::optional<detail::AtlasSlot> store(const TextureKey& key, BlockView blocks);
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
