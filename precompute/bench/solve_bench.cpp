// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// DESIGN P3: eight directions solved, against plain value iteration and NumPy on the same graph.
//
// The graph: clips of 250 samples whose heading and pose drift, each with its own continuation and
// 99 jumps to samples of like heading and pose. Ours is exact; plain iteration and NumPy stop at
// the largest change of 0.05 (1 - alpha), and of their sweeps, which all take the same time, the
// first hundred (ten) are made. Arguments: thousands of samples, alpha in thousandths.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numeric>

#include "control/joint.h"
#include "control/lanes.h"
#include "support/dense_control.h"
#include "vsprite/random.h"

namespace vsprite {
namespace {

constexpr double kV0 = 0.35, kWeight = 0.6;
constexpr std::uint32_t kClip = 250, kRow = 100;

struct Graph {
  CostTable costs;
  std::vector<Vec2> velocities;
  std::vector<float> skip_costs;
};

Graph make_graph(std::uint32_t n) {
  Random random{n};
  std::vector<double> heading(n), pose(n);
  Graph graph;
  for (std::uint32_t i = 0; i < n; ++i) {
    const bool cut = i % kClip == 0;
    heading[i] = cut ? 6.283 * random.unit() : heading[i - 1] + 0.16 * (random.unit() - 0.5);
    heading[i] -= 6.2831853 * std::floor(heading[i] / 6.2831853);
    pose[i] = cut ? random.unit() : pose[i - 1] + 0.08 + 0.02 * random.unit();
    pose[i] -= std::floor(pose[i]);
    graph.velocities.push_back(
        {static_cast<float>(std::cos(heading[i])), static_cast<float>(std::sin(heading[i]))});
    graph.skip_costs.push_back(
        i + 2 < n && i % kClip + 2 < kClip ? 0.6f : std::numeric_limits<float>::infinity());
  }
  // Candidates: the 400 nearest in heading and as many at random; the best 99 of them.
  std::vector<std::uint32_t> order(n), rank(n);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return heading[a] < heading[b]; });
  for (std::uint32_t k = 0; k < n; ++k) rank[order[k]] = k;
  graph.costs.row_start.assign(1, 0);
  graph.costs.kept.assign(n, 1);
  for (std::uint32_t i = 0; i < n; ++i) {
    std::vector<std::pair<float, std::uint32_t>> found;
    for (std::uint32_t k = 0; k < 800; ++k) {
      const std::uint32_t j = k < 400 ? order[(rank[i] + n + k - 200) % n]
                                      : static_cast<std::uint32_t>(random.below(n));
      if (j <= i && i - j < 15) continue;
      const double turn = std::fabs(heading[i] - heading[j]);
      const double step = std::fabs(pose[i] + 0.09 - pose[j]);
      const double t = 0.25 + 0.5 * std::min(turn, 6.2831853 - turn) + std::min(step, 1 - step);
      found.push_back({static_cast<float>(t), j});
    }
    std::sort(found.begin(), found.end());
    std::map<std::uint32_t, float> row;
    if (i % kClip + 1 < kClip && i + 1 < n) row[i + 1] = 0;
    for (const auto& [t, j] : found) {
      if (row.size() >= kRow) break;
      row.emplace(j, t);
    }
    for (const auto& [j, t] : row) graph.costs.transitions.push_back({j, t});
    graph.costs.row_start.push_back(static_cast<std::uint32_t>(graph.costs.transitions.size()));
  }
  return graph;
}

const Graph& graph_of(std::int64_t thousands) {
  static std::map<std::int64_t, Graph> graphs;
  auto found = graphs.find(thousands);
  if (found == graphs.end()) {
    const auto n = static_cast<std::uint32_t>(1000 * thousands);
    found = graphs.emplace(thousands, make_graph(n)).first;
  }
  return found->second;
}

LaneFloats arrivals(const Graph& graph) {
  LaneFloats out;
  for (const Vec2& v : graph.velocities) {
    for (int d = 0; d < kCompassCount; ++d)
      out.push_back(static_cast<float>(kWeight * heading_cost(v, kV0, d, kCompassCount)));
  }
  return out;
}

// What the rivals do as well: eight directions, V. One thread.
void BM_EightDirections(benchmark::State& state) {
  const Graph& graph = graph_of(state.range(0));
  const Edges edges = make_edges(graph.costs, {}, {.cap = 10});
  Lanes lanes;
  lanes.discount = static_cast<double>(state.range(1)) / 1000;
  lanes.arrive = arrivals(graph);
  for (auto _ : state) {
    start(edges, lanes);
    solve_lanes(edges, lanes);
    benchmark::DoNotOptimize(lanes.values.data());
  }
}

// Everything that `vsprite solve` does for mode "paper": ten groups, the chain of K = 5, next, cost
// to go and the certificate.
void BM_ModePaper(benchmark::State& state) {
  const Graph& graph = graph_of(state.range(0));
  const SolveConfig config{
      .alpha = static_cast<double>(state.range(1)) / 1000, .w1 = kWeight, .cap = 10};
  double bound = 0;
  for (auto _ : state)
    bound = solve(graph.costs, graph.velocities, kV0, config, 1)->mode.error_bound;
  state.counters["error_bound"] = bound;
}

