// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/tiles.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "support/creature.h"
#include "support/temp_folder.h"
#include "tool/files.h"
#include "vsprite/random.h"

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

// A process that is killed outright, again and again, loses at most the tiles it was working on.
TEST(Tiles, KilledOutrightTenTimesTheSearchEndsInTheSamePairs) {
  const testing::TempFolder folder;
  const FeatureSet set = testing::make_creature(3000, 100);
  const PairFinder finder(set, kLoose);
  const TileStore store = keep_tiles(folder.path() + "/pairs", 7);
  Random random{4};
  int struck = 0;
  for (int kill_number = 0; kill_number < 10; ++kill_number) {
    const pid_t child = ::fork();
    if (child == 0) {
      PairTile tile;
      for (;;)  // a tile is taken away again, so that there always is one to write
        for (int t = 0; t < finder.tile_count(); ++t) {
          if (!store.load(t, tile)) store.save(t, finder.find(t));
          if (t % 3 == 2) std::remove((folder.path() + "/pairs/000001.bin").c_str());
        }
    }
    ::usleep(static_cast<useconds_t>(2000 + random.below(20000)));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    struck += WIFSIGNALED(status) ? 1 : 0;
  }
  EXPECT_EQ(struck, 10);
  EXPECT_EQ(accepted_pairs(finder, 1, store), accepted_pairs(set, kLoose, 1));
}

TEST(Tiles, AHundredThousandSamplesSayFirstWhatTheyNeed) {
  FeatureSet set = testing::make_creature(1000, 100);
  for (int i = 1000; i < 100000; ++i) {
    set.samples.push_back(set.samples[static_cast<std::size_t>(i % 1000)]);
    set.rows.push_back(set.rows[static_cast<std::size_t>(i % 1000)]);
  }
  const auto needs = foresee(PairFinder(set, kLoose), 100000);
  const std::string said = needs ? *needs : needs.error().message;
  EXPECT_EQ(said.substr(0, 19), "5000 million pairs,") << said;
  EXPECT_NE(said.find(" s on one core and "), std::string::npos) << said;
  EXPECT_NE(said.find(" GB of memory"), std::string::npos) << said;
}

TEST(Tiles, ForeseesWhatIsDue) {
  const FeatureSet set = testing::make_creature(2200, 100);
  const auto needs = foresee(PairFinder(set, kLoose), 2200);
  ASSERT_TRUE(needs);
  EXPECT_EQ(needs->substr(0, 16), "2 million pairs,") << *needs;
}

}  // namespace
}  // namespace vsprite
