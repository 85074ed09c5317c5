// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The renderer: turns calls into batches and keeps pictures on texture pages.
//
// Compositing is Porter and Duff's "over" (SIGGRAPH 1984) on premultiplied linear light.
#include "vsprite/draw.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "renderer.h"
#include "shaders/sprite.h"
#include "vsprite/compose.h"

namespace vsprite {

namespace gl = detail::gl;
namespace glsl = shaders::sprite;
using detail::Batch;
using detail::BatchState;
using detail::Cells;
using detail::Kind;
using detail::Octagon;
using detail::Picture;
using detail::Program;
using detail::Surface;

namespace {

std::array<float, 4> to_floats(const std::array<int, 4>& numbers) {
  std::array<float, 4> out{};
  for (std::size_t k = 0; k < 4; ++k) out[k] = static_cast<float>(numbers[k]);
  return out;
}

/// How far each corner of a picture is clear: the least x + y of a pixel that is not, from there.
std::array<float, 4> clear_corners(ImageView image) {
  const int most = std::min(image.width, image.height) / 2;
  std::array<int, 4> cuts{most, most, most, most};
  const auto covered = [](const std::uint8_t* p) { return p[3] != 0; };
  for (int y = 0; y < image.height; ++y) {
    const int up = image.height - 1 - y;
    int first = 0, last = 0;  // clear pixels at either end, as far as they matter
    while (first < most && first < image.width && !covered(image.pixel(first, y))) ++first;
    while (last < most && !covered(image.pixel(image.width - 1 - last, y))) ++last;
    cuts[0] = std::min(cuts[0], first + y);
    cuts[1] = std::min(cuts[1], last + y);
    cuts[2] = std::min(cuts[2], last + up);
    cuts[3] = std::min(cuts[3], first + up);
  }
  return to_floats(cuts);
}

/// The same by whole blocks, of which the first begins a texel before the picture.
std::array<float, 4> clear_corners(BlockView blocks) {
  const int most = std::min(blocks.width, blocks.height) / 2;
  std::array<int, 4> cuts{most, most, most, most};
  const std::uint8_t* block = blocks.bytes;
  for (int y = 0; y < blocks.rows(); ++y) {
    for (int x = 0; x < blocks.columns(); ++x, block += 16) {
      if (std::all_of(block, block + 16, [](std::uint8_t b) { return b == 0; })) continue;
      const int left = std::max(0, 4 * x - 1), right = std::max(0, blocks.width - 4 * x - 3);
      const int top = std::max(0, 4 * y - 1), bottom = std::max(0, blocks.height - 4 * y - 3);
      cuts[0] = std::min(cuts[0], left + top);
      cuts[1] = std::min(cuts[1], right + top);
      cuts[2] = std::min(cuts[2], right + bottom);
      cuts[3] = std::min(cuts[3], left + bottom);
    }
  }
  return to_floats(cuts);
}

/// A large octagon whose texels are all opaque: the box of all opaque runs, moved in side by side
/// as long as that gains area. `halves`: rows of `stride` texels.
Octagon opaque_core(const std::uint16_t* halves, int columns, int rows, int stride) {
  constexpr std::uint16_t kOne = 0x3C00;
  struct Run {
    int first = 0, last = 0;
  };
  std::vector<Run> runs(static_cast<std::size_t>(rows));
  std::array<int, 4> sides{columns, rows, 0, 0};  // left, top, right, bottom
  for (int y = 0; y < rows; ++y) {
    Run& longest = runs[static_cast<std::size_t>(y)];
    const std::uint16_t* alpha = halves + std::ptrdiff_t{y} * stride * 4 + 3;
    for (int x = 0, first = 0; x <= columns; ++x) {
      if (x < columns && alpha[4 * x] == kOne) continue;
      if (x - first > longest.last - longest.first) longest = {first, x};
      first = x + 1;
    }
    if (longest.first == longest.last) continue;
    sides = {std::min(sides[0], longest.first), std::min(sides[1], y),
             std::max(sides[2], longest.last), y + 1};
  }
  std::array<int, 4> cuts{};
  const auto area_of = [&](const std::array<int, 4>& box) {
    const int width = box[2] - box[0], height = box[3] - box[1];
    cuts = {};
    for (int y = box[1]; y < box[3]; ++y) {
      const Run& run = runs[static_cast<std::size_t>(y)];
      const bool above = 2 * (y - box[1]) < height;
      const int from_end = above ? y + 1 - box[1] : box[3] - y;
      int &left = cuts[above ? 0 : 3], &right = cuts[above ? 1 : 2];
      if (run.first > box[0]) left = std::max(left, run.first - box[0] + from_end);
      if (run.last < box[2]) right = std::max(right, box[2] - run.last + from_end);
    }
    const int over =
        std::max(0, cuts[0] + cuts[1] - width) + std::max(0, cuts[2] + cuts[3] - width) +
        std::max(0, cuts[0] + cuts[3] - height) + std::max(0, cuts[1] + cuts[2] - height);
    if (over > 0 || width <= 0 || height <= 0) return -over;
    int area = 2 * width * height;
    for (const int cut : cuts) area -= cut * cut;
    return area;
  };
  int best = area_of(sides);
  for (int step = 8; step > 0; step /= 2) {
    for (bool better = true; better;) {
      better = false;
      for (std::size_t side = 0; side < 4; ++side) {
        std::array<int, 4> moved = sides;
        moved[side] += side < 2 ? step : -step;
        if (moved[0] >= moved[2] || moved[1] >= moved[3]) continue;
        const int area = area_of(moved);
        if (area <= best) continue;
        best = area;
        sides = moved;
        better = true;
      }
    }
  }
  if (best <= 0) return {};
  area_of(sides);
  const std::array<float, 4> box = to_floats(sides);
  return {box[0], box[1], box[2], box[3], to_floats(cuts)};
}

/// How many pixels of a picture that is drawn at `scale` go into a texel, along either side.
int reduction(float scale) {
  constexpr int kMost = 16;
  int side = 1;
  while (side < kMost && scale * static_cast<float>(2 * side) <= 1) side *= 2;
  return side;
}

TextureKey reduced(TextureKey key, int side) {
  constexpr std::uint32_t kFirst = 1u << 16;  // behind all shadows
  if (side > 1) key.variant = kFirst + static_cast<std::uint32_t>(side);
  return key;
}

/// The mean light of a square of pixels; beyond the picture they are clear.
void convert_mean(const detail::LightTable& light, ImageView image, int left, int top, int side,
                  std::uint16_t* out) {
  std::array<float, 4> sum{};
  std::array<std::uint16_t, 4> one{};
  for (int y = top; y < std::min(top + side, image.height); ++y) {
    for (int x = left; x < std::min(left + side, image.width); ++x) {
      if (image.pixel(x, y)[3] == 0) continue;
      light.convert(image.pixel(x, y), one.data());
      for (std::size_t c = 0; c < 4; ++c) sum[c] += detail::float_from_half(one[c]);
    }
  }
  const float share = 1 / static_cast<float>(side * side);
  for (std::size_t c = 0; c < 4; ++c) out[c] = detail::half_from_float(sum[c] * share);
}

}  // namespace

Renderer::Impl::~Impl() {
  for (gl::Id id : pages) gl::free_texture(device, id);
  for (Program* p : {&shape_program, &flat_program, &window_program, &file_program}) {
    if (p->id != 0) gl::free_program(device, p->id);
  }
  for (auto& variants : sprite_programs) {
    for (Program& p : variants) {
      if (p.id != 0) gl::free_program(device, p.id);
    }
  }
  for (Program& effect : effects) gl::free_program(device, effect.id);
  for (gl::Stream* s : {&sprite_stream, &shape_stream, &flat_stream, &empty_stream}) {
    gl::free_stream(device, *s);
  }
  free_puppets();
  for (Surface& layer : layers) layer.free(device);
  frame.free(device);
  gl::free_target(device, encoded);
  for (gl::Target& half : backdrop) gl::free_target(device, half);
}

Result<void> Renderer::Impl::set_up() {
  const auto build = [&](Program& program, std::string_view name, std::string_view vert,
                         std::string_view frag, std::string_view defines = "") -> Result<void> {
    program.name = name;
    Result<gl::Id> id = gl::make_program(device, name, vert, "", frag, defines);
    if (!id) return std::move(id).error();
    program.id = *id;
    program.device = &device;
    return {};
  };
  if (auto r = build(sprite_programs[0][0], "sprite", glsl::sprite_vert, glsl::sprite_frag,
                     "#define TAPS 1\n");
      !r) {
    return r;
  }
  if (auto r = build(shape_program, "shape", glsl::shape_vert, glsl::shape_frag); !r) return r;
  if (auto r = build(flat_program, "flat", glsl::flat_vert, glsl::flat_frag); !r) return r;
  const std::string dither = config.dither ? "#define DITHER\n" : "";
  if (auto r = build(window_program, "encode", glsl::encode_vert, glsl::encode_frag, dither); !r) {
    return r;
  }
  if (auto r = build(file_program, "encode", glsl::encode_vert, glsl::encode_frag,
                     dither + "#define FILE\n");
      !r) {
    return r;
  }
  sprite_stream = gl::make_stream(device, detail::kSpriteVectors, 8);
  shape_stream = gl::make_stream(device, 4, 4);
  flat_stream = gl::make_stream(device, 2, 0);
  empty_stream = gl::make_stream(device, 0, 0);
  return {};
}

void Renderer::Impl::flush() {
  const std::size_t count = std::exchange(waiting, 0);
  for (std::size_t k = 0; k < count; ++k) {
    const bool is_puppets = batches[k].state.kind == Kind::Puppets;
    is_puppets ? flush_puppets(batches[k]) : flush(batches[k]);
    ++stats.batches;
  }
}

void Renderer::Impl::flush(const Batch& batch) {
  const auto& [what, blend, page, old_page, taps, wrapped] = batch.state;
  const bool sprites = what == Kind::Sprites;
  Program* variant = sprites ? sprite_program(taps, old_page >= 0, wrapped) : nullptr;
  Program& program = variant != nullptr     ? *variant
                     : sprites              ? sprite_programs[0][0]
                     : what == Kind::Shapes ? shape_program
                                            : flat_program;
  const gl::Stream& stream = sprites                ? sprite_stream
                             : what == Kind::Shapes ? shape_stream
                                                    : flat_stream;
  gl::use(device, program.id);
  program.set("frame_size",
              {static_cast<float>(target->main.width), static_cast<float>(target->main.height)});
  if (sprites) {
    gl::bind(device, 0, pages[static_cast<std::size_t>(page)]);
    gl::set_sampler(device, program.location("page"), 0);
    program.set("page_size", {static_cast<float>(atlas.page_width(page)),
                              static_cast<float>(atlas.page_height(page))});
    if (old_page >= 0) {
      gl::bind(device, 1, pages[static_cast<std::size_t>(old_page)]);
      gl::set_sampler(device, program.location("old_page"), 1);
      program.set("old_page_size", {static_cast<float>(atlas.page_width(old_page)),
                                    static_cast<float>(atlas.page_height(old_page))});
    }
  }
  if (sprites && wrapped) {
    gl::bind(device, 2, backdrop.back().texture);
    gl::set_sampler(device, program.location("backdrop"), 2);
  }
  if (sprites) program.set("order", {0, 0, 1});
  if (sprites && draw_by_depth(batch, program)) return;
  gl::blend(device, blend);
  gl::draw(device, stream, batch.words.data(),
           batch.words.size() / (4 * static_cast<std::size_t>(stream.vectors)));
}

bool Renderer::Impl::draw_by_depth(const Batch& batch, Program& program) {
  constexpr float kStep = 1.0f / (1 << 20);  // of depth, from one instance to the next
  constexpr std::size_t kWords = 4 * detail::kSpriteVectors;
  const std::size_t count = batch.words.size() / kWords;
  const float pixels =
      static_cast<float>(target->main.width) * static_cast<float>(target->main.height);
  if (batch.hidden < pixels || count >= 1 << 20) return false;
  if (!gl::clear_depth(device, target->main)) return false;
  turned.clear();
  for (std::size_t k = count; k-- > 0;) {
    const float* core = &batch.cores[k * kWords];
    turned.insert(turned.end(), core, core + kWords);
  }
  gl::use_depth(device, true);
  gl::blend(device, BlendMode::Replace);
  program.set("order", {-kStep * static_cast<float>(count - 1), kStep, -1});
  gl::draw(device, sprite_stream, turned.data(), count);
  gl::blend(device, batch.state.blend);
  program.set("order", {kStep / 2, -kStep, 1});  // its own core hides a sprite, too
  gl::draw(device, sprite_stream, batch.words.data(), count);
  gl::use_depth(device, false);
  if (puppets.slices > 0) gl::clear_depth(device, target->main);
  ++stats.batches;
  return true;
}

Program* Renderer::Impl::sprite_program(int samples, bool fading, bool wraps) {
  const auto kind_of = static_cast<std::size_t>((fading ? 1 : 0) + (wraps ? 2 : 0));
  Program& program = sprite_programs[static_cast<std::size_t>(samples - 1)][kind_of];
  if (program.id == 0) {
    const std::string defines = "#define TAPS " + std::to_string(samples) +
                                (fading ? "\n#define FADE" : "") +
                                (wraps ? "\n#define WRAP\n" : "\n");
    const Result<gl::Id> made =
        gl::make_program(device, "sprite", glsl::sprite_vert, "", glsl::sprite_frag, defines);
    if (!made) return nullptr;
    program.id = *made;
    program.device = &device;
  }
  return &program;
}

Batch& Renderer::Impl::open(const BatchState& state, const Cells::Span& where) {
  constexpr std::size_t kLookBack = 32;
  const std::size_t oldest = waiting - std::min(waiting, kLookBack);
  for (std::size_t k = waiting; k-- > oldest;) {
    Batch& batch = batches[k];
    const bool joins = batch.state == state;
    if (joins) batch.cells.add(where);
    if (joins) return batch;
    if (batch.cells.meet(where)) break;
  }
  if (waiting == batches.size()) batches.emplace_back();
  Batch& batch = batches[waiting++];
  batch.state = state;
  batch.cells = {};
  batch.cells.add(where);
  batch.words.clear();
  batch.cores.clear();
  batch.hidden = 0;
  return batch;
}

Cells::Span Renderer::Impl::cells_of(Vec2 center, Vec2 half_size) const noexcept {
  const auto cell = [](float at, int size) {
    const float k = at * Cells::kSide / static_cast<float>(size);
    return k > 0 ? static_cast<int>(std::min(k, Cells::kSide - 1.0f)) : 0;
  };
  const int width = target->main.width, height = target->main.height;
  return {cell(center.x - half_size.x, width), cell(center.y - half_size.y, height),
          cell(center.x + half_size.x, width), cell(center.y + half_size.y, height)};
}

void Renderer::Impl::use_surface(Surface* surface) {
  flush();
  target = surface;
  has_backdrop = false;
  puppets.slices = 0;
  camera = {};
  if (surface != nullptr) gl::draw_to(device, surface->main);
}

// Room on a page that stands ready.
std::optional<detail::AtlasSlot> Renderer::Impl::place(const TextureKey& key, int width, int height,
                                                       detail::PageForm form) {
  const auto placed = atlas.insert(key, width, height, form);
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
    if (pages[index] != 0) gl::free_texture(device, pages[index]);
    const int page_width = atlas.page_width(placed->slot.page),
              page_height = atlas.page_height(placed->slot.page);
    pages[index] = form == detail::PageForm::Blocks
                       ? gl::make_block_texture(device, page_width, page_height)
                       : gl::make_texture(device, page_width, page_height);
  }
  ++stats.uploads;
  stats.texture_bytes = atlas.bytes();
  return placed->slot;
}

