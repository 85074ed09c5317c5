// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// NIPS section 4: equation 2 by policy iteration instead of the paper's literal iteration, which
// needs about ln(1/eps) / (1 - alpha) sweeps. Departure: standing costs pi (DESIGN section 2), or
// the sprite would stand for ever, since the angle of a resting sample means nothing.
#include "control/solve.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace vsprite {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxSweeps = 10000;  // never met: a policy is improved 10..20 times

// The transitions under the cap, as a mode sees them.
struct Graph {
  std::vector<std::uint32_t> row_start;
  std::vector<Transition> edges;
  std::size_t size() const { return row_start.size() - 1; }
};

Graph cap_costs(const CostTable& costs, double cap) {
  Graph graph;
  graph.row_start.assign(1, 0);
  for (std::size_t i = 0; i + 1 < costs.row_start.size(); ++i) {
    float cheapest = std::numeric_limits<float>::infinity();
    for (std::uint32_t e = costs.row_start[i]; e < costs.row_start[i + 1]; ++e) {
      cheapest = std::min(cheapest, costs.transitions[e].cost);
    }
    const double limit = std::max(cap, static_cast<double>(cheapest));
    for (std::uint32_t e = costs.row_start[i]; e < costs.row_start[i + 1]; ++e) {
      const Transition& t = costs.transitions[e];
      if (static_cast<double>(t.cost) <= limit) graph.edges.push_back(t);
    }
    graph.row_start.push_back(static_cast<std::uint32_t>(graph.edges.size()));
  }
  return graph;
}

// The best edge out of i for given costs per state and values behind; `best` may hold an action
// that is kept unless another is strictly better. Value is +inf where the row is empty.
struct Choice {
  double value = kInfinity;
  std::uint32_t to = kNoSample;
  double cost = 0;  // T + w1 a of the step
};
template <class Values>
Choice best_edge(const Graph& graph, std::span<const double> state_cost, double alpha,
                 const Values& values, std::size_t i) {
  Choice best;
  for (std::uint32_t e = graph.row_start[i]; e < graph.row_start[i + 1]; ++e) {
    const Transition& t = graph.edges[e];
    const double cost = static_cast<double>(t.cost) + state_cost[t.to];
    const double f = cost + alpha * static_cast<double>(values[t.to]);
    if (f < best.value) best = {f, t.to, cost};
  }
  return best;
}

struct Policy {
  std::vector<std::uint32_t> to;
  std::vector<double> cost;  // T + w1 a of the step
};

// V of a policy, exactly. Follow the policy from an unvisited sample until a known one, or until
// the walk meets itself: then on the cycle i_0 .. i_(m-1)
//     V(i_0) = sum_q alpha^q c(i_q) / (1 - alpha^m),
// and everything before follows by V(i) = c(i) + alpha V(to(i)).
void evaluate(const Policy& policy, double alpha, std::vector<double>& values) {
  enum : std::uint8_t { Unseen, OnWalk, Known };
  std::vector<std::uint8_t> state(values.size(), Unseen);
  std::vector<std::uint32_t> walk;
  for (std::uint32_t start = 0; start < values.size(); ++start) {
    if (policy.to[start] == kNoSample || state[start] == Known) continue;
    walk.clear();
    std::uint32_t i = start;
    while (state[i] == Unseen) {
      state[i] = OnWalk;
      walk.push_back(i);
      i = policy.to[i];
    }
    if (state[i] == OnWalk) {
      double sum = 0, power = 1;
      std::uint32_t q = i;
      do {
        sum += power * policy.cost[q];
        power *= alpha;
        q = policy.to[q];
      } while (q != i);
      values[i] = sum / (1 - power);
      state[i] = Known;
    }
    for (std::size_t k = walk.size(); k-- > 0;) {
      const std::uint32_t w = walk[k];
      if (state[w] == Known) continue;
      values[w] = policy.cost[w] + alpha * values[policy.to[w]];
      state[w] = Known;
    }
  }
}

// V of the constrained table: Howard's policy iteration, improved in place from the last sample to
// the first (a film runs forward, so values travel backwards), until no action changes.
std::vector<double> solve_constrained(const Graph& graph, std::span<const double> state_cost,
                                      double alpha) {
  const std::size_t n = graph.size();
  std::vector<double> values(n, 0);
  Policy policy{std::vector<std::uint32_t>(n, kNoSample), std::vector<double>(n, 0)};
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    bool changed = false;
    for (std::size_t i = n; i-- > 0;) {
      const Choice best = best_edge(graph, state_cost, alpha, values, i);
      if (best.to == kNoSample) continue;
      const double now =
          policy.to[i] == kNoSample ? kInfinity : policy.cost[i] + alpha * values[policy.to[i]];
      if (!(best.value < now - 1e-12 * (1 + now)) && policy.to[i] != kNoSample) {
        values[i] = now;
        continue;
      }
      policy.to[i] = best.to;
      policy.cost[i] = best.cost;
      values[i] = best.value;
      changed = true;
    }
    if (!changed) break;
    evaluate(policy, alpha, values);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (policy.to[i] == kNoSample) values[i] = kInfinity;
  }
  return values;
}

// The state costs of one direction's constrained table: w1 a_j(l).
std::vector<double> state_costs(std::span<const Vec2> velocities, double v0, Direction direction,
                                double w1) {
  std::vector<double> costs;
  costs.reserve(velocities.size());
  for (const Vec2& v : velocities) costs.push_back(w1 * direction_cost(v, v0, direction));
  return costs;
}

