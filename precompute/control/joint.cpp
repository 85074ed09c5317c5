// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// CONTROL's setting E, after McCann & Pollard 2007, whose controller also expects the player.
#include "control/joint.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "control/lanes.h"
#include "similarity/features.h"

namespace vsprite {
namespace {

constexpr double kMovingShare = 0.7;  // of v0: a sample that has turned moves at least so fast
constexpr int kMaxRounds = 1000;
constexpr double kSettled = 1e-9;  // relative change of M that ends its iteration

double degrees(double deg) { return deg * kPi / 180; }

// a_j(l) for group h; none costs nothing, rest as in the mode of the paper.
double arrival_angle(Vec2 velocity, double v0, double fast, int h, const JointConfig& config) {
  if (h >= config.headings) return heading_cost(velocity, v0, h, config.headings);
  const auto x = static_cast<double>(velocity.x), y = static_cast<double>(velocity.y);
  const double f = std::min(1.0, std::sqrt(x * x + y * y) / v0);
  const double off =
      std::max(0.0, heading_angle(velocity, h, config.headings) - degrees(config.bend_deg));
  const UnitVector u = heading_vector(static_cast<std::uint32_t>(h) *
                                      (kMaxHeadings / static_cast<std::uint32_t>(config.headings)));
  const double along = (x * u.x + y * u.y) / kUnitOne;
  return f * off + (1 - f) * kPi + config.speed_weight * (1 - std::clamp(along / fast, 0.0, 1.0));
}

// Everything that stays the same during a solve.
struct Problem {
  const Edges& edges;
  const JointConfig& config;
  const Spread& spread;
  std::size_t groups = 0, blocks = 0;
  std::uint32_t served = 0;
  double rho = 0;
  std::vector<LaneFloats> angle;                 // a block: a_j(l); of own blocks
  std::vector<std::vector<std::uint8_t>> exits;  // a block: bit lane, j has turned
  std::size_t heading_blocks() const { return static_cast<std::size_t>(config.headings) / kLanes; }
  bool is_heading(std::size_t group) const {
    return group < static_cast<std::size_t>(config.headings);
  }
  double weight(std::size_t group, bool turning) const {
    // Standing still is worth a jump, as it is in turning; nothing else distinguishes the phases.
    return turning || !is_heading(group) ? config.turn_w1 : config.cruise_w1;
  }
};

void fill_block(Problem& problem, const Motion& motion, double fast, std::size_t b) {
  const std::size_t n = motion.velocities.size();
  LaneFloats& angle = problem.angle[b];
  std::vector<std::uint8_t>& exits = problem.exits[b];
  const bool own = problem.spread.owns(b);
  if (own) angle.assign(n * kLanes, 0);
  exits.assign(n, 0);
  for (std::size_t j = 0; j < n; ++j) {
    const Vec2 v = motion.velocities[j];
    const double speed = std::sqrt(static_cast<double>(v.x) * static_cast<double>(v.x) +
                                   static_cast<double>(v.y) * static_cast<double>(v.y));
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t group = b * kLanes + lane;
      if (group >= problem.groups) break;
      const int h = static_cast<int>(group);
      if (own)
        angle[j * kLanes + lane] =
            static_cast<float>(arrival_angle(v, motion.v0, fast, h, problem.config));
      const bool turned =
          !problem.is_heading(group) ||
          (speed > kMovingShare * motion.v0 &&
           heading_angle(v, h, problem.config.headings) <= degrees(problem.config.exit_deg));
      exits[j] = static_cast<std::uint8_t>(exits[j] | (turned ? 1u << lane : 0u));
    }
  }
}

// The part of c_j that comes from a change of command: alpha rho M_j^l.
class Expectation {
 public:
  Expectation(const Problem& problem, std::size_t samples)
      : problem_(problem), sum_(samples, 0), count_(std::popcount(problem.served)) {}

  // Sums V^turn over the served headings, block by block in every process; returns the largest
  // relative change.
  double update(std::vector<Lanes>& turning) {
    before_.assign(sum_.size(), 0);
    before_.swap(sum_);
    for (std::size_t b = 0; b < problem_.heading_blocks(); ++b) {
      LaneDoubles& values = problem_.spread.owns(b) ? turning[b].values : received_;
      values.resize(sum_.size() * kLanes);
      problem_.spread.share_block(b, std::span(values));
      const std::uint32_t served = problem_.served >> b * kLanes & 0xFFu;
      for (std::size_t j = 0; j < sum_.size(); ++j) {
        for (std::uint32_t left = served; left != 0; left &= left - 1)
          sum_[j] += values[j * kLanes + static_cast<std::size_t>(std::countr_zero(left))];
      }
    }
    double change = 0, largest = 1;
    for (std::size_t j = 0; j < sum_.size(); ++j) {
      if (!std::isfinite(sum_[j])) sum_[j] = 0;
      change = std::max(change, std::fabs(sum_[j] - before_[j]));
      largest = std::max(largest, std::fabs(sum_[j]));
    }
    return change / largest;
  }