std::optional<detail::AtlasSlot> Renderer::Impl::store(const TextureKey& key, ImageView image,
                                                       int side) {
  const int columns = (image.width + side - 1) / side, rows = (image.height + side - 1) / side;
  const int width = columns + 2, height = rows + 2;  // a border of zeros
  auto slot = place(key, width, height, detail::PageForm::Halves);
  if (!slot) return std::nullopt;
  staging.assign(std::size_t(width) * std::size_t(height) * 4, 0);
  for (int y = 0; y < rows; ++y) {
    std::uint16_t* out = &staging[(std::size_t(y + 1) * std::size_t(width) + 1) * 4];
    for (int x = 0; x < columns; ++x, out += 4) {
      if (side == 1) {
        light.convert(image.pixel(x, y), out);
      } else {
        convert_mean(light, image, x * side, y * side, side, out);
      }
    }
  }
  gl::upload(device, pages[static_cast<std::size_t>(slot->page)], slot->rect, staging.data());
  std::array<float, 4> cuts = clear_corners(image);
  if (side > 1) {
    for (float& cut : cuts) cut = std::max(0.0f, std::floor(cut / static_cast<float>(side)) - 1);
  }
  slot->outline = {0, 0, static_cast<float>(columns), static_cast<float>(rows), cuts};
  slot->core = opaque_core(&staging[(std::size_t(width) + 1) * 4], columns, rows, width);
  atlas.set_shape(key, slot->outline, slot->core);
  return slot;
}

