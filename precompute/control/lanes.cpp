// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Policy iteration in lanes. Departures from the textbook: improvement works in place, so that one
// sweep carries news through a whole clip; it compares single precision values from which an offset
// was taken, and keeps a choice that is not clearly beaten, since ties would cycle for ever.
#include "control/lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

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
using Halves = std::int64_t __attribute__((vector_size(4 * kLanes)));
using Wide = double __attribute__((vector_size(8 * kLanes), aligned(8), may_alias));
using Loose = float __attribute__((vector_size(4 * kLanes), aligned(4), may_alias));

constexpr int kMaxSweeps = 10000;           // never met: a policy is improved 10..20 times
constexpr std::uint32_t kMostSeen = 24;     // choices that are remembered of a row
constexpr int kRefinePasses = 3;            // sweeps between two evaluations
constexpr std::size_t kFewChanges = 5;      // fewer than a fifth: worth a full sweep
constexpr std::size_t kNearlySolved = 100;  // fewer than a hundredth: now exactly
constexpr double kTie = 1e-6;  // share of the value within which choices are equally good
constexpr float kInfinite = std::numeric_limits<float>::infinity();

#define VSPRITE_INLINE inline __attribute__((always_inline))

// True if any lane of a mask is set.
VSPRITE_INLINE bool any_of(const Mask& mask) {
  const Halves halves = reinterpret_cast<Halves>(mask);
  return (halves[0] | halves[1] | halves[2] | halves[3]) != 0;
}

// Storage that vectors may point into.
class Aligned {
 public:
  explicit Aligned(std::size_t count) : bytes_(new std::byte[count * sizeof(Vector) + 63]) {}
  Vector* get() {
    const auto at = reinterpret_cast<std::uintptr_t>(bytes_.get());
    return reinterpret_cast<Vector*>((at + 63) / 64 * 64);
  }

 private:
  std::unique_ptr<std::byte[]> bytes_;
};

// Everything a sweep touches, as plain pointers.
struct SweepView {
  std::size_t count;
  const std::uint32_t *first, *last;  // edges of a row
  const std::uint32_t* to;
  const float* price;
  const Loose* arrive;
  const std::uint8_t* exits;  // or null
  const Wide* values;         // V
  const Wide* beyond;         // or null
  const Wide* offset;
  double discount;
  Vector* value;  // V - offset
  Vector* go;     // c_j + b (V'_j - offset)
  std::uint32_t* chosen;
  float* chosen_price;
  std::uint8_t* changed;  // a row: lanes that chose anew
};

// Lanes of an exit byte, as a mask.
VSPRITE_INLINE void lanes_of(std::uint8_t bits, Mask& out) {
  const Mask bit = {1, 2, 4, 8, 16, 32, 64, 128};
  out = ((Mask{} + static_cast<std::int32_t>(bits)) & bit) != 0;
}

VSPRITE_INLINE unsigned bits_of(const Mask& mask) {
  const Mask bits = mask & Mask{1, 2, 4, 8, 16, 32, 64, 128};
  const Halves halves = reinterpret_cast<Halves>(bits);
  const std::int64_t all = halves[0] | halves[1] | halves[2] | halves[3];
  return static_cast<unsigned>((all | all >> 32) & 0xFF);
}

// The cheapest edge of a row in every lane; of equals the first of the even or of the odd ones.
struct RowBest {
  Vector best;
  Mask edge;
};
VSPRITE_INLINE void best_of_row(const SweepView& v, std::uint32_t first, std::uint32_t last,
                                RowBest& out) {
  Vector best = Vector{} + kInfinite, other = best;
  Mask edge = {}, other_edge = {}, at = {};
  std::uint32_t e = first;
  for (; e + 1 < last; e += 2) {
    const Vector f = v.go[v.to[e]] + v.price[e], g = v.go[v.to[e + 1]] + v.price[e + 1];
    edge = f < best ? at : edge;
    best = f < best ? f : best;
    other_edge = g < other ? at : other_edge;
    other = g < other ? g : other;
    at += 2;
  }
  if (e < last) {
    const Vector f = v.go[v.to[e]] + v.price[e];
    edge = f < best ? at : edge;
    best = f < best ? f : best;
  }
  other_edge += 1;
  out.edge = other < best ? other_edge : edge;
  out.best = other < best ? other : best;
}

