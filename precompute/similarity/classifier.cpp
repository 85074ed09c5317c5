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
constexpr int kGap = 15;                       // samples left out around a held-out block of time
constexpr double kMinThreshold = 0.05;         // of b, whose natural size is 1

using Vector = std::array<double, kVariables>;
using Matrix = std::array<Vector, kVariables>;

// One labelled pair: margin = y (b - u . x) = a . (u, b).
struct Example {
  Vector a{};
  double cost = 1;
  bool acceptable = false;
  int i = 0, j = 0;
};

struct Problem {
  std::vector<const Example*> examples;
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
  for (const Example* e : problem.examples) {
    const double slack = 1 - dot(e->a, z);
    if (slack > 0) sum += e->cost * slack * slack;
  }
  sum /= static_cast<double>(problem.examples.size());
  for (std::size_t k = 0; k < kFeatureCount; ++k) sum += problem.ridge * z[k] * z[k];
  return sum;
}

void derivatives(const Problem& problem, const Vector& z, Vector& gradient, Matrix& hessian) {
  gradient = {};
  hessian = {};
  const double scale = 2 / static_cast<double>(problem.examples.size());
  for (const Example* e : problem.examples) {
    const double slack = 1 - dot(e->a, z);
    if (slack <= 0) continue;
    for (std::size_t r = 0; r < e->a.size(); ++r) {
      gradient[r] -= scale * e->cost * slack * e->a[r];
      for (std::size_t c = 0; c < e->a.size(); ++c) {
        hessian[r][c] += scale * e->cost * e->a[r] * e->a[c];
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

// First with u >= 0, then again with every weight held above its share of their sum.
Vector fit(const std::vector<const Example*>& examples, const std::array<double, kFeatureCount>& sd,
           const TrainConfig& config) {
  Problem problem{examples, config.ridge, {}};
  problem.lower.back() = kMinThreshold;
  Vector z{};
  z.back() = 1;
  z = minimise(problem, z);
  double sum = 0;
  for (std::size_t k = 0; k < kFeatureCount; ++k) sum += z[k];
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    problem.lower[k] = sd[k] > 0 ? config.floor * sum : 0;
    z[k] = std::max(z[k], problem.lower[k]);
  }
  return minimise(problem, z);
}

// The fold of every sample: whole clips, longest first, each to the fold with the fewest samples;
// or blocks of time.
std::vector<int> make_folds(const FeatureSet& set, int folds) {
  struct Clip {
    int clip = 0;
    std::size_t begin = 0, size = 0;
  };
  const std::size_t n = set.rows.size(), parts = static_cast<std::size_t>(folds);
  std::vector<Clip> clips;
  for (std::size_t i = 0; i < n; ++i) {
    if (clips.empty() || clips.back().clip != set.rows[i].clip)
      clips.push_back({set.rows[i].clip, i, 0});
    ++clips.back().size;
  }
  std::stable_sort(clips.begin(), clips.end(),
                   [](const Clip& a, const Clip& b) { return a.size > b.size; });
  std::vector<int> fold(n);
  if (clips.size() < parts || 2 * clips.front().size > n) {
    for (std::size_t i = 0; i < n; ++i) fold[i] = static_cast<int>(i * parts / n);
    return fold;
  }
  std::vector<std::size_t> filled(parts, 0);
  for (const Clip& clip : clips) {
    const auto least = std::min_element(filled.begin(), filled.end());
    *least += clip.size;
    std::fill_n(fold.begin() + static_cast<std::ptrdiff_t>(clip.begin), clip.size,
                static_cast<int>(least - filled.begin()));
  }
  return fold;
}

// True if the sample lies in fold `held`, or in the same clip within kGap samples of it.
bool touches(const FeatureSet& set, const std::vector<int>& fold, int sample, int held) {
  const int n = static_cast<int>(fold.size());
  const auto at = static_cast<std::size_t>(sample);
  for (int s = std::max(0, sample - kGap); s <= std::min(n - 1, sample + kGap); ++s) {
    const auto k = static_cast<std::size_t>(s);
    if (fold[k] == held && set.rows[k].clip == set.rows[at].clip) return true;
  }
  return false;
}

bool has_both_classes(const std::vector<const Example*>& examples) {
  const auto acceptable = [](const Example* e) { return e->acceptable; };
  return std::any_of(examples.begin(), examples.end(), acceptable) &&
         !std::all_of(examples.begin(), examples.end(), acceptable);
}

Confusion cross_validate(const FeatureSet& set, const std::vector<Example>& examples,
                         const std::array<double, kFeatureCount>& sd, const TrainConfig& config) {
  Confusion held_out;
  const std::vector<int> fold = make_folds(set, config.folds);
  for (int held = 0; held < config.folds; ++held) {
    std::vector<const Example*> training, test;
    for (const Example& e : examples) {
      if (fold[static_cast<std::size_t>(e.i)] == held) test.push_back(&e);
      if (!touches(set, fold, e.i, held) && !touches(set, fold, e.j, held)) training.push_back(&e);
    }
    if (test.empty() || !has_both_classes(training)) continue;
    const Vector z = fit(training, sd, config);
    for (const Example* e : test) {
      const double margin = dot(e->a, z);
      int& count = e->acceptable ? (margin >= 0 ? held_out.true_accept : held_out.false_reject)
                                 : (margin > 0 ? held_out.true_reject : held_out.false_accept);
      ++count;
    }
  }
  return held_out;
}

std::array<double, kFeatureCount> measure_spread(const std::vector<FeatureVector>& vectors) {
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

Result<void> check(const FeatureSet& set, std::span<const Label> labels,
                   const TrainConfig& config) {
  if (!(config.false_accept_cost > 0) || !(config.ridge > 0) || !(config.floor >= 0) ||
      !(config.floor <= 0.1) || config.folds < 2) {
    return Error{ErrorCode::BadSetting,
                 "train: false_accept_cost and ridge must be above 0, floor in 0..0.1, folds at "
                 "least 2; correct the setting"};
  }
  const auto acceptable =
      std::count_if(labels.begin(), labels.end(), [](const Label& l) { return l.acceptable; });
  const bool none_good = acceptable == 0;
  if (none_good || acceptable == std::ssize(labels)) {
    return Error{ErrorCode::BadContent,
                 "train: " + std::to_string(labels.size()) + " labelled pairs of " +
                     std::to_string(set.samples.size()) + " samples hold " +
                     (none_good ? "no acceptable pair" : "no unacceptable pair") +
                     ", at least one of each kind is due; film the subject for longer and let it "
                     "take different poses"};
  }
  return {};
}

}  // namespace

float Classifier::distance(const FeatureVector& f) const noexcept {
  double sum = 0;
  for (std::size_t k = 0; k < f.size(); ++k) sum += weights[k] * static_cast<double>(f[k]);
  return static_cast<float>(sum / threshold);
}

Result<Training> train(const FeatureSet& set, std::span<const Label> labels,
                       const TrainConfig& config) {
  if (auto ok = check(set, labels, config); !ok) return ok.error();
  std::vector<FeatureVector> vectors;
  for (const Label& l : labels) vectors.push_back(features(set, l.i, l.j));

  Training result;
  result.spread = measure_spread(vectors);
  std::vector<Example> examples;
  for (std::size_t n = 0; n < labels.size(); ++n) {
    const double y = labels[n].acceptable ? 1 : -1;
    Example e{{},
              labels[n].acceptable ? 1 : config.false_accept_cost,
              labels[n].acceptable,
              labels[n].i,
              labels[n].j};
    for (std::size_t k = 0; k < kFeatureCount; ++k) {
      if (result.spread[k] > 0) e.a[k] = -y * static_cast<double>(vectors[n][k]) / result.spread[k];
    }
    e.a.back() = y;
    examples.push_back(e);
  }
  std::vector<const Example*> all;
  for (const Example& e : examples) all.push_back(&e);

  const Vector z = fit(all, result.spread, config);
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    result.classifier.weights[k] = result.spread[k] > 0 ? z[k] / result.spread[k] : 0;
  }
  result.classifier.threshold = z.back();
  result.held_out = cross_validate(set, examples, result.spread, config);
  return result;
}

}  // namespace vsprite
