// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Puppets on the GPU: puppet_render.cpp's mapping, a face per instance. Corners are put on the same
// grid of 1/256 px, so that neighbours share their edges to the bit and the GPU's own rule gives
// each pixel to one of them. A quad is covered as two triangles and textured by the inverse
// bilinear map in the fragment shader, exactly, not by subdivision.
//
// Faces go from far to near; depth decides within a puppet, not between two. Each puppet therefore
// gets a slice of the depth buffer of its own, nearer than all before; when the slices are used up
// it is cleared.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "renderer.h"
#include "shaders/puppet.h"
#include "vsprite/puppet.h"

namespace vsprite {

namespace gl = detail::gl;
namespace glsl = shaders::puppet;
using detail::Kind;
using detail::PuppetBrush;
using detail::Skin;

namespace {

constexpr int kRow = 1024;       // texels of a row of numbers, as in the shaders
constexpr int kMostRows = 2048;  // of shares in a batch
constexpr int kSlices = 1023;    // of 8,192 steps each: 23 bits, which floats and the buffer hold
constexpr float kSteps = 8184;   // 8 x 1023: the usual fractions of it are whole numbers

struct Shelves {
  std::vector<Rect> rects;  // with their borders
  int width = 1, height = 1;
};

// The views side by side in rows as wide as the widest or about square.
Shelves place_views(const Puppet& puppet) {
  double area = 0;
  Shelves out;
  for (const PuppetView& v : puppet.views) {
    area += double(v.picture.width + 2) * (v.picture.height + 2);
    out.width = std::max(out.width, v.picture.width + 2);
  }
  const int limit = std::max(out.width, static_cast<int>(std::sqrt(area) * 1.2));
  int x = 0, y = 0, tall = 0;
  for (const PuppetView& v : puppet.views) {
    const int w = v.picture.width + 2, h = v.picture.height + 2;
    if (x > 0 && x + w > limit) x = 0, y += tall, tall = 0;
    out.rects.push_back({x, y, w, h});
    x += w;
    tall = std::max(tall, h);
    out.width = std::max(out.width, x);
    out.height = y + tall;
  }
  return out;
}

std::size_t rows_of(std::size_t texels) { return (texels + kRow - 1) / kRow; }

// On the grid of the software path.
float on_grid(float px) {
  constexpr float kFar = 1 << 15;
  return static_cast<float>(std::llround(std::clamp(px, -kFar, kFar) * 256)) / 256;
}

void sort_faces(const Puppet& puppet, const PuppetPose& pose, PuppetBrush& brush) {
  brush.order.resize(puppet.faces.size());
  brush.keys.resize(puppet.faces.size());
  for (std::size_t f = 0; f < puppet.faces.size(); ++f) {
    const Face& face = puppet.faces[f];
    float sum = 0;
    for (std::uint32_t c = 0; c < face.count; ++c) sum += pose.depth[face.corners[c]];
    brush.keys[f] = sum / static_cast<float>(face.count);
  }
  std::iota(brush.order.begin(), brush.order.end(), 0u);
  std::sort(brush.order.begin(), brush.order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return brush.keys[a] != brush.keys[b] ? brush.keys[a] < brush.keys[b] : a < b;
  });
}

}  // namespace

Result<void> Renderer::Impl::set_up_puppets() {
  if (puppets.program.id != 0) return {};
  Result<gl::Id> id = gl::make_program(device, "puppet", glsl::puppet_vert, "", glsl::puppet_frag);
  if (!id) return std::move(id).error();
  puppets.program.name = "puppet";
  puppets.program.id = *id;
  puppets.program.device = &device;
  puppets.stream = gl::make_stream(device, 5, 4);
  return {};
}

void Renderer::Impl::free_puppets() {
  for (Skin& skin : puppets.skins)
    for (const gl::Id id : {skin.page, skin.places})
      if (id != 0) gl::free_texture(device, id);
  if (puppets.shares_texture != 0) gl::free_texture(device, puppets.shares_texture);
  if (puppets.program.id != 0) gl::free_program(device, puppets.program.id);
  gl::free_stream(device, puppets.stream);
}

