// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The renderer: turns calls into batches, keeps pictures on texture pages, encodes the frame.
//
// Compositing is Porter and Duff's "over" (SIGGRAPH 1984) on premultiplied linear light. A picture
// is stored sRGB-encoded and multiplied by alpha, c = a f(l); linear premultiplied light is a
// f^-1(c / a), tabulated for all 65,536 pairs (a, c). Filtering before this conversion would darken
// soft edges.
#include "vsprite/draw.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "atlas.h"
#include "font.h"
#include "gl.h"
#include "shaders/sprite.h"

namespace vsprite {
namespace {

namespace gl = detail::gl;
namespace glsl = shaders::sprite;

constexpr int kPageSide = 2048;
constexpr std::size_t kTexelBytes = 8;  // four half floats
constexpr std::uint64_t kFontSprite = ~std::uint64_t{0};

constexpr std::string_view kEffectPrelude =
    "in vec2 pixel;\n"
    "out vec4 color;\n"
    "uniform vec2 frame_size;\n"
    "uniform sampler2D scene;\n"
    "vec4 scene_at(vec2 at) { return texture(scene, at / frame_size); }\n";

float linear_value(float encoded) noexcept {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

/// IEEE 754 binary16 of x in [0, 1], rounded to nearest.
std::uint16_t half_from_float(float x) noexcept {
  // Adding a power of two makes the float unit drop the bits that a half has no room for.
  if (x < 6.103515625e-5f) return static_cast<std::uint16_t>(x * 16777216.0f + 0.5f);
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x) + 0x1000u;
  return static_cast<std::uint16_t>((bits >> 13) - ((127u - 15u) << 10));
}

/// (alpha, encoded premultiplied value) -> linear premultiplied value.
class LightTable {
 public:
  LightTable() : halves_(65536) {
    for (unsigned a = 1; a < 256; ++a) {
      for (unsigned c = 0; c < 256; ++c) {
        const float straight = std::min(1.0f, static_cast<float>(c) / static_cast<float>(a));
        const float light = linear_value(straight) * static_cast<float>(a) / 255.0f;
        halves_[a << 8 | c] = half_from_float(light);
      }
    }
  }
  void convert(const std::uint8_t* rgba, std::uint16_t* out) const noexcept {
    const std::uint16_t* row = &halves_[std::size_t{rgba[3]} << 8];
    out[0] = row[rgba[0]];
    out[1] = row[rgba[1]];
    out[2] = row[rgba[2]];
    out[3] = row[rgba[3]];  // f^-1(a / a) a = a
  }

 private:
  std::vector<std::uint16_t> halves_;
};

struct Program {
  std::string name;
  gl::Id id = 0;
  std::map<std::string, int, std::less<>> locations;

  int location(std::string_view uniform) {
    const auto found = locations.find(uniform);
    if (found != locations.end()) return found->second;
    std::string key(uniform);
    const int place = gl::find_uniform(id, key.c_str());
    return locations.emplace(std::move(key), place).first->second;
  }
  void set(std::string_view uniform, std::initializer_list<float> values) {
    gl::set(location(uniform), static_cast<int>(values.size()), {values.begin(), values.size()});
  }
};

/// What is drawn into: the frame or a layer, with a copy for effects that look at it.
struct Surface {
  gl::Target main;
  gl::Target copy;
  void free() {
    gl::free_target(main);
    gl::free_target(copy);
  }
};

enum class Kind { Nothing, Sprites, Shapes, Triangles };

}  // namespace

struct Renderer::Impl {
  RendererConfig config;
  RendererStats stats;
  gl::Device device;
  LightTable light;
  detail::Atlas atlas;
  std::vector<gl::Id> pages;
  Program sprite_program, shape_program, flat_program, fit_program, exact_program;
  gl::Stream sprite_stream, shape_stream, flat_stream, empty_stream;
  std::vector<Program> effects;
  Effect layer_effect;
  std::vector<Surface> layers;
  Surface frame;
  gl::Target encoded;
  Surface* target = nullptr;  // null: drawing does nothing
  bool in_frame = false;
  gl::Id window_framebuffer = 0;
  Rect window_fit;
  Camera camera;

  Kind kind = Kind::Nothing;
  BlendMode blend = BlendMode::Over;
  int page = -1;
  std::vector<float> batch;
  std::vector<std::uint16_t> staging;
  std::uint32_t uncached = 0;

