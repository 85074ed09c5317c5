// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// From the chroma grid to pixels: alpha gets the detail of luma, which films carry in full,
//
//     alpha = up(alpha_h) + up(a) (g - up(g_h)),   a = cov(alpha_h, g_h) / (var(g_h) + 1e-4) in 3 x
//     3
//
// with g the linear luma less the plate's; colour is unmixed on the grid and takes its brightness
// from the pixel. Never the other way round: chroma blown up to pixels shows screen inside the
// subject.
#include "film/matte.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "film/color.h"
#include "film/light.h"
#include "film/unmix.h"

namespace vsprite {
namespace {

using detail::Mask;
using detail::Patch;
using detail::Silhouette;

constexpr int kMostBlobs = 32;
constexpr float kDetailRidge = 1e-4f;

// Four times the encoded luma 0..255 of each Y of a film: an index of the table of sums.
std::array<std::uint16_t, 256> luma_sums(const Coding& coding) {
  std::array<std::uint16_t, 256> table{};
  const RgbOfYcc m = rgb_of_ycc(coding);
  for (int y = 0; y < 256; ++y)
    table[static_cast<std::size_t>(y)] = static_cast<std::uint16_t>(m.sums(4 * y, 128, 128, 4)[0]);
  return table;
}

// The two cells that a pixel lies between, and the share of the second.
struct Between {
  int first, second;
  float share;
};

Between between(int pixel, int cells) {
  const int cell = pixel / 2;
  if (pixel % 2 == 0) return {std::max(cell - 1, 0), cell, 0.75f};
  return {cell, std::min(cell + 1, cells - 1), 0.25f};
}

struct Bilinear {
  std::size_t at[4];
  float share[4];

  Bilinear(Between x, Between y, int width) {
    const auto index = [&](int cx, int cy) {
      return static_cast<std::size_t>(cy) * static_cast<std::size_t>(width) +
             static_cast<std::size_t>(cx);
    };
    at[0] = index(x.first, y.first);
    at[1] = index(x.second, y.first);
    at[2] = index(x.first, y.second);
    at[3] = index(x.second, y.second);
    share[0] = (1 - x.share) * (1 - y.share);
    share[1] = x.share * (1 - y.share);
    share[2] = (1 - x.share) * y.share;
    share[3] = x.share * y.share;
  }
  float of(const std::vector<float>& plane) const {
    return share[0] * plane[at[0]] + share[1] * plane[at[1]] + share[2] * plane[at[2]] +
           share[3] * plane[at[3]];
  }
};

}  // namespace

struct Keyer::Impl {
  const ScreenModel* screen;
  MatteConfig config;
  Silhouette silhouette;
  Patch patch;

  std::array<std::uint16_t, 256> luma;  // of the film's Y
  YccOfRgb weights;

  // Maps of pixels over the patch.
  int left = 0, top = 0, width = 0, height = 0;  // film pixels
  std::vector<float> alpha;                      // 0..1, clipped
  std::vector<float> gain, guide;                // cells: a and g_h
  std::vector<float> own[3];                     // cells: the subject's colour F
  std::vector<std::uint8_t> inner;               // cells: 0 edge, 1 all opaque around, 2 all clear

