// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tiny_sprite.h - a sprite small enough to reason about: an arrow that swims in eight headings.
//
// Sample 0 was not kept. Then one clip of 12 samples for each heading (clockwise from right, 60
// px/s at 30 ticks a second), then a clip of 6 that stands still (tag "idle"). A heading may change
// to a neighbouring one at every sample (cost 0.3), its clip closes (0.1), and from every phase 0
// one may come to rest and leave again (0.5). The third sample of each heading is shown for two
// ticks. Modes, solved by plain value iteration: "paper" (K = 3), and "responsive" (turning and
// cruising, playing through at 0.2, bending up to 15 degrees; no model of the player).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "vsprite/image.h"
#include "vsprite/sprite.h"

namespace vsprite::testing {

inline constexpr std::uint32_t kTinyClip = 12;  ///< samples of one heading
inline constexpr std::uint32_t kTinyIdle = 6;   ///< samples that stand still
inline constexpr std::uint32_t kTinyFirstIdle = 1 + 8 * kTinyClip;
inline constexpr std::uint32_t kTinySamples = kTinyFirstIdle + kTinyIdle;
inline constexpr std::uint32_t kTinyStages = 4;  ///< of the mode "paper": K + 1
inline constexpr float kTinySpeed = 60;          ///< px/s

/// The sample of a heading (0 right, clockwise) at a phase 0..11.
inline std::uint32_t tiny_sample(int heading, std::uint32_t phase) {
  return 1 + static_cast<std::uint32_t>(heading) * kTinyClip + phase;
}
/// 0..7, or -1 for a sample that stands still or was not kept.
inline int tiny_heading(std::uint32_t sample) {
  if (sample == 0 || sample >= kTinyFirstIdle) return -1;
  return static_cast<int>((sample - 1) / kTinyClip);
}

namespace tiny {

inline void add_samples(SpriteData& data) {
  data.samples.resize(kTinySamples);
  for (std::uint32_t i = 1; i < kTinySamples; ++i) {
    Sample& s = data.samples[i];
    const int heading = tiny_heading(i);
    const Vec2 unit = unit_vector(heading < 0 ? Direction::Rest : static_cast<Direction>(heading));
    s.width = static_cast<std::uint16_t>(22 + i % 3);
    s.height = static_cast<std::uint16_t>(20 + i % 2);
    s.anchor = {static_cast<float>(s.width) / 2, static_cast<float>(s.height) / 2};
    s.velocity = {unit.x * kTinySpeed, unit.y * kTinySpeed};
    s.step_x = step_per_tick(s.velocity.x, data.fps_numerator, data.fps_denominator);
    s.step_y = step_per_tick(s.velocity.y, data.fps_numerator, data.fps_denominator);
    s.area = 150;
    s.duration = static_cast<std::uint16_t>(heading >= 0 && (i - 1) % kTinyClip == 2 ? 2 : 1);
    s.tag = static_cast<std::uint16_t>(heading < 0 ? 1 : 0);
    s.clip = heading < 0 ? 9 : static_cast<std::uint32_t>(heading) + 1;
    s.frame = i;
    s.kept = 1;
    const bool last = heading < 0 ? i + 2 >= kTinySamples : (i - 1) % kTinyClip + 2 >= kTinyClip;
    if (!last) s.skip_cost = 0.2f;
  }
}

inline void add_transitions(SpriteData& data) {
  data.row_start.assign(1, 0);
  for (std::uint32_t i = 0; i < kTinySamples; ++i) {
    std::vector<Transition> row;
    const int heading = tiny_heading(i);
    const std::uint32_t phase = heading < 0 ? i - kTinyFirstIdle : (i - 1) % kTinyClip;
    if (i >= kTinyFirstIdle) {
      const bool last = phase + 1 == kTinyIdle;
      row.push_back({last ? kTinyFirstIdle : i + 1, last ? 0.1f : 0.0f});
      if (phase == 0) {
        for (int h = 0; h < 8; ++h) row.push_back({tiny_sample(h, 0), 0.5f});
      }
    } else if (heading >= 0) {
      const std::uint32_t after = (phase + 1) % kTinyClip;
      row.push_back({tiny_sample(heading, after), after == 0 ? 0.1f : 0.0f});
      row.push_back({tiny_sample((heading + 1) % 8, after), 0.3f});
      row.push_back({tiny_sample((heading + 7) % 8, after), 0.3f});
      if (phase == 0) row.push_back({kTinyFirstIdle, 0.5f});
    }
    std::sort(row.begin(), row.end(), [](auto& a, auto& b) { return a.to < b.to; });
    data.transitions.insert(data.transitions.end(), row.begin(), row.end());
    data.row_start.push_back(static_cast<std::uint32_t>(data.transitions.size()));
  }
}

/// |angle(v_j, l)| in radians; pi for a sample that stands still, and the reverse for Rest.
inline double angle_term(int direction, std::uint32_t sample) {
  constexpr double kPi = 3.14159265358979;
  const int heading = tiny_heading(sample);
  if (direction == static_cast<int>(Direction::None)) return 0;
  if (direction == static_cast<int>(Direction::Rest)) return heading < 0 ? 0 : kPi;
  if (heading < 0) return kPi;
  const int apart = std::abs(heading - direction);
  return std::min(apart, 8 - apart) * kPi / 4;
}

/// True if the mode's last stage ends at this sample, for a group of tables.
inline bool has_turned(const ControlMode& mode, int direction, std::uint32_t sample) {
  return mode.by_state && (direction >= kCompassCount || tiny_heading(sample) == direction);
}

/// One table, swept until it stands: V_i = min_j [T_ij + G_j], G_j = w |angle(v_j, l)| + a V'_j.
/// `behind`: V of the stage that follows, where the sample (or, by the clock, any) ends this one.
inline std::vector<double> solve_table(const SpriteData& data, ControlMode& mode, int direction,
                                       std::uint32_t stage, const std::vector<double>& behind) {
  const bool turning = mode.by_state && stage > 0;
  const double weight = turning ? double{mode.turn_w1} : stage == 0 ? double{mode.w1} : 0.0;
  const std::size_t table = std::size_t{static_cast<unsigned>(direction)} * mode.stages + stage;
  std::vector<double> values(kTinySamples, 0);
  for (int round = 0; round < (turning || stage == 0 ? 250 : 1); ++round) {
    for (std::uint32_t j = 1; j < kTinySamples; ++j) {
      const bool ends = stage > 0 && (!mode.by_state || has_turned(mode, direction, j));
      mode.go[table * kTinySamples + j] = static_cast<float>(
          weight * angle_term(direction, j) + mode.alpha * (ends ? behind[j] : values[j]));
    }
    const float* go = mode.go.data() + table * kTinySamples;
    for (std::uint32_t i = 1; i < kTinySamples; ++i) {
      double best = std::numeric_limits<double>::infinity();
      const auto offer = [&](std::uint32_t to, double price) {
        if (!(price + double{go[to]} < best)) return;
        best = price + double{go[to]};
        mode.next[table * kTinySamples + i] = to;
      };
      for (std::uint32_t k = data.row_start[i]; k < data.row_start[i + 1]; ++k)
        offer(data.transitions[k].to, double{data.transitions[k].cost});
      const double skip = double{data.samples[i].skip_cost};
      if (mode.plays_through && std::isfinite(skip)) offer(i + 2, skip);
      values[i] = best;
    }
  }
  return values;
}

inline ControlMode make_mode(const SpriteData& data, const char* name, std::uint32_t stages,
                             bool by_state) {
  ControlMode mode;
  mode.name = name;
  mode.alpha = 0.9f;
  mode.w1 = 0.5f;
  mode.cap = 1;
  mode.stages = stages;
  mode.served = 0xFF;
  mode.served_headings = 0xFF;
  mode.residual = 1e-9;
  mode.error_bound = 1e-8;
  mode.next.assign(mode.tables() * kTinySamples, kNoSample);
  mode.go.assign(mode.tables() * kTinySamples, 0);
  if (by_state) {
    mode.by_state = mode.plays_through = true;
    mode.turn_w1 = 2;
    mode.bend_cos = 1037154959;  // cos and sin of 15 degrees, times 2^30
    mode.bend_sin = 277904834;
    mode.arrived.assign(kTinySamples, 0);
    for (std::uint32_t i = 1; i < kTinyFirstIdle; ++i) mode.arrived[i] = 1u << tiny_heading(i);
  }
  for (int d = 0; d < kDirectionCount; ++d) {
    mode.table_of[static_cast<std::size_t>(d)] = static_cast<Direction>(d);
    std::vector<double> values(kTinySamples, 0);
    for (std::uint32_t k = 0; k < stages; ++k) values = solve_table(data, mode, d, k, values);
  }
  return mode;
}

}  // namespace tiny

inline SpriteData tiny_sprite_data() {
  SpriteData data;
  data.name = "tiny";
  data.body_length = 20;
  data.tags = {"swim", "idle"};
  data.start_sample = 1;
  tiny::add_samples(data);
  tiny::add_transitions(data);
  data.modes.push_back(tiny::make_mode(data, "paper", kTinyStages, false));
  data.modes.push_back(tiny::make_mode(data, "responsive", 2, true));
  return data;
}

/// The straight-alpha picture of a sample: an arrow head along the heading (a disc at rest), one
/// hue a heading, with a soft edge. Only the unit vectors and sqrt go into it.
inline Image tiny_picture(const SpriteData& data, std::uint32_t sample) {
  constexpr std::uint8_t kHues[9][3] = {{230, 60, 50},  {230, 150, 40}, {220, 220, 50},
                                        {90, 200, 60},  {50, 190, 170}, {60, 120, 230},
                                        {120, 70, 220}, {220, 70, 180}, {190, 190, 190}};
  const Sample& s = data.samples[sample];
  const int heading = tiny_heading(sample);
  const Vec2 u = unit_vector(heading < 0 ? Direction::Rest : static_cast<Direction>(heading));
  Image image{s.width, s.height, std::vector<std::uint8_t>(std::size_t{4} * s.width * s.height)};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float dx = static_cast<float>(x) + 0.5f - s.anchor.x;
      const float dy = static_cast<float>(y) + 0.5f - s.anchor.y;
      const float along = dx * u.x + dy * u.y;
      const float across = std::fabs(dx * u.y - dy * u.x);
      const float inside = heading < 0 ? 8.0f - std::sqrt(dx * dx + dy * dy)
                                       : std::min(8.0f - along - 2 * across, along + 8.0f);
      std::uint8_t* p = image.rgba.data() + 4 * (y * image.width + x);
      const auto* hue = kHues[heading < 0 ? 8 : heading];
      p[0] = hue[0];
      p[1] = hue[1];
      p[2] = static_cast<std::uint8_t>(hue[2] - static_cast<int>(sample % kTinyClip));
      p[3] = static_cast<std::uint8_t>(std::clamp(inside * 0.5f + 0.5f, 0.0f, 1.0f) * 255 + 0.5f);
    }
  }
  return image;
}

