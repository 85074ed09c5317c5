// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/solve.h - the mode "paper": the discounted cost to go for every heading, none and rest.
//
//     F_ij = T_ij + w1 a_j(l) + alpha min_k F_jk,   V_i = min_j F_ij          [NIPS eq. 2]
//     a_j(l) = f |angle(v_j, l)| + (1 - f) pi,  f = min(1, |v_j| / v0)
//     V^k_i = min_j [T_ij + alpha V^(k-1)_j],  k = 1..K                        [NIPS section 4.1]
//
// none: w1 = 0. rest: a_j = pi f^2 (a slow drift is worth no jump).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "control/spread.h"
#include "similarity/transitions.h"
#include "vsprite/geometry.h"
#include "vsprite/result.h"
#include "vsprite/sprite.h"

namespace vsprite {

struct SolveConfig {
  double alpha = 0.97;  ///< [0, 1)
  double w1 = 0;        ///< per radian, >= 0; 0 = by rule: pi w1 = 2.5 x the median accepted T
  double cap = 1.0;    ///< transitions dearer than this are left out, > 0; from a sample without an
                       ///< edge under the cap its cheapest are kept
  int free_steps = 5;  ///< K, 0..10
  int headings = 8;    ///< 8, 16 or 32
  bool iterate = false;  ///< the paper's own iteration from F = T instead of policy iteration
};

/// A solved mode. All of it is served; who measures it may narrow that.
struct Solution {
  ControlMode mode;           ///< next and go from V as stored; residual: largest |TV - V| of V as
                              ///< stored, in double, over all tables
  std::vector<float> values;  ///< V: (tables, N); +inf where a sample was not kept
};

/// a_j(l) in radians, [0, pi]; 0 for None.
double direction_cost(Vec2 velocity, double v0, Direction direction) noexcept;
/// The same for heading h of `headings`; h = headings is none, h = headings + 1 rest.
double heading_cost(Vec2 velocity, double v0, int h, int headings) noexcept;
/// |angle(v, l)|, radians in [0, pi].
double heading_angle(Vec2 velocity, int h, int headings) noexcept;

/// The default w1 of a film: pi w1 = 2.5 x the median cost of its jumps; 0.6 where it has none.
double default_w1(const CostTable& costs);

/// `velocities`: (N) px/s; `v0` px/s > 0. `jobs`: threads, 0 = all; the result does not depend on
/// it. With `spread` the whole is what process 0 returns. Errors: BadSetting (alpha, w1, cap,
/// free_steps out of range or not finite), BadContent (a kept sample without a transition, or one
/// that leads to a sample not kept).
Result<Solution> solve(const CostTable& costs, std::span<const Vec2> velocities, double v0,
                       const SolveConfig& config, int jobs = 0, const Spread& spread = {});

namespace detail {

/// What both modes ask of their input. Errors: as solve().
Result<void> check_graph(const CostTable& costs, std::size_t samples, double v0);
Error bad_setting(const std::string& name, double found, const std::string& due);
/// A mode with every direction served and room for its tables: in process 0 for all, elsewhere for
/// those of its own blocks.
Solution empty_solution(const char* name, int headings, int stages, std::size_t samples,
                        const Spread& spread);

/// The tables of a block, (groups of it, stages, N), where its process has room for them.
struct BlockTables {
  std::span<std::uint32_t> next;
  std::span<float> go, values;
};
BlockTables tables_of(Solution& solution, const Spread& spread, std::size_t block,
                      std::size_t samples);
/// `residuals`: a block. To process 0, which sets `solution.mode.residual` to the largest.
void gather_blocks(Solution& solution, const Spread& spread, std::vector<double>& residuals,
                   std::size_t samples);

}  // namespace detail
}  // namespace vsprite
