// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Samples are left out in the order in which a player would miss them least.
#include "control/choose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "control/actions.h"
#include "control/bench.h"
#include "vsprite/actor.h"
#include "vsprite/random.h"

namespace vsprite {
namespace {

constexpr double kShortest = 0.3, kLongest = 3;   // s that a command stands
constexpr double kResting = 0.1, kIdling = 0.05;  // chance that a command is Rest, None
constexpr double kSlowTurns = 0.01;  // share of turns that may last longer than a command stands
constexpr int kHalvings = 6;         // of the share, before a round is given up

Result<Solution> solve_again(const CostTable& costs, const Motion& motion, const ControlMode& mode,
                             int jobs) {
  if (mode.by_state)
    return solve_joint(costs, motion, joint_config(mode), mode.served_headings, jobs);
  return solve(costs, motion.velocities, motion.v0, paper_config(mode), jobs);
}

CostTable costs_of(const SpriteData& data) {
  CostTable costs{data.row_start, data.transitions, {}, {}};
  costs.kept.assign(data.samples.size(), 1);
  return costs;
}

// Solves every mode of `model` for the samples of `data`, and measures what it serves.
Result<Sprite> solve_modes(SpriteData& data, const SpriteData& model, double v0,
                           const ChoiceConfig& config) {
  CostTable costs = costs_of(data);
  std::vector<Vec2> velocities;
  std::vector<float> skip_costs;
  std::vector<std::string> tags;
  for (const Sample& s : data.samples) {
    velocities.push_back(s.velocity);
    skip_costs.push_back(s.skip_cost);
    tags.push_back(data.tags[s.tag]);
  }
  costs.needed = needed_transitions(costs, tags);
  data.modes.clear();
  for (const ControlMode& mode : model.modes) {
    auto solution = solve_again(costs, {velocities, skip_costs, v0}, mode, config.jobs);
    if (!solution) return solution.error();
    solution->mode.name = mode.name;
    data.modes.push_back(std::move(solution->mode));
  }
  for (std::size_t m = 0; m < data.modes.size(); ++m) {
    const auto trial = make_sprite(data);
    if (!trial) return trial.error();
    serve(*trial, static_cast<int>(m), config.seed, model.modes[m].served, data.modes[m]);
  }
  return make_sprite(data);
}

// How often a player gets to see each sample, in the default mode.
std::vector<std::uint64_t> count_shown(const Sprite& sprite, const ChoiceConfig& config) {
  std::vector<std::uint64_t> shown(sprite.samples().size(), 0);
  Random random{config.seed};
  Actor actor = make_actor(sprite, {}, config.seed);
  std::uint64_t until = 0;
  for (std::uint64_t tick = 0; tick < config.ticks; ++tick) {
    if (tick >= until) {
      const double kind = random.unit();
      const auto compass = static_cast<Direction>(random.below(kCompassCount));
      set_direction(sprite, actor,
                    kind < kResting             ? Direction::Rest
                    : kind < kResting + kIdling ? Direction::None
                                                : compass);
      const double seconds = kShortest + (kLongest - kShortest) * random.unit();
      until = tick + static_cast<std::uint64_t>(std::ceil(seconds * sprite.fps()));
    }
    step(sprite, actor);
    ++shown[actor.sample];
  }
  return shown;
}

// The strongly connected part of the chosen samples that is shown most; the others are taken out.
void keep_connected(const SpriteData& data, const std::vector<std::uint64_t>& shown,
                    std::vector<std::uint8_t>& chosen) {
  CostTable graph;
  graph.row_start.push_back(0);
  for (std::size_t i = 0; i < data.samples.size(); ++i) {
    for (std::uint32_t k = data.row_start[i]; k < data.row_start[i + 1]; ++k)
      if (chosen[i] != 0 && chosen[data.transitions[k].to] != 0)
        graph.transitions.push_back(data.transitions[k]);
    graph.row_start.push_back(static_cast<std::uint32_t>(graph.transitions.size()));
  }
  graph.kept = chosen;
  const Components parts = find_components(graph);
  std::vector<std::uint64_t> worth(parts.count, 0);
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (chosen[i] != 0) worth[parts.of[i]] += shown[i] + 1;
  const auto best =
      static_cast<std::uint32_t>(std::max_element(worth.begin(), worth.end()) - worth.begin());
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (parts.of[i] != best) chosen[i] = 0;
}

// The way to every tag anew; cuts lead where they led.
Result<void> solve_actions(const SpriteData& large, SampleChoice& choice) {
  std::vector<std::uint32_t> number(large.samples.size(), kNoSample);
  for (std::uint32_t k = 0; k < choice.from.size(); ++k) number[choice.from[k]] = k;
  SpriteData& data = choice.data;
  data.action_tau = large.action_tau;
  data.action_horizon = large.action_horizon;
  const ActionConfig config{.tau = large.action_tau,
                            .horizon = static_cast<int>(large.action_horizon)};
  for (const ActionTable& action : large.actions) {
    std::vector<Cut> cuts;
    for (const std::uint32_t i : choice.from)
      cuts.push_back({number[action.cut[i]], action.cut_cost[i]});
    auto table = solve_action(costs_of(data), data.samples, action.tag, cuts, config);
    if (!table) return table.error();
    data.actions.push_back(std::move(*table));
  }
  return {};
}

// One mode's state between two rounds, all in the numbering of the large sprite.
class Chooser {
 public:
  Chooser(const SpriteData& data, const ChoiceConfig& config)
      : data_(data), config_(config), v0_(usual_v0(measure_speeds(data.samples))) {
    for (const Sample& s : data.samples) chosen_.push_back(s.kept == 1 ? 1 : 0);
    is_protected_.assign(data.samples.size(), 0);
    for (const SampleEvent& event : data.events) is_protected_[event.sample] = 1;
    for (const ActionTable& action : data.actions)
      for (const std::uint32_t to : action.cut)
        if (to != kNoSample) is_protected_[to] = 1;
  }

