// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// HyperBF (Poggio & Brunelli 1992, eq. 8-9 and section 4.1): few centres t and a norm W that move.
// Departs in one point: instead of letting c flow down the gradient beside t and W, c is solved for
// at every step, where its gradient is zero; what is left for t and W is the gradient of the best
// error (variable projection).

#include <cmath>

#include "synthesis/rbf_system.h"
#include "vsprite/random.h"

namespace vsprite {
namespace {

constexpr double kFloor = 1e-10;  // keeps c bounded where two centres meet

struct State {
  RbfNetwork net;
  Eigen::MatrixXd residual;  // (N, M) y - f(x)
  double error = 0;          // H
};

void solve_coefficients(const Examples& examples, const RbfConfig& config, State& state) {
  const Eigen::MatrixXd phi = detail::design(examples, state.net), y = detail::targets(examples);
  Eigen::MatrixXd normal = phi.transpose() * phi;
  for (Eigen::Index k = 0; k < state.net.center_count(); ++k) normal(k, k) += config.ridge + kFloor;
  const Eigen::MatrixXd c = normal.fullPivLu().solve(phi.transpose() * y);
  detail::put_coefficients(c, state.net.center_count(), state.net);
  state.residual = y - phi * c;
  state.error = state.residual.squaredNorm();
}

// dG/ds.
double kernel_slope(Kernel kernel, double s, double width) {
  switch (kernel) {
    case Kernel::Linear:
      return s > 0 ? 0.5 / std::sqrt(s) : 0;
    case Kernel::Gaussian:
      return -kernel_value(kernel, s, width) / (width * width);
    case Kernel::ThinPlate:
      return s > 0 ? kernel_value(kernel, s, width) / s + 0.5 : 0;  // (ln s + 1) / 2
    case Kernel::Multiquadric:
      return 0.5 / std::sqrt(s + width * width);
  }
  return 0;
}

// dH/dt and dH/dW: with e = y - f, H = sum e'e, q = W (x - t), s = q'q,
//   dH/dt_k = sum_i -2 (e_i . c_k) G'(s) (-2 W'q),   dH/dW = sum_ik -2 (e_i . c_k) G'(s) 2 q (x -
//   t)'
Eigen::VectorXd gradient(const Examples& examples, const State& state) {
  const RbfNetwork& net = state.net;
  const Eigen::Index dims = net.dims, centers = net.center_count(), outputs = net.outputs;
  Eigen::MatrixXd w(dims, dims);
  for (Eigen::Index i = 0; i < dims * dims; ++i)
    w(i / dims, i % dims) = net.metric[static_cast<std::size_t>(i)];
  Eigen::MatrixXd by_t = Eigen::MatrixXd::Zero(centers, dims);
  Eigen::MatrixXd by_w = Eigen::MatrixXd::Zero(dims, dims);
  Eigen::VectorXd difference(dims);
  for (Eigen::Index i = 0; i < examples.count(); ++i) {
    for (Eigen::Index k = 0; k < centers; ++k) {
      for (Eigen::Index d = 0; d < dims; ++d) {
        difference(d) = examples.x[static_cast<std::size_t>(i * dims + d)] -
                        net.centers[static_cast<std::size_t>(k * dims + d)];
        if (!net.is_cyclic(static_cast<int>(d))) continue;
        const double period = net.period[static_cast<std::size_t>(d)];
        difference(d) -= period * std::floor(difference(d) / period + 0.5);
      }
      const Eigen::VectorXd q = w * difference;
      double along = 0;
      for (Eigen::Index m = 0; m < outputs; ++m)
        along += state.residual(i, m) * net.weights[static_cast<std::size_t>(k * outputs + m)];
      const double factor = -4 * along * kernel_slope(net.kernel, q.squaredNorm(), net.width);
      by_t.row(k) -= factor * (w.transpose() * q).transpose();
      by_w += factor * q * difference.transpose();
    }
  }
  Eigen::VectorXd out(centers * dims + dims * dims);
  for (Eigen::Index i = 0; i < centers * dims; ++i) out(i) = by_t(i / dims, i % dims);
  for (Eigen::Index i = 0; i < dims * dims; ++i) out(centers * dims + i) = by_w(i / dims, i % dims);
  return out;
}

State moved(const Examples& examples, const RbfConfig& config, const State& from,
            const Eigen::VectorXd& step) {
  State out{from.net, {}, 0};
  const std::size_t centers = out.net.centers.size();
  for (std::size_t i = 0; i < static_cast<std::size_t>(step.size()); ++i)
    (i < centers ? out.net.centers[i] : out.net.metric[i - centers]) +=
        step(static_cast<Eigen::Index>(i));
  solve_coefficients(examples, config, out);
  return out;
}

// One step of 1 in every coordinate: of a centre, in units of its parameter that |d|_W measures 1;
// of an entry of W, the size of its column. Parameters may have any unit.
Eigen::VectorXd step_units(const RbfNetwork& net) {
  const auto dims = static_cast<std::size_t>(net.dims);
  std::vector<double> column(dims, 0);
  for (std::size_t i = 0; i < net.metric.size(); ++i)
    column[i % dims] = std::hypot(column[i % dims], net.metric[i]);
  Eigen::VectorXd out(static_cast<Eigen::Index>(net.centers.size() + net.metric.size()));
  for (std::size_t i = 0; i < static_cast<std::size_t>(out.size()); ++i) {
    const double size = std::max(column[i % dims], 1e-12);
    out(static_cast<Eigen::Index>(i)) = i < net.centers.size() ? 1 / size : size;
  }
  return out;
}

// Down the gradient, with a step of its own for every coordinate that grows while the slope keeps
// its sign and halves when it turns (Rprop, Riedmiller & Braun 1993): t and W differ in scale.
State descend(const Examples& examples, const HyperConfig& config, State state) {
  State best = state;
  const Eigen::Index size =
      static_cast<Eigen::Index>(state.net.centers.size() + state.net.metric.size());
  const Eigen::VectorXd unit = step_units(state.net);
  Eigen::VectorXd reach = 0.02 * unit, before = Eigen::VectorXd::Zero(size);
  for (int k = 0; k < config.steps; ++k) {
    Eigen::VectorXd slope = gradient(examples, state), step(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      const double turn = slope(i) * before(i);
      if (turn > 0) reach(i) = std::min(0.5 * unit(i), 1.2 * reach(i));
      if (turn < 0) reach(i) = std::max(1e-9 * unit(i), 0.5 * reach(i)), slope(i) = 0;
      step(i) = slope(i) > 0 ? -reach(i) : slope(i) < 0 ? reach(i) : 0;
    }
    before = slope;
    state = moved(examples, config.rbf, state, step);
    if (state.error < best.error) best = state;
  }
  return best;
}

// Sum of four uniforms: near enough to a bell.
double bell(Random& random) {
  double sum = -2;
  for (int k = 0; k < 4; ++k) sum += random.unit();
  return sum * 1.7;
}

State wander(const Examples& examples, const HyperConfig& config, State state) {
  Random random{config.seed};
  const Eigen::VectorXd unit = step_units(state.net);
  State best = state;
  double reach = 0.3;
  const Eigen::Index size =
      static_cast<Eigen::Index>(state.net.centers.size() + state.net.metric.size());
  for (int k = 0; k < config.steps; ++k) {
    Eigen::VectorXd step(size);
    for (Eigen::Index i = 0; i < size; ++i) step(i) = reach * unit(i) * bell(random);
    const State next = moved(examples, config.rbf, state, step);
    const double left = 1 - static_cast<double>(k) / config.steps;
    const double heat = config.temperature * left * left * best.error;
    const double rise = next.error - state.error;
    const bool takes =
        rise < 0 || (heat > 0 && random.unit() < kernel_value(Kernel::Gaussian, rise / heat, 1));
    if (takes) state = next;
    if (state.error < best.error) best = state;
    reach = std::min(1.0, std::max(1e-4, reach * (takes ? 1.2 : 0.93)));
  }
  return best;
}

// The first example, then always the one farthest from those taken.
void spread_centers(const Examples& examples, int count, RbfNetwork& net) {
  const auto dims = static_cast<std::size_t>(examples.dims);
  const auto n = static_cast<std::size_t>(examples.count());
  std::vector<double> gap(n, HUGE_VAL);
  std::size_t next = 0;
  for (int k = 0; k < count; ++k) {
    const double* t = &examples.x[next * dims];
    net.centers.insert(net.centers.end(), t, t + dims);
    const std::size_t taken = next;
    next = 0;
    for (std::size_t i = 0; i < n; ++i) {
      gap[i] = std::min(gap[i], squared_distance(net, {&examples.x[i * dims], dims},
                                                 {&examples.x[taken * dims], dims}));
      if (gap[i] > gap[next]) next = i;
    }
  }
}

}  // namespace

Result<HyperFit> fit_hyperbf(const Examples& examples, const HyperConfig& config) {
  // What makes examples or settings bad is the same as for exact interpolation.
  RbfConfig checked = config.rbf;
  checked.pseudo_inverse = true;
  if (const auto tried = fit_rbf(examples, checked); !tried) return tried.error();
  if (config.centers < 1 || config.centers > examples.count())
    return Error{ErrorCode::BadSetting, "centers " + std::to_string(config.centers) + ": 1 to " +
                                            std::to_string(examples.count()) + " are due"};
  State state{detail::empty_network(examples, config.rbf), {}, 0};
  const int dims = examples.dims;
  if (state.net.metric.empty())
    for (int i = 0; i < dims * dims; ++i) state.net.metric.push_back(i % (dims + 1) == 0 ? 1 : 0);
  spread_centers(examples, config.centers, state.net);
  solve_coefficients(examples, config.rbf, state);
  HyperFit out;
  out.first_error = state.error;
  state = config.training == HyperTraining::Gradient ? descend(examples, config, std::move(state))
                                                     : wander(examples, config, std::move(state));
  out.error = state.error;
  if (dims <= kMaxHullDims) state.net.hull = hull_corners(examples, config.rbf);
  auto net = make_rbf_network(std::move(state.net));
  if (!net) return net.error();
  out.net = std::move(*net);
  return out;
}

}  // namespace vsprite
