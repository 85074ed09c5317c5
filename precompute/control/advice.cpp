// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/advice.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "control/response.h"
#include "similarity/features.h"
#include "vsprite/actor.h"
#include "vsprite/random.h"

namespace vsprite {
namespace {

constexpr int kStarts = 24, kLongest = 120, kWindow = 5;  // ticks
constexpr double kTurnedDeg = 22.5, kLeastShare = 0.25;
constexpr std::uint64_t kSettle = 60, kApart = 11, kRandomTicks = 18000;
constexpr double kScarce = 3, kSlowTurn = 1.5;  // s; times the median turn
constexpr std::size_t kMostSentences = 8;

double angle_deg(double x, double y, Direction direction) {
  const Vec2 u = unit_vector(direction);
  return angle_between(x, y, static_cast<double>(u.x), static_cast<double>(u.y)) * 180 / kPi;
}

// Drives turns and notes what was shown.
class Driver {
 public:
  Driver(const Sprite& sprite, int mode, std::uint64_t seed)
      : sprite_(sprite), mode_(mode), seed_(seed), shown_(sprite.samples().size(), 0) {
    const double usual = measure_speeds(sprite.samples()).usual;
    least_ = kLeastShare * usual * kWindow / sprite.fps() * static_cast<double>(kFixedOne);
  }

  TurnForecast turn(Direction from, Direction to) {
    std::vector<double> frames, costs;
    Actor actor = make_actor(sprite_, {}, seed_, mode_);
    set_direction(sprite_, actor, from);
    for (std::uint64_t t = 0; t < kSettle; ++t) tick(actor);
    for (int k = 0; k < kStarts; ++k) {
      Actor trial = actor;
      double worst = 0;
      frames.push_back(ask(trial, to, worst));
      costs.push_back(worst);
      for (std::uint64_t t = 0; t < kApart; ++t) tick(actor);
    }
    std::sort(frames.begin(), frames.end());
    std::sort(costs.begin(), costs.end());
    return {from, to, frames[kStarts / 2], frames[kStarts * 9 / 10], costs[kStarts / 2], 0};
  }

  void wander() {
    const double fps = sprite_.fps();
    const KeyScript script =
        random_script(static_cast<double>(kRandomTicks) / fps, 0.5, 3, fps, seed_);
    Actor actor = make_actor(sprite_, {}, seed_, mode_);
    for (std::uint64_t t = 0; t < kRandomTicks; ++t) {
      set_direction(sprite_, actor, script.at(t));
      tick(actor);
    }
    for (const Direction d : {Direction::None, Direction::Rest}) {
      set_direction(sprite_, actor, d);
      for (std::uint64_t t = 0; t < kRandomTicks / 10; ++t) tick(actor);
    }
  }

  const std::vector<std::uint8_t>& shown() const { return shown_; }

 private:
  void tick(Actor& actor) {
    step(sprite_, actor);
    shown_[actor.sample] = 1;
  }
  // Ticks until the travelled direction fits; the dearest jump before that.
  double ask(Actor& actor, Direction to, double& worst) {
    std::array<Position, kWindow + 1> past;
    past.fill(actor.position);
    set_direction(sprite_, actor, to);
    for (int t = 1; t <= kLongest; ++t) {
      const std::uint32_t before = actor.sample;
      tick(actor);
      worst = std::max(worst, static_cast<double>(shown_cost(sprite_, before, actor)));
      std::rotate(past.begin(), past.begin() + 1, past.end());
      past.back() = actor.position;
      const auto x = static_cast<double>(past.back().x - past.front().x);
      const auto y = static_cast<double>(past.back().y - past.front().y);
      if (std::hypot(x, y) >= least_ && angle_deg(x, y, to) <= kTurnedDeg) return t;
    }
    return kLongest;
  }

