// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// NIPS section 2, last paragraph. The paper keeps every accepted transition; here only the part
// from which there is always a way on is kept, and rows are bounded.
#include "similarity/transitions.h"

#include <algorithm>
#include <limits>
#include <map>
#include <queue>
#include <tuple>
#include <utility>

namespace vsprite {
namespace {

constexpr std::uint32_t kUnseen = std::numeric_limits<std::uint32_t>::max();

std::size_t sample_count(const CostTable& graph) { return graph.row_start.size() - 1; }

std::span<const Transition> row_of(const CostTable& graph, std::size_t i) {
  return {graph.transitions.data() + graph.row_start[i],
          graph.row_start[i + 1] - graph.row_start[i]};
}

// Rows of D, both triangles and the diagonal, ascending; `cost` is D.
CostTable symmetric_rows(std::size_t n, std::span<const PairDistance> pairs) {
  CostTable d;
  d.row_start.assign(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i) ++d.row_start[i + 1];
  for (const PairDistance& p : pairs) ++d.row_start[p.i + 1], ++d.row_start[p.j + 1];
  for (std::size_t i = 0; i < n; ++i) d.row_start[i + 1] += d.row_start[i];
  d.transitions.resize(d.row_start[n]);
  std::vector<std::uint32_t> fill(d.row_start.begin(), d.row_start.end() - 1);
  // Pairs ascend by (i, j): first what is left of the diagonal, then the diagonal, then the rest.
  for (const PairDistance& p : pairs) d.transitions[fill[p.j]++] = {p.i, p.distance};
  for (std::size_t i = 0; i < n; ++i) d.transitions[fill[i]++] = {static_cast<std::uint32_t>(i), 0};
  for (const PairDistance& p : pairs) d.transitions[fill[p.i]++] = {p.j, p.distance};
  return d;
}

// T_ij = (D_i,j-1 + D_i+1,j) / 2 for every j whose two pairs are accepted: row i of D, moved one
// sample on, merged with row i+1.
CostTable make_transitions(const FeatureSet& set, const CostTable& d,
                           const TransitionConfig& config) {
  const std::size_t n = sample_count(d);
  CostTable graph;
  graph.row_start.assign(1, 0);
  for (std::size_t s = 0; s < n; ++s) {
    const int i = static_cast<int>(s);
    if (follows(set, i, i + 1)) {
      const int min_back = shortest_jump_back(set, i, config.min_back);
      const auto before = row_of(d, s), after = row_of(d, s + 1);
      auto b = after.begin();
      for (const Transition& a : before) {
        const std::uint32_t to = a.to + 1;
        while (b != after.end() && b->to < to) ++b;
        if (b == after.end()) break;
        const int j = static_cast<int>(to), back = i - j;
        if (b->to != to || !follows(set, j - 1, j)) continue;
        if (back >= 0 && back < min_back && set.rows[s].clip == set.rows[to].clip) continue;
        const float worse = std::max(a.cost, b->cost);
        const float cost = worse > 1 ? config.near_miss_price * worse : (a.cost + b->cost) / 2;
        graph.transitions.push_back({to, j == i + 1 ? 0.0f : cost});
      }
    }
    graph.row_start.push_back(static_cast<std::uint32_t>(graph.transitions.size()));
  }
  return graph;
}

// The transitions of accepted pairs: a near miss costs more than 1, they do not.
CostTable accepted_part(const CostTable& graph) {
  CostTable part;
  part.row_start.assign(1, 0);
  for (std::size_t i = 0; i < sample_count(graph); ++i) {
    for (const Transition& t : row_of(graph, i)) {
      if (t.cost <= 1) part.transitions.push_back(t);
    }
    part.row_start.push_back(static_cast<std::uint32_t>(part.transitions.size()));
  }
  return part;
}

// The graph with joins in it; a join in the place of a dearer transition takes it.
CostTable with_joins(const CostTable& graph, std::span<const TagJoin> joins) {
  CostTable result;
  result.row_start.assign(1, 0);
  auto join = joins.begin();
  for (std::size_t i = 0; i < sample_count(graph); ++i) {
    const auto row = row_of(graph, i);
    auto t = row.begin();
    while (t != row.end() || (join != joins.end() && join->from == i)) {
      const bool join_next =
          join != joins.end() && join->from == i && (t == row.end() || join->to <= t->to);
      if (!join_next) {
        result.transitions.push_back(*t++);
        continue;
      }
      result.transitions.push_back({join->to, join->cost});
      if (t != row.end() && t->to == join->to) {
        result.transitions.back().cost = std::min(join->cost, t->cost), ++t;
      }
      ++join;
    }
    result.row_start.push_back(static_cast<std::uint32_t>(result.transitions.size()));
  }
  return result;
}

CostTable reversed(const CostTable& graph) {
  const std::size_t n = sample_count(graph);
  CostTable back;
  back.kept = graph.kept;
  back.row_start.assign(n + 1, 0);
  for (const Transition& t : graph.transitions) ++back.row_start[t.to + 1];
  for (std::size_t i = 0; i < n; ++i) back.row_start[i + 1] += back.row_start[i];
  back.transitions.resize(graph.transitions.size());
  std::vector<std::uint32_t> fill(back.row_start.begin(), back.row_start.end() - 1);
  for (std::size_t i = 0; i < n; ++i) {
    for (const Transition& t : row_of(graph, i)) {
      back.transitions[fill[t.to]++] = {static_cast<std::uint32_t>(i), t.cost};
    }
  }
  return back;
}

// The largest part with an edge inside; ties: the one with the lowest sample number; of a cast the
// part that holds its tags. Empty if none.
std::vector<std::uint8_t> largest_part(const CostTable& graph, int tagged) {
  const Components parts = find_components(graph);
  std::vector<std::uint32_t> size(parts.count, 0);
  std::vector<std::uint8_t> has_edge(parts.count, 0);
  for (std::size_t i = 0; i < parts.of.size(); ++i) {
    ++size[parts.of[i]];
    for (const Transition& t : row_of(graph, i)) {
      if (parts.of[t.to] == parts.of[i]) has_edge[parts.of[i]] = 1;
    }
  }
  std::uint32_t best = kUnseen;
  for (std::size_t i = 0; i < parts.of.size(); ++i) {
    const std::uint32_t part = parts.of[i];
    if (has_edge[part] && (best == kUnseen || size[part] > size[best])) best = part;
  }
  if (tagged >= 0) {
    const std::uint32_t part = parts.of[static_cast<std::size_t>(tagged)];
    best = has_edge[part] ? part : kUnseen;
  }
  std::vector<std::uint8_t> kept(parts.of.size(), 0);
  if (best == kUnseen) return {};
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = parts.of[i] == best;
  return kept;
}

CostTable restricted(const CostTable& graph, const std::vector<std::uint8_t>& kept) {
  CostTable part;
  part.kept = kept;
  part.row_start.assign(1, 0);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    for (const Transition& t : row_of(graph, i)) {
      if (kept[i] && kept[t.to]) part.transitions.push_back(t);
    }
    part.row_start.push_back(static_cast<std::uint32_t>(part.transitions.size()));
  }
  return part;
}

using Edge = std::pair<std::uint32_t, Transition>;  // from, transition

// Edges of `full` that must join `capped` for every kept sample to be reached from `root`, cheapest
// first (Prim's order, in which an edge of `capped` is free).
std::vector<Edge> missing_edges(const CostTable& capped, const CostTable& full,
                                std::uint32_t root) {
  using Offer = std::tuple<float, std::uint32_t, std::uint32_t>;  // cost, from, to
  std::priority_queue<Offer, std::vector<Offer>, std::greater<>> offers;
  std::vector<std::uint8_t> seen(sample_count(full), 0);
  std::vector<std::uint32_t> stack;
  std::vector<Edge> missing;
  const auto flood = [&](std::uint32_t from) {
    stack.push_back(from);
    seen[from] = 1;
    while (!stack.empty()) {
      const std::uint32_t i = stack.back();
      stack.pop_back();
      for (const Transition& t : row_of(capped, i)) {
        if (!seen[t.to]) seen[t.to] = 1, stack.push_back(t.to);
      }
      for (const Transition& t : row_of(full, i)) {
        if (!seen[t.to]) offers.emplace(t.cost, i, t.to);
      }
    }
  };
  flood(root);
  while (!offers.empty()) {
    const auto [cost, from, to] = offers.top();
    offers.pop();
    if (seen[to]) continue;
    missing.push_back({from, {to, cost}});
    flood(to);
  }
  return missing;
}

// True where neither neighbour on the diagonal is cheaper: (i - 1, j - 1) and (i + 1, j + 1) are
// the same jump a frame sooner and later. Ties: the first.
bool is_minimum(const FeatureSet& set, const CostTable& graph, std::size_t i, const Transition& t) {
  const auto cost = [&](std::size_t from, std::uint32_t to) {
    const auto row = row_of(graph, from);
    const auto at = std::lower_bound(row.begin(), row.end(), to,
                                     [](const Transition& a, std::uint32_t b) { return a.to < b; });
    return at != row.end() && at->to == to ? at->cost : std::numeric_limits<float>::infinity();
  };
  const int a = static_cast<int>(i), b = static_cast<int>(t.to);
  if (follows(set, a, b)) return true;
  if (follows(set, a - 1, a) && follows(set, b - 1, b) && cost(i - 1, t.to - 1) <= t.cost) {
    return false;
  }
  return !(follows(set, a, a + 1) && follows(set, b, b + 1) && cost(i + 1, t.to + 1) < t.cost);
}

// The cheapest `limit` of every row (ties: the lowest sample) and natural continuation; then the
// cheapest edges without which the part would fall apart.
CostTable capped_rows(const FeatureSet& set, const CostTable& full, std::span<const TagJoin> joins,
                      const TransitionConfig& config) {
  const auto limit = static_cast<std::size_t>(config.max_per_sample);
  const std::size_t n = sample_count(full);
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = row_of(full, i);
    std::vector<Transition> cheapest(row.begin(), row.end());
    if (config.minima) {
      std::erase_if(cheapest, [&](const Transition& t) { return !is_minimum(set, full, i, t); });
    }
    if (cheapest.size() > limit) {
      const auto rank = [&](const Transition& t) {
        const bool natural = follows(set, static_cast<int>(i), static_cast<int>(t.to));
        return std::tuple(!natural, t.cost, t.to);
      };
      std::sort(cheapest.begin(), cheapest.end(),
                [&](const Transition& a, const Transition& b) { return rank(a) < rank(b); });
      const bool natural = std::get<0>(rank(cheapest.front())) == false;
      cheapest.resize(std::min(cheapest.size(), limit + (natural ? 1 : 0)));
    }
    for (const Transition& t : cheapest) edges.push_back({static_cast<std::uint32_t>(i), t});
  }
  for (const TagJoin& join : joins) edges.push_back({join.from, {join.to, join.cost}});
  const auto build = [&] {
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
      return std::tie(a.first, a.second.to, a.second.cost) <
             std::tie(b.first, b.second.to, b.second.cost);
    });
    edges.erase(std::unique(edges.begin(), edges.end(),
                            [](const Edge& a, const Edge& b) {
                              return a.first == b.first && a.second.to == b.second.to;
                            }),
                edges.end());
    CostTable table;
    table.kept = full.kept;
    table.row_start.assign(n + 1, 0);
    for (const Edge& e : edges)
      ++table.row_start[e.first + 1], table.transitions.push_back(e.second);
    for (std::size_t i = 0; i < n; ++i) table.row_start[i + 1] += table.row_start[i];
    return table;
  };
  CostTable capped = build();
  const auto root = static_cast<std::uint32_t>(std::find(full.kept.begin(), full.kept.end(), 1) -
                                               full.kept.begin());
  for (const Edge& e : missing_edges(capped, full, root)) edges.push_back(e);
  capped = build();
  for (const Edge& e : missing_edges(reversed(capped), reversed(full), root)) {
    edges.push_back({e.second.to, {e.first, e.second.cost}});
  }
  return build();
}

