// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// What a tick costs (DESIGN P5: at most 10 ns an actor, 100,000 in 1 ms), for 1, 1,000 and 100,000
// actors of one sprite, one in twenty of which is commanded anew every tick; and drawing one sprite
// on the CPU.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "support/tiny_sprite.h"
#include "vsprite/actor.h"
#include "vsprite/compose.h"

namespace vsprite {
namespace {

// As many samples as a long film holds, each with fifty jumps and a random table: the actors are
// spread over it all, as bad for the caches as a crowd can be.
SpriteData large_sprite_data() {
  constexpr std::uint32_t kSamples = 15000, kClip = 250, kRow = 50;
  const SpriteData tiny = testing::tiny_sprite_data();
  SpriteData data;
  data.name = "large";
  std::mt19937 random(5);
  data.row_start.assign(1, 0);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    Sample s = tiny.samples[1 + random() % 96];
    s.clip = i / kClip;
    s.skip_cost = i % kClip + 2 < kClip ? 0.6f : std::numeric_limits<float>::infinity();
    data.samples.push_back(s);
    std::vector<std::uint32_t> row;
    if (i % kClip + 1 < kClip) row.push_back(i + 1);
    while (row.size() < kRow) row.push_back(static_cast<std::uint32_t>(random() % kSamples));
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    for (const std::uint32_t to : row) data.transitions.push_back({to, to == i + 1 ? 0 : 0.5f});
    data.row_start.push_back(static_cast<std::uint32_t>(data.transitions.size()));
  }
  for (ControlMode mode : tiny.modes) {
    if (!mode.by_state) mode.stages = 6;  // K = 5, as a film is solved
    mode.next.clear();
    for (std::size_t k = 0; k < mode.tables() * kSamples; ++k) {
      const auto i = static_cast<std::uint32_t>(k % kSamples);
      const std::uint32_t first = data.row_start[i];
      const bool natural = i % kClip + 1 < kClip && random() % 4 != 0;
      const std::uint32_t pick =
          first + static_cast<std::uint32_t>(random() % (data.row_start[i + 1] - first));
      mode.next.push_back(natural ? i + 1 : data.transitions[pick].to);
    }
    mode.go.assign(mode.next.size(), 1);
    mode.arrived.clear();
    if (mode.by_state) {
      for (std::uint32_t i = 0; i < kSamples; ++i) mode.arrived.push_back(1u << random() % 8);
    }
    data.modes.push_back(std::move(mode));
  }
  return data;
}

const Sprite& sprite_of(std::int64_t large) {
  static const Sprite tiny = testing::tiny_sprite();
  static const Sprite big = *make_sprite(large_sprite_data());
  return large != 0 ? big : tiny;
}

std::vector<Actor> make_crowd(const Sprite& sprite, std::int64_t count, std::int64_t mode) {
  std::vector<Actor> actors;
  std::mt19937 random(7);
  while (std::ssize(actors) < count) {
    Actor actor = make_actor(sprite, {}, random(), static_cast<int>(mode));
    actor.sample = static_cast<std::uint32_t>(1 + random() % (sprite.samples().size() - 1));
    actors.push_back(actor);
  }
  return actors;
}

// Arguments: actors, mode (0 paper, 1 responsive), 15,000 samples instead of 103.
void BM_Step(benchmark::State& state) {
  const Sprite& sprite = sprite_of(state.range(2));
  std::vector<Actor> actors = make_crowd(sprite, state.range(0), state.range(1));
  std::size_t tick = 0;
  for (auto _ : state) {
    for (std::size_t i = tick % 20; i < actors.size(); i += 20)
      set_direction(sprite, actors[i], static_cast<Direction>((tick / 20 + i) % 10));
    if (actors.size() == 1) {
      step(sprite, actors[0]);
    } else {
      step(sprite, actors);
    }
    ++tick;
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(BM_Step)->ArgsProduct({{1, 1000, 100000}, {0, 1}, {0, 1}});

float room_right(const void*, Vec2 position) { return -position.x; }

// Arguments: variety or clearance. Every tick looks at a row of transitions.
void BM_StepWish(benchmark::State& state) {
  const Sprite& sprite = sprite_of(1);
  std::vector<Actor> actors = make_crowd(sprite, 1000, 1);
  const StepWish wish{.slack = 0.1f, .clearance = state.range(0) != 0 ? room_right : nullptr};
  for (auto _ : state) {
    for (Actor& actor : actors) step(sprite, actor, wish);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * 1000);
}
BENCHMARK(BM_StepWish)->Arg(0)->Arg(1);

void BM_DrawSprite(benchmark::State& state) {
  Image canvas = make_checkerboard(128, 128);
  Image picture = make_image(64, 64, 200, 120, 40, 200);
  for (auto _ : state) {
    draw_picture(canvas, picture, {20.25f, 30.75f}, {.blend = static_cast<Blend>(state.range(0))});
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_DrawSprite)->Arg(0)->Arg(1);

}  // namespace
}  // namespace vsprite
