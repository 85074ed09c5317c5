// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/match.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "film/light.h"
#include "film/subject.h"

namespace vsprite {
namespace {

double linear_of_code(std::size_t code) {
  return static_cast<double>(detail::linear_of_sums()[4 * code]);
}

/// Which pixels of a line one pixel of the result sees, and how much of each; the weights' sum
/// is 1.
struct Tap {
  int first = 0;
  std::vector<float> weights;
};

std::vector<Tap> taps_of(double ratio, int size, int source) {
  const double reach = std::max(ratio, 1.0);
  std::vector<Tap> taps(static_cast<std::size_t>(size));
  for (int k = 0; k < size; ++k) {
    const double centre = (k + 0.5) * ratio - 0.5;  // in source pixels, their centres at 0, 1, ...
    Tap& tap = taps[static_cast<std::size_t>(k)];
    tap.first = static_cast<int>(std::floor(centre - reach)) + 1;
    double sum = 0;
    std::vector<double> weights;
    for (int p = tap.first; p < centre + reach; ++p)
      sum += weights.emplace_back(std::max(0.0, reach - std::fabs(p - centre)));
    // Beyond the border nothing is seen, but it counts: the picture ends there.
    for (int p = tap.first; p < tap.first + static_cast<int>(weights.size()); ++p) {
      const double weight = weights[static_cast<std::size_t>(p - tap.first)] / sum;
      tap.weights.push_back(p >= 0 && p < source ? static_cast<float>(weight) : 0.0f);
    }
  }
  return taps;
}

/// Coverage and premultiplied linear light, 0..1.
using Light = std::array<float, 4>;

Light light_of(const std::uint8_t* pixel, const double (&gain)[3]) {
  const float alpha = static_cast<float>(pixel[3]) / 255;
  Light light{0, 0, 0, alpha};
  for (std::size_t c = 0; c < 3; ++c)
    light[c] = alpha * static_cast<float>(linear_of_code(pixel[c]) * gain[c]);
  return light;
}

void put(const Light& light, std::uint8_t* pixel) {
  const auto alpha = static_cast<int>(light[3] * 255 + 0.5f);
  if (alpha == 0) return;
  pixel[3] = static_cast<std::uint8_t>(std::min(alpha, 255));
  for (std::size_t c = 0; c < 3; ++c) pixel[c] = detail::encoded_of(light[c] / light[3]);
}

}  // namespace

void MeanColor::add(const Image& picture) {
  for (std::size_t p = 0; p + 3 < picture.rgba.size(); p += 4)
    for (std::size_t c = 0; c < 3; ++c)
      counts_[256 * c + picture.rgba[p + c]] += picture.rgba[p + 3];
}

void MeanColor::add(const MeanColor& other) {
  for (std::size_t k = 0; k < counts_.size(); ++k) counts_[k] += other.counts_[k];
}

double MeanColor::mean(int channel) const {
  double sum = 0, count = 0;
  for (std::size_t code = 0; code < 256; ++code) {
    const auto seen = static_cast<double>(counts_[256 * static_cast<std::size_t>(channel) + code]);
    sum += seen * linear_of_code(code);
    count += seen;
  }
  return count > 0 ? sum / count : 0;
}

double median_area(std::span<const SampleRow> rows) {
  std::vector<double> areas;
  for (const SampleRow& row : rows) areas.push_back(row.area);
  return areas.empty() ? 0 : detail::median(areas);
}

Matching match_clip(double area, const MeanColor& color, double reference_area,
                    const MeanColor& reference_color) {
  Matching matching;
  const auto rounded = [](double value) { return std::floor(value * 1000 + 0.5) / 1000; };
  const auto same = [](double ratio, double most) { return ratio < most && ratio > 1 / most; };
  if (area > 0 && reference_area > 0) {
    const double scale = std::sqrt(reference_area / area);
    if (!same(scale, kSameScale)) matching.scale = std::max(rounded(scale), 0.001);
  }
  for (int c = 0; c < 3; ++c) {
    const double mean = color.mean(c), due = reference_color.mean(c);
    if (!(mean > 0) || !(due > 0) || same(due / mean, kSameGain)) continue;
    matching.gain[c] = rounded(std::clamp(due / mean, 1 / kLargestGain, kLargestGain));
  }
  return matching;
}

std::vector<SampleRow> retimed(std::span<const SampleRow> rows, Rate from, Rate to) {
  // Frames of `to` in one of `from`, as a fraction; rounded to the nearest, halves up.
  const std::int64_t up = std::int64_t{to.numerator} * from.denominator;
  const std::int64_t down = std::int64_t{to.denominator} * from.numerator;
  const auto tick = [&](std::int64_t frame) { return (2 * frame * up + down) / (2 * down); };
  std::vector<SampleRow> kept;
  std::int64_t time = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i == 0 || rows[i].clip != rows[i - 1].clip) time = 0;
    const std::int64_t begin = tick(time);
    time += rows[i].duration;
    const bool last = i + 1 == rows.size() || rows[i + 1].clip != rows[i].clip;
    const std::int64_t shown = tick(time) - begin;
    if (shown == 0 && !(last && time == rows[i].duration)) continue;
    kept.push_back(rows[i]);
    kept.back().duration = static_cast<int>(std::clamp<std::int64_t>(shown, 1, 65535));
  }
  return kept;
}

Image redrawn(const Image& picture, double ratio, int width, int height, const double (&gain)[3]) {
  Image out{width, height, {}};
  const auto columns = static_cast<std::size_t>(width);
  const auto across = static_cast<std::size_t>(picture.width);
  out.rgba.assign(4 * columns * static_cast<std::size_t>(height), 0);
  const std::vector<Tap> xs = taps_of(ratio, width, picture.width);
  const std::vector<Tap> ys = taps_of(ratio, height, picture.height);
  std::vector<Light> line(across);
  for (std::size_t v = 0; v < ys.size(); ++v) {
    std::fill(line.begin(), line.end(), Light{});
    for (std::size_t k = 0; k < ys[v].weights.size(); ++k) {
      const float weight = ys[v].weights[k];
      if (weight == 0) continue;
      const auto row = static_cast<std::size_t>(ys[v].first) + k;
      for (std::size_t x = 0; x < across; ++x) {
        const Light light = light_of(picture.rgba.data() + 4 * (row * across + x), gain);
        for (std::size_t c = 0; c < 4; ++c) line[x][c] += weight * light[c];
      }
    }
    for (std::size_t u = 0; u < columns; ++u) {
      Light sum{};
      for (std::size_t k = 0; k < xs[u].weights.size(); ++k) {
        const float weight = xs[u].weights[k];
        if (weight == 0) continue;
        const Light& light = line[static_cast<std::size_t>(xs[u].first) + k];
        for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * light[c];
      }
      put(sum, out.rgba.data() + 4 * (v * columns + u));
    }
  }
  return out;
}

}  // namespace vsprite
