// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The paper's linear classifier, with two departures: squared hinge loss (smooth enough for
// Newton), and weights that may not be negative.
#include "similarity/classifier.h"

#include <algorithm>
#include <cmath>

namespace vsprite {
namespace {

constexpr int kVariables = kFeatureCount + 1;  // u, then b
constexpr double kMinThreshold = 0.05;         // of b, whose natural size is 1

using Vector = std::array<double, kVariables>;
using Matrix = std::array<Vector, kVariables>;

// One labelled pair: margin = y (b - u . x) = a . (u, b).
struct Example {
  Vector a{};
  double cost = 1;  // times the label's weight
};

struct Problem {
  std::vector<Example> examples;
  double weight = 0;  // of all labels
  double ridge = 0;
  Vector lower{};
};

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

double loss(const Problem& problem, const Vector& z) {
  double sum = 0;
  for (const Example& e : problem.examples) {
    const double slack = 1 - dot(e.a, z);
    if (slack > 0) sum += e.cost * slack * slack;
  }
  sum /= problem.weight;
  for (std::size_t k = 0; k < kFeatureCount; ++k) sum += problem.ridge * z[k] * z[k];
  return sum;
}

void derivatives(const Problem& problem, const Vector& z, Vector& gradient, Matrix& hessian) {
  gradient = {};
  hessian = {};
  const double scale = 2 / problem.weight;
  for (const Example& e : problem.examples) {
    const double slack = 1 - dot(e.a, z);
    if (slack <= 0) continue;
    for (std::size_t r = 0; r < e.a.size(); ++r) {
      gradient[r] -= scale * e.cost * slack * e.a[r];
      for (std::size_t c = 0; c < e.a.size(); ++c) {
        hessian[r][c] += scale * e.cost * e.a[r] * e.a[c];
      }
    }
  }
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    gradient[k] += 2 * problem.ridge * z[k];
    hessian[k][k] += 2 * problem.ridge;
  }
  for (std::size_t k = 0; k < hessian.size(); ++k) hessian[k][k] += 1e-9;
}

// Solves hessian x = rhs by Cholesky's method; the matrix is positive definite by its ridge.
Vector solve_newton(Matrix m, Vector x) {
  for (std::size_t c = 0; c < x.size(); ++c) {
    for (std::size_t k = 0; k < c; ++k) m[c][c] -= m[c][k] * m[c][k];
    m[c][c] = std::sqrt(std::max(m[c][c], 1e-12));
    for (std::size_t r = c + 1; r < x.size(); ++r) {
      for (std::size_t k = 0; k < c; ++k) m[r][c] -= m[r][k] * m[c][k];
      m[r][c] /= m[c][c];
    }
  }
  for (std::size_t r = 0; r < x.size(); ++r) {
    for (std::size_t k = 0; k < r; ++k) x[r] -= m[r][k] * x[k];
    x[r] /= m[r][r];
  }
  for (std::size_t r = x.size(); r-- > 0;) {
    for (std::size_t k = r + 1; k < x.size(); ++k) x[r] -= m[k][r] * x[k];
    x[r] /= m[r][r];
  }
  return x;
}

// Variables at their bound that the gradient would push outwards stay; the others take the Newton
// step, cut back to the bounds.
Vector minimise(const Problem& problem, Vector z) {
  double value = loss(problem, z);
  for (int iteration = 0; iteration < 200; ++iteration) {
    Vector gradient;
    Matrix hessian;
    derivatives(problem, z, gradient, hessian);
    Vector direction = gradient;
    for (std::size_t k = 0; k < z.size(); ++k) {
      if (z[k] > problem.lower[k] || gradient[k] < 0) continue;
      for (std::size_t c = 0; c < z.size(); ++c) hessian[k][c] = hessian[c][k] = 0;
      hessian[k][k] = 1;
      direction[k] = 0;
    }
    direction = solve_newton(hessian, direction);
    bool better = false;
    for (double length = 1; length > 1e-9 && !better; length /= 2) {
      Vector trial = z;
      for (std::size_t k = 0; k < z.size(); ++k) {
        trial[k] = std::max(problem.lower[k], z[k] - length * direction[k]);
      }
      const double trial_value = loss(problem, trial);
      better = trial_value < value * (1 - 1e-12);
      if (better) z = trial, value = trial_value;
    }
    if (!better) break;
  }
  return z;
}

Problem make_problem(const LabelledPairs& pairs, std::span<const int> chosen,
                     const std::array<double, kFeatureCount>& spread, const TrainConfig& config) {
  const auto label_at = [&](int k) -> const Label& {
    return pairs.labels[static_cast<std::size_t>(k)];
  };
  const auto answers =
      std::count_if(chosen.begin(), chosen.end(), [&](int k) { return label_at(k).by_person; });
  const auto from_film = std::ssize(chosen) - answers;
  const double film_weight =
      answers > 0 && from_film > 0 ? config.film_labels_worth / static_cast<double>(from_film) : 1;
  Problem problem;
  problem.ridge = config.ridge;
  problem.lower.back() = kMinThreshold;
  for (const int k : chosen) {
    const Label& label = label_at(k);
    const double y = label.acceptable ? 1 : -1, weight = label.by_person ? 1 : film_weight;
    Example e{{}, weight * (label.acceptable ? 1 : config.false_accept_cost)};
    const FeatureVector& f = pairs.vectors[static_cast<std::size_t>(k)];
    for (std::size_t n = 0; n < kFeatureCount; ++n)
      if (spread[n] > 0) e.a[n] = -y * static_cast<double>(f[n]) / spread[n];
    e.a.back() = y;
    problem.weight += weight;
    problem.examples.push_back(e);
  }
  return problem;
}

// First with u >= 0, then again with every weight held above its share of their sum.
Vector fit(Problem problem, const std::array<double, kFeatureCount>& spread,
           const TrainConfig& config) {
  Vector z{};
  z.back() = 1;
  z = minimise(problem, z);
  double sum = 0;
  for (std::size_t k = 0; k < kFeatureCount; ++k) sum += z[k];
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    problem.lower[k] = spread[k] > 0 ? config.floor * sum : 0;
    z[k] = std::max(z[k], problem.lower[k]);
  }
  return minimise(problem, z);
}

}  // namespace

