// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/solve.h - the discounted cost to go, for eight directions, no direction and rest.
//
//     F_ij = T_ij + w1 a_j(l) + alpha min_k F_jk,   V_j = min_k F_jk          [NIPS eq. 2]
//     a_j(l) = f |angle(v_j, l)| + (1 - f) pi,  f = min(1, |v_j| / v0)
//     V^k_i = min_j [T_ij + alpha V^(k-1)_j],  k = 1..K                        [NIPS section 4.1]
//
// none: w1 = 0. rest: a_j = pi * min(1, |v_j| / v0) (prefers low speed). Deterministic problem, so a
// policy is a functional graph: exact evaluation in O(N), improvement by Gauss-Seidel (Howard).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "similarity/transitions.h"
#include "vsprite/geometry.h"
#include "vsprite/result.h"

namespace vsprite {

struct SolveConfig {
  double alpha = 0.97;   ///< [0, 1)
  double w1 = 0.6;       ///< per radian, >= 0
  double cap = 1.0;      ///< transitions dearer than this are left out, > 0 (rows never emptied)
  int free_steps = 5;    ///< K, 0..10
};

/// Everything about a mode that the pack stores, and V itself.
struct Solution {
  int stages = 1;                        ///< K + 1
  std::vector<float> values;             ///< (10, stages, N); +inf where a sample was not kept
  std::vector<std::uint32_t> next;       ///< (10 * stages, N); kNoSample where not kept
  double residual = 0;                   ///< largest |TV - V|, in double, over all tables
  double error_bound = 0;                ///< residual / (1 - alpha)
};

/// `velocities`: (N) px/s; `v0` px/s > 0.
/// Errors: BadSetting (alpha, w1, cap, free_steps out of range or not finite).
Result<Solution> solve(const CostTable& costs, std::span<const Vec2> velocities, double v0,
                       const SolveConfig& config);

}  // namespace vsprite
