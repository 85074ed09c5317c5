// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// ticks.h - a mode compiled for playing: all that one tick of one actor reads lies together.
//
// The pack holds next[table][sample], displacements by sample, and what a step leads to must be
// found out (is it a jump? was a sample left out? has it turned?). None of that depends on the
// actor, so it is worked out once, when a sprite is loaded. For sample i and group g
//
//     record[i][g] = { dx, dy, move of stage 0, move of stage 1, .. }
//
// dx, dy: displacement a tick, already turned towards g by up to the mode's bend. A move says where
// the tables of g lead from i, and what the actor is then: sample, stage, flags. One tick touches
// one cache line, two in a mode of many stages.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>

#include "vsprite/sprite.h"

namespace vsprite::detail {

/// A move: sample in bits 0..19 (packs hold at most 1,000,000), the stage after it in 20..24.
inline constexpr std::uint32_t kMoveSample = (1u << 20) - 1;
inline constexpr int kMoveStageShift = 20;
inline constexpr std::uint32_t kMoveStage = 31;
inline constexpr int kMoveJumpedShift = 25;   ///< 1: not the film's own continuation
inline constexpr int kMoveSkippedShift = 26;  ///< 1: plays through
/// Bits 27..31: for how many ticks i is shown; kLongShown: that many or more.
inline constexpr int kMoveShownShift = 27;
inline constexpr std::uint32_t kLongShown = 31;

struct TickTable {
  struct alignas(64) Line {
    std::uint32_t words[16];
  };
  std::uint32_t groups = 0;
  std::uint32_t stages = 0;
  std::uint32_t words = 0;  ///< of a record
  std::unique_ptr<Line[]> lines;

  std::size_t stride() const noexcept { return std::size_t{groups} * words; }
  const std::uint32_t* record(std::uint32_t sample, std::uint32_t group) const noexcept {
    const auto* first = reinterpret_cast<const std::uint32_t*>(lines.get());
    return first + sample * stride() + group * words;
  }
};

/// Calls job(i, next) for the samples from `first` to before `last`, where next[table] is what that
/// table leads to from i. Sixteen samples of all tables are copied at a time: whole cache lines,
/// however far apart the tables lie. Pre: at most 256 tables.
template <class Job>
void for_each_sample(const ControlMode& mode, std::uint32_t n, std::uint32_t first,
                     std::uint32_t last, const Job& job) {
  constexpr std::uint32_t kColumns = 16, kMost = 256;
  const auto tables = static_cast<std::uint32_t>(mode.tables());
  std::array<std::uint32_t, kColumns * kMost> block;
  for (; first < last; first += kColumns) {
    const std::uint32_t count = std::min(last - first, kColumns);
    for (std::uint32_t t = 0; t < tables; ++t) {
      const std::uint32_t* from = mode.next.data() + std::size_t{t} * n + first;
      for (std::uint32_t k = 0; k < count; ++k) block[k * kMost + t] = from[k];
    }
    for (std::uint32_t k = 0; k < count; ++k) job(first + k, block.data() + k * kMost);
  }
}

/// `data` has been checked.
TickTable make_tick_table(const SpriteData& data, const ControlMode& mode);

/// The move from `from` to `to` at a stage: what the actor is afterwards.
std::uint32_t make_move(const SpriteData& data, const ControlMode& mode, std::uint32_t group,
                        std::uint32_t stage, std::uint32_t from, std::uint32_t to) noexcept;

}  // namespace vsprite::detail