  // M_j of a group: the mean over the served headings other than its own.
  double mean(std::size_t group, std::size_t j, double own) const {
    const bool among = problem_.is_heading(group) && (problem_.served >> group & 1u) != 0;
    return among ? (sum_[j] - own) / (count_ - 1) : sum_[j] / count_;
  }

 private:
  const Problem& problem_;
  std::vector<double> sum_, before_;
  LaneDoubles received_;
  int count_;
};

// c_j of a block and phase, with M from the turning values as they stand.
void fill_arrive(const Problem& problem, const Expectation& expectation, std::size_t b,
                 bool turning, const LaneDoubles* own, LaneFloats& arrive) {
  const LaneFloats& angle = problem.angle[b];
  arrive.resize(angle.size());
  for (std::size_t at = 0; at < angle.size(); ++at) {
    const std::size_t j = at / kLanes, group = b * kLanes + at % kLanes;
    if (group >= problem.groups) {
      arrive[at] = 0;
      continue;
    }
    double cost = problem.weight(group, turning) * static_cast<double>(angle[at]);
    if (problem.rho > 0) {
      const double value = own != nullptr && std::isfinite((*own)[at]) ? (*own)[at] : 0;
      cost += problem.config.alpha * problem.rho * expectation.mean(group, j, value);
    }
    arrive[at] = static_cast<float>(cost);
  }
}

class JointSolver {
 public:
  JointSolver(const Problem& problem, std::size_t samples)
      : problem_(problem),
        expectation_(problem, samples),
        cruising_(problem.blocks),
        turning_(problem.blocks) {
    for (std::size_t b = 0; b < problem.blocks; ++b) {
      if (!problem.spread.owns(b)) continue;
      for (Lanes* lanes : {&cruising_[b], &turning_[b]}) {
        lanes->discount = problem.config.alpha * (1 - problem.rho);
        start(problem.edges, *lanes);
      }
      turning_[b].exits = problem.exits[b];
      turning_[b].beyond = &cruising_[b].values;
    }
  }

  void solve() {
    const std::size_t heading_blocks = problem_.heading_blocks();
    for (int round = 0; round < kMaxRounds; ++round) {
      std::vector<std::size_t> changed(heading_blocks, 0);
      each_own(heading_blocks, [&](std::size_t b) { changed[b] = improve_both(b); });
      for (std::size_t b = 0; b < heading_blocks; ++b)
        problem_.spread.share_block(b, std::span(changed).subspan(b, 1));
      const bool same = std::all_of(changed.begin(), changed.end(), [](auto c) { return c == 0; });
      if (same && settled_) break;
      // A policy's M is found by evaluations alone; roughly, while policies still change.
      for (int k = 0; k < (same ? kMaxRounds : 2); ++k) {
        each_own(heading_blocks, [&](std::size_t b) { evaluate_both(b); });
        settled_ = problem_.rho == 0 || expectation_.update(turning_) < kSettled;
        if (settled_) break;
      }
    }
    // None and rest are never expected, so they come after.
    const std::size_t last = problem_.blocks - 1;
    if (!problem_.spread.owns(last)) return;
    for (int round = 0; round < kMaxRounds && improve_both(last) > 0; ++round) evaluate_both(last);
  }

  // Tables, cost to go and the certificate, all from V as stored, which is what it keeps.
  void write(Solution& solution) {
    const std::size_t n = problem_.edges.size();
    round_to_stored(cruising_);
    round_to_stored(turning_);
    if (problem_.rho > 0) expectation_.update(turning_);
    std::vector<double> residuals(problem_.blocks, 0), turning = residuals;
    const auto write_one = [&](std::size_t k) {
      const std::size_t b = k / 2;
      (k % 2 == 1 ? turning : residuals)[b] =
          write_phase(b, k % 2 == 1, detail::tables_of(solution, problem_.spread, b, n));
    };
    each_own(problem_.blocks, write_one, 2);
    for (std::size_t b = 0; b < problem_.blocks; ++b)
      residuals[b] = std::max(residuals[b], turning[b]);
    detail::gather_blocks(solution, problem_.spread, residuals, n);
  }

