// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// All pairs by bounds and integer kernels, over tiles whose size does not depend on the threads.
#include "similarity/distance.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

namespace vsprite {
namespace {

constexpr std::uint64_t kTilePairs = 1 << 19;  // a tile has about as many, or a 512th of all
constexpr int kRowsTogether = 32;              // rows that share a part of the columns in cache
constexpr float kMargin = 2e-5f;               // over the rounding of float bounds, relative
constexpr std::size_t kMeanBlocks = 32;        // blocks whose means bound the colour; at most 64
constexpr double kLeastWeight = 1e-150;        // keeps a quotient finite

detail::PairTable make_table(const FeatureSet& set, const Classifier& classifier, float limit) {
  detail::PairTable table;
  const auto weight = [&](Feature f) {
    return static_cast<float>(classifier.weights[f] / classifier.threshold);
  };
  table.per_area = set.scale == FeatureScale::PerArea;
  table.speed_weight = weight(kSpeed), table.angle_weight = weight(kAngle);
  table.area_weight = weight(kArea), table.mean_weight = weight(kMeanColor);
  const double unit = table.per_area ? 1 : 255;
  table.alpha_weight = static_cast<float>(classifier.weights[kAlpha] / classifier.threshold / unit);
  table.color_weight =
      std::max(kColorStep * classifier.weights[kColor] / classifier.threshold / std::sqrt(unit),
               kLeastWeight);
  table.fade = static_cast<float>(set.v0);
  table.limit = limit * (1 + kMargin);
  const int squares = set.grid / 8 * (set.grid / 8);
  table.coarse_size = static_cast<std::size_t>((squares + 31) / 32 * 32);
  for (const FeatureSample& s : set.samples) {
    table.speed.push_back(s.speed), table.angle.push_back(s.heading);
    table.area.push_back(s.area), table.red.push_back(s.mean_color[0]);
    table.green.push_back(s.mean_color[1]), table.blue.push_back(s.mean_color[2]);
    table.coverage.push_back(static_cast<float>(s.cells.coverage));
    table.cells.push_back(&s.cells);
    auto coarse = coarse_coverage(s.cells, set.block_order, set.grid);
    const auto means = block_means(s.cells, kMeanBlocks);
    table.mean_size = means.size();
    table.means.insert(table.means.end(), means.begin(), means.end());
    coarse.resize(table.coarse_size, 0);
    table.coarse.insert(table.coarse.end(), coarse.begin(), coarse.end());
  }
  for (auto* column :
       {&table.speed, &table.angle, &table.area, &table.red, &table.green, &table.blue}) {
    column->resize(column->size() + detail::PairTable::kPadding, 0);
  }
  return table;
}

std::vector<int> make_tiles(std::size_t samples) {
  const auto n = static_cast<std::uint64_t>(samples);
  const std::uint64_t all = n * (n - (n > 0)) / 2, size = std::max(kTilePairs, all / 512);
  std::vector<int> first_row{0};
  std::uint64_t pairs = 0;
  for (std::uint64_t i = 0; i < n; ++i) {
    pairs += n - 1 - i;
    if (pairs < size && i + 1 < n) continue;
    first_row.push_back(static_cast<int>(i) + 1);
    pairs = 0;
  }
  if (first_row.size() == 1) first_row.push_back(0);
  return first_row;
}

}  // namespace

PairFinder::PairFinder(const FeatureSet& set, const Classifier& classifier, float limit)
    : set_(set),
      classifier_(classifier),
      limit_(limit),
      table_(make_table(set, classifier, limit)),
      first_row_(make_tiles(set.samples.size())) {}

void PairFinder::find_row(int i, int begin, int end, PairTile& tile) const {
  std::array<detail::Candidate, detail::kRowPart> candidates;
  const auto row = static_cast<std::size_t>(i);
  for (auto from = static_cast<std::size_t>(begin); from < static_cast<std::size_t>(end);
       from += detail::kRowPart) {
    const std::size_t to = std::min(from + detail::kRowPart, static_cast<std::size_t>(end));
    const std::size_t count =
        detail::filter_row(table_, row, from, to, candidates.data(), tile.compared);
    for (std::size_t n = 0; n < count; ++n) {
      const auto& [j, sums] = candidates[n];
      const int column = static_cast<int>(j);
      FeatureVector f = cheap_features(set_, i, column);
      const std::uint32_t coverage =
          set_.samples[row].cells.coverage + set_.samples[j].cells.coverage;
      detail::set_pixel_features(set_, i, column, sums.color, coverage - 2 * sums.overlap, f);
      const float distance = classifier_.distance(f);
      if (distance <= limit_) tile.pairs.push_back({static_cast<std::uint32_t>(i), j, distance});
    }
  }
}

PairTile PairFinder::find(int tile) const {
  const int count = static_cast<int>(set_.samples.size()), end = first_row(tile + 1);
  PairTile result;
  std::array<PairTile, kRowsTogether> rows;
  for (int first = first_row(tile); first < end; first += kRowsTogether) {
    const int last = std::min(first + kRowsTogether, end);
    for (PairTile& row : rows) row.pairs.clear();
    for (int from = first + 1; from < count; from += static_cast<int>(detail::kRowPart)) {
      const int to = std::min(from + static_cast<int>(detail::kRowPart), count);
      for (int i = first; i < last; ++i) {
        find_row(i, std::max(from, i + 1), to, rows[static_cast<std::size_t>(i - first)]);
      }
    }
    for (int i = first; i < last; ++i) {
      const auto& found = rows[static_cast<std::size_t>(i - first)].pairs;
      result.pairs.insert(result.pairs.end(), found.begin(), found.end());
      result.considered += static_cast<std::uint64_t>(count - 1 - i);
    }
  }
  for (const PairTile& row : rows) result.compared += row.compared;
  return result;
}

std::vector<PairDistance> accepted_pairs(const PairFinder& finder, int jobs, const TileStore& store,
                                         std::uint64_t* compared,
                                         const std::function<void(double)>& progress) {
  std::vector<PairTile> tiles(static_cast<std::size_t>(finder.tile_count()));
  std::mutex progress_mutex;
  int done = 0;
  tbb::task_arena arena(jobs > 0 ? jobs : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<int>(0, finder.tile_count(), 1), [&](const auto& range) {
      for (int t = range.begin(); t < range.end(); ++t) {
        PairTile& tile = tiles[static_cast<std::size_t>(t)];
        if (!store.load || !store.load(t, tile)) {
          tile = finder.find(t);
          if (store.save) store.save(t, tile);
        }
        if (!progress) continue;
        const std::scoped_lock lock(progress_mutex);
        progress(static_cast<double>(++done) / finder.tile_count());
      }
    });
  });
  std::size_t total = 0;
  for (const PairTile& tile : tiles) total += tile.pairs.size();
  std::vector<PairDistance> pairs;
  pairs.reserve(total);
  std::uint64_t looked_at = 0;
  for (PairTile& tile : tiles) {
    pairs.insert(pairs.end(), tile.pairs.begin(), tile.pairs.end());
    looked_at += tile.compared;
    tile = {};
  }
  if (compared) *compared = looked_at;
  return pairs;
}

std::vector<PairDistance> accepted_pairs(const FeatureSet& set, const Classifier& classifier,
                                         int jobs, std::uint64_t* compared,
                                         const std::function<void(double)>& progress, float limit) {
  return accepted_pairs(PairFinder(set, classifier, limit), jobs, {}, compared, progress);
}

}  // namespace vsprite
