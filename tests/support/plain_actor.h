// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// plain_actor.h - one tick of an actor as actor.h and sprite.h say it, from the pack's own tables:
// what the compiled records of the engine must agree with.
#pragma once

#include "vsprite/actor.h"
#include "vsprite/policy.h"

namespace vsprite::testing {

/// The displacement of one sample a tick, turned towards a group.
inline Position plain_step(const ControlMode& mode, const Sample& s, std::uint32_t group) {
  const std::int64_t x = s.step_x, y = s.step_y, half = kUnitOne / 2;
  if (mode.bend_sin == 0 || group >= mode.headings) return {x, y};
  const UnitVector u = heading_vector(group * (kMaxHeadings / mode.headings));
  const std::int64_t along = (x * u.x + y * u.y) >> 30, across = (x * u.y - y * u.x) >> 30;
  if (along > 0 && (across < 0 ? -across : across) * mode.bend_cos <= along * mode.bend_sin) {
    const std::int64_t length = s.step_length;
    return {(length * u.x + half) >> 30, (length * u.y + half) >> 30};
  }
  const std::int64_t c = mode.bend_cos, r = across < 0 ? -mode.bend_sin : mode.bend_sin;
  return {(x * c - y * r + half) >> 30, (x * r + y * c + half) >> 30};
}

inline void plain_tick(const Sprite& sprite, Actor& actor) {
  const ControlMode& mode = sprite.data().modes[actor.mode];
  const auto samples = sprite.samples();
  const Position by = plain_step(mode, samples[actor.sample], actor.bent);
  actor.position.x += by.x;
  actor.position.y += by.y;
  if (actor.skipped != 0) {
    const Sample& left_out = samples[actor.sample - 1];
    const Position more = plain_step(mode, left_out, actor.bent);
    actor.position.x += more.x * left_out.duration;
    actor.position.y += more.y * left_out.duration;
  }
  ++actor.tick;
  actor.bent = actor.group;
  if (actor.shown < samples[actor.sample].duration) {
    ++actor.shown;
    actor.jumped = actor.skipped = 0;
    return;
  }
  const Policy policy = make_policy(sprite, actor.mode);
  const std::uint32_t table = table_index(policy, actor.group, actor.stage);
  const std::uint32_t next = next_sample(policy, table, actor.sample);
  const bool natural = sprite.is_natural(actor.sample, next);
  actor.skipped = !natural && mode.plays_through && sprite.is_skip(actor.sample, next);
  actor.jumped = !natural;
  actor.sample = next;
  actor.shown = 1;
  actor.table = static_cast<std::uint8_t>(table);
  if (actor.stage == 0) return;
  if (!mode.by_state) {
    --actor.stage;
  } else if (actor.group >= mode.headings || (mode.arrived[next] >> actor.group & 1u) != 0) {
    actor.stage = 0;
  }
}

}  // namespace vsprite::testing
