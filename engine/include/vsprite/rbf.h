// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/rbf.h - from a few parameters to many numbers that were learned from examples: the
// network behind puppets (puppet.h).
//
//     f(x) = sum_k c_k G(|x - t_k|_W^2) + p(x)        [Poggio & Brunelli 1992, Appendix 1, eq. 7-9]
//
// D parameters in, M numbers out, K centres. G takes s = r^2:
//
//     linear sqrt(s)   Gaussian exp(-s / width^2)   thin-plate (s ln s) / 2
//     multiquadric sqrt(s + width^2)
//
// and |d|_W^2 = d' W' W d. The difference d of a cyclic parameter is taken the short way round; the
// polynomial p has no linear term in it. Fitting is the tool's (precompute/synthesis/rbf_fit.h);
// here is what runs every drawn frame: nothing allocates, and the exponential and the logarithm are
// our own, so that the same network and parameters give the same numbers on every machine.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "vsprite/result.h"

namespace vsprite {

enum class Kernel : std::uint8_t { Linear, Gaussian, ThinPlate, Multiquadric };
inline constexpr int kKernelCount = 4;

/// "linear", "gaussian", "thin-plate", "multiquadric".
std::string_view kernel_name(Kernel kernel) noexcept;
/// G(s). Pre: s >= 0, width > 0.
double kernel_value(Kernel kernel, double s, double width) noexcept;

inline constexpr int kMaxHullDims = 8;           ///< parameters that a hull may span
inline constexpr int kMaxNetworkDims = 1 << 17;  ///< D, of maps from whole configurations

/// A fitted network. Plain data, immutable once made; any number of threads may read it. Arrays are
/// row-major.
struct RbfNetwork {
  Kernel kernel = Kernel::ThinPlate;
  int degree = 1;                  ///< of p: -1 none, 0 constant, 1 linear
  double width = 1;                ///< > 0, in units of |d|_W
  int dims = 0;                    ///< D >= 1
  int outputs = 0;                 ///< M >= 1
  std::vector<double> period;      ///< (D): 0, or the parameter's period; empty: none is cyclic
  std::vector<double> metric;      ///< (D, D) W; empty: the identity
  std::vector<double> centers;     ///< (K, D)
  std::vector<double> weights;     ///< (K, M)
  std::vector<double> polynomial;  ///< (terms, M): the constant, then each parameter's slope
  std::vector<double> hull;        ///< (H, D): the examples' extreme points; empty: no hull

  int center_count() const noexcept {
    return dims == 0 ? 0 : static_cast<int>(centers.size() / static_cast<std::size_t>(dims));
  }
  bool is_cyclic(int d) const noexcept {
    return !period.empty() && period[static_cast<std::size_t>(d)] > 0;
  }
  /// Rows of `polynomial`.
  int term_count() const noexcept;
};

/// Checks that every shape agrees and every number is finite. Call it once, where untrusted data
/// enters (load_puppets does). Errors: CorruptData, with the name of the array at fault.
Result<RbfNetwork> make_rbf_network(RbfNetwork parts);

/// Squared distance |x - t|_W^2 in the network's sense.
double squared_distance(const RbfNetwork& net, std::span<const double> x,
                        std::span<const double> t) noexcept;

/// f(x) into `out` (M). Cost O(K (D^2 + M)). Pre: the sizes match, x is finite.
void predict(const RbfNetwork& net, std::span<const double> x, std::span<double> out) noexcept;

/// Networks extrapolate badly: replaces x by the nearest point, in the metric W, of the convex hull
/// of the examples. Cyclic parameters stay. Returns the distance moved, 0 inside.
double clamp_to_hull(const RbfNetwork& net, std::span<double> x) noexcept;

/// Examples that one smooth map cannot join (an arm held up or down before an obstacle) are kept in
/// sets [Darrell 1998, NIPS companion]: a set of examples, where it lies, and what may follow it.
struct ExampleSet {
  RbfNetwork net;                    ///< has a hull
  std::vector<double> median;        ///< (D) of its examples
  std::vector<std::uint32_t> joins;  ///< the sets that may be entered from this one
};

/// Which set answers for x, given the one that answered before (-1: none). It is kept until x
/// leaves its hull; then one of `joins` whose hull holds x is entered, or where none does it is
/// kept. At the start: of the sets that hold x the one with the nearest median, else the nearest
/// hull. Pre: D <= 8, at least one set.
int choose_set(std::span<const ExampleSet> sets, std::span<const double> x, int current) noexcept;

}  // namespace vsprite