  Result<SampleChoice> run() {
    auto tried = attempt(chosen_);
    if (!tried) return tried.error();
    protect_actions();
    double under = 0;  // how far below the limit a round goes
    for (double share = config_.share; weight(chosen_) > config_.limit;) {
      const double left = weight(chosen_), due = config_.limit * (1 - under);
      std::vector<std::uint8_t> fewer = without_least(left, std::max(due, left * (1 - share)));
      auto next = fewer == chosen_ || !is_complete(fewer) ? Result<bool>(false) : attempt(fewer);
      if (!next) return next.error();
      if (*next) {
        share = std::min(config_.share, 2 * share);
        under = 0;
      } else if (left * (1 - share) <= due && under < config_.share) {
        under = under == 0 ? std::ldexp(config_.share, -kHalvings) : 2 * under;
      } else if (share > std::ldexp(config_.share, -kHalvings)) {
        share /= 2;
      } else if (is_strict_) {
        is_strict_ = false;  // small means slow, then
        share = config_.share;
        under = 0;
      } else {
        return Error{ErrorCode::BadContent,
                     data_.name + ": " + amount(weight(chosen_)) + " is the least that serves " +
                         "every direction and tag, " + amount(config_.limit) + " at most are due"};
      }
    }
    if (auto solved = solve_actions(data_, best_); !solved) return solved.error();
    return std::move(best_);
  }

 private:
  double weight_of(std::size_t i) const { return config_.weights.empty() ? 1 : config_.weights[i]; }
  double weight(const std::vector<std::uint8_t>& chosen) const {
    double sum = 0;
    std::size_t ways = 0;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (chosen[i] == 0) continue;
      sum += weight_of(i);
      for (std::uint32_t k = data_.row_start[i]; k < data_.row_start[i + 1]; ++k)
        ways += chosen[data_.transitions[k].to];
    }
    return sum + config_.transition_weight * static_cast<double>(ways);
  }
  double ways_of(std::uint32_t i) const { return data_.row_start[i + 1] - data_.row_start[i]; }
  std::string amount(double value) const {
    if (config_.weights.empty()) return std::to_string(std::llround(value)) + " samples";
    return std::to_string(std::llround(value / 1000)) + " kB of samples";
  }

  // Solves and drives a choice, and takes it if every direction is still travelled.
  Result<bool> attempt(const std::vector<std::uint8_t>& chosen) {
    SampleChoice trial = take_samples(data_, chosen);
    const auto sprite = solve_modes(trial.data, data_, v0_, config_);
    if (!sprite) return sprite.error();
    const std::uint32_t due = data_.modes.front().served;
    const bool first = shown_.empty();
    if (!first && (trial.data.modes.front().served & due) != due) return false;
    const double slow = slow_share(*sprite);
    if (first) most_slow_ = std::max(kSlowTurns, slow);
    if (is_strict_ && slow > most_slow_) return false;
    shown_.assign(data_.samples.size(), 0);
    const auto counts = count_shown(*sprite, config_);
    for (std::size_t k = 0; k < counts.size(); ++k) shown_[trial.from[k]] = counts[k];
    chosen_ = chosen;
    best_ = std::move(trial);
    return true;
  }

