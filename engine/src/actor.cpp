// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// One tick of a character: move by the shown sample, then perhaps look up the next one.
#include "vsprite/actor.h"

#define XXH_STATIC_LINKING_ONLY  // the size of the streaming state
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

#include "actor_parts.h"
#include "vsprite/owner.h"
#include "vsprite/policy.h"

namespace vsprite {
namespace {

using detail::Displacement;
using detail::move_by;
using detail::moved;
using detail::show;
using detail::stays;
using detail::TickTable;

const ControlMode& mode_of(const Sprite& sprite, const Actor& actor) noexcept {
  return sprite.impl().data.modes[actor.mode];
}

std::uint32_t followed(const ControlMode& mode, Direction command) noexcept {
  return group_of(mode, mode.table_of[static_cast<std::size_t>(command)]);
}

PositionOwner owner_of(const Actor& actor) noexcept {
  return static_cast<PositionOwner>(actor.owner & kOwnerKind);
}

// What the owner of the position moves it by.
Displacement owned_step(const Sprite::Impl& impl, const Actor& actor) noexcept {
  if (owner_of(actor) == PositionOwner::Game) return {actor.drive_x, actor.drive_y};
  const Displacement filmed = detail::recorded_step(impl, actor);
  if (owner_of(actor) != PositionOwner::Scaled) return filmed;
  static constexpr std::int64_t kMost = std::int64_t{1} << 40;  // only a hostile pack moves so far
  const auto scaled = [](std::int64_t by, std::int64_t factor) {
    return std::clamp(by, -kMost, kMost) * factor >> 16;
  };
  return {scaled(filmed.x, actor.drive_x), scaled(filmed.y, actor.drive_y)};
}

// One film tick of an actor that plays an action, or is moved by another than the film.
void advance(const Sprite::Impl& impl, Actor& actor) noexcept {
  if (actor.action != 0) {
    // Where an action moves is its own.
    actor.bent = static_cast<std::uint8_t>(impl.data.modes[actor.mode].headings);
    return detail::advance_action(impl, actor);
  }
  actor.bent = actor.group;
  if (owner_of(actor) == PositionOwner::Game) return detail::advance_following(impl, actor);
  if (!stays(impl, actor)) detail::show_steered(impl, actor);
}

// As many film ticks as pass in one of a body that the game moves: 0, 1 or 2.
void advance_by_clock(const Sprite::Impl& impl, Actor& actor) noexcept {
  const std::uint32_t passed = actor.clock + detail::clock_rate(impl, actor);
  actor.clock = static_cast<std::uint16_t>(passed & 0xFFFFu);
  actor.jumped = actor.skipped = 0;
  std::uint8_t jumped = 0;
  const std::uint32_t before = actor.sample;
  for (std::uint32_t k = passed >> 16; k > 0; --k) {
    advance(impl, actor);
    jumped |= actor.jumped;
  }
  actor.jumped = jumped;
  // Two samples of the film in one tick: the first one's events count too.
  if (jumped == 0 && actor.sample == before + 2) actor.skipped = 1;
}

void directed_tick(const Sprite::Impl& impl, Actor& actor) noexcept {
  if (owner_of(actor) == PositionOwner::Game) detail::trail(impl, actor).put(actor);
  const std::uint32_t sample = actor.sample;
  const std::uint16_t shown = actor.shown;
  actor.owner &= kOwnerKind;
  move_by(actor, owned_step(impl, actor));
  if (owner_of(actor) == PositionOwner::Game) {
    advance_by_clock(impl, actor);
  } else {
    advance(impl, actor);
  }
  const bool again = actor.sample == sample && (actor.shown != 1 || shown == 1);
  if (again) actor.owner |= kOwnerStill;
}

// One tick by the tables. Without a branch that depends on the film: a sample that was left out
// counts zero times where none was, and what stays takes its old values.
inline void tick(const Sprite::Impl& impl, Actor& actor) noexcept {
  using namespace detail;
  if ((actor.action | actor.owner) != 0) [[unlikely]]
    return directed_tick(impl, actor);
  const TickTable& table = impl.ticks[actor.mode];
  const std::uint32_t* record = table.record(actor.sample, actor.bent);
  const std::uint32_t* before = record - actor.skipped * table.stride();
  const std::uint32_t lasted = actor.skipped * (before[2] >> kMoveShownShift);
  const std::uint32_t index = actor.group * table.stages + actor.stage;
  const std::uint32_t move = table.record(actor.sample, actor.group)[2 + actor.stage];
  const std::uint32_t shown_for = move >> kMoveShownShift;
  if (lasted == kLongShown || shown_for == kLongShown) [[unlikely]] {
    move_by(actor, recorded_step(impl, actor));
    actor.bent = actor.group;
    if (!stays(impl, actor)) show(actor, index, move);
    return;
  }
  const auto x = [](const std::uint32_t* r) {
    return std::int64_t{static_cast<std::int32_t>(r[0])};
  };
  const auto y = [](const std::uint32_t* r) {
    return std::int64_t{static_cast<std::int32_t>(r[1])};
  };
  move_by(actor, {x(record) + x(before) * lasted, y(record) + y(before) * lasted});
  const bool stay = actor.shown < shown_for;
  const auto byte = [&](std::uint32_t held, std::uint32_t changed) {
    return static_cast<std::uint8_t>(stay ? held : changed);
  };
  actor.bent = actor.group;
  actor.table = byte(actor.table, index);
  actor.stage = byte(actor.stage, move >> kMoveStageShift & kMoveStage);
  actor.jumped = byte(0, move >> kMoveJumpedShift & 1u);
  actor.skipped = byte(0, move >> kMoveSkippedShift & 1u);
  actor.shown = static_cast<std::uint16_t>(stay ? actor.shown + 1 : 1);
  actor.sample = stay ? actor.sample : move & kMoveSample;
}

// The transitions out of a sample that cost at most `slack` more than the best, at most sixteen.
struct NearTies {
  std::array<std::uint32_t, 16> to;
  std::size_t count = 0;
};
NearTies near_ties(const Sprite& sprite, const ControlMode& mode, std::uint32_t table,
                   std::uint32_t from, float slack) noexcept {
  const std::size_t n = sprite.samples().size();
  const float* go = mode.go.data() + table * n;
  const std::uint32_t best = mode.next[table * n + from];
  const auto price = [&](float cost) { return mode.power == 2 ? cost * cost : cost; };
  const auto price_to = [&](std::uint32_t to, float cost) {
    if (sprite.is_natural(from, to)) return 0.0f;
    const bool skips = mode.plays_through && sprite.is_skip(from, to);
    return price(skips ? mode.skip_price * sprite.samples()[from].skip_cost : cost);
  };
  const float limit = price_to(best, sprite.transition_cost(from, best)) + go[best] + slack;
  NearTies ties{{best}, 1};
  for (const Transition& t : sprite.transitions(from)) {
    if (t.to == best || ties.count == ties.to.size() || t.cost > mode.cap) continue;
    if (price_to(t.to, t.cost) + go[t.to] <= limit) ties.to[ties.count++] = t.to;
  }
  return ties;
}

// Where the actor would be ten samples after it was led to `to`, and how many ticks later.
struct Outlook {
  Position position;
  std::int64_t ticks = 0;
};
Outlook ahead_of(const Sprite& sprite, const Actor& actor, std::uint32_t table,
                 std::uint32_t to) noexcept {
  constexpr int kAhead = 10;
  const Policy policy = make_policy(sprite, actor.mode);
  Outlook outlook{actor.position};
  for (int k = 0; k < kAhead; ++k) {
    const Sample& s = sprite.samples()[to];
    outlook.position.x = moved(outlook.position.x, std::int64_t{s.step_x} * s.duration);
    outlook.position.y = moved(outlook.position.y, std::int64_t{s.step_y} * s.duration);
    outlook.ticks += s.duration;
    to = next_sample(policy, table, to);
  }
  return outlook;
}

// What makes one near tie better than another: room, or speed (px a tick).
float score(const Actor& actor, const StepWish& wish, const Outlook& outlook) noexcept {
  if (wish.clearance != nullptr) return wish.clearance(wish.world, to_pixels(outlook.position));
  const Vec2 way = to_pixels(
      {moved(outlook.position.x, -actor.position.x), moved(outlook.position.y, -actor.position.y)});
  const float speed = std::sqrt(way.x * way.x + way.y * way.y) / static_cast<float>(outlook.ticks);
  return wish.pace == Pace::Fast ? speed : -speed;
}

// PCG (O'Neill 2014), 32 bits of state.
std::uint32_t draw(std::uint32_t& state) noexcept {
  const std::uint32_t old = state;
  state = old * 747796405u + 2891336453u;
  const std::uint32_t word = ((old >> ((old >> 28) + 4)) ^ old) * 277803737u;
  return word >> 22 ^ word;
}

std::uint32_t choose(const Sprite& sprite, Actor& actor, std::uint32_t table,
                     const StepWish& wish) noexcept {
  const NearTies ties = near_ties(sprite, mode_of(sprite, actor), table, actor.sample, wish.slack);
  if (ties.count == 1) return ties.to[0];
  if (wish.clearance == nullptr && wish.pace == Pace::Any)
    return ties.to[draw(actor.random) % ties.count];
  std::uint32_t best = ties.to[0];
  float most = score(actor, wish, ahead_of(sprite, actor, table, best));
  for (std::size_t k = 1; k < ties.count; ++k) {
    const float there = score(actor, wish, ahead_of(sprite, actor, table, ties.to[k]));
    if (there > most) best = ties.to[k], most = there;
  }
  return best;
}

void command(const Sprite& sprite, Actor& actor, Direction direction,
             std::uint32_t group) noexcept {
  actor.direction = direction;
  if (group == actor.group) return;
  actor.group = static_cast<std::uint8_t>(group);
  actor.stage = static_cast<std::uint8_t>(mode_of(sprite, actor).stages - 1);
}

// The cosine of the angle between a heading and (x, y) of length 1.
double cosine_to(const ControlMode& mode, std::uint32_t heading, double x, double y) noexcept {
  const UnitVector u = heading_vector(heading * (kMaxHeadings / mode.headings));
  return (u.x * x + u.y * y) / kUnitOne;
}

}  // namespace

namespace detail {

Displacement recorded_step(const Sprite::Impl& impl, const Actor& actor) noexcept {
  const TickTable& table = impl.ticks[actor.mode];
  const auto step_of = [&](std::uint32_t sample) -> Displacement {
    const std::uint32_t* record = table.record(sample, actor.bent);
    return {static_cast<std::int32_t>(record[0]), static_cast<std::int32_t>(record[1])};
  };
  Displacement d = step_of(actor.sample);
  if (actor.skipped == 0) return d;
  const Displacement more = step_of(actor.sample - 1);
  const std::int64_t duration = impl.data.samples[actor.sample - 1].duration;
  return {d.x + more.x * duration, d.y + more.y * duration};
}

}  // namespace detail

Actor make_actor(const Sprite& sprite, Vec2 position, std::uint64_t seed, int mode) noexcept {
  Actor actor;
  actor.position = to_position(position);
  actor.random = static_cast<std::uint32_t>(seed ^ seed >> 32);
  actor.sample = sprite.data().start_sample;
  actor.shown = 1;
  actor.mode = static_cast<std::uint8_t>(mode);
  const Policy policy = make_policy(sprite, mode);
  const std::uint32_t none = followed(mode_of(sprite, actor), Direction::None);
  actor.group = actor.bent = static_cast<std::uint8_t>(none);
  actor.table = static_cast<std::uint8_t>(table_index(policy, none, 0));
  return actor;
}

void set_direction(const Sprite& sprite, Actor& actor, Direction direction) noexcept {
  if (direction == actor.direction) return;
  command(sprite, actor, direction, followed(mode_of(sprite, actor), direction));
}

void set_heading(const Sprite& sprite, Actor& actor, Vec2 toward) noexcept {
  const ControlMode& mode = mode_of(sprite, actor);
  const double tx = static_cast<double>(toward.x), ty = static_cast<double>(toward.y);
  const double length = std::sqrt(tx * tx + ty * ty);
  if (!(length > 0) || !std::isfinite(length)) {
    return set_direction(sprite, actor, Direction::None);
  }
  std::uint32_t best = mode.headings;
  double best_cosine = 0.5;  // 60 degrees
  for (std::uint32_t h = 0; h < mode.headings; ++h) {
    if ((mode.served_headings >> h & 1u) == 0) continue;
    const double cosine = cosine_to(mode, h, tx / length, ty / length);
    if (cosine >= best_cosine) best = h, best_cosine = cosine;
  }
  if (best == mode.headings) return set_direction(sprite, actor, Direction::Rest);
  if (actor.group < mode.headings && (mode.served_headings >> actor.group & 1u) != 0) {
    // Kept unless the best is nearer by a third of the distance between two headings, so that a
    // trembling hand at the border of two does not make it dither.
    const double c = mode.headings == 8    ? 0.96592582628906829   // cos 15 degrees
                     : mode.headings == 16 ? 0.99144486137381041   // cos 7.5 degrees
                                           : 0.99785892323860351;  // cos 3.75 degrees
    const double s = std::sqrt(1 - c * c);
    const double best_sine = std::sqrt(std::max(0.0, 1 - best_cosine * best_cosine));
    const double limit = best_cosine * c - best_sine * s;  // cos(angle to the best + margin)
    if (cosine_to(mode, actor.group, tx / length, ty / length) >= limit) best = actor.group;
  }
  command(sprite, actor, direction_of(mode, best), best);
}

void set_target(const Sprite& sprite, Actor& actor, Vec2 target, float arrive_radius) noexcept {
  // An actor that has arrived starts again only beyond 1.5 radii, so that it does not dither.
  constexpr double kLeaveRadius = 1.5;
  const double dx =
      static_cast<double>(target.x) - static_cast<double>(actor.position.x) / kFixedOne;
  const double dy =
      static_cast<double>(target.y) - static_cast<double>(actor.position.y) / kFixedOne;
  const double distance = std::sqrt(dx * dx + dy * dy);
  const bool resting = actor.direction == Direction::Rest;
  const double radius = static_cast<double>(arrive_radius) * (resting ? kLeaveRadius : 1.0);
  if (!(distance > radius)) return set_direction(sprite, actor, Direction::Rest);
  set_heading(sprite, actor,
              {static_cast<float>(dx / distance), static_cast<float>(dy / distance)});
}

void step(const Sprite& sprite, Actor& actor) noexcept { tick(sprite.impl(), actor); }

void step(const Sprite& sprite, std::span<Actor> actors) noexcept {
  const Sprite::Impl& impl = sprite.impl();
#ifdef __GNUC__
  // Records of a large sprite lie beyond the nearest cache; fetching them early hides that.
  constexpr std::size_t kAhead = 12;
  const std::size_t fetched = actors.size() - std::min(actors.size(), kAhead);
  for (std::size_t i = 0; i < fetched; ++i) {
    const Actor& later = actors[i + kAhead];
    __builtin_prefetch(impl.ticks[later.mode].record(later.sample, later.group));
    tick(impl, actors[i]);
  }
  actors = actors.subspan(fetched);
#endif
  for (Actor& actor : actors) tick(impl, actor);
}

void step(const Sprite& sprite, Actor& actor, const StepWish& wish) noexcept {
  const Sprite::Impl& impl = sprite.impl();
  if ((actor.action | actor.owner) != 0) return directed_tick(impl, actor);
  const ControlMode& mode = mode_of(sprite, actor);
  move_by(actor, detail::recorded_step(impl, actor));
  actor.bent = actor.group;
  if (stays(impl, actor)) return;
  const std::uint32_t table = actor.group * mode.stages + actor.stage;
  const std::uint32_t next = choose(sprite, actor, table, wish);
  show(actor, table,
       detail::make_move(impl.data, mode, actor.group, actor.stage, actor.sample, next));
}

Vec2 draw_position(const Sprite& sprite, const Actor& actor, float fraction) noexcept {
  const Displacement by = owned_step(sprite.impl(), actor);
  const double f = static_cast<double>(fraction);
  double x = static_cast<double>(actor.position.x) + f * static_cast<double>(by.x);
  double y = static_cast<double>(actor.position.y) + f * static_cast<double>(by.y);
  if ((actor.offset_x | actor.offset_y) != 0 || owner_of(actor) == PositionOwner::Game) {
    Actor after = actor;
    if (owner_of(actor) == PositionOwner::Game) detail::trail(sprite.impl(), actor).put(after);
    x += detail::kOffsetUnit * ((1 - f) * actor.offset_x + f * after.offset_x);
    y += detail::kOffsetUnit * ((1 - f) * actor.offset_y + f * after.offset_y);
  }
  return {static_cast<float>(x / kFixedOne), static_cast<float>(y / kFixedOne)};
}

float shown_cost(const Sprite& sprite, std::uint32_t before, const Actor& after) noexcept {
  if (after.jumped == 0) return 0;
  const float cost = sprite.transition_cost(before, after.sample);
  if (std::isfinite(cost)) return cost;
  for (const ActionTable& table : sprite.data().actions)
    if (table.cut[before] == after.sample) return table.cut_cost[before];
  return cost;
}

static_assert(sizeof(XXH3_state_t) <= StateHash::kStateBytes);
static_assert(alignof(XXH3_state_t) <= alignof(StateHash));

StateHash::StateHash() noexcept { XXH3_64bits_reset(new (state_) XXH3_state_t); }

void StateHash::add(const Actor& actor) noexcept {
  std::array<std::uint8_t, 30> row;
  std::size_t at = 0;
  const auto put = [&](std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) row[at++] = static_cast<std::uint8_t>(value >> (8 * i));
  };
  put(actor.tick, 8);
  put(actor.sample, 4);
  put(static_cast<std::uint64_t>(actor.position.x), 8);
  put(static_cast<std::uint64_t>(actor.position.y), 8);
  put(static_cast<std::uint64_t>(actor.direction), 1);
  put(actor.table, 1);
  XXH3_64bits_update(std::launder(reinterpret_cast<XXH3_state_t*>(state_)), row.data(), row.size());
}

std::uint64_t StateHash::digest() const noexcept {
  return XXH3_64bits_digest(std::launder(reinterpret_cast<const XXH3_state_t*>(state_)));
}

}  // namespace vsprite
