// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// naive_beam.h - the beam search as the paper describes it: every successor of every sequence is
// evaluated, then the cheapest are chosen, by sorting everything or by std::nth_element. The
// reference for control/search.h, and its rivals in the benchmark.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <tuple>
#include <vector>

#include "control/path_cost.h"

namespace vsprite::testing {

enum class Selection { Sort, NthElement };

struct NaiveBeam {
  Cost best = kNoCost;  ///< of the cheapest sequence that arrived
  std::uint64_t expansions = 0;
  std::uint64_t ticks = 0;
};

/// `max_ticks`: stop there (0: to the end), for timing the slow one.
inline NaiveBeam naive_beam(const PathCost& path, std::size_t width, Selection selection,
                            std::uint64_t max_ticks = 0,
                            const std::function<void(std::span<const PathState>)>& survivors = {}) {
  struct Candidate {
    Cost rank, cost;
    std::uint32_t parent, sample;
    auto key() const { return std::tie(rank, parent, sample); }
    bool operator<(const Candidate& other) const { return key() < other.key(); }
  };
  NaiveBeam out;
  const Sprite& sprite = path.sprite();
  std::vector<std::vector<PathState>> pools(path.longest_duration() + 1);  // by end, modulo
  std::vector<PathState> moving, parents, beam;
  std::vector<Candidate> candidates;
  const auto keep_cheapest = [&] {
    if (selection == Selection::Sort) {
      std::sort(candidates.begin(), candidates.end());
      candidates.resize(std::min(width, candidates.size()));
    } else if (candidates.size() > width) {
      std::nth_element(candidates.begin(), candidates.begin() + static_cast<long>(width) - 1,
                       candidates.end());
      candidates.resize(width);
    }
    // Parents in the order in which they were made, so that ties fall the same way next time.
    std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
      return std::tie(a.parent, a.rank, a.sample) < std::tie(b.parent, b.rank, b.sample);
    });
  };
  const auto put_back = [&] {
    if (survivors) survivors(beam);
    for (const PathState& s : beam)
      pools[(out.ticks + sprite.samples()[s.sample].duration) % pools.size()].push_back(s);
  };

  for (std::uint32_t i = 0; i < sprite.samples().size(); ++i)
    if (sprite.samples()[i].kept) candidates.push_back({path.seed(i).cost, 0, i, i});
  keep_cheapest();
  for (const Candidate& c : candidates) beam.push_back(path.seed(c.sample));
  put_back();
  const auto is_empty = [](const auto& pool) { return pool.empty(); };
  while (!std::all_of(pools.begin(), pools.end(), is_empty)) {
    if (max_ticks > 0 && out.ticks == max_ticks) break;
    ++out.ticks;
    moving.swap(pools[out.ticks % pools.size()]);
    pools[out.ticks % pools.size()].clear();
    parents.clear();
    candidates.clear();
    beam.clear();
    const Cost before = out.best;
    for (const PathState& from : moving) {
      PathState to;
      const PathEnd end = path.leave(from, to);
      if (end == PathEnd::Dropped || to.cost >= before) continue;
      if (end == PathEnd::Arrived) {
        out.best = std::min(out.best, to.cost);
        continue;
      }
      parents.push_back(to);
    }
    if (parents.empty()) continue;
    for (std::uint32_t p = 0; p < parents.size(); ++p) {
      const PathState& s = parents[p];
      const Cost rank = path.estimate(s);
      for (const Transition& t : sprite.transitions(s.sample)) {
        const Cost cost = s.cost + Cost{PathCost::transition_cost(t.cost)} +
                          Cost{path.angle_cost(t.to, s.segment)};
        candidates.push_back({cost + rank, cost, p, t.to});
      }
    }
    out.expansions += candidates.size();
    keep_cheapest();
    for (const Candidate& c : candidates) {
      beam.push_back(parents[c.parent]);
      beam.back().cost = c.cost;
      beam.back().sample = c.sample;
    }
    put_back();
  }
  return out;
}

}  // namespace vsprite::testing