  explicit Impl(const RendererConfig& c, gl::Device d)
      : config(c),
        device(std::move(d)),
        atlas(std::min(kPageSide, device.max_size), device.max_size, c.texture_budget,
              kTexelBytes) {}
  ~Impl();

  Result<void> set_up();
  void flush();
  void select(Kind wanted, BlendMode mode, int wanted_page = -1);
  void use_surface(Surface* surface);
  void drop_frame();
  std::optional<detail::AtlasSlot> store(const TextureKey& key, ImageView image);
  void push(std::initializer_list<float> values) {
    batch.insert(batch.end(), values.begin(), values.end());
  }
  void push_picture(const detail::AtlasSlot& slot, Vec2 corner, Vec2 x_axis, Vec2 y_axis,
                    Color tint, Color fog, float fog_amount);
  Vec2 to_frame(Vec2 p) const noexcept {
    return {(p.x - camera.origin.x) * camera.scale + camera.offset.x,
            (p.y - camera.origin.y) * camera.scale + camera.offset.y};
  }
  void encode(bool straight, bool flip, bool exact);
  void draw_line_of_text(std::string_view text, Vec2 at, float size, const TextStyle& style);
};

Renderer::Impl::~Impl() {
  for (gl::Id id : pages) gl::free_texture(id);
  for (Program* p :
       {&sprite_program, &shape_program, &flat_program, &fit_program, &exact_program}) {
    if (p->id != 0) gl::free_program(p->id);
  }
  for (Program& effect : effects) gl::free_program(effect.id);
  for (gl::Stream* s : {&sprite_stream, &shape_stream, &flat_stream, &empty_stream}) {
    gl::free_stream(*s);
  }
  for (Surface& layer : layers) layer.free();
  frame.free();
  gl::free_target(encoded);
}

Result<void> Renderer::Impl::set_up() {
  const auto build = [&](Program& program, std::string_view name, std::string_view vert,
                         std::string_view frag, std::string_view prelude = "") -> Result<void> {
    program.name = name;
    Result<gl::Id> id = gl::make_program(device, name, vert, prelude, frag);
    if (!id) return std::move(id).error();
    program.id = *id;
    return {};
  };
  if (auto r = build(sprite_program, "sprite", glsl::sprite_vert, glsl::sprite_frag); !r) return r;
  if (auto r = build(shape_program, "shape", glsl::shape_vert, glsl::shape_frag); !r) return r;
  if (auto r = build(flat_program, "flat", glsl::flat_vert, glsl::flat_frag); !r) return r;
  if (auto r = build(fit_program, "encode", glsl::encode_vert, glsl::encode_frag); !r) return r;
  if (auto r =
          build(exact_program, "encode", glsl::encode_vert, glsl::encode_frag, "#define EXACT\n");
      !r) {
    return r;
  }
  sprite_stream = gl::make_stream(5, true);
  shape_stream = gl::make_stream(4, true);
  flat_stream = gl::make_stream(2, false);
  empty_stream = gl::make_stream(0, false);
  return {};
}

void Renderer::Impl::flush() {
  const Kind what = std::exchange(kind, Kind::Nothing);
  if (what == Kind::Nothing || batch.empty()) return;
  const bool sprites = what == Kind::Sprites;
  Program& program = sprites ? sprite_program : what == Kind::Shapes ? shape_program : flat_program;
  const gl::Stream& stream = sprites                ? sprite_stream
                             : what == Kind::Shapes ? shape_stream
                                                    : flat_stream;
  gl::use(program.id);
  program.set("frame_size",
              {static_cast<float>(target->main.width), static_cast<float>(target->main.height)});
  if (sprites) {
    gl::bind(0, pages[static_cast<std::size_t>(page)]);
    gl::set_sampler(program.location("page"), 0);
    program.set("page_size", {static_cast<float>(atlas.page_width(page)),
                              static_cast<float>(atlas.page_height(page))});
  }
  gl::blend(blend);
  gl::draw(stream, batch.data(), batch.size() / (4 * static_cast<std::size_t>(stream.vectors)));
  batch.clear();
  ++stats.batches;
}

void Renderer::Impl::select(Kind wanted, BlendMode mode, int wanted_page) {
  if (kind == wanted && blend == mode && page == wanted_page) return;
  flush();
  kind = wanted;
  blend = mode;
  page = wanted_page;
}

void Renderer::Impl::use_surface(Surface* surface) {
  flush();
  target = surface;
  camera = {};
  if (surface != nullptr) gl::draw_to(device, surface->main);
}

std::optional<detail::AtlasSlot> Renderer::Impl::store(const TextureKey& key, ImageView image) {
  const int width = image.width + 2, height = image.height + 2;  // a border of zeros
  const auto placed = atlas.insert(key, width, height);
  if (!placed) return std::nullopt;
  const std::size_t index = static_cast<std::size_t>(placed->slot.page);
  if (placed->page != detail::Atlas::Page::Same) {
    flush();  // what waits may show pictures of the page that was emptied
    if (index < pages.size()) {
      ++stats.evictions;
    } else {
      pages.push_back(0);
    }
  }
  if (placed->page == detail::Atlas::Page::New) {
    if (pages[index] != 0) gl::free_texture(pages[index]);
    pages[index] =
        gl::make_texture(atlas.page_width(placed->slot.page), atlas.page_height(placed->slot.page));
  }
  staging.assign(std::size_t(width) * std::size_t(height) * 4, 0);
  for (int y = 0; y < image.height; ++y) {
    std::uint16_t* out = &staging[(std::size_t(y + 1) * std::size_t(width) + 1) * 4];
    for (int x = 0; x < image.width; ++x, out += 4) light.convert(image.pixel(x, y), out);
  }
  gl::upload(pages[index], placed->slot.rect, staging.data());
  ++stats.uploads;
  stats.texture_bytes = atlas.bytes();
  return placed->slot;
}

void Renderer::Impl::push_picture(const detail::AtlasSlot& slot, Vec2 corner, Vec2 x_axis,
                                  Vec2 y_axis, Color tint, Color fog, float fog_amount) {
  select(Kind::Sprites, BlendMode::Over, slot.page);
  const Rect& r = slot.rect;
  push({corner.x, corner.y, 0, 0, x_axis.x, x_axis.y, y_axis.x, y_axis.y});
  push({static_cast<float>(r.x + 1), static_cast<float>(r.y + 1), static_cast<float>(r.width - 2),
        static_cast<float>(r.height - 2)});
  push({tint.r, tint.g, tint.b, tint.a, fog.r, fog.g, fog.b, fog_amount});
  ++stats.sprites;
}

Color srgb(std::uint32_t rgb, float alpha) noexcept {
  const auto channel = [&](unsigned shift) {
    return linear_value(static_cast<float>(rgb >> shift & 255u) / 255.0f);
  };
  return {channel(16), channel(8), channel(0), alpha};
}

Shape disc(Vec2 center, float radius, Color color) noexcept {
  return {.center = center, .half_size = {radius, radius}, .radius = radius, .color = color};
}

Shape line(Vec2 from, Vec2 to, float width, Color color) noexcept {
  const float dx = to.x - from.x, dy = to.y - from.y;
  const float length = std::sqrt(dx * dx + dy * dy);
  return {.center = {0.5f * (from.x + to.x), 0.5f * (from.y + to.y)},
          .half_size = {0.5f * (length + width), 0.5f * width},
          .radius = 0.5f * width,
          .angle = length > 0 ? std::atan2(dy, dx) : 0.0f,
          .color = color};
}

Shape box(Vec2 from, Vec2 to, Color color, float radius) noexcept {
  return {.center = {0.5f * (from.x + to.x), 0.5f * (from.y + to.y)},
          .half_size = {0.5f * (to.x - from.x), 0.5f * (to.y - from.y)},
          .radius = radius,
          .color = color};
}

Result<Renderer> make_renderer(const RendererConfig& config) {
  Result<gl::Device> device = gl::probe();
  if (!device) return std::move(device).error();
  auto impl = std::make_unique<Renderer::Impl>(config, std::move(*device));
  if (auto done = impl->set_up(); !done) return std::move(done).error();
  Renderer renderer(std::move(impl));
  Result<Effect> effect = renderer.make_effect("layer", glsl::layer_frag);
  if (!effect) return std::move(effect).error();
  return renderer;
}

Renderer::Renderer(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

int Renderer::width() const noexcept { return impl_->target ? impl_->target->main.width : 0; }
int Renderer::height() const noexcept { return impl_->target ? impl_->target->main.height : 0; }
const RendererStats& Renderer::stats() const noexcept { return impl_->stats; }
const std::string& Renderer::device() const noexcept { return impl_->device.name; }
const Camera& Renderer::camera() const noexcept { return impl_->camera; }
void Renderer::set_camera(const Camera& camera) { impl_->camera = camera; }

void Renderer::begin_frame(int width, int height) {
  Impl& m = *impl_;
  m.window_framebuffer = gl::current_framebuffer();
  m.stats.sprites = m.stats.batches = m.stats.uploads = 0;
  m.batch.clear();
  m.kind = Kind::Nothing;
  m.in_frame = true;
  if (m.frame.main.width != width || m.frame.main.height != height) {
    m.frame.free();
    gl::free_target(m.encoded);
    if (width > 0 && height > 0) {
      if (auto made = gl::make_target(m.device, width, height, false)) m.frame.main = *made;
    }
  }
  m.use_surface(m.frame.main.framebuffer != 0 ? &m.frame : nullptr);
  if (m.target != nullptr) gl::clear(0, 0, 0, 1);
}

void Renderer::clear(Color color) {
  if (impl_->target == nullptr) return;
  impl_->flush();
  gl::clear(color.r * color.a, color.g * color.a, color.b * color.a, color.a);
}

bool Renderer::is_cached(const TextureKey& key) const noexcept {
  return key.sprite != 0 && impl_->atlas.has(key);
}

void Renderer::forget(std::uint64_t sprite) { impl_->atlas.forget(sprite); }

void Renderer::draw_sprite(const SpriteDraw& s) {
  Impl& m = *impl_;
  if (m.target == nullptr) return;
  std::optional<detail::AtlasSlot> slot;
  if (s.key.sprite != 0) slot = m.atlas.find(s.key);
  if (!slot) {
    if (s.image.rgba == nullptr || s.image.width <= 0 || s.image.height <= 0) return;
    slot = m.store(s.key.sprite != 0 ? s.key : TextureKey{0, m.uncached++}, s.image);
    if (!slot) return;
  }
  const float scale = s.scale * m.camera.scale;
  const float c = std::cos(s.angle) * scale, n = std::sin(s.angle) * scale;
  const float side = s.mirror ? -1.0f : 1.0f;
  const Vec2 x_axis{side * c, side * n}, y_axis{-n, c};
  const Vec2 at = m.to_frame(s.position);
  const Vec2 corner{at.x - x_axis.x * s.anchor.x - y_axis.x * s.anchor.y,
                    at.y - x_axis.y * s.anchor.x - y_axis.y * s.anchor.y};
  m.push_picture(*slot, corner, x_axis, y_axis, s.tint, s.fog, s.fog_amount);
}

void Renderer::draw_shape(const Shape& s) {
  Impl& m = *impl_;
  if (m.target == nullptr) return;
  m.select(Kind::Shapes, s.blend);
  const Vec2 at = m.to_frame(s.center);
  const float k = m.camera.scale;
  m.push({at.x, at.y, s.half_size.x * k, s.half_size.y * k});
  m.push({std::cos(s.angle), std::sin(s.angle), s.radius * k, s.outline * k});
  m.push({s.feather * k, 0, 0, 0, s.color.r, s.color.g, s.color.b, s.color.a});
}

void Renderer::draw_triangles(std::span<const Vertex> vertices, BlendMode blend) {
  Impl& m = *impl_;
  if (m.target == nullptr) return;
  m.select(Kind::Triangles, blend);
  for (const Vertex& v : vertices.first(vertices.size() / 3 * 3)) {
    const Vec2 at = m.to_frame(v.position);
    m.push({at.x, at.y, 0, 0, v.color.r, v.color.g, v.color.b, v.color.a});
  }
}

void Renderer::draw_polygon(std::span<const Vec2> corners, Color color) {
  // The polygon shrunk by half a pixel, with a rim of one pixel that fades to nothing.
  const std::size_t n = corners.size();
  if (n < 3 || impl_->target == nullptr) return;
  const float half = 0.5f / impl_->camera.scale;
  const auto normal = [&](std::size_t i) {  // of the edge i -> i + 1, outwards
    const Vec2 a = corners[i % n], b = corners[(i + 1) % n];
    const float dx = b.x - a.x, dy = b.y - a.y;
    const float length = std::max(std::sqrt(dx * dx + dy * dy), 1e-6f);
    return Vec2{dy / length, -dx / length};
  };
  std::vector<Vec2> inner(n), outer(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 p = normal(i + n - 1), q = normal(i);
    const float grow = half / std::max(1 + p.x * q.x + p.y * q.y, 0.3f);
    const Vec2 d{(p.x + q.x) * grow, (p.y + q.y) * grow};
    inner[i] = {corners[i].x - d.x, corners[i].y - d.y};
    outer[i] = {corners[i].x + d.x, corners[i].y + d.y};
  }
  const Color clear{color.r, color.g, color.b, 0};
  std::vector<Vertex> triangles;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    if (i > 0 && j > 0) {
      triangles.insert(triangles.end(), {{inner[0], color}, {inner[i], color}, {inner[j], color}});
    }
    triangles.insert(triangles.end(), {{inner[i], color}, {outer[i], clear}, {outer[j], clear}});
    triangles.insert(triangles.end(), {{inner[i], color}, {outer[j], clear}, {inner[j], color}});
  }
  draw_triangles(triangles);
}

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
      if (slot) push_picture(*slot, corner, {1, 0}, {0, 1}, style.color, {}, 0);
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

Result<Effect> Renderer::make_effect(std::string_view name, std::string_view fragment) {
  Result<gl::Id> id =
      gl::make_program(impl_->device, name, glsl::effect_vert, kEffectPrelude, fragment);
  if (!id) return std::move(id).error();
  impl_->effects.push_back({std::string(name), *id, {}});
  return Effect{static_cast<int>(impl_->effects.size()) - 1};
}

void Renderer::run_effect(Effect effect, std::span<const Uniform> uniforms,
                          const EffectPass& pass) {
  Impl& m = *impl_;
  if (m.target == nullptr || effect.id < 0) return;
  m.flush();
  Program& program = m.effects[static_cast<std::size_t>(effect.id)];
  const gl::Target& main = m.target->main;
  const int scene = program.location("scene");
  if (scene >= 0) {
    if (m.target->copy.framebuffer == 0) {
      auto made = gl::make_target(m.device, main.width, main.height, false);
      if (!made) return;
      m.target->copy = *made;
    }
    gl::copy(main, m.target->copy);
    gl::draw_to(m.device, main);
  }
  gl::use(program.id);
  if (scene >= 0) {
    gl::bind(0, m.target->copy.texture);
    gl::set_sampler(scene, 0);
  }
  int unit = 1;
  for (const Uniform& u : uniforms) {
    const int place = program.location(u.name);
    if (place < 0) continue;
    if (u.components == 0) {
      if (u.layer.id < 0) continue;
      gl::bind(unit, m.layers[static_cast<std::size_t>(u.layer.id)].main.texture);
      gl::set_sampler(place, unit++);
    } else if (!u.values.empty()) {
      gl::set(place, u.components, u.values);
    } else {
      gl::set(place, u.components, {u.value.data(), static_cast<std::size_t>(u.components)});
    }
  }
  const Rect area = pass.area.width > 0 ? pass.area : Rect{0, 0, main.width, main.height};
  program.set("frame_size", {static_cast<float>(main.width), static_cast<float>(main.height)});
  program.set("area", {static_cast<float>(area.x), static_cast<float>(area.y),
                       static_cast<float>(area.width), static_cast<float>(area.height)});
  gl::blend(pass.blend);
  gl::draw_rectangle(m.empty_stream);
  ++m.stats.batches;
}

Result<Layer> Renderer::make_layer(int width, int height) {
  Result<gl::Target> made =
      gl::make_target(impl_->device, std::max(width, 1), std::max(height, 1), false);
  if (!made) return std::move(made).error();
  // A freed place is used again; surfaces are found by index, so moving the vector is harmless
  // except to the target in use.
  const bool on_layer = impl_->target != nullptr && impl_->target != &impl_->frame;
  const std::ptrdiff_t active = on_layer ? impl_->target - impl_->layers.data() : 0;
  std::size_t index = 0;
  while (index < impl_->layers.size() && impl_->layers[index].main.framebuffer != 0) ++index;
  if (index == impl_->layers.size()) impl_->layers.emplace_back();
  impl_->layers[index].main = *made;
  if (on_layer) impl_->target = impl_->layers.data() + active;
  return Layer{static_cast<int>(index)};
}

void Renderer::free_layer(Layer layer) {
  if (layer.id >= 0) impl_->layers[static_cast<std::size_t>(layer.id)].free();
}

void Renderer::begin_layer(Layer layer) {
  if (layer.id < 0) return;
  impl_->use_surface(&impl_->layers[static_cast<std::size_t>(layer.id)]);
}

void Renderer::end_layer() {
  const bool back = impl_->in_frame && impl_->frame.main.framebuffer != 0;
  impl_->use_surface(back ? &impl_->frame : nullptr);
}

void Renderer::draw_layer(Layer layer, const EffectPass& pass) {
  const Uniform picture("layer", layer);
  run_effect(Effect{0}, {&picture, 1}, pass);
}

void Renderer::Impl::encode(bool straight, bool flip, bool exact) {
  Program& program = exact ? exact_program : fit_program;
  gl::use(program.id);
  gl::bind(0, frame.main.texture);
  gl::set_sampler(program.location("frame"), 0);
  program.set("frame_size",
              {static_cast<float>(frame.main.width), static_cast<float>(frame.main.height)});
  program.set("straight", {straight ? 1.0f : 0.0f});
  program.set("flip", {flip ? 1.0f : 0.0f});
  program.set("dither", {config.dither ? 1.0f : 0.0f});
  gl::blend(BlendMode::Replace);
  gl::draw_rectangle(empty_stream);
}

void Renderer::end_frame(int window_width, int window_height) {
  Impl& m = *impl_;
  m.flush();
  m.in_frame = false;
  if (m.target == nullptr) return;
  m.target = nullptr;
  const int width = m.frame.main.width, height = m.frame.main.height;
  if (window_width <= 0 || window_height <= 0) {
    window_width = width;
    window_height = height;
  }
  const double fit = std::min(double(window_width) / width, double(window_height) / height);
  Rect& r = m.window_fit;
  r.width = std::max(1, static_cast<int>(std::lround(width * fit)));
  r.height = std::max(1, static_cast<int>(std::lround(height * fit)));
  r.x = (window_width - r.width) / 2;
  r.y = (window_height - r.height) / 2;
  // OpenGL counts the window's rows from the bottom.
  gl::draw_to_window(m.window_framebuffer,
                     {r.x, window_height - r.y - r.height, r.width, r.height});
  if (r.width != window_width || r.height != window_height) gl::clear(0, 0, 0, 1);
  m.encode(false, true, r.width == width && r.height == height);
}

Vec2 Renderer::frame_from_window(Vec2 point) const noexcept {
  const Rect& r = impl_->window_fit;
  if (r.width <= 0 || r.height <= 0) return point;
  const gl::Target& main = impl_->frame.main;
  return {(point.x - static_cast<float>(r.x)) * static_cast<float>(main.width) /
              static_cast<float>(r.width),
          (point.y - static_cast<float>(r.y)) * static_cast<float>(main.height) /
              static_cast<float>(r.height)};
}

Image Renderer::read_pixels() {
  Impl& m = *impl_;
  m.flush();
  const int width = m.frame.main.width, height = m.frame.main.height;
  if (m.frame.main.framebuffer == 0) return {};
  if (m.encoded.framebuffer == 0) {
    auto made = gl::make_target(m.device, width, height, true);
    if (!made) return {};
    m.encoded = *made;
  }
  Image image{width, height, {}};
  image.rgba.resize(std::size_t(width) * std::size_t(height) * 4);
  const gl::Id before = gl::current_framebuffer();
  gl::draw_to_window(m.encoded.framebuffer, {0, 0, width, height});
  m.encode(true, false, true);
  gl::read(m.encoded, image.rgba.data());
  if (m.target != nullptr) {
    gl::draw_to(m.device, m.target->main);
  } else {
    gl::draw_to_window(before, {0, 0, width, height});
  }
  return image;
}

void draw_actor(Renderer& renderer, const Sprite& sprite, FrameCache& frames, const Actor& actor,
                float fraction, const SpriteDraw& look) {
  SpriteDraw s = look;
  const Vec2 at = draw_position(sprite, actor, fraction);
  s.position = {at.x + look.position.x, at.y + look.position.y};
  s.anchor = sprite.samples()[actor.sample].anchor;
  s.key = {reinterpret_cast<std::uintptr_t>(&sprite.data()), actor.sample};
  if (!renderer.is_cached(s.key)) s.image = frames.frame(actor.sample);
  renderer.draw_sprite(s);
}

}  // namespace vsprite
