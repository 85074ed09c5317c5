// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// All pairs by bounds and integer kernels, over tiles whose size does not depend on the threads.
#include "similarity/distance.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <mutex>

namespace vsprite {
namespace {

constexpr int kTileRows = 32;  // samples i of a tile
constexpr int kTileColumns =
    256;  // samples j looked at together, so that their blocks stay in cache

constexpr int kMaxBands = 64 / kBlock;

// Lower bounds of the difference in coverage, one for each band (a row of blocks), and which bands
// show anything at all.
struct Bands {
  std::array<std::uint32_t, kMaxBands> bound{};
  std::array<bool, kMaxBands> empty{};
  std::uint32_t sum = 0;
};

Bands bound_bands(const FeatureSample& a, const FeatureSample& b, std::size_t bands) noexcept {
  Bands result;
  for (std::size_t band = 0; band < bands; ++band) {
    std::uint32_t bound = 0, seen = 0;
    for (std::size_t k = band * bands; k < (band + 1) * bands; ++k) {
      bound += static_cast<std::uint32_t>(std::abs(a.block_alpha[k] - b.block_alpha[k]));
      seen |= static_cast<std::uint32_t>(a.block_alpha[k]) | b.block_alpha[k];
    }
    result.bound[band] = bound;
    result.empty[band] = seen == 0;
    result.sum += bound;
  }
  return result;
}

// One pair, the cheapest bound first. `f` holds lower bounds that are replaced by the features.
class PairTest {
 public:
  PairTest(const FeatureSet& set, const Classifier& classifier)
      : set_(set), classifier_(classifier), plane_(set.grid * set.grid) {
    // From the middle outward: that is where the subject is, and so where it differs.
    const int bands = set.grid / kBlock;
    for (int k = 0; k < bands; ++k) {
      order_.push_back(bands / 2 + (k % 2 == 0 ? k / 2 : -(k + 1) / 2));
    }
  }

  // True if accepted, with its distance; `compared` counts pairs whose cells were looked at.
  bool accept(int i, int j, float& distance, std::uint64_t& compared) const noexcept {
    FeatureVector f = cheap_features(set_, i, j);
    if (refused(f)) return false;
    const FeatureSample& a = set_.samples[static_cast<std::size_t>(i)];
    const FeatureSample& b = set_.samples[static_cast<std::size_t>(j)];
    const Bands bands = bound_bands(a, b, order_.size());
    f[kAlpha] = detail::alpha_feature(bands.sum);
    if (refused(f)) return false;
    ++compared;
    std::uint32_t alpha = bands.sum;
    std::uint64_t color = 0;
    for (const int band : order_) {
      const auto k = static_cast<std::size_t>(band);
      if (bands.empty[k]) continue;
      const int first = band * kBlock * set_.grid;
      alpha += detail::alpha_difference(a.planes.data() + first, b.planes.data() + first,
                                        kBlock * set_.grid) -
               bands.bound[k];
      color += detail::color_difference(a.planes.data(), b.planes.data(), plane_, first, set_.grid,
                                        kBlock);
      f[kAlpha] = detail::alpha_feature(alpha);
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
  std::vector<int> order_;  // of the bands
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
