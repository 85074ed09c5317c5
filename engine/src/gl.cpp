// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// OpenGL 3.3 core or ES 3 through libepoxy. No call here fails but for want of memory or by bad
// GLSL.
#include "gl.h"

#include <epoxy/gl.h>

#include <array>
#include <vector>

namespace vsprite::detail::gl {
namespace {

constexpr std::string_view kCoreHeader = "#version 330 core\n";
constexpr std::string_view kEsHeader =
    "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n";

std::string log_of(Id id, bool program) {
  GLint length = 0;
  if (program) {
    glGetProgramiv(id, GL_INFO_LOG_LENGTH, &length);
  } else {
    glGetShaderiv(id, GL_INFO_LOG_LENGTH, &length);
  }
  std::string text(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
  if (program) {
    glGetProgramInfoLog(id, length, nullptr, text.data());
  } else {
    glGetShaderInfoLog(id, length, nullptr, text.data());
  }
  while (!text.empty() && (text.back() == '\0' || text.back() == '\n' || text.back() == '.')) {
    text.pop_back();
  }
  return text;
}

Result<Id> compile(const Device& device, std::string_view name, GLenum kind,
                   std::string_view prelude, std::string_view text) {
  constexpr std::string_view first_line = "#line 1\n";  // messages count the lines of `text`
  const std::array<std::string_view, 4> parts = {device.es ? kEsHeader : kCoreHeader, prelude,
                                                 first_line, text};
  std::array<const GLchar*, 4> strings{};
  std::array<GLint, 4> lengths{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    strings[i] = parts[i].data();
    lengths[i] = static_cast<GLint>(parts[i].size());
  }
  const Id shader = glCreateShader(kind);
  glShaderSource(shader, static_cast<GLsizei>(parts.size()), strings.data(), lengths.data());
  glCompileShader(shader);
  GLint done = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done == GL_TRUE) return shader;
  Error error{ErrorCode::BadContent, std::string(name) +
                                         (kind == GL_VERTEX_SHADER ? ".vert: " : ".frag: ") +
                                         log_of(shader, false)};
  glDeleteShader(shader);
  return error;
}

GLenum linear_format(const Device& device) {
  return device.half_target ? GL_RGBA16F : GL_SRGB8_ALPHA8;
}

void set_filter(GLint wrap) {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
}

}  // namespace

Result<Device> probe() {
  Device device;
  const GLubyte* version = glGetString(GL_VERSION);
  if (version == nullptr) {
    return Error{ErrorCode::Unavailable,
                 "renderer: no OpenGL context is current in this thread, make one first"};
  }
  device.es = !epoxy_is_desktop_gl();
  const int number = epoxy_gl_version();
  if (number < (device.es ? 30 : 33)) {
    return Error{ErrorCode::Unavailable,
                 "renderer: OpenGL " + std::to_string(number / 10) + "." +
                     std::to_string(number % 10) +
                     " was found, 3.3 or ES 3.0 is due: update the graphics driver"};
  }
  device.name = (device.es ? "OpenGL ES " : "OpenGL ") + std::to_string(number / 10) + "." +
                std::to_string(number % 10) + ", " +
                reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  GLint size = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &size);
  device.max_size = size;
  device.half_target = true;
  Result<Target> trial = make_target(device, 4, 4, false);
  device.half_target = trial.has_value();
  if (trial) free_target(*trial);
  return device;
}

Result<Id> make_program(const Device& device, std::string_view name, std::string_view vertex,
                        std::string_view fragment_prelude, std::string_view fragment,
                        std::string_view defines) {
  Result<Id> vert = compile(device, name, GL_VERTEX_SHADER, defines, vertex);
  if (!vert) return vert;
  const std::string prelude = std::string(defines) + std::string(fragment_prelude);
  Result<Id> frag = compile(device, name, GL_FRAGMENT_SHADER, prelude, fragment);
  if (!frag) {
    glDeleteShader(*vert);
    return frag;
  }
  const Id program = glCreateProgram();
  glAttachShader(program, *vert);
  glAttachShader(program, *frag);
  glLinkProgram(program);
  glDeleteShader(*vert);
  glDeleteShader(*frag);
  GLint done = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &done);
  if (done == GL_TRUE) return program;
  Error error{ErrorCode::BadContent, std::string(name) + ": " + log_of(program, true)};
  glDeleteProgram(program);
  return error;
}

void free_program(Id program) { glDeleteProgram(program); }
int find_uniform(Id program, const char* name) { return glGetUniformLocation(program, name); }
void use(Id program) { glUseProgram(program); }

void set(int location, int components, std::span<const float> values) {
  const GLsizei length = static_cast<GLsizei>(values.size()) / components;
  if (components == 1) glUniform1fv(location, length, values.data());
  if (components == 2) glUniform2fv(location, length, values.data());
  if (components == 3) glUniform3fv(location, length, values.data());
  if (components == 4) glUniform4fv(location, length, values.data());
}

void set_sampler(int location, int unit) { glUniform1i(location, unit); }

Id make_texture(int width, int height) {
  Id id = 0;
  glGenTextures(1, &id);
  bind(0, id);
  set_filter(GL_CLAMP_TO_EDGE);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, width, height, 0, GL_RGBA, GL_HALF_FLOAT, nullptr);
  return id;
}

