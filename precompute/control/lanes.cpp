// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Policy iteration in lanes. Departures from the textbook: improvement works in place, so that one
// sweep carries news through a whole clip; it compares single precision values from which an offset
// was taken, and keeps a choice that is not clearly beaten, since ties would cycle for ever.
#include "control/lanes.h"

#include <algorithm>
#include <cmath>

#include "vsprite/sprite.h"

// One more body of a kernel for CPUs with AVX2. It gives the same bits: no lane meets another and
// nothing is contracted. (Thread sanitizer runs before the choice could be made.)
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define VSPRITE_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define VSPRITE_CLONES
#endif

namespace vsprite {
namespace {

using Vector = float __attribute__((vector_size(4 * kLanes)));
using Mask = std::int32_t __attribute__((vector_size(4 * kLanes)));
using Wide = double __attribute__((vector_size(8 * kLanes), aligned(8)));

constexpr int kMaxSweeps = 10000;  // never met: a policy is improved 10..20 times
constexpr double kTie = 1e-6;      // share of the value within which choices are equally good
constexpr float kInfinite = std::numeric_limits<float>::infinity();

// Everything a sweep touches, as plain pointers.
struct SweepView {
  const std::uint32_t* row_start;
  const std::uint32_t* to;
  const float* price;
  std::size_t count;
  const Vector* arrive;
  const std::uint8_t* exits;  // or null
  Vector discount, shift;     // shift: (1 - b) offset
  Vector* value;              // V - offset
  Vector* go;                 // c_j + b (V'_j - offset)
  std::uint32_t* policy;
};

// The cheapest edge of a row in one lane; of equals the first.
std::uint32_t cheapest_edge(const SweepView& v, std::size_t i, std::size_t lane) {
  const float* go = reinterpret_cast<const float*>(v.go);
  float best = kInfinite;
  std::uint32_t edge = kNoEdge;
  for (std::uint32_t e = v.row_start[i]; e < v.row_start[i + 1]; ++e) {
    const float f = v.price[e] + go[v.to[e] * kLanes + lane];
    if (f < best) best = f, edge = e;
  }
  return edge;
}

// Lanes whose choice the minimum of the row beats clearly get a new one. What was chosen is worth
// less now than when it was evaluated, if anything, so most rows end at the first test.
std::size_t choose(const SweepView& v, std::size_t i, const float* best, const float* before) {
  const float* go = reinterpret_cast<const float*>(v.go);
  std::size_t changed = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const float slack = 2e-6f * (1 + std::fabs(best[lane]));
    std::uint32_t& edge = v.policy[i * kLanes + lane];
    if (edge != kNoEdge) {
      if (!(best[lane] < before[lane] - slack)) continue;
      if (!(best[lane] < v.price[edge] + go[v.to[edge] * kLanes + lane] - slack)) continue;
    }
    edge = cheapest_edge(v, i, lane);
    ++changed;
  }
  return changed;
}

VSPRITE_CLONES std::size_t sweep(const SweepView& v) {
  std::size_t changed = 0;
  const Vector infinite = Vector{} + kInfinite;
  for (std::size_t i = v.count; i-- > 0;) {
    const std::uint32_t first = v.row_start[i], last = v.row_start[i + 1];
    if (first == last) continue;
    Vector best = infinite, other = infinite;
    std::uint32_t e = first;
    for (; e + 1 < last; e += 2) {
      const Vector f = v.go[v.to[e]] + v.price[e], g = v.go[v.to[e + 1]] + v.price[e + 1];
      best = f < best ? f : best;
      other = g < other ? g : other;
    }
    if (e < last) {
      const Vector f = v.go[v.to[e]] + v.price[e];
      best = f < best ? f : best;
    }
    best = other < best ? other : best;
    const Vector before = v.value[i] + v.shift;
    const Mask better = best < before - 2e-6f;
    std::int32_t any = v.policy[i * kLanes] == kNoEdge;
    for (std::size_t lane = 0; lane < kLanes; ++lane) any |= better[lane];
    if (any == 0) continue;
    float best_of[kLanes], before_of[kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      best_of[lane] = best[lane];
      before_of[lane] = before[lane];
    }
    const bool fresh = v.policy[i * kLanes] == kNoEdge;
    changed += choose(v, i, best_of, before_of);
    const Vector now = fresh ? best : best < before ? best : before;
    const Vector value = now - v.shift;
    const Vector go = v.arrive[i] + v.discount * value;
    v.value[i] = value;
    if (v.exits == nullptr || v.exits[i] == 0) {
      v.go[i] = go;
    } else {
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        if ((v.exits[i] >> lane & 1) == 0) v.go[i][lane] = go[lane];
    }
  }
  return changed;
}

// Storage that the vectors of a view may point into.
struct Aligned {
  explicit Aligned(std::size_t count) : bytes(count * sizeof(Vector) + 63) {}
  Vector* get() {
    const auto at = reinterpret_cast<std::uintptr_t>(bytes.data());
    return reinterpret_cast<Vector*>((at + 63) / 64 * 64);
  }
  std::vector<std::uint8_t> bytes;
};

// One lane's policy as a chain: where each sample leads, and what that costs.
struct Chain {
  std::vector<std::uint32_t> to;
  std::vector<double> cost;
  std::vector<double> value;
  std::vector<std::uint8_t> state;
  std::vector<std::uint32_t> walk;
};
enum : std::uint8_t { kUnseen, kOnWalk, kKnown };

// Follows the chain from every unknown sample until a known one, or until the walk meets itself:
// then on the cycle i_0 .. i_(m-1)
//     V(i_0) = sum_q b^q c(i_q) / (1 - b^m),
// and everything before follows by V(i) = c(i) + b V(to(i)).
void evaluate_chain(Chain& chain, double discount) {
  for (std::uint32_t start = 0; start < chain.to.size(); ++start) {
    if (chain.state[start] == kKnown) continue;
    chain.walk.clear();
    std::uint32_t i = start;
    while (chain.state[i] == kUnseen) {
      chain.state[i] = kOnWalk;
      chain.walk.push_back(i);
      i = chain.to[i];
    }
    if (chain.state[i] == kOnWalk) {
      double sum = 0, power = 1;
      std::uint32_t q = i;
      do {
        sum += power * chain.cost[q];
        power *= discount;
        q = chain.to[q];
      } while (q != i);
      chain.value[i] = sum / (1 - power);
      chain.state[i] = kKnown;
    }
    for (std::size_t k = chain.walk.size(); k-- > 0;) {
      const std::uint32_t w = chain.walk[k];
      if (chain.state[w] == kKnown) continue;
      chain.value[w] = chain.cost[w] + discount * chain.value[chain.to[w]];
      chain.state[w] = kKnown;
    }
  }
}

// Eight doubles at a time; see best_of_rows.
VSPRITE_CLONES void row_minima(const Edges& edges, const double* go_of, double* values,
                               std::uint32_t* to) {
  const Wide* go = reinterpret_cast<const Wide*>(go_of);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const std::uint32_t first = edges.row_start[i], last = edges.row_start[i + 1];
    Wide best = Wide{} + std::numeric_limits<double>::infinity();
    for (std::uint32_t e = first; e < last; ++e) {
      const Wide f = go[edges.to[e]] + static_cast<double>(edges.price[e]);
      best = f < best ? f : best;
    }
    const Wide limit = best + kTie * (best + 1);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      values[i * kLanes + lane] = best[lane];
      to[i * kLanes + lane] = kNoSample;
    }
    std::size_t open = first < last ? kLanes : 0;
    for (std::uint32_t e = first; open > 0 && e < last; ++e) {
      const Wide f = go[edges.to[e]] + static_cast<double>(edges.price[e]);
      const auto hit = f <= limit;
      std::int64_t any = 0;
      for (std::size_t lane = 0; lane < kLanes; ++lane) any |= hit[lane];
      if (any == 0) continue;
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        std::uint32_t& chosen = to[i * kLanes + lane];
        if (hit[lane] != 0 && chosen == kNoSample) chosen = edges.to[e], --open;
      }
    }
  }
}

}  // namespace

