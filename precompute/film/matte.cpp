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
#include <cstring>

#include "film/cast_shadow.h"
#include "film/color.h"
#include "film/coverage.h"
#include "film/light.h"
#include "film/touch_up.h"
#include "film/unmix.h"
#include "hwy/cache_control.h"

namespace vsprite {
namespace {

using detail::lanes;
using detail::Mask;
using detail::Patch;
using detail::Silhouette;
using detail::Span;

constexpr int kMostBlobs = 32;
constexpr int kShadow = 6;  // cells around the body where its contact shadow and smear lie

}  // namespace

struct Keyer::Impl {
  const ScreenModel* screen;
  MatteConfig config;
  Silhouette silhouette;
  Patch patch;
  float light[256];  // linear luma of the film's Y
  YccOfRgb weights;

  // Maps of cells.
  std::vector<float> gain, guide, own[3];
  std::vector<std::uint8_t> inner;  // 1: all opaque around, 2: all clear, else 0
  Mask shaded;                      // where a standing plate may lie in the subject's shadow
  std::vector<float> product;       // working room
  // Maps of pixels over the patch, `stride` = 2 x patch.width apart.
  int left = 0, top = 0, width = 0, height = 0;  // film pixels
  std::size_t stride = 0;
  std::vector<float> detail, plate;  // linear luma less the plate's, and the plate's
  std::vector<std::uint8_t> alpha;
  std::vector<std::uint8_t> measured;  // alpha before a person's settings; empty without any