  std::size_t pixel(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  std::size_t cell(int x, int y) const {
    return static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(patch.width) +
           static_cast<std::size_t>(x / 2);
  }
  // Of the frame or the plate.
  std::size_t luma_at(const Frame& frame, int x, int y) const {
    return luma[frame.y[static_cast<std::size_t>(top + y) * static_cast<std::size_t>(frame.width) +
                        static_cast<std::size_t>(left + x)]];
  }
  // Linear luma of the plate at a pixel, with the frame's drift.
  float plate_luma(int x, int y) const {
    const std::size_t at =
        static_cast<std::size_t>(top + y) * static_cast<std::size_t>(screen->width) +
        static_cast<std::size_t>(left + x);
    const float code = 4 * (luma_scale * (static_cast<float>(screen->luma[at]) - luma_black) +
                            drift_luma[cell(x, y)]);
    return detail::linear_of_sums()[static_cast<std::size_t>(
        std::clamp(code + 0.5f, 0.0f, 1020.0f))];
  }
  float luma_scale, luma_black;   // of ScreenModel::luma, to code values 0..255
  std::vector<float> drift_luma;  // cells, code values

  void measure_guide(const Frame& frame);
  void measure_gain();
  void raise_alpha(const Frame& frame);
  void measure_own_color();
  void find_blobs(KeyedFrame& result, std::vector<int>& labels);
  void paint(const Frame& frame, const std::vector<int>& labels, KeyedFrame& result);
  void whole_frame(const Frame& frame, KeyedFrame& result) const;
};

// g_h: the mean over the cell of linear luma less the plate's.
void Keyer::Impl::measure_guide(const Frame& frame) {
  const auto& light = detail::linear_of_sums();
  const std::size_t n = patch.cells();
  guide.assign(n, 0);
  drift_luma.resize(n);
  inner.assign(n, 0);
  for (int cy = 0; cy < patch.height; ++cy)
    for (int cx = 0; cx < patch.width; ++cx) {
      const std::size_t i = static_cast<std::size_t>(cy) * static_cast<std::size_t>(patch.width) +
                            static_cast<std::size_t>(cx);
      const double u = detail::scaled(patch.left + cx, silhouette.grid.width);
      const double v = detail::scaled(patch.top + cy, silhouette.grid.height);
      const auto& drift = silhouette.drift;
      drift_luma[i] = weights.blue * static_cast<float>(drift.at(0, u, v)) +
                      weights.green * static_cast<float>(drift.at(1, u, v)) +
                      weights.red * static_cast<float>(drift.at(2, u, v));
      // Cells with nothing but 0 or nothing but 1 around need no detail.
      float low = 1;
      float high = 0;
      for (int y = std::max(cy - 1, 0); y <= std::min(cy + 1, patch.height - 1); ++y)
        for (int x = std::max(cx - 1, 0); x <= std::min(cx + 1, patch.width - 1); ++x) {
          const float a =
              patch.alpha[static_cast<std::size_t>(y) * static_cast<std::size_t>(patch.width) +
                          static_cast<std::size_t>(x)];
          low = std::min(low, a);
          high = std::max(high, a);
        }
      inner[i] = low >= 1 ? 1 : high <= 0 ? 2 : 0;
      float sum = 0;
      int count = 0;
      for (int y = 2 * cy; y < std::min(2 * cy + 2, height); ++y)
        for (int x = 2 * cx; x < std::min(2 * cx + 2, width); ++x, ++count)
          sum += light[luma_at(frame, x, y)] - plate_luma(x, y);
      guide[i] = sum / static_cast<float>(std::max(count, 1));
    }
}

void Keyer::Impl::measure_gain() {
  gain.assign(patch.cells(), 0);
  for (int cy = 0; cy < patch.height; ++cy)
    for (int cx = 0; cx < patch.width; ++cx) {
      const std::size_t i = static_cast<std::size_t>(cy) * static_cast<std::size_t>(patch.width) +
                            static_cast<std::size_t>(cx);
      if (inner[i]) continue;
      float a = 0;
      float g = 0;
      float ag = 0;
      float gg = 0;
      float count = 0;
      for (int y = std::max(cy - 1, 0); y <= std::min(cy + 1, patch.height - 1); ++y)
        for (int x = std::max(cx - 1, 0); x <= std::min(cx + 1, patch.width - 1); ++x) {
          const std::size_t j =
              static_cast<std::size_t>(y) * static_cast<std::size_t>(patch.width) +
              static_cast<std::size_t>(x);
          a += patch.alpha[j];
          g += guide[j];
          ag += patch.alpha[j] * guide[j];
          gg += guide[j] * guide[j];
          count += 1;
        }
      gain[i] = (ag - a * g / count) / (gg - g * g / count + count * kDetailRidge);
    }
}

void Keyer::Impl::raise_alpha(const Frame& frame) {
  const auto& light = detail::linear_of_sums();
  alpha.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  for (int y = 0; y < height; ++y) {
    const Between rows = between(y, patch.height);
    for (int x = 0; x < width; ++x) {
      const std::uint8_t kind = inner[cell(x, y)];
      if (kind == 2) continue;
      float& out = alpha[pixel(x, y)];
      if (kind == 1) {
        out = 1;
        continue;
      }
      const Bilinear up(between(x, patch.width), rows, patch.width);
      const float g = light[luma_at(frame, x, y)] - plate_luma(x, y);
      const float a = up.of(patch.alpha) + up.of(gain) * (g - up.of(guide));
      // Before a plain plate shadows and the codec's smear look like thin subject: they are taken
      // off.
      const float shade = screen->kind == KeyKind::Plate ? 0.15f : 0.0f;
      const float clear = (a - shade) / (1 - shade);
      out = clear < config.clip_low ? 0.0f : clear > config.clip_high ? 1.0f : clear;
    }
  }
}

// F per cell: unmixed where there is enough of it, else that of the neighbourhood; the screen's hue
// is taken out as far as the neighbourhood has none of it.
void Keyer::Impl::measure_own_color() {
  for (int p = 0; p < 3; ++p) own[p].assign(patch.cells(), 0);
  for (std::size_t i = 0; i < patch.cells(); ++i) {
    const float a = patch.alpha[i];
    if (!(a > 0)) continue;
    float f[3];
    const float trust = a * a * a;
    for (int p = 0; p < 3; ++p) {
      const float free = patch.plate[p][i] + (patch.frame[p][i] - patch.plate[p][i]) / a;
      const float unmixed = std::clamp(free, 0.0f, 1.0f);
      f[p] = (trust * unmixed + 0.05f * patch.mean[p][i]) / (trust + 0.05f);
    }
    if (screen->key >= 0 && !(a >= 1 && inner[i] == 1)) {
      const float allowed = std::max(
          detail::key_strength(screen->key, patch.mean[0][i], patch.mean[1][i], patch.mean[2][i]),
          0.0f);
      const float excess = detail::key_strength(screen->key, f[0], f[1], f[2]) - allowed;
      if (excess > 0) {
        const bool single = screen->key < 3;
        for (int p = 0; p < 3; ++p)
          if ((p == screen->key % 3) == single) f[p] = std::max(f[p] - excess, 0.0f);
      }
    }
    for (int p = 0; p < 3; ++p) own[p][i] = f[p];
  }
}

// Parts on the grid, near ones joined; those without a seed are noise.
void Keyer::Impl::find_blobs(KeyedFrame& result, std::vector<int>& labels) {
  Mask covered(patch.width, patch.height);
  Mask solid(patch.width, patch.height);
  std::vector<float> cover(patch.cells());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) cover[cell(x, y)] += 0.25f * alpha[pixel(x, y)];
  for (std::size_t i = 0; i < cover.size(); ++i) {
    covered.in[i] = cover[i] > 0 ? 1 : 0;
    solid.in[i] = cover[i] >= 0.5f ? 1 : 0;
  }
  const int parts = connected_parts(dilate(covered, 1), labels);
  struct Part {
    int seeds = 0;
    double area = 0;
    int label = 0;
  };
  std::vector<Part> sums(static_cast<std::size_t>(parts) + 1);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (!covered.in[i]) labels[i] = 0;
    Part& part = sums[static_cast<std::size_t>(labels[i])];
    part.seeds += patch.seeds.in[i];
    part.area += 4 * static_cast<double>(cover[i]);
    part.label = labels[i];
  }
  sums[0] = Part{};
  std::erase_if(sums, [](const Part& p) { return p.label == 0 || p.seeds == 0; });
  std::sort(sums.begin(), sums.end(), [](const Part& a, const Part& b) {
    return a.area != b.area ? a.area > b.area : a.label < b.label;
  });
  if (sums.size() > static_cast<std::size_t>(kMostBlobs)) sums.resize(kMostBlobs);
  std::vector<int> renamed(static_cast<std::size_t>(parts) + 1);
  for (std::size_t k = 0; k < sums.size(); ++k)
    renamed[static_cast<std::size_t>(sums[k].label)] = static_cast<int>(k) + 1;
  for (int& label : labels) label = renamed[static_cast<std::size_t>(label)];

