// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/tiles.h"

#include <gtest/gtest.h>

#include <fstream>

#include "support/creature.h"
#include "support/temp_folder.h"
#include "tool/files.h"

namespace vsprite {
namespace {

constexpr Classifier kLoose{{0.004, 0.3, 0.004, 0.01, 0.01, 0.002}, 1};

// A search that is killed after some tiles goes on from them; a tile that was damaged, cut short or
// made by another search is made again.
TEST(Tiles, AKilledSearchGoesOnAndTakesNothingDamaged) {
  const testing::TempFolder folder;
  const FeatureSet set = testing::make_creature(2200, 100);
  const PairFinder finder(set, kLoose);
  ASSERT_GE(finder.tile_count(), 4);
  const TileStore store = keep_tiles(folder.path() + "/pairs", 7);
  for (int t = 0; t < 4; ++t) store.save(t, finder.find(t));
  const auto path = [&](int t) {
    return folder.path() + "/pairs/00000" + std::to_string(t) + ".bin";
  };
  std::string bytes = *read_file(path(1));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(path(1), std::ios::binary) << bytes;
  std::ofstream(path(2), std::ios::binary) << bytes.substr(0, bytes.size() - 5);

  PairTile tile;
  EXPECT_TRUE(store.load(0, tile));
  EXPECT_EQ(tile.pairs, finder.find(0).pairs);
  EXPECT_FALSE(store.load(1, tile));
  EXPECT_FALSE(store.load(2, tile));
  EXPECT_FALSE(keep_tiles(folder.path() + "/pairs", 8).load(3, tile));
  EXPECT_EQ(accepted_pairs(finder, 1, store), accepted_pairs(set, kLoose, 1));
  EXPECT_TRUE(store.load(2, tile));
}

TEST(Tiles, ForeseesWhatIsDue) {
  const FeatureSet set = testing::make_creature(2200, 100);
  const auto needs = foresee(PairFinder(set, kLoose), 2200);
  ASSERT_TRUE(needs);
  EXPECT_EQ(needs->substr(0, 16), "2 million pairs,") << *needs;
}

}  // namespace
}  // namespace vsprite
