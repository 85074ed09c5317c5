// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/cast_shadow.h"

#include <algorithm>

#include "film/grid.h"
#include "film/lanes.h"
#include "film/light.h"
#include "film/silhouette.h"

namespace vsprite::detail {
namespace {

constexpr float kLeast = 0.03f;            // shade below this is none ...
constexpr float kNoises = 1.5f;            // ... and below this many sigma of a cell's noise
constexpr float kStrong = 2.5f;            // times that: what makes a part a shadow
constexpr float kOffLine = 0.12f;          // |C - sB| / |sB| that is still the plate's colour
constexpr float kDarkest = 0.35f;          // s: what is darker is a thing
constexpr double kReach = 1, kNear = 0.5;  // of the body: looked at, and belonging to it
constexpr int kBlurs = 2;                  // passes of 3 x 3
constexpr int kRim = 1;                    // cells at the subject that hold some of it
constexpr int kBehind = 4;                 // cells that the shade is carried on behind it

// The cells about all parts.
Window window_of(const Frame& frame, std::span<const Blob> blobs) {
  int left = frame.width, top = frame.height, right = 0, bottom = 0;
  for (const Blob& blob : blobs) {
    left = std::min(left, blob.box.x), right = std::max(right, blob.box.x + blob.box.width);
    top = std::min(top, blob.box.y), bottom = std::max(bottom, blob.box.y + blob.box.height);
  }
  const int body = std::max(blobs[0].box.width, blobs[0].box.height);
  const int margin = std::max(static_cast<int>(kReach * body), 16);
  left = std::max(left - margin, 0) / 2, top = std::max(top - margin, 0) / 2;
  right = std::min((right + margin) / 2 + 1, frame.cell_width());
  bottom = std::min((bottom + margin) / 2 + 1, frame.cell_height());
  return {left, top, right - left, bottom - top};
}

// Which part covers a cell of the window, 0: none.
std::vector<std::uint8_t> labels_of(const KeyedFrame& keyed, const Window& window) {
  std::vector<std::uint8_t> labels(window.cells(), 0);
  for (int y = 0; y < keyed.crop.height; ++y)
    for (int x = 0; x < keyed.crop.width; ++x) {
      const std::uint8_t label =
          keyed.labels[static_cast<std::size_t>(y) * static_cast<std::size_t>(keyed.crop.width) +
                       static_cast<std::size_t>(x)];
      const int u = (keyed.crop.x + x) / 2 - window.left, v = (keyed.crop.y + y) / 2 - window.top;
      if (label == 0 || u < 0 || v < 0 || u >= window.width || v >= window.height) continue;
      labels[static_cast<std::size_t>(v) * static_cast<std::size_t>(window.width) +
             static_cast<std::size_t>(u)] = label;
    }
  return labels;
}

// Frame and plate in linear light; the plate with the frame's drift.
struct Light {
  std::vector<float> frame[3], plate[3], noise;  // noise: sigma of s in one cell
};

Light light_of(const ScreenModel& screen, const Frame& frame, const Window& window) {
  Light out;
  Grid grid;
  const std::vector<Span> spans(static_cast<std::size_t>(window.height), Span{0, window.width});
  make_grid(frame, window, spans, grid);
  const Surface drift = fit_drift(screen, frame, screen.threshold);
  const RowScale u = scale_of(window.left, frame.cell_width());
  const std::size_t n = window.cells();
  out.noise.resize(n);
  for (int p = 0; p < 3; ++p) {
    out.frame[p].resize(n);
    out.plate[p].resize(n);
  }
  for (int y = 0; y < window.height; ++y) {
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(window.width);
    const std::size_t from =
        static_cast<std::size_t>(window.top + y) * static_cast<std::size_t>(frame.cell_width()) +
        static_cast<std::size_t>(window.left);
    const double v = scaled(window.top + y, frame.cell_height());
    for (int p = 0; p < 3; ++p) {
      lanes().look_up(linear_of_sums().data(), grid.plane[p].data() + at, window.width,
                      out.frame[p].data() + at);
      lanes().shift(screen.linear[p].data() + from, screen.slope[p].data() + from,
                    row_of(drift, p, v), u, window.width, out.plate[p].data() + at);
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(window.width); ++i)
      out.noise[at + i] =
          screen.noise[0] * screen.slope[1][from + i] / std::max(out.plate[1][at + i], 1e-4f);
  }
  return out;
}

// Sums over a neighbourhood of what is free of the subject.
void smooth(const std::vector<std::uint8_t>& free, const Window& window,
            std::vector<float>& plane) {
  std::vector<float> scratch(plane.size()), out(plane.size());
  for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = free[i] ? plane[i] : 0.0f;
  for (int pass = 0; pass < kBlurs; ++pass) {
    lanes().blur3(plane.data(), window.width, window.height, scratch.data(), out.data());
    plane.swap(out);
  }
}

// 1 - s where that is on the plate's line and stands out, else 0. `strong`: well out of the noise.
std::vector<float> shade_of(Light& light, const Window& window,
                            const std::vector<std::uint8_t>& free, Mask& strong) {
  for (int p = 0; p < 3; ++p) {
    smooth(free, window, light.frame[p]);
    smooth(free, window, light.plate[p]);
  }
  std::vector<float> shade(window.cells(), 0.0f);
  for (std::size_t i = 0; i < shade.size(); ++i) {
    if (!free[i]) continue;
    float bb = 0, cb = 0, off = 0;
    for (int p = 0; p < 3; ++p) {
      bb += light.plate[p][i] * light.plate[p][i];
      cb += light.frame[p][i] * light.plate[p][i];
    }
    const float s = cb / std::max(bb, 1e-12f);
    for (int p = 0; p < 3; ++p) {
      const float rest = light.frame[p][i] - s * light.plate[p][i];
      off += rest * rest;
    }
    if (s < kDarkest || off > kOffLine * kOffLine * s * s * bb) continue;
    const float least = std::max(kLeast, kNoises * light.noise[i]);
    const float dark = 1 - s;
    if (dark <= least) continue;
    shade[i] = dark * std::min((dark - least) / least, 1.0f);
    strong.in[i] = dark > kStrong * least ? 1 : 0;
  }
  return shade;
}

// Parts without a strong core or far from every blob go; each of the others belongs to the largest
// blob that it comes near.
std::vector<std::uint8_t> owners_of(std::vector<float>& shade, const Mask& strong,
                                    const std::vector<std::uint8_t>& labels,
                                    std::span<const Blob> blobs, const Window& window) {
  const int body = std::max(blobs[0].box.width, blobs[0].box.height) / 2;
  Mask shaded(window.width, window.height);
  lanes().above(shade.data(), 0, shade.size(), shaded.in.data());
  const Mask core = erode(strong, std::clamp(body / 16, 1, 3));
  std::vector<int> parts;
  const int count = connected_parts(shaded, parts);
  std::vector<std::uint8_t> has_core(static_cast<std::size_t>(count) + 1, 0);
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (core.in[i]) has_core[static_cast<std::size_t>(parts[i])] = 1;
  std::vector<std::uint8_t> owner(has_core.size(), 0);
  for (const Blob& blob : blobs) {  // largest first
    Mask near(window.width, window.height);
    for (std::size_t i = 0; i < labels.size(); ++i) near.in[i] = labels[i] == blob.label;
    near = dilate_disc(near, std::max(static_cast<int>(kNear * body), 3));
    for (std::size_t i = 0; i < parts.size(); ++i) {
      std::uint8_t& of = owner[static_cast<std::size_t>(parts[i])];
      if (parts[i] && near.in[i] && of == 0) of = static_cast<std::uint8_t>(blob.label);
    }
  }
  std::vector<std::uint8_t> owners(parts.size(), 0);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto part = static_cast<std::size_t>(parts[i]);
    owners[i] = has_core[part] ? owner[part] : std::uint8_t{0};
    if (owners[i] == 0) shade[i] = 0;
  }
  return owners;
}

// From ring to ring behind the subject the mean of what is known beside it.
void carry_on(const Window& window, std::vector<std::uint8_t> known, std::vector<float>& shade,
              std::vector<std::uint8_t>& owners) {
  const int w = window.width, h = window.height;
  const auto at = [w](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
  };
  for (int ring = 0; ring < kBehind; ++ring) {
    const std::vector<std::uint8_t> before = known;
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        if (before[at(x, y)]) continue;
        float sum = 0;
        int count = 0;
        std::uint8_t owner = 0;
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, h - 1); ++v)
          for (int u = std::max(x - 1, 0); u <= std::min(x + 1, w - 1); ++u) {
            const std::size_t k = at(u, v);
            if (!before[k]) continue;
            sum += shade[k];
            ++count;
            if (owner == 0) owner = owners[k];
          }
        if (count == 0) continue;
        shade[at(x, y)] = sum / static_cast<float>(count);
        owners[at(x, y)] = owner;
        known[at(x, y)] = 1;
      }
  }
}

