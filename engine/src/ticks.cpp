// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Compiles a mode's tables into records, and turns displacements towards the command.
#include "ticks.h"

#include <algorithm>
#include <cmath>

#include "bulk.h"

namespace vsprite::detail {
namespace {

struct Displacement {
  std::int64_t x = 0, y = 0;
};

// The step (x, y) turned towards the unit vector u, but not by more than the mode's bend, at the
// same length. Whole numbers throughout: |u| = 2^30, so products stay below 2^63.
Displacement bend(const Sample& sample, UnitVector u, const ControlMode& mode) noexcept {
  const std::int64_t x = sample.step_x, y = sample.step_y;
  constexpr std::int64_t kHalf = kUnitOne / 2;
  const std::int64_t along = (x * u.x + y * u.y) >> 30, across = (x * u.y - y * u.x) >> 30;
  const std::int64_t off = across < 0 ? -across : across;
  if (along > 0 && off * mode.bend_cos <= along * mode.bend_sin) {
    const std::int64_t length = sample.step_length;
    return {(length * u.x + kHalf) >> 30, (length * u.y + kHalf) >> 30};
  }
  const std::int64_t c = mode.bend_cos, s = across < 0 ? -mode.bend_sin : mode.bend_sin;
  return {(x * c - y * s + kHalf) >> 30, (x * s + y * c + kHalf) >> 30};
}

// Only a hostile pack moves by more than 32,767 pixels a tick.
std::uint32_t word(std::int64_t value) noexcept {
  return static_cast<std::uint32_t>(
      static_cast<std::int32_t>(std::clamp<std::int64_t>(value, INT32_MIN, INT32_MAX)));
}

bool skips(const SpriteData& data, std::uint32_t from, std::uint32_t to) noexcept {
  return to == from + 2 && std::isfinite(data.samples[from].skip_cost);
}

}  // namespace

std::uint32_t make_move(const SpriteData& data, const ControlMode& mode, std::uint32_t group,
                        std::uint32_t stage, std::uint32_t from, std::uint32_t to) noexcept {
  const bool natural = to == from + 1 && data.samples[to].clip == data.samples[from].clip;
  const bool skipped = !natural && mode.plays_through && skips(data, from, to);
  std::uint32_t then = stage;
  if (stage > 0 && !mode.by_state) then = stage - 1;
  if (stage > 0 && mode.by_state) {
    const bool arrived = group >= mode.headings || (mode.arrived[to] >> group & 1u) != 0;
    if (arrived) then = 0;
  }
  return to | then << kMoveStageShift | std::uint32_t{!natural} << kMoveJumpedShift |
         std::uint32_t{skipped} << kMoveSkippedShift |
         std::min<std::uint32_t>(data.samples[from].duration, kLongShown) << kMoveShownShift;
}

namespace {

void fill_records(const SpriteData& data, const ControlMode& mode, TickTable& table,
                  std::uint32_t first, std::uint32_t last) {
  const std::size_t n = data.samples.size();
  std::uint32_t* at = table.lines[0].words + first * table.stride();
  for (std::uint32_t i = first; i < last; ++i) {
    const Sample& sample = data.samples[i];
    for (std::uint32_t g = 0; g < table.groups; ++g) {
      const bool bends = mode.bend_sin != 0 && g < mode.headings;
      const Displacement by =
          bends ? bend(sample, heading_vector(g * (kMaxHeadings / mode.headings)), mode)
                : Displacement{sample.step_x, sample.step_y};
      *at++ = word(by.x);
      *at++ = word(by.y);
      for (std::uint32_t k = 0; k < mode.stages; ++k) {
        // A sample that was not kept is never shown; it would stay.
        const std::uint32_t next = mode.next[std::size_t{g * mode.stages + k} * n + i];
        *at++ = next == kNoSample ? i : make_move(data, mode, g, k, i, next);
      }
    }
  }
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
