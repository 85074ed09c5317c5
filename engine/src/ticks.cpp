// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Compiles a mode's tables into records, and turns displacements towards the command.
#include "ticks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bulk.h"

namespace vsprite::detail {
namespace {

struct Displacement {
  std::int64_t x = 0, y = 0;
};

// The step (x, y) turned towards the unit vector u, but not by more than the mode's bend, at the
// same length. Whole numbers throughout: |u| = 2^30, so products stay below 2^63. Both ways are
// worked out: which one counts cannot be foreseen.
Displacement bend(const Sample& sample, UnitVector u, const ControlMode& mode) noexcept {
  const std::int64_t x = sample.step_x, y = sample.step_y, length = sample.step_length;
  constexpr std::int64_t kHalf = kUnitOne / 2;
  const std::int64_t along = (x * u.x + y * u.y) >> 30, across = (x * u.y - y * u.x) >> 30;
  const std::int64_t off = across < 0 ? -across : across;
  const bool reaches = (along > 0) & (off * mode.bend_cos <= along * mode.bend_sin);
  const std::int64_t c = mode.bend_cos, s = across < 0 ? -mode.bend_sin : mode.bend_sin;
  const std::int64_t turned_x = (x * c - y * s + kHalf) >> 30;
  const std::int64_t turned_y = (x * s + y * c + kHalf) >> 30;
  return {reaches ? (length * u.x + kHalf) >> 30 : turned_x,
          reaches ? (length * u.y + kHalf) >> 30 : turned_y};
}

// Only a hostile pack moves by more than 32,767 pixels a tick.
std::uint32_t word(std::int64_t value) noexcept {
  return static_cast<std::uint32_t>(
      static_cast<std::int32_t>(std::clamp<std::int64_t>(value, INT32_MIN, INT32_MAX)));
}

// What leaving a sample may be besides a jump, and the part of a move that only it decides.
struct Leaving {
  std::uint32_t natural = kNoSample;  // the film's own continuation
  std::uint32_t skip = kNoSample;     // the next but one
  std::uint32_t shown = 0;            // in place
};

Leaving leaving(const SpriteData& data, const ControlMode& mode, std::uint32_t from) noexcept {
  const Sample& s = data.samples[from];
  Leaving out;
  if (from + 1 < data.samples.size() && data.samples[from + 1].clip == s.clip)
    out.natural = from + 1;
  if (mode.plays_through && std::isfinite(s.skip_cost)) out.skip = from + 2;
  out.shown = std::min<std::uint32_t>(s.duration, kLongShown) << kMoveShownShift;
  return out;
}

std::uint32_t move_to(const Leaving& from, const ControlMode& mode, std::uint32_t group,
                      std::uint32_t stage, std::uint32_t to) noexcept {
  std::uint32_t then = stage;
  if (stage > 0 && !mode.by_state) then = stage - 1;
  if (stage > 0 && mode.by_state) {
    const bool arrived = group >= mode.headings || (mode.arrived[to] >> group & 1u) != 0;
    then = arrived ? 0 : stage;
  }
  return to | then << kMoveStageShift | std::uint32_t{to != from.natural} << kMoveJumpedShift |
         std::uint32_t{to == from.skip} << kMoveSkippedShift | from.shown;
}

}  // namespace

std::uint32_t make_move(const SpriteData& data, const ControlMode& mode, std::uint32_t group,
                        std::uint32_t stage, std::uint32_t from, std::uint32_t to) noexcept {
  return move_to(leaving(data, mode, from), mode, group, stage, to);
}

namespace {

void fill_records(const SpriteData& data, const ControlMode& mode, TickTable& table,
                  std::uint32_t first, std::uint32_t last) {
  const auto n = static_cast<std::uint32_t>(data.samples.size());
  std::array<UnitVector, kMaxHeadings> headings{};
  for (std::uint32_t g = 0; g < mode.headings; ++g)
    headings[g] = heading_vector(g * (kMaxHeadings / mode.headings));
  std::uint32_t* at = reinterpret_cast<std::uint32_t*>(table.lines.get()) + first * table.stride();
  for_each_sample(mode, n, first, last, [&](std::uint32_t i, const std::uint32_t* next) {
    const Sample& sample = data.samples[i];
    const Leaving from = leaving(data, mode, i);
    for (std::uint32_t g = 0; g < table.groups; ++g) {
      const bool bends = mode.bend_sin != 0 && g < mode.headings;
      const Displacement by =
          bends ? bend(sample, headings[g], mode) : Displacement{sample.step_x, sample.step_y};
      *at++ = word(by.x);
      *at++ = word(by.y);
      for (std::uint32_t k = 0; k < mode.stages; ++k, ++next) {
        // A sample that was not kept is never shown; it would stay.
        *at++ = *next == kNoSample ? i : move_to(from, mode, g, k, *next);
      }
    }
  });
}

}  // namespace

TickTable make_tick_table(const SpriteData& data, const ControlMode& mode) {
  const auto n = static_cast<std::uint32_t>(data.samples.size());
  TickTable table{mode.headings + 2, mode.stages, mode.stages + 2, {}};
  const std::size_t lines = (n * table.stride() + 15) / 16;
  table.lines = std::make_unique_for_overwrite<TickTable::Line[]>(lines);
  prefer_large_pages(table.lines.get(), lines * sizeof(TickTable::Line));
  run_halves(lines * sizeof(TickTable::Line), n, [&](std::uint32_t first, std::uint32_t last) {
    fill_records(data, mode, table, first, last);
  });
  return table;
}

}  // namespace vsprite::detail
