// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/lanes.h - eight deterministic control problems over one graph, solved together.
//
//     V_i = min_j [p_ij + c_j + b V'_j],    V'_j = V_j, or a value from outside where j is an exit
//
// The next sample follows from the choice alone, so a policy is a functional graph: every sample
// runs into one cycle, on which V is a geometric sum. A policy is therefore evaluated exactly in
// O(N), whatever b (Howard), and improved by sweeps from the last sample to the first, since a film
// runs forward and values travel backwards. Between two sweeps over all edges the problem is solved
// on those edges alone that were ever chosen: a few a row, so that sweeping them costs next to
// nothing (column generation, as in linear programming). The eight problems lie in the lanes of one
// vector. Each lane is computed by itself in IEEE single precision: the same bits with any
// instruction set.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "similarity/transitions.h"

namespace vsprite {

inline constexpr std::size_t kLanes = 8;

/// The transitions that a mode may take, and their prices.
struct Edges {
  std::vector<std::uint32_t> row_start;  ///< (N + 1)
  std::vector<std::uint32_t> to;
  std::vector<float> price;  ///< >= 0
  std::size_t size() const { return row_start.size() - 1; }
};

struct PriceConfig {
  double cap = 1;          ///< dearer transitions are left out, but for the cheapest of a row
  int power = 1;           ///< price = T^power
  double skip_price = -1;  ///< >= 0: i -> i+2 costs (skip_price x its T)^power
};
/// `skip_costs`: (N) T of leaving out the next sample, or infinity; empty: none.
Edges make_edges(const CostTable& costs, std::span<const float> skip_costs,
                 const PriceConfig& config);

/// (N, kLanes), lanes together.
using LaneFloats = std::vector<float>;
using LaneDoubles = std::vector<double>;

/// One vector of problems and how far it has been solved.
struct Lanes {
  double discount = 0;              ///< b
  LaneFloats arrive;                ///< c_j
  std::vector<std::uint8_t> exits;  ///< (N) bit k: in lane k the value of j is `beyond`; or empty
  const LaneDoubles* beyond = nullptr;
  std::array<double, kLanes> offset{};  ///< about V; sweeps look at V - offset, which keeps digits

  LaneDoubles values;                        ///< V; +inf where a row is empty
  std::vector<std::uint32_t> to;             ///< (N, kLanes) the choice; kNoSample at first
  std::vector<float> price;                  ///< (N, kLanes) of the choice
  struct Seen {                              ///< every choice that a full sweep made, a few a row
    std::vector<std::uint32_t> first, last;  ///< (N) into the two below
    std::vector<std::uint32_t> to;
    std::vector<float> price;
  } seen;
  LaneFloats work;                    ///< of sweeps, kept so that none has to fetch memory anew
  std::vector<std::uint8_t> changed;  ///< (N) bit k: the last sweep chose anew in lane k
};
/// `lanes.arrive` is due; values become 0.
void start(const Edges& edges, Lanes& lanes);
/// One sweep over all edges: every choice becomes the best for what is known, in place. Returns how
/// many changed.
std::size_t improve(const Edges& edges, Lanes& lanes);
/// V of the choices as they stand, exactly.
void evaluate(const Edges& edges, Lanes& lanes);
/// After improve(): evaluations in single precision and sweeps over the choices seen so far, until
/// few change: near the optimum of a graph of a tenth of the edges. Ends with evaluate().
void refine(const Edges& edges, Lanes& lanes);
/// All three until no choice among all edges changes.
void solve_lanes(const Edges& edges, Lanes& lanes);

/// min_j [p_ij + g_j] for (N, kLanes) g in double, its minimiser `to` (of near ties, within 1e-6 of
/// the value, the lowest sample), for every row; +inf and kNoSample where a row is empty.
void best_of_rows(const Edges& edges, const LaneDoubles& go, LaneDoubles& values,
                  std::vector<std::uint32_t>& to);

}  // namespace vsprite
