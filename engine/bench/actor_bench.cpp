// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// What a tick costs (DESIGN P5: at most 10 ns an actor), for 1, 1,000 and 100,000 actors of one
// sprite whose commands change now and then; and drawing one sprite on the CPU.
#include <benchmark/benchmark.h>

#include "support/tiny_sprite.h"
#include "vsprite/actor.h"
#include "vsprite/compose.h"

namespace vsprite {
namespace {

// Arguments: actors, mode (0 paper, 1 responsive), and whether near ties are weighed.
void BM_Step(benchmark::State& state) {
  const Sprite sprite = testing::tiny_sprite();
  std::vector<Actor> actors(static_cast<std::size_t>(state.range(0)),
                            make_actor(sprite, {}, 1, static_cast<int>(state.range(1))));
  const StepWish wish{.slack = 0.1f};
  std::uint32_t tick = 0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < actors.size(); ++i) {
      if ((tick + i) % 20 == 0) {
        set_direction(sprite, actors[i], static_cast<Direction>((tick / 20 + i) % 10));
      }
      if (state.range(2) != 0) {
        step(sprite, actors[i], wish);
      } else {
        step(sprite, actors[i]);
      }
    }
    ++tick;
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(BM_Step)->ArgsProduct({{1, 1000, 100000}, {0, 1}, {0}})->Args({1000, 1, 1});

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