std::vector<std::uint8_t> reached_from(const CostTable& graph, std::vector<std::uint8_t> seen) {
  std::vector<std::uint32_t> stack;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i]) stack.push_back(static_cast<std::uint32_t>(i));
  }
  while (!stack.empty()) {
    const std::uint32_t i = stack.back();
    stack.pop_back();
    for (const Transition& t : row_of(graph, i)) {
      if (!seen[t.to]) seen[t.to] = 1, stack.push_back(t.to);
    }
  }
  return seen;
}

void count_lost(const FeatureSet& set, const CostTable& graph,
                const std::vector<std::uint8_t>& kept, TransitionStats& stats) {
  const std::vector<std::uint8_t> leads_in = reached_from(reversed(graph), kept);
  for (std::size_t s = 0; s < kept.size(); ++s) {
    const int i = static_cast<int>(s);
    if (kept[s]) {
      ++stats.kept;
    } else if (!follows(set, i, i + 1) || !follows(set, i - 1, i)) {
      ++stats.lost_clip_end;
    } else if (!leads_in[s]) {
      ++stats.lost_dead_end;
    } else {
      ++stats.lost_unreachable;
    }
  }
}

// Transitions that are no continuation, per second of kept film.
double count_jumps(const FeatureSet& set, const CostTable& table) {
  double seconds = 0;
  std::uint64_t jumps = 0;
  for (std::size_t i = 0; i < sample_count(table); ++i) {
    if (!table.kept[i]) continue;
    seconds += set.rows[i].duration / set.fps;
    for (const Transition& t : row_of(table, i)) {
      jumps += follows(set, static_cast<int>(i), static_cast<int>(t.to)) ? 0 : 1;
    }
  }
  return seconds > 0 ? static_cast<double>(jumps) / seconds : 0;
}

