// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/features.h - how two samples differ: the six features of NIPS section 2.
//
// Pictures are compared aligned at their anchors, on a common grid. Every feature is symmetric and 0
// for a pair (i, i). No libm transcendental: the same bits on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "film/extract.h"
#include "vsprite/image.h"

namespace vsprite {

inline constexpr int kFeatureCount = 6;
inline constexpr const char* kFeatureNames[kFeatureCount] = {"speed", "angle", "color",
                                                             "alpha", "mean_color", "area"};
/// speed px/s; angle rad, faded out at low speed; color, alpha: sums over the aligned grid; mean
/// color: code values; area px^2. Units exact in the .cpp.
using FeatureVector = std::array<float, kFeatureCount>;

/// The angle of (x, y), radians in (-pi, pi], clockwise from +x; error below 1e-6; polynomial, no libm.
double angle_of(double x, double y) noexcept;
/// The angle between two vectors, [0, pi]; 0 if either is null.
double angle_between(double ax, double ay, double bx, double by) noexcept;

/// One sample as the features see it.
struct FeatureSample {
  float velocity_x = 0, velocity_y = 0;  ///< film px/s
  float speed = 0;
  float area = 0;                        ///< film px^2
  float mean_color[3] = {};              ///< alpha-weighted, 0..255
  std::vector<std::uint8_t> rgba;        ///< (grid, grid) straight, anchor at the centre
};

/// All samples on one grid; what every later stage of the film sees of the pictures.
struct FeatureSet {
  int grid = 64;               ///< cells a side
  double cell = 1;             ///< film pixels per cell, from the largest sprite
  double v0 = 0;               ///< px/s: below this speed the angle fades (0.35 x median moving speed)
  double fps = 30;
  std::vector<SampleRow> rows;
  std::vector<FeatureSample> samples;  ///< (N), same numbering
};

/// `pictures(i)` hands out the straight-alpha picture of sample i, in ascending order, once each.
FeatureSet make_feature_set(std::vector<SampleRow> rows, double fps, int grid,
                            const std::function<Image(int)>& pictures);

/// The six features of a pair. Cost O(grid^2).
FeatureVector features(const FeatureSet& set, int i, int j) noexcept;

}  // namespace vsprite
