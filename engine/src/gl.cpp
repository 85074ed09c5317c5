// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// OpenGL 3.3 core or ES 3 through the functions that the game's loader finds. No call here fails
// but for want of memory or by bad GLSL.
#include "gl.h"

// Khronos's headers name every function and its type; the functions themselves come by the loader.
#ifdef __EMSCRIPTEN__
#include <GLES3/gl3.h>
#else
#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#endif

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <iterator>
#include <vector>

namespace vsprite::detail::gl {

#define VSPRITE_GL_FUNCTIONS(F)                                                                    \
  F(ActiveTexture)                                                                                 \
  F(AttachShader)                                                                                  \
  F(BindBuffer) F(BindFramebuffer) F(BindRenderbuffer) F(BindTexture) F(BindVertexArray)           \
      F(BlendEquation) F(BlendFunc) F(BlendFuncSeparate) F(BlitFramebuffer) F(BufferData)          \
          F(CheckFramebufferStatus) F(Clear) F(ClearColor) F(ColorMask) F(CompileShader)           \
              F(CompressedTexImage2D) F(CompressedTexSubImage2D) F(CreateProgram) F(CreateShader)  \
                  F(DeleteBuffers) F(DeleteFramebuffers) F(DeleteProgram) F(DeleteRenderbuffers)   \
                      F(DeleteShader) F(DeleteTextures) F(DeleteVertexArrays) F(DepthFunc) F(      \
                          DepthMask) F(Disable) F(DrawArrays) F(DrawArraysInstanced) F(Enable)     \
                          F(EnableVertexAttribArray) F(Finish) F(FramebufferRenderbuffer) F(       \
                              FramebufferTexture2D) F(GenBuffers) F(GenFramebuffers)               \
                              F(GenRenderbuffers) F(GenTextures) F(GenVertexArrays) F(GetIntegerv) \
                                  F(GetProgramInfoLog) F(GetProgramiv) F(GetShaderInfoLog)         \
                                      F(GetShaderiv) F(GetString) F(GetStringi)                    \
                                          F(GetUniformLocation) F(LinkProgram) F(PixelStorei)      \
                                              F(ReadPixels) F(RenderbufferStorage) F(ShaderSource) \
                                                  F(TexImage2D) F(TexParameteri) F(TexSubImage2D)  \
                                                      F(Uniform1fv) F(Uniform1i) F(Uniform2fv)     \
                                                          F(Uniform3fv) F(Uniform4fv)              \
                                                              F(UseProgram) F(VertexAttribDivisor) \
                                                                  F(VertexAttribPointer)           \
                                                                      F(Viewport)

struct Functions {
#define VSPRITE_GL_MEMBER(name) decltype(&::gl##name) name = nullptr;
  VSPRITE_GL_FUNCTIONS(VSPRITE_GL_MEMBER)
#undef VSPRITE_GL_MEMBER
};

void FreeFunctions::operator()(const Functions* functions) const { delete functions; }

namespace {

constexpr GLenum kFramebufferSrgb = 0x8DB9;  // desktop only
constexpr GLenum kSrgbDxt5 = 0x8C4F;         // COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT
constexpr std::string_view kCoreHeader = "#version 330 core\n";
constexpr std::string_view kEsHeader =
    "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n";

std::string log_of(const Device& device, Id id, bool program) {
  GLint length = 0;
  if (program) {
    device->GetProgramiv(id, GL_INFO_LOG_LENGTH, &length);
  } else {
    device->GetShaderiv(id, GL_INFO_LOG_LENGTH, &length);
  }
  std::string text(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
  if (program) {
    device->GetProgramInfoLog(id, length, nullptr, text.data());
  } else {
    device->GetShaderInfoLog(id, length, nullptr, text.data());
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
  const Id shader = device->CreateShader(kind);
  device->ShaderSource(shader, static_cast<GLsizei>(parts.size()), strings.data(), lengths.data());
  device->CompileShader(shader);
  GLint done = GL_FALSE;
  device->GetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done == GL_TRUE) return shader;
  Error error{ErrorCode::BadContent, std::string(name) +
                                         (kind == GL_VERTEX_SHADER ? ".vert: " : ".frag: ") +
                                         log_of(device, shader, false)};
  device->DeleteShader(shader);
  return error;
}

/// Nulls, and the name of one of them, where the loader knows no such function.
FunctionTable load_functions(GlLoader load, const char*& missing) {
  auto functions = std::make_unique<Functions>();
  const auto find = [&](auto& function, const char* name) {
    function =
        load != nullptr ? reinterpret_cast<std::decay_t<decltype(function)>>(load(name)) : nullptr;
    if (function == nullptr) missing = name;
  };
#define VSPRITE_GL_FIND(name) find(functions->name, "gl" #name);
  VSPRITE_GL_FUNCTIONS(VSPRITE_GL_FIND)
#undef VSPRITE_GL_FIND
  return FunctionTable(functions.release());
}

struct Version {
  bool es = false;
  int major = 0, minor = 0;
};

/// "4.5 (Core Profile) Mesa 22.3.6", "OpenGL ES 3.0 (WebGL 2.0 ...)".
Version read_version(std::string_view words) {
  constexpr std::string_view kEs = "OpenGL ES ";
  Version version;
  version.es = words.starts_with(kEs);
  if (version.es) words.remove_prefix(kEs.size());
  const char* const end = words.data() + words.size();
  const char* dot = std::from_chars(words.data(), end, version.major).ptr;
  if (dot != end && *dot == '.') std::from_chars(dot + 1, end, version.minor);
  return version;
}

GLenum linear_format(const Device& device) {
  return device.half_target ? GL_RGBA16F : GL_SRGB8_ALPHA8;
}

/// True if the driver names one of the extensions that let BC3 be sampled as sRGB.
bool has_srgb_blocks(const Device& device) {
  constexpr std::string_view kAlone[] = {"GL_EXT_texture_compression_s3tc_srgb",
                                         "GL_WEBGL_compressed_texture_s3tc_srgb",
                                         "WEBGL_compressed_texture_s3tc_srgb"};
  GLint count = 0;
  device->GetIntegerv(GL_NUM_EXTENSIONS, &count);
  bool s3tc = false, srgb = false;
  for (GLint k = 0; k < count; ++k) {
    const GLubyte* words = device->GetStringi(GL_EXTENSIONS, static_cast<GLuint>(k));
    if (words == nullptr) continue;
    const std::string_view name(reinterpret_cast<const char*>(words));
    if (std::find(std::begin(kAlone), std::end(kAlone), name) != std::end(kAlone)) return true;
    s3tc = s3tc || name == "GL_EXT_texture_compression_s3tc";
    srgb = srgb || name == "GL_EXT_texture_sRGB";
  }
  return s3tc && srgb;
}

void set_filter(const Device& device, GLint wrap) {
  device->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  device->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  device->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
  device->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
}

}  // namespace

Result<Device> probe(GlLoader load) {
  const Error no_context{ErrorCode::Unavailable,
                         "renderer: no OpenGL context is current in this thread, make one first"};
  const char* missing = nullptr;
  Device device;
  device.functions = load_functions(load, missing);
  if (device->GetString == nullptr) return no_context;
  const GLubyte* words = device->GetString(GL_VERSION);
  if (words == nullptr) return no_context;
  const Version version = read_version(reinterpret_cast<const char*>(words));
  device.es = version.es;
  const std::string number = std::to_string(version.major) + "." + std::to_string(version.minor);
  if (version.major * 10 + version.minor < (device.es ? 30 : 33)) {
    return Error{ErrorCode::Unavailable,
                 "renderer: OpenGL " + number +
                     " was found, 3.3 or ES 3.0 is due: update the graphics driver"};
  }
  if (missing != nullptr) {
    return Error{ErrorCode::Unavailable, "renderer: the OpenGL function " + std::string(missing) +
                                             " was not found: update the graphics driver"};
  }
  device.name = (device.es ? "OpenGL ES " : "OpenGL ") + number + ", " +
                reinterpret_cast<const char*>(device->GetString(GL_RENDERER));
  GLint size = 0;
  device->GetIntegerv(GL_MAX_TEXTURE_SIZE, &size);
  device.max_size = size;
  if (has_srgb_blocks(device)) device.block_format = kSrgbDxt5;
  device.half_target = true;
  Result<Target> trial = make_target(device, 4, 4, false);
  device.half_target = trial.has_value();
  if (trial) {
    free_target(device, *trial);
  } else {
    device.name += ", 8 bits a channel";
  }
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
    device->DeleteShader(*vert);
    return frag;
  }
  const Id program = device->CreateProgram();
  device->AttachShader(program, *vert);
  device->AttachShader(program, *frag);
  device->LinkProgram(program);
  device->DeleteShader(*vert);
  device->DeleteShader(*frag);
  GLint done = GL_FALSE;
  device->GetProgramiv(program, GL_LINK_STATUS, &done);
  if (done == GL_TRUE) return program;
  Error error{ErrorCode::BadContent, std::string(name) + ": " + log_of(device, program, true)};
  device->DeleteProgram(program);
  return error;
}

void free_program(const Device& device, Id program) { device->DeleteProgram(program); }
int find_uniform(const Device& device, Id program, const char* name) {
  return device->GetUniformLocation(program, name);
}
void use(const Device& device, Id program) { device->UseProgram(program); }

void set(const Device& device, int location, int components, std::span<const float> values) {
  const GLsizei length = static_cast<GLsizei>(values.size()) / components;
  if (components == 1) device->Uniform1fv(location, length, values.data());
  if (components == 2) device->Uniform2fv(location, length, values.data());
  if (components == 3) device->Uniform3fv(location, length, values.data());
  if (components == 4) device->Uniform4fv(location, length, values.data());
}

void set_sampler(const Device& device, int location, int unit) {
  device->Uniform1i(location, unit);
}

Id make_texture(const Device& device, int width, int height) {
  Id id = 0;
  device->GenTextures(1, &id);
  bind(device, 0, id);
  set_filter(device, GL_CLAMP_TO_EDGE);
  device->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, width, height, 0, GL_RGBA, GL_HALF_FLOAT,
                     nullptr);
  return id;
}