// Stores V as float, then reads next and the residual off the stored values, so that both hold for
// what is in the file. `behind`: the values that the table looks up; itself for the constrained
// one.
double finish_table(const Graph& graph, std::span<const double> state_cost, double alpha,
                    std::span<const float> behind, std::span<const float> values,
                    std::span<std::uint32_t> next) {
  double residual = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Choice best = best_edge(graph, state_cost, alpha, behind, i);
    next[i] = best.to;
    if (best.to == kNoSample) continue;
    residual = std::max(residual, std::fabs(best.value - static_cast<double>(values[i])));
  }
  return residual;
}

// One direction: the constrained table, then the chain V^1 .. V^K on top of it.
double solve_direction(const Graph& graph, const std::vector<double>& state_cost, double alpha,
                       std::size_t stages, std::span<float> values, std::span<std::uint32_t> next) {
  const std::size_t n = graph.size();
  const std::vector<double> free_cost(n, 0);
  const std::vector<double> constrained = solve_constrained(graph, state_cost, alpha);
  for (std::size_t i = 0; i < n; ++i) values[i] = static_cast<float>(constrained[i]);
  double residual =
      finish_table(graph, state_cost, alpha, values.first(n), values.first(n), next.first(n));
  for (std::size_t k = 1; k < stages; ++k) {
    const auto behind = values.subspan((k - 1) * n, n), here = values.subspan(k * n, n);
    for (std::size_t i = 0; i < n; ++i) {
      here[i] = static_cast<float>(best_edge(graph, free_cost, alpha, behind, i).value);
    }
    residual = std::max(
        residual, finish_table(graph, free_cost, alpha, behind, here, next.subspan(k * n, n)));
  }
  return residual;
}

Result<void> check(const CostTable& costs, std::span<const Vec2> velocities, double v0,
                   const SolveConfig& config) {
  const auto bad = [](const std::string& name, double found, const std::string& due) {
    return Error{ErrorCode::BadSetting, "solve: " + name + " is " + std::to_string(found) + ", " +
                                            due + " is due; correct the setting"};
  };
  if (!(config.alpha >= 0 && config.alpha < 1)) {
    return bad("alpha", config.alpha, "a number from 0 to below 1");
  }
  if (!(config.w1 >= 0 && config.w1 < 1e6)) return bad("w1", config.w1, "0 to 1000000");
  if (!(config.cap > 0)) return bad("cap", config.cap, "a number above 0");
  if (config.free_steps < 0 || config.free_steps > 10) {
    return bad("free_steps", config.free_steps, "0 to 10");
  }
  if (!(v0 > 0)) return bad("v0", v0, "a speed above 0");
  assert(costs.row_start.size() == velocities.size() + 1);
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    bool sound = costs.kept[i] == 0 || costs.row_start[i] < costs.row_start[i + 1];
    for (std::uint32_t e = costs.row_start[i]; e < costs.row_start[i + 1]; ++e) {
      const Transition& t = costs.transitions[e];
      sound = sound && t.to < velocities.size() && costs.kept[t.to] && t.cost >= 0;
    }
    if (!sound) {
      return Error{ErrorCode::BadContent,
                   "solve: the transitions of sample " + std::to_string(i) +
                       " do not lead on, one into the kept part is due; run `vsprite transitions` "
                       "again"};
    }
  }
  return {};
}

}  // namespace

double direction_cost(Vec2 velocity, double v0, Direction direction) noexcept {
  const auto x = static_cast<double>(velocity.x), y = static_cast<double>(velocity.y);
  const double f = std::min(1.0, std::sqrt(x * x + y * y) / v0);
  if (direction == Direction::None) return 0;
  if (direction == Direction::Rest) return kPi * f * f;
  // The heading is in (-pi, pi], the command in [0, 2 pi): up to 11/4 pi apart before wrapping.
  const double apart = std::fabs(angle_of(x, y) - static_cast<int>(direction) * (kPi / 4));
  const double d = apart > 2 * kPi ? apart - 2 * kPi : apart;
  return f * (d > kPi ? 2 * kPi - d : d) + (1 - f) * kPi;
}

double default_w1(const CostTable& costs) {
  std::vector<float> jumps;
  for (const Transition& t : costs.transitions) {
    if (t.cost > 0) jumps.push_back(t.cost);
  }
  if (jumps.empty()) return 0.6;
  const auto middle = jumps.begin() + std::ssize(jumps) / 2;
  std::nth_element(jumps.begin(), middle, jumps.end());
  return 2.5 * static_cast<double>(*middle) / kPi;
}

Result<Solution> solve(const CostTable& costs, std::span<const Vec2> velocities, double v0,
                       const SolveConfig& config, int jobs) {
  if (auto ok = check(costs, velocities, v0, config); !ok) return ok.error();
  const Graph graph = cap_costs(costs, config.cap);
  const std::size_t n = graph.size(), stages = static_cast<std::size_t>(config.free_steps) + 1;
  Solution solution;
  solution.stages = config.free_steps + 1;
  solution.w1 = config.w1 > 0 ? config.w1 : default_w1(costs);
  solution.values.resize(kDirectionCount * stages * n);
  solution.next.resize(kDirectionCount * stages * n);
  std::vector<double> residuals(kDirectionCount, 0);
  tbb::task_arena arena(jobs > 0 ? jobs : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(0, kDirectionCount, [&](int d) {
      const std::size_t start = static_cast<std::size_t>(d) * stages * n;
      residuals[static_cast<std::size_t>(d)] = solve_direction(
          graph, state_costs(velocities, v0, static_cast<Direction>(d), solution.w1), config.alpha,
          stages, std::span(solution.values).subspan(start, stages * n),
          std::span(solution.next).subspan(start, stages * n));
    });
  });
  solution.residual = *std::max_element(residuals.begin(), residuals.end());
  solution.error_bound = solution.residual / (1 - config.alpha);
  return solution;
}

}  // namespace vsprite