float Classifier::distance(const FeatureVector& f) const noexcept {
  double sum = 0;
  for (std::size_t k = 0; k < f.size(); ++k) sum += weights[k] * static_cast<double>(f[k]);
  return static_cast<float>(sum / threshold);
}

LabelledPairs measure_pairs(const FeatureSet& set, std::vector<Label> labels) {
  LabelledPairs pairs{std::move(labels), {}};
  pairs.vectors.reserve(pairs.labels.size());
  for (const Label& l : pairs.labels) pairs.vectors.push_back(features(set, l.i, l.j));
  return pairs;
}

std::array<double, kFeatureCount> measure_spread(std::span<const FeatureVector> vectors) {
  std::array<double, kFeatureCount> sd{};
  const auto n = static_cast<double>(vectors.size());
  for (std::size_t k = 0; k < sd.size(); ++k) {
    double sum = 0, squares = 0;
    for (const FeatureVector& f : vectors) sum += static_cast<double>(f[k]);
    for (const FeatureVector& f : vectors) {
      const double d = static_cast<double>(f[k]) - sum / n;
      squares += d * d;
    }
    sd[k] = std::sqrt(squares / n);
  }
  return sd;
}

Classifier fit_classifier(const LabelledPairs& pairs, std::span<const int> chosen,
                          const std::array<double, kFeatureCount>& spread,
                          const TrainConfig& config) {
  const Vector z = fit(make_problem(pairs, chosen, spread, config), spread, config);
  Classifier classifier;
  for (std::size_t k = 0; k < kFeatureCount; ++k)
    classifier.weights[k] = spread[k] > 0 ? z[k] / spread[k] : 0;
  classifier.threshold = z.back();
  return classifier;
}

}  // namespace vsprite
