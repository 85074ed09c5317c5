// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/actions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "control/solve.h"

namespace vsprite {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kStayDiscount = 0.985, kHoldPrice = 1;

struct Problem {
  const CostTable& costs;
  std::span<const Sample> samples;
  std::uint16_t tag;
  std::vector<std::uint8_t> first;  // (N)

  std::span<const Transition> row(std::uint32_t i) const {
    return {costs.transitions.data() + costs.row_start[i],
            costs.row_start[i + 1] - costs.row_start[i]};
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(samples.size()); }
};

double shown_price(double t) { return std::max(t, t * t); }

// Samples by V, least first; each is final when it is taken out.
void solve_way(const Problem& p, double tau, ActionTable& table) {
  const std::uint32_t n = p.size();
  std::vector<std::vector<Transition>> into(n);  // .to: where the edge comes from
  for (std::uint32_t i = 0; i < n; ++i)
    for (const Transition& t : p.row(i)) into[t.to].push_back({i, t.cost});
  std::vector<double> value(n, kInfinity);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (std::uint32_t i = 0; i < n; ++i) {
    if (p.first[i] == 0) continue;
    open.push({value[i] = 0, i});
    table.next[i] = i;
  }
  while (!open.empty()) {
    const auto [reached, j] = open.top();
    open.pop();
    if (reached > value[j]) continue;
    for (const Transition& edge : into[j]) {
      const std::uint32_t i = edge.to;
      const double through = tau * p.samples[i].duration + double{edge.cost} + reached;
      if (!(through < value[i])) continue;
      value[i] = through;
      table.next[i] = j;
      open.push({through, i});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i)
    table.value[i] = p.costs.kept[i] != 0 ? static_cast<float>(value[i]) : 0.0f;
}

// W for m = 1, 2, .. from shorter deadlines.
void solve_deadlines(const Problem& p, std::uint32_t horizon, ActionTable& table) {
  const std::uint32_t n = p.size();
  std::vector<std::vector<double>> w(horizon + 1, std::vector<double>(n, kInfinity));
  for (std::uint32_t m = 1; m <= horizon; ++m) {
    for (std::uint32_t i = 0; i < n; ++i) {
      std::uint32_t& to = table.in_time[std::size_t{m - 1} * n + i];
      if (p.costs.kept[i] == 0) continue;
      if (p.first[i] != 0) {
        w[m][i] = 0, to = i;
        continue;
      }
      w[m][i] = shown_price(double{table.cut_cost[i]}), to = table.cut[i];
      const std::uint32_t lasts = p.samples[i].duration;
      if (m < lasts) continue;
      for (const Transition& t : p.row(i)) {
        const double then = p.first[t.to] != 0 ? 0 : w[m - lasts][t.to];
        const double cost = shown_price(double{t.cost}) + then;
        if (cost < w[m][i]) w[m][i] = cost, to = t.to;
      }
    }
  }
}

// Sweeps from the last sample to the first, since a film runs forward.
void solve_stay(const Problem& p, ActionTable& table) {
  const std::uint32_t n = p.size();
  std::vector<double> value(n, 0);
  const auto is_in = [&](std::uint32_t i) {
    return p.costs.kept[i] != 0 && p.samples[i].tag == p.tag;
  };
  for (int sweep = 0; sweep < 5000; ++sweep) {
    double change = 0;
    for (std::uint32_t i = n; i-- > 0;) {
      if (!is_in(i)) continue;
      double best = kHoldPrice + kStayDiscount * value[i];
      std::uint32_t to = i;
      for (const Transition& t : p.row(i)) {
        const double cost = double{t.cost} + kStayDiscount * value[t.to];
        if (is_in(t.to) && cost < best) best = cost, to = t.to;
      }
      change = std::max(change, std::fabs(best - value[i]));
      value[i] = best;
      table.stay[i] = to;
    }
    if (change < 1e-9) return;
  }
}

Error no_way(std::uint16_t tag, const std::string& what) {
  return {ErrorCode::BadContent, "tag " + std::to_string(tag) + ": " + what};
}

}  // namespace

std::vector<std::uint32_t> first_samples(std::span<const Sample> samples, std::uint16_t tag) {
  std::vector<std::uint32_t> firsts;
  for (std::uint32_t i = 0; i < samples.size(); ++i) {
    const Sample& s = samples[i];
    if (s.kept == 0 || s.tag != tag) continue;
    const bool goes_on = i > 0 && samples[i - 1].kept != 0 && samples[i - 1].clip == s.clip &&
                         samples[i - 1].tag == tag;
    if (!goes_on) firsts.push_back(i);
  }
  return firsts;
}

std::vector<Cut> find_cuts(const FeatureSet& set, const Classifier& classifier,
                           std::span<const Sample> samples, std::span<const std::uint32_t> firsts) {
  const auto distance = [&](int i, int j) {
    return double{classifier.distance(features(set, i, j))};
  };
  std::vector<Cut> cuts(samples.size());
  for (std::size_t s = 0; s < samples.size(); ++s) {
    if (samples[s].kept == 0) continue;
    const int i = static_cast<int>(s);
    double least = kInfinity;
    for (const std::uint32_t first : firsts) {
      const int j = static_cast<int>(first);
      const bool next = follows(set, i, i + 1), before = j > 0 && follows(set, j - 1, j);
      const double cost = next && before ? (distance(i, j - 1) + distance(i + 1, j)) / 2
                          : next         ? distance(i + 1, j)
                          : before       ? distance(i, j - 1)
                                         : distance(i, j);
      if (cost < least) least = cost, cuts[s] = {first, static_cast<float>(cost)};
    }
  }
  return cuts;
}

Result<ActionTable> solve_action(const CostTable& costs, std::span<const Sample> samples,
                                 std::uint16_t tag, std::span<const Cut> cuts,
                                 const ActionConfig& config) {
  if (!(config.tau >= 0.001 && config.tau <= 1e6))
    return detail::bad_setting("action-tau", config.tau, "0.001 or more");
  if (config.horizon < 1 || config.horizon > 64)
    return detail::bad_setting("horizon", config.horizon, "1 to 64");
  const std::size_t n = samples.size();
  const auto horizon = static_cast<std::uint32_t>(config.horizon);
  Problem problem{costs, samples, tag, std::vector<std::uint8_t>(n, 0)};
  const auto firsts = first_samples(samples, tag);
  if (firsts.empty()) return no_way(tag, "no sample of it was kept");
  for (const std::uint32_t first : firsts) problem.first[first] = 1;
  ActionTable table;
  table.tag = tag;
  table.value.assign(n, 0);
  table.cut_cost.assign(n, 0);
  table.next.assign(n, kNoSample);
  table.cut = table.stay = table.next;
  table.in_time.assign(n * horizon, kNoSample);
  for (std::size_t i = 0; i < n; ++i)
    if (costs.kept[i] != 0) table.cut[i] = cuts[i].to, table.cut_cost[i] = cuts[i].cost;
  solve_way(problem, config.tau, table);
  for (std::size_t i = 0; i < n; ++i)
    if (costs.kept[i] != 0 && !std::isfinite(table.value[i]))
      return no_way(tag, "sample " + std::to_string(i) + " does not lead there");
  solve_deadlines(problem, horizon, table);
  solve_stay(problem, table);
  return table;
}

}  // namespace vsprite