  void prepare();
  void place(const Frame& frame);
  void measure_detail(const Frame& frame);
  void measure_guide();
  void mark_inner();
  void raise_alpha();
  void touch_up_alpha();
  void measure_own_color();
  void keep_tint(std::ptrdiff_t at, std::size_t count, detail::Planes mixed);
  void find_blobs(KeyedFrame& result, std::vector<int>& labels);
  void paint(const Frame& frame, const std::vector<int>& labels, KeyedFrame& result);
  void touch_up_color(KeyedFrame& result) const;
  void whole_frame(const Frame& frame, KeyedFrame& result) const;
};

// What depends on the film alone.
void Keyer::Impl::prepare() {
  const auto& table = detail::linear_of_sums();
  const RgbOfYcc m = rgb_of_ycc(screen->plate.coding);
  for (int y = 0; y < 256; ++y)
    light[y] = table[static_cast<std::size_t>(m.sums(4 * y, 128, 128, 4)[0])];
  weights = ycc_of_rgb(screen->plate.coding);
}

void Keyer::Impl::place(const Frame& frame) {
  left = 2 * patch.left;
  top = 2 * patch.top;
  width = std::min(2 * patch.width, frame.width - left);
  height = std::min(2 * patch.height, frame.height - top);
  stride = 2 * static_cast<std::size_t>(patch.width);
}

// Linear luma of the rim's pixels less the plate's; what an odd edge lacks repeats the last one.
void Keyer::Impl::measure_detail(const Frame& frame) {
  const auto rows = 2 * static_cast<std::size_t>(patch.height);
  detail.resize(rows * stride);
  plate.resize(rows * stride);
  std::vector<float> drift(stride);  // a cell's twice, for its pixels
  const int w = frame.cell_width();
  const double step = w > 1 ? 2.0 / (w - 1) : 0.0;
  for (const auto& [cell_row, span] : patch.rim) {
    const double v = detail::scaled(patch.top + cell_row, frame.cell_height());
    const std::size_t from =
        static_cast<std::size_t>(patch.top + cell_row) * static_cast<std::size_t>(w) +
        static_cast<std::size_t>(patch.left + span.begin);
    lanes().luma_drift(
        screen->slope[1].data() + from,
        {detail::row_of(silhouette.drift, 0, v), detail::row_of(silhouette.drift, 1, v),
         detail::row_of(silhouette.drift, 2, v)},
        {weights.red, weights.green, weights.blue}, patch.left + span.begin, step, span.size(),
        drift.data() + 2 * span.begin);
    const auto skipped = static_cast<std::size_t>(span.begin);
    for (int y = 2 * cell_row; y < std::min(2 * cell_row + 2, height); ++y) {
      const std::size_t pixel =
          static_cast<std::size_t>(top + y) * static_cast<std::size_t>(frame.width) +
          static_cast<std::size_t>(left) + 2 * skipped;
      if (y + 2 < height) {  // the next cells' pixels are asked for ahead
        const std::uint8_t* next = frame.y.data() + pixel + 2 * frame.width;
        const std::uint16_t* next_plate = screen->luma.data() + pixel + 2 * frame.width;
        for (int x = 0; x < 2 * span.size(); x += 64) hwy::Prefetch(next + x);
        for (int x = 0; x < 2 * span.size(); x += 32) hwy::Prefetch(next_plate + x);
      }
      float* out = detail.data() + static_cast<std::size_t>(y) * stride;
      float* below = plate.data() + static_cast<std::size_t>(y) * stride;
      lanes().detail(frame.y.data() + pixel, light, screen->luma.data() + pixel,
                     drift.data() + 2 * skipped, std::min(2 * span.end, width) - 2 * span.begin,
                     out + 2 * skipped, below + 2 * skipped);
      if (2 * span.end > width) {
        out[width] = out[width - 1];
        below[width] = below[width - 1];
      }
    }
  }
  for (auto y = static_cast<std::size_t>(height); y < rows; ++y)
    for (auto* plane : {&detail, &plate})
      std::copy_n(plane->data() + (y - 1) * stride, stride, plane->data() + y * stride);
}

// g_h: the mean of g over a cell; a: how much of g is alpha's own detail.
void Keyer::Impl::measure_guide() {
  const std::size_t n = patch.cells();
  guide.resize(n);
  gain.resize(n);
  for (const auto& [y, span] : patch.rim) {
    const float* first = detail.data() +
                         2 * static_cast<std::ptrdiff_t>(y) * static_cast<std::ptrdiff_t>(stride) +
                         2 * span.begin;
    lanes().halve(first, first + stride, span.size(),
                  guide.data() + static_cast<std::ptrdiff_t>(y) * patch.width + span.begin);
  }
  // What lies off the rim is met by inner cells alone, whose gain is 0 in the end.
  const std::vector<float> zeros(static_cast<std::size_t>(patch.width));
  const auto about = [&](const std::vector<float>& map, int y) {
    return detail::rows_around(map, patch.width, patch.height, y, zeros);
  };
  for (const auto& [y, span] : patch.rim)
    lanes().gain(about(patch.alpha, y), about(guide, y), patch.width, span.begin, span.end,
                 gain.data() + static_cast<std::ptrdiff_t>(y) * patch.width);
}

// Cells with nothing but 0 or nothing but 1 around need no detail.
void Keyer::Impl::mark_inner() {
  const std::size_t n = patch.cells();
  Mask some(patch.width, patch.height);
  Mask full(patch.width, patch.height);
  detail::each_span(patch, [&](std::size_t at, std::size_t count) {
    const float* cells = patch.alpha.data() + at;
    lanes().above(cells, 0, count, some.in.data() + at);
    lanes().above(cells, 0.99999994f, count, full.in.data() + at);  // the float below 1
  });
  some = dilate(some, 1);
  full = erode(full, 1);
  inner.resize(n);
  if (screen->kind == KeyKind::Plate) shaded = dilate(patch.seeds, kShadow);
  detail::each_span(patch, [&](std::size_t at, std::size_t count) {
    lanes().inner(some.in.data() + at, full.in.data() + at, count, inner.data() + at,
                  gain.data() + at);
  });
}

// The two cells that a row of pixels lies between, mixed and doubled along a span of it.
void up_row(const std::vector<float>& plane, int width, int height, Span span, int y, float* out) {
  const int cell = y / 2;
  const int second = std::clamp(y % 2 ? cell + 1 : cell - 1, 0, height - 1);
  lanes().double_row(plane.data() + static_cast<std::ptrdiff_t>(cell) * width + span.begin, 0.75f,
                     plane.data() + static_cast<std::ptrdiff_t>(second) * width + span.begin, 0.25f,
                     span.size(), out + 2 * span.begin);
}

// Shadow covers less than a third of the light; above 0.6 alpha stays, between it is stretched.
std::uint8_t out_of_shade(std::uint8_t alpha) {
  constexpr int kNone = 77;
  constexpr int kAll = 153;
  if (alpha >= kAll) return alpha;
  return static_cast<std::uint8_t>(alpha <= kNone ? 0 : (alpha - kNone) * kAll / (kAll - kNone));
}

void Keyer::Impl::raise_alpha() {
  alpha.assign(stride * static_cast<std::size_t>(height), 0);
  // What the rim leaves out of the spans is opaque.
  for (int y = 0; y < height; ++y)
    if (const Span span = patch.spans[static_cast<std::size_t>(y / 2)]; span.size())
      std::fill_n(alpha.data() + static_cast<std::size_t>(y) * stride + 2 * span.begin,
                  std::min(2 * span.end, width) - 2 * span.begin, std::uint8_t{255});
  std::vector<float> rows(3 * stride);
  // Before a plain plate shadows and the codec's smear look like thin subject: they are taken off.
  const float shade = screen->kind == KeyKind::Plate ? 0.15f : 0.0f;
  for (const auto& [cell_row, span] : patch.rim) {
    const std::uint8_t* kinds = inner.data() + static_cast<std::ptrdiff_t>(cell_row) * patch.width;
    for (int y = 2 * cell_row; y < std::min(2 * cell_row + 2, height); ++y) {
      float* up = rows.data();
      up_row(patch.alpha, patch.width, patch.height, span, y, up);
      up_row(gain, patch.width, patch.height, span, y, up + stride);
      up_row(guide, patch.width, patch.height, span, y, up + 2 * stride);
      up += 2 * span.begin;
      const std::size_t at = static_cast<std::size_t>(y) * stride;
      const std::size_t first = at + 2 * static_cast<std::size_t>(span.begin);
      lanes().raise_alpha({up, up + stride, up + 2 * stride, detail.data() + first, shade,
                           config.clip_low, config.clip_high},
                          2 * span.size(), alpha.data() + first);
      // The neighbours' gain reaches half a cell into what is all opaque or all clear.
      lanes().settle(kinds + span.begin, span.size(), alpha.data() + first);
      if (shade > 0)
        for (int x = span.begin; x < span.end; ++x)
          if (shaded.row(cell_row)[x])
            for (std::uint8_t* a = alpha.data() + at + 2 * x; a < alpha.data() + at + 2 * x + 2;
                 ++a)
              *a = out_of_shade(*a);
      std::fill(alpha.begin() + static_cast<std::ptrdiff_t>(at) + width,
                alpha.begin() + static_cast<std::ptrdiff_t>(at + stride), std::uint8_t{0});
    }
  }
}

void Keyer::Impl::touch_up_alpha() {
  measured.clear();
  const bool clipped = config.clip_black > 0 || config.clip_white < 1;
  if (!clipped && config.edge == 0) return;
  measured = alpha;
  if (clipped) detail::stretch(config.clip_black, config.clip_white, alpha);
  detail::move_edge(config.edge, static_cast<int>(stride), width, height, alpha);
}

// The screen's tint goes back into own colours, those of `count` cells from `at` on.
void Keyer::Impl::keep_tint(std::ptrdiff_t at, std::size_t count, detail::Planes mixed) {
  product.resize(std::max(product.size(), 3 * count));
  float* const tinted[3] = {product.data(), product.data() + count, product.data() + 2 * count};
  const float* c[3];
  const float* b[3];
  const float* m[3];
  for (int p = 0; p < 3; ++p) {
    c[p] = patch.frame[p].data() + at;
    b[p] = patch.plate[p].data() + at;
    m[p] = patch.mean[p].data() + at;
  }
  lanes().own_color(patch.alpha.data() + at, c, b, m, inner.data() + at, false, {}, count, tinted);
  for (int p = 0; p < 3; ++p)
    for (std::size_t i = 0; i < count; ++i)
      mixed[p][i] = config.despill * mixed[p][i] + (1 - config.despill) * tinted[p][i];
}

// F per cell of the rim, encoded and times alpha: what is then mixed between cells.
void Keyer::Impl::measure_own_color() {
  const std::size_t n = patch.cells();
  for (auto& plane : own) plane.resize(n);
  const auto pointers = [](auto& planes) {
    return std::array{planes[0].data(), planes[1].data(), planes[2].data()};
  };
  const auto frame = pointers(patch.frame);
  const auto back = pointers(patch.plate);
  const auto mean = pointers(patch.mean);
  const auto out = pointers(own);
  const detail::KeyShape shape = detail::shape_of(screen->key);
  for (const auto& [y, span] : patch.rim) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(y) * patch.width + span.begin;
    // Whole blocks of lanes, as far as there is room; the next run is made over what is more.
    const auto count =
        static_cast<std::size_t>(std::min((span.size() + 7) / 8 * 8, patch.width - span.begin));
    const float* c[3] = {frame[0] + at, frame[1] + at, frame[2] + at};
    const float* b[3] = {back[0] + at, back[1] + at, back[2] + at};
    const float* m[3] = {mean[0] + at, mean[1] + at, mean[2] + at};
    float* o[3] = {out[0] + at, out[1] + at, out[2] + at};
    const float* weight = patch.alpha.data() + at;
    lanes().own_color(weight, c, b, m, inner.data() + at, screen->key >= 0, shape, count, o);
    if (screen->key >= 0 && config.despill < 1) keep_tint(at, count, o);
    for (float* plane : o) lanes().encode(weight, plane, count);
  }
}