  const Sprite& sprite_;
  int mode_;
  std::uint64_t seed_;
  double least_ = 0;
  std::vector<std::uint8_t> shown_;
};

// The compass direction of every moving sample, or None.
std::vector<Direction> headings_of(const Sprite& sprite, double moving) {
  std::vector<Direction> headings;
  for (const Sample& s : sprite.samples()) {
    const double speed =
        std::hypot(static_cast<double>(s.velocity.x), static_cast<double>(s.velocity.y));
    headings.push_back(s.kept != 0 && speed > moving ? nearest_direction(s.velocity)
                                                     : Direction::None);
  }
  return headings;
}

// How often one heading gave way to the other within two seconds of one clip.
int count_filmed(const Sprite& sprite, const std::vector<Direction>& headings, Direction from,
                 Direction to) {
  const double limit = 2 * sprite.fps();
  int count = 0;
  double since = limit + 1;  // ticks since `from` was last seen
  for (std::size_t i = 0; i < headings.size(); ++i) {
    if (i == 0 || sprite.samples()[i].clip != sprite.samples()[i - 1].clip) since = limit + 1;
    since += sprite.samples()[i].duration;
    if (headings[i] == from) since = 0;
    if (headings[i] != to || since > limit) continue;
    ++count;
    since = limit + 1;
  }
  return count;
}

void fill_rose(const Sprite& sprite, double moving, Advice& advice) {
  std::array<double, kRoseSectors> way{};
  for (const Sample& s : sprite.samples()) {
    if (s.kept == 0) continue;
    const auto x = static_cast<double>(s.velocity.x), y = static_cast<double>(s.velocity.y);
    const double seconds = s.duration / sprite.fps(), speed = std::hypot(x, y);
    if (speed <= moving) {
      advice.standing += seconds;
      continue;
    }
    const double turn = std::atan2(y, x) / (2 * kPi) * kRoseSectors;
    const auto sector = static_cast<std::size_t>(std::lround(turn) + 2 * kRoseSectors);
    advice.rose[sector % kRoseSectors].seconds += seconds;
    way[sector % kRoseSectors] += seconds * speed;
  }
  for (std::size_t k = 0; k < kRoseSectors; ++k)
    if (advice.rose[k].seconds > 0) advice.rose[k].speed = way[k] / advice.rose[k].seconds;
}

std::string name(Direction d) { return std::string(direction_name(d)); }

std::string number(double value) {
  std::string digits = std::to_string(std::round(value * 10) / 10);
  digits.resize(digits.size() - 5);
  return digits.ends_with(".0") ? digits.substr(0, digits.size() - 2) : digits;
}

std::string times(int count) {
  return count == 0 ? "never" : count == 1 ? "once" : std::to_string(count) + " times";
}

// Only what the view can hold: both ends of a turn are served, as are both neighbours of a
// direction that is asked for.
void write_sentences(const Sprite& sprite, std::uint32_t served, Advice& advice) {
  if (served == 0) {
    advice.film.push_back(
        "no direction can be steered: film the subject walking across the view, both ways");
    return;
  }
  std::vector<TurnForecast> slow = advice.turns;
  std::sort(slow.begin(), slow.end(), [](const auto& a, const auto& b) {
    return std::tie(a.frames, a.slow, b.from, b.to) > std::tie(b.frames, b.slow, a.from, a.to);
  });
  const double usual = slow.empty() ? 0 : slow[slow.size() / 2].frames;
  for (const TurnForecast& t : slow) {
    if (advice.film.size() == kMostSentences / 2 || t.frames < kSlowTurn * usual) break;
    const std::string takes = t.frames >= kLongest ? "over " + number(kLongest) : number(t.frames);
    advice.film.push_back("turning from " + name(t.from) + " to " + name(t.to) + " takes " + takes +
                          " frames (" + number(t.frames / sprite.fps()) + " s), filmed " +
                          times(t.filmed) + ": film 20 s of " + name(t.from) + "-to-" + name(t.to) +
                          " turns");
  }
  for (std::uint32_t d = 0; d < kCompassCount; ++d) {
    const std::uint32_t k = 2 * d;  // half of each neighbouring sector counts too
    const double seconds = advice.rose[k].seconds +
                           advice.rose[(k + 1) % kRoseSectors].seconds / 2 +
                           advice.rose[(k + 15) % kRoseSectors].seconds / 2;
    const auto is_served = [&](std::uint32_t e) { return (served >> e % 8 & 1u) != 0; };
    const Direction direction = static_cast<Direction>(d);
    if (!is_served(d) && is_served(d + 1) && is_served(d + 7)) {
      advice.film.push_back("nothing travels " + name(direction) +
                            ", between two directions that do: film 20 s of it");
    } else if (is_served(d) && seconds < kScarce) {
      advice.film.push_back("only " + number(seconds) + " s of film go " + name(direction) +
                            ": film 20 s of it");
    }
  }
  if (advice.film.size() > kMostSentences) advice.film.resize(kMostSentences);
  if (advice.film.empty())
    advice.film.push_back("no turn is much slower than the others: more of everything, if at all");
}

}  // namespace

Advice make_advice(const Sprite& sprite, int mode, std::uint64_t seed) {
  Advice advice;
  const std::uint32_t served =
      sprite.data().modes[static_cast<std::size_t>(mode)].served & ((1u << kCompassCount) - 1);
  const double moving = measure_speeds(sprite.samples()).moving;
  const std::vector<Direction> headings = headings_of(sprite, moving);
  Driver driver(sprite, mode, seed);
  for (std::uint32_t from = 0; from < kCompassCount; ++from) {
    for (std::uint32_t to = 0; to < kCompassCount; ++to) {
      if (from == to || (served >> from & 1u) == 0 || (served >> to & 1u) == 0) continue;
      const auto f = static_cast<Direction>(from), t = static_cast<Direction>(to);
      advice.turns.push_back(driver.turn(f, t));
      advice.turns.back().filmed = count_filmed(sprite, headings, f, t);
    }
  }
  driver.wander();
  for (std::uint32_t i = 0; i < driver.shown().size(); ++i) {
    if (sprite.samples()[i].kept != 0 && driver.shown()[i] == 0) advice.unused.push_back(i);
  }
  fill_rose(sprite, moving, advice);
  write_sentences(sprite, served, advice);
  return advice;
}

}  // namespace vsprite
