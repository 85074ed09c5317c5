// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/features.h - how two samples differ: the six features of NIPS section 2.
//
// Pictures are compared aligned at their anchors, on a common grid. With speed s, heading h, mean
// colour m, area A, and a cell's coverage a (0..255) and colour c (sRGB code values):
//
//     speed       |s_i - s_j|                                                       px/s
//     angle       |h_i - h_j| min(1, min(s_i, s_j) / v0)                            rad, [0, pi]
//     color       sqrt( sum over cells of min(a_i, a_j) / 255 |c_i - c_j|^2 )       code values
//     alpha       sum over cells of |a_i - a_j| / 255                               cells
//     mean_color  |m_i - m_j|                                                       code values
//     area        |A_i - A_j|                                                       px^2
//
// Every feature is symmetric, >= 0, and 0 for a pair (i, i). Sums over pixels are integers and the
// rest is correctly rounded arithmetic: the same bits on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "film/extract.h"
#include "vsprite/image.h"

namespace vsprite {

inline constexpr int kFeatureCount = 6;
inline constexpr const char* kFeatureNames[kFeatureCount] = {"speed", "angle",      "color",
                                                             "alpha", "mean_color", "area"};
enum Feature { kSpeed, kAngle, kColor, kAlpha, kMeanColor, kArea };

/// The six features of a pair, in the order of kFeatureNames.
using FeatureVector = std::array<float, kFeatureCount>;

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr int kDefaultGrid =
    48;                           ///< cells a side; finer finds no other jumps and costs time
inline constexpr int kBlock = 8;  ///< cells a side of a block of the coarse coverage image

/// The angle of (x, y), radians in (-pi, pi], clockwise from +x; error below 1e-8; polynomial, no
/// libm. 0 for (0, 0).
double angle_of(double x, double y) noexcept;
/// The angle between two vectors, [0, pi]; 0 if either is null.
double angle_between(double ax, double ay, double bx, double by) noexcept;

/// One sample as the features see it.
struct FeatureSample {
  float velocity_x = 0, velocity_y = 0;  ///< film px/s
  float speed = 0;                       ///< film px/s
  float heading = 0;                     ///< angle_of the velocity
  float area = 0;                        ///< film px^2
  float mean_color[3] = {};              ///< alpha-weighted, 0..255
  std::vector<std::uint8_t> planes;      ///< (4, grid, grid) coverage, red, green, blue (straight);
                                         ///< the anchor at the centre
  std::vector<std::uint16_t> block_alpha;  ///< (grid / kBlock)^2 sums of coverage
};

/// All samples on one grid; what every later stage of the film sees of the pictures.
struct FeatureSet {
  int grid = kDefaultGrid;  ///< cells a side
  double cell = 1;          ///< film pixels per cell, from the largest sprite
  double moving_speed = 1;  ///< px/s, > 0: a sample faster than this moves
  double v0 = 1;            ///< px/s, > 0: below this speed the angle fades
  double fps = 30;
  std::vector<SampleRow> rows;
  std::vector<FeatureSample> samples;  ///< (N), same numbering
};

/// What counts as moving, and how fast the subject usually moves, px/s.
struct SpeedScale {
  double moving = 1;  ///< a quarter of the 95th percentile of speed, but at least a quarter of the
                      ///< subject's size (root of the median area) a second; > 0
  double usual = 0;   ///< median speed of what is faster than that; 0 if nothing is
};
SpeedScale measure_speeds(std::vector<double> speeds, std::vector<double> areas);

/// v0 = 0.35 x the usual speed; where nothing moves, 0.35 x the speed that would count as moving.
/// `pictures(i)` hands out the straight-alpha picture of sample i, in ascending order, once each.
/// `grid`: a multiple of kBlock, 16..64.
FeatureSet make_feature_set(std::vector<SampleRow> rows, double fps, int grid,
                            const std::function<Image(int)>& pictures);

/// True if both samples belong to one clip and `next` is the sample after `i`.
bool follows(const FeatureSet& set, int i, int next) noexcept;

/// The four features that need no pixel; color and alpha are 0. O(1).
FeatureVector cheap_features(const FeatureSet& set, int i, int j) noexcept;

/// The six features of a pair. Cost O(grid^2).
FeatureVector features(const FeatureSet& set, int i, int j) noexcept;

namespace detail {

/// Sum of |a_i - a_j| over `count` cells.
std::uint32_t alpha_difference(const std::uint8_t* a, const std::uint8_t* b, int count) noexcept;
/// Sum of min(a_i, a_j) |c_i - c_j|^2 over rows of `width` <= 64 cells; `plane`: cells of a plane.
std::uint64_t color_difference(const std::uint8_t* a, const std::uint8_t* b, int plane, int first,
                               int width, int rows) noexcept;
/// The integer sums as features; both rise with their argument.
float alpha_feature(std::uint32_t sum) noexcept;
float color_feature(std::uint64_t sum) noexcept;

}  // namespace detail
}  // namespace vsprite
