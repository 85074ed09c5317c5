// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/response.h"

#include <gtest/gtest.h>

namespace vsprite {
namespace {

TEST(Response, CommandsWithoutATableGoToTheBetterNeighbourOrToRest) {
  std::array<DirectionReport, kCompassCount> reports{};
  for (std::size_t d = 0; d < kCompassCount; ++d) reports[d].direction = static_cast<Direction>(d);
  reports[0].reachable = reports[2].reachable = true;
  reports[0].tracking_error_deg = 9;
  reports[2].tracking_error_deg = 4;
  const ServedDirections served = serve_directions(reports);
  EXPECT_EQ(served.served, 5u);
  EXPECT_EQ(served.table_of[0], Direction::Right);
  EXPECT_EQ(served.table_of[1], Direction::Down);
  EXPECT_EQ(served.table_of[7], Direction::Right);
  EXPECT_EQ(served.table_of[4], Direction::Rest);
  EXPECT_EQ(served.table_of[8], Direction::None);
}

TEST(Response, RandomScriptsAreReproducibleAndAlwaysChange) {
  const KeyScript a = random_script(60, 1.5, 4, 30, 2), b = random_script(60, 1.5, 4, 30, 2);
  ASSERT_EQ(a.entries.size(), b.entries.size());
  for (std::size_t k = 0; k + 1 < a.entries.size(); ++k) {
    EXPECT_EQ(a.entries[k].tick, b.entries[k].tick);
    EXPECT_NE(a.entries[k].direction, a.entries[k + 1].direction);
    EXPECT_GE(a.entries[k + 1].tick - a.entries[k].tick, 44u);
  }
}

}  // namespace
}  // namespace vsprite
