// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// synthesis/rbf_system.h - the matrices behind rbf_fit.h. For its sources only.
#pragma once

#include <Eigen/Dense>

#include "synthesis/rbf_fit.h"

namespace vsprite::detail {

struct System {
  Eigen::MatrixXd matrix;  ///< (N + terms, N + terms)
  Eigen::MatrixXd right;   ///< (N + terms, M)
};

/// Kernel, degree, width, metric and period; no centres.
RbfNetwork empty_network(const Examples& examples, const RbfConfig& config);
System make_system(const Examples& examples, const RbfConfig& config);
/// (N, K + terms): the kernels at the network's centres, then the polynomial's terms.
Eigen::MatrixXd design(const Examples& examples, const RbfNetwork& net);
/// The first `centers` rows are weights, the others the polynomial.
void put_coefficients(const Eigen::MatrixXd& coefficients, int centers, RbfNetwork& net);
Eigen::MatrixXd targets(const Examples& examples);

}  // namespace vsprite::detail
