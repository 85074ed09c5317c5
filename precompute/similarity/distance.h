// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// similarity/distance.h - every pair of samples that looks alike, exactly.
//
// N samples are N (N - 1) / 2 pairs. Because the weights are non-negative, D of a vector that is
// nowhere larger than the features is a lower bound of D, and a bound above the limit refuses the
// pair. In order of price: the four features without pixels, eight pairs at a time; coverage by
// squares of 8 x 8 cells, since |sum a_i - sum a_j| <= sum |a_i - a_j|; the mean colours of the
// most telling blocks, since a mean square is no smaller than the square of the mean; cells, the
// most telling blocks first, stopped as soon as the colour so far takes the pair too far. What is
// accepted, and its distance, is bit for bit what the plain loop gives, on every processor.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "similarity/classifier.h"
#include "similarity/features.h"
#include "similarity/kernels.h"

namespace vsprite {

/// An accepted pair, i < j, D <= limit.
struct PairDistance {
  std::uint32_t i = 0, j = 0;
  float distance = 0;
  friend bool operator==(const PairDistance&, const PairDistance&) = default;
};

/// What was found in some of the rows.
struct PairTile {
  std::vector<PairDistance> pairs;  ///< ascending by (i, j)
  std::uint64_t considered = 0;     ///< pairs of these rows
  std::uint64_t compared = 0;       ///< of these, pairs whose cells were looked at
};

/// Finds pairs tile by tile. A tile is a run of rows; tiles in order are all pairs in order. Any
/// number of threads may call find.
class PairFinder {
 public:
  /// `set` must outlive the finder and stay as it is. `limit` > 0, in units of D.
  PairFinder(const FeatureSet& set, const Classifier& classifier, float limit = 1);
  float limit() const noexcept { return limit_; }
  int tile_count() const noexcept { return static_cast<int>(first_row_.size()) - 1; }
  /// The rows of a tile; they depend on the number of samples alone.
  int first_row(int tile) const noexcept { return first_row_[static_cast<std::size_t>(tile)]; }
  PairTile find(int tile) const;
  /// Pairs (i, j) of one row, begin <= j < end, appended to `tile`; j may be below i.
  void find_row(int i, int begin, int end, PairTile& tile) const;

 private:
  const FeatureSet& set_;
  const Classifier& classifier_;
  float limit_;
  detail::PairTable table_;
  std::vector<int> first_row_;
};

/// Accepted pairs, ascending by (i, j): exactly those of the plain loop over all pairs.
/// `jobs`: threads, 0 = all; the result does not depend on it. `compared`: pairs whose pixels were
/// looked at. `progress`: share done, rising, one call at a time, from any thread.
std::vector<PairDistance> accepted_pairs(const FeatureSet& set, const Classifier& classifier,
                                         int jobs, std::uint64_t* compared = nullptr,
                                         const std::function<void(double)>& progress = {},
                                         float limit = 1);

/// Where tiles come from and go to, so that a search that was killed can go on. All may be empty.
struct TileStore {
  std::function<bool(int tile, PairTile&)> load;        ///< false: not there
  std::function<void(int tile, const PairTile&)> save;  ///< from any thread
};
std::vector<PairDistance> accepted_pairs(const PairFinder& finder, int jobs, const TileStore& store,
                                         std::uint64_t* compared = nullptr,
                                         const std::function<void(double)>& progress = {});

}  // namespace vsprite
