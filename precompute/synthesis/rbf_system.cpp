// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Kernel matrices, with and without the polynomial's border.

#include "synthesis/rbf_system.h"

namespace vsprite::detail {

RbfNetwork empty_network(const Examples& examples, const RbfConfig& config) {
  RbfNetwork net;
  net.kernel = config.kernel;
  net.degree = config.degree;
  net.width = config.width;
  net.dims = examples.dims;
  net.outputs = examples.outputs;
  net.period = config.period;
  net.metric = config.metric;
  return net;
}

Eigen::MatrixXd targets(const Examples& examples) {
  Eigen::MatrixXd y(examples.count(), examples.outputs);
  for (Eigen::Index i = 0; i < y.rows(); ++i)
    for (Eigen::Index m = 0; m < y.cols(); ++m)
      y(i, m) = examples.y[static_cast<std::size_t>(i * y.cols() + m)];
  return y;
}

Eigen::MatrixXd design(const Examples& examples, const RbfNetwork& net) {
  const auto dims = static_cast<std::size_t>(examples.dims);
  const int n = examples.count(), centers = net.center_count();
  Eigen::MatrixXd out(n, centers + net.term_count());
  for (int i = 0; i < n; ++i) {
    const double* x = &examples.x[static_cast<std::size_t>(i) * dims];
    for (int k = 0; k < centers; ++k) {
      const double s = squared_distance(net, {x, dims},
                                        {&net.centers[static_cast<std::size_t>(k) * dims], dims});
      out(i, k) = kernel_value(net.kernel, s, net.width);
    }
    int term = centers;
    if (net.degree >= 0) out(i, term++) = 1;
    for (int d = 0; net.degree == 1 && d < examples.dims; ++d)
      if (!net.is_cyclic(d)) out(i, term++) = x[d];
  }
  return out;
}

System make_system(const Examples& examples, const RbfConfig& config) {
  RbfNetwork net = empty_network(examples, config);
  net.centers = examples.x;
  const Eigen::MatrixXd values = design(examples, net);
  const Eigen::Index n = values.rows(), terms = values.cols() - n;
  System out;
  out.matrix = Eigen::MatrixXd::Zero(n + terms, n + terms);
  out.matrix.topRows(n) = values;
  out.matrix.bottomLeftCorner(terms, n) = values.rightCols(terms).transpose();
  // Linear and multiquadric are negative definite where the polynomial vanishes.
  const bool negative = config.kernel == Kernel::Linear || config.kernel == Kernel::Multiquadric;
  for (Eigen::Index i = 0; i < n; ++i) out.matrix(i, i) += negative ? -config.ridge : config.ridge;
  out.right = Eigen::MatrixXd::Zero(n + terms, examples.outputs);
  out.right.topRows(n) = targets(examples);
  return out;
}

void put_coefficients(const Eigen::MatrixXd& coefficients, int centers, RbfNetwork& net) {
  net.weights.clear();
  net.polynomial.clear();
  for (Eigen::Index i = 0; i < coefficients.rows(); ++i)
    for (Eigen::Index m = 0; m < coefficients.cols(); ++m)
      (i < centers ? net.weights : net.polynomial).push_back(coefficients(i, m));
}

}  // namespace vsprite::detail
