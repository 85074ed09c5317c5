// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// A crowd in real time (P6): so many actors of one pack, steered at random, a picture asked for
// each of them 60 times a second, with a budget of a tenth of the decoded film. Prints the pictures
// that were not there in time, and what decoding ahead costs.
//
//     stream_bench goldfish.vsp [ACTORS 200] [SECONDS 10]
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "vsprite/actor.h"
#include "vsprite/pack.h"
#include "vsprite/random.h"
#include "vsprite/stream.h"

namespace vsprite {
namespace {

constexpr int kFrameRate = 60;

struct Player {
  Actor actor;
  int ticks_left = 0;
};

double cpu_seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

std::size_t decoded_bytes(const Sprite& sprite) {
  std::size_t bytes = 0;
  for (const Sample& s : sprite.samples()) bytes += std::size_t{4} * s.width * s.height;
  return bytes;
}

void tick(const Sprite& sprite, std::vector<Player>& players, Random& random) {
  for (Player& p : players) {
    if (--p.ticks_left < 0) {  // another of eight directions every 0.5 to 3 s
      set_direction(sprite, p.actor, static_cast<Direction>(random.below(8)));
      p.ticks_left =
          static_cast<int>(sprite.fps() * (0.5 + 0.01 * static_cast<double>(random.below(251))));
    }
    step(sprite, p.actor);
  }
}

int run(const Sprite& sprite, int actors, int seconds) {
  using Clock = std::chrono::steady_clock;
  const std::size_t raw = decoded_bytes(sprite);
  FrameCache frames(sprite, raw / 10);
  Random random(1);
  std::vector<Player> players;
  for (int k = 0; k < actors; ++k)
    players.push_back({make_actor(sprite, {}, static_cast<std::uint64_t>(k)), 0});
  for (int k = 0; k < 3000; ++k) tick(sprite, players, random);  // they spread over the film
  std::vector<double> ms;
  std::uint64_t early = 0;
  double ticks = 0, main = 0, all = 0;
  const auto begin = Clock::now();
  for (int f = 0; f < kFrameRate * seconds; ++f) {
    std::this_thread::sleep_until(begin + std::chrono::microseconds(1'000'000LL * f / kFrameRate));
    if (f == kFrameRate) {
      early = frames.stats().misses;
      main = cpu_seconds(CLOCK_THREAD_CPUTIME_ID), all = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID);
    }
    const auto start = Clock::now();
    for (ticks += sprite.fps() / kFrameRate; ticks >= 1; --ticks) tick(sprite, players, random);
    for (Player& p : players) {
      if (frames.frame(p.actor.sample).width == 0) return 1;
      frames.look_ahead(p.actor);
    }
    ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  main = cpu_seconds(CLOCK_THREAD_CPUTIME_ID) - main;
  all = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID) - all;
  const FrameCacheStats& stats = frames.stats();
  std::sort(ms.begin(), ms.end());
  const double late = static_cast<double>(seconds - 1);
  std::printf("%d actors, %d s, budget %.1f of %.1f MB\n", actors, seconds,
              static_cast<double>(raw / 10) / 1e6, static_cast<double>(raw) / 1e6);
  std::printf("misses: %llu in the first second, %llu after it; %.0f pictures a second ahead\n",
              static_cast<unsigned long long>(early),
              static_cast<unsigned long long>(stats.misses - early),
              static_cast<double>(stats.ahead) / seconds);
  std::printf("of one core: the thread %.1f %%, the game's steps and pictures %.1f %%\n",
              100 * (all - main) / late, 100 * main / late);
  std::printf("ms a frame (steps and pictures): median %.2f, 99 %% %.2f\n", ms[ms.size() / 2],
              ms[ms.size() * 99 / 100]);
  return 0;
}

}  // namespace
}  // namespace vsprite

int main(int argc, char** argv) {
  const int actors = argc > 2 ? std::atoi(argv[2]) : 200,
            seconds = argc > 3 ? std::atoi(argv[3]) : 10;
  if (argc < 2 || actors < 1 || seconds < 2) {
    std::fprintf(stderr, "stream_bench PACK [ACTORS] [SECONDS, at least 2]\n");
    return 2;
  }
  const auto sprite = vsprite::load_pack(argv[1]);
  if (!sprite) {
    std::fprintf(stderr, "stream_bench: error: %s\n", sprite.error().message.c_str());
    return 3;
  }
  return vsprite::run(*sprite, actors, seconds);
}
