// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/policy.h - which sample comes next: one look into a table that was solved beforehand.
#pragma once

#include <cstdint>
#include <span>

#include "vsprite/sprite.h"

namespace vsprite {

/// The group of tables for a command that is followed as it stands: a heading's number, else none
/// or rest behind the headings.
inline std::uint32_t group_of(const ControlMode& mode, Direction direction) noexcept {
  const auto d = static_cast<std::uint32_t>(direction);
  return d < kCompassCount ? d * (mode.headings / kCompassCount)
                           : mode.headings + d - kCompassCount;
}

/// The command that a group of tables serves: of several headings near a compass direction, that
/// direction.
inline Direction direction_of(const ControlMode& mode, std::uint32_t group) noexcept {
  if (group >= mode.headings) {
    return static_cast<Direction>(kCompassCount + group - mode.headings);
  }
  const std::uint32_t fine = mode.headings / kCompassCount;
  return static_cast<Direction>((group + fine / 2) / fine % kCompassCount);
}

/// A view of one mode's `next[table][sample]`; owns nothing, valid while the Sprite lives.
struct Policy {
  std::span<const std::uint32_t> next;  ///< (tables, samples)
  std::uint32_t sample_count = 0;
  std::uint32_t stages = 1;  ///< tables per group
};

/// Pre: mode < sprite.data().modes.size().
inline Policy make_policy(const Sprite& sprite, int mode) noexcept {
  const ControlMode& control = sprite.data().modes[static_cast<std::size_t>(mode)];
  return {control.next, static_cast<std::uint32_t>(sprite.samples().size()), control.stages};
}

/// The table of a group at a stage.
inline std::uint32_t table_index(const Policy& policy, std::uint32_t group,
                                 std::uint32_t stage) noexcept {
  return group * policy.stages + stage;
}

/// argmin_j of p(T_ij) + G_j (NIPS section 4), by table. O(1).
/// Pre: `sample` was kept.
inline std::uint32_t next_sample(const Policy& policy, std::uint32_t table,
                                 std::uint32_t sample) noexcept {
  return policy.next[static_cast<std::size_t>(table) * policy.sample_count + sample];
}

}  // namespace vsprite