int first_tagged(const FeatureSet& set) {
  for (std::size_t i = 0; i < set.rows.size(); ++i) {
    if (!set.rows[i].tag.empty()) return static_cast<int>(i);
  }
  return -1;
}

std::string share(int part, std::size_t whole) {
  const auto percent = (200 * static_cast<std::size_t>(part) + whole) / (2 * whole);
  return std::to_string(part) + " of " + std::to_string(whole) + " samples (" +
         std::to_string(percent) + " %)";
}

// One sentence for each way of getting lost that took more than 10 % of the film.
void give_reasons(std::size_t n, TransitionStats& stats) {
  const std::size_t lost = n - static_cast<std::size_t>(stats.kept);
  if (10 * lost <= n) return;
  stats.reasons.push_back(share(static_cast<int>(lost), n) +
                          " are lost, because no endless run of frames passes through them");
  const auto name = [&](int count, const std::string& what) {
    if (10 * static_cast<std::size_t>(count) > n) stats.reasons.push_back(share(count, n) + what);
  };
  name(stats.lost_dead_end,
       " lead nowhere: from there on nothing looks like an earlier frame; film the subject coming "
       "back to a pose that it had before");
  name(stats.lost_unreachable,
       " are never reached: nothing leads back to what happens there; film that action twice");
  name(stats.lost_clip_end,
       " begin or end a clip; film longer takes in which the subject stays in the picture");
}

}  // namespace

