// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Exposure drift, distance to the plate, shadows, and the cleaned map of what is left.
#include "film/silhouette.h"

#include <algorithm>
#include <cmath>

#include "film/light.h"

namespace vsprite::detail {

float key_strength(int key, float r, float g, float b) noexcept {
  switch (key) {
    case 0:
      return r - std::max(g, b);
    case 1:
      return g - std::max(r, b);
    case 2:
      return b - std::max(r, g);
    case 3:
      return std::min(g, b) - r;
    case 4:
      return std::min(r, b) - g;
    case 5:
      return std::min(r, g) - b;
    default:
      return 0;
  }
}

void SurfaceFit::add(double x, double y, const double (&value)[3]) {
  const double term[6] = {1, x, y, x * x, x * y, y * y};
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) normal_[i][j] += term[i] * term[j];
    for (int p = 0; p < 3; ++p) right_[p][i] += term[i] * value[p];
  }
  ++count_;
}

// Cholesky of the 6 x 6 normal equations, a little ridge on all but the constant.
bool SurfaceFit::solve(Surface& surface) const {
  surface = Surface{};
  if (count_ == 0) return false;
  for (int p = 0; p < 3; ++p) surface.coefficient[p][0] = right_[p][0] / count_;
  if (count_ < 60) return false;
  double l[6][6] = {};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) {
      double sum = normal_[j][i] + (i == j && i > 0 ? 1e-4 * count_ : 0.0);
      for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      if (i == j) {
        if (!(sum > 1e-9 * count_)) return false;
        l[i][i] = std::sqrt(sum);
      } else {
        l[i][j] = sum / l[j][j];
      }
    }
  for (int p = 0; p < 3; ++p) {
    double z[6];
    for (int i = 0; i < 6; ++i) {
      z[i] = right_[p][i];
      for (int k = 0; k < i; ++k) z[i] -= l[i][k] * z[k];
      z[i] /= l[i][i];
    }
    for (int i = 5; i >= 0; --i) {
      for (int k = i + 1; k < 6; ++k) z[i] -= l[k][i] * z[k];
      z[i] /= l[i][i];
    }
    std::copy(z, z + 6, surface.coefficient[p]);
  }
  return true;
}

// The residual of the sure background, some thousand cells of it, in four rounds. Each round
// believes what lies near the round before.
Surface fit_drift(const ScreenModel& screen, const Grid& grid, float reach) {
  Surface drift;
  const int step = std::max(4, grid.width / 40);
  for (const float limit : {4 * reach, 2 * reach, reach, reach}) {
    SurfaceFit fit;
    for (int y = step / 2; y < grid.height; y += step) {
      const double v = scaled(y, grid.height);
      for (int x = step / 2; x < grid.width; x += step) {
        const double u = scaled(x, grid.width);
        const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) +
                              static_cast<std::size_t>(x);
        double residual[3];
        float left[3];
        for (int p = 0; p < 3; ++p) {
          residual[p] = 0.25 * grid.plane[p][i] - static_cast<double>(screen.cells[p][i]);
          left[p] = static_cast<float>(residual[p] - drift.at(p, u, v));
        }
        if (distance_squared(left[0], left[1], left[2]) < limit * limit) fit.add(u, v, residual);
      }
    }
    // Too little screen in sight: the film's plate stands.
    if (fit.count() * step * step * 20 < static_cast<int>(grid.cells())) return Surface{};
    fit.solve(drift);
  }
  return drift;
}

