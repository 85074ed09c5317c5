// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The textbook's interpolant in long double: dense, plain Gaussian elimination, libm.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "synthesis/rbf_fit.h"

namespace vsprite::reference {

using Real = long double;
using Row = std::vector<Real>;

inline Real kernel(Kernel kernel, Real r, Real width) {
  switch (kernel) {
    case Kernel::Linear:
      return r;
    case Kernel::Gaussian:
      return std::exp(-(r / width) * (r / width));
    case Kernel::ThinPlate:
      return r > 0 ? r * r * std::log(r) : 0;
    case Kernel::Multiquadric:
      return std::sqrt(r * r + width * width);
  }
  return 0;
}

inline Real distance(const double* a, const double* b, int dims, const RbfConfig& config) {
  Row d;
  for (int i = 0; i < dims; ++i) {
    Real difference = Real(a[i]) - Real(b[i]);
    if (!config.period.empty() && config.period[std::size_t(i)] > 0)
      difference = std::remainder(difference, Real(config.period[std::size_t(i)]));
    d.push_back(difference);
  }
  Real sum = 0;
  for (int i = 0; i < dims; ++i) {
    Real q = config.metric.empty() ? d[std::size_t(i)] : 0;
    for (int k = 0; !config.metric.empty() && k < dims; ++k)
      q += Real(config.metric[std::size_t(i * dims + k)]) * d[std::size_t(k)];
    sum += q * q;
  }
  return std::sqrt(sum);
}

// Solves a x = b in place; a (n, n + m), the last m columns are b and become x.
inline void eliminate(std::vector<Row>& a) {
  const std::size_t n = a.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const Real factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < a[k].size(); ++j) a[i][j] -= factor * a[k][j];
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = n; j < a[i].size(); ++j) a[i][j] /= a[i][i];
}

// The polynomial's terms at x: 1, then every parameter that is not cyclic.
inline Row terms_of(const double* x, int dims, const RbfConfig& config) {
  Row out;
  if (config.degree >= 0) out.push_back(1);
  for (int d = 0; config.degree == 1 && d < dims; ++d)
    if (config.period.empty() || config.period[std::size_t(d)] <= 0) out.push_back(Real(x[d]));
  return out;
}

// The interpolant's system, (N + terms, N + terms + outputs): the last columns are the right side.
inline std::vector<Row> system_of(const Examples& e, const RbfConfig& config) {
  const int n = e.count(), dims = e.dims;
  const int terms = static_cast<int>(terms_of(e.x.data(), dims, config).size());
  const bool negative = config.kernel == Kernel::Linear || config.kernel == Kernel::Multiquadric;
  std::vector<Row> a(std::size_t(n + terms), Row(std::size_t(n + terms + e.outputs), 0));
  for (int i = 0; i < n; ++i) {
    const double* x = &e.x[std::size_t(i * dims)];
    for (int j = 0; j < n; ++j)
      a[std::size_t(i)][std::size_t(j)] = kernel(
          config.kernel, distance(x, &e.x[std::size_t(j * dims)], dims, config), config.width);
    a[std::size_t(i)][std::size_t(i)] += negative ? -config.ridge : config.ridge;
    const Row term = terms_of(x, dims, config);
    for (int t = 0; t < terms; ++t)
      a[std::size_t(i)][std::size_t(n + t)] = a[std::size_t(n + t)][std::size_t(i)] =
          term[std::size_t(t)];
    for (int m = 0; m < e.outputs; ++m)
      a[std::size_t(i)][std::size_t(n + terms + m)] = e.y[std::size_t(i * e.outputs + m)];
  }
  return a;
}

// Of that system, in the norm of the largest row sum.
inline Real condition(const Examples& e, const RbfConfig& config) {
  std::vector<Row> a = system_of(e, config);
  const std::size_t n = a.size();
  const auto largest = [n](const std::vector<Row>& rows, std::size_t from) {
    Real most = 0;
    for (const Row& row : rows) {
      Real sum = 0;
      for (std::size_t j = from; j < from + n; ++j) sum += std::abs(row[j]);
      most = std::max(most, sum);
    }
    return most;
  };
  const Real size = largest(a, 0);
  for (std::size_t i = 0; i < n; ++i) {
    a[i].assign(a[i].begin(), a[i].begin() + std::ptrdiff_t(n));
    a[i].resize(2 * n, 0);
    a[i][n + i] = 1;
  }
  eliminate(a);
  return size * largest(a, n);
}

// The interpolant's value at `at` (D), one number an output.
inline Row interpolate(const Examples& e, const RbfConfig& config, const double* at) {
  const int n = e.count(), dims = e.dims;
  const Row term = terms_of(at, dims, config);
  const int terms = static_cast<int>(term.size());
  std::vector<Row> a = system_of(e, config);
  eliminate(a);
  Row out(std::size_t(e.outputs), 0);
  for (int m = 0; m < e.outputs; ++m) {
    const auto column = std::size_t(n + terms + m);
    for (int j = 0; j < n; ++j)
      out[std::size_t(m)] +=
          a[std::size_t(j)][column] *
          kernel(config.kernel, distance(at, &e.x[std::size_t(j * dims)], dims, config),
                 config.width);
    for (int t = 0; t < terms; ++t)
      out[std::size_t(m)] += a[std::size_t(n + t)][column] * term[std::size_t(t)];
  }
  return out;
}

}  // namespace vsprite::reference
