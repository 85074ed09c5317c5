// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// What a puppet costs: posing it, drawing it, fitting it. One thread, and the driver's own.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>

#include "puppet/art.h"
#include "vsprite/compose.h"
#include "vsprite/random.h"
#ifdef VSPRITE_BENCH_DRAW
#include "vsprite/draw.h"
#include "vsprite/window.h"
#endif

namespace vsprite {
namespace {

Puppet first(const ViewSet& set) { return std::move(fit_puppets(set)->at(0)); }

void pose(benchmark::State& state, const Puppet& puppet) {
  PuppetPose pose = make_pose(puppet);
  const RbfNetwork& net = puppet.net;
  std::vector<double> at(static_cast<std::size_t>(net.dims));
  Random random{1};
  for (auto _ : state) {
    for (std::size_t d = 0; d < at.size(); ++d) {
      const PuppetParameter& p = puppet.parameters[d];
      at[d] = p.low + random.unit() * (p.high - p.low);
    }
    pose_puppet(puppet, at, pose);
    benchmark::DoNotOptimize(pose.points.data());
  }
  state.counters["points"] = static_cast<double>(puppet.point_count());
  state.counters["views"] = net.center_count();
}

void PoseFace(benchmark::State& state) { pose(state, first(puppet_art::face_views())); }
void PoseWalk(benchmark::State& state) { pose(state, first(puppet_art::walk_views())); }
void PoseArm(benchmark::State& state) { pose(state, first(puppet_art::arm_views())); }
BENCHMARK(PoseFace)->Unit(benchmark::kMicrosecond);
BENCHMARK(PoseWalk)->Unit(benchmark::kMicrosecond);
BENCHMARK(PoseArm)->Unit(benchmark::kMicrosecond);

// A frame of 1,000 walkers, posed: 16.7 ms are a frame at 60 a second.
void PoseThousandWalkers(benchmark::State& state) {
  const Puppet puppet = first(puppet_art::walk_views());
  PuppetPose pose = make_pose(puppet);
  double phase = 0;
  for (auto _ : state) {
    for (int k = 0; k < 1000; ++k) {
      phase += 0.00617;
      pose_puppet(puppet, std::array{std::cos(phase), std::sin(phase)}, pose);
      benchmark::DoNotOptimize(pose.points.data());
    }
  }
}
BENCHMARK(PoseThousandWalkers)->Unit(benchmark::kMillisecond);

void RenderWalk(benchmark::State& state) {
  const Puppet puppet = first(puppet_art::walk_views());
  PuppetPose pose = make_pose(puppet);
  pose_puppet(puppet, std::array{0.4, 0.3}, pose);
  PuppetPainter painter;
  Image canvas = make_image(320, 380, 0, 0, 0, 0);
  for (auto _ : state) render_puppet(puppet, pose, painter, canvas, pose.center);
}
BENCHMARK(RenderWalk)->Unit(benchmark::kMicrosecond);

void FitThirtyViewsOfTwoHundredPoints(benchmark::State& state) {
  Random random{2};
  Examples e{.dims = 2, .outputs = 2 * 200 + 2 + 200 + 30, .x = {}, .y = {}};
  for (int i = 0; i < 60; ++i) e.x.push_back(random.unit());
  for (int i = 0; i < 30 * e.outputs; ++i) e.y.push_back(100 * random.unit());
  for (auto _ : state) benchmark::DoNotOptimize(fit_rbf(e));
}
BENCHMARK(FitThirtyViewsOfTwoHundredPoints)->Unit(benchmark::kMillisecond);

#ifdef VSPRITE_BENCH_DRAW
using Clock = std::chrono::steady_clock;

// A frame of 1,000 walkers of one puppet, each in a pose of its own, on the renderer: their height
// in px, and the side of the square frame. The counters are milliseconds a frame: posing;
// draw_puppet, until nothing is left but to tell the driver; the driver's calls; and what it still
// needs to finish, which for a software driver is vertices and pixels. A frame of 1 px leaves no
// pixels.
void DrawThousandWalkers(benchmark::State& state) {
  constexpr int kCount = 1000;
  const int side = static_cast<int>(state.range(1));
  Result<Window> window = Window::open({.width = side, .height = side, .headless = true});
  if (!window) return state.SkipWithError(window.error().message.c_str());
  Result<Renderer> renderer = make_renderer(Window::gl_function);
  if (!renderer) return state.SkipWithError(renderer.error().message.c_str());
  const Puppet puppet = first(puppet_art::walk_views());
  const Result<PuppetSkin> skin = renderer->make_skin(puppet);
  if (!skin) return state.SkipWithError(skin.error().message.c_str());
  const float scale =
      static_cast<float>(state.range(0)) / static_cast<float>(puppet.views[0].picture.height);
  std::vector<PuppetPose> poses(kCount, make_pose(puppet));
  std::vector<Vec2> places;
  Random random{3};
  for (int k = 0; k < kCount; ++k) {
    const auto x = static_cast<float>(random.unit() * side);
    places.push_back({x, static_cast<float>(random.unit() * side)});
  }
  double phase = 0, posing = 0, drawing = 0, driver = 0, waiting = 0;
  const auto frame = [&] {
    const auto start = Clock::now();
    for (PuppetPose& pose : poses) {
      phase += 0.00617;
      pose_puppet(puppet, std::array{std::cos(phase), std::sin(phase)}, pose);
    }
    const auto posed = Clock::now();
    renderer->begin_frame(side, side);
    for (std::size_t k = 0; k < kCount; ++k)
      renderer->draw_puppet(puppet, poses[k], *skin, places[k], scale);
    const auto drawn = Clock::now();
    renderer->end_frame();
    window->swap();
    const auto sent = Clock::now();
    renderer->wait();
    const auto done = Clock::now();
    const auto ms = [](auto span) {
      return std::chrono::duration<double, std::milli>(span).count();
    };
    posing += ms(posed - start), drawing += ms(drawn - posed);
    driver += ms(sent - drawn), waiting += ms(done - sent);
  };
  frame();  // everything has grown
  posing = drawing = driver = waiting = 0;
  for (auto _ : state) frame();
  const auto a_frame = benchmark::Counter::kAvgIterations;
  state.counters["pose"] = {posing, a_frame};
  state.counters["draw"] = {drawing, a_frame};
  state.counters["driver"] = {driver, a_frame};
  state.counters["finish"] = {waiting, a_frame};
  state.counters["batches"] = static_cast<double>(renderer->stats().batches);
  state.counters["puppets"] = static_cast<double>(renderer->stats().sprites);
}
BENCHMARK(DrawThousandWalkers)
    ->ArgNames({"height", "frame"})
    ->Args({4, 1})
    ->Args({16, 720})
    ->Args({32, 720})
    ->Args({64, 720})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
#endif

}  // namespace
}  // namespace vsprite
