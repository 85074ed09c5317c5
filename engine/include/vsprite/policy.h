// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/policy.h - which sample comes next: one look into a table that was solved beforehand.
#pragma once

#include <cstdint>
#include <span>

#include "vsprite/sprite.h"

namespace vsprite {

/// A view of one mode's `next[table][sample]`; owns nothing, valid while the Sprite lives.
struct Policy {
  std::span<const std::uint32_t> next;  ///< (tables, samples)
  std::uint32_t sample_count = 0;
  std::uint32_t stages = 1;  ///< tables per direction
};

/// Pre: mode < sprite.data().modes.size().
inline Policy make_policy(const Sprite& sprite, int mode) noexcept {
  const ControlMode& control = sprite.data().modes[static_cast<std::size_t>(mode)];
  return {control.next, static_cast<std::uint32_t>(sprite.samples().size()), control.stages};
}

/// The table for a direction with `stage` free steps left.
inline std::uint32_t table_index(const Policy& policy, Direction direction,
                                 std::uint32_t stage) noexcept {
  return static_cast<std::uint32_t>(direction) * policy.stages + stage;
}

/// argmin_j of T_ij + w1 |angle(v_j, l)| + a V_j (NIPS section 4), by table. O(1).
/// Pre: `sample` was kept.
inline std::uint32_t next_sample(const Policy& policy, std::uint32_t table,
                                 std::uint32_t sample) noexcept {
  return policy.next[static_cast<std::size_t>(table) * policy.sample_count + sample];
}

}  // namespace vsprite
