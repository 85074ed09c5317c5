// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// gl.h - the dozen OpenGL operations that the renderer is made of. Everything is y down: the first
// row of every texture and target is the top one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "vsprite/draw.h"
#include "vsprite/geometry.h"
#include "vsprite/result.h"

namespace vsprite::detail::gl {

using Id = unsigned;

/// OpenGL's functions as the loader found them, by their names without "gl"; known to gl.cpp alone.
struct Functions;
struct FreeFunctions {
  void operator()(const Functions* functions) const;
};
using FunctionTable = std::unique_ptr<const Functions, FreeFunctions>;

/// What the other operations draw by.
struct Device {
  FunctionTable functions;
  std::string name;
  bool es = false;
  bool half_target = false;  ///< RGBA16F can be drawn into; else sRGB8, with the same blending
  int max_size = 0;          ///< of a texture's side
  unsigned block_format = 0;  ///< BC3 that is sampled as sRGB; 0: the driver has none

  const Functions* operator->() const { return functions.get(); }
};

/// A texture that can be drawn into.
struct Target {
  Id framebuffer = 0;
  Id texture = 0;
  Id depth = 0;  ///< a renderbuffer; 0: none yet
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

/// Errors: Unavailable.
Result<Device> probe(GlLoader load);

/// `name` stands in messages; `defines` opens both texts. Errors: BadContent with the compiler's
/// words.
Result<Id> make_program(const Device& device, std::string_view name, std::string_view vertex,
                        std::string_view fragment_prelude, std::string_view fragment,
                        std::string_view defines = "");
void free_program(const Device& device, Id program);
int find_uniform(const Device& device, Id program, const char* name);
void use(const Device& device, Id program);
/// components 1..4, `values` holds components * length floats.
void set(const Device& device, int location, int components, std::span<const float> values);
void set_sampler(const Device& device, int location, int unit);

/// Linear premultiplied half floats, bilinear, clamped.
Id make_texture(const Device& device, int width, int height);
void upload(const Device& device, Id texture, const Rect& rect, const std::uint16_t* halves);
/// BC3 blocks, sampled as sRGB: all clear; sides and `rect` are multiples of 4.
/// Pre: device.block_format != 0.
Id make_block_texture(const Device& device, int width, int height);
void upload_blocks(const Device& device, Id texture, const Rect& rect, const std::uint8_t* blocks);
void bind(const Device& device, int unit, Id texture);
void free_texture(const Device& device, Id texture);
/// Numbers for texelFetch: width * height * 4 floats replace what `texture` (0: a new one) held.
Id upload_numbers(const Device& device, Id texture, int width, int height, const float* numbers);

/// `encoded`: plain RGBA8 to read back from; else linear light. Errors: Unavailable.
Result<Target> make_target(const Device& device, int width, int height, bool encoded);
void free_target(const Device& device, Target& target);
/// Makes every depth of the target, which is drawn to, the farthest. False without memory for it.
bool clear_depth(const Device& device, Target& target);
/// From now on: nearer or as near wins, and is kept. `draw_to` and `false` end it.
void use_depth(const Device& device, bool on);
/// Draws go to `target` from now on.
void draw_to(const Device& device, const Target& target);
/// Draws go to framebuffer `framebuffer`, values as they are.
void draw_to_window(const Device& device, Id framebuffer, const Rect& viewport);
Id current_framebuffer(const Device& device);
void copy(const Device& device, const Target& from, const Target& to);
/// Bilinear: of half the size, each pixel is the mean of four.
void reduce(const Device& device, const Target& from, const Target& to);
/// Bilinear, turned upside down: windows count their rows from the bottom.
void stretch(const Device& device, const Target& from, Id window, const Rect& place);
void clear(const Device& device, float r, float g, float b, float a);
void read(const Device& device, const Target& target, std::uint8_t* rgba);

void finish(const Device& device);

void blend(const Device& device, BlendMode mode);

Stream make_stream(const Device& device, int vectors, int corners);
void free_stream(const Device& device, Stream& stream);
/// `data`: count * vectors * 4 floats.
void draw(const Device& device, const Stream& stream, const float* data, std::size_t count);
/// One strip of four without attributes.
void draw_rectangle(const Device& device, const Stream& stream);

}  // namespace vsprite::detail::gl