  // The anchor's mask: solid cells, opened until thin parts are gone, with the soft edge added
  // back.
  std::vector<double> opened_weight(sums.size() + 1);
  std::vector<Mask> openings;
  for (int radius = screen->opening; radius > 0; radius /= 2)
    openings.push_back(dilate(open_disc(solid, radius), 1));
  openings.push_back(covered);
  std::vector<std::size_t> choice(sums.size() + 1, openings.size() - 1);
  for (std::size_t o = openings.size(); o-- > 0;)
    for (std::size_t i = 0; i < labels.size(); ++i)
      if (labels[i] && openings[o].in[i]) choice[static_cast<std::size_t>(labels[i])] = o;

  struct Sums {
    double area = 0, weight = 0, x = 0, y = 0;
    int left = 1 << 30, top = 1 << 30, right = -1, bottom = -1;
    bool border = false;
  };
  std::vector<Sums> all(sums.size() + 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float a = alpha[pixel(x, y)];
      const std::size_t c = cell(x, y);
      const auto label = static_cast<std::size_t>(labels[c]);
      if (!(a > 0) || label == 0) continue;
      Sums& s = all[label];
      s.area += static_cast<double>(a);
      s.left = std::min(s.left, x);
      s.right = std::max(s.right, x + 1);
      s.top = std::min(s.top, y);
      s.bottom = std::max(s.bottom, y + 1);
      const bool edge = left + x < 1 || top + y < 1 || left + x >= screen->width - 1 ||
                        top + y >= screen->height - 1;
      if (edge && a > 0.2f) s.border = true;
      if (!openings[choice[label]].in[c]) continue;
      s.weight += static_cast<double>(a);
      s.x += static_cast<double>(a) * (left + x + 0.5);
      s.y += static_cast<double>(a) * (top + y + 0.5);
    }
  for (std::size_t label = 1; label < all.size(); ++label) {
    const Sums& s = all[label];
    if (s.right < 0 || !(s.weight > 0)) continue;
    Blob blob;
    blob.box = {left + s.left, top + s.top, s.right - s.left, s.bottom - s.top};
    blob.area = s.area;
    blob.anchor_x = s.x / s.weight;
    blob.anchor_y = s.y / s.weight;
    blob.touches_border = s.border;
    blob.label = static_cast<int>(label);
    result.blobs.push_back(blob);
  }
}

