// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// DESIGN P4: the exact beam against the same beam by std::sort and by std::nth_element, in one run
// on one thread, on a square path; 10 s and 60 s of motion. Time is given per tick of motion.
//
//     beam_bench [PACK.vsp] --benchmark_repetitions=5      without a pack: a synthetic sprite
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string_view>

#include "control/response.h"
#include "control/search.h"
#include "support/naive_beam.h"
#include "vsprite/pack.h"
#include "vsprite/random.h"

namespace vsprite {
namespace {

constexpr int kWidth = 50000;

/// 3,000 samples that swim in every direction, 60 transitions each, costs as a film's.
Sprite synthetic_sprite() {
  SpriteData data;
  data.name = "synthetic";
  data.body_length = 150;
  Random random{7};
  constexpr std::uint32_t kSamples = 3000, kEdges = 60, kClip = 100;
  data.samples.resize(kSamples);
  data.row_start.assign(1, 0);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    Sample& s = data.samples[i];
    const double turn = 2 * (i / kClip) / 30.0 * kPi + (i % kClip) * 0.02;
    // A circle without libm would do as well: this is no pack.
    s.velocity = {static_cast<float>(180 * std::cos(turn)),
                  static_cast<float>(180 * std::sin(turn))};
    s.step_x = step_per_tick(s.velocity.x, 30, 1);
    s.step_y = step_per_tick(s.velocity.y, 30, 1);
    s.clip = i / kClip;
    s.frame = i;
    s.width = s.height = 8;
    s.area = 50;
    s.kept = 1;
    std::vector<Transition> row;
    for (std::uint32_t e = 0; e < kEdges; ++e)
      row.push_back({static_cast<std::uint32_t>(random.below(kSamples)),
                     static_cast<float>(0.2 + 0.8 * random.unit())});
    row.push_back({(i + 1) % kClip == 0 ? i + 1 - kClip : i + 1, 0});
    std::sort(row.begin(), row.end(),
              [](auto& a, auto& b) { return a.to != b.to ? a.to < b.to : a.cost < b.cost; });
    row.erase(std::unique(row.begin(), row.end(), [](auto& a, auto& b) { return a.to == b.to; }),
              row.end());
    data.transitions.insert(data.transitions.end(), row.begin(), row.end());
    data.row_start.push_back(static_cast<std::uint32_t>(data.transitions.size()));
  }
  ControlMode mode;
  mode.name = "paper";
  mode.next.assign(std::size_t{kDirectionCount} * kSamples, 0);
  for (std::size_t k = 0; k < mode.next.size(); ++k)
    mode.next[k] = data.transitions[data.row_start[k % kSamples]].to;
  data.modes.push_back(mode);
  auto sprite = make_sprite(std::move(data));
  if (!sprite) std::fprintf(stderr, "%s\n", sprite.error().message.c_str());
  return std::move(*sprite);
}

std::unique_ptr<Sprite> the_sprite;

/// A square that takes about `seconds` at the usual speed.
PathCost square(double seconds) {
  const SpeedScale speeds = measure_speeds(the_sprite->samples());
  const auto side = static_cast<float>(speeds.usual * seconds / 4);
  const double body = static_cast<double>(the_sprite->data().body_length);
  const std::vector<Vec2> points = {{0, 0}, {side, 0}, {side, side}, {0, side}, {0, 0}};
  return *PathCost::make(*the_sprite, points,
                         {.w1 = 0.2,
                          .w2 = 8 / (body * body),
                          .tau = 0.1,
                          .usual_speed = speeds.usual,
                          .v0 = 0.35 * speeds.usual,
                          .least_speed = 0.0875 * speeds.usual});
}

void report(benchmark::State& state, std::uint64_t ticks) {
  using benchmark::Counter;
  state.counters["ticks"] = static_cast<double>(ticks);
  state.counters["s_per_tick"] =
      Counter(static_cast<double>(ticks), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void BM_Naive(benchmark::State& state) {
  const PathCost path = square(10);
  const auto how = static_cast<testing::Selection>(state.range(0));
  testing::NaiveBeam out;
  for (auto _ : state)
    out = testing::naive_beam(path, kWidth, how, static_cast<std::uint64_t>(state.range(1)));
  report(state, out.ticks);
}
// Sorting takes long: its time is that of the first ticks.
BENCHMARK(BM_Naive)
    ->Args({0, 10})
    ->Args({1, 40})
    ->ArgNames({"nth_element", "ticks"})
    ->Unit(benchmark::kMillisecond);

void BM_Exact(benchmark::State& state) {
  const PathCost path = square(static_cast<double>(state.range(0)));
  SearchStats stats;
  for (auto _ : state) {
    stats = {};
    const auto clip =
        search_path(path, {.width = kWidth, .jobs = static_cast<int>(state.range(1))}, &stats);
    if (!clip) state.SkipWithError(clip.error().message.c_str());
  }
  report(state, stats.ticks);
}
BENCHMARK(BM_Exact)
    ->Args({10, 1})
    ->Args({10, 2})
    ->Args({60, 1})
    ->ArgNames({"seconds", "jobs"})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// The same survivors in every tick, at several widths, on this very sprite?
bool survivors_agree() {
  const PathCost path = square(1);
  std::size_t wrong = 0;
  for (const int width : {10, 1000, kWidth}) {
    std::vector<std::vector<PathState>> ours;
    (void)search_path(path, {.width = width, .survivors = [&](std::span<const PathState> s) {
                               ours.emplace_back(s.begin(), s.end());
                             }});
    std::size_t tick = 0;
    const auto compare = [&](std::span<const PathState> s) {
      const auto same = [](const PathState& a, const PathState& b) {
        return a.cost == b.cost && a.sample == b.sample && a.x == b.x && a.y == b.y;
      };
      wrong += tick >= ours.size() ||
               !std::equal(s.begin(), s.end(), ours[tick].begin(), ours[tick].end(), same);
      ++tick;
    };
    testing::naive_beam(path, static_cast<std::size_t>(width), testing::Selection::NthElement, 0,
                        compare);
    wrong += tick != ours.size();
    std::printf("width %d: survivors of %zu ticks compared, %zu differ\n", width, tick, wrong);
  }
  return wrong == 0;
}

}  // namespace
}  // namespace vsprite

int main(int argc, char** argv) {
  using namespace vsprite;
  if (argc > 1 && std::string_view(argv[1]).ends_with(".vsp")) {
    auto loaded = load_pack(argv[1]);
    if (!loaded) return std::fprintf(stderr, "%s\n", loaded.error().message.c_str()), 1;
    the_sprite = std::make_unique<Sprite>(std::move(*loaded));
    argv[1] = argv[0];
    --argc, ++argv;
  } else {
    the_sprite = std::make_unique<Sprite>(synthetic_sprite());
  }
  benchmark::Initialize(&argc, argv);
  if (!survivors_agree()) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
