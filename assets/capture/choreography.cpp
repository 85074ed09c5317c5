// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// A seeded planner over a small dynamic model. Every quantity that shows (tail beat, bend,
// hovering) is a smooth function of speed, thrust and turn rate, so that the fish passes through
// like states again and again: this is what makes a film steerable.
#include "choreography.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "random.h"

namespace vsprite::capture {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kQuarter = kPi / 4;
constexpr double kPitchOfClimb =
    0.87;  // body pitch over elevation of the path: +-78 of +-90 degrees
constexpr double kPitchRate = 7.0 * kPi / 180;  // per frame, at the fastest
constexpr double kBurstSpeed = 232, kGlideSpeed = 148, kTurnSpeed = 150;  // px/s
constexpr int kBurst = 17, kGlide = 15;                                   // frames

/// A move from one value to another: rest, ramp, even rate, ramp, rest.
struct Move {
  double from = 0, to = 0;
  int frames = 1;

  // With ramps of a quarter of the time the greatest rate is 4/3 of the mean.
  static double ease(double u) {
    constexpr double r = 0.25, peak = 1 / (1 - r);
    u = std::clamp(u, 0.0, 1.0);
    if (u > 0.5) return 1 - ease(1 - u);
    if (u >= r) return peak * (u - r / 2);
    // Integral of peak (1 - cos(pi u / r)) / 2: smooth to the second derivative.
    return peak * 0.5 * (u - r / kPi * std::sin(kPi * u / r));
  }
  double at(int t) const { return from + (to - from) * ease(static_cast<double>(t) / frames); }
};

struct State {
  FishPose pose;
  double thrust = 0;    // 0 .. 1, filtered
  double yaw_rate = 0;  // radians a frame, filtered
  double pitch_rate = 0;
  int facing = 0;   // 0 right, 1 left
  int heading = 0;  // 0..7, kRest
};

/// One leg, fully decided: it can be simulated from a State without any further choice.
struct Leg {
  int heading = 0;
  int facing = 0;
  Move yaw, pitch;
  int turn = 0;         // frames until both moves are done
  int cruise = 0;       // frames after that
  int burst_start = 0;  // where in the burst-glide cycle the cruise begins
};

double wrap_angle(double a) { return std::remainder(a, 2 * kPi); }

/// Elevation of the path for a heading, radians, up positive.
double elevation_of(int heading) {
  constexpr int steps[8] = {0, -1, -2, -1, 0, 1, 2, 1};
  return heading == kRest ? 0 : steps[heading] * kQuarter;
}

/// Which way a heading makes the fish face: 0 right, 1 left, -1 either.
int facing_of(int heading) {
  constexpr int faces[9] = {0, 0, -1, 1, 1, 1, -1, 0, -1};
  return faces[heading];
}

double thrust_goal(const Leg& leg, int t) {
  if (leg.heading == kRest) return 0;
  if (t < leg.turn * 6 / 10) return 0.45;
  const int cycle = (t - leg.turn * 6 / 10 + leg.burst_start) % (kBurst + kGlide);
  return cycle < kBurst ? 1.0 : 0.08;
}

double speed_goal(const Leg& leg, int t, double thrust) {
  if (leg.heading == kRest) return 0;
  // Sharp climbs and dives are turned slowly.
  const double sharp = std::abs(leg.pitch.to - leg.pitch.from);
  if (t < leg.turn * 6 / 10) return kTurnSpeed - 38 * std::min(sharp, 2.0);
  return kGlideSpeed + (kBurstSpeed + 14 - kGlideSpeed) * thrust;
}

/// One frame of motion. All that shows of the fish is set here.
void advance(State& s, const Leg& leg, int t, double fps) {
  FishPose& p = s.pose;
  const double yaw = leg.yaw.at(t + 1), pitch = leg.pitch.at(t + 1);
  s.yaw_rate += 0.5 * ((yaw - p.yaw) - s.yaw_rate);
  s.pitch_rate += 0.5 * ((pitch - p.pitch) - s.pitch_rate);
  p.yaw = yaw;
  p.pitch = pitch;
  s.thrust += 0.26 * (thrust_goal(leg, t) - s.thrust);
  const double rate = leg.heading == kRest ? 0.11 : 0.16;
  p.speed += rate * (speed_goal(leg, t, s.thrust) - p.speed);

  p.hover = std::exp(-std::pow(p.speed / 75, 2));
  p.tail_phase += (1.05 + 1.75 * s.thrust + 0.25 * p.hover) / fps;
  p.tail_amplitude = 0.20 + 0.80 * s.thrust;
  p.bend = 4.2 * s.yaw_rate;
  p.arch = 3.4 * s.pitch_rate;
  p.heading = leg.heading == kRest ? -1 : leg.heading;

  const double elevation = std::clamp(p.pitch / kPitchOfClimb, -kPi / 2, kPi / 2);
  p.x += p.speed / fps * std::cos(elevation) * std::cos(p.yaw);
  p.y -= p.speed / fps * std::sin(elevation);
}

/// How far the line from nose to tail, with its margin, stays inside the frame; negative: outside.
double room(const FishPose& p, const ChoreographyConfig& c) {
  const double dx = std::cos(p.pitch) * std::cos(p.yaw), dy = -std::sin(p.pitch);
  double least = 1e9;
  for (const double along : {c.nose, -c.tail}) {
    const double x = p.x + along * dx, y = p.y + along * dy;
    const double side_x = 8 + c.margin * std::abs(dy), side_y = 8 + c.margin * std::cos(p.pitch);
    least = std::min({least, x - side_x, c.width - x - side_x, y - side_y, c.height - y - side_y});
  }
  return least;
}

/// Whether nothing of the fish can be seen.
bool outside(const FishPose& p, const ChoreographyConfig& c) {
  const double dx = std::cos(p.pitch) * std::cos(p.yaw), dy = -std::sin(p.pitch);
  const double fat = c.margin + 14;
  const auto beyond = [&](double centre, double step, double size) {
    const double a = centre + c.nose * step, b = centre - c.tail * step;
    return std::max(a, b) < -fat || std::min(a, b) > size + fat;
  };
  return beyond(p.x, dx, c.width) || beyond(p.y, dy, c.height);
}

class Planner {
 public:
  explicit Planner(const ChoreographyConfig& config) : c_(config), random_(config.seed) {}
  Choreography run();

