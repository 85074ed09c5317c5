// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// plain_lanes.h - the keyer's two central loops as the formulas say them, one cell after the other.
#pragma once

#include <algorithm>
#include <cstdlib>

#include "film/lanes.h"

namespace vsprite::testing {

inline int plain_count_different(const std::uint8_t* top, const std::uint8_t* low,
                                 const std::uint8_t* cb, const std::uint8_t* cr,
                                 const std::uint16_t* plate_y, const std::uint8_t* plate_cb,
                                 const std::uint8_t* plate_cr, int n,
                                 const detail::RowLimits& limits) {
  int count = 0;
  for (int i = 0; i < n; ++i) {
    const int y = top[2 * i] + top[2 * i + 1] + low[2 * i] + low[2 * i + 1] - plate_y[i];
    const int b = cb[i] - plate_cb[i];
    const int r = cr[i] - plate_cr[i];
    count += std::abs(y - limits.shift_y) > limits.limit_y ||
             std::abs(b - limits.shift_cb) > limits.limit_c ||
             std::abs(r - limits.shift_cr) > limits.limit_c;
  }
  return count;
}

/// alpha = (D . q) / (m . q), q = adj(S) m, S = alpha^2 Sigma_F + sigma_n^2 I, two rounds from 1/2.
inline float plain_projection(const detail::ProjectionRow& row, float spill, int i) {
  float mean[3], covariance[3][3], d[3], m[3];
  const float inverse = 1 / row.moment[0][i];
  for (int p = 0; p < 3; ++p) mean[p] = row.moment[1 + p][i] * inverse;
  const float hue = 0.04f * (0.2126f * mean[0] + 0.7152f * mean[1] + 0.0722f * mean[2]);
  for (int p = 0, k = 4; p < 3; ++p)
    for (int q = p; q < 3; ++q, ++k) {
      float c = row.moment[k][i] * inverse + (0.1f * 0.1f - 1) * mean[p] * mean[q];
      if (p == q) c = std::max(c, 0.0f) + hue * hue;
      covariance[p][q] = covariance[q][p] = c;
    }
  for (int p = 0; p < 3; ++p) {
    d[p] = row.frame[p][i] - row.plate[p][i];
    m[p] = mean[p] + spill * row.plate[p][i] - row.plate[p][i];
  }
  float a = 0.5f;
  for (int round = 0; round < 2; ++round) {
    float s[3][3], adjugate[3][3];
    for (int p = 0; p < 3; ++p)
      for (int q = 0; q < 3; ++q)
        s[p][q] = a * a * covariance[p][q] + (p == q ? row.noise[p][i] * row.noise[p][i] : 0);
    for (int p = 0; p < 3; ++p)
      for (int q = 0; q < 3; ++q)
        adjugate[p][q] = s[(p + 1) % 3][(q + 1) % 3] * s[(p + 2) % 3][(q + 2) % 3] -
                         s[(p + 1) % 3][(q + 2) % 3] * s[(p + 2) % 3][(q + 1) % 3];
    float top = 0, bottom = 0;
    for (int p = 0; p < 3; ++p)
      for (int q = 0; q < 3; ++q) {
        top += d[p] * adjugate[p][q] * m[q];
        bottom += m[p] * adjugate[p][q] * m[q];
      }
    a = std::clamp(bottom > 0 ? top / bottom : 0.0f, 0.02f, 1.0f);
  }
  return std::max(a, row.bound[i]);
}

}  // namespace vsprite::testing
