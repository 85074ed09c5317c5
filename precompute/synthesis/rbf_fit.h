// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// synthesis/rbf_fit.h - learns a network (vsprite/rbf.h) from examples [Poggio & Brunelli 1992,
// Appendix 1].
//
// One centre an example gives exact interpolation, with the side conditions of the polynomial:
//
//     | K - + ridge   P | | c |   | Y |        K_ij = G(|x_i - x_j|_W^2),  P = 1, x
//     | P'            0 | | d | = | 0 |
//
// (the ridge takes the sign under which K is definite on what P leaves). Fewer, movable centres and
// a learned norm give HyperBF, where t and W go down the error's gradient, or wander at random and
// keep what lowers it (sometimes what raises it, as Metropolis does); c is always the best one for
// them.
#pragma once

#include <cstdint>
#include <vector>

#include "vsprite/rbf.h"
#include "vsprite/result.h"

namespace vsprite {

/// N examples, row-major.
struct Examples {
  int dims = 0;           ///< D
  int outputs = 0;        ///< M
  std::vector<double> x;  ///< (N, D)
  std::vector<double> y;  ///< (N, M)
  int count() const { return dims == 0 ? 0 : static_cast<int>(x.size()) / dims; }
};

struct RbfConfig {
  Kernel kernel = Kernel::ThinPlate;
  int degree = 1;                 ///< -1 none, 0, 1
  bool allow_low_degree = false;  ///< a kernel below its least degree, by name
  double width = 1;               ///< > 0, in units of |d|_W
  double ridge = 0;               ///< >= 0; 0 is exact
  bool pseudo_inverse = false;    ///< least norm where the system is singular [Darrell 1998]
  std::vector<double> period{};   ///< (D) as in RbfNetwork
  std::vector<double> metric{};   ///< (D, D) as in RbfNetwork
};

/// -1, 0 or 1: below it the system may be singular for examples that all differ.
int least_degree(Kernel kernel) noexcept;

/// Exact for ridge 0. Errors: BadSetting (kernel and degree do not go together), BadContent (equal
/// examples, named by number from 1; too few of them for the degree; a number that is not finite).
Result<RbfNetwork> fit_rbf(const Examples& examples, const RbfConfig& config = {});

/// (N, M): what each example's prediction would be off if it were left out, in closed form: c_i /
/// (A^-1)_ii, without fitting N times. Errors as fit_rbf.
Result<std::vector<double>> leave_one_out(const Examples& examples, const RbfConfig& config = {});

/// Keeps only the examples that are corners of the convex hull, (H, D). Pre: D <= 8.
std::vector<double> hull_corners(const Examples& examples, const RbfConfig& config);

enum class HyperTraining : std::uint8_t { Gradient, RandomSearch };

struct HyperConfig {
  RbfConfig rbf{};  ///< its `metric` is where W starts
  int centers = 4;  ///< n <= N
  HyperTraining training = HyperTraining::Gradient;
  int steps = 400;            ///< of the gradient, or tried changes
  double temperature = 0.01;  ///< of RandomSearch: a rise of the error by this share is kept
                              ///< with chance 1 / e at first; falls to nothing
  std::uint64_t seed = 1;
};

struct HyperFit {
  RbfNetwork net;
  double first_error = 0;  ///< H = sum of squared errors, before training
  double error = 0;        ///< after
};

/// Errors as fit_rbf.
Result<HyperFit> fit_hyperbf(const Examples& examples, const HyperConfig& config);

}  // namespace vsprite