 private:
  int at() const { return static_cast<int>(out_.poses.size()); }
  Leg make_leg(const State& s, int heading, int cruise);
  double least_room(State s, const Leg& leg) const;
  double best_sequel(const State& after);
  double price(int from, int to) const;
  std::optional<Leg> choose();
  void perform(const Leg& leg);
  void leave_and_return();
  void fill_velocities();

  ChoreographyConfig c_;
  Random random_;
  Choreography out_;
  State s_;
  std::array<double, 8> sector_frames_{};
  int yaw_side_ = 0;
};

Leg Planner::make_leg(const State& s, int heading, int cruise) {
  Leg leg;
  leg.heading = heading;
  leg.facing = facing_of(heading) < 0 ? s.facing : facing_of(heading);
  leg.cruise = cruise;
  const double jitter = random_.uniform(-0.09, 0.09);
  double elevation = elevation_of(heading) + (heading == kRest ? 0.3 * jitter : jitter);
  elevation = std::clamp(elevation, -kPi / 2, kPi / 2);
  leg.pitch = {s.pose.pitch, kPitchOfClimb * elevation, 1};
  // The new yaw is a multiple of pi; which way round is drawn, so that half of the turns show the
  // face and half the tail.
  double turn = wrap_angle((leg.facing == 1 ? kPi : 0) - s.pose.yaw);
  if (std::abs(turn) > 1) turn = random_.uniform() < 0.5 ? std::abs(turn) : -std::abs(turn);
  leg.yaw = {s.pose.yaw, s.pose.yaw + turn, 1};
  const double pitch_frames = std::abs(leg.pitch.to - leg.pitch.from) * 4 / 3 / kPitchRate;
  const double yaw_frames = std::abs(turn) > 1 ? random_.uniform(16, 21) : 4;
  leg.pitch.frames = std::max(9, static_cast<int>(std::ceil(pitch_frames)));
  leg.yaw.frames = static_cast<int>(yaw_frames);
  leg.turn = std::max(leg.pitch.frames, leg.yaw.frames);
  leg.burst_start = random_.uniform() < 0.8 ? 0 : kBurst;
  return leg;
}

double Planner::least_room(State s, const Leg& leg) const {
  double least = 1e9;
  for (int t = 0; t < leg.turn + leg.cruise; ++t) {
    advance(s, leg, t, c_.fps);
    least = std::min(least, room(s.pose, c_));
  }
  return least;
}

/// The price of the cheapest leg that fits in after `after`; a high one if none does.
double Planner::best_sequel(const State& after) {
  double best = 30;
  for (int heading = 0; heading < 8; ++heading) {
    if (heading == after.heading) continue;
    const double cost = price(after.heading, heading);
    if (cost < best && least_room(after, make_leg(after, heading, 10)) > 0) best = cost;
  }
  return best;
}

double Planner::price(int from, int to) const {
  const int apart = from == kRest ? 0 : std::abs((to - from + 12) % 8 - 4);  // 4 same .. 0 opposite
  const bool wanted = apart == 0 || apart == 3;
  const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(to);
  double mean = 1;
  for (const double f : sector_frames_) mean += f / 8;
  const double count = out_.turns[a][b];
  return std::pow(count, 1.5) * (wanted ? 0.7 : 1.0) + 4.0 * (sector_frames_[b] / mean - 1);
}

/// The cheapest leg with room, counting the one that may follow it.
std::optional<Leg> Planner::choose() {
  std::optional<Leg> best, roomiest;
  double best_price = 1e9, most_room = -1e9;
  for (int heading = 0; heading < 8; ++heading) {
    if (heading == s_.heading) continue;
    for (int cruise = 12 + static_cast<int>(random_.uniform(0, 4)); cruise < 44; cruise += 5) {
      const Leg leg = make_leg(s_, heading, cruise);
      const double space = least_room(s_, leg);
      if (space > most_room) most_room = space, roomiest = leg;
      if (space < 0) break;
      State after = s_;
      for (int t = 0; t < leg.turn + leg.cruise; ++t) advance(after, leg, t, c_.fps);
      after.heading = heading;
      after.facing = leg.facing;
      const double cost = price(s_.heading, heading) + 0.9 * best_sequel(after) +
                          random_.uniform(0, 0.6) - 0.012 * cruise;
      if (cost < best_price) best_price = cost, best = leg;
    }
  }
  if (best) return best;
  return most_room > -25 ? roomiest : best;  // a fin may brush the edge
}

void Planner::perform(const Leg& leg) {
  const auto from = static_cast<std::size_t>(s_.heading),
             to = static_cast<std::size_t>(leg.heading);
  if (from != to) ++out_.turns[from][to];
  for (int t = 0; t < leg.turn + leg.cruise && at() < c_.frames; ++t) {
    advance(s_, leg, t, c_.fps);
    out_.poses.push_back(s_.pose);
    if (leg.heading != kRest) sector_frames_[to] += 1;
  }
  s_.heading = leg.heading;
  s_.facing = leg.facing;
}

/// Straight on out of the picture, a short absence, and in again from another side.
void Planner::leave_and_return() {
  constexpr int leaves[8] = {0, 4, 1, 5, 2, 6, 3, 7};  // headings out, and in again
  constexpr int enters[8] = {3, 1, 4, 7, 5, 0, 2, 4};
  const int way_out = leaves[out_.exits % 8], way_in = enters[out_.exits % 8];
  Leg leg = make_leg(s_, way_out == s_.heading ? (way_out + 1) % 8 : way_out, 0);
  State probe = s_;
  int frames = 0;
  for (; frames < 200 && !outside(probe.pose, c_); ++frames) advance(probe, leg, frames, c_.fps);
  leg.cruise = std::max(0, frames - leg.turn);
  perform(leg);
  const int absence = static_cast<int>(random_.uniform(6, 14));
  FishPose gone = s_.pose;
  gone.away = true;
  gone.velocity_x = gone.velocity_y = 0;
  for (int k = 0; k < absence && at() < c_.frames; ++k) out_.poses.push_back(gone);

  // Come in along the heading that passes the middle of the frame, from just outside.
  const int entry_facing = facing_of(way_in) < 0 ? 0 : facing_of(way_in);
  const double elevation = elevation_of(way_in);
  const double dx = std::cos(elevation) * (entry_facing == 1 ? -1 : 1), dy = -std::sin(elevation);
  s_.facing = entry_facing;
  s_.heading = way_in;
  s_.pose.yaw = entry_facing == 1 ? kPi : 0;
  s_.pose.pitch = kPitchOfClimb * elevation;
  s_.pose.x = c_.width / 2 + random_.uniform(-40, 40);
  s_.pose.y = c_.height / 2 + random_.uniform(-30, 30);
  while (!outside(s_.pose, c_)) s_.pose.x -= 4 * dx, s_.pose.y -= 4 * dy;
  Leg entry = make_leg(s_, way_in, 0);
  probe = s_;
  frames = 0;
  while (frames < 120 && room(probe.pose, c_) < 0) advance(probe, entry, frames++, c_.fps);
  entry.cruise = std::max(0, frames + 3 - entry.turn);
  perform(entry);
  ++out_.exits;
}

void Planner::fill_velocities() {
  auto& poses = out_.poses;
  for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
    if (poses[i - 1].away || poses[i].away || poses[i + 1].away) continue;
    poses[i].velocity_x = (poses[i + 1].x - poses[i - 1].x) * c_.fps / 2;
    poses[i].velocity_y = (poses[i + 1].y - poses[i - 1].y) * c_.fps / 2;
  }
}

Choreography Planner::run() {
  s_.pose.x = 250;
  s_.pose.y = c_.height / 2;
  s_.pose.speed = 0;
  s_.heading = kRest;
  perform(make_leg(s_, kRest, 24));
  for (int legs = 1; at() < c_.frames; ++legs) {
    if (legs % c_.leave_every == 0) {
      leave_and_return();
      continue;
    }
    if (legs % c_.rest_every == 0 && s_.heading != kRest) {
      const Leg rest = make_leg(s_, kRest, static_cast<int>(random_.uniform(24, 46)));
      if (least_room(s_, rest) > 0) {
        perform(rest);
        continue;
      }
    }
    const std::optional<Leg> leg = choose();
    if (leg) {
      perform(*leg);
    } else {
      leave_and_return();  // cornered: the way out is straight on
    }
  }
  fill_velocities();
  return std::move(out_);
}

}  // namespace

Choreography choreograph(const ChoreographyConfig& config) { return Planner(config).run(); }

}  // namespace vsprite::capture