// The float images of V and of the cost to go.
VSPRITE_INLINE void read_values(const SweepView& v) {
  const Wide offset = *v.offset;
  const Vector discount = Vector{} + static_cast<float>(v.discount);
  for (std::size_t j = 0; j < v.count; ++j) {
    const Vector own = __builtin_convertvector(v.values[j] - offset, Vector);
    Vector behind = own;
    if (v.exits != nullptr && v.exits[j] != 0) {
      const Vector past = __builtin_convertvector(v.beyond[j] - offset, Vector);
      Mask exits;
      lanes_of(v.exits[j], exits);
      behind = exits ? past : own;
    }
    v.value[j] = own;
    v.go[j] = v.arrive[j] + discount * behind;
  }
}

// Lane by lane, each from its own row.
VSPRITE_INLINE void gather(const Vector* rows, const std::uint32_t* at, Vector& out) {
  const float* from = reinterpret_cast<const float*>(rows);
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    out[lane] = from[std::size_t{at[lane]} * kLanes + lane];
}

// What an offset of all values adds to a row: (1 - b) offset.
VSPRITE_INLINE void shift_of(const SweepView& v, Vector& out) {
  out = __builtin_convertvector((1 - v.discount) * *v.offset, Vector);
}

VSPRITE_INLINE void set_value(const SweepView& v, std::size_t i, const Vector& value) {
  const Vector go = v.arrive[i] + (Vector{} + static_cast<float>(v.discount)) * value;
  v.value[i] = value;
  if (v.exits == nullptr || v.exits[i] == 0) {
    v.go[i] = go;
  } else {
    Mask exits;
    lanes_of(v.exits[i], exits);
    v.go[i] = exits ? v.go[i] : go;
  }
}

// Lanes whose choice the minimum of the row beats clearly get a new one. What was chosen is worth
// less now than when it was evaluated, if anything, so most rows end at the first test.
VSPRITE_CLONES std::size_t sweep(const SweepView& v, int passes) {
  Vector shift;
  shift_of(v, shift);
  std::size_t changed = 0;
  std::fill_n(v.changed, v.count, std::uint8_t{0});
  for (std::size_t step = 0; step < v.count * static_cast<std::size_t>(passes); ++step) {
    const std::size_t i = v.count - 1 - step % v.count;
    const std::uint32_t first = v.first[i], last = v.last[i];
    if (first == last) continue;
    RowBest row;
    best_of_row(v, first, last, row);
    const Vector before = v.value[i] + shift;
    std::uint32_t* chosen = v.chosen + i * kLanes;
    const bool fresh = chosen[0] == kNoSample;
    if (!fresh && !any_of(row.best < before - 2e-6f)) continue;
    const Vector size = row.best < 0.0f ? -row.best : row.best, slack = 2e-6f * (1.0f + size);
    Loose& price = reinterpret_cast<Loose*>(v.chosen_price)[i];
    Mask anew = row.best < before - slack;
    if (fresh) {
      anew = Mask{} - 1;
    } else if (any_of(anew)) {
      Vector go;
      gather(v.go, chosen, go);
      anew &= row.best < price + go - slack;
    }
    if (any_of(anew)) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::uint32_t e = first + static_cast<std::uint32_t>(row.edge[lane]);
        const bool takes = anew[lane] != 0;
        chosen[lane] = takes ? v.to[e] : chosen[lane];
        price[lane] = takes ? v.price[e] : price[lane];
      }
      const unsigned bits = bits_of(anew);
      v.changed[i] = static_cast<std::uint8_t>(v.changed[i] | bits);
      changed += static_cast<std::size_t>(std::popcount(bits));
    }
    set_value(v, i, (fresh || row.best < before ? row.best : before) - shift);
  }
  return changed;
}