  // Of the turns asked for, how many were not made before another was asked for.
  double slow_share(const Sprite& sprite) const {
    SteerTally tally;
    const double seconds = static_cast<double>(config_.ticks) / 4 / sprite.fps();
    const auto frames = static_cast<std::uint64_t>(seconds * sprite.fps());
    const KeyScript script =
        random_script(seconds, kLongest / 2, kLongest, sprite.fps(), config_.seed);
    tally_steering(sprite, 0, script, frames, config_.seed, tally);
    return tally.unfinished / std::max(1.0, static_cast<double>(tally.turns.size()));
  }

  // Tags that no steering shows are there for actions, and are played as a whole.
  void protect_actions() {
    std::vector<std::uint8_t> is_steered(data_.tags.size(), 0);
    for (std::size_t i = 0; i < shown_.size(); ++i)
      if (shown_[i] > 0) is_steered[data_.samples[i].tag] = 1;
    for (std::size_t i = 0; i < shown_.size(); ++i)
      if (chosen_[i] != 0 && is_steered[data_.samples[i].tag] == 0) is_protected_[i] = 1;
  }

  std::vector<std::uint8_t> without_least(double left, double goal) const {
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < chosen_.size(); ++i)
      if (chosen_[i] != 0 && is_protected_[i] == 0) order.push_back(i);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return shown_[a] < shown_[b]; });
    std::vector<std::uint8_t> fewer = chosen_;
    for (std::size_t k = 0; k < order.size() && left > goal; ++k) {
      fewer[order[k]] = 0;
      left -= weight_of(order[k]) + config_.transition_weight * ways_of(order[k]);
    }
    keep_connected(data_, shown_, fewer);
    return fewer;
  }

  // True if nothing that is protected and no tag is lost.
  bool is_complete(const std::vector<std::uint8_t>& fewer) const {
    std::vector<std::uint8_t> before(data_.tags.size(), 0), after = before;
    for (std::size_t i = 0; i < fewer.size(); ++i) {
      if (chosen_[i] == 0) continue;
      if (is_protected_[i] != 0 && fewer[i] == 0) return false;
      before[data_.samples[i].tag] = 1;
      if (fewer[i] != 0) after[data_.samples[i].tag] = 1;
    }
    return before == after;
  }

  const SpriteData& data_;
  const ChoiceConfig& config_;
  double v0_ = 0, most_slow_ = 0;
  bool is_strict_ = true;
  std::vector<std::uint8_t> chosen_, is_protected_;
  std::vector<std::uint64_t> shown_;
  SampleChoice best_;
};

}  // namespace

SampleChoice take_samples(const SpriteData& data, const std::vector<std::uint8_t>& chosen) {
  SampleChoice choice;
  std::vector<std::uint32_t> number(chosen.size(), kNoSample);
  for (std::uint32_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i] == 0) continue;
    number[i] = static_cast<std::uint32_t>(choice.from.size());
    choice.from.push_back(i);
  }
  SpriteData& out = choice.data;
  out.name = data.name;
  out.fps_numerator = data.fps_numerator;
  out.fps_denominator = data.fps_denominator;
  out.body_length = data.body_length;
  out.tags = data.tags;
  out.bodies = data.bodies;
  out.event_names = data.event_names;
  std::uint32_t clip = 0;
  out.row_start.push_back(0);
  for (std::size_t k = 0; k < choice.from.size(); ++k) {
    const std::uint32_t i = choice.from[k];
    Sample s = data.samples[i];
    if (k > 0 && (choice.from[k - 1] + 1 != i || data.samples[i - 1].clip != s.clip)) ++clip;
    s.clip = clip;
    if (s.mirror_of != kNoSample) s.mirror_of = number[s.mirror_of];
    const bool skips = k + 2 < choice.from.size() && choice.from[k + 2] == i + 2;
    if (!skips) s.skip_cost = std::numeric_limits<float>::infinity();
    out.samples.push_back(s);
    for (std::uint32_t t = data.row_start[i]; t < data.row_start[i + 1]; ++t) {
      const Transition& way = data.transitions[t];
      if (chosen[way.to] != 0) out.transitions.push_back({number[way.to], way.cost});
    }
    out.row_start.push_back(static_cast<std::uint32_t>(out.transitions.size()));
  }
  for (const SampleEvent& event : data.events)
    if (chosen[event.sample] != 0) out.events.push_back({number[event.sample], event.name});
  out.shadow_scale = data.shadow_scale;
  for (const FilmedShadow& shadow : data.shadows) {
    if (chosen[shadow.sample] == 0) continue;
    out.shadows.push_back(shadow);
    out.shadows.back().sample = number[shadow.sample];
  }
  return choice;
}

Result<SampleChoice> choose_samples(const SpriteData& data, const ChoiceConfig& config) {
  return Chooser(data, config).run();
}

}  // namespace vsprite
