// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// NIPS section 4: equation 2 by policy iteration (lanes.h) instead of the paper's literal
// iteration, which needs about ln(1/eps) / (1 - alpha) sweeps and stays as `iterate`. Departure:
// standing costs pi (DESIGN section 2), or the sprite would stand for ever, since the angle of a
// resting sample means nothing.
#include "control/solve.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "control/lanes.h"
#include "similarity/features.h"

namespace vsprite {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxIterations =
    10'000'000;  // of the paper's own method; never met below a = 0.99999

// Eight groups of tables and what they have in common.
struct Block {
  std::size_t first = 0, count = kLanes;  // groups
  LaneFloats arrive;                      // w1 a_j(l)
};

Block make_block(std::span<const Vec2> velocities, double v0, const SolveConfig& config,
                 std::size_t first) {
  const auto groups = static_cast<std::size_t>(config.headings) + 2;
  Block block{first, std::min(kLanes, groups - first), LaneFloats(velocities.size() * kLanes, 0)};
  for (std::size_t j = 0; j < velocities.size(); ++j) {
    for (std::size_t lane = 0; lane < block.count; ++lane) {
      block.arrive[j * kLanes + lane] = static_cast<float>(
          config.w1 *
          heading_cost(velocities[j], v0, static_cast<int>(first + lane), config.headings));
    }
  }
  return block;
}

// The paper's own method: F_ij = T_ij at first, then equation 2 again and again. Only the smallest
// F of a row is ever looked at, so only it is kept.
LaneDoubles iterate(const Edges& edges, const LaneFloats& arrive, double alpha) {
  LaneDoubles go(arrive.size(), 0), values, after;
  std::vector<std::uint32_t> next;
  best_of_rows(edges, go, values, next);
  for (int k = 0; k < kMaxIterations; ++k) {
    for (std::size_t a = 0; a < go.size(); ++a) {
      go[a] = static_cast<double>(arrive[a]) + (std::isfinite(values[a]) ? alpha * values[a] : 0);
    }
    best_of_rows(edges, go, after, next);
    double change = 0, largest = 0;
    for (std::size_t a = 0; a < go.size(); ++a) {
      if (!std::isfinite(after[a])) continue;
      change = std::max(change, std::fabs(after[a] - values[a]));
      largest = std::max(largest, after[a]);
    }
    values.swap(after);
    if (change <= 1e-11 * (1 + largest) * (1 - alpha)) break;
  }
  return values;
}

// Writes one stage of a block's tables, read off its values; returns the largest |TV - V|.
// `values`: V as it will be stored; where empty, V is what the rows give.
double write_stage(const Edges& edges, const LaneDoubles& go, const LaneDoubles* values,
                   const Block& block, std::size_t stage, std::size_t stages,
                   const detail::BlockTables& tables, LaneDoubles& stored) {
  const std::size_t n = edges.size();
  LaneDoubles best;
  std::vector<std::uint32_t> next;
  best_of_rows(edges, go, best, next);
  stored.resize(n * kLanes);
  double residual = 0;
  for (std::size_t lane = 0; lane < block.count; ++lane) {
    const std::size_t table = (lane * stages + stage) * n;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t at = i * kLanes + lane;
      const double value = values != nullptr ? (*values)[at] : best[at];
      const bool kept = std::isfinite(best[at]);
      tables.values[table + i] = static_cast<float>(value);
      tables.next[table + i] = next[at];
      tables.go[table + i] = kept ? static_cast<float>(go[at]) : 0;
      stored[at] = kept ? static_cast<double>(tables.values[table + i]) : 0;
      if (kept) residual = std::max(residual, std::fabs(best[at] - stored[at]));
    }
  }
  return residual;
}

