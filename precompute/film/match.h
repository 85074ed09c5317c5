// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/match.h - clips filmed or generated apart, brought to one scale, mean colour and frame rate.
//
// The first clip of a cast is the reference. Another clip is scaled by the root of the ratio of the
// median areas; a subject of another pose covers another area, so what lies within kSameScale is
// taken for the same scale. Its colour is multiplied by one gain a channel, in linear light, as
// exposure and white balance do, until the mean over all its pictures is the reference's.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "film/extract.h"
#include "vsprite/image.h"

namespace vsprite {

inline constexpr double kSameScale = 1.08;  ///< area's root, ratio
inline constexpr double kSameGain = 1.01;   ///< too small to be seen
inline constexpr double kLargestGain = 4;   ///< more is a fault of the film

/// Mean colour of pictures in linear light, weighted by coverage. Integer counts inside: the order
/// of the pictures does not matter.
class MeanColor {
 public:
  void add(const Image& picture);
  void add(const MeanColor& other);
  /// 0 where nothing was seen.
  double mean(int channel) const;

 private:
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(3 * 256);  // coverage by code
};

/// What is done to a clip.
struct Matching {
  double scale = 1;            ///< its film pixels times this are the reference's
  double gain[3] = {1, 1, 1};  ///< R G B, linear light
  bool changes_color() const noexcept { return gain[0] != 1 || gain[1] != 1 || gain[2] != 1; }
};

/// Median area of the samples, film px^2.
double median_area(std::span<const SampleRow> rows);
Matching match_clip(double area, const MeanColor& color, double reference_area,
                    const MeanColor& reference_color);

struct Rate {
  std::uint32_t numerator = 30, denominator = 1;  ///< frames a second
};
/// Durations in frames of `to`: each sample is shown from the frame nearest to its own time on, and
/// one whose time is taken by the next is left out. Time begins anew in every clip. Rows come in
/// the order of film frames, clip by clip; the samples keep their old numbers.
std::vector<SampleRow> retimed(std::span<const SampleRow> rows, Rate from, Rate to);

/// The picture with `ratio` of its pixels to one of the result's, width x height of them from its
/// top left corner on, colours multiplied by `gain`. Straight alpha; filtered in linear light by a
/// tent that is as wide as the larger of both pixels.
Image redrawn(const Image& picture, double ratio, int width, int height, const double (&gain)[3]);

}  // namespace vsprite
