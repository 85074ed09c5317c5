// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// closed_form.h - the rival that matting papers compare with: Levin, Lischinski and Weiss, "A
// Closed-Form Solution to Natural Image Matting" (2008), solved directly. Slow and plain.
//
//     alpha = argmin  a' L a + lambda (a - known)' D (a - known)
#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cstdint>
#include <vector>

namespace vsprite::testing {

/// `rgb`: (height, width, 3) linear. `known`: 0 clear, 1 opaque, below 0 to be found.
inline std::vector<float> closed_form_matte(const std::vector<float>& rgb,
                                            const std::vector<float>& known, int width, int height,
                                            double epsilon = 1e-5, double lambda = 100) {
  const int n = width * height;
  const auto known_at = [&](int i) { return known[static_cast<std::size_t>(i)]; };
  std::vector<Eigen::Triplet<double>> entries;
  for (int y = 1; y + 1 < height; ++y)
    for (int x = 1; x + 1 < width; ++x) {
      int at[9];
      bool open = false;
      for (int k = 0; k < 9; ++k) {
        at[k] = (y + k / 3 - 1) * width + x + k % 3 - 1;
        open = open || known_at(at[k]) < 0;
      }
      if (!open) continue;  // a window of known cells says nothing new
      Eigen::Matrix<double, 9, 3> c;
      for (int k = 0; k < 9; ++k)
        for (int p = 0; p < 3; ++p)
          c(k, p) = static_cast<double>(rgb[static_cast<std::size_t>(3 * at[k] + p)]);
      const Eigen::RowVector3d mean = c.colwise().mean();
      c.rowwise() -= mean;
      const Eigen::Matrix3d covariance =
          c.transpose() * c / 9 + epsilon / 9 * Eigen::Matrix3d::Identity();
      const Eigen::Matrix<double, 9, 9> affinity =
          (Eigen::Matrix<double, 9, 9>::Ones() + c * covariance.inverse() * c.transpose()) / 9;
      for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 9; ++j)
          entries.emplace_back(at[i], at[j], (i == j ? 1.0 : 0.0) - affinity(i, j));
    }
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, known_at(i) < 0 ? 1e-9 : lambda);
    if (known_at(i) > 0) right[i] = lambda * static_cast<double>(known_at(i));
  }
  Eigen::SparseMatrix<double> system(n, n);
  system.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(system);
  const Eigen::VectorXd solved = solver.solve(right);
  std::vector<float> alpha(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
    alpha[static_cast<std::size_t>(i)] = static_cast<float>(std::clamp(solved[i], 0.0, 1.0));
  return alpha;
}

}  // namespace vsprite::testing