// One block: the constrained tables, then the chain V^1 .. V^K on top of them.
double solve_block(const Edges& edges, const Block& block, const SolveConfig& config,
                   const detail::BlockTables& tables) {
  const auto stages = static_cast<std::size_t>(config.free_steps) + 1;
  LaneDoubles values;
  if (config.iterate) {
    values = iterate(edges, block.arrive, config.alpha);
  } else {
    Lanes lanes;
    lanes.discount = config.alpha;
    lanes.arrive = block.arrive;
    start(edges, lanes);
    solve_lanes(edges, lanes);
    values = std::move(lanes.values);
  }
  LaneDoubles go(values.size()), stored;
  for (std::size_t a = 0; a < go.size(); ++a) {
    values[a] = static_cast<double>(static_cast<float>(values[a]));
    go[a] = static_cast<double>(block.arrive[a]) +
            (std::isfinite(values[a]) ? config.alpha * values[a] : 0);
  }
  double residual = write_stage(edges, go, &values, block, 0, stages, tables, stored);
  for (std::size_t k = 1; k < stages; ++k) {
    for (std::size_t a = 0; a < go.size(); ++a) go[a] = config.alpha * stored[a];
    residual =
        std::max(residual, write_stage(edges, go, nullptr, block, k, stages, tables, stored));
  }
  return residual;
}

Result<void> check_settings(const SolveConfig& config) {
  using detail::bad_setting;
  if (!(config.alpha >= 0 && config.alpha < 1)) {
    return bad_setting("alpha", config.alpha, "a number from 0 to below 1");
  }
  if (!(config.w1 >= 0 && config.w1 < 1e6)) return bad_setting("w1", config.w1, "0 to 1000000");
  if (!(config.cap > 0)) return bad_setting("cap", config.cap, "a number above 0");
  if (config.free_steps < 0 || config.free_steps > 10) {
    return bad_setting("free-steps", config.free_steps, "0 to 10");
  }
  if (config.headings != 8 && config.headings != 16 && config.headings != 32) {
    return bad_setting("directions", config.headings, "8, 16 or 32");
  }
  const int tables = (config.headings + 2) * (config.free_steps + 1);
  if (tables > 256) {
    return bad_setting("free-steps", config.free_steps,
                       "with " + std::to_string(config.headings) + " directions at most " +
                           std::to_string(256 / (config.headings + 2) - 1));
  }
  return {};
}

}  // namespace