namespace {

// C = s B in linear light within 12 %, 0.35 < s < 1.3: the screen in shade.
bool on_shadow_line(const float (&c)[3], const float (&b)[3]) {
  const float bb = b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
  if (!(bb > 0)) return false;
  const float s = (c[0] * b[0] + c[1] * b[1] + c[2] * b[2]) / bb;
  if (s < 0.35f || s > 1.3f) return false;
  float rest = 0;
  for (int p = 0; p < 3; ++p) rest += (c[p] - s * b[p]) * (c[p] - s * b[p]);
  return rest < 0.12f * 0.12f * s * s * bb;
}

// Contrast of each cell to the frame's own plate, smoothed over 3 x 3.
void measure_contrast(const ScreenModel& screen, Silhouette& s) {
  const Grid& grid = s.grid;
  const int w = grid.width;
  s.contrast.resize(grid.cells());
  const float step = w > 1 ? 2.0f / static_cast<float>(w - 1) : 0.0f;
  for (int y = 0; y < grid.height; ++y) {
    const double v = scaled(y, grid.height);
    const SurfaceRow blue = row_of(s.drift, 0, v);
    const SurfaceRow green = row_of(s.drift, 1, v);
    const SurfaceRow red = row_of(s.drift, 2, v);
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(w);
    const std::uint16_t* frame[3] = {grid.plane[0].data() + at, grid.plane[1].data() + at,
                                     grid.plane[2].data() + at};
    const float* plate[3] = {screen.cells[0].data() + at, screen.cells[1].data() + at,
                             screen.cells[2].data() + at};
    float* out = s.contrast.data() + at;
    for (int x = 0; x < w; ++x) {
      const float u = step * static_cast<float>(x) - 1;
      out[x] = std::sqrt(distance_squared(0.25f * frame[0][x] - plate[0][x] - blue.at(u),
                                          0.25f * frame[1][x] - plate[1][x] - green.at(u),
                                          0.25f * frame[2][x] - plate[2][x] - red.at(u)));
    }
  }
}

// A screen in shade is screen: its contrast is struck out.
void forgive_shadows(const ScreenModel& screen, Silhouette& s) {
  const Grid& grid = s.grid;
  const auto& light = linear_of_sums();
  for (int y = 0; y < grid.height; ++y) {
    const double v = scaled(y, grid.height);
    for (int x = 0; x < grid.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) +
                            static_cast<std::size_t>(x);
      if (s.contrast[i] <= 0.5f * screen.threshold) continue;
      const double u = scaled(x, grid.width);
      float c[3];
      float b[3];
      for (int p = 0; p < 3; ++p) {
        c[p] = light[grid.plane[p][i]];
        const float code = 4 * (screen.cells[p][i] + static_cast<float>(s.drift.at(p, u, v)));
        b[p] = light[static_cast<std::size_t>(std::clamp(code + 0.5f, 0.0f, 1020.0f))];
      }
      if (on_shadow_line(c, b)) s.contrast[i] = 0;
    }
  }
}

// Without a key faint differences are shadows, reflections and the codec's smear: they count only
// within three cells of what stands out as the subject does.
void drop_faint(const ScreenModel& screen, Silhouette& s) {
  Mask strong(s.mask.width, s.mask.height);
  const float least = std::max(2 * screen.threshold, 0.2f * screen.subject_contrast);
  for (std::size_t i = 0; i < strong.in.size(); ++i) strong.in[i] = s.contrast[i] > least ? 1 : 0;
  const Mask near = dilate(strong, 3);
  for (std::size_t i = 0; i < near.in.size(); ++i) s.mask.in[i] &= near.in[i];
}

}  // namespace

void find_silhouette(const ScreenModel& screen, const Frame& frame, Silhouette& s) {
  make_grid(frame, s.grid);
  s.drift = fit_drift(screen, s.grid, screen.threshold);
  measure_contrast(screen, s);
  if (screen.key >= 0) forgive_shadows(screen, s);
  std::vector<float> scratch;
  blur(s.contrast, s.grid.width, s.grid.height, 1, 1, scratch);
  s.mask = Mask(s.grid.width, s.grid.height);
  for (std::size_t i = 0; i < s.mask.in.size(); ++i)
    s.mask.in[i] = s.contrast[i] > screen.threshold ? 1 : 0;
  if (screen.key < 0) drop_faint(screen, s);
  s.mask = dilate(erode(s.mask, 1), 1);
  s.mask = erode(dilate(s.mask, 2), 2);
  s.left = s.grid.width;
  s.top = s.grid.height;
  s.right = s.bottom = 0;
  for (int y = 0; y < s.grid.height; ++y)
    for (int x = 0; x < s.grid.width; ++x)
      if (s.mask.row(y)[x]) {
        s.left = std::min(s.left, x);
        s.right = std::max(s.right, x + 1);
        s.top = std::min(s.top, y);
        s.bottom = std::max(s.bottom, y + 1);
      }
  s.empty = s.right <= s.left;
}

}  // namespace vsprite::detail
