// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/spread.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>

#include "control/joint.h"
#include "support/processes.h"
#include "support/random_film.h"

namespace vsprite {
namespace {

using testing::Processes;
using testing::RandomFilm;

constexpr double kV0 = 20;

using Solve = std::function<Result<Solution>(const Spread&)>;

// +inf stands in rows that were not kept; nothing may differ by a bit.
template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), sizeof(T) * a.size()) == 0;
}

// Any number of processes gives what one alone does, and the others hold their own blocks' tables.
void expect_same(const Solve& solve, std::size_t headings) {
  const auto alone = solve({});
  ASSERT_TRUE(alone) << alone.error().message;
  const std::size_t block = alone->values.size() / (headings + 2) * 8;
  for (std::size_t count = 1; count <= 6; ++count) {
    std::vector<Result<Solution>> parts(count, Error{});
    Processes(count).run([&](const Spread& spread) { parts[spread.rank] = solve(spread); });
    for (const auto& part : parts) ASSERT_TRUE(part) << part.error().message;
    const Solution& whole = *parts[0];
    EXPECT_TRUE(same_bytes(whole.values, alone->values)) << count;
    EXPECT_TRUE(same_bytes(whole.mode.next, alone->mode.next)) << count;
    EXPECT_TRUE(same_bytes(whole.mode.go, alone->mode.go)) << count;
    EXPECT_EQ(whole.mode.arrived, alone->mode.arrived) << count;
    EXPECT_EQ(whole.mode.residual, alone->mode.residual) << count;
    EXPECT_EQ(whole.mode.error_bound, alone->mode.error_bound) << count;
    for (std::size_t rank = 1; rank < count; ++rank) {
      const std::size_t most = (headings / 8 + 1 - rank + count - 1) / count;  // own blocks
      EXPECT_LE(parts[rank]->values.size(), rank > headings / 8 ? 0 : most * block) << count;
    }
  }
}

TEST(Spread, ModePaperIsTheSameForAnyNumberOfProcesses) {
  const RandomFilm film(50, 3);
  for (const int headings : {8, 16, 32}) {
    for (const bool iterate : {false, true}) {
      const SolveConfig config{
          .cap = 1, .free_steps = headings == 32 ? 6 : 2, .headings = headings, .iterate = iterate};
      expect_same(
          [&](const Spread& spread) {
            return solve(film.costs, film.velocities, kV0, config, 2, spread);
          },
          static_cast<std::size_t>(headings));
    }
  }
}

TEST(Spread, ModeResponsiveIsTheSameForAnyNumberOfProcesses) {
  const RandomFilm film(50, 4);
  const Motion motion{film.velocities, film.skip_costs, kV0};
  for (const int headings : {8, 16, 32}) {
    for (const double rho : {0.0, 0.03}) {
      const JointConfig config{
          .cap = 0.9, .change_rate = rho, .play_through = true, .headings = headings};
      const std::uint32_t served = headings == 8 ? 0xFDu : 0xFFFFDFF7u >> (32 - headings);
      expect_same(
          [&](const Spread& spread) {
            return solve_joint(film.costs, motion, config, served, 2, spread);
          },
          static_cast<std::size_t>(headings));
    }
  }
}

TEST(Spread, TheTablesOfOtherProcessesGoToTheFirstOnce) {
  const RandomFilm film(30, 5);
  Processes three(3);
  three.run([&](const Spread& spread) {
    (void)solve(film.costs, film.velocities, kV0, {.headings = 32}, 1, spread);
  });
  // Of the blocks 0..4 process 1 has 1 and 4 (none and rest, two groups), process 2 has 2: each
  // group 6 tables of 31 samples, three numbers each, and each block a residual.
  EXPECT_EQ(three.gathered(), std::size_t{8 + 8 + 2} * 6 * 31 * 12 + 3 * 8);
}

TEST(Spread, AnErrorIsEverybodys) {
  RandomFilm film(30, 6);
  film.costs.transitions[3].cost = -1;
  std::vector<Result<Solution>> parts(3, Error{});
  Processes(3).run([&](const Spread& spread) {
    parts[spread.rank] = solve(film.costs, film.velocities, kV0, {}, 1, spread);
  });
  for (const auto& part : parts) {
    ASSERT_FALSE(part);
    EXPECT_EQ(part.error().code, ErrorCode::BadContent);
  }
}

}  // namespace
}  // namespace vsprite