// V of the choices in single precision, cheaper than the exact evaluation below: go of an
// unknown sample is NaN, of one on the present walk +inf.
class NearEvaluation {
 public:
  NearEvaluation(const SweepView& view, std::vector<std::size_t>& walk)
      : v_(view), walk_(walk), go_(reinterpret_cast<float*>(view.go)) {}

  // Follows the choice of `at` to a known value, or until the walk meets itself.
  void follow(std::size_t at) {
    walk_.clear();
    for (; std::isnan(go_[at]); at = target(at)) {
      go_[at] = kInfinite;
      walk_.push_back(at);
    }
    if (std::isinf(go_[at])) close(at);
    for (std::size_t k = walk_.size(); k-- > 0;) {
      const std::size_t q = walk_[k];
      if (std::isinf(go_[q])) set(q, v_.chosen_price[q] + go_[target(q)] - shift(q));
    }
  }

 private:
  std::size_t target(std::size_t at) const {
    return std::size_t{v_.chosen[at]} * kLanes + at % kLanes;
  }
  float arrive(std::size_t at) const { return reinterpret_cast<const float*>(v_.arrive)[at]; }
  float shift(std::size_t at) const {
    const double offset = reinterpret_cast<const double*>(v_.offset)[at % kLanes];
    return static_cast<float>((1 - v_.discount) * offset);
  }
  void set(std::size_t at, float value) {
    reinterpret_cast<float*>(v_.value)[at] = value;
    go_[at] = arrive(at) + static_cast<float>(v_.discount) * value;
  }
  void close(std::size_t at) {
    double sum = 0, power = 1;
    std::size_t q = at;
    do {
      const std::size_t next = target(q);
      sum += power * static_cast<double>(v_.chosen_price[q] + arrive(next) - shift(q));
      power *= v_.discount;
      q = next;
    } while (q != at);
    set(at, static_cast<float>(sum / (1 - power)));
  }

  const SweepView& v_;
  std::vector<std::size_t>& walk_;
  float* go_;
};

// Adds the least value to the offset, so that the values keep their digits.
void lower_offset(const SweepView& v, double* offset) {
  Vector least = Vector{} + kInfinite;
  for (std::size_t i = 0; i < v.count; ++i) {
    if (v.first[i] != v.last[i]) least = v.value[i] < least ? v.value[i] : least;
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if (std::isfinite(least[lane])) offset[lane] += static_cast<double>(least[lane]);
}

VSPRITE_CLONES void evaluate_near(const SweepView& v, NearEvaluation& walks) {
  Vector shift;
  shift_of(v, shift);
  const Vector unknown = Vector{} + std::numeric_limits<float>::quiet_NaN();
  std::fill_n(v.go, v.count, unknown);
  if (v.exits != nullptr) {
    const Vector discount = Vector{} + static_cast<float>(v.discount);
    for (std::size_t j = 0; j < v.count; ++j) {
      if (v.exits[j] == 0) continue;
      const Vector past = __builtin_convertvector(v.beyond[j] - *v.offset, Vector);
      Mask exits;
      lanes_of(v.exits[j], exits);
      v.go[j] = exits ? v.arrive[j] + discount * past : v.go[j];
    }
  }
  for (std::size_t i = v.count; i-- > 0;) {
    if (v.first[i] == v.last[i]) continue;
    const std::uint32_t* chosen = v.chosen + i * kLanes;
    Vector go;
    gather(v.go, chosen, go);
    const Mask open = go != go;
    if (any_of(open)) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if (open[lane] == 0) continue;
        walks.follow(std::size_t{chosen[lane]} * kLanes + lane);
      }
      gather(v.go, chosen, go);
    }
    set_value(v, i, reinterpret_cast<const Loose*>(v.chosen_price)[i] + go - shift);
  }
}

// What best_of_rows reads and writes.
struct RowsView {
  const Edges& edges;
  const double* go;
  const double* offset;  // about the least of `go`
  Vector* near;          // (N) go - offset
  Vector* f;             // one row
  double* values;
  std::uint32_t* to;
};

