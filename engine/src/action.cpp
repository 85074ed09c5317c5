// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Playing actions: to a tag along its tables, through it, and on.
#include "vsprite/action.h"

#include <algorithm>

#include "actor_parts.h"
#include "sections.h"

namespace vsprite {
namespace detail {
namespace {

constexpr std::uint16_t kMostDue = 0xFFFF;

int phase_of(const Actor& actor) noexcept { return actor.play & kPlayPhase; }

const Action& action_of(const Sprite::Impl& impl, const Actor& actor) noexcept {
  return impl.action_list[actor.action - 1u];
}

const ActionTable& table_of(const Sprite::Impl& impl, const Actor& actor) noexcept {
  const Action& action = action_of(impl, actor);
  return impl.data
      .actions[static_cast<std::size_t>(action.tables[static_cast<std::size_t>(phase_of(actor))])];
}

// The phase from `first` on that the action has, or kPhases.
int phase_from(const Action& action, int first) noexcept {
  while (first < Action::kPhases && action.tables[static_cast<std::size_t>(first)] < 0) ++first;
  return first;
}

bool is_held(const Sprite::Impl& impl, const Actor& actor) noexcept {
  if ((actor.play & kPlayReleased) != 0) return false;
  return phase_of(actor) == Action::kAir ||
         ((actor.play & kPlayHold) != 0 && !action_of(impl, actor).has_phases);
}

std::uint16_t due_of(int within) noexcept {
  return within < 0 ? 0 : static_cast<std::uint16_t>(std::clamp<int>(within, 1, kMostDue));
}

// The phase begins where its first sample shows: now, if it does already.
void enter(const Sprite::Impl& impl, Actor& actor, int phase, int within) noexcept {
  actor.play = static_cast<std::uint8_t>((actor.play & ~(kPlayPhase | kPlayApproach)) | phase);
  actor.due = 0;
  if (table_of(impl, actor).next[actor.sample] == actor.sample) return;
  actor.play |= kPlayApproach;
  actor.due = due_of(within);
}

void begin(const Sprite::Impl& impl, Actor& actor, std::uint16_t action, int within,
           bool hold) noexcept {
  actor.action = action;
  actor.play = static_cast<std::uint8_t>((actor.play & kPlayQueuedHold) | (hold ? kPlayHold : 0));
  enter(impl, actor, phase_from(action_of(impl, actor), 0), within);
}

// Steered again; a command has to turn the actor as if it had just come.
void finish(const Sprite::Impl& impl, Actor& actor) noexcept {
  actor.action = actor.queued = actor.due = 0;
  actor.play = 0;
  actor.stage = static_cast<std::uint8_t>(impl.data.modes[actor.mode].stages - 1);
}

void show_sample(const Sprite::Impl& impl, Actor& actor, std::uint32_t to) noexcept {
  const auto& samples = impl.data.samples;
  const bool natural = to == actor.sample + 1 && samples[to].clip == samples[actor.sample].clip;
  actor.jumped = natural ? 0 : 1;
  actor.skipped = 0;
  actor.sample = to;
  actor.shown = 1;
}

// One tick on the way to the first sample of a phase. Under a deadline the sample that is shown may
// have to end early.
void approach(const Sprite::Impl& impl, Actor& actor) noexcept {
  const ActionTable& table = table_of(impl, actor);
  const std::size_t n = impl.data.samples.size(), i = actor.sample;
  const std::uint32_t left = actor.due;  // counts this tick
  const bool last_chance = left == 1;
  if (actor.due > 0) --actor.due;
  if (!last_chance && stays(impl, actor)) return;
  // The tables count from the tick that showed the sample first.
  const std::uint32_t m = left + actor.shown - 1;
  const bool by_time = left > 0 && m <= impl.data.action_horizon;
  std::uint32_t to = by_time ? table.in_time[(m - 1) * n + i] : table.next[i];
  const bool over = actor.shown >= impl.data.samples[i].duration;
  if (last_chance && (!over || table.next[to] != to)) to = table.cut[i];
  show_sample(impl, actor, to);
  if (table.next[to] != to) return;
  actor.play &= static_cast<std::uint8_t>(~kPlayApproach);
  actor.due = 0;
}

void show_next(const Sprite::Impl& impl, Actor& actor) noexcept;

// The phase is over with the sample that is shown: what comes next shows in this tick.
void go_on(const Sprite::Impl& impl, Actor& actor) noexcept {
  const Action& action = action_of(impl, actor);
  const int phase = phase_from(action, phase_of(actor) + 1);
  if (phase < Action::kPhases) {
    enter(impl, actor, phase, kNoDeadline);
  } else if (actor.queued != 0) {
    const std::uint16_t queued = actor.queued;
    const bool hold = (actor.play & kPlayQueuedHold) != 0;
    actor.queued = 0;
    actor.play = 0;
    begin(impl, actor, queued, kNoDeadline, hold);
  } else {
    finish(impl, actor);
    return show_steered(impl, actor);
  }
  show_next(impl, actor);
}

// Shows the sample after one whose time is over, inside a phase.
void show_next(const Sprite::Impl& impl, Actor& actor) noexcept {
  if ((actor.play & kPlayApproach) != 0) return approach(impl, actor);
  const auto& samples = impl.data.samples;
  const std::uint32_t i = actor.sample;
  const ActionTable& table = table_of(impl, actor);
  if (is_held(impl, actor)) {
    if (table.stay[i] != i) return show_sample(impl, actor, table.stay[i]);
    actor.jumped = actor.skipped = 0;  // held
    return;
  }
  const bool let_go = (actor.play & kPlayReleased) != 0 && phase_of(actor) != Action::kEnd;
  const bool runs_on = i + 1 < samples.size() && samples[i + 1].clip == samples[i].clip &&
                       samples[i + 1].tag == table.tag && samples[i + 1].kept != 0;
  const bool was_held = phase_of(actor) == Action::kAir || (actor.play & kPlayHold) != 0;
  if (runs_on && !(let_go && was_held)) return show_sample(impl, actor, i + 1);
  go_on(impl, actor);
}

}  // namespace

void advance_action(const Sprite::Impl& impl, Actor& actor) noexcept {
  if ((actor.play & kPlayApproach) != 0) return approach(impl, actor);
  if (stays(impl, actor)) return;
  show_next(impl, actor);
}

}  // namespace detail

int find_action(const Sprite& sprite, std::string_view name) noexcept {
  const auto actions = sprite.actions();
  for (std::size_t k = 0; k < actions.size(); ++k)
    if (actions[k].name == name) return static_cast<int>(k);
  return -1;
}

void play(const Sprite& sprite, Actor& actor, int action, int within, bool hold) noexcept {
  actor.queued = 0;
  actor.play = 0;
  detail::begin(sprite.impl(), actor, static_cast<std::uint16_t>(action + 1), within, hold);
}

bool play(const Sprite& sprite, Actor& actor, std::string_view name, int within,
          bool hold) noexcept {
  const int action = find_action(sprite, name);
  if (action >= 0) play(sprite, actor, action, within, hold);
  return action >= 0;
}

void queue(const Sprite& sprite, Actor& actor, int action, bool hold) noexcept {
  if (actor.action == 0) return play(sprite, actor, action, kNoDeadline, hold);
  actor.queued = static_cast<std::uint16_t>(action + 1);
  actor.play =
      static_cast<std::uint8_t>((actor.play & ~kPlayQueuedHold) | (hold ? kPlayQueuedHold : 0));
}

void release(const Sprite& sprite, Actor& actor, int within) noexcept {
  if (actor.action == 0) return;
  actor.play |= kPlayReleased;
  const Action& action = detail::action_of(sprite.impl(), actor);
  const bool in_air = detail::phase_of(actor) == Action::kAir;
  if (!in_air || action.tables[Action::kEnd] < 0 || within < 0) return;
  detail::enter(sprite.impl(), actor, Action::kEnd, within);
}

void cancel(const Sprite& sprite, Actor& actor) noexcept {
  if (actor.action != 0) detail::finish(sprite.impl(), actor);
}

}  // namespace vsprite