namespace {

// Alphas of a run of cells, two rows of pixels: their sum, that of the right and lower pixels, and
// the sum times the cell's number.
struct RunSums {
  int all = 0, right = 0, low = 0;
  std::int64_t moment = 0;
};

RunSums sum_run(const std::uint8_t* top, const std::uint8_t* low, int begin, int end) {
  RunSums sums;
  int moment = 0;  // below 2^31 for any run: 16,384 cells of 1,020
  for (int x = begin; x < end; ++x) {
    const int left = top[2 * x] + low[2 * x];
    const int right = top[2 * x + 1] + low[2 * x + 1];
    sums.all += left + right;
    sums.right += right;
    sums.low += low[2 * x] + low[2 * x + 1];
    moment += (left + right) * (x - begin);
  }
  sums.moment = moment + std::int64_t{begin} * sums.all;
  return sums;
}

// A part of the matte, in sums of alpha 0..255 over pixels.
struct Part {
  std::int64_t area = 0, weight = 0, x = 0, y = 0;  // x, y: twice the pixel's centre
  int left = 1 << 30, top = 1 << 30, right = -1, bottom = -1;
  int label = 0;
  bool seeded = false, border = false;
};

}  // namespace

// Parts on the grid, near ones joined; those without a seed are noise.
void Keyer::Impl::find_blobs(KeyedFrame& result, std::vector<int>& labels) {
  const int w = patch.width;
  Mask covered(w, patch.height);
  Mask solid(w, patch.height);
  const std::vector<std::uint8_t> nothing(stride);
  const auto top_row = [&](int cy) {
    return alpha.data() + 2 * static_cast<std::size_t>(cy) * stride;
  };
  const auto low_row = [&](int cy) {
    return 2 * cy + 1 < height ? top_row(cy) + stride : nothing.data();
  };
  for (int cy = 0; cy < patch.height; ++cy)
    lanes().cover(top_row(cy), low_row(cy), w, covered.row(cy), solid.row(cy));
  const int count = connected_parts(dilate(covered, 1), labels);
  for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = covered.in[i] ? labels[i] : 0;
  // Calls `with` for every run of one label, of cells that `in` admits.
  const auto each_run = [&](const Mask& in, auto with) {
    for (int cy = 0; cy < patch.height; ++cy) {
      const int* label = labels.data() + static_cast<std::ptrdiff_t>(cy) * w;
      const std::uint8_t* admitted = in.row(cy);
      for (int cx = 0; cx < w;) {
        if (!admitted[cx]) {
          const void* next = std::memchr(admitted + cx, 1, static_cast<std::size_t>(w - cx));
          if (!next) break;
          cx = static_cast<int>(static_cast<const std::uint8_t*>(next) - admitted);
        }
        const int of = label[cx];
        int end = cx + 1;
        while (end < w && admitted[end] && label[end] == of) ++end;
        if (of) with(of, cy, cx, end);
        cx = end;
      }
    }
  };
  std::vector<Part> parts(static_cast<std::size_t>(count) + 1);
  each_run(covered, [&](int label, int cy, int begin, int end) {
    Part& part = parts[static_cast<std::size_t>(label)];
    const std::uint8_t* a = top_row(cy);
    const std::uint8_t* b = low_row(cy);
    const RunSums sums = sum_run(a, b, begin, end);
    part.label = label;
    part.area += sums.all;
    part.seeded = part.seeded || std::memchr(patch.seeds.row(cy) + begin, 1,
                                             static_cast<std::size_t>(end - begin));
    part.left = std::min(part.left, 2 * begin + (a[2 * begin] || b[2 * begin] ? 0 : 1));
    part.right = std::max(part.right, 2 * end - (a[2 * end - 1] || b[2 * end - 1] ? 0 : 1));
    part.top = std::min(part.top, 2 * cy + (sums.all > sums.low ? 0 : 1));
    part.bottom = std::max(part.bottom, 2 * cy + (sums.low ? 2 : 1));
  });
  std::vector<Part> kept;
  for (const Part& part : parts)
    if (part.label && part.seeded) kept.push_back(part);
  std::sort(kept.begin(), kept.end(), [](const Part& a, const Part& b) {
    return a.area != b.area ? a.area > b.area : a.label < b.label;
  });
  if (kept.size() > static_cast<std::size_t>(kMostBlobs)) kept.resize(kMostBlobs);
  std::vector<int> renamed(parts.size());
  for (std::size_t k = 0; k < kept.size(); ++k)
    renamed[static_cast<std::size_t>(kept[k].label)] = static_cast<int>(k) + 1;
  bool as_they_are = true;
  for (std::size_t k = 0; k < renamed.size(); ++k)
    as_they_are = as_they_are && renamed[k] == static_cast<int>(k);
  if (!as_they_are)
    for (int& label : labels) label = renamed[static_cast<std::size_t>(label)];

  // The anchor's mask: solid cells, opened until thin parts are gone, with the soft edge added
  // back; where nothing is left of a part, opened by less.
  std::vector<char> anchored(kept.size() + 1, 0);
  std::size_t missing = kept.size();
  for (int radius = screen->opening; missing > 0; radius /= 2) {
    const Mask opened =
        radius > 0 ? dilate(dilate_disc(erode_disc(solid, radius), radius), 1) : covered;
    std::vector<char> now(kept.size() + 1, 0);
    each_run(opened, [&](int label, int cy, int begin, int end) {
      const auto k = static_cast<std::size_t>(label);
      if (anchored[k]) return;
      now[k] = 1;
      Part& part = kept[k - 1];
      const RunSums sums = sum_run(top_row(cy), low_row(cy), begin, end);
      part.weight += sums.all;
      part.x += 4 * sums.moment + sums.all + 2 * sums.right;
      part.y += std::int64_t{sums.all} * (4 * cy + 1) + 2 * sums.low;
    });
    for (std::size_t k = 1; k < now.size(); ++k)
      if (now[k]) {
        anchored[k] = 1;
        --missing;
      }
    if (radius == 0) break;
  }
  // What is of no part is not there.
  for (int cy = 0; cy < patch.height && !as_they_are; ++cy) {
    const int* label = labels.data() + static_cast<std::ptrdiff_t>(cy) * w;
    for (int cx = 0; cx < w; ++cx)
      if (!label[cx] && covered.row(cy)[cx])
        for (int y = 2 * cy; y < std::min(2 * cy + 2, height); ++y)
          std::fill_n(alpha.data() + static_cast<std::size_t>(y) * stride + 2 * cx, 2,
                      std::uint8_t{0});
  }
  // Contact with the film's border: more than a fifth covered there.
  const auto look_at = [&](int x, int y) {
    const std::size_t c = static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(w) +
                          static_cast<std::size_t>(x / 2);
    if (labels[c] && alpha[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)] > 51)
      kept[static_cast<std::size_t>(labels[c]) - 1].border = true;
  };
  for (int x = 0; x < width; ++x) {
    if (top == 0) look_at(x, 0);
    if (top + height == screen->height) look_at(x, height - 1);
  }
  for (int y = 0; y < height; ++y) {
    if (left == 0) look_at(0, y);
    if (left + width == screen->width) look_at(width - 1, y);
  }
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Part& part = kept[k];
    if (part.right < 0 || part.weight <= 0) continue;
    Blob blob;
    blob.box = {left + part.left, top + part.top, part.right - part.left, part.bottom - part.top};
    blob.area = static_cast<double>(part.area) / 255;
    blob.anchor_x = left + 0.5 * static_cast<double>(part.x) / static_cast<double>(part.weight);
    blob.anchor_y = top + 0.5 * static_cast<double>(part.y) / static_cast<double>(part.weight);
    blob.touches_border = part.border;
    blob.label = static_cast<int>(k) + 1;
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
  result.straight.rgba.reserve(4 * n);
  result.labels.reserve(n);

  const RgbOfYcc matrix = rgb_of_ycc(frame.coding);
  std::vector<float> rows(4 * stride);
  std::vector<std::uint8_t> painted(4 * stride);
  std::vector<std::uint8_t> names(stride);
  const std::vector<std::uint8_t>& coverage = measured.empty() ? alpha : measured;
  const int crop_left = crop.x - left;
  const int crop_right = crop_left + crop.width;
  for (int y = crop.y - top; y < crop.y - top + crop.height; ++y) {
    const int cy = y / 2;
    // Deep inside the picture is taken as it is: green clothes stay green.
    const std::uint8_t* inside = patch.deep.row(cy);
    const int* label = labels.data() + static_cast<std::ptrdiff_t>(cy) * patch.width;
    // Cells from the first to the last that is covered; runs of deep ones are copied.
    const Span within =
        measured.empty() ? patch.spans[static_cast<std::size_t>(cy)] : Span{0, patch.width};
    int first = within.begin;
    int last = within.end;
    while (first < last && !label[first]) ++first;
    while (last > first && !label[last - 1]) --last;
    const std::size_t at = static_cast<std::size_t>(y) * stride;
    const std::size_t film =
        static_cast<std::size_t>(top + y) * static_cast<std::size_t>(frame.width) +
        static_cast<std::size_t>(left);
    const std::size_t color =
        static_cast<std::size_t>(patch.top + cy) * static_cast<std::size_t>(frame.cell_width()) +
        static_cast<std::size_t>(patch.left);
    for (int begin = first; begin < last;) {
      const bool as_filmed = inside[begin] != 0;
      const void* other =
          std::memchr(inside + begin, as_filmed ? 0 : 1, static_cast<std::size_t>(last - begin));
      const int end =
          other ? static_cast<int>(static_cast<const std::uint8_t*>(other) - inside) : last;
      const int from = 2 * begin;
      // Whole blocks of lanes, as far as there is room; the next run is painted over what is more.
      const int pixels = std::min((2 * (end - begin) + 31) / 32 * 32, width - from);
      std::uint8_t* out = painted.data() + 4 * from;
      if (as_filmed) {
        lanes().paint_filmed(matrix, frame.y.data() + film + from, frame.cb.data() + color + begin,
                             frame.cr.data() + color + begin, pixels, out);
      } else {
        float* up = rows.data();
        const Span span{std::max(begin - 1, 0), std::min(end + 1, patch.width)};
        up_row(patch.alpha, patch.width, patch.height, span, y, up);
        for (int p = 0; p < 3; ++p)
          up_row(own[p], patch.width, patch.height, span, y,
                 up + static_cast<std::size_t>(p + 1) * stride);
        up += from;
        lanes().paint_own({coverage.data() + at + from,
                           up,
                           {up + stride, up + 2 * stride, up + 3 * stride},
                           detail.data() + at + from,
                           plate.data() + at + from,
                           weights.red,
                           weights.green,
                           weights.blue},
                          pixels, out);
      }
      begin = end;
    }
    lanes().name_pixels(alpha.data() + at + 2 * first, label + first, last - first,
                        names.data() + 2 * first);
    const int low = std::clamp(2 * first, crop_left, crop_right);
    const int high = std::clamp(std::min(2 * last, width), low, crop_right);
    const auto append = [&](std::vector<std::uint8_t>& to, const std::uint8_t* from, int bytes) {
      to.insert(to.end(), static_cast<std::size_t>(bytes * (low - crop_left)), 0);
      to.insert(to.end(), from + bytes * low, from + bytes * high);
      to.insert(to.end(), static_cast<std::size_t>(bytes * (crop_right - high)), 0);
    };
    append(result.straight.rgba, painted.data(), 4);
    append(result.labels, names.data(), 1);
  }
}

