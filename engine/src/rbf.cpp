// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Evaluation of networks (Poggio & Brunelli 1992, eq. 7-9), the nearest point of a convex hull
// (Wolfe, "Finding the nearest point in a polytope", 1976), and example sets with hysteresis.

#include "vsprite/rbf.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "elementary.h"

namespace vsprite {
namespace {

Error bad_network(const std::string& what) { return {ErrorCode::CorruptData, "network: " + what}; }

bool all_finite(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); });
}

double wrapped(const RbfNetwork& net, int d, double difference) noexcept {
  if (!net.is_cyclic(d)) return difference;
  const double period = net.period[static_cast<std::size_t>(d)];
  return difference - period * std::floor(difference / period + 0.5);
}

// --- the nearest point of a hull: y = sum of lambda_i p_i over a corral of at most D + 1 points

constexpr int kMost = kMaxHullDims + 1;
using Point = std::array<double, kMaxHullDims>;

double dot(const Point& a, const Point& b) noexcept {
  double sum = 0;
  for (std::size_t d = 0; d < a.size(); ++d) sum += a[d] * b[d];
  return sum;
}

struct Corral {
  int count = 0;
  std::array<Point, kMost + 1> points{};
  std::array<int, kMost + 1> index{};
  std::array<double, kMost + 1> lambda{};

  Point sum() const noexcept {
    Point y{};
    for (int i = 0; i < count; ++i)
      for (std::size_t d = 0; d < y.size(); ++d)
        y[d] += lambda[static_cast<std::size_t>(i)] * points[static_cast<std::size_t>(i)][d];
    return y;
  }
  void drop(int i) noexcept {
    for (int k = i; k + 1 < count; ++k) {
      const auto to = static_cast<std::size_t>(k), from = to + 1;
      points[to] = points[from], index[to] = index[from], lambda[to] = lambda[from];
    }
    --count;
  }
};

// The point of least norm of the corral's affine hull: (e e' + P'P) u = e, alpha = u / sum u.
// False: the corral is degenerate.
bool affine_minimum(const Corral& c, std::array<double, kMost + 1>& alpha) noexcept {
  std::array<std::array<double, kMost + 2>, kMost + 1> m{};
  const auto n = static_cast<std::size_t>(c.count);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) m[i][j] = 1 + dot(c.points[i], c.points[j]);
    m[i][n] = 1;
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    if (std::abs(m[pivot][k]) < 1e-13) return false;
    std::swap(m[k], m[pivot]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j <= n; ++j) m[i][j] -= factor * m[k][j];
    }
  }
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += alpha[i] = m[i][n] / m[i][i];
  if (!(std::abs(sum) > 1e-300)) return false;
  for (std::size_t i = 0; i < n; ++i) alpha[i] /= sum;
  return true;
}

// Moves lambda to the affine minimum, dropping points until it lies inside their hull.
bool settle(Corral& c) noexcept {
  constexpr double kTiny = 1e-12;
  while (true) {
    std::array<double, kMost + 1> alpha{};
    if (!affine_minimum(c, alpha)) return false;
    double theta = 1;
    int leaves = -1;
    for (int i = 0; i < c.count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (alpha[at] > kTiny) continue;
      const double step = c.lambda[at] / std::max(c.lambda[at] - alpha[at], 1e-300);
      if (leaves < 0 || step < theta) theta = step, leaves = i;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(c.count); ++i)
      c.lambda[i] += (leaves < 0 ? 1 : theta) * (alpha[i] - c.lambda[i]);
    if (leaves < 0) return true;
    c.drop(leaves);
  }
}

// The hull's points seen from x, in the metric: W (h - x), cyclic parameters left out.
Point seen_from(const RbfNetwork& net, std::span<const double> x, std::size_t h) noexcept {
  const auto dims = static_cast<std::size_t>(net.dims);
  Point difference{}, out{};
  for (std::size_t d = 0; d < dims; ++d)
    if (!net.is_cyclic(static_cast<int>(d))) difference[d] = net.hull[h * dims + d] - x[d];
  if (net.metric.empty()) return difference;
  for (std::size_t i = 0; i < dims; ++i)
    for (std::size_t d = 0; d < dims; ++d) out[i] += net.metric[i * dims + d] * difference[d];
  return out;
}