Edges make_edges(const CostTable& costs, std::span<const float> skip_costs,
                 const PriceConfig& config) {
  Edges edges;
  edges.row_start.assign(1, 0);
  const auto price_of = [&](double t) { return static_cast<float>(config.power == 2 ? t * t : t); };
  for (std::size_t i = 0; i + 1 < costs.row_start.size(); ++i) {
    const std::span row(costs.transitions.data() + costs.row_start[i],
                        costs.row_start[i + 1] - costs.row_start[i]);
    float cheapest = kInfinite;
    for (const Transition& t : row) cheapest = std::min(cheapest, t.cost);
    const double limit = std::max(config.cap, static_cast<double>(cheapest));
    const bool skips = config.skip_price >= 0 && i < skip_costs.size() &&
                       static_cast<double>(skip_costs[i]) <= config.cap && !row.empty();
    const auto add = [&](std::uint32_t to, float price) {
      edges.to.push_back(to);
      edges.price.push_back(price);
    };
    bool open = skips;
    const auto next_but_one = static_cast<std::uint32_t>(i + 2);
    const float skip = skips ? price_of(config.skip_price * static_cast<double>(skip_costs[i])) : 0;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const Transition& t = row[k];
      if (open && t.to >= next_but_one) add(next_but_one, skip), open = false;
      if (skips && t.to == next_but_one) continue;
      const bool needed = !costs.needed.empty() && costs.needed[costs.row_start[i] + k] != 0;
      if (needed || static_cast<double>(t.cost) <= limit) add(t.to, price_of(static_cast<double>(t.cost)));
    }
    if (open) add(next_but_one, skip);
    edges.row_start.push_back(static_cast<std::uint32_t>(edges.to.size()));
  }
  return edges;
}