void BM_ModeResponsive(benchmark::State& state) {
  const Graph& graph = graph_of(state.range(0));
  const JointConfig config{.alpha = static_cast<double>(state.range(1)) / 1000, .cap = 10};
  double bound = 0;
  for (auto _ : state) {
    const auto solution =
        solve_joint(graph.costs, {graph.velocities, graph.skip_costs, kV0}, config, 0xFF, 1);
    bound = solution->mode.error_bound;
  }
  state.counters["error_bound"] = bound;
}

// The plain loop on eight directions: at most kMostSweeps sweeps of each are made, and the time of
// those that are missing is added.
struct PlainRun {
  double sweeps = 0, seconds = 0;  // of all eight directions
};
constexpr int kMostSweeps = 100, kNumPySweeps = 10;

const PlainRun& plain_run(std::int64_t thousands, std::int64_t alpha) {
  static std::map<std::pair<std::int64_t, std::int64_t>, PlainRun> runs;
  const auto [found, is_new] = runs.try_emplace({thousands, alpha});
  PlainRun& run = found->second;
  if (!is_new) return run;
  const Graph& graph = graph_of(thousands);
  const LaneFloats all = arrivals(graph);
  std::vector<float> values, arrive(graph.velocities.size());
  for (std::size_t d = 0; d < kLanes; ++d) {
    for (std::size_t j = 0; j < arrive.size(); ++j) arrive[j] = all[j * kLanes + d];
    const auto begin = std::chrono::steady_clock::now();
    const double sweeps = testing::plain_iteration(
        graph.costs, arrive, static_cast<float>(alpha) / 1000, values, kMostSweeps);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    run.sweeps += sweeps;
    run.seconds += spent.count() * sweeps / std::min(sweeps, double{kMostSweeps});
  }
  return run;
}

void BM_PlainIteration(benchmark::State& state) {
  for (auto _ : state) state.SetIterationTime(plain_run(state.range(0), state.range(1)).seconds);
  state.counters["sweeps"] = plain_run(state.range(0), state.range(1)).sweeps / kLanes;
}

// The same loop in NumPy (CSR, minimum.reduceat): a few sweeps of every direction are timed, as
// many as the plain loop needs are charged. Skipped where python3 has no NumPy.
void BM_NumPy(benchmark::State& state) {
  const Graph& graph = graph_of(state.range(0));
  const char* kFile = "solve_bench.graph";
  std::ofstream file(kFile, std::ios::binary);
  const auto write = [&](const auto& values) {
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(values[0])));
  };
  write(graph.costs.row_start);
  write(graph.costs.transitions);
  write(arrivals(graph));
  file.close();
  const std::string script =
      "import numpy as np,time\n"
      "n=" +
      std::to_string(graph.velocities.size()) + ";a=np.float32(" +
      std::to_string(static_cast<double>(state.range(1)) / 1000) +
      ")\n"
      "f=open('solve_bench.graph','rb')\n"
      "r=np.fromfile(f,np.uint32,n+1);m=int(r[-1])\n"
      "e=np.fromfile(f,np.dtype([('to',np.uint32),('t',np.float32)]),m)\n"
      "c=np.fromfile(f,np.float32).reshape(n,8);to=e['to'].astype(np.int64);t=e['t'].copy()\n"
      "s=r[:-1].astype(np.int64);begin=time.time()\n"
      "for d in range(8):\n"
      "  v=np.zeros(n,np.float32);cost=t+c[to,d]\n"
      "  for k in range(" +
      std::to_string(kNumPySweeps) +
      "):\n"
      "    w=np.minimum.reduceat(cost+a*v[to],s);change=np.abs(w-v).max();v=w\n"
      "print(time.time()-begin)\n";
  std::ofstream("solve_bench.py") << script;
  for (auto _ : state) {
    double seconds = 0;
    std::FILE* pipe = ::popen("/usr/bin/python3 solve_bench.py 2>/dev/null", "r");
    const bool ran = pipe != nullptr && std::fscanf(pipe, "%lf", &seconds) == 1;
    if (pipe != nullptr) ::pclose(pipe);
    if (!ran) {
      state.SkipWithError("python3 with NumPy is not there");
      break;
    }
    const double sweeps = plain_run(state.range(0), state.range(1)).sweeps / kLanes;
    state.SetIterationTime(seconds * sweeps / kNumPySweeps);
  }
  std::remove(kFile);
  std::remove("solve_bench.py");
}

void sizes(benchmark::internal::Benchmark* b) {
  for (const int n : {5, 15, 50}) {
    for (const int alpha : {970, 990, 999}) b->Args({n, alpha});
  }
  b->Unit(benchmark::kMillisecond)->MinTime(0.2);
}
BENCHMARK(BM_EightDirections)->Apply(sizes);
BENCHMARK(BM_ModePaper)->Apply(sizes);
BENCHMARK(BM_ModeResponsive)
    ->Args({5, 985})
    ->Args({15, 985})
    ->Args({15, 970})
    ->Unit(benchmark::kMillisecond);
void rivals(benchmark::internal::Benchmark* b) {
  for (const int n : {5, 15, 50}) {
    for (const int alpha : {970, 990, 999}) b->Args({n, alpha});
  }
  b->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK(BM_PlainIteration)->Apply(rivals);
BENCHMARK(BM_NumPy)->Apply(rivals);

}  // namespace
}  // namespace vsprite