Corral nearest_corral(const RbfNetwork& net, std::span<const double> x) noexcept {
  const std::size_t count = net.hull.size() / static_cast<std::size_t>(net.dims);
  Corral c;
  double best = std::numeric_limits<double>::infinity(), scale = 0;
  for (std::size_t h = 0; h < count; ++h) {
    const Point p = seen_from(net, x, h);
    const double norm = dot(p, p);
    scale = std::max(scale, norm);
    if (norm < best) best = norm, c.points[0] = p, c.index[0] = static_cast<int>(h);
  }
  c.count = 1;
  c.lambda[0] = 1;
  for (int round = 0; round < 200; ++round) {
    const Point y = c.sum();
    double least = dot(y, y) - 1e-12 * scale;
    int enters = -1;
    Point entering{};
    for (std::size_t h = 0; h < count; ++h) {
      const Point p = seen_from(net, x, h);
      const double along = dot(y, p);
      if (along < least) least = along, enters = static_cast<int>(h), entering = p;
    }
    const auto end = c.index.begin() + c.count;
    if (enters < 0 || c.count > net.dims || std::find(c.index.begin(), end, enters) != end) break;
    const auto at = static_cast<std::size_t>(c.count);
    c.points[at] = entering, c.index[at] = enters, c.lambda[at] = 0;
    ++c.count;
    const Corral before = c;
    if (!settle(c)) {
      c = before;
      break;
    }
  }
  return c;
}

}  // namespace

std::string_view kernel_name(Kernel kernel) noexcept {
  constexpr std::array<std::string_view, kKernelCount> kNames{"linear", "gaussian", "thin-plate",
                                                              "multiquadric"};
  return kNames[static_cast<std::size_t>(kernel)];
}

double kernel_value(Kernel kernel, double s, double width) noexcept {
  switch (kernel) {
    case Kernel::Linear:
      return std::sqrt(s);
    case Kernel::Gaussian:
      return detail::portable_exp(-s / (width * width));
    case Kernel::ThinPlate:
      return s < 1e-300 ? 0 : s * detail::portable_log(s) / 2;
    case Kernel::Multiquadric:
      return std::sqrt(s + width * width);
  }
  return 0;
}

int RbfNetwork::term_count() const noexcept {
  if (degree < 1) return degree + 1;
  int terms = 1;
  for (int d = 0; d < dims; ++d) terms += !is_cyclic(d);
  return terms;
}

Result<RbfNetwork> make_rbf_network(RbfNetwork parts) {
  if (parts.dims < 1 || parts.dims > kMaxNetworkDims || parts.outputs < 1 ||
      parts.outputs > 4 * kMaxNetworkDims)
    return bad_network(std::to_string(parts.dims) + " parameters and " +
                       std::to_string(parts.outputs) + " outputs");
  if (static_cast<int>(parts.kernel) >= kKernelCount || parts.degree < -1 || parts.degree > 1)
    return bad_network("kernel " + std::to_string(static_cast<int>(parts.kernel)) +
                       " with degree " + std::to_string(parts.degree));
  if (!(parts.width > 0) || !std::isfinite(parts.width))
    return bad_network("width " + std::to_string(parts.width) + ", a positive one is due");
  const auto dims = static_cast<std::size_t>(parts.dims),
             outputs = static_cast<std::size_t>(parts.outputs);
  const std::size_t count = parts.centers.size() / dims;
  const auto check = [&](const char* name, const std::vector<double>& array, std::size_t due) {
    if (array.size() != due)
      return Result<void>(bad_network(std::string(name) + " has " + std::to_string(array.size()) +
                                      " numbers, " + std::to_string(due) + " are due"));
    if (!all_finite(array))
      return Result<void>(bad_network(std::string(name) + " holds a number that is not finite"));
    return Result<void>();
  };
  if (auto ok = check("period", parts.period, parts.period.empty() ? 0 : dims); !ok)
    return ok.error();
  if (auto ok = check("metric", parts.metric, parts.metric.empty() ? 0 : dims * dims); !ok)
    return ok.error();
  if (auto ok = check("centers", parts.centers, count * dims); !ok) return ok.error();
  if (auto ok = check("weights", parts.weights, count * outputs); !ok) return ok.error();
  const auto terms = static_cast<std::size_t>(parts.term_count());
  if (auto ok = check("polynomial", parts.polynomial, terms * outputs); !ok) return ok.error();
  if (auto ok = check("hull", parts.hull, parts.hull.size() / dims * dims); !ok) return ok.error();
  if (!parts.hull.empty() && parts.dims > kMaxHullDims)
    return bad_network("hull of " + std::to_string(parts.dims) + " parameters, at most 8 are due");
  return parts;
}