Result<PuppetSkin> Renderer::make_skin(const Puppet& puppet) {
  Impl& m = *impl_;
  if (auto ready = m.set_up_puppets(); !ready) return ready.error();
  const Shelves shelves = place_views(puppet);
  const std::size_t points = puppet.point_count(), texels = puppet.views.size() * (points + 1);
  if (shelves.width > m.device.max_size || shelves.height > m.device.max_size ||
      rows_of(texels) > kMostRows) {
    return Error{ErrorCode::Unavailable,
                 "puppet " + puppet.name + ": its views fill " + std::to_string(shelves.width) +
                     " x " + std::to_string(shelves.height) + " px, at most " +
                     std::to_string(m.device.max_size) + " a side are possible"};
  }
  m.flush();
  Skin skin{0, 0, shelves.width, shelves.height, puppet.views.size(), points};
  skin.page = gl::make_texture(m.device, skin.width, skin.height);
  std::vector<float> places(rows_of(texels) * kRow * 4, 0);
  float* out = places.data();
  for (std::size_t v = 0; v < puppet.views.size(); ++v) {
    const PuppetView& view = puppet.views[v];
    const Rect& r = shelves.rects[v];
    m.staging.assign(std::size_t(r.width) * std::size_t(r.height) * 4, 0);
    for (int y = 0; y < view.picture.height; ++y) {
      std::uint16_t* to = &m.staging[(std::size_t(y + 1) * std::size_t(r.width) + 1) * 4];
      const std::uint8_t* from =
          &view.picture.rgba[std::size_t(y) * std::size_t(view.picture.width) * 4];
      for (int x = 0; x < view.picture.width; ++x, to += 4, from += 4) m.light.convert(from, to);
    }
    gl::upload(m.device, skin.page, r, m.staging.data());
    const float left = static_cast<float>(r.x + 1), top = static_cast<float>(r.y + 1);
    for (const Vec2 p : view.points) {
      *out++ = left + p.x, *out++ = top + p.y;
      *out++ = 0, *out++ = 0;
    }
    *out++ = left, *out++ = top;
    *out++ = left + static_cast<float>(view.picture.width);
    *out++ = top + static_cast<float>(view.picture.height);
  }
  skin.places =
      gl::upload_numbers(m.device, 0, kRow, static_cast<int>(rows_of(texels)), places.data());
  m.stats.uploads += puppet.views.size();
  std::size_t index = 0;
  while (index < m.puppets.skins.size() && m.puppets.skins[index].page != 0) ++index;
  if (index == m.puppets.skins.size()) m.puppets.skins.emplace_back();
  m.puppets.skins[index] = skin;
  return PuppetSkin{static_cast<int>(index)};
}

void Renderer::free_skin(PuppetSkin skin) {
  if (skin.id < 0) return;
  impl_->flush();
  Skin& old = impl_->puppets.skins[static_cast<std::size_t>(skin.id)];
  for (const gl::Id id : {old.page, old.places})
    if (id != 0) gl::free_texture(impl_->device, id);
  old = {};
}

