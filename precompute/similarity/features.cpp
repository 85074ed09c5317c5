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

#include "similarity/kernels.h"

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

void fill_mean_color(FeatureSample& sample, const Image& image) {
  struct {
    std::uint64_t alpha = 0, color[3] = {};
  } sum;
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

FeatureSample make_sample(const SampleRow& row, const Image& image, double cell, int grid) {
  FeatureSample sample;
  sample.velocity_x = static_cast<float>(row.velocity_x);
  sample.velocity_y = static_cast<float>(row.velocity_y);
  sample.speed = static_cast<float>(
      std::sqrt(row.velocity_x * row.velocity_x + row.velocity_y * row.velocity_y));
  sample.heading = static_cast<float>(angle_of(row.velocity_x, row.velocity_y));
  sample.area = static_cast<float>(row.area);
  sample.cells = make_cells(row, image, cell, grid);
  fill_mean_color(sample, image);
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
  assert(grid >= 16 && grid <= kMaxGrid && grid % 8 == 0);
  FeatureSet set;
  set.grid = grid;
  set.fps = fps;
  set.cell = cell_size(rows, grid);
  set.rows = std::move(rows);
  set.samples.reserve(set.rows.size());
  for (std::size_t i = 0; i < set.rows.size(); ++i) {
    set.samples.push_back(make_sample(set.rows[i], pictures(static_cast<int>(i)), set.cell, grid));
  }
  std::vector<const CellImage*> images;
  for (const FeatureSample& sample : set.samples) images.push_back(&sample.cells);
  set.block_order = telling_order(images, grid);
  for (FeatureSample& sample : set.samples) reorder(sample.cells, set.block_order);
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
  if (set.scale == FeatureScale::PerArea) {
    const double area = (static_cast<double>(a.area) + static_cast<double>(b.area)) / 2;
    const bool any = area > 0;
    f[kSpeed] = any ? static_cast<float>(static_cast<double>(f[kSpeed]) / std::sqrt(area)) : 0;
    f[kArea] = any ? static_cast<float>(static_cast<double>(f[kArea]) / area) : 0;
  }
  return f;
}

FeatureVector features(const FeatureSet& set, int i, int j) noexcept {
  const CellImage& a = set.samples[static_cast<std::size_t>(i)].cells;
  const CellImage& b = set.samples[static_cast<std::size_t>(j)].cells;
  const detail::PairSums sums = detail::compare_cells(a, b);
  FeatureVector f = cheap_features(set, i, j);
  detail::set_pixel_features(set, i, j, sums.color, a.coverage + b.coverage - 2 * sums.overlap, f);
  return f;
}

void detail::set_pixel_features(const FeatureSet& set, int i, int j, std::uint64_t color,
                                std::uint32_t alpha, FeatureVector& f) noexcept {
  double unit = 255;
  if (set.scale == FeatureScale::PerArea) {
    const auto coverage = set.samples[static_cast<std::size_t>(i)].cells.coverage +
                          set.samples[static_cast<std::size_t>(j)].cells.coverage;
    unit = coverage > 0 ? static_cast<double>(coverage) / 2 : 1;
  }
  f[kColor] = static_cast<float>(kColorStep * std::sqrt(static_cast<double>(color) / unit));
  f[kAlpha] = static_cast<float>(static_cast<double>(alpha) / unit);
}

}  // namespace vsprite