// The row in single precision first, whose error is known; what may be least or a near tie of it is
// looked at again in double. Of near ties the first, which is the lowest sample, is taken.
VSPRITE_CLONES void row_minima(const RowsView& v) {
  const std::size_t n = v.edges.size();
  const Wide offset = *reinterpret_cast<const Wide*>(v.offset);
  const Vector about = __builtin_convertvector(offset, Vector);
  const Wide* wide = reinterpret_cast<const Wide*>(v.go);
  for (std::size_t j = 0; j < n; ++j) v.near[j] = __builtin_convertvector(wide[j] - offset, Vector);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t first = v.edges.row_start[i], last = v.edges.row_start[i + 1];
    const std::uint32_t* to = v.edges.to.data() + first;
    const float* price = v.edges.price.data() + first;
    const std::size_t count = last - first;
    double least[kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      least[lane] = std::numeric_limits<double>::infinity();
      v.to[i * kLanes + lane] = kNoSample;
    }
    Vector best = Vector{} + kInfinite;
    for (std::size_t e = 0; e < count; ++e) {
      v.f[e] = v.near[to[e]] + price[e];
      best = v.f[e] < best ? v.f[e] : best;
    }
    const Vector size = best < 0.0f ? -best : best;
    const Vector margin =
        best + 2e-6f * (size + 1.0f) + 1.01f * static_cast<float>(kTie) * (size + about + 1.0f);
    const auto each_near = [&](const auto& look) __attribute__((always_inline)) {
      for (std::size_t e = 0; e < count; ++e) {
        const Mask hit = v.f[e] <= margin;
        if (!any_of(hit)) continue;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          if (hit[lane] != 0)
            look(e, lane, v.go[to[e] * kLanes + lane] + static_cast<double>(price[e]));
        }
      }
    };
    each_near(
        [&](std::size_t, std::size_t lane, double f) { least[lane] = std::min(least[lane], f); });
    each_near([&](std::size_t e, std::size_t lane, double f) {
      std::uint32_t& chosen = v.to[i * kLanes + lane];
      if (chosen == kNoSample && f <= least[lane] + kTie * (least[lane] + 1)) chosen = to[e];
    });
    for (std::size_t lane = 0; lane < kLanes; ++lane) v.values[i * kLanes + lane] = least[lane];
  }
}

// What sweeps over some edges of every row touch.
SweepView view_of(Lanes& lanes, std::span<const std::uint32_t> first,
                  std::span<const std::uint32_t> last, const std::vector<std::uint32_t>& to,
                  const std::vector<float>& price) {
  const std::size_t n = first.size();
  lanes.work.resize((2 * n + 2) * kLanes);
  lanes.changed.resize(n);
  const auto at = reinterpret_cast<std::uintptr_t>(lanes.work.data());
  const auto value = reinterpret_cast<Vector*>((at + 63) / 64 * 64);
  const auto wide = [](const double* from) { return reinterpret_cast<const Wide*>(from); };
  return {n,
          first.data(),
          last.data(),
          to.data(),
          price.data(),
          reinterpret_cast<const Loose*>(lanes.arrive.data()),
          lanes.exits.empty() ? nullptr : lanes.exits.data(),
          wide(lanes.values.data()),
          lanes.beyond != nullptr ? wide(lanes.beyond->data()) : nullptr,
          wide(lanes.offset.data()),
          lanes.discount,
          value,
          value + n,
          lanes.to.data(),
          lanes.price.data(),
          lanes.changed.data()};
}
SweepView all_edges(const Edges& edges, Lanes& lanes) {
  const std::span rows(edges.row_start);
  return view_of(lanes, rows.first(edges.size()), rows.subspan(1), edges.to, edges.price);
}
SweepView seen_edges(Lanes& lanes) {
  const Lanes::Seen& seen = lanes.seen;
  return view_of(lanes, seen.first, seen.last, seen.to, seen.price);
}