void Renderer::draw_puppet(const Puppet& puppet, const PuppetPose& pose, PuppetSkin skin_id,
                           Vec2 center, float scale) {
  Impl& m = *impl_;
  PuppetBrush& brush = m.puppets;
  if (m.target == nullptr || skin_id.id < 0) return;
  const Skin& skin = brush.skins[static_cast<std::size_t>(skin_id.id)];
  if (skin.points != pose.points.size() || skin.views != pose.shares.size()) return;
  const detail::BatchState state{.kind = Kind::Puppets, .page = skin_id.id};
  const bool follows = m.waiting > 0 && m.batches[m.waiting - 1].state == state;
  if (!follows || brush.slices == kSlices ||
      rows_of(brush.shares.size() / 4 + skin.views) > kMostRows) {
    m.flush();
    brush.shares.clear();
  }
  if (brush.slices == 0 || brush.slices == kSlices) {
    if (!gl::clear_depth(m.device, m.target->main)) return;
    brush.slices = 0;
  }
  ++brush.slices;
  std::vector<float>& words = m.open(state).words;
  const auto base = static_cast<float>(brush.shares.size() / 4);
  for (const float share : pose.shares) brush.shares.insert(brush.shares.end(), {share, 0, 0, 0});
  const auto [low, high] = std::minmax_element(pose.depth.begin(), pose.depth.end());
  const float far = *low, step = *high > *low ? kSteps / (*high - *low) : 0;
  const Vec2 at = m.to_frame(center);
  const float k = scale * m.camera.scale;
  brush.placed.resize(skin.points), brush.steps.resize(skin.points);
  for (std::size_t i = 0; i < skin.points; ++i) {
    const Vec2 p = pose.points[i];
    brush.placed[i] = {on_grid(at.x + k * p.x), on_grid(at.y + k * p.y)};
    brush.steps[i] = (pose.depth[i] - far) * step;
  }

  sort_faces(puppet, pose, brush);
  const float slice = static_cast<float>(brush.slices) * 8192;
  for (const std::uint32_t f : brush.order) {
    const Face& face = puppet.faces[f];
    const bool quad = face.count == 4;
    const std::array<std::uint32_t, 4> c{face.corners[0], face.corners[1], face.corners[2],
                                         face.corners[quad ? 3 : 2]};
    const Vec2 p0 = brush.placed[c[0]], p1 = brush.placed[c[1]], p2 = brush.placed[c[2]],
               p3 = brush.placed[c[3]];
    // As the software path cuts it: along the diagonal whose two halves turn alike.
    const auto turns = [](Vec2 p, Vec2 q, Vec2 r) {
      return (double{q.x} - p.x) * (double{r.y} - p.y) > (double{q.y} - p.y) * (double{r.x} - p.x);
    };
    const bool first = quad && turns(p0, p1, p2) == turns(p2, p3, p0);
    const bool convex =
        first && turns(p0, p1, p3) == turns(p1, p2, p3) && turns(p0, p1, p2) == turns(p0, p1, p3);
    const float cut = !quad ? 0.0f : first ? 1.0f : 2.0f;
    const auto push = [&](std::initializer_list<float> v) { words.insert(words.end(), v); };
    push({p0.x, p0.y, p1.x, p1.y, p2.x, p2.y, p3.x, p3.y});
    push(
        {brush.steps[c[0]], brush.steps[c[1]], brush.steps[c[2]], quad ? brush.steps[c[3]] : 0.0f});
    push({static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2]),
          static_cast<float>(c[3]), base, cut, convex ? 1.0f : 0.0f, slice});
  }
  ++m.stats.sprites;
}

void Renderer::Impl::flush_puppets(const detail::Batch& batch) {
  const Skin& skin = puppets.skins[static_cast<std::size_t>(batch.state.page)];
  const std::size_t rows = rows_of(puppets.shares.size() / 4);
  puppets.shares.resize(rows * kRow * 4, 0);
  puppets.shares_texture = gl::upload_numbers(device, puppets.shares_texture, kRow,
                                              static_cast<int>(rows), puppets.shares.data());
  detail::Program& program = puppets.program;
  gl::use(device, program.id);
  int unit = 0;
  for (const auto& [name, texture] :
       {std::pair{"page", skin.page}, std::pair{"places", skin.places},
        std::pair{"shares", puppets.shares_texture}}) {
    gl::bind(device, unit, texture);
    gl::set_sampler(device, program.location(name), unit++);
  }
  program.set("frame_size",
              {static_cast<float>(target->main.width), static_cast<float>(target->main.height)});
  program.set("page_size", {static_cast<float>(skin.width), static_cast<float>(skin.height)});
  program.set("view_count", {static_cast<float>(skin.views)});
  program.set("point_count", {static_cast<float>(skin.points)});
  gl::blend(device, batch.state.blend);
  gl::use_depth(device, true);
  gl::draw(device, puppets.stream, batch.words.data(), batch.words.size() / 20);
  gl::use_depth(device, false);
}

}  // namespace vsprite
