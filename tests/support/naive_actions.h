// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// naive_actions.h - the tables of a tag by sweeping its equations until nothing changes, and the
// tiny sprite with actions: heading down is jump.start, .air, .end, heading up is "wave".
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/tiny_sprite.h"

namespace vsprite::testing {

inline bool naive_is_first(const SpriteData& data, std::uint32_t i, std::uint16_t tag) {
  const auto has = [&](std::uint32_t s) {
    return data.samples[s].kept != 0 && data.samples[s].tag == tag;
  };
  return has(i) && (i == 0 || !has(i - 1) || data.samples[i - 1].clip != data.samples[i].clip);
}

/// V by Bellman sweeps, in double.
inline std::vector<double> naive_way(const SpriteData& data, std::uint16_t tag, double tau) {
  const auto n = static_cast<std::uint32_t>(data.samples.size());
  std::vector<double> v(n, std::numeric_limits<double>::infinity());
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t i = 0; i < n; ++i) {
      if (data.samples[i].kept == 0) continue;
      double best = naive_is_first(data, i, tag) ? 0 : v[i];
      for (std::uint32_t e = data.row_start[i]; best > 0 && e < data.row_start[i + 1]; ++e)
        best = std::min(best, tau * data.samples[i].duration + double{data.transitions[e].cost} +
                                  v[data.transitions[e].to]);
      changed = changed || best < v[i];
      v[i] = best;
    }
  }
  return v;
}

/// W_m(i) by plain recursion; the sample chosen goes to `to`.
inline double naive_in_time(const SpriteData& data, const ActionTable& t, std::uint32_t i, int m,
                            std::uint32_t* to = nullptr) {
  if (naive_is_first(data, i, t.tag)) {
    if (to) *to = i;
    return 0;
  }
  if (m < 1) return std::numeric_limits<double>::infinity();
  const auto price = [](double c) { return std::max(c, c * c); };
  double best = price(double{t.cut_cost[i]});
  if (to) *to = t.cut[i];
  for (std::uint32_t e = data.row_start[i]; e < data.row_start[i + 1]; ++e) {
    const Transition& edge = data.transitions[e];
    if (m < data.samples[i].duration) continue;
    const double cost =
        price(double{edge.cost}) + naive_in_time(data, t, edge.to, m - data.samples[i].duration);
    if (!(cost < best)) continue;
    best = cost;
    if (to) *to = edge.to;
  }
  return best;
}

inline ActionTable naive_action(const SpriteData& data, std::uint16_t tag, float cut_cost) {
  const auto n = static_cast<std::uint32_t>(data.samples.size());
  ActionTable t;
  t.tag = tag;
  t.value.assign(n, 0);
  t.cut_cost.assign(n, 0);
  t.next.assign(n, kNoSample);
  t.cut = t.stay = t.next;
  t.in_time.assign(n * data.action_horizon, kNoSample);
  const std::vector<double> v = naive_way(data, tag, double{data.action_tau});
  std::uint32_t first = 0;
  while (!naive_is_first(data, first, tag)) ++first;
  for (std::uint32_t i = 0; i < n; ++i) {
    if (data.samples[i].kept == 0) continue;
    t.value[i] = static_cast<float>(v[i]);
    t.cut[i] = first;
    t.cut_cost[i] = cut_cost;
    if (naive_is_first(data, i, tag)) t.next[i] = i;
    const bool inside = data.samples[i].tag == tag;
    if (inside) t.stay[i] = i;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t e = data.row_start[i]; e < data.row_start[i + 1]; ++e) {
      const Transition& edge = data.transitions[e];
      if (inside && data.samples[edge.to].tag == tag && (t.stay[i] == i || edge.cost == 0))
        t.stay[i] = edge.to;
      if (t.next[i] == i || !(double{edge.cost} + v[edge.to] < least)) continue;
      least = double{edge.cost} + v[edge.to];
    }
    for (std::uint32_t e = data.row_start[i]; e < data.row_start[i + 1]; ++e) {
      const Transition& edge = data.transitions[e];
      if (t.next[i] == kNoSample && double{edge.cost} + v[edge.to] == least) t.next[i] = edge.to;
    }
  }
  for (std::uint32_t m = 1; m <= data.action_horizon; ++m)
    for (std::uint32_t i = 0; i < n; ++i)
      if (data.samples[i].kept != 0)
        naive_in_time(data, t, i, static_cast<int>(m), &t.in_time[(m - 1) * n + i]);
  return t;
}

inline constexpr std::uint16_t kStartTag = 2, kAirTag = 3, kEndTag = 4, kWaveTag = 5;

/// The tiny sprite whose samples have tags, without tables for them.
inline SpriteData tagged_sprite_data() {
  SpriteData data = tiny_sprite_data();
  data.tags = {"", "idle", "jump.start", "jump.air", "jump.end", "wave"};
  for (std::uint32_t phase = 0; phase < kTinyClip; ++phase) {
    data.samples[tiny_sample(2, phase)].tag = phase < 3 ? kStartTag : phase < 8 ? kAirTag : kEndTag;
    data.samples[tiny_sample(6, phase)].tag = kWaveTag;
  }
  data.action_tau = 0.05f;
  data.action_horizon = 8;
  return data;
}

inline SpriteData acting_sprite_data() {
  SpriteData data = tagged_sprite_data();
  for (std::uint16_t tag = 1; tag < data.tags.size(); ++tag)
    data.actions.push_back(naive_action(data, tag, 2));
  return data;
}

}  // namespace vsprite::testing
