// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The bordered system of an interpolating network, solved with full pivoting; leave-one-out after
// Rippa (1999), with the polynomial and the ridge in it.

#include "synthesis/rbf_fit.h"

#include <Eigen/Dense>
#include <cmath>
#include <string>

#include "synthesis/rbf_system.h"

namespace vsprite {
namespace {

std::string degree_name(int degree) { return degree < 0 ? "none" : std::to_string(degree); }

Result<void> check_settings(const RbfConfig& config) {
  if (config.degree < -1 || config.degree > 1)
    return Error{ErrorCode::BadSetting,
                 "degree " + std::to_string(config.degree) + ": none, 0 or 1 is due"};
  if (!(config.width > 0) || !std::isfinite(config.width) || !(config.ridge >= 0) ||
      !std::isfinite(config.ridge))
    return Error{ErrorCode::BadSetting,
                 "width and ridge: a positive width and a ridge of 0 or more "
                 "are due"};
  const int least = least_degree(config.kernel);
  if (config.degree < least && !config.allow_low_degree)
    return Error{ErrorCode::BadSetting, "kernel " + std::string(kernel_name(config.kernel)) +
                                            " needs a polynomial of degree " + degree_name(least) +
                                            ", " + degree_name(config.degree) +
                                            " was given: raise it, or set allow_low_degree"};
  bool cyclic = false;
  for (const double period : config.period) cyclic |= period > 0;
  if (config.kernel == Kernel::ThinPlate && cyclic && !config.allow_low_degree)
    return Error{ErrorCode::BadSetting,
                 "kernel thin-plate needs a linear term in every parameter, which a cyclic one "
                 "cannot have: take kernel linear or gaussian, or give its cosine and sine"};
  return {};
}

Result<void> check_examples(const Examples& examples, const RbfConfig& config) {
  const auto n = static_cast<std::size_t>(examples.count());
  const auto dims = static_cast<std::size_t>(examples.dims);
  for (const auto* numbers : {&examples.x, &examples.y})
    for (std::size_t i = 0; i < numbers->size(); ++i)
      if (!std::isfinite((*numbers)[i]))
        return Error{ErrorCode::BadContent, "example " +
                                                std::to_string(i / (numbers->size() / n) + 1) +
                                                " holds a number that is not finite"};
  const RbfNetwork net = detail::empty_network(examples, config);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      if (squared_distance(net, {&examples.x[i * dims], dims}, {&examples.x[j * dims], dims}) == 0)
        return Error{ErrorCode::BadContent, "examples " + std::to_string(i + 1) + " and " +
                                                std::to_string(j + 1) +
                                                " have the same parameters: one of them has to go"};
  return {};
}

Error singular(const Examples& examples, const RbfConfig& config) {
  if (config.degree == 1)
    return {ErrorCode::BadContent,
            std::to_string(examples.count()) + " examples of " + std::to_string(examples.dims) +
                " parameters do not span the plane that degree 1 needs: add an example off their "
                "line, or take degree 0 with kernel linear"};
  return {ErrorCode::BadContent,
          "the examples leave the network undetermined: move one of their "
          "parameters a little, or set a ridge"};
}

struct Solved {
  detail::System system;
  Eigen::MatrixXd coefficients;  // (N + terms, M)
  Eigen::MatrixXd inverse;       // only where asked for
};

Result<Solved> solve(const Examples& examples, const RbfConfig& config, bool with_inverse) {
  if (auto ok = check_settings(config); !ok) return ok.error();
  if (examples.count() < 1) return Error{ErrorCode::BadContent, "no examples"};
  if (auto ok = check_examples(examples, config); !ok) return ok.error();
  Solved out;
  out.system = detail::make_system(examples, config);
  const Eigen::MatrixXd& a = out.system.matrix;
  if (config.pseudo_inverse) {
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> qr(a);
    out.coefficients = qr.solve(out.system.right);
    if (with_inverse) out.inverse = qr.pseudoInverse();
    return out;
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(a);
  if (!lu.isInvertible()) return singular(examples, config);
  out.coefficients = lu.solve(out.system.right);
  // One step of refinement takes what the growth of the pivots lost.
  out.coefficients += lu.solve(out.system.right - a * out.coefficients);
  if (with_inverse) out.inverse = lu.inverse();
  return out;
}

}  // namespace

int least_degree(Kernel kernel) noexcept {
  if (kernel == Kernel::Gaussian) return -1;
  return kernel == Kernel::ThinPlate ? 1 : 0;
}

Result<RbfNetwork> fit_rbf(const Examples& examples, const RbfConfig& config) {
  auto solved = solve(examples, config, false);
  if (!solved) return solved.error();
  RbfNetwork net = detail::empty_network(examples, config);
  net.centers = examples.x;
  detail::put_coefficients(solved->coefficients, examples.count(), net);
  if (examples.dims <= kMaxHullDims) net.hull = hull_corners(examples, config);
  return make_rbf_network(std::move(net));
}

Result<std::vector<double>> leave_one_out(const Examples& examples, const RbfConfig& config) {
  const auto solved = solve(examples, config, true);
  if (!solved) return solved.error();
  std::vector<double> errors;
  errors.reserve(examples.y.size());
  for (int i = 0; i < examples.count(); ++i)
    for (int m = 0; m < examples.outputs; ++m)
      errors.push_back(solved->coefficients(i, m) / solved->inverse(i, i));
  return errors;
}

std::vector<double> hull_corners(const Examples& examples, const RbfConfig& config) {
  const auto dims = static_cast<std::size_t>(examples.dims);
  RbfNetwork net = detail::empty_network(examples, config);
  net.hull = examples.x;
  // A point is no corner if the hull of the others holds it.
  for (std::size_t i = 0; i < net.hull.size() && net.hull.size() > dims;) {
    const auto at = net.hull.begin() + static_cast<std::ptrdiff_t>(i);
    std::vector<double> point(at, at + static_cast<std::ptrdiff_t>(dims));
    const std::vector<double> all = net.hull;
    net.hull.erase(at, at + static_cast<std::ptrdiff_t>(dims));
    if (std::vector<double> moved = point; clamp_to_hull(net, moved) == 0) continue;
    net.hull = all;
    i += dims;
  }
  return net.hull;
}

}  // namespace vsprite