std::optional<detail::AtlasSlot> Renderer::Impl::store(const TextureKey& key, BlockView blocks) {
  // The border of zeros is theirs already.
  auto slot = place(key, blocks.width + 2, blocks.height + 2, detail::PageForm::Blocks);
  if (!slot) return std::nullopt;
  gl::upload_blocks(device, pages[static_cast<std::size_t>(slot->page)],
                    {slot->rect.x, slot->rect.y, 4 * blocks.columns(), 4 * blocks.rows()},
                    blocks.bytes);
  slot->outline = {0, 0, static_cast<float>(blocks.width), static_cast<float>(blocks.height),
                   clear_corners(blocks)};
  atlas.set_shape(key, slot->outline, {});
  return slot;
}

std::optional<detail::AtlasSlot> Renderer::Impl::find_or_store(const TextureKey& key,
                                                               ImageView image, int side,
                                                               BlockView blocks) {
  if (key.sprite != 0) {
    if (const auto slot = atlas.find(key)) return slot;
  }
  const TextureKey name = key.sprite != 0 ? key : TextureKey{0, uncached++};
  if (blocks.bytes != nullptr && takes_blocks()) return store(name, blocks);
  if (image.rgba == nullptr || image.width <= 0 || image.height <= 0) return std::nullopt;
  return store(name, image, side);
}

