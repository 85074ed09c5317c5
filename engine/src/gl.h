// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// gl.h - the dozen OpenGL operations that the renderer is made of. Everything is y down: the first
// row of every texture and target is the top one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "vsprite/draw.h"
#include "vsprite/geometry.h"
#include "vsprite/result.h"

namespace vsprite::detail::gl {

using Id = unsigned;

struct Device {
  std::string name;
  bool es = false;
  bool half_target = false;  ///< RGBA16F can be drawn into; else sRGB8, with the same blending
  int max_size = 0;          ///< of a texture's side
};

/// A texture that can be drawn into.
struct Target {
  Id framebuffer = 0;
  Id texture = 0;
  int width = 0;
  int height = 0;
};

/// Instances of `vectors` vec4 each, drawn as strips of so many corners; 0: plain triangles'
/// vertices.
struct Stream {
  Id array = 0;
  Id buffer = 0;
  int vectors = 0;
  int corners = 4;
};

Result<Device> probe();

/// `name` stands in messages; `defines` opens both texts. Errors: BadContent with the compiler's
/// words.
Result<Id> make_program(const Device& device, std::string_view name, std::string_view vertex,
                        std::string_view fragment_prelude, std::string_view fragment,
                        std::string_view defines = "");
void free_program(Id program);
int find_uniform(Id program, const char* name);
void use(Id program);
/// components 1..4, `values` holds components * length floats.
void set(int location, int components, std::span<const float> values);
void set_sampler(int location, int unit);

/// Linear premultiplied half floats, bilinear, clamped.
Id make_texture(int width, int height);
void upload(Id texture, const Rect& rect, const std::uint16_t* halves);
void bind(int unit, Id texture);
void free_texture(Id texture);

/// `encoded`: plain RGBA8 to read back from; else linear light. Errors: Unavailable.
Result<Target> make_target(const Device& device, int width, int height, bool encoded);
void free_target(Target& target);
/// Draws go to `target` from now on.
void draw_to(const Device& device, const Target& target);
/// Draws go to framebuffer `framebuffer`, values as they are.
void draw_to_window(Id framebuffer, const Rect& viewport);
Id current_framebuffer();
void copy(const Target& from, const Target& to);
/// Bilinear, turned upside down: windows count their rows from the bottom.
void stretch(const Target& from, Id window, const Rect& place);
void clear(float r, float g, float b, float a);
void read(const Target& target, std::uint8_t* rgba);

void finish();

void blend(BlendMode mode);

Stream make_stream(int vectors, int corners);
void free_stream(Stream& stream);
/// `data`: count * vectors * 4 floats.
void draw(const Stream& stream, const float* data, std::size_t count);
/// One strip of four without attributes.
void draw_rectangle(const Stream& stream);

}  // namespace vsprite::detail::gl