void Keyer::Impl::paint(const Frame& frame, const std::vector<int>& labels, KeyedFrame& result) {
  if (result.blobs.empty()) return;
  Rect crop = result.blobs[0].box;
  for (const Blob& blob : result.blobs) {
    const int right = std::max(crop.x + crop.width, blob.box.x + blob.box.width);
    const int bottom = std::max(crop.y + crop.height, blob.box.y + blob.box.height);
    crop.x = std::min(crop.x, blob.box.x);
    crop.y = std::min(crop.y, blob.box.y);
    crop.width = right - crop.x;
    crop.height = bottom - crop.y;
  }
  result.crop = crop;
  result.straight.width = crop.width;
  result.straight.height = crop.height;
  const std::size_t n =
      static_cast<std::size_t>(crop.width) * static_cast<std::size_t>(crop.height);
  result.straight.rgba.assign(4 * n, 0);
  result.labels.assign(n, 0);
  const auto& light = detail::linear_of_sums();
  // Deeper than 6 cells the picture is taken as it is: green clothes stay green.
  const auto depth = detail::distance_to(patch.seeds, 0);
  for (int cy = 0; cy < crop.height; ++cy) {
    const int y = crop.y + cy - top;
    const Between rows = between(y, patch.height);
    for (int cx = 0; cx < crop.width; ++cx) {
      const int x = crop.x + cx - left;
      const float a = alpha[pixel(x, y)];
      const std::size_t c = cell(x, y);
      if (!(a > 0) || labels[c] == 0) continue;
      const std::size_t to = static_cast<std::size_t>(cy) * static_cast<std::size_t>(crop.width) +
                             static_cast<std::size_t>(cx);
      const auto code = static_cast<std::uint8_t>(a * 255 + 0.5f);
      if (code == 0) continue;
      result.labels[to] = static_cast<std::uint8_t>(labels[c]);
      std::uint8_t* out = result.straight.rgba.data() + 4 * to;
      out[3] = code;
      if (depth[c] > 30) {
        const auto rgb = rgb_at(frame, left + x, top + y);
        std::copy(rgb.begin(), rgb.end(), out);
        continue;
      }
      // F from the cells around, each as far as it is covered.
      const Bilinear up(between(x, patch.width), rows, patch.width);
      float f[3] = {};
      float total = 0;
      for (int k = 0; k < 4; ++k) {
        const float w = up.share[k] * patch.alpha[up.at[k]];
        total += w;
        for (int p = 0; p < 3; ++p) f[p] += w * own[p][up.at[k]];
      }
      if (!(total > 0)) {
        for (int p = 0; p < 3; ++p) f[p] = patch.mean[p][c];
        total = 1;
      }
      for (float& value : f) value /= total;
      // Brightness of the pixel itself, trusted as far as it is covered: what its luma is above
      // that of the mixture expected, in code values.
      std::uint8_t own_rgb[3];
      for (int p = 0; p < 3; ++p) own_rgb[p] = detail::encoded_of(f[p]);
      const float own_luma = 4 * (weights.red * static_cast<float>(own_rgb[0]) +
                                  weights.green * static_cast<float>(own_rgb[1]) +
                                  weights.blue * static_cast<float>(own_rgb[2]));
      const float mixed =
          a * light[static_cast<std::size_t>(own_luma + 0.5f)] + (1 - a) * plate_luma(x, y);
      const float expected = static_cast<float>(4 * detail::encoded_of(mixed));
      const float lift = 0.25f * a * a * (static_cast<float>(luma_at(frame, x, y)) - expected);
      for (int p = 0; p < 3; ++p)
        out[p] = static_cast<std::uint8_t>(
            std::clamp(static_cast<float>(own_rgb[p]) + lift + 0.5f, 0.0f, 255.0f));
    }
  }
}

