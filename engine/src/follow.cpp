// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// An actor that the game moves: which sample goes as it does, and how fast to play it.
#include <algorithm>
#include <cmath>

#include "actor_parts.h"
#include "vsprite/owner.h"
#include "vsprite/policy.h"

namespace vsprite {
namespace detail {
namespace {

constexpr int kAhead = 12;          // L
constexpr double kTrailWeight = 2;  // w
constexpr double kGoWeight = 1;
constexpr bool kTurning = true;
constexpr double kLeash = 1.0 / 3;  // body lengths
constexpr double kPull = 0.09;      // a tick, of the speed at most
constexpr double kSpring = 0.08;    // a tick, of the offset
constexpr double kLostShare = 0.9;  // of the leash
constexpr double kLostPace = 0.5;   // of the speed, along the way
constexpr double kRateOne = 65536;

struct Velocity {
  double x = 0, y = 0;
  double length() const noexcept { return std::sqrt(x * x + y * y); }
};

Velocity drive_of(const Actor& actor) noexcept {
  return {static_cast<double>(actor.drive_x), static_cast<double>(actor.drive_y)};
}

double rate_of(double wanted, double filmed) noexcept {
  if (!(filmed > 0)) return 1;
  return std::clamp(wanted / filmed, kSlowestRate, kFastestRate);
}

double leash_of(const SpriteData& data) noexcept {
  return kLeash * std::max(1.0, static_cast<double>(data.body_length)) * 65536;
}

// What the tables expect from a sample on: of the two headings beside the velocity, in proportion.
struct Beyond {
  const float* first = nullptr;
  const float* second = nullptr;
  double share = 0;  // of the second
  double at(std::uint32_t sample) const noexcept {
    return (1 - share) * static_cast<double>(first[sample]) +
           share * static_cast<double>(second[sample]);
  }
};

Beyond make_beyond(const SpriteData& data, const ControlMode& mode, const Actor& actor,
                   const Velocity& v) noexcept {
  const std::uint32_t stage = kTurning && mode.by_state ? mode.stages - 1 : 0;
  const auto table = [&](std::uint32_t group) {
    return mode.go.data() + (std::size_t{group} * mode.stages + stage) * data.samples.size();
  };
  Beyond beyond{table(actor.group), table(actor.group), 0};
  if (actor.group >= mode.headings) return beyond;
  const std::uint32_t h = actor.group;
  const UnitVector u = heading_vector(h * (kMaxHeadings / mode.headings));
  const double across = v.y * u.x - v.x * u.y;
  const std::uint32_t n = mode.headings, near = across >= 0 ? (h + 1) % n : (h + n - 1) % n;
  if ((mode.served_headings >> near & 1u) == 0) return beyond;
  const UnitVector w = heading_vector(near * (kMaxHeadings / n));
  // v = a u + b w: b by the part of v across u, a by that across w.
  const double turn = std::fabs(static_cast<double>(u.x) * w.y - static_cast<double>(u.y) * w.x);
  const double b = std::fabs(across) / turn;
  const double a = std::fabs(v.x * w.y - v.y * w.x) / turn;
  if (!(a + b > 0)) return beyond;
  beyond.second = table(near);
  beyond.share = b / (a + b);
  return beyond;
}

// At the end of the leash and not getting on: what lies within reach of a look ahead does not lead
// out of there, the mode's own tables do.
bool is_lost(const Sprite::Impl& impl, const Actor& actor) noexcept {
  const Velocity o{actor.offset_x * kOffsetUnit, actor.offset_y * kOffsetUnit};
  if (o.length() < kLostShare * leash_of(impl.data)) return false;
  const Velocity v = drive_of(actor);
  const Sample& s = impl.data.samples[actor.sample];
  return v.x * s.step_x + v.y * s.step_y < kLostPace * v.length() * v.length();
}

// What a jump to a sample leads to: how far the drawn character would leave the body.
class Chooser {
 public:
  Chooser(const Sprite::Impl& impl, const Actor& actor) noexcept
      : impl_(impl),
        mode_(impl.data.modes[actor.mode]),
        v_(drive_of(actor)),
        speed_(v_.length()),
        leash_(leash_of(impl.data)),
        offset_{actor.offset_x * kOffsetUnit, actor.offset_y * kOffsetUnit},
        beyond_(make_beyond(impl.data, mode_, actor, v_)) {}

  double price(double t) const noexcept { return mode_.power == 2 ? t * t : t; }

  double ahead(std::uint32_t to) const noexcept {
    const auto& samples = impl_.data.samples;
    Velocity o = offset_;
    double cost = 0;
    std::uint32_t j = to;
    for (int k = 0; k < kAhead; ++k) {
      const Sample& s = samples[j];
      const double r = rate_of(speed_, impl_.pace[j]);
      o.x += s.step_x - v_.x / r;
      o.y += s.step_y - v_.y / r;
      cost += o.length();
      const bool goes_on =
          j + 1 < samples.size() && samples[j + 1].clip == s.clip && samples[j + 1].kept != 0;
      if (goes_on) ++j;
    }
    return kTrailWeight * cost / leash_ + kGoWeight * beyond_.at(j);
  }

