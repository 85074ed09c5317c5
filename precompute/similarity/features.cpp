// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The six features of NIPS section 2. Departures: the angle fades out at low speed, where it means
// nothing, and the colour term is the root of the weighted sum of squares (the L2 distance of two
// pictures), so that every feature grows linearly with the difference that a person sees.
#include "similarity/features.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

// Integer kernels are built for wider registers too and chosen at start: the same sums, sooner.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define VSPRITE_WIDE_KERNEL __attribute__((target_clones("arch=skylake-avx512", "avx2", "default")))
#else
#define VSPRITE_WIDE_KERNEL
#endif

namespace vsprite {
namespace {

constexpr double kMovingShare = 0.25;  // of the 95th percentile of speed
constexpr double kMovingSize = 0.25;   // of the subject's size, a second
constexpr double kFadeShare = 0.35;    // v0 over the median moving speed

// atan on [0, 1]: folded at tan(pi/8) to |t| <= 0.4142, where the series to t^19 errs by 4e-10.
double atan_unit(double t) noexcept {
  constexpr double kFold = 0.41421356237309503;
  const bool folded = t > kFold;
  if (folded) t = (t - 1) / (t + 1);
  const double s = t * t;
  double sum = 0;
  for (int k = 19; k >= 1; k -= 2) sum = sum * s * -1 + 1.0 / k;
  return (folded ? kPi / 4 : 0) + t * sum;
}

double heading_difference(double a, double b) noexcept {
  const double d = std::fabs(a - b);
  return d > kPi ? 2 * kPi - d : d;
}

// The k-th smallest value; `values` is reordered. Pre: not empty.
double quantile(std::vector<double>& values, double share) {
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

void set_speeds(FeatureSet& set) {
  std::vector<double> speeds, areas;
  for (const FeatureSample& s : set.samples) {
    speeds.push_back(static_cast<double>(s.speed));
    areas.push_back(static_cast<double>(s.area));
  }
  const SpeedScale scale = measure_speeds(std::move(speeds), std::move(areas));
  set.moving_speed = scale.moving;
  set.v0 = kFadeShare * (scale.usual > 0 ? scale.usual : scale.moving);
}

// Side of a cell: the grid, centred at the anchor, holds the largest sprite.
double cell_size(const std::vector<SampleRow>& rows, int grid) {
  double reach = 1;
  for (const SampleRow& r : rows) {
    reach = std::max({reach, r.anchor_x - r.left, r.left + r.width - r.anchor_x, r.anchor_y - r.top,
                      r.top + r.height - r.anchor_y});
  }
  return 2 * reach / grid;
}

// How much of each pixel lies in each cell along one axis, in 1/256 pixel.
struct Overlap {
  int first = 0;
  std::vector<int> weights;
};
std::vector<Overlap> axis_overlaps(double anchor, double cell, int grid, int size) {
  std::vector<int> edges;  // of the cells, 1/256 px of the image
  for (int g = 0; g <= grid; ++g) {
    const double edge = (anchor + (g - grid / 2) * cell) * 256;
    edges.push_back(static_cast<int>(std::floor(std::clamp(edge, -1e8, 1e8) + 0.5)));
  }
  std::vector<Overlap> cells(static_cast<std::size_t>(grid));
  for (std::size_t g = 0; g < cells.size(); ++g) {
    const int begin = std::max(edges[g], 0), end = std::min(edges[g + 1], 256 * size);
    cells[g].first = begin / 256;
    for (int p = begin / 256; 256 * p < end; ++p) {
      cells[g].weights.push_back(std::min(end, 256 * (p + 1)) - std::max(begin, 256 * p));
    }
  }
  return cells;
}

// One cell: coverage and colour, colour weighted by coverage.
struct CellSum {
  std::uint64_t alpha = 0, color[3] = {};
};
CellSum sum_cell(const Image& image, const Overlap& x, const Overlap& y) {
  CellSum sum;
  for (std::size_t r = 0; r < y.weights.size(); ++r) {
    const std::size_t row = static_cast<std::size_t>(y.first) + r;
    const std::size_t start =
        4 * (row * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x.first));
    for (std::size_t c = 0; c < x.weights.size(); ++c) {
      const std::uint8_t* p = image.rgba.data() + start + 4 * c;
      const auto weight = static_cast<std::uint64_t>(y.weights[r] * x.weights[c]) * p[3];
      sum.alpha += weight;
      for (int k = 0; k < 3; ++k) sum.color[k] += weight * p[k];
    }
  }
  return sum;
}

void fill_planes(FeatureSample& sample, const SampleRow& row, const Image& image, double cell,
                 int grid) {
  const double scale = row.scale > 0 ? row.scale : 1;
  const auto xs = axis_overlaps((row.anchor_x - row.left) * scale, cell * scale, grid, image.width);
  const auto ys = axis_overlaps((row.anchor_y - row.top) * scale, cell * scale, grid, image.height);
  const auto full = static_cast<std::uint64_t>(
      std::max(std::floor(cell * scale * cell * scale * 65536 + 0.5), 1.0));
  const auto side = static_cast<std::size_t>(grid), plane = side * side;
  sample.planes.assign(4 * plane, 0);
  for (std::size_t y = 0; y < side; ++y) {
    for (std::size_t x = 0; x < side; ++x) {
      const CellSum sum = sum_cell(image, xs[x], ys[y]);
      const std::uint64_t alpha = std::min<std::uint64_t>((sum.alpha + full / 2) / full, 255);
      if (alpha == 0) continue;
      const std::size_t at = y * side + x;
      sample.planes[at] = static_cast<std::uint8_t>(alpha);
      for (std::size_t k = 0; k < 3; ++k) {
        sample.planes[(k + 1) * plane + at] =
            static_cast<std::uint8_t>((sum.color[k] + sum.alpha / 2) / sum.alpha);
      }
    }
  }
}

void fill_mean_color(FeatureSample& sample, const Image& image) {
  CellSum sum;
  for (std::size_t p = 0; p + 3 < image.rgba.size(); p += 4) {
    const std::uint64_t alpha = image.rgba[p + 3];
    sum.alpha += alpha;
    for (std::size_t k = 0; k < 3; ++k) sum.color[k] += alpha * image.rgba[p + k];
  }
  for (int k = 0; k < 3 && sum.alpha > 0; ++k) {
    sample.mean_color[k] =
        static_cast<float>(static_cast<double>(sum.color[k]) / static_cast<double>(sum.alpha));
  }
}

void fill_blocks(FeatureSample& sample, int grid) {
  const auto side = static_cast<std::size_t>(grid), blocks = side / kBlock;
  sample.block_alpha.assign(blocks * blocks, 0);
  for (std::size_t y = 0; y < side; ++y) {
    for (std::size_t x = 0; x < side; ++x) {
      std::uint16_t& block = sample.block_alpha[y / kBlock * blocks + x / kBlock];
      block = static_cast<std::uint16_t>(block + sample.planes[y * side + x]);
    }
  }
}

FeatureSample make_sample(const SampleRow& row, const Image& image, double cell, int grid) {
  FeatureSample sample;
  sample.velocity_x = static_cast<float>(row.velocity_x);
  sample.velocity_y = static_cast<float>(row.velocity_y);
  sample.speed = static_cast<float>(
      std::sqrt(row.velocity_x * row.velocity_x + row.velocity_y * row.velocity_y));
  sample.heading = static_cast<float>(angle_of(row.velocity_x, row.velocity_y));
  sample.area = static_cast<float>(row.area);
  fill_planes(sample, row, image, cell, grid);
  fill_mean_color(sample, image);
  fill_blocks(sample, grid);
  return sample;
}

}  // namespace

double angle_of(double x, double y) noexcept {
  const double ax = std::fabs(x), ay = std::fabs(y);
  if (ax == 0 && ay == 0) return 0;
  double angle = ay <= ax ? atan_unit(ay / ax) : kPi / 2 - atan_unit(ax / ay);
  if (x < 0) angle = kPi - angle;
  return y < 0 ? -angle : angle;
}

double angle_between(double ax, double ay, double bx, double by) noexcept {
  if ((ax == 0 && ay == 0) || (bx == 0 && by == 0)) return 0;
  return heading_difference(angle_of(ax, ay), angle_of(bx, by));
}

SpeedScale measure_speeds(std::vector<double> speeds, std::vector<double> areas) {
  SpeedScale scale;
  if (speeds.empty()) return scale;
  const double floor = std::max(kMovingSize * std::sqrt(quantile(areas, 0.5)), 1e-3);
  scale.moving = std::max(kMovingShare * quantile(speeds, 0.95), floor);
  std::erase_if(speeds, [&](double s) { return s <= scale.moving; });
  if (!speeds.empty()) scale.usual = quantile(speeds, 0.5);
  return scale;
}

FeatureSet make_feature_set(std::vector<SampleRow> rows, double fps, int grid,
                            const std::function<Image(int)>& pictures) {
  assert(grid >= 16 && grid <= 64 && grid % kBlock == 0);
  FeatureSet set;
  set.grid = grid;
  set.fps = fps;
  set.cell = cell_size(rows, grid);
  set.rows = std::move(rows);
  set.samples.reserve(set.rows.size());
  for (std::size_t i = 0; i < set.rows.size(); ++i) {
    set.samples.push_back(make_sample(set.rows[i], pictures(static_cast<int>(i)), set.cell, grid));
  }
  set_speeds(set);
  return set;
}

bool follows(const FeatureSet& set, int i, int next) noexcept {
  return next == i + 1 && i >= 0 && static_cast<std::size_t>(next) < set.rows.size() &&
         set.rows[static_cast<std::size_t>(i)].clip ==
             set.rows[static_cast<std::size_t>(next)].clip;
}

FeatureVector cheap_features(const FeatureSet& set, int i, int j) noexcept {
  const FeatureSample& a = set.samples[static_cast<std::size_t>(i)];
  const FeatureSample& b = set.samples[static_cast<std::size_t>(j)];
  const double slower = static_cast<double>(std::min(a.speed, b.speed));
  const double fade = std::min(1.0, slower / set.v0);
  double color = 0;
  for (int k = 0; k < 3; ++k) {
    const double d = static_cast<double>(a.mean_color[k]) - static_cast<double>(b.mean_color[k]);
    color += d * d;
  }
  FeatureVector f{};
  f[kSpeed] = std::fabs(a.speed - b.speed);
  f[kAngle] = static_cast<float>(
      fade * heading_difference(static_cast<double>(a.heading), static_cast<double>(b.heading)));
  f[kMeanColor] = static_cast<float>(std::sqrt(color));
  f[kArea] = std::fabs(a.area - b.area);
  return f;
}

FeatureVector features(const FeatureSet& set, int i, int j) noexcept {
  const std::uint8_t* a = set.samples[static_cast<std::size_t>(i)].planes.data();
  const std::uint8_t* b = set.samples[static_cast<std::size_t>(j)].planes.data();
  const int plane = set.grid * set.grid;
  FeatureVector f = cheap_features(set, i, j);
  f[kColor] = detail::color_feature(detail::color_difference(a, b, plane, 0, set.grid, set.grid));
  f[kAlpha] = detail::alpha_feature(detail::alpha_difference(a, b, plane));
  return f;
}

namespace detail {

VSPRITE_WIDE_KERNEL
std::uint32_t alpha_difference(const std::uint8_t* a, const std::uint8_t* b, int count) noexcept {
  std::uint32_t sum = 0;
  for (int p = 0; p < count; ++p) sum += static_cast<std::uint32_t>(std::abs(a[p] - b[p]));
  return sum;
}

// A cell adds at most 255 * 3 * 255^2 < 2^26, so 64 cells fit 32 bits.
VSPRITE_WIDE_KERNEL
std::uint64_t color_difference(const std::uint8_t* a, const std::uint8_t* b, int plane, int first,
                               int width, int rows) noexcept {
  std::uint64_t total = 0;
  for (int y = 0; y < rows; ++y) {
    const std::uint8_t* pa = a + first + y * width;
    const std::uint8_t* pb = b + first + y * width;
    std::uint32_t sum = 0;
    for (int x = 0; x < width; ++x) {
      const int r = pa[x + plane] - pb[x + plane];
      const int g = pa[x + 2 * plane] - pb[x + 2 * plane];
      const int u = pa[x + 3 * plane] - pb[x + 3 * plane];
      const int weight = std::min(pa[x], pb[x]);
      sum += static_cast<std::uint32_t>(weight * (r * r + g * g + u * u));
    }
    total += sum;
  }
  return total;
}

float alpha_feature(std::uint32_t sum) noexcept {
  return static_cast<float>(static_cast<double>(sum) / 255.0);
}

float color_feature(std::uint64_t sum) noexcept {
  return static_cast<float>(std::sqrt(static_cast<double>(sum) / 255.0));
}

}  // namespace detail
}  // namespace vsprite
