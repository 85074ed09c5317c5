// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// What a puppet costs: posing it, drawing it, fitting it. One thread.
#include <benchmark/benchmark.h>

#include <cmath>

#include "puppet/art.h"
#include "vsprite/compose.h"
#include "vsprite/random.h"

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

}  // namespace
}  // namespace vsprite
