// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Effects, layers, and the way out: the frame encoded for the window or a file.
#include <algorithm>
#include <cmath>

#include "renderer.h"
#include "shaders/sprite.h"

namespace vsprite {

namespace gl = detail::gl;
namespace glsl = shaders::sprite;
using detail::Program;

namespace {

constexpr std::string_view kEffectPrelude =
    "in vec2 pixel;\n"
    "out vec4 color;\n"
    "uniform vec2 frame_size;\n"
    "uniform sampler2D scene;\n"
    "vec4 scene_at(vec2 at) { return texture(scene, at / frame_size); }\n";

}  // namespace

Result<Effect> Renderer::make_effect(std::string_view name, std::string_view fragment) {
  Result<gl::Id> id =
      gl::make_program(impl_->device, name, glsl::effect_vert, kEffectPrelude, fragment);
  if (!id) return std::move(id).error();
  impl_->effects.push_back({std::string(name), *id, {}, &impl_->device});
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
    gl::copy(m.device, main, m.target->copy);
    gl::draw_to(m.device, main);
  }
  gl::use(m.device, program.id);
  if (scene >= 0) {
    gl::bind(m.device, 0, m.target->copy.texture);
    gl::set_sampler(m.device, scene, 0);
  }
  int unit = 1;
  for (const Uniform& u : uniforms) {
    const int place = program.location(u.name);
    if (place < 0) continue;
    if (u.components == 0) {
      if (u.layer.id < 0) continue;
      gl::bind(m.device, unit, m.layers[static_cast<std::size_t>(u.layer.id)].main.texture);
      gl::set_sampler(m.device, place, unit++);
    } else if (!u.values.empty()) {
      gl::set(m.device, place, u.components, u.values);
    } else {
      gl::set(m.device, place, u.components,
              {u.value.data(), static_cast<std::size_t>(u.components)});
    }
  }
  const Rect area = pass.area.width > 0 ? pass.area : Rect{0, 0, main.width, main.height};
  program.set("frame_size", {static_cast<float>(main.width), static_cast<float>(main.height)});
  program.set("area", {static_cast<float>(area.x), static_cast<float>(area.y),
                       static_cast<float>(area.width), static_cast<float>(area.height)});
  gl::blend(m.device, pass.blend);
  gl::draw_rectangle(m.device, m.empty_stream);
  ++m.stats.batches;
}

Result<Layer> Renderer::make_layer(int width, int height, LayerFormat format) {
  Result<gl::Target> made = gl::make_target(impl_->device, std::max(width, 1), std::max(height, 1),
                                            format == LayerFormat::Bytes);
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
  if (layer.id >= 0) impl_->layers[static_cast<std::size_t>(layer.id)].free(impl_->device);
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

void Renderer::Impl::encode(Program& program, bool flip) {
  gl::use(device, program.id);
  gl::bind(device, 0, frame.main.texture);
  gl::set_sampler(device, program.location("frame"), 0);
  program.set("frame_size",
              {static_cast<float>(frame.main.width), static_cast<float>(frame.main.height)});
  program.set("flip", {flip ? 1.0f : 0.0f});
  gl::blend(device, BlendMode::Replace);
  gl::draw_rectangle(device, empty_stream);
}

bool Renderer::Impl::encode_apart(Program& program) {
  const int width = frame.main.width, height = frame.main.height;
  if (encoded.framebuffer == 0) {
    auto made = gl::make_target(device, width, height, true);
    if (!made) return false;
    encoded = *made;
  }
  gl::draw_to_window(device, encoded.framebuffer, {0, 0, width, height});
  encode(program, false);
  return true;
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
  const Rect place{r.x, window_height - r.y - r.height, r.width, r.height};
  const bool exact = r.width == width && r.height == height;
  if (!exact && !m.encode_apart(m.window_program)) return;
  gl::draw_to_window(m.device, m.window_framebuffer, place);
  if (r.width != window_width || r.height != window_height) gl::clear(m.device, 0, 0, 0, 1);
  if (exact) {
    m.encode(m.window_program, true);
  } else {
    gl::stretch(m.device, m.encoded, m.window_framebuffer, place);
  }
}

void Renderer::wait() { gl::finish(impl_->device); }

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
  Image image{width, height, {}};
  image.rgba.resize(std::size_t(width) * std::size_t(height) * 4);
  const gl::Id before = gl::current_framebuffer(m.device);
  if (!m.encode_apart(m.file_program)) return {};
  gl::read(m.device, m.encoded, image.rgba.data());
  if (m.target != nullptr) {
    gl::draw_to(m.device, m.target->main);
  } else {
    gl::draw_to_window(m.device, before, {0, 0, width, height});
  }
  return image;
}

}  // namespace vsprite