void Renderer::Impl::push_picture(const detail::Picture& p) {
  const auto length = [](Vec2 v) { return std::sqrt(v.x * v.x + v.y * v.y); };
  const float smallest = std::min(length(p.x_axis), length(p.y_axis));
  const float reach = p.footprint / std::max(smallest, 0.01f);
  // Up to a fifth more than a texel one sample is nearer to the mean than four are.
  const int samples =
      reach <= 1.2f ? 1
                    : std::clamp(static_cast<int>(std::ceil(reach - 0.02f)), 2, detail::kMostTaps);
  const auto inner = [](const Rect& r) {
    return std::array{static_cast<float>(r.x + 1), static_cast<float>(r.y + 1),
                      static_cast<float>(r.width - 2), static_cast<float>(r.height - 2)};
  };
  const std::array<float, 4> rect = inner(p.slot.rect);
  const std::array<float, 4> old = p.old ? inner(p.old->rect) : std::array<float, 4>{};
  Octagon box = p.slot.outline;
  if (p.old) {
    box = {std::min(0.0f, p.shift.x),
           std::min(0.0f, p.shift.y),
           std::max(rect[2], p.shift.x + old[2]),
           std::max(rect[3], p.shift.y + old[3]),
           {}};
  }
  const Vec2 middle{(box.left + box.right) / 2, (box.top + box.bottom) / 2};
  const Vec2 half{(box.right - box.left) / 2 + 1, (box.bottom - box.top) / 2 + 1};
  const Vec2 center{p.corner.x + p.x_axis.x * middle.x + p.y_axis.x * middle.y,
                    p.corner.y + p.x_axis.y * middle.x + p.y_axis.y * middle.y};
  const float rim =
      samples > 1 ? 1 + p.footprint : 1;  // what a reduced picture reaches beyond its box
  const Vec2 reached{std::fabs(p.x_axis.x) * half.x + std::fabs(p.y_axis.x) * half.y + rim,
                     std::fabs(p.x_axis.y) * half.x + std::fabs(p.y_axis.y) * half.y + rim};
  Batch& batch = open({.kind = Kind::Sprites,
                       .page = p.slot.page,
                       .old_page = p.old ? p.old->page : -1,
                       .taps = samples,
                       .wrapped = p.wrap > 0},
                      cells_of(center, reached));
  const auto push = [&](std::vector<float>& words, Vec2 x_axis, Vec2 y_axis, const Octagon& o) {
    words.insert(
        words.end(),
        {p.corner.x, p.corner.y, p.footprint, p.share,      x_axis.x, x_axis.y, y_axis.x, y_axis.y,
         rect[0],    rect[1],    rect[2],     rect[3],      p.tint.r, p.tint.g, p.tint.b, p.tint.a,
         p.fog.r,    p.fog.g,    p.fog.b,     p.fog_amount, o.left,   o.top,    o.right,  o.bottom,
         o.cuts[0],  o.cuts[1],  o.cuts[2],   o.cuts[3],    old[0],   old[1],   old[2],   old[3],
         p.shift.x,  p.shift.y,  p.wrap,      p.wrap_reach});
  };
  push(batch.words, p.x_axis, p.y_axis, box);
  // What hides: as much smaller than the core as the shader makes the rest larger.
  const Octagon& core = p.slot.core;
  const float pad =
      samples > 1 ? 0.5f + 0.75f * p.footprint / std::clamp(smallest, 0.01f, 1.0f) : 0.5f;
  const float width = core.right - core.left - 2 * pad, height = core.bottom - core.top - 2 * pad;
  const auto& c = core.cuts;
  const bool hides = !p.old && p.wrap <= 0 && p.tint.a >= 1 &&
                     width > std::max(c[0] + c[1], c[2] + c[3]) &&
                     height > std::max(c[0] + c[3], c[1] + c[2]);
  if (hides) {
    push(batch.cores, p.x_axis, p.y_axis, core);
    batch.hidden += width * height * length(p.x_axis) * length(p.y_axis);
  } else {
    push(batch.cores, {}, {}, {});  // covers nothing
  }
  ++stats.sprites;
}

