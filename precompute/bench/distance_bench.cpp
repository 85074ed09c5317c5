// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// distance_bench [--work=DIR] [--large=N] - all pairs: plain loop, strong loop, BLAS, numpy, scipy
// and ours, in one run on one thread where not said otherwise.
//
// DIR: a work folder whose stages `segment` and `train` have run; without one, a drawn creature.
// Pairs of the rivals are drawn from all pairs, the same for all. The growth from 5,000 samples to
// N is fitted and printed at the end.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <string>

#include "support/creature.h"
#include "support/plain_distance.h"
#include "tool/pictures.h"
#include "tool/project.h"
#ifdef VSPRITE_BENCH_BLAS
#include <cblas.h>
#endif

namespace vsprite {
namespace detail {
// strong_loop.cpp
void strong_sums(const float* a, const float* b, int plane, float& color, float& alpha);
}  // namespace detail
namespace {

constexpr std::size_t kDrawn = 20000;  // pairs that a rival is timed on
constexpr std::size_t kPool = 2000;  // samples that they are drawn from, as a loop would tile them

struct Subject {
  FeatureSet set;
  Classifier classifier;
  std::vector<std::vector<std::uint8_t>> dense;  // of the first kPool samples drawn
  std::vector<std::vector<float>> floats;
  std::vector<std::pair<int, int>> pairs;  // into the pool
  std::vector<int> pool;                   // samples
  std::map<std::size_t, FeatureSet> sized;
};
std::unique_ptr<Subject> subject;
std::map<std::size_t, double> seconds_at;

void load(const std::string& work) {
  subject = std::make_unique<Subject>();
  if (work.empty()) {
    subject->set = testing::make_creature(5000, 250, kDefaultGrid);
    subject->classifier =
        train(subject->set, bootstrap_labels(subject->set, 1000, 1), {})->classifier;
  } else {
    const auto project = Project::look(work);
    auto sprites = project ? load_sprites(*project) : Result<LoadedSprites>(project.error());
    const auto classifier = project ? project->classifier() : Result<Classifier>(project.error());
    if (!sprites || !classifier) {
      const Error& error = sprites ? classifier.error() : sprites.error();
      std::fprintf(stderr, "distance_bench: error: %s\n", error.message.c_str());
      std::exit(3);
    }
    subject->set = std::move(sprites->features);
    subject->classifier = *classifier;
  }
  Random random{3};
  const FeatureSet& set = subject->set;
  for (std::size_t k = 0; k < kPool; ++k) {
    subject->pool.push_back(static_cast<int>(random.below(set.samples.size())));
    subject->dense.push_back(testing::dense_cells(set, static_cast<std::size_t>(subject->pool[k])));
    subject->floats.emplace_back(subject->dense[k].begin(), subject->dense[k].end());
  }
  // 16 rows by 8 columns at a time, as a loop walks that keeps its tiles in cache.
  for (std::size_t n = 0; n < kDrawn; ++n) {
    subject->pairs.emplace_back(n / 8 % 16, 16 + (n % 8 + 8 * (n / 128)) % (kPool - 16));
  }
}

void report(benchmark::State& state, std::size_t pairs_each) {
  const auto pairs = static_cast<double>(state.iterations()) * static_cast<double>(pairs_each);
  state.counters["pairs/s"] = benchmark::Counter(pairs, benchmark::Counter::kIsRate);
  state.counters["ns/pair"] =
      benchmark::Counter(pairs / 1e9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

// The real feature as a float loop that the compiler may not reorder (PERFORMANCE: 2.5 us at 64).
void plain_float(benchmark::State& state) {
  const int plane = subject->set.grid * subject->set.grid;
  for (auto _ : state) {
    for (const auto& [i, j] : subject->pairs) {
      const float* a = subject->floats[static_cast<std::size_t>(i)].data();
      const float* b = subject->floats[static_cast<std::size_t>(j)].data();
      float color = 0, alpha = 0;
      for (int p = 0; p < plane; ++p) {
        const float r = a[p + plane] - b[p + plane], g = a[p + 2 * plane] - b[p + 2 * plane];
        const float u = a[p + 3 * plane] - b[p + 3 * plane];
        color += std::min(a[p], b[p]) * (r * r + g * g + u * u);
        alpha += std::fabs(a[p] - b[p]);
      }
      benchmark::DoNotOptimize(color);
      benchmark::DoNotOptimize(alpha);
    }
  }
  report(state, kDrawn);
}
BENCHMARK(plain_float)->Unit(benchmark::kMillisecond);

// The same sums in bytes and integers, which the compiler may vectorise.
void plain_integer(benchmark::State& state) {
  const int plane = subject->set.grid * subject->set.grid;
  for (auto _ : state) {
    for (const auto& [i, j] : subject->pairs) {
      auto sums = testing::plain_sums(subject->dense[static_cast<std::size_t>(i)].data(),
                                      subject->dense[static_cast<std::size_t>(j)].data(), plane);
      benchmark::DoNotOptimize(sums);
    }
  }
  report(state, kDrawn);
}
BENCHMARK(plain_integer)->Unit(benchmark::kMillisecond);

// The fair rival: float sums in any order, AVX2 and FMA allowed (strong_loop.cpp).
void strong_float(benchmark::State& state) {
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
    state.SkipWithError("this processor has no AVX2 and FMA");
    return;
  }
  const int plane = subject->set.grid * subject->set.grid;
  for (auto _ : state) {
    for (const auto& [i, j] : subject->pairs) {
      float color = 0, alpha = 0;
      detail::strong_sums(subject->floats[static_cast<std::size_t>(i)].data(),
                          subject->floats[static_cast<std::size_t>(j)].data(), plane, color, alpha);
      benchmark::DoNotOptimize(color);
      benchmark::DoNotOptimize(alpha);
    }
  }
  report(state, kDrawn);
}
BENCHMARK(strong_float)->Unit(benchmark::kMillisecond);

// What a matrix product can do: |c_i - c_j|^2 unweighted, through the identity. Another feature.
void blas_unweighted(benchmark::State& state) {
#ifdef VSPRITE_BENCH_BLAS
  const int width = 3 * subject->set.grid * subject->set.grid, rows = 1000;
  std::vector<float> matrix, product(static_cast<std::size_t>(rows) * rows);
  for (int i = 0; i < rows; ++i) {
    const auto& f = subject->floats[static_cast<std::size_t>(i)];
    matrix.insert(matrix.end(), f.begin() + width / 3, f.end());
  }
  openblas_set_num_threads(1);
  for (auto _ : state) {
    cblas_ssyrk(CblasRowMajor, CblasUpper, CblasNoTrans, rows, width, 1, matrix.data(), width, 0,
                product.data(), rows);
    benchmark::DoNotOptimize(product.data());
  }
  report(state, static_cast<std::size_t>(rows) * (rows - 1) / 2);
#else
  state.SkipWithError("built without OpenBLAS (libopenblas-dev)");
#endif
}
BENCHMARK(blas_unweighted)->Unit(benchmark::kMillisecond);

// What scripts do: python3 with numpy or scipy, where they are there. `code` prints seconds for
// `pairs` unordered pairs of pictures of `p` values in one colour plane.
void python(benchmark::State& state, const char* code, std::size_t pairs) {
  const int plane = subject->set.grid * subject->set.grid;
  const std::string command =
      "PATH=/usr/bin:$PATH OPENBLAS_NUM_THREADS=1 python3 -c 'p=" + std::to_string(plane) + "\n" +
      code + "' 2>/dev/null";
  for (auto _ : state) {
    double seconds = 0;
    std::FILE* pipe = ::popen(command.c_str(), "r");
    const bool read = pipe && std::fscanf(pipe, "%lf", &seconds) == 1;
    if (pipe) ::pclose(pipe);
    if (!read) {
      state.SkipWithError("no python3 with numpy and scipy here");
      return;
    }
    state.SetIterationTime(seconds);
  }
  report(state, pairs);
}

// |c_i - c_j|^2 unweighted, float64, as scipy does it; another feature, both triangles.
void scipy_cdist(benchmark::State& state) {
  python(state,
         "import numpy as n, time\nfrom scipy.spatial.distance import cdist\n"
         "x=n.random.RandomState(1).rand(400,3*p)\nt=time.perf_counter()\n"
         "cdist(x,x,\"sqeuclidean\")\nprint(time.perf_counter()-t)",
         400 * 399 / 2);
}
BENCHMARK(scipy_cdist)->UseManualTime()->Unit(benchmark::kMillisecond);

// The real feature, by broadcasting, one triangle.
void numpy_broadcast(benchmark::State& state) {
  python(state,
         "import numpy as n, time\nr=n.random.RandomState(1)\n"
         "a=r.rand(200,p).astype(n.float32)\nc=r.rand(200,3,p).astype(n.float32)\n"
         "t=time.perf_counter()\n"
         "for i in range(199):\n"
         "  w=n.minimum(a[i],a[i+1:]); d=c[i]-c[i+1:]\n"
         "  (w*(d*d).sum(1)).sum(1); n.abs(a[i]-a[i+1:]).sum(1)\n"
         "print(time.perf_counter()-t)",
         200 * 199 / 2);
}
BENCHMARK(numpy_broadcast)->UseManualTime()->Unit(benchmark::kMillisecond);

// Ours without bounds: both pixel features of every pair, exact, by each instruction set.
void kernel(benchmark::State& state) {
  const auto targets = detail::kernel_targets();
  const auto k = static_cast<std::size_t>(state.range(0));
  if (k >= targets.size()) {
    state.SkipWithError("no such instruction set here");
    return;
  }
  detail::use_kernel_target(static_cast<int>(k));
  state.SetLabel(targets[k]);
  for (auto _ : state) {
    for (const auto& [i, j] : subject->pairs) {
      const auto at = [&](int n) -> const CellImage& {
        return subject->set
            .samples[static_cast<std::size_t>(subject->pool[static_cast<std::size_t>(n)])]
            .cells;
      };
      auto sums = detail::compare_cells(at(i), at(j));
      benchmark::DoNotOptimize(sums);
    }
  }
  detail::use_kernel_target(-1);
  report(state, kDrawn);
}
BENCHMARK(kernel)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);

double peak_mb() {
  struct rusage usage {};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

const FeatureSet& sized(std::size_t count) {
  if (count == subject->set.samples.size()) return subject->set;
  auto& sets = subject->sized;
  if (!sets.contains(count)) {
    sets.clear();  // one at a time: memory is a figure here
    sets.emplace(count, testing::grown(subject->set, count));
  }
  return sets.at(count);
}

// End to end: bounds and kernels, the accepted set. range: samples, threads.
void all_pairs(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const FeatureSet& set = sized(count);
  const std::size_t all = count * (count - 1) / 2;
  std::uint64_t compared = 0;
  std::size_t accepted = 0;
  double fastest = 1e9;
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    accepted = accepted_pairs(set, subject->classifier, static_cast<int>(state.range(1)), &compared)
                   .size();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    fastest = std::min(fastest, took.count());
  }
  if (state.range(1) == 1) seconds_at[count] = fastest;
  report(state, all);
  state.counters["compared%"] = 100 * static_cast<double>(compared) / static_cast<double>(all);
  state.counters["accepted%"] = 100 * static_cast<double>(accepted) / static_cast<double>(all);
  state.counters["peak_MB"] = peak_mb();
}

}  // namespace
}  // namespace vsprite