// The alpha that was asked for; what it grew over takes the colour beside it.
void Keyer::Impl::touch_up_color(KeyedFrame& result) const {
  if (!measured.empty()) {
    const Rect& crop = result.crop;
    std::vector<std::uint8_t> grown(result.labels.size());
    for (int y = 0; y < crop.height; ++y)
      for (int x = 0; x < crop.width; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(crop.width) +
                              static_cast<std::size_t>(x);
        const std::size_t at = static_cast<std::size_t>(crop.y - top + y) * stride +
                               static_cast<std::size_t>(crop.x - left + x);
        result.straight.rgba[4 * i + 3] = alpha[at];
        grown[i] = alpha[at] && !measured[at] ? 1 : 0;
      }
    detail::spread_color(grown, result.straight);
  }
  if (screen->key >= 0 && config.despill > 1)
    detail::take_tint_out(detail::shape_of(screen->key), config.despill - 1, result.straight);
}

// Key `none`: everything is subject, and the frame's border is not its edge.
void Keyer::Impl::whole_frame(const Frame& frame, KeyedFrame& result) const {
  const std::size_t n = frame.y.size();
  result.crop = {0, 0, frame.width, frame.height};
  result.straight =
      frame.rgba.empty() ? to_image(frame) : Image{frame.width, frame.height, frame.rgba};
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
    sum += lanes().difference(a.y.data() + at, b.y.data() + at, box.width);
  }
  return static_cast<double>(sum) / (1.0 * box.width * box.height);
}

}  // namespace