 private:
  const Sprite::Impl& impl_;
  const ControlMode& mode_;
  Velocity v_;
  double speed_, leash_;
  Velocity offset_;
  Beyond beyond_;
};

}  // namespace

std::uint32_t clock_rate(const Sprite::Impl& impl, const Actor& actor) noexcept {
  const auto one = static_cast<std::uint32_t>(kRateOne);
  if (actor.action != 0 || actor.direction == Direction::Rest) return one;
  const double rate = rate_of(drive_of(actor).length(), impl.pace[actor.sample]);
  return static_cast<std::uint32_t>(rate * kRateOne + 0.5);
}

// The feet stand where they stand: the character moves as filmed, and is drawn back to the body by
// no more than a tenth of its speed, or by what the leash asks for.
Trail trail(const Sprite::Impl& impl, const Actor& actor) noexcept {
  const Sample& s = impl.data.samples[actor.sample];
  const double rate = clock_rate(impl, actor) / kRateOne;
  const Velocity v = drive_of(actor);
  const Velocity free{actor.offset_x * kOffsetUnit + rate * s.step_x - v.x,
                      actor.offset_y * kOffsetUnit + rate * s.step_y - v.y};
  const double away = free.length();
  const double pull =
      std::min(kSpring * away, kPull * std::max(v.length(), 0.25 * impl.usual_step));
  const double left = std::min(away - pull, leash_of(impl.data));
  const double keep = away > 0 ? left / away : 0;
  return {free.x * keep, free.y * keep, away - left};
}

void Trail::put(Actor& actor) const noexcept {
  const auto fixed = [](double value) {
    return static_cast<std::int16_t>(
        std::floor(std::clamp(value / kOffsetUnit, -32767.0, 32767.0) + 0.5));
  };
  actor.offset_x = fixed(x);
  actor.offset_y = fixed(y);
}

void advance_following(const Sprite::Impl& impl, Actor& actor) noexcept {
  const SpriteData& data = impl.data;
  const ControlMode& mode = data.modes[actor.mode];
  if (stays(impl, actor)) return;
  const std::uint32_t i = actor.sample;
  const std::uint32_t table = actor.group * mode.stages;
  if (actor.group >= mode.headings) {
    actor.stage = 0;
    return show_steered(impl, actor);
  }
  if (is_lost(impl, actor)) {
    actor.stage = static_cast<std::uint8_t>(mode.by_state ? mode.stages - 1 : 0);
    show_steered(impl, actor);
    actor.skipped = 0;
    return;
  }
  const Chooser chooser(impl, actor);
  std::uint32_t best = mode.next[std::size_t{table} * data.samples.size() + i];
  double least = HUGE_VAL;
  const auto offer = [&](std::uint32_t to, double t) {
    const double cost = chooser.price(t) + chooser.ahead(to);
    if (cost < least) least = cost, best = to;
  };
  if (i + 1 < data.samples.size() && data.samples[i + 1].clip == data.samples[i].clip &&
      data.samples[i + 1].kept != 0)
    offer(i + 1, 0);
  for (std::uint32_t e = data.row_start[i]; e < data.row_start[i + 1]; ++e) {
    const Transition& t = data.transitions[e];
    if (t.cost <= mode.cap && t.to != i + 1) offer(t.to, static_cast<double>(t.cost));
  }
  show(actor, table, make_move(data, mode, actor.group, 0, i, best));
  // The game moves it: nothing is left out that would have to be made up for.
  actor.skipped = 0;
}

}  // namespace detail

namespace {

std::int32_t fixed(double value) noexcept {
  constexpr double kMost = 2147483647.0;
  if (!(value == value)) return 0;
  return static_cast<std::int32_t>(std::floor(std::clamp(value, -kMost, kMost - 1) + 0.5));
}

}  // namespace

void own_recorded(Actor& actor) noexcept {
  // What was left out has been moved by already.
  if ((actor.owner & kOwnerKind) == static_cast<std::uint8_t>(PositionOwner::Game))
    actor.skipped = 0;
  actor.owner = static_cast<std::uint8_t>(PositionOwner::Recorded);
  actor.drive_x = actor.drive_y = 0;
  actor.offset_x = actor.offset_y = 0;
  actor.clock = 0;
}

void own_scaled(Actor& actor, Vec2 factor) noexcept {
  own_recorded(actor);
  actor.owner = static_cast<std::uint8_t>(PositionOwner::Scaled);
  const auto scaled = [](float value) {
    return fixed(std::clamp(static_cast<double>(value), -16.0, 16.0) * 65536);
  };
  actor.drive_x = scaled(factor.x);
  actor.drive_y = scaled(factor.y);
}

void follow(const Sprite& sprite, Actor& actor, Vec2 velocity) noexcept {
  const Sprite::Impl& impl = sprite.impl();
  actor.owner = static_cast<std::uint8_t>(PositionOwner::Game);
  const SpriteData& data = impl.data;
  const double per_tick = 65536.0 * data.fps_denominator / data.fps_numerator;
  actor.drive_x = fixed(static_cast<double>(velocity.x) * per_tick);
  actor.drive_y = fixed(static_cast<double>(velocity.y) * per_tick);
  const double speed = detail::drive_of(actor).length();
  if (!(speed >= 0.25 * static_cast<double>(impl.usual_step)))
    return set_direction(sprite, actor, Direction::Rest);
  set_heading(sprite, actor,
              {static_cast<float>(actor.drive_x), static_cast<float>(actor.drive_y)});
}

double foot_slip(const Sprite& sprite, const Actor& actor) noexcept {
  return detail::trail(sprite.impl(), actor).slip / 65536 * sprite.fps();
}

}  // namespace vsprite