int main(int argc, char** argv) {
  std::string work;
  std::int64_t large = 30000;
  int kept = 1;
  for (int n = 1; n < argc; ++n) {
    if (std::strncmp(argv[n], "--work=", 7) == 0) {
      work = argv[n] + 7;
    } else if (std::strncmp(argv[n], "--large=", 8) == 0) {
      large = std::atoll(argv[n] + 8);
    } else {
      argv[kept++] = argv[n];
    }
  }
  argc = kept;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  vsprite::load(work);
  benchmark::AddCustomContext("kernels", vsprite::detail::kernel_target());
  const auto own = static_cast<std::int64_t>(vsprite::subject->set.samples.size());
  for (const std::int64_t count : {own, std::int64_t{5000}, std::int64_t{10000}, large}) {
    if (count > large) continue;
    for (const std::int64_t threads : {1, 2}) {
      benchmark::RegisterBenchmark("all_pairs", vsprite::all_pairs)
          ->ArgNames({"samples", "threads"})
          ->Args({count, threads})
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    }
    if (count == own && own == 5000) continue;
  }
  benchmark::RunSpecifiedBenchmarks();
  const auto& at = vsprite::seconds_at;
  if (at.contains(5000) && at.contains(static_cast<std::size_t>(large)) && large > 5000) {
    const double growth = std::log(at.at(static_cast<std::size_t>(large)) / at.at(5000)) /
                          std::log(static_cast<double>(large) / 5000);
    std::printf("growth: time ~ N^%.2f from 5000 to %lld samples\n", growth,
                static_cast<long long>(large));
  }
  return 0;
}