/// Without pictures.
inline Sprite tiny_sprite() { return *make_sprite(tiny_sprite_data()); }

/// `n` samples of 2 x 2 px that go right and round, one transition each.
inline SpriteData long_sprite_data(std::uint32_t n) {
  SpriteData data = tiny_sprite_data();
  Sample sample = data.samples[1];
  sample.width = sample.height = 2;
  sample.anchor = {1, 1};
  data.tags = {""};
  data.samples.assign(n, sample);
  data.row_start.assign(1, 0);
  data.transitions.clear();
  data.start_sample = 0;
  ControlMode mode = data.modes[0];
  mode.stages = 1;
  mode.served = mode.served_headings = 1;
  mode.table_of.fill(Direction::Right);
  std::vector<std::uint32_t> next;
  for (std::uint32_t i = 0; i < n; ++i) {
    data.samples[i].frame = i;
    if (i + 2 >= n) data.samples[i].skip_cost = std::numeric_limits<float>::infinity();
    const bool last = i + 1 == n;
    data.transitions.push_back({last ? 0 : i + 1, last ? 0.1f : 0.0f});
    data.row_start.push_back(i + 1);
    next.push_back(data.transitions.back().to);
  }
  mode.next.clear();
  for (std::size_t t = 0; t < mode.tables(); ++t)
    mode.next.insert(mode.next.end(), next.begin(), next.end());
  mode.go.assign(mode.next.size(), 0);
  data.modes.assign(1, mode);
  return data;
}

}  // namespace vsprite::testing
