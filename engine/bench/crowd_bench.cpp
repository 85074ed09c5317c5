// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// A crowd on the screen: so many actors of one pack, steered at random, by depth, with shadows and
// fades, 60 frames a second into memory, pictures decoded ahead with a budget of a tenth of the
// decoded film. Prints what a frame takes until the driver has drawn it, and the pictures that were
// not there in time.
//
//     crowd_bench goldfish.vsp [ACTORS 200] [SECONDS 10] [BODY 64] [LAST.png]
//
// BODY: length drawn, px.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "vsprite/draw.h"
#include "vsprite/pack.h"
#include "vsprite/random.h"
#include "vsprite/record.h"
#include "vsprite/window.h"

namespace vsprite {
namespace {

constexpr int kFrameRate = 60, kWidth = 1280, kHeight = 720;

struct Player {
  Actor actor;
  ActorFade fade;
  int ticks_left = 0;
};

/// Another of eight directions every 0.5 to 3 s; who leaves comes in on the other side.
void tick(const Sprite& sprite, std::vector<Player>& players, Random& random, Vec2 room) {
  const auto wrap = [](std::int64_t& value, float most) {
    const auto far = static_cast<std::int64_t>(most) * kFixedOne;
    value = (value % far + far) % far;
  };
  for (Player& p : players) {
    if (--p.ticks_left < 0) {
      set_direction(sprite, p.actor, static_cast<Direction>(random.below(8)));
      p.ticks_left =
          static_cast<int>(sprite.fps() * (0.5 + 0.01 * static_cast<double>(random.below(251))));
    }
    step(sprite, p.actor);
    follow(sprite, p.actor, p.fade);
    wrap(p.actor.position.x, room.x);
    wrap(p.actor.position.y, room.y);
  }
}

struct Times {
  std::vector<double> ms{};
  double at(std::size_t percent) {
    std::sort(ms.begin(), ms.end());
    return ms[(ms.size() - 1) * percent / 100];
  }
};

Result<void> run(const Sprite& sprite, int actors, int seconds, float body, const char* picture) {
  using Clock = std::chrono::steady_clock;
  Result<Window> window = Window::open({.width = kWidth, .height = kHeight, .headless = true});
  if (!window) return window.error();
  Result<Renderer> renderer = make_renderer(Window::gl_function);
  if (!renderer) return renderer.error();
  std::size_t raw = 0;
  for (const Sample& s : sprite.samples()) raw += std::size_t{4} * s.width * s.height;
  FrameCache frames(sprite, raw / 10);
  const float scale = body / sprite.data().body_length;
  const Vec2 room{kWidth / scale, kHeight / scale};
  Random random(1);
  std::vector<Player> players(static_cast<std::size_t>(actors));
  for (std::size_t k = 0; k < players.size(); ++k) players[k].actor = make_actor(sprite, {}, k);
  for (int k = 0; k < 3000; ++k) tick(sprite, players, random, room);  // over film and room
  std::vector<ActorDraw> list(players.size());
  for (std::size_t k = 0; k < players.size(); ++k) {
    list[k].sprite = &sprite;
    list[k].frames = &frames;
    list[k].actor = &players[k].actor;
    list[k].fade = &players[k].fade;
  }
  const Shadow shadow{.opacity = 0.3f, .squash = 1, .offset = {6, 10}};
  Times all;
  std::uint64_t early = 0, uploads = 0, batches = 0;
  double ticks = 0;
  const auto begin = Clock::now();
  for (int f = 0; f < kFrameRate * seconds; ++f) {
    std::this_thread::sleep_until(begin + std::chrono::microseconds(1'000'000LL * f / kFrameRate));
    if (f == kFrameRate) early = frames.stats().misses;
    const auto start = Clock::now();
    for (ticks += sprite.fps() / kFrameRate; ticks >= 1; --ticks)
      tick(sprite, players, random, room);
    renderer->begin_frame(kWidth, kHeight);
    renderer->clear(srgb(0x9cc4d8));
    renderer->set_camera({.scale = scale});
    draw_actors(*renderer, list, static_cast<float>(ticks), &shadow);
    renderer->end_frame();
    window->swap();
    renderer->wait();
    if (f < kFrameRate) continue;  // the first second fills the caches
    all.ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    uploads += renderer->stats().uploads;
    batches += renderer->stats().batches;
  }
  const auto count = static_cast<double>(all.ms.size());
  std::printf("%d actors of %.0f px, %d s, on %s\n", actors, static_cast<double>(body), seconds,
              renderer->device().c_str());
  std::printf("ms a frame after the first second: median %.2f, 99 %% %.2f, worst %.2f\n",
              all.at(50), all.at(99), all.at(100));
  std::printf("a frame: %.1f pictures sent, %.1f draw calls; pages emptied: %llu\n",
              static_cast<double>(uploads) / count, static_cast<double>(batches) / count,
              static_cast<unsigned long long>(renderer->stats().evictions));
  std::printf("pictures that came too late: %llu in the first second, %llu after it\n",
              static_cast<unsigned long long>(early),
              static_cast<unsigned long long>(frames.stats().misses - early));
  if (picture != nullptr) return save_png(picture, renderer->read_pixels());
  return {};
}

}  // namespace
}  // namespace vsprite

int main(int argc, char** argv) {
  const auto number = [&](int k, int usual) { return argc > k ? std::atoi(argv[k]) : usual; };
  const int actors = number(2, 200), seconds = number(3, 10), body = number(4, 64);
  if (argc < 2 || actors < 1 || seconds < 2 || body < 1) {
    std::fprintf(stderr, "crowd_bench PACK [ACTORS] [SECONDS, at least 2] [BODY px] [LAST.png]\n");
    return 2;
  }
  const auto sprite = vsprite::load_pack(argv[1]);
  const vsprite::Result<void> done =
      sprite ? vsprite::run(*sprite, actors, seconds, static_cast<float>(body),
                            argc > 5 ? argv[5] : nullptr)
             : vsprite::Result<void>(sprite.error());
  if (done) return 0;
  std::fprintf(stderr, "crowd_bench: error: %s\n", done.error().message.c_str());
  return 3;
}