void upload(const Device& device, Id texture, const Rect& rect, const std::uint16_t* halves) {
  bind(device, 0, texture);
  device->PixelStorei(GL_UNPACK_ALIGNMENT, 8);
  device->PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  device->TexSubImage2D(GL_TEXTURE_2D, 0, rect.x, rect.y, rect.width, rect.height, GL_RGBA,
                        GL_HALF_FLOAT, halves);
}

Id make_block_texture(const Device& device, int width, int height) {
  Id id = 0;
  device->GenTextures(1, &id);
  bind(device, 0, id);
  set_filter(device, GL_CLAMP_TO_EDGE);
  const std::vector<std::uint8_t> clear(static_cast<std::size_t>(width) *
                                        static_cast<std::size_t>(height));
  device->CompressedTexImage2D(GL_TEXTURE_2D, 0, device.block_format, width, height, 0,
                               static_cast<GLsizei>(clear.size()), clear.data());
  return id;
}

void upload_blocks(const Device& device, Id texture, const Rect& rect, const std::uint8_t* blocks) {
  bind(device, 0, texture);
  device->CompressedTexSubImage2D(GL_TEXTURE_2D, 0, rect.x, rect.y, rect.width, rect.height,
                                  device.block_format, rect.width * rect.height, blocks);
}

