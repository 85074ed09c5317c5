// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "similarity/distance.h"

#include <gtest/gtest.h>

#include "support/creature.h"
#include "support/plain_distance.h"

namespace vsprite {
namespace {

constexpr Classifier kEven{{0.004, 0.3, 0.004, 0.01, 0.01, 0.002}, 1};

// Samples that follow no film: `paint(i, planes)` fills coverage, red, green, blue.
template <class Paint>
FeatureSet drawn(int count, int grid, Paint paint) {
  FeatureSet set;
  set.grid = grid;
  Random random{5};
  for (int i = 0; i < count; ++i) {
    std::vector<std::uint8_t> planes(static_cast<std::size_t>(4 * grid * grid), 0);
    paint(i, planes, random);
    FeatureSample s;
    s.speed = static_cast<float>(100 * random.unit());
    s.heading = static_cast<float>(2 * kPi * random.unit() - kPi);
    s.cells = testing::pack_cells(planes, grid);
    s.area = static_cast<float>(s.cells.coverage) / 255;
    for (float& c : s.mean_color) c = static_cast<float>(40 * random.unit());
    set.samples.push_back(std::move(s));
    set.rows.emplace_back();
  }
  testing::put_in_order(set);
  return set;
}

using Planes = std::vector<std::uint8_t>;

void noise(int, Planes& planes, Random& random) {
  for (std::uint8_t& p : planes) p = static_cast<std::uint8_t>(random.next());
}
void alike(int, Planes& planes, Random&) { std::fill(planes.begin(), planes.end(), 200); }
void one_cell(int i, Planes& planes, Random& random) {
  for (std::size_t k = 0; k < 4; ++k) {
    planes[(k * planes.size() / 4) + static_cast<std::size_t>(i) % (planes.size() / 4)] =
        static_cast<std::uint8_t>(random.next() | 1);
  }
}
void empty_or_full(int i, Planes& planes, Random&) {
  std::fill(planes.begin(), planes.end(),
            static_cast<std::uint8_t>(i % 3 == 0 ? 0 : 255 * (i % 2)));
  std::fill(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(planes.size() / 4),
            static_cast<std::uint8_t>(i % 3 == 0 ? 0 : 255));
}
void extreme(int i, Planes& planes, Random&) {  // the largest sums there are
  std::fill(planes.begin(), planes.end(), static_cast<std::uint8_t>(i % 2 == 0 ? 0 : 255));
  std::fill(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(planes.size() / 4), 255);
}

// Every block nearly of one colour: its mean says almost all, and rounds this way or that.
void nearly_flat(int, Planes& planes, Random& random) {
  const std::size_t plane = planes.size() / 4;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto level = static_cast<std::uint8_t>(k == 0 ? 250 : 100 + random.below(12));
    for (std::size_t c = 0; c < plane; ++c)
      planes[k * plane + c] = static_cast<std::uint8_t>(level + random.below(2));
  }
}

void expect_identical(const FeatureSet& set, const Classifier& classifier, float limit) {
  const auto plain = testing::plain_pairs(set, classifier, limit);
  EXPECT_EQ(accepted_pairs(set, classifier, 2, nullptr, {}, limit), plain);
  const auto targets = detail::kernel_targets();
  for (std::size_t k = 0; k < targets.size(); ++k) {
    detail::use_kernel_target(static_cast<int>(k));
    EXPECT_EQ(accepted_pairs(set, classifier, 1, nullptr, {}, limit), plain) << targets[k];
  }
  detail::use_kernel_target(-1);
}

class Adversary : public ::testing::TestWithParam<void (*)(int, Planes&, Random&)> {};

TEST_P(Adversary, GetsThePlainLoopsPairsOnEveryInstructionSet) {
  for (const int grid : {16, 24, 64}) {
    FeatureSet set = drawn(90, grid, GetParam());
    for (const FeatureScale scale : {FeatureScale::Raw, FeatureScale::PerArea}) {
      set.scale = scale;
      for (const float limit : {0.25f, 1.0f, 4.0f, 1e6f}) expect_identical(set, kEven, limit);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Distance, Adversary,
                         ::testing::Values(noise, alike, one_cell, empty_or_full, extreme,
                                           nearly_flat));

TEST(Distance, AcceptsExactlyWhatThePlainLoopAccepts) {
  FeatureSet set = testing::grown(testing::make_creature(160, 40), 640);
  const Classifier trained = train(set, bootstrap_labels(set, 400, 1), {})->classifier;
  ASSERT_GT(testing::plain_pairs(set, trained).size(), 1000u);
  expect_identical(set, trained, 1);
  expect_identical(set, trained, 1.5f);
}

TEST(Distance, HoldsWhereAWeightIsZero) {
  const FeatureSet set = drawn(60, 16, noise);
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    Classifier one{{}, 1};
    one.weights[k] = 1e-3;
    expect_identical(set, one, 1);
  }
  expect_identical(set, Classifier{{}, 1}, 1);
}

TEST(Distance, DoesWithoutPairs) {
  for (const int count : {0, 1, 2}) {
    const FeatureSet set = drawn(count, 16, alike);
    std::uint64_t compared = 1;
    EXPECT_LE(accepted_pairs(set, kEven, 1, &compared).size(), 1u);
    EXPECT_LE(compared, 1u);
  }
}

TEST(Distance, TilesInOrderAreAllPairsInOrder) {
  const FeatureSet set = drawn(1500, 16, one_cell);
  const PairFinder finder(set, kEven);
  ASSERT_GT(finder.tile_count(), 1);
  std::uint64_t considered = 0;
  for (int t = 0; t < finder.tile_count(); ++t) considered += finder.find(t).considered;
  EXPECT_EQ(considered, 1500u * 1499 / 2);
  int saved = 0, loaded = 0;
  std::vector<PairTile> kept(static_cast<std::size_t>(finder.tile_count()));
  TileStore store;
  store.save = [&](int t, const PairTile& tile) {
    kept[static_cast<std::size_t>(t)] = tile;
    ++saved;
  };
  const auto first = accepted_pairs(finder, 1, store);
  store.load = [&](int t, PairTile& tile) {
    tile = kept[static_cast<std::size_t>(t)];
    ++loaded;
    return true;
  };
  EXPECT_EQ(accepted_pairs(finder, 1, store), first);
  EXPECT_EQ(saved, finder.tile_count());
  EXPECT_EQ(loaded, finder.tile_count());
}

}  // namespace
}  // namespace vsprite