// Adds the new choices of a row to those seen; a full row keeps what it has.
void remember(Lanes& lanes, std::size_t i, unsigned bits) {
  Lanes::Seen& seen = lanes.seen;
  std::uint32_t before = kNoSample;
  for (; bits != 0; bits &= bits - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
    const std::uint32_t to = lanes.to[i * kLanes + lane];
    if (to == before) continue;
    before = to;
    bool known = seen.last[i] - seen.first[i] == kMostSeen;
    for (std::uint32_t e = seen.first[i]; e < seen.last[i]; ++e) known |= seen.to[e] == to;
    if (known) continue;
    seen.to[seen.last[i]] = to;
    seen.price[seen.last[i]++] = lanes.price[i * kLanes + lane];
  }
}

// Follows every choice to a known value, or until the walk meets itself: then on the cycle
// i_0 .. i_(m-1)
//     V(i_0) = sum_q b^q c(i_q) / (1 - b^m),
// and everything before follows by V(i) = c(i) + b V(to(i)). From the last sample to the first, so
// that nearly every walk is one step long.
class Evaluation {
 public:
  explicit Evaluation(Lanes& lanes) : lanes_(lanes), state_(lanes.to.size(), kUnseen) {}

  void run() {
    const std::uint32_t* __restrict to = lanes_.to.data();
    const float* __restrict price = lanes_.price.data();
    const float* __restrict arrive = lanes_.arrive.data();
    const std::uint8_t* __restrict exits = lanes_.exits.empty() ? nullptr : lanes_.exits.data();
    double* __restrict values = lanes_.values.data();
    std::uint8_t* __restrict state = state_.data();
    const double discount = lanes_.discount;
    for (std::size_t at = lanes_.to.size(); at-- > 0;) {
      if (state[at] != kUnseen) continue;
      const std::uint32_t j = to[at];
      const std::size_t lane = at % kLanes, next = std::size_t{j} * kLanes + lane;
      const bool is_near = j != kNoSample && (exits == nullptr || (exits[j] >> lane & 1) == 0) &&
                           state[next] == kKnown;
      if (is_near) {
        const double cost = static_cast<double>(price[at]) + static_cast<double>(arrive[next]);
        values[at] = cost + discount * values[next];
        state[at] = kKnown;
      } else {
        follow(at);
      }
    }
  }

 private:
  enum : std::uint8_t { kUnseen, kOnWalk, kKnown };

  std::size_t target(std::size_t at) const {
    return std::size_t{lanes_.to[at]} * kLanes + at % kLanes;
  }
  double cost(std::size_t at) const {
    return static_cast<double>(lanes_.price[at]) + static_cast<double>(lanes_.arrive[target(at)]);
  }
  bool leaves(std::size_t at) const {
    return !lanes_.exits.empty() && (lanes_.exits[lanes_.to[at]] >> at % kLanes & 1) != 0;
  }
  void set(std::size_t at, double behind) {
    lanes_.values[at] = cost(at) + lanes_.discount * behind;
    state_[at] = kKnown;
  }
  // True if the value is known now without a walk.
  bool settle(std::size_t at) {
    if (lanes_.to[at] == kNoSample) {
      lanes_.values[at] = std::numeric_limits<double>::infinity();
      state_[at] = kKnown;
    } else if (leaves(at)) {
      set(at, (*lanes_.beyond)[target(at)]);
    } else if (state_[target(at)] == kKnown) {
      set(at, lanes_.values[target(at)]);
    }
    return state_[at] == kKnown;
  }
  void follow(std::size_t at) {
    walk_.clear();
    while (state_[at] == kUnseen && !settle(at)) {
      state_[at] = kOnWalk;
      walk_.push_back(at);
      at = target(at);
    }
    if (state_[at] == kOnWalk) close(at);
    for (std::size_t k = walk_.size(); k-- > 0;) {
      if (state_[walk_[k]] != kKnown) set(walk_[k], lanes_.values[target(walk_[k])]);
    }
  }
  void close(std::size_t at) {
    double sum = 0, power = 1;
    std::size_t q = at;
    do {
      sum += power * cost(q);
      power *= lanes_.discount;
      q = target(q);
    } while (q != at);
    lanes_.values[at] = sum / (1 - power);
    state_[at] = kKnown;
  }