void cut_out(const Window& window, const std::vector<float>& shade,
             const std::vector<std::uint8_t>& owners, KeyedFrame& keyed) {
  int left = window.width, top = window.height, right = 0, bottom = 0;
  std::vector<std::uint8_t> bytes(shade.size());
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(window.width) +
                            static_cast<std::size_t>(x);
      bytes[i] = owners[i] ? static_cast<std::uint8_t>(255 * shade[i] + 0.5f) : std::uint8_t{0};
      if (bytes[i] == 0) continue;
      left = std::min(left, x), right = std::max(right, x + 1);
      top = std::min(top, y), bottom = std::max(bottom, y + 1);
    }
  if (right <= left) return;
  keyed.shade_cells = {window.left + left, window.top + top, right - left, bottom - top};
  for (int y = top; y < bottom; ++y) {
    const auto from = static_cast<std::ptrdiff_t>(y) * window.width;
    keyed.shade.insert(keyed.shade.end(), bytes.begin() + from + left,
                       bytes.begin() + from + right);
    keyed.shade_labels.insert(keyed.shade_labels.end(), owners.begin() + from + left,
                              owners.begin() + from + right);
  }
}

}  // namespace

void measure_shadow(const ScreenModel& screen, const Frame& frame, KeyedFrame& keyed) {
  if (keyed.blobs.empty()) return;
  const Window window = window_of(frame, keyed.blobs);
  const std::vector<std::uint8_t> labels = labels_of(keyed, window);
  Mask covered(window.width, window.height);
  for (std::size_t i = 0; i < labels.size(); ++i) covered.in[i] = labels[i] != 0;
  std::vector<std::uint8_t> free = dilate(covered, kRim).in;
  for (std::uint8_t& cell : free) cell = cell == 0;
  Light light = light_of(screen, frame, window);
  Mask strong(window.width, window.height);
  std::vector<float> shade = shade_of(light, window, free, strong);
  std::vector<std::uint8_t> owners = owners_of(shade, strong, labels, keyed.blobs, window);
  carry_on(window, std::move(free), shade, owners);
  cut_out(window, shade, owners, keyed);
}

}  // namespace vsprite::detail
