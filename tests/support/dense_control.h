// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// dense_control.h - both control problems written out as the equations stand, for small N: a full
// matrix F, and a value for every (sample, phase, command). Slow and plain; what solve.h and
// joint.h are tested against, and the plain loop that their speed is measured against.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "control/joint.h"
#include "control/solve.h"

namespace vsprite::testing {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// T as a full (N, N) matrix; infinity where there is no transition under the cap.
inline std::vector<double> dense_costs(const CostTable& costs, double cap) {
  const std::size_t n = costs.kept.size();
  std::vector<double> t(n * n, kNever);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::uint32_t e = costs.row_start[i]; e < costs.row_start[i + 1]; ++e) {
      const Transition& edge = costs.transitions[e];
      if (static_cast<double>(edge.cost) <= cap)
        t[i * n + edge.to] = static_cast<double>(edge.cost);
    }
  }
  return t;
}

/// NIPS eq. 2, literally: F = T, then F_ij = T_ij + w1 a_j + alpha min_k F_jk until it stands.
inline std::vector<double> dense_f(const std::vector<double>& t, const std::vector<double>& angle,
                                   double w1, double alpha) {
  const std::size_t n = angle.size();
  std::vector<double> f = t;
  for (int sweep = 0; sweep < 4000; ++sweep) {
    std::vector<double> least(n, kNever);
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) least[j] = std::min(least[j], f[j * n + k]);
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j)
        f[i * n + j] = t[i * n + j] + w1 * angle[j] + alpha * least[j];
    }
  }
  return f;
}

/// The responsive problem of joint.h: V[phase][heading][sample], phase 0 cruising, 1 turning.
/// `angle[l][j]`, `turned[l][j]` as the problem defines them; `price` (N, N).
struct DenseJoint {
  std::size_t n = 0, headings = 8;
  std::vector<double> price;
  std::vector<std::vector<double>> angle;
  std::vector<std::vector<bool>> turned;
  double alpha = 0, rho = 0, cruise_w1 = 0, turn_w1 = 0;

  std::vector<std::vector<double>> solve() const {
    std::vector<std::vector<double>> v(2 * headings, std::vector<double>(n, 0));
    for (int sweep = 0; sweep < 3000; ++sweep) {
      auto after = v;
      for (std::size_t l = 0; l < headings; ++l) {
        for (std::size_t p = 0; p < 2; ++p) {
          for (std::size_t i = 0; i < n; ++i) after[p * headings + l][i] = best(v, p, l, i);
        }
      }
      v.swap(after);
    }
    return v;
  }

 private:
  double best(const std::vector<std::vector<double>>& v, std::size_t p, std::size_t l,
              std::size_t i) const {
    double least = kNever;
    for (std::size_t j = 0; j < n; ++j) {
      if (!std::isfinite(price[i * n + j])) continue;
      double others = 0;
      for (std::size_t m = 0; m < headings; ++m) {
        if (m != l) others += v[headings + m][j] / static_cast<double>(headings - 1);
      }
      const std::size_t phase = p == 1 && !turned[l][j] ? 1 : 0;
      const double future = (1 - rho) * v[phase * headings + l][j] + rho * others;
      least = std::min(
          least, price[i * n + j] + (p == 1 ? turn_w1 : cruise_w1) * angle[l][j] + alpha * future);
    }
    return least;
  }
};

/// One direction by the plain loop: V = 0, sweeps in order until the largest change is below
/// 0.05 (1 - alpha), at most `most`. Returns the number of sweeps, as far as they were left out
/// from the last change, which shrinks by alpha a sweep.
inline double plain_iteration(const CostTable& costs, const std::vector<float>& arrive, float alpha,
                              std::vector<float>& values, int most) {
  const std::size_t n = costs.kept.size();
  values.assign(n, 0);
  std::vector<float> after(n, 0);
  for (int sweep = 1;; ++sweep) {
    float change = 0;
    for (std::size_t i = 0; i < n; ++i) {
      float best = std::numeric_limits<float>::infinity();
      for (std::uint32_t e = costs.row_start[i]; e < costs.row_start[i + 1]; ++e) {
        const Transition& t = costs.transitions[e];
        best = std::min(best, t.cost + arrive[t.to] + alpha * values[t.to]);
      }
      after[i] = best;
      change = std::max(change, std::fabs(best - values[i]));
    }
    values.swap(after);
    const float due = 0.05f * (1 - alpha);
    if (change < due) return sweep;
    if (sweep == most) return sweep + std::log(double{due / change}) / std::log(double{alpha});
  }
}

}  // namespace vsprite::testing
