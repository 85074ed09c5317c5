// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// All pairs by bounds and integer kernels, over tiles whose size does not depend on the threads.
#include "similarity/distance.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>

namespace vsprite {
namespace {

constexpr int kTileRows = 32;  // samples i of a tile
constexpr int kTileColumns =
    256;  // samples j looked at together, so that their blocks stay in cache

std::uint32_t block_difference(const std::vector<std::uint16_t>& a,
                               const std::vector<std::uint16_t>& b) noexcept {
  std::uint32_t sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    sum += static_cast<std::uint32_t>(std::abs(a[k] - b[k]));
  }
  return sum;
}

// One pair, the cheapest bound first. `f` holds lower bounds that are replaced by the features.
class PairTest {
 public:
  PairTest(const FeatureSet& set, const Classifier& classifier)
      : set_(set), classifier_(classifier), plane_(set.grid * set.grid) {}

  // True if accepted, with its distance; `compared` counts pairs whose cells were looked at.
  bool accept(int i, int j, float& distance, std::uint64_t& compared) const noexcept {
    FeatureVector f = cheap_features(set_, i, j);
    if (refused(f)) return false;
    const FeatureSample& a = set_.samples[static_cast<std::size_t>(i)];
    const FeatureSample& b = set_.samples[static_cast<std::size_t>(j)];
    f[kAlpha] = detail::alpha_feature(block_difference(a.block_alpha, b.block_alpha));
    if (refused(f)) return false;
    ++compared;
    const std::uint32_t alpha = detail::alpha_difference(a.planes.data(), b.planes.data(), plane_);
    f[kAlpha] = detail::alpha_feature(alpha);
    if (refused(f)) return false;
    std::uint64_t color = 0;
    for (int y = 0; y < set_.grid; y += kBlock) {
      color += detail::color_difference(a.planes.data(), b.planes.data(), plane_, y * set_.grid,
                                        set_.grid, kBlock);
      f[kColor] = detail::color_feature(color);
      if (refused(f)) return false;
    }
    distance = classifier_.distance(f);
    return true;
  }

 private:
  bool refused(const FeatureVector& lower_bound) const noexcept {
    return classifier_.distance(lower_bound) > 1.0f;
  }

  const FeatureSet& set_;
  const Classifier& classifier_;
  int plane_;
};

struct Tile {
  std::vector<PairDistance> pairs;
  std::uint64_t compared = 0;
};

Tile compare_tile(const PairTest& test, int first, int count) {
  const int last = std::min(first + kTileRows, count);
  std::vector<std::vector<PairDistance>> rows(kTileRows);
  Tile tile;
  for (int column = first; column < count; column += kTileColumns) {
    const int end = std::min(column + kTileColumns, count);
    for (int i = first; i < last; ++i) {
      for (int j = std::max(i + 1, column); j < end; ++j) {
        float distance = 0;
        if (test.accept(i, j, distance, tile.compared)) {
          rows[static_cast<std::size_t>(i - first)].push_back(
              {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), distance});
        }
      }
    }
  }
  for (const auto& row : rows) tile.pairs.insert(tile.pairs.end(), row.begin(), row.end());
  return tile;
}

}  // namespace

std::vector<PairDistance> accepted_pairs(const FeatureSet& set, const Classifier& classifier,
                                         int jobs, std::uint64_t* compared,
                                         const std::function<void(double)>& progress) {
  const int count = static_cast<int>(set.samples.size());
  const int tile_count = (count + kTileRows - 1) / kTileRows;
  const PairTest test(set, classifier);
  std::vector<Tile> tiles(static_cast<std::size_t>(tile_count));
  std::mutex progress_mutex;
  std::uint64_t done = 0;
  tbb::task_arena arena(jobs > 0 ? jobs : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(0, tile_count, [&](int t) {
      const int first = t * kTileRows;
      tiles[static_cast<std::size_t>(t)] = compare_tile(test, first, count);
      if (!progress) return;
      const std::scoped_lock lock(progress_mutex);
      done += static_cast<std::uint64_t>(count - first);
      const auto total =
          static_cast<std::uint64_t>(tile_count) *
          (2 * static_cast<std::uint64_t>(count) -
           static_cast<std::uint64_t>(kTileRows) * static_cast<std::uint64_t>(tile_count - 1)) /
          2;
      progress(static_cast<double>(done) / static_cast<double>(total));
    });
  });
  std::vector<PairDistance> pairs;
  std::uint64_t looked_at = 0;
  for (const Tile& tile : tiles) {
    pairs.insert(pairs.end(), tile.pairs.begin(), tile.pairs.end());
    looked_at += tile.compared;
  }
  if (compared) *compared = looked_at;
  return pairs;
}

}  // namespace vsprite
