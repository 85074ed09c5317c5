// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// turnstrips PACK FOLDER [COUNT [SEED]] - film strips of turns to look at: one picture a turn, a
// row for each mode of the pack, every tick at full size from two before the command on, anchors in
// the middle. Under a picture that a jump led to stands a bar of the jump's cost (the cell's width:
// 1). Printed: what jumped, and how the steps of the position change.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "vsprite/actor.h"
#include "vsprite/compose.h"
#include "vsprite/pack.h"
#include "vsprite/random.h"
#include "vsprite/record.h"
#include "vsprite/show.h"

namespace {

using namespace vsprite;

constexpr int kBefore = 2, kAfter = 14, kSettle = 90;  // ticks

struct Turn {
  Direction from, to;
};

void bar(Image& canvas, int x, int y, int width) {
  for (int dy = 0; dy < 6; ++dy)
    for (int dx = 0; dx < width; ++dx) {
      std::uint8_t* p = canvas.rgba.data() + 4 * (static_cast<std::size_t>(y + dy) *
                                                      static_cast<std::size_t>(canvas.width) +
                                                  static_cast<std::size_t>(x + dx));
      p[0] = 200, p[1] = 30, p[2] = 30;
    }
}

void film(const Sprite& sprite, FrameCache& frames, int mode, const Turn& turn, int cell, int top,
          Image& canvas) {
  Actor actor = make_actor(sprite, {}, 1, mode);
  set_direction(sprite, actor, turn.from);
  for (int t = 0; t < kSettle; ++t) step(sprite, actor);
  std::printf("  %-10s", sprite.data().modes[static_cast<std::size_t>(mode)].name.c_str());
  for (int t = -kBefore; t < kAfter; ++t) {
    if (t == 0) set_direction(sprite, actor, turn.to);
    const Actor before = actor;
    step(sprite, actor);
    const double cost = static_cast<double>(shown_cost(sprite, before.sample, actor));
    const int left = (t + kBefore) * cell;
    draw_sample(canvas, frames.frame(actor.sample), sprite.samples()[actor.sample],
                {static_cast<float>(left + cell / 2), static_cast<float>(top + cell / 2)});
    if (cost > 0)
      bar(canvas, left, top + cell - 6, std::clamp(static_cast<int>(cost * cell), 1, cell));
    const Vec2 a = to_pixels(before.position), b = to_pixels(actor.position);
    std::printf(" %s%.1f", cost > 0 ? "*" : "",
                std::hypot(static_cast<double>(b.x - a.x), static_cast<double>(b.y - a.y)));
  }
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: turnstrips PACK FOLDER [COUNT [SEED]]\n", stderr);
    return 2;
  }
  const auto sprite = load_pack(argv[1]);
  if (!sprite) {
    std::fprintf(stderr, "turnstrips: error: %s\n", sprite.error().message.c_str());
    return 3;
  }
  const int count = argc > 3 ? std::atoi(argv[3]) : 10;
  Random random{argc > 4 ? std::strtoull(argv[4], nullptr, 10) : 1};
  std::vector<Direction> served;
  for (int d = 0; d < kCompassCount; ++d)
    if ((sprite->data().modes.front().served >> d & 1u) != 0)
      served.push_back(static_cast<Direction>(d));
  int cell = 0;
  for (const Sample& s : sprite->samples())
    if (s.kept) cell = std::max({cell, int{s.width}, int{s.height}});
  const int modes = static_cast<int>(sprite->data().modes.size());
  std::filesystem::create_directories(argv[2]);
  FrameCache frames(*sprite);
  for (int k = 0; k < count && served.size() > 1; ++k) {
    const std::size_t from = random.below(served.size());
    const std::size_t to = (from + 1 + random.below(served.size() - 1)) % served.size();
    const Turn turn{served[from], served[to]};
    Image canvas = make_checkerboard((kBefore + kAfter) * cell, modes * cell, 16);
    std::printf("%d: %d -> %d, px a tick; * = jump\n", k, static_cast<int>(turn.from),
                static_cast<int>(turn.to));
    for (int m = 0; m < modes; ++m) film(*sprite, frames, m, turn, cell, m * cell, canvas);
    char name[32];
    std::snprintf(name, sizeof name, "/turn%02d.png", k);
    if (auto saved = save_png(argv[2] + std::string(name), canvas); !saved) {
      std::fprintf(stderr, "turnstrips: error: %s\n", saved.error().message.c_str());
      return 4;
    }
  }
  return 0;
}