Keyer::Keyer(const ScreenModel& screen, const MatteConfig& config)
    : impl_(std::make_unique<Impl>()) {
  impl_->screen = &screen;
  impl_->config = config;
  impl_->prepare();
}

Keyer::~Keyer() = default;

KeyedFrame Keyer::key(const Frame& frame, const Frame* before) {
  KeyedFrame result;
  result.index = frame.index;
  Impl& k = *impl_;
  if (k.screen->kind == KeyKind::None) {
    k.whole_frame(frame, result);
  } else if (k.screen->kind == KeyKind::Alpha) {
    if (!frame.rgba.empty()) detail::take_coverage(frame, k.screen->opening, result);
  } else {
    detail::find_silhouette(*k.screen, frame, k.silhouette);
    if (k.silhouette.empty) return result;
    detail::cut_patch(*k.screen, k.silhouette, k.patch);
    detail::unmix(*k.screen, k.patch);
    if (k.config.shadow) detail::leave_to_shadow(k.patch);
    k.place(frame);
    k.measure_detail(frame);
    k.measure_guide();
    k.mark_inner();
    k.raise_alpha();
    k.touch_up_alpha();
    k.measure_own_color();
    std::vector<int> labels;
    k.find_blobs(result, labels);
    k.paint(frame, labels, result);
    k.touch_up_color(result);
    if (k.config.shadow) detail::measure_shadow(*k.screen, frame, result);
  }
  if (before && !result.blobs.empty())
    result.difference = mean_difference(frame, *before, result.blobs[0].box);
  return result;
}

}  // namespace vsprite