namespace detail {

Error bad_setting(const std::string& name, double found, const std::string& due) {
  char number[32];
  std::snprintf(number, sizeof number, "%g", found);
  return {ErrorCode::BadSetting,
          "solve: " + name + " is " + number + ", " + due + " is due; correct the setting"};
}

Result<void> check_graph(const CostTable& costs, std::size_t samples, double v0) {
  if (!(v0 > 0)) return bad_setting("v0", v0, "a speed above 0");
  assert(costs.row_start.size() == samples + 1);
  for (std::size_t i = 0; i < samples; ++i) {
    bool sound = costs.kept[i] == 0 || costs.row_start[i] < costs.row_start[i + 1];
    for (std::uint32_t e = costs.row_start[i]; e < costs.row_start[i + 1]; ++e) {
      const Transition& t = costs.transitions[e];
      sound = sound && t.to < samples && costs.kept[t.to] && t.cost >= 0 && std::isfinite(t.cost);
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

namespace {

std::size_t block_count(const ControlMode& mode) {
  return (mode.headings + 2 + kLanes - 1) / kLanes;
}
// Of one block; the last one has fewer groups.
std::size_t table_count(const ControlMode& mode, std::size_t block) {
  return std::min<std::size_t>(kLanes, mode.headings + 2 - block * kLanes) * mode.stages;
}

}  // namespace

Solution empty_solution(const char* name, int headings, int stages, std::size_t samples,
                        const Spread& spread) {
  Solution solution;
  ControlMode& mode = solution.mode;
  mode.name = name;
  mode.headings = static_cast<std::uint32_t>(headings);
  mode.stages = static_cast<std::uint32_t>(stages);
  for (std::size_t d = 0; d < kDirectionCount; ++d) mode.table_of[d] = static_cast<Direction>(d);
  mode.served = (1u << kCompassCount) - 1;
  mode.served_headings = mode.headings == 32 ? ~0u : (1u << mode.headings) - 1;
  std::size_t room = 0;
  for (std::size_t b = 0; b < block_count(mode); ++b)
    if (spread.rank == 0 || spread.owns(b)) room += table_count(mode, b) * samples;
  mode.next.assign(room, kNoSample);
  mode.go.assign(room, 0);
  solution.values.assign(room, 0);
  return solution;
}

BlockTables tables_of(Solution& solution, const Spread& spread, std::size_t block,
                      std::size_t samples) {
  const std::size_t before = spread.rank == 0 ? block : block / spread.count;
  const std::size_t begin = before * kLanes * solution.mode.stages * samples;
  const std::size_t size = table_count(solution.mode, block) * samples;
  return {std::span(solution.mode.next).subspan(begin, size),
          std::span(solution.mode.go).subspan(begin, size),
          std::span(solution.values).subspan(begin, size)};
}

void gather_blocks(Solution& solution, const Spread& spread, std::vector<double>& residuals,
                   std::size_t samples) {
  for (std::size_t b = 0; b < residuals.size(); ++b) {
    if (spread.rank != 0 && !spread.owns(b)) continue;
    const BlockTables tables = tables_of(solution, spread, b, samples);
    spread.gather_block(b, tables.next);
    spread.gather_block(b, tables.go);
    spread.gather_block(b, tables.values);
    spread.gather_block(b, std::span(residuals).subspan(b, 1));
  }
  solution.mode.residual = *std::max_element(residuals.begin(), residuals.end());
}

}  // namespace detail

double heading_angle(Vec2 velocity, int h, int headings) noexcept {
  // The heading is in (-pi, pi], the command in [0, 2 pi): up to 3 pi apart before wrapping.
  const double command = h * (2 * kPi / headings);
  const double apart = std::fabs(
      angle_of(static_cast<double>(velocity.x), static_cast<double>(velocity.y)) - command);
  const double d = apart > 2 * kPi ? apart - 2 * kPi : apart;
  return d > kPi ? 2 * kPi - d : d;
}

double heading_cost(Vec2 velocity, double v0, int h, int headings) noexcept {
  const auto x = static_cast<double>(velocity.x), y = static_cast<double>(velocity.y);
  const double f = std::min(1.0, std::sqrt(x * x + y * y) / v0);
  if (h == headings) return 0;
  if (h > headings) return kPi * f * f;
  return f * heading_angle(velocity, h, headings) + (1 - f) * kPi;
}

double direction_cost(Vec2 velocity, double v0, Direction direction) noexcept {
  return heading_cost(velocity, v0, static_cast<int>(direction), kCompassCount);
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
                       const SolveConfig& given, int jobs, const Spread& spread) {
  if (auto ok = check_settings(given); !ok) return ok.error();
  if (auto ok = detail::check_graph(costs, velocities.size(), v0); !ok) return ok.error();
  SolveConfig config = given;
  if (config.w1 == 0) config.w1 = default_w1(costs);
  const Edges edges = make_edges(costs, {}, {.cap = config.cap});
  const std::size_t n = velocities.size();
  Solution solution =
      detail::empty_solution("paper", config.headings, config.free_steps + 1, n, spread);
  const std::size_t groups = solution.mode.headings + 2;
  std::vector<double> residuals((groups + kLanes - 1) / kLanes, 0);
  tbb::task_arena arena(jobs > 0 ? jobs : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, residuals.size(), [&](std::size_t b) {
      if (!spread.owns(b)) return;
      residuals[b] = solve_block(edges, make_block(velocities, v0, config, b * kLanes), config,
                                 detail::tables_of(solution, spread, b, n));
    });
  });
  detail::gather_blocks(solution, spread, residuals, n);
  ControlMode& mode = solution.mode;
  mode.alpha = static_cast<float>(config.alpha);
  mode.w1 = static_cast<float>(config.w1);
  mode.cap = static_cast<float>(config.cap);
  mode.error_bound = mode.residual / (1 - config.alpha);
  return solution;
}

}  // namespace vsprite