Color srgb(std::uint32_t rgb, float alpha) noexcept {
  const auto channel = [&](unsigned shift) {
    return detail::linear_value(static_cast<float>(rgb >> shift & 255u) / 255.0f);
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

Result<Renderer> make_renderer(GlLoader load, const RendererConfig& config) {
  Result<gl::Device> device = gl::probe(load);
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
  m.window_framebuffer = gl::current_framebuffer(m.device);
  m.stats.sprites = m.stats.batches = m.stats.uploads = 0;
  m.waiting = 0;
  m.in_frame = true;
  if (m.frame.main.width != width || m.frame.main.height != height) {
    m.frame.free(m.device);
    gl::free_target(m.device, m.encoded);
    if (width > 0 && height > 0) {
      if (auto made = gl::make_target(m.device, width, height, false)) m.frame.main = *made;
    }
  }
  m.use_surface(m.frame.main.framebuffer != 0 ? &m.frame : nullptr);
  if (m.target != nullptr) gl::clear(m.device, 0, 0, 0, 1);
}

void Renderer::clear(Color color) {
  if (impl_->target == nullptr) return;
  impl_->flush();
  gl::clear(impl_->device, color.r * color.a, color.g * color.a, color.b * color.a, color.a);
}

void Renderer::take_backdrop() {
  Impl& m = *impl_;
  if (m.target == nullptr) return;
  m.flush();
  m.has_backdrop = true;
  const gl::Target* from = &m.target->main;
  for (gl::Target& half : m.backdrop) {
    const int width = (from->width + 1) / 2, height = (from->height + 1) / 2;
    if (half.width != width || half.height != height) {
      gl::free_target(m.device, half);
      auto made = gl::make_target(m.device, width, height, false);
      if (!made) {  // no memory: no light
        m.has_backdrop = false;
        break;
      }
      half = *made;
    }
    gl::reduce(m.device, *from, half);
    from = &half;
  }
  gl::draw_to(m.device, m.target->main);
}

bool Renderer::is_cached(const TextureKey& key) const noexcept {
  return key.sprite != 0 && impl_->atlas.has(key);
}

bool Renderer::takes_blocks() const noexcept { return impl_->takes_blocks(); }

void Renderer::forget(std::uint64_t sprite) { impl_->atlas.forget(sprite); }

TextureKey reduced_key(const TextureKey& picture, float scale) noexcept {
  return reduced(picture, reduction(std::fabs(scale)));
}

void Renderer::draw_sprite(const SpriteDraw& s) {
  Impl& m = *impl_;
  if (m.target == nullptr) return;
  detail::Picture p;
  const bool fades = s.fade.share > 0;
  int side = reduction(std::fabs(s.scale * m.camera.scale));
  // Who knows that the whole picture is there need not give it again.
  if (s.image.rgba == nullptr && !m.atlas.has(reduced(s.key, side))) side = 1;
  if (s.blocks.bytes != nullptr || s.fade.blocks.bytes != nullptr) side = 1;
  const TextureKey key = reduced(s.key, side), old_key = reduced(s.fade.key, side);
  // The older picture first: it is the one that is likely to be there.
  if (fades) p.old = m.find_or_store(old_key, s.fade.image, side, s.fade.blocks);
  const auto slot = m.find_or_store(key, s.image, side, s.blocks);
  if (!slot) return;
  // Storing one may have emptied the page of the other.
  if (fades && s.fade.key.sprite != 0) p.old = m.atlas.find(old_key);
  p.slot = *slot;
  p.share = std::min(s.fade.share, 1.0f);
  m.set_axes(s, p);
  m.put_at(s.position, s.anchor, p);
  const auto size = static_cast<float>(side);
  p.x_axis = {p.x_axis.x * size, p.x_axis.y * size};
  p.y_axis = {p.y_axis.x * size, p.y_axis.y * size};
  p.shift = {(s.anchor.x - s.fade.anchor.x) / size, (s.anchor.y - s.fade.anchor.y) / size};
  p.tint = s.tint;
  p.fog = s.fog;
  p.fog_amount = s.fog_amount;
  if (m.has_backdrop) p.wrap = std::min(s.wrap, 1.0f);
  p.wrap_reach = s.wrap_reach;
  m.push_picture(p);
}

void Renderer::Impl::set_axes(const SpriteDraw& s, Picture& p) const {
  const float scale = s.scale * camera.scale;
  const float c = std::cos(s.angle) * scale, n = std::sin(s.angle) * scale;
  const float side = s.mirror ? -1.0f : 1.0f;
  p.x_axis = {side * c, side * n};
  p.y_axis = {-n, c};
}

void Renderer::Impl::put_at(Vec2 position, Vec2 texel, Picture& p) const {
  const Vec2 at = to_frame(position);
  p.corner = {at.x - p.x_axis.x * texel.x - p.y_axis.x * texel.y,
              at.y - p.x_axis.y * texel.x - p.y_axis.y * texel.y};
}

TextureKey shadow_key(const TextureKey& picture, const Shadow& shadow) noexcept {
  const float blur = shadow.blur > 0 ? std::min(shadow.blur, 64.0f) : 0.0f;
  return {picture.sprite, picture.sample, 1 + static_cast<std::uint32_t>(std::lround(4 * blur))};
}

void Renderer::draw_shadow(const SpriteDraw& s, const Shadow& shadow) {
  if (impl_->target == nullptr) return;
  const float share = std::clamp(s.fade.share, 0.0f, 1.0f);
  impl_->push_shadow(s, {s.image, s.key, s.anchor, 1 - share}, shadow);
  impl_->push_shadow(s, {s.fade.image, s.fade.key, s.fade.anchor, share}, shadow);
}

void Renderer::Impl::push_shadow(const SpriteDraw& s, const Fade& of, const Shadow& shadow) {
  const float opacity = of.share * shadow.opacity;
  if (!(opacity > 0)) return;
  const TextureKey key = shadow_key(of.key, shadow);
  const float blur = static_cast<float>(key.variant - 1) / 4;
  std::optional<detail::AtlasSlot> slot;
  if (key.sprite != 0) slot = atlas.find(key);
  if (!slot) slot = find_or_store(key, make_shadow(of.image, blur).image);
  if (!slot) return;
  Picture p;
  p.slot = *slot;
  set_axes(s, p);
  // On the ground: heights are squashed and lean over.
  const SoftShadow place = make_shadow({}, blur);  // where any picture's shadow lies
  const auto lay = [&](Vec2 v) {
    return Vec2{(v.x - shadow.slant * v.y) * place.scale, shadow.squash * v.y * place.scale};
  };
  p.x_axis = lay(p.x_axis);
  p.y_axis = lay(p.y_axis);
  put_at(
      {s.position.x + shadow.offset.x, s.position.y + shadow.offset.y},
      {(of.anchor.x - place.corner.x) / place.scale, (of.anchor.y - place.corner.y) / place.scale},
      p);
  p.tint = {shadow.color.r, shadow.color.g, shadow.color.b, opacity};
  p.footprint = 0;  // it is soft already: one sample will do
  push_picture(p);
}

void Renderer::draw_shape(const Shape& s) {
  Impl& m = *impl_;
  if (m.target == nullptr) return;
  std::vector<float>& words = m.open({.kind = Kind::Shapes, .blend = s.blend}).words;
  const Vec2 at = m.to_frame(s.center);
  const float k = m.camera.scale;
  words.insert(words.end(), {at.x, at.y, s.half_size.x * k, s.half_size.y * k, std::cos(s.angle),
                             std::sin(s.angle), s.radius * k, s.outline * k, s.feather * k, 0, 0, 0,
                             s.color.r, s.color.g, s.color.b, s.color.a});
}

void Renderer::draw_triangles(std::span<const Vertex> vertices, BlendMode blend) {
  Impl& m = *impl_;
  if (m.target == nullptr) return;
  std::vector<float>& words = m.open({.kind = Kind::Triangles, .blend = blend}).words;
  for (const Vertex& v : vertices.first(vertices.size() / 3 * 3)) {
    const Vec2 at = m.to_frame(v.position);
    words.insert(words.end(), {at.x, at.y, 0, 0, v.color.r, v.color.g, v.color.b, v.color.a});
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

}  // namespace vsprite
