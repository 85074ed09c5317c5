// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/joint.h - the mode "responsive": what the player may do next is part of the problem.
//
//     F_ij^{p,l} = T_ij^2 + w_p a_j(l) + alpha [(1-rho) V_j^{p',l} + rho mean_{m != l}
//     V_j^{turn,m}] a_j(l) = f max(0, |angle(v_j, l)| - bend) + (1-f) pi + s (1 - clamp(v_j . l /
//     fast, 0, 1))
//
// A change of command enters the phase `turn`; p' = cruise from the first sample j on that lies
// within `exit` of the command and moves, else p' = p. rho is the chance that the player changes
// the command, so the sprite waits in poses from which it can turn. The speed term s keeps it from
// waiting curled up. i -> i+2 inside a clip (play-through) counts as a jump; the engine
// turns displacements by up to `bend` towards the command, so so much is free here.
//
// The command is random, the next sample is not: for a given mean M_j^l = mean_{m != l}
// V_j^{turn,m} each (p, l) is a deterministic problem with discount alpha (1-rho) (lanes.h), and M
// is a contraction by alpha rho / (1 - alpha (1-rho)) of itself.
#pragma once

#include <span>

#include "control/solve.h"

namespace vsprite {

struct JointConfig {
  double alpha = 0.985;        ///< [0, 1)
  double cruise_w1 = 0.2;      ///< w_cruise, per radian, >= 0
  double turn_w1 = 0.8;        ///< w_turn, per radian, >= 0; as w_cruise: one table
  double cap = 1;              ///< on T, > 0
  double change_rate = 0.012;  ///< rho, per sample, [0, 1); 0: no model of the player
  double speed_weight = 0.3;   ///< s, radians, >= 0; 0: no speed term
  bool play_through = false;   ///< i -> i+2
  double skip_price = 1;       ///< times its own T, >= 0
  double bend_deg = 15;        ///< [0, 45]; 0: none
  double exit_deg = 25;        ///< (0, 90]
  int headings = 8;            ///< 8, 16 or 32
};

/// What solving needs of the film's motion; any one unit of length.
struct Motion {
  std::span<const Vec2> velocities;   ///< (N) a second
  std::span<const float> skip_costs;  ///< (N) T of leaving out the next sample; or infinity
  double v0 = 0;                      ///< > 0; below this speed a heading means little
};

/// `served`: bit h, a heading that the player may command (the others are solved too, but not
/// expected). `spread`: as for solve(); the processes also share V^turn, N doubles a heading, every
/// time that M is summed. Errors: as solve(), and BadSetting for the settings above.
Result<Solution> solve_joint(const CostTable& costs, const Motion& motion,
                             const JointConfig& config, std::uint32_t served, int jobs = 0,
                             const Spread& spread = {});

/// The 75th percentile of the speeds above v0: "fast".
double fast_speed(std::span<const Vec2> velocities, double v0);

}  // namespace vsprite