  Lanes& lanes_;
  std::vector<std::uint8_t> state_;
  std::vector<std::size_t> walk_;
};

// One sweep over all edges for the values as they stand in single precision.
std::size_t improve_near(const Edges& edges, Lanes& lanes) {
  const std::size_t count = sweep(all_edges(edges, lanes), 1);
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (lanes.changed[i] != 0) remember(lanes, i, lanes.changed[i]);
  return count;
}

// Sweeps over the choices seen so far, each after an evaluation, until hardly any changes.
void refine_near(Lanes& lanes) {
  const SweepView view = seen_edges(lanes);
  std::vector<std::size_t> walk;
  NearEvaluation walks(view, walk);
  for (int k = 0; k < kMaxSweeps; ++k) {
    lower_offset(view, lanes.offset.data());
    evaluate_near(view, walks);
    if (sweep(view, kRefinePasses) < lanes.to.size() / kFewChanges) break;
  }
}

// The least of every lane, over rows that are not empty.
void least_of_lanes(const Edges& edges, const LaneDoubles& values, double* least) {
  std::fill_n(least, kLanes, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges.row_start[i] == edges.row_start[i + 1]) continue;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      least[lane] = std::min(least[lane], values[i * kLanes + lane]);
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if (!std::isfinite(least[lane])) least[lane] = 0;
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
      if (needed || static_cast<double>(t.cost) <= limit)
        add(t.to, price_of(static_cast<double>(t.cost)));
    }
    if (open) add(next_but_one, skip);
    edges.row_start.push_back(static_cast<std::uint32_t>(edges.to.size()));
  }
  return edges;
}

void start(const Edges& edges, Lanes& lanes) {
  const std::size_t n = edges.size();
  lanes.values.assign(n * kLanes, 0);
  lanes.to.assign(n * kLanes, kNoSample);
  lanes.price.assign(n * kLanes, 0);
  lanes.offset.fill(0);
  Lanes::Seen& seen = lanes.seen;
  seen.first.resize(n);
  for (std::size_t i = 0; i < n; ++i) seen.first[i] = static_cast<std::uint32_t>(i) * kMostSeen;
  seen.last = seen.first;
  seen.to.resize(n * kMostSeen);
  seen.price.resize(n * kMostSeen);
}

std::size_t improve(const Edges& edges, Lanes& lanes) {
  read_values(all_edges(edges, lanes));
  return improve_near(edges, lanes);
}

void evaluate(const Edges& edges, Lanes& lanes) {
  Evaluation(lanes).run();
  least_of_lanes(edges, lanes.values, lanes.offset.data());
}

void refine(const Edges& edges, Lanes& lanes) {
  refine_near(lanes);
  evaluate(edges, lanes);
}

void solve_lanes(const Edges& edges, Lanes& lanes) {
  read_values(all_edges(edges, lanes));
  for (int k = 0; k < kMaxSweeps; ++k) {
    const std::size_t changed = improve_near(edges, lanes);
    refine_near(lanes);
    if (changed < lanes.to.size() / kNearlySolved) break;
  }
  for (int k = 0; k < kMaxSweeps; ++k) {
    evaluate(edges, lanes);
    if (improve(edges, lanes) == 0) break;
  }
}

void best_of_rows(const Edges& edges, const LaneDoubles& go, LaneDoubles& values,
                  std::vector<std::uint32_t>& to) {
  const std::size_t n = edges.size();
  values.resize(n * kLanes);
  to.resize(n * kLanes);
  std::size_t longest = 0;
  for (std::size_t i = 0; i < n; ++i)
    longest = std::max<std::size_t>(longest, edges.row_start[i + 1] - edges.row_start[i]);
  Aligned near(n), row(longest);
  double offset[kLanes];
  least_of_lanes(edges, go, offset);
  row_minima({edges, go.data(), offset, near.get(), row.get(), values.data(), to.data()});
}

}  // namespace vsprite