// Key `none`: everything is subject, and the frame's border is not its edge.
void Keyer::Impl::whole_frame(const Frame& frame, KeyedFrame& result) const {
  const std::size_t n = frame.y.size();
  result.crop = {0, 0, frame.width, frame.height};
  result.straight = to_image(frame);
  result.labels.assign(n, 1);
  Blob blob;
  blob.box = result.crop;
  blob.area = static_cast<double>(n);
  blob.anchor_x = 0.5 * frame.width;
  blob.anchor_y = 0.5 * frame.height;
  blob.label = 1;
  result.blobs.push_back(blob);
}

namespace {

// Of luma, in code values.
double mean_difference(const Frame& a, const Frame& b, const Rect& box) {
  if (a.y.size() != b.y.size() || box.width < 1 || box.height < 1) return 0;
  std::uint64_t sum = 0;
  for (int y = box.y; y < box.y + box.height; ++y) {
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) +
                           static_cast<std::size_t>(box.x);
    const std::size_t n = static_cast<std::size_t>(box.width);
    std::uint32_t row = 0;
    for (std::size_t i = 0; i < n; ++i)
      row += static_cast<std::uint32_t>(std::abs(a.y[at + i] - b.y[at + i]));
    sum += row;
  }
  return static_cast<double>(sum) / (1.0 * box.width * box.height);
}

}  // namespace

Keyer::Keyer(const ScreenModel& screen, const MatteConfig& config)
    : impl_(std::make_unique<Impl>()) {
  impl_->screen = &screen;
  impl_->luma = luma_sums(screen.plate.coding);
  impl_->luma_scale = 1 / (64 * ycc_of_rgb(screen.plate.coding).luma);
  impl_->luma_black = 64 * ycc_of_rgb(screen.plate.coding).black;
  impl_->weights = ycc_of_rgb(screen.plate.coding);
  impl_->config = config;
}

Keyer::~Keyer() = default;

KeyedFrame Keyer::key(const Frame& frame, const Frame* before) {
  KeyedFrame result;
  result.index = frame.index;
  Impl& k = *impl_;
  if (k.screen->kind == KeyKind::None) {
    k.whole_frame(frame, result);
  } else {
    detail::find_silhouette(*k.screen, frame, k.silhouette);
    if (k.silhouette.empty) return result;
    detail::cut_patch(*k.screen, k.silhouette, k.patch);
    detail::unmix(*k.screen, k.patch);
    k.left = 2 * k.patch.left;
    k.top = 2 * k.patch.top;
    k.width = std::min(2 * k.patch.width, frame.width - k.left);
    k.height = std::min(2 * k.patch.height, frame.height - k.top);
    k.measure_guide(frame);
    k.measure_gain();
    k.raise_alpha(frame);
    k.measure_own_color();
    std::vector<int> labels;
    k.find_blobs(result, labels);
    k.paint(frame, labels, result);
  }
  if (before && !result.blobs.empty())
    result.difference = mean_difference(frame, *before, result.blobs[0].box);
  return result;
}

}  // namespace vsprite