// Tarjan's algorithm with an explicit stack: a film of 30,000 samples may be one long path.
Components find_components(const CostTable& graph) {
  const std::size_t n = sample_count(graph);
  Components parts{std::vector<std::uint32_t>(n, kUnseen), 0};
  std::vector<std::uint32_t> order(n, kUnseen), low(n, 0), open,
      edge(graph.row_start.begin(), graph.row_start.end());
  std::vector<std::uint32_t> path;
  std::uint32_t time = 0;
  for (std::uint32_t root = 0; root < n; ++root) {
    if (order[root] != kUnseen) continue;
    path.push_back(root);
    while (!path.empty()) {
      const std::uint32_t i = path.back();
      if (order[i] == kUnseen) {
        order[i] = low[i] = time++;
        open.push_back(i);
      }
      if (edge[i] < graph.row_start[i + 1]) {
        const std::uint32_t to = graph.transitions[edge[i]++].to;
        if (order[to] == kUnseen) {
          path.push_back(to);
        } else if (parts.of[to] == kUnseen) {
          low[i] = std::min(low[i], order[to]);
        }
        continue;
      }
      path.pop_back();
      if (!path.empty()) low[path.back()] = std::min(low[path.back()], low[i]);
      if (low[i] != order[i]) continue;
      for (std::uint32_t member = kUnseen; member != i;) {
        member = open.back();
        open.pop_back();
        parts.of[member] = parts.count;
      }
      ++parts.count;
    }
  }
  return parts;
}

