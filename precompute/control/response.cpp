// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Headless runs of the engine's actor, measured as DESIGN section 4 defines.
#include "control/response.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "vsprite/actor.h"
#include "vsprite/random.h"

namespace vsprite {
namespace {

constexpr int kStarts = 5;
constexpr double kSettle = 2, kTravel = 10;        // s
constexpr double kReachable = 60, kTurned = 22.5;  // degrees
constexpr std::size_t kWindow = 5;                 // film frames of the travelled direction
constexpr double kLeastShare = 0.25;               // of the usual speed

double degrees(double radians) { return radians * 180 / kPi; }

// Angle between a displacement and a compass direction, degrees.
double error_deg(Position from, Position to, Direction direction) {
  const Vec2 unit = unit_vector(direction);
  return degrees(angle_between(static_cast<double>(to.x - from.x),
                               static_cast<double>(to.y - from.y), static_cast<double>(unit.x),
                               static_cast<double>(unit.y)));
}

double length_px(Position from, Position to) {
  const double x = static_cast<double>(to.x - from.x), y = static_cast<double>(to.y - from.y);
  return std::sqrt(x * x + y * y) / static_cast<double>(kFixedOne);
}

double usual_speed(const Sprite& sprite) { return measure_speeds(sprite.samples()).usual; }

std::uint64_t ticks(double seconds, double fps) {
  return static_cast<std::uint64_t>(std::ceil(seconds * fps));
}

void run(const Sprite& sprite, Actor& actor, std::uint64_t count) {
  for (std::uint64_t t = 0; t < count; ++t) step(sprite, actor);
}

// Nearest rank for p. Pre: not empty.
double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return (values[(n - 1) / 2] + values[n / 2]) / 2;
}
double percentile(std::vector<double> values, std::size_t percent) {
  std::sort(values.begin(), values.end());
  return values[(values.size() * percent + 99) / 100 - 1];
}

// Follows the last command until the travelled direction fits it, and until the picture differs
// from what the command before would have shown.
class TurnMeter {
 public:
  TurnMeter(const Sprite& sprite, double least_px, std::uint32_t served, SteerTally& tally)
      : sprite_(sprite), least_px_(least_px), served_(served), tally_(tally) {}

  // `actor` has not been told yet.
  void command(const Actor& actor, Direction direction, std::uint64_t tick) {
    const auto stood = static_cast<double>(tick - since_);
    if (waiting_) {
      tally_.turns.push_back(stood);
      ++tally_.unfinished;
    }
    if (unchanged_) tally_.first_changes.push_back(stood);
    waiting_ = unchanged_ = is_served(direction);
    wanted_ = direction;
    since_ = tick;
    shadow_ = actor;
  }
  // Before a tick's step.
  void look(Position position, std::uint64_t tick) {
    past_.push_back(position);
    if (past_.size() > kWindow + 1) past_.pop_front();
    if (!waiting_ || past_.size() <= kWindow) return;
    if (length_px(past_.front(), position) < least_px_) return;
    if (error_deg(past_.front(), position, wanted_) > kTurned) return;
    tally_.turns.push_back(static_cast<double>(tick - since_));
    waiting_ = false;
  }
  // After it.
  void compare(const Actor& actor, std::uint64_t tick) {
    if (!unchanged_) return;
    step(sprite_, shadow_);
    if (shadow_.sample == actor.sample) return;
    tally_.first_changes.push_back(static_cast<double>(tick + 1 - since_));
    unchanged_ = false;
  }
  void travel(Position from, Position to) {
    if (!is_served(wanted_)) return;
    const Vec2 unit = unit_vector(wanted_);
    tally_.way += length_px(from, to);
    tally_.along += (static_cast<double>(to.x - from.x) * static_cast<double>(unit.x) +
                     static_cast<double>(to.y - from.y) * static_cast<double>(unit.y)) /
                    static_cast<double>(kFixedOne);
    ++tally_.commanded_ticks;
  }

 private:
  bool is_served(Direction direction) const {
    const int d = static_cast<int>(direction);
    return d < kCompassCount && (served_ >> d & 1u) != 0;
  }

