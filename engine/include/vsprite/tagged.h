// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/tagged.h - what a sprite knows about its tags: how to get to each, and how to stay in it.
//
// A tag names a kind of motion ("walk", "jump"); phases of one action share its name before a dot:
// jump.start, jump.air, jump.end. For every tag the way to its first samples was solved beforehand,
//
//     V_i = 0 at the first samples of the tag,   V_i = tau d_i + min_j (T_ij + V_j) elsewhere,
//
// undiscounted (with a discount, circling for ever can be cheaper than one dear jump); tau > 0 is
// the price of a tick, d_i for how many a sample is shown. Under a deadline of m ticks
//
//     W_m(i) = min_j (p(T_ij) + W_(m - d_i)(j)),   p(T) = T, or T^2 beyond the threshold,
//
// where from every sample one more jump leads to a first sample, accepted or not: a cut.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

namespace vsprite {

/// The tables of one tag. Samples that were not kept: kNoSample, and 0.
struct ActionTable {
  std::uint16_t tag = 0;               ///< index into SpriteData::tags
  std::vector<float> value;            ///< (N) V
  std::vector<std::uint32_t> next;     ///< (N) the minimiser of V; a first sample itself
  std::vector<float> cut_cost;         ///< (N) T of the cut, whatever it is
  std::vector<std::uint32_t> cut;      ///< (N) the first sample that a cut shows
  std::vector<std::uint32_t> stay;     ///< (N) from a sample of the tag another one of it, or the
                                       ///< same where it can only be held; kNoSample elsewhere
  std::vector<std::uint32_t> in_time;  ///< (action_horizon, N) the minimiser of W_m, m = 1, 2, ..
};

/// What a game plays by name: every tag, and what the phases with one name before the dot make
/// together.
struct Action {
  static constexpr int kStart = 0, kAir = 1, kEnd = 2, kPhases = 3;
  std::string name;
  std::array<std::int32_t, kPhases> tables{-1, -1, -1};  ///< into SpriteData::actions, or -1; a
                                                         ///< single tag stands at kStart
  bool has_phases = false;
};

/// Something that happens when a sample comes to be shown: a foot comes down, a sword strikes.
struct SampleEvent {
  std::uint32_t sample = 0;
  std::uint32_t name = 0;  ///< index into SpriteData::event_names
  friend auto operator<=>(const SampleEvent&, const SampleEvent&) = default;
};

/// The room that the subject takes up, about the anchor, px: the same for all samples of a tag, so
/// that a game does not collide with a wagging tail. From the 5th to the 95th percentile of where
/// the opaque pixels of each picture end.
struct BodyBox {
  std::uint16_t tag = 0;  ///< index into SpriteData::tags
  float left = 0, top = 0, right = 0, bottom = 0;
};

}  // namespace vsprite