void start(const Edges& edges, Lanes& lanes) {
  lanes.values.assign(edges.size() * kLanes, 0);
  lanes.policy.assign(edges.size() * kLanes, kNoEdge);
}

std::size_t improve(const Edges& edges, Lanes& lanes) {
  const std::size_t n = edges.size();
  Aligned arrive(n), value(n), go(n);
  SweepView view{edges.row_start.data(),
                 edges.to.data(),
                 edges.price.data(),
                 n,
                 arrive.get(),
                 lanes.exits.empty() ? nullptr : lanes.exits.data(),
                 Vector{} + static_cast<float>(lanes.discount),
                 Vector{},
                 value.get(),
                 go.get(),
                 lanes.policy.data()};
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    view.shift[lane] = static_cast<float>((1 - lanes.discount) * lanes.offset[lane]);
  std::copy(lanes.arrive.begin(), lanes.arrive.end(), reinterpret_cast<float*>(arrive.get()));
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t at = j * kLanes + lane;
      const bool exits = view.exits != nullptr && (view.exits[j] >> lane & 1) != 0;
      const double behind = exits ? (*lanes.beyond)[at] : lanes.values[at];
      view.value[j][lane] = static_cast<float>(lanes.values[at] - lanes.offset[lane]);
      view.go[j][lane] = lanes.arrive[at] + static_cast<float>(lanes.discount) *
                                                static_cast<float>(behind - lanes.offset[lane]);
    }
  }
  return sweep(view);
}

void evaluate(const Edges& edges, Lanes& lanes) {
  const std::size_t n = edges.size();
  Chain chain;
  chain.to.resize(n);
  chain.cost.resize(n);
  chain.value.resize(n);
  chain.state.resize(n);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t edge = lanes.policy[i * kLanes + lane];
      if (edge == kNoEdge) {
        chain.value[i] = std::numeric_limits<double>::infinity();
        chain.state[i] = kKnown;
        continue;
      }
      const std::uint32_t j = edges.to[edge];
      const std::size_t at = j * kLanes + lane;
      chain.to[i] = j;
      chain.cost[i] =
          static_cast<double>(edges.price[edge]) + static_cast<double>(lanes.arrive[at]);
      const bool leaves = !lanes.exits.empty() && (lanes.exits[j] >> lane & 1) != 0;
      chain.state[i] = leaves ? kKnown : kUnseen;
      if (leaves) chain.value[i] = chain.cost[i] + lanes.discount * (*lanes.beyond)[at];
    }
    evaluate_chain(chain, lanes.discount);
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < n; ++i) {
      lanes.values[i * kLanes + lane] = chain.value[i];
      lowest = std::min(lowest, chain.value[i]);
    }
    lanes.offset[lane] = std::isfinite(lowest) ? lowest : 0;
  }
}

void solve_lanes(const Edges& edges, Lanes& lanes) {
  for (int k = 0; k < kMaxSweeps; ++k) {
    if (improve(edges, lanes) == 0) break;
    evaluate(edges, lanes);
  }
}

void best_of_rows(const Edges& edges, const LaneDoubles& go, LaneDoubles& values,
                  std::vector<std::uint32_t>& to) {
  values.resize(edges.size() * kLanes);
  to.resize(edges.size() * kLanes);
  row_minima(edges, go.data(), values.data(), to.data());
}

}  // namespace vsprite
