// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/features.h - how two samples differ: the six features of NIPS section 2.
//
// Pictures are compared aligned at their anchors, on a common grid. With speed s, heading h, mean
// colour m, area A, and a cell's coverage a (0..1) and colour c (sRGB code values in steps of 2):
//
//                raw: the paper's                                unit, range          per area:
//                over
//     speed       |s_i - s_j|                                     px/s, >= 0           sqrt(A)
//     angle       |h_i - h_j| min(1, min(s_i, s_j) / v0)          rad, 0..pi           1
//     color       sqrt( sum over cells of min(a_i, a_j)           code values,         sqrt(a)
//                                     x |c_i - c_j|^2 )           0..442 x grid
//     alpha       sum over cells of |a_i - a_j|                   cells, 0..grid^2     a
//     mean_color  |m_i - m_j|                                     code values, 0..442  1
//     area        |A_i - A_j|                                     px^2, >= 0           A
//
// with v0 = FeatureSet::v0, A = (A_i + A_j) / 2 and a = half the coverage of both together. The
// variants per area are free of scale: a subject filmed from twice as near has the same features
// (speed then in roots of its area a second, color the rms over the subject, alpha and area shares
// of it, 0..2), so near and far samples share one threshold. 0 / 0 is 0.
//
// Every feature is symmetric, >= 0, and 0 for a pair (i, i). Sums over pixels are integers and the
// rest is correctly rounded arithmetic: the same bits on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "film/extract.h"
#include "similarity/cells.h"
#include "vsprite/image.h"

namespace vsprite {

inline constexpr int kFeatureCount = 6;
inline constexpr const char* kFeatureNames[kFeatureCount] = {"speed", "angle",      "color",
                                                             "alpha", "mean_color", "area"};
enum Feature { kSpeed, kAngle, kColor, kAlpha, kMeanColor, kArea };

/// The six features of a pair, in the order of kFeatureNames.
using FeatureVector = std::array<float, kFeatureCount>;

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr int kDefaultGrid = 48;  ///< cells a side; finer finds no other jumps

/// Which of the two columns above.
enum class FeatureScale { Raw, PerArea };

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
  CellImage cells;
};

/// All samples on one grid; what every later stage of the film sees of the pictures.
struct FeatureSet {
  int grid = kDefaultGrid;  ///< cells a side
  FeatureScale scale = FeatureScale::Raw;
  double cell = 1;          ///< film pixels per cell, from the largest sprite
  double moving_speed = 1;  ///< px/s, > 0: a sample faster than this moves
  double v0 = 1;            ///< px/s, > 0: below this speed the angle fades
  double fps = 30;
  std::vector<SampleRow> rows;
  std::vector<FeatureSample> samples;  ///< (N), same numbering
  BlockOrder block_order;              ///< of every sample's cells
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
/// `grid`: a multiple of 8, 16..64.
FeatureSet make_feature_set(std::vector<SampleRow> rows, double fps, int grid,
                            const std::function<Image(int)>& pictures);

/// True if both samples belong to one clip and `next` is the sample after `i`.
bool follows(const FeatureSet& set, int i, int next) noexcept;

/// The four features that need no pixel; color and alpha are 0. O(1).
FeatureVector cheap_features(const FeatureSet& set, int i, int j) noexcept;

/// The six features of a pair. Cost O(cells that both pictures fill).
FeatureVector features(const FeatureSet& set, int i, int j) noexcept;

namespace detail {

/// Puts the features of the pixels into `f`. `color`: PairSums::color; `alpha`: the sum of
/// |a_i - a_j|, coverage 0..255. Both features rise with their argument.
void set_pixel_features(const FeatureSet& set, int i, int j, std::uint64_t color,
                        std::uint32_t alpha, FeatureVector& f) noexcept;

}  // namespace detail
}  // namespace vsprite