void bind(const Device& device, int unit, Id texture) {
  device->ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  device->BindTexture(GL_TEXTURE_2D, texture);
}

void free_texture(const Device& device, Id texture) { device->DeleteTextures(1, &texture); }

Id upload_numbers(const Device& device, Id texture, int width, int height, const float* numbers) {
  const bool fresh = texture == 0;
  if (fresh) device->GenTextures(1, &texture);
  bind(device, 0, texture);
  if (fresh) {
    device->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    device->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }
  device->PixelStorei(GL_UNPACK_ALIGNMENT, 8);
  device->PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  device->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, numbers);
  return texture;
}

Result<Target> make_target(const Device& device, int width, int height, bool encoded) {
  Target target{0, 0, 0, width, height};
  if (width > device.max_size && device.max_size > 0) {
    return Error{ErrorCode::Unavailable, "renderer: a picture of " + std::to_string(width) + " x " +
                                             std::to_string(height) + ", at most " +
                                             std::to_string(device.max_size) +
                                             " a side are possible"};
  }
  device->GenTextures(1, &target.texture);
  bind(device, 0, target.texture);
  set_filter(device, GL_CLAMP_TO_EDGE);
  const GLenum format = encoded ? GL_RGBA8 : linear_format(device);
  const bool half = format == GL_RGBA16F;
  device->TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0, GL_RGBA,
                     half ? GL_HALF_FLOAT : GL_UNSIGNED_BYTE, nullptr);
  const Id before = current_framebuffer(device);
  device->GenFramebuffers(1, &target.framebuffer);
  device->BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  device->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.texture,
                               0);
  const bool complete = device->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  device->BindFramebuffer(GL_FRAMEBUFFER, before);
  if (complete) return target;
  free_target(device, target);
  return Error{ErrorCode::Unavailable, "renderer: the graphics driver refuses a picture of " +
                                           std::to_string(width) + " x " + std::to_string(height)};
}

