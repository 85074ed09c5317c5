// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/unmix.h - coverage and foreground colour on the chroma grid, in linear light.
//
//     C = alpha F + (1 - alpha) B        D = C - B,  m = mu - B
//     alpha = (D . q) / (m . q),         q = S^-1 m,  S = alpha^2 Sigma_F + sigma_n^2 I
//
// mu and Sigma_F are the mean and covariance of the sure subject (the seeds) nearby. Where the
// subject is colourless its covariance lies along grey and luma is forgiven: the formula becomes a
// colour-difference key; where colour says little it becomes a luma key. No threshold decides that.
#pragma once

#include <vector>

#include "film/silhouette.h"

namespace vsprite::detail {

inline constexpr int kUntouched = 6;  ///< cells: deeper in the picture is taken as it is

/// A run of cells of a row.
struct RowSpan {
  int y = 0;
  Span span;
};

/// The part of a frame that holds the subject. All maps are (height, width) cells, with room for a
/// block of lanes behind the last.
struct Patch {
  int left = 0, top = 0, width = 0, height = 0;  ///< cells, place on the film's grid
  Mask core;                                     ///< the silhouette
  Mask region;                                   ///< where alpha may be above 0: two cells more
  std::vector<Span> spans;                       ///< of each row, what holds the region and kReach
  std::vector<float> contrast;                   ///< as in Silhouette; before a plate alone
  std::vector<float> frame[3], plate[3];         ///< C, B: linear R, G, B
  std::vector<float> noise[3];                   ///< sigma_n, linear
  Mask seeds;                                    ///< surely subject
  std::vector<float> alpha;                      ///< the result
  Mask deep;                                     ///< kUntouched inside the seeds: all opaque
  std::vector<RowSpan> rim;                      ///< of the spans, all but what deep surrounds
  std::vector<float> mean[3];                    ///< mu: the foreground nearby, on the rim

  // Working room: evidence, weights, moments at half and at a quarter of the grid's resolution. A
  // row of moments holds all ten, one behind the other with zeros between, so that sums run over
  // them at once.
  std::vector<float> key, bound, residual, weight, color[3], scratch, soft;
  std::vector<float> near, wide, far, rows;
  std::vector<std::uint8_t> mode;
  std::vector<RowSpan> open;  // what was projected last: off it the residual is 0

  std::size_t cells() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

/// Calls `with(first cell, cells)` for the span of every row: all that is read of a patch.
template <class With>
void each_span(const Patch& patch, With with) {
  for (std::size_t y = 0; y < patch.spans.size(); ++y)
    if (const Span span = patch.spans[y]; span.size())
      with(y * static_cast<std::size_t>(patch.width) + static_cast<std::size_t>(span.begin),
           static_cast<std::size_t>(span.size()));
}

/// Cuts the patch around the silhouette out of frame and plate, in linear light.
void cut_patch(const ScreenModel& screen, const Silhouette& silhouette, Patch& patch);

/// Finds the seeds, then alpha and mean.
void unmix(const ScreenModel& screen, Patch& patch);

}  // namespace vsprite::detail