 private:
  // `work` gets the blocks, or of each block the phases, that are this process's.
  template <class Work>
  void each_own(std::size_t count, const Work& work, std::size_t phases = 1) {
    tbb::parallel_for(std::size_t{0}, count * phases, [&](std::size_t k) {
      if (problem_.spread.owns(k / phases)) work(k);
    });
  }
  void refresh(std::size_t b) {
    fill_arrive(problem_, expectation_, b, false, &turning_[b].values, cruising_[b].arrive);
    fill_arrive(problem_, expectation_, b, true, &turning_[b].values, turning_[b].arrive);
  }
  std::size_t improve_both(std::size_t b) {
    refresh(b);
    std::size_t changed = 0;
    for (Lanes* lanes : {&cruising_[b], &turning_[b]}) {  // turning leads to cruising
      changed += improve(problem_.edges, *lanes);
      refine(problem_.edges, *lanes);
    }
    return changed;
  }
  void evaluate_both(std::size_t b) {
    refresh(b);
    evaluate(problem_.edges, cruising_[b]);
    evaluate(problem_.edges, turning_[b]);
  }

  // The rest of the lanes has done its work.
  static void round_to_stored(std::vector<Lanes>& lanes) {
    for (Lanes& block : lanes) {
      LaneDoubles values = std::move(block.values);
      for (double& v : values) v = static_cast<double>(static_cast<float>(v));
      block = {};
      block.values = std::move(values);
    }
  }

  double write_phase(std::size_t b, bool turn, const detail::BlockTables& tables) const {
    const LaneDoubles &cruising = cruising_[b].values, &turning = turning_[b].values;
    const std::size_t n = problem_.edges.size();
    const double alpha = problem_.config.alpha, rho = problem_.rho;
    LaneDoubles go(n * kLanes, 0), best;
    for (std::size_t at = 0; at < go.size(); ++at) {
      const std::size_t j = at / kLanes, lane = at % kLanes, group = b * kLanes + lane;
      if (group >= problem_.groups || !std::isfinite(turning[at])) continue;
      const bool cruises = !turn || (problem_.exits[b][j] >> lane & 1) != 0;
      const double behind = cruises ? cruising[at] : turning[at];
      const double expected = rho > 0 ? rho * expectation_.mean(group, j, turning[at]) : 0;
      go[at] = problem_.weight(group, turn) * static_cast<double>(problem_.angle[b][at]) +
               alpha * ((1 - rho) * behind + expected);
    }
    std::vector<std::uint32_t> next;
    best_of_rows(problem_.edges, go, best, next);
    double residual = 0;
    for (std::size_t lane = 0; lane < kLanes && b * kLanes + lane < problem_.groups; ++lane) {
      const std::size_t table = (lane * 2 + (turn ? 1 : 0)) * n;
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t at = i * kLanes + lane;
        const double value = (turn ? turning : cruising)[at];
        const bool kept = std::isfinite(best[at]);
        tables.values[table + i] = static_cast<float>(value);
        tables.next[table + i] = next[at];
        tables.go[table + i] = kept ? static_cast<float>(go[at]) : 0;
        if (kept) residual = std::max(residual, std::fabs(best[at] - value));
      }
    }
    return residual;
  }

  const Problem& problem_;
  Expectation expectation_;
  std::vector<Lanes> cruising_, turning_;
  bool settled_ = false;
};

Result<void> check_settings(const JointConfig& c) {
  using detail::bad_setting;
  const auto weight = [](double w) { return w >= 0 && w < 1e6; };
  if (!(c.alpha >= 0 && c.alpha < 1))
    return bad_setting("alpha", c.alpha, "a number from 0 to below 1");
  if (!weight(c.cruise_w1)) return bad_setting("cruise-w1", c.cruise_w1, "0 to 1000000");
  if (!weight(c.turn_w1)) return bad_setting("turn-w1", c.turn_w1, "0 to 1000000");
  if (!(c.cap > 0)) return bad_setting("cap", c.cap, "a number above 0");
  if (!(c.change_rate >= 0 && c.change_rate < 1))
    return bad_setting("change-rate", c.change_rate, "a chance from 0 to below 1 a sample");
  if (!weight(c.speed_weight)) return bad_setting("speed-weight", c.speed_weight, "0 to 1000000");
  if (!weight(c.skip_price)) return bad_setting("skip-price", c.skip_price, "0 to 1000000");
  if (!(c.bend_deg >= 0 && c.bend_deg <= 45)) return bad_setting("bend", c.bend_deg, "0 to 45");
  if (!(c.exit_deg > 0 && c.exit_deg <= 90))
    return bad_setting("exit", c.exit_deg, "more than 0 and at most 90");
  if (c.headings != 8 && c.headings != 16 && c.headings != 32)
    return bad_setting("directions", c.headings, "8, 16 or 32");
  return {};
}