void free_target(const Device& device, Target& target) {
  if (target.framebuffer != 0) device->DeleteFramebuffers(1, &target.framebuffer);
  if (target.texture != 0) device->DeleteTextures(1, &target.texture);
  if (target.depth != 0) device->DeleteRenderbuffers(1, &target.depth);
  target = {};
}

bool clear_depth(const Device& device, Target& target) {
  if (target.depth == 0) {
    device->GenRenderbuffers(1, &target.depth);
    device->BindRenderbuffer(GL_RENDERBUFFER, target.depth);
    device->RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, target.width, target.height);
    device->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                    target.depth);
  }
  if (device->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    device->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, 0);
    device->DeleteRenderbuffers(1, &target.depth);
    target.depth = 0;
    return false;
  }
  device->DepthMask(GL_TRUE);
  device->Clear(GL_DEPTH_BUFFER_BIT);
  return true;
}

void use_depth(const Device& device, bool on) {
  if (!on) return device->Disable(GL_DEPTH_TEST);
  device->Enable(GL_DEPTH_TEST);
  device->DepthFunc(GL_LEQUAL);
  device->DepthMask(GL_TRUE);
}

void draw_to(const Device& device, const Target& target) {
  device->BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  device->Viewport(0, 0, target.width, target.height);
  device->Disable(GL_DEPTH_TEST);
  device->Disable(GL_CULL_FACE);
  device->Disable(GL_SCISSOR_TEST);
  device->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  // An sRGB target is blended in linear light only if asked; on ES it always is.
  if (!device.es && !device.half_target) device->Enable(kFramebufferSrgb);
}

void draw_to_window(const Device& device, Id framebuffer, const Rect& viewport) {
  device->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  device->Viewport(viewport.x, viewport.y, viewport.width, viewport.height);
  if (!device.es) device->Disable(kFramebufferSrgb);
}

Id current_framebuffer(const Device& device) {
  GLint id = 0;
  device->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &id);
  return static_cast<Id>(id);
}