void upload(Id texture, const Rect& rect, const std::uint16_t* halves) {
  bind(0, texture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glTexSubImage2D(GL_TEXTURE_2D, 0, rect.x, rect.y, rect.width, rect.height, GL_RGBA, GL_HALF_FLOAT,
                  halves);
}

void bind(int unit, Id texture) {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, texture);
}

void free_texture(Id texture) { glDeleteTextures(1, &texture); }

Result<Target> make_target(const Device& device, int width, int height, bool encoded) {
  Target target{0, 0, width, height};
  if (width > device.max_size && device.max_size > 0) {
    return Error{ErrorCode::Unavailable, "renderer: a picture of " + std::to_string(width) + " x " +
                                             std::to_string(height) + ", at most " +
                                             std::to_string(device.max_size) +
                                             " a side are possible"};
  }
  glGenTextures(1, &target.texture);
  bind(0, target.texture);
  set_filter(GL_CLAMP_TO_EDGE);
  const GLenum format = encoded ? GL_RGBA8 : linear_format(device);
  const bool half = format == GL_RGBA16F;
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0, GL_RGBA,
               half ? GL_HALF_FLOAT : GL_UNSIGNED_BYTE, nullptr);
  const Id before = current_framebuffer();
  glGenFramebuffers(1, &target.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.texture, 0);
  const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_FRAMEBUFFER, before);
  if (complete) return target;
  free_target(target);
  return Error{ErrorCode::Unavailable, "renderer: the graphics driver refuses a picture of " +
                                           std::to_string(width) + " x " + std::to_string(height)};
}

void free_target(Target& target) {
  if (target.framebuffer != 0) glDeleteFramebuffers(1, &target.framebuffer);
  if (target.texture != 0) glDeleteTextures(1, &target.texture);
  target = {};
}

void draw_to(const Device& device, const Target& target) {
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  glViewport(0, 0, target.width, target.height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  // An sRGB target is blended in linear light only if asked; on ES it always is.
  if (!device.es && !device.half_target) glEnable(GL_FRAMEBUFFER_SRGB);
}

void draw_to_window(Id framebuffer, const Rect& viewport) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
  if (epoxy_is_desktop_gl()) glDisable(GL_FRAMEBUFFER_SRGB);
}

Id current_framebuffer() {
  GLint id = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &id);
  return static_cast<Id>(id);
}

void copy(const Target& from, const Target& to) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to.framebuffer);
  glBlitFramebuffer(0, 0, from.width, from.height, 0, 0, to.width, to.height, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
}

void stretch(const Target& from, Id window, const Rect& place) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, window);
  glBlitFramebuffer(0, 0, from.width, from.height, place.x, place.y + place.height,
                    place.x + place.width, place.y, GL_COLOR_BUFFER_BIT, GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, window);
}

void clear(float r, float g, float b, float a) {
  glClearColor(r, g, b, a);
  glClear(GL_COLOR_BUFFER_BIT);
}

void read(const Target& target, std::uint8_t* rgba) {
  const Id before = current_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
  glReadPixels(0, 0, target.width, target.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
  glBindFramebuffer(GL_FRAMEBUFFER, before);
}

void finish() { glFinish(); }

void blend(BlendMode mode) {
  if (mode == BlendMode::Replace) {
    glDisable(GL_BLEND);
    return;
  }
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  if (mode == BlendMode::Over) glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  if (mode == BlendMode::Add) glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_ONE);
  if (mode == BlendMode::Multiply) glBlendFuncSeparate(GL_DST_COLOR, GL_ZERO, GL_ZERO, GL_ONE);
}

Stream make_stream(int vectors, int corners) {
  const bool instanced = corners > 0;
  Stream stream{0, 0, vectors, corners};
  glGenVertexArrays(1, &stream.array);
  glBindVertexArray(stream.array);
  if (vectors == 0) return stream;
  glGenBuffers(1, &stream.buffer);
  glBindBuffer(GL_ARRAY_BUFFER, stream.buffer);
  const GLsizei stride = static_cast<GLsizei>(sizeof(float)) * 4 * vectors;
  for (int i = 0; i < vectors; ++i) {
    const GLuint slot = static_cast<GLuint>(i);
    const std::size_t offset = sizeof(float) * 4 * slot;
    glEnableVertexAttribArray(slot);
    glVertexAttribPointer(slot, 4, GL_FLOAT, GL_FALSE, stride, reinterpret_cast<void*>(offset));
    glVertexAttribDivisor(slot, instanced ? 1 : 0);
  }
  return stream;
}

void free_stream(Stream& stream) {
  if (stream.array != 0) glDeleteVertexArrays(1, &stream.array);
  if (stream.buffer != 0) glDeleteBuffers(1, &stream.buffer);
  stream = {};
}

void draw(const Stream& stream, const float* data, std::size_t count) {
  glBindVertexArray(stream.array);
  glBindBuffer(GL_ARRAY_BUFFER, stream.buffer);
  const std::size_t bytes = count * sizeof(float) * 4 * static_cast<std::size_t>(stream.vectors);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
  if (stream.corners > 0) {
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, stream.corners, static_cast<GLsizei>(count));
  } else {
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(count));
  }
}

void draw_rectangle(const Stream& stream) {
  glBindVertexArray(stream.array);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace vsprite::detail::gl
