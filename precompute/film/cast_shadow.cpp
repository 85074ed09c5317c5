// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/cast_shadow.h"

#include <algorithm>
#include <cmath>

#include "film/grid.h"
#include "film/lanes.h"
#include "film/light.h"
#include "film/silhouette.h"

namespace vsprite::detail {
namespace {

constexpr float kLeast = 0.03f;            // shade below this is none ...
constexpr float kNoises = 4;               // ... and below this many sigma of s nearby
constexpr float kStrong = 2.5f;            // times that: what makes a part a shadow
constexpr float kOffLine = 0.12f;          // |C - sB| / |sB| that is still the plate's colour
constexpr float kDarkest = 0.35f;          // s: what is darker is a thing
constexpr double kReach = 1, kNear = 0.5;  // of the body: looked at, and belonging to it
constexpr int kBlurs = 2;                  // passes of 3 x 3
constexpr int kRim = 1;                    // cells at the subject that hold some of it
constexpr int kBehind = 4;                 // cells that the shade is carried on behind it

// In a matte.
constexpr float kThin = 0.6f;      // alpha below it may be shade
constexpr float kTelling = 0.25f;  // of the plate: how far off its line the subject has to be
constexpr float kNone = 0.1f, kSome = 0.25f;  // coverage that the colour off the line speaks for

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
  std::vector<float> frame[3], plate[3];
};

Light light_of(const ScreenModel& screen, const Frame& frame, const Window& window) {
  Light out;
  Grid grid;
  const std::vector<Span> spans(static_cast<std::size_t>(window.height), Span{0, window.width});
  make_grid(frame, window, spans, grid);
  const Surface drift = fit_drift(screen, frame, screen.threshold);
  const RowScale u = scale_of(window.left, frame.cell_width());
  const std::size_t n = window.cells();
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
  }
  return out;
}

// Sums over a neighbourhood of what is free of the subject.
void smooth(const std::vector<std::uint8_t>& free, const Window& window,
            std::vector<float>& plane) {
  std::vector<float> out(plane.size());
  for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = free[i] ? plane[i] : 0.0f;
  for (int pass = 0; pass < kBlurs; ++pass) {
    blur3(plane, window.width, window.height, out);
    plane.swap(out);
  }
}

// Off the line of the plate (r, g, b of it), squared; `s`: along it.
float off_line(const float (&color)[3], const float (&plate)[3], float& s) {
  float bb = 0, cb = 0, off = 0;
  for (int p = 0; p < 3; ++p) bb += plate[p] * plate[p], cb += color[p] * plate[p];
  s = cb / std::max(bb, 1e-12f);
  for (int p = 0; p < 3; ++p) {
    const float rest = color[p] - s * plate[p];
    off += rest * rest;
  }
  return off;
}

// 1 - s where that is on the plate's line and stands out, else 0. `strong`: well out of the noise,
// which is the usual |1 - s| of the neighbourhood: most of it lies bare.
std::vector<float> shade_of(Light& light, const Window& window,
                            const std::vector<std::uint8_t>& free, Mask& strong) {
  for (int p = 0; p < 3; ++p) {
    smooth(free, window, light.frame[p]);
    smooth(free, window, light.plate[p]);
  }
  std::vector<float> shade(window.cells(), 0.0f), off;
  for (std::size_t i = 0; i < shade.size(); ++i) {
    if (!free[i]) continue;
    const float color[3] = {light.frame[0][i], light.frame[1][i], light.frame[2][i]};
    const float plate[3] = {light.plate[0][i], light.plate[1][i], light.plate[2][i]};
    const float bb = plate[0] * plate[0] + plate[1] * plate[1] + plate[2] * plate[2];
    float s = 0;
    const float rest = off_line(color, plate, s);
    off.push_back(std::abs(1 - s));
    if (s > kDarkest && rest < kOffLine * kOffLine * s * s * bb) shade[i] = std::max(1 - s, 0.0f);
  }
  if (off.empty()) return shade;
  const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
  std::nth_element(off.begin(), middle, off.end());
  const float least = std::max(kLeast, kNoises * 1.48f * *middle);
  for (std::size_t i = 0; i < shade.size(); ++i) {
    const float dark = shade[i];
    strong.in[i] = dark > kStrong * least ? 1 : 0;
    shade[i] = dark * std::clamp((dark - least) / least, 0.0f, 1.0f);
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

void leave_to_shadow(Patch& patch) {
  for (std::size_t i = 0; i < patch.cells(); ++i) {
    float& alpha = patch.alpha[i];
    if (!(alpha > 0) || alpha > kThin || patch.seeds.in[i]) continue;
    float color[3], plate[3], mean[3], s = 0, of_mean = 0, bb = 0;
    for (int p = 0; p < 3; ++p) {
      color[p] = patch.frame[p][i], plate[p] = patch.plate[p][i], mean[p] = patch.mean[p][i];
      bb += plate[p] * plate[p];
    }
    const float subject = off_line(mean, plate, of_mean);
    const float here = off_line(color, plate, s);
    if (subject < kTelling * kTelling * bb || s < kDarkest || s > 1 - kStrong * kLeast) continue;
    const float covered = std::sqrt(here / subject);
    alpha *= std::clamp((covered - kNone) / (kSome - kNone), 0.0f, 1.0f);
  }
}

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