void copy(const Device& device, const Target& from, const Target& to) {
  device->BindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer);
  device->BindFramebuffer(GL_DRAW_FRAMEBUFFER, to.framebuffer);
  device->BlitFramebuffer(0, 0, from.width, from.height, 0, 0, to.width, to.height,
                          GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void reduce(const Device& device, const Target& from, const Target& to) {
  device->BindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer);
  device->BindFramebuffer(GL_DRAW_FRAMEBUFFER, to.framebuffer);
  device->BlitFramebuffer(0, 0, from.width, from.height, 0, 0, to.width, to.height,
                          GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

void stretch(const Device& device, const Target& from, Id window, const Rect& place) {
  device->BindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer);
  device->BindFramebuffer(GL_DRAW_FRAMEBUFFER, window);
  device->BlitFramebuffer(0, 0, from.width, from.height, place.x, place.y + place.height,
                          place.x + place.width, place.y, GL_COLOR_BUFFER_BIT, GL_LINEAR);
  device->BindFramebuffer(GL_FRAMEBUFFER, window);
}

void clear(const Device& device, float r, float g, float b, float a) {
  device->ClearColor(r, g, b, a);
  device->Clear(GL_COLOR_BUFFER_BIT);
}

void read(const Device& device, const Target& target, std::uint8_t* rgba) {
  const Id before = current_framebuffer(device);
  device->BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  device->PixelStorei(GL_PACK_ALIGNMENT, 4);
  device->PixelStorei(GL_PACK_ROW_LENGTH, 0);
  device->ReadPixels(0, 0, target.width, target.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
  device->BindFramebuffer(GL_FRAMEBUFFER, before);
}

void finish(const Device& device) { device->Finish(); }

void blend(const Device& device, BlendMode mode) {
  if (mode == BlendMode::Replace) {
    device->Disable(GL_BLEND);
    return;
  }
  device->Enable(GL_BLEND);
  device->BlendEquation(GL_FUNC_ADD);
  if (mode == BlendMode::Over) device->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  if (mode == BlendMode::Add) device->BlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_ONE);
  if (mode == BlendMode::Multiply)
    device->BlendFuncSeparate(GL_DST_COLOR, GL_ZERO, GL_ZERO, GL_ONE);
}

Stream make_stream(const Device& device, int vectors, int corners) {
  const bool instanced = corners > 0;
  Stream stream{0, 0, vectors, corners};
  device->GenVertexArrays(1, &stream.array);
  device->BindVertexArray(stream.array);
  if (vectors == 0) return stream;
  device->GenBuffers(1, &stream.buffer);
  device->BindBuffer(GL_ARRAY_BUFFER, stream.buffer);
  const GLsizei stride = static_cast<GLsizei>(sizeof(float)) * 4 * vectors;
  for (int i = 0; i < vectors; ++i) {
    const GLuint slot = static_cast<GLuint>(i);
    const std::size_t offset = sizeof(float) * 4 * slot;
    device->EnableVertexAttribArray(slot);
    device->VertexAttribPointer(slot, 4, GL_FLOAT, GL_FALSE, stride,
                                reinterpret_cast<void*>(offset));
    device->VertexAttribDivisor(slot, instanced ? 1 : 0);
  }
  return stream;
}

void free_stream(const Device& device, Stream& stream) {
  if (stream.array != 0) device->DeleteVertexArrays(1, &stream.array);
  if (stream.buffer != 0) device->DeleteBuffers(1, &stream.buffer);
  stream = {};
}

void draw(const Device& device, const Stream& stream, const float* data, std::size_t count) {
  device->BindVertexArray(stream.array);
  device->BindBuffer(GL_ARRAY_BUFFER, stream.buffer);
  const std::size_t bytes = count * sizeof(float) * 4 * static_cast<std::size_t>(stream.vectors);
  device->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
  if (stream.corners > 0) {
    device->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, stream.corners, static_cast<GLsizei>(count));
  } else {
    device->DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(count));
  }
}

void draw_rectangle(const Device& device, const Stream& stream) {
  device->BindVertexArray(stream.array);
  device->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace vsprite::detail::gl