  const Sprite& sprite_;
  double least_px_ = 0;
  std::uint32_t served_ = 0;
  SteerTally& tally_;
  std::deque<Position> past_;
  Actor shadow_;
  Direction wanted_ = Direction::None;
  std::uint64_t since_ = 0;
  bool waiting_ = false, unchanged_ = false;
};

}  // namespace

SpeedScale measure_speeds(std::span<const Sample> samples) {
  std::vector<double> speeds, areas;
  for (const Sample& s : samples) {
    const double x = static_cast<double>(s.velocity.x), y = static_cast<double>(s.velocity.y);
    speeds.push_back(std::sqrt(x * x + y * y));
    areas.push_back(static_cast<double>(s.area));
  }
  return measure_speeds(std::move(speeds), std::move(areas));
}

double usual_v0(const SpeedScale& speeds) noexcept {
  return 0.35 * (speeds.usual > 0 ? speeds.usual : speeds.moving);
}

std::array<DirectionReport, kCompassCount> measure_directions(const Sprite& sprite, int mode,
                                                              std::uint64_t seed) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < sprite.samples().size(); ++i) {
    if (sprite.samples()[i].kept) kept.push_back(i);
  }
  Random random{seed};
  std::array<std::uint32_t, kStarts> starts{};
  for (std::uint32_t& start : starts) start = kept[random.below(kept.size())];
  const SpeedScale speeds = measure_speeds(sprite.samples());
  const double least = std::max(speeds.moving, kLeastShare * speeds.usual);

  std::array<DirectionReport, kCompassCount> reports{};
  for (int d = 0; d < kCompassCount; ++d) {
    DirectionReport& report = reports[static_cast<std::size_t>(d)];
    report.direction = static_cast<Direction>(d);
    double error = 0;
    for (const std::uint32_t start : starts) {
      Actor actor = make_actor(sprite, {}, seed, mode);
      actor.sample = start;
      set_direction(sprite, actor, report.direction);
      run(sprite, actor, ticks(kSettle, sprite.fps()));
      const Position from = actor.position;
      run(sprite, actor, ticks(kTravel, sprite.fps()));
      error += error_deg(from, actor.position, report.direction) / kStarts;
      report.speed += length_px(from, actor.position) / (kTravel * kStarts);
    }
    report.reachable = speeds.usual > 0 && report.speed >= least && error <= kReachable;
    report.raw_error_deg = error;
    if (report.reachable) report.tracking_error_deg = error;
  }
  return reports;
}

ServedDirections serve_directions(const std::array<DirectionReport, kCompassCount>& reports) {
  ServedDirections result;
  result.table_of.fill(Direction::Rest);
  result.table_of[static_cast<std::size_t>(Direction::None)] = Direction::None;
  for (std::size_t d = 0; d < kCompassCount; ++d) {
    if (!reports[d].reachable) continue;
    result.table_of[d] = static_cast<Direction>(d);
    result.served |= 1u << d;
  }
  // Within 60 degrees of a compass direction lie only its two neighbours, 45 degrees away.
  for (std::size_t d = 0; d < kCompassCount; ++d) {
    if (reports[d].reachable) continue;
    const DirectionReport* best = nullptr;
    for (const std::size_t turn : {std::size_t{1}, std::size_t{7}}) {
      const DirectionReport& near = reports[(d + turn) % kCompassCount];
      if (!near.reachable) continue;
      if (!best || *near.tracking_error_deg < *best->tracking_error_deg) best = &near;
    }
    if (best) result.table_of[d] = best->direction;
  }
  return result;
}

void serve(const Sprite& sprite, int mode, std::uint64_t seed, std::uint32_t wanted,
           ControlMode& result) {
  auto reports = measure_directions(sprite, mode, seed);
  for (std::size_t d = 0; d < kCompassCount; ++d) {
    if ((wanted >> d & 1u) == 0) reports[d].reachable = false;
  }
  const ServedDirections served = serve_directions(reports);
  result.served = served.served;
  result.table_of = served.table_of;
  result.served_headings = 0;
  const std::uint32_t fine = result.headings / kCompassCount;
  for (std::uint32_t h = 0; h < result.headings; ++h) {
    const std::uint32_t d = h / fine, after = h % fine == 0 ? d : (d + 1) % kCompassCount;
    if ((served.served >> d & 1u) != 0 && (served.served >> after & 1u) != 0)
      result.served_headings |= 1u << h;
  }
}

