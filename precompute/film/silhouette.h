// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/silhouette.h - where a frame differs from its plate, on the chroma grid.
#pragma once

#include "film/grid.h"
#include "film/lanes.h"
#include "film/plate.h"

namespace vsprite::detail {

/// The six colour differences that a screen may be strong in: R, G, B, cyan, magenta, yellow.
inline constexpr int kKeyCount = 6;
/// Strength of colour difference `key` of a linear colour (r, g, b): one channel less the larger of
/// the others, or the lesser of two less the third.
float key_strength(int key, float r, float g, float b) noexcept;

/// Quadratic in x, y (both scaled to -1..1 over the grid) for each plane: 1 x y xx xy yy.
struct Surface {
  double coefficient[3][6] = {};
  double at(int plane, double x, double y) const {
    const double* k = coefficient[plane];
    return k[0] + k[1] * x + k[2] * y + k[3] * x * x + k[4] * x * y + k[5] * y * y;
  }
};

/// Least squares of a quadratic, accumulated sample by sample, three planes at once.
class SurfaceFit {
 public:
  void add(double x, double y, const double (&value)[3]);
  int count() const { return count_; }
  /// False where the samples do not determine it (then `surface` holds their mean).
  bool solve(Surface& surface) const;

 private:
  double normal_[6][6] = {};
  double right_[3][6] = {};
  int count_ = 0;
};

/// One row of a surface, for the lanes.
inline RowTerms row_of(const Surface& s, int plane, double y) {
  const double* k = s.coefficient[plane];
  return {static_cast<float>(k[0] + k[2] * y + k[5] * y * y), static_cast<float>(k[1] + k[4] * y),
          static_cast<float>(k[3])};
}
/// The scaled x of a window's cells on a grid `width` wide.
inline RowScale scale_of(int left, int width) {
  const double step = width > 1 ? 2.0 / (width - 1) : 0.0;
  return {static_cast<float>(width > 1 ? step * left - 1 : 0.0), static_cast<float>(step)};
}

/// Where a frame may differ from its plate, and what it looks like there. All maps are those of
/// `window`, planes are R, G, B.
struct Silhouette {
  Surface drift;            ///< frame - plate on the bare screen, code values
  Window window;            ///< what was looked at: blocks that differ, and a margin
  std::vector<Span> spans;  ///< of the window's rows; outside nothing but mask and contrast is set
  Grid grid;                ///< the frame, encoded
  std::vector<float> frame[3];  ///< the same in linear light
  std::vector<float> plate[3];  ///< the plate with the drift, in linear light
  std::vector<float> contrast;  ///< smoothed distance to the plate, code values
  Mask mask;                    ///< 1 = not screen
  bool empty = true;
  Window box;  ///< of the mask, on the film's grid

  std::vector<float> rough;  // working room
};

/// Row y of a map of cells and those about it; `zeros`: a row of them.
inline RowsAround rows_around(const std::vector<float>& map, int width, int height, int y,
                              const std::vector<float>& zeros) {
  const float* row = map.data() + static_cast<std::ptrdiff_t>(y) * width;
  return {y > 0 ? row - width : zeros.data(), row, y + 1 < height ? row + width : zeros.data()};
}

/// Means over 3 x 3 of a map; outside is 0.
void blur3(const std::vector<float>& map, int width, int height, std::vector<float>& out);

/// Scaled coordinate of cell index i of n: -1..1.
inline double scaled(int i, int n) { return n > 1 ? 2.0 * i / (n - 1) - 1 : 0.0; }

/// Luma and colour together; colour is the steadier witness in a compressed film and counts double.
inline float distance_squared(float r, float g, float b) {
  const float y = 0.114f * b + 0.587f * g + 0.299f * r;
  const float cb = 0.564f * (b - y);
  const float cr = 0.713f * (r - y);
  return y * y + 2 * (cb * cb + cr * cr);
}

/// The drift of the bare screen in a frame, code values; what differs by more than `reach` from the
/// plate and the drift is not believed.
Surface fit_drift(const ScreenModel& screen, const Frame& frame, float reach);

/// Completes a model whose plate is known: what the keyer reads for every frame.
void prepare_model(ScreenModel& screen);

/// Of the subject's usual contrast: a plate that differs less from the subject is like it, and what
/// differs less from such a plate may be the subject's shadow or reflection there.
inline constexpr float kUnlike = 0.5f;

/// The channels of colour difference `key`.
KeyShape shape_of(int key) noexcept;

/// The rectangle of what is in; false where nothing is.
bool find_box(const Mask& mask, Window& box);

/// Finds what is not screen. The result's buffers are reused from call to call.
void find_silhouette(const ScreenModel& screen, const Frame& frame, Silhouette& result);

}  // namespace vsprite::detail