// The largest angle of bend as a sine and cosine in 2^-30, by the series: no libm decides a pack.
void set_bend(double radians, ControlMode& mode) {
  double sine = 0, cosine = 0, term = 1;
  for (int k = 0; k < 20; ++k) {
    (k % 2 == 0 ? cosine : sine) += k % 4 < 2 ? term : -term;
    term *= radians / (k + 1);
  }
  mode.bend_cos = static_cast<std::int32_t>(std::floor(cosine * kUnitOne + 0.5));
  mode.bend_sin = static_cast<std::int32_t>(std::floor(sine * kUnitOne + 0.5));
}

void fill_mode(const Problem& problem, const JointConfig& config, ControlMode& mode) {
  mode.alpha = static_cast<float>(config.alpha);
  mode.w1 = static_cast<float>(config.cruise_w1);
  mode.turn_w1 = static_cast<float>(config.turn_w1);
  mode.cap = static_cast<float>(config.cap);
  mode.change_rate = static_cast<float>(problem.rho);
  mode.speed_weight = static_cast<float>(config.speed_weight);
  mode.skip_price = static_cast<float>(config.skip_price);
  mode.exit_angle = static_cast<float>(degrees(config.exit_deg));
  mode.dead_angle = static_cast<float>(degrees(config.bend_deg));
  mode.power = 2;
  mode.by_state = true;
  mode.plays_through = config.play_through;
  set_bend(degrees(config.bend_deg), mode);
  const std::size_t n = problem.edges.size();
  mode.arrived.assign(n, 0);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t b = 0; b * kLanes < mode.headings; ++b)
      mode.arrived[j] |= std::uint32_t{problem.exits[b][j]} << (b * kLanes);
  }
  mode.error_bound = mode.residual / (1 - config.alpha);
}

}  // namespace

double fast_speed(std::span<const Vec2> velocities, double v0) {
  std::vector<double> speeds;
  for (const Vec2& v : velocities) {
    const double speed = std::sqrt(static_cast<double>(v.x) * static_cast<double>(v.x) +
                                   static_cast<double>(v.y) * static_cast<double>(v.y));
    if (speed > v0) speeds.push_back(speed);
  }
  if (speeds.empty()) return v0;
  const auto at = speeds.begin() + std::ssize(speeds) * 3 / 4;
  std::nth_element(speeds.begin(), at, speeds.end());
  return *at;
}

Result<Solution> solve_joint(const CostTable& costs, const Motion& motion,
                             const JointConfig& config, std::uint32_t served, int jobs,
                             const Spread& spread) {
  if (auto ok = check_settings(config); !ok) return ok.error();
  if (auto ok = detail::check_graph(costs, motion.velocities.size(), motion.v0); !ok)
    return ok.error();
  const Edges edges = make_edges(
      costs, motion.skip_costs,
      {.cap = config.cap, .power = 2, .skip_price = config.play_through ? config.skip_price : -1});
  const std::size_t groups = static_cast<std::size_t>(config.headings) + 2;
  Problem problem{edges, config, spread, groups, (groups + kLanes - 1) / kLanes, served, 0, {}, {}};
  problem.rho = std::popcount(served) > 1 ? config.change_rate : 0;  // nothing else to command
  problem.angle.resize(problem.blocks);
  problem.exits.resize(problem.blocks);
  Solution solution =
      detail::empty_solution("responsive", config.headings, 2, motion.velocities.size(), spread);
  const double fast = fast_speed(motion.velocities, motion.v0);
  tbb::task_arena arena(jobs > 0 ? jobs : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, problem.blocks,
                      [&](std::size_t b) { fill_block(problem, motion, fast, b); });
    JointSolver solver(problem, motion.velocities.size());
    solver.solve();
    solver.write(solution);
  });
  fill_mode(problem, config, solution.mode);
  return solution;
}

}  // namespace vsprite