double squared_distance(const RbfNetwork& net, std::span<const double> x,
                        std::span<const double> t) noexcept {
  const int dims = net.dims;
  double s = 0;
  if (net.metric.empty()) {
    for (int d = 0; d < dims; ++d) {
      const auto at = static_cast<std::size_t>(d);
      const double difference = wrapped(net, d, x[at] - t[at]);
      s += difference * difference;
    }
    return s;
  }
  for (int i = 0; i < dims; ++i) {
    const double* row = net.metric.data() + static_cast<std::ptrdiff_t>(i) * dims;
    double sum = 0;
    for (int d = 0; d < dims; ++d) {
      const auto at = static_cast<std::size_t>(d);
      sum += row[at] * wrapped(net, d, x[at] - t[at]);
    }
    s += sum * sum;
  }
  return s;
}

void predict(const RbfNetwork& net, std::span<const double> x, std::span<double> out) noexcept {
  const auto dims = static_cast<std::size_t>(net.dims),
             outputs = static_cast<std::size_t>(net.outputs);
  assert(x.size() == dims && out.size() == outputs);
  std::fill(out.begin(), out.end(), 0.0);
  const auto add = [&](double factor, const double* row) {
    for (std::size_t m = 0; m < outputs; ++m) out[m] += factor * row[m];
  };
  const double* term = net.polynomial.data();
  if (net.degree >= 0) add(1, term), term += outputs;
  for (std::size_t d = 0; net.degree == 1 && d < dims; ++d)
    if (!net.is_cyclic(static_cast<int>(d))) add(x[d], term), term += outputs;
  const auto count = static_cast<std::size_t>(net.center_count());
  for (std::size_t k = 0; k < count; ++k) {
    const double s = squared_distance(net, x, {net.centers.data() + k * dims, dims});
    add(kernel_value(net.kernel, s, net.width), net.weights.data() + k * outputs);
  }
}

double clamp_to_hull(const RbfNetwork& net, std::span<double> x) noexcept {
  if (net.hull.empty()) return 0;
  const auto dims = static_cast<std::size_t>(net.dims);
  const Corral c = nearest_corral(net, x);
  const Point y = c.sum();
  const double moved = std::sqrt(dot(y, y));
  double reach = 0;
  for (int i = 0; i < c.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    reach = std::max(reach, std::sqrt(dot(c.points[at], c.points[at])));
  }
  if (moved <= 1e-9 * reach) return 0;  // inside: stays exactly as it is
  for (std::size_t d = 0; d < dims; ++d) {
    if (net.is_cyclic(static_cast<int>(d))) continue;
    double at = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(c.count); ++i)
      at += c.lambda[i] * net.hull[static_cast<std::size_t>(c.index[i]) * dims + d];
    x[d] = at;
  }
  return moved;
}

int choose_set(std::span<const ExampleSet> sets, std::span<const double> x, int current) noexcept {
  const auto outside = [&](std::size_t i) {
    Point at{};
    std::copy(x.begin(), x.end(), at.begin());
    return clamp_to_hull(sets[i].net, std::span(at).first(x.size()));
  };
  const auto from_median = [&](std::size_t i) {
    return squared_distance(sets[i].net, x, sets[i].median);
  };
  int best = -1;
  double best_outside = 0, best_median = 0;
  const auto offer = [&](std::size_t i) {
    const double gap = outside(i), median = from_median(i);
    if (best >= 0 && (gap > best_outside || (gap == best_outside && median >= best_median))) return;
    best = static_cast<int>(i), best_outside = gap, best_median = median;
  };
  if (current < 0 || static_cast<std::size_t>(current) >= sets.size()) {
    for (std::size_t i = 0; i < sets.size(); ++i) offer(i);
    return best;
  }
  const auto now = static_cast<std::size_t>(current);
  if (outside(now) == 0) return current;
  for (const std::uint32_t i : sets[now].joins)
    if (i < sets.size() && outside(i) == 0) offer(i);
  return best < 0 ? current : best;
}

}  // namespace vsprite