SteerReport SteerTally::report(double fps) const {
  SteerReport report;
  report.frames = costs.size();
  report.turns = static_cast<int>(turns.size());
  report.unfinished = unfinished;
  report.freezes = freezes;
  if (!turns.empty()) {
    report.turn_median = median(turns);
    report.turn_p95 = percentile(turns, 95);
  }
  if (!first_changes.empty()) {
    report.first_change_median = median(first_changes);
    report.first_change_p95 = percentile(first_changes, 95);
  }
  if (commanded_ticks > 0) report.speed = way * fps / static_cast<double>(commanded_ticks);
  if (way > 0) report.travel_share = along / way;
  if (costs.empty()) return report;
  double sum = 0;
  for (const double c : costs) sum += c;
  report.cost_mean = sum / static_cast<double>(costs.size());
  report.cost_p99 = percentile(costs, 99);
  report.cost_max = *std::max_element(costs.begin(), costs.end());
  report.jumps_per_second = static_cast<double>(jumps) * fps / static_cast<double>(costs.size());
  return report;
}

void tally_steering(const Sprite& sprite, int mode, const KeyScript& script, std::uint64_t frames,
                    std::uint64_t seed, SteerTally& tally, std::uint64_t* hash,
                    std::vector<TraceRow>* trace) {
  const double fps = sprite.fps();
  TurnMeter meter(sprite, kLeastShare * usual_speed(sprite) * static_cast<double>(kWindow) / fps,
                  sprite.data().modes[static_cast<std::size_t>(mode)].served, tally);
  Actor actor = make_actor(sprite, {}, seed, mode);
  StateHash states;
  tally.costs.reserve(tally.costs.size() + frames);
  for (std::uint64_t tick = 0; tick < frames; ++tick) {
    const Direction wanted = script.at(tick);
    if (wanted != actor.direction) meter.command(actor, wanted, tick);
    set_direction(sprite, actor, wanted);
    play_script(sprite, script, tick, actor);
    meter.look(actor.position, tick);
    const Actor before = actor;
    step(sprite, actor);
    meter.compare(actor, tick);
    meter.travel(before.position, actor.position);
    if (hash != nullptr) states.add(actor);
    tally.costs.push_back(static_cast<double>(shown_cost(sprite, before.sample, actor)));
    tally.jumps += actor.jumped;
    const bool over = before.shown >= sprite.samples()[before.sample].duration;
    // What an action holds is no freeze.
    tally.freezes += over && actor.sample == before.sample && actor.action == 0;
    if (trace) {
      trace->push_back({actor.tick, actor.sample,
                        static_cast<double>(actor.position.x) / static_cast<double>(kFixedOne),
                        static_cast<double>(actor.position.y) / static_cast<double>(kFixedOne),
                        actor.direction, actor.table, tally.costs.back()});
    }
  }
  if (hash != nullptr) *hash = states.digest();
}

SteerReport measure_steering(const Sprite& sprite, int mode, const KeyScript& script,
                             std::uint64_t frames, std::uint64_t seed,
                             std::vector<TraceRow>* trace) {
  SteerTally tally;
  std::uint64_t hash = 0;
  tally_steering(sprite, mode, script, frames, seed, tally, &hash, trace);
  SteerReport report = tally.report(sprite.fps());
  report.states_hash = hash;
  double error = 0;
  int reached = 0;
  for (const DirectionReport& d : measure_directions(sprite, mode, seed)) {
    if (!d.reachable) continue;
    error += *d.tracking_error_deg;
    ++reached;
  }
  if (reached > 0) report.tracking_error_deg = error / reached;
  return report;
}

KeyScript random_script(double seconds, double min_s, double max_s, double fps,
                        std::uint64_t seed) {
  Random random{seed};
  KeyScript script;
  std::size_t direction = random.below(kCompassCount);
  for (double t = 0; t < seconds; t += min_s + (max_s - min_s) * random.unit()) {
    direction = (direction + 1 + random.below(kCompassCount - 1)) % kCompassCount;
    script.entries.push_back({ticks(t, fps), static_cast<Direction>(direction)});
  }
  return script;
}

}  // namespace vsprite