Result<CostTable> make_cost_table(const FeatureSet& set, std::span<const PairDistance> pairs,
                                  const TransitionConfig& config, TransitionStats& stats,
                                  const Classifier* classifier) {
  if (config.max_per_sample < 1 || config.min_back < 1 || !(config.near_miss >= 0) ||
      !(config.near_miss_price > 1)) {
    return Error{ErrorCode::BadSetting,
                 "transitions: max_per_sample and min_back must be at least 1, near_miss at least "
                 "0 and its price above 1; correct the setting"};
  }
  const std::uint64_t n = set.samples.size();
  const std::uint64_t compared = stats.compared;
  stats = {};
  stats.compared = compared;
  stats.pairs = n * (n - (n > 0)) / 2;
  for (const PairDistance& p : pairs) ++(p.distance <= 1 ? stats.accepted : stats.near_misses);
  CostTable graph = make_transitions(set, symmetric_rows(n, pairs), config);
  const int tagged = classifier ? first_tagged(set) : -1;
  CostTable part;  // of `graph`, where it is not all of it: memory counts here
  if (stats.near_misses > 0) part = accepted_part(graph);
  if (tagged >= 0) {
    const CostTable& plain = stats.near_misses > 0 ? part : graph;
    stats.joins = find_joins(set, *classifier, plain, config.min_back);
    part = with_joins(plain, stats.joins);
    graph = with_joins(graph, stats.joins);
  }
  const CostTable& accepted = stats.near_misses > 0 || tagged >= 0 ? part : graph;
  const std::vector<std::uint8_t> kept = largest_part(accepted, tagged);
  if (kept.empty()) {
    return Error{ErrorCode::BadContent,
                 "transitions: none of " + std::to_string(accepted.transitions.size()) +
                     " transitions among " + std::to_string(n) +
                     " samples leads back to an earlier frame, at least one is due for an endless "
                     "run; film the subject coming back to a pose that it had before"};
  }
  CostTable table = capped_rows(set, restricted(graph, kept), stats.joins, config);
  count_lost(set, accepted, kept, stats);
  give_reasons(n, stats);
  stats.transitions = table.transitions.size();
  stats.jumps_per_second = count_jumps(set, table);
  return table;
}

std::vector<std::uint8_t> needed_transitions(const CostTable& costs,
                                             std::span<const std::string> tags) {
  const auto root = std::find(costs.kept.begin(), costs.kept.end(), 1) - costs.kept.begin();
  if (root == static_cast<std::ptrdiff_t>(costs.kept.size())) return {};
  std::vector<std::uint8_t> needed(costs.transitions.size(), 0);
  const auto need = [&](std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t e = costs.row_start[from]; e < costs.row_start[from + 1]; ++e)
      if (costs.transitions[e].to == to) needed[e] = 1;
  };
  std::map<std::pair<std::string, std::string>, std::tuple<float, std::uint32_t, std::uint32_t>>
      ways;
  CostTable free;  // continuations, which no cap cuts
  free.row_start.assign(1, 0);
  for (std::uint32_t i = 0; i < sample_count(costs); ++i) {
    for (const Transition& t : row_of(costs, i)) {
      if (t.to == i + 1 && t.cost == 0) free.transitions.push_back(t);
      if (tags[i] == tags[t.to] || tags[i].empty() || tags[t.to].empty()) continue;
      const std::tuple way(t.cost, i, t.to);
      const auto [at, fresh] = ways.try_emplace({tags[i], tags[t.to]}, way);
      at->second = std::min(at->second, way);
    }
    free.row_start.push_back(static_cast<std::uint32_t>(free.transitions.size()));
  }
  for (const auto& [between, way] : ways) need(std::get<1>(way), std::get<2>(way));
  const auto first = static_cast<std::uint32_t>(root);
  for (const Edge& e : missing_edges(free, costs, first)) need(e.first, e.second.to);
  for (const Edge& e : missing_edges(reversed(free), reversed(costs), first))
    need(e.second.to, e.first);
  return needed;
}

std::vector<float> skip_costs(const FeatureSet& set, const Classifier& classifier,
                              std::span<const std::uint8_t> kept) {
  const int n = static_cast<int>(set.samples.size());
  std::vector<float> costs(set.samples.size(), std::numeric_limits<float>::infinity());
  for (int i = 0; i + 2 < n; ++i) {
    const auto s = static_cast<std::size_t>(i);
    if (kept[s] == 0 || kept[s + 2] == 0 || !follows(set, i, i + 1) || !follows(set, i + 1, i + 2))
      continue;
    costs[s] = (classifier.distance(features(set, i, i + 1)) +
                classifier.distance(features(set, i + 1, i + 2))) /
               2;
  }
  return costs;
}

}  // namespace vsprite
