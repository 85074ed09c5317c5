// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The tank's rules without a window: walls, food, score, rounds, pause, the same run twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "best.h"
#include "support/tiny_sprite.h"
#include "world.h"

namespace aquarium {
namespace {

using vsprite::Direction;
using vsprite::Sprite;
using vsprite::Vec2;

constexpr int kTicksPerSecond = 30;

/// A key that changes every half second to two and a half, among all ten commands.
class RandomKeys {
 public:
  explicit RandomKeys(std::uint64_t seed) : dice_{seed} {}
  Direction next() {
    if (left_-- <= 0) {
      left_ = 15 + dice_.below(60);
      held_ = static_cast<Direction>(dice_.below(vsprite::kDirectionCount));
    }
    return held_;
  }

 private:
  Random dice_;
  Direction held_ = Direction::Right;
  int left_ = 0;
};

float worst_overhang(const Sprite& sprite, const World& world) {
  float worst = 0;
  for (const Fish& fish : world.fish)
    worst = std::max(worst, overhang(room_of(fish), body_box(sprite, fish.actor)));
  return worst;
}

/// A round that has just begun, the player's fish in the middle.
World playing_world(const Sprite& sprite) {
  World world = make_world(sprite, 1, 2);
  step(sprite, world, {.direction = Direction::Right});
  world.flakes.clear();
  return world;
}

/// A flake that lies in the mouth of the player's fish.
Flake flake_at_mouth(const Sprite& sprite, const World& world) {
  Flake flake;
  flake.id = 900;
  flake.at = mouth_of(sprite, world.fish[0]);
  flake.column = flake.at.x;
  return flake;
}

TEST(Aquarium, NoFishLeavesTheTankInAnHourOfRandomKeys) {
  const Sprite sprite = vsprite::testing::tiny_sprite();
  World world = make_world(sprite, 5, 6);
  RandomKeys keys(17);
  constexpr int kTicks = 3600 * kTicksPerSecond;
  float worst = 0;
  int outside = 0;
  for (int t = 0; t < kTicks; ++t) {
    step(sprite, world, {.direction = keys.next(), .start = true});
    const float out = worst_overhang(sprite, world);
    worst = std::max(worst, out);
    outside += out > kSoftGlass * sprite.data().body_length + 1 ? 1 : 0;
  }
  EXPECT_LE(worst, sprite.data().body_length / 4);
  EXPECT_LT(outside, kTicks / 200) << "the fish should turn by itself, not be held back";
}

TEST(Aquarium, ThePlayersFishObeysAwayFromTheWalls) {
  const Sprite sprite = vsprite::testing::tiny_sprite();
  World world = make_world(sprite, 5, 2);
  RandomKeys keys(23);
  int roomy = 0;
  for (int t = 0; t < 600 * kTicksPerSecond; ++t) {
    const Fish& fish = world.fish[0];
    const Box body = body_box(sprite, fish.actor);
    const Box room = room_of(fish);
    const float way = 1.2f * sprite.data().body_length;
    const bool clear = body.left - room.left > way && room.right - body.right > way &&
                       body.top - room.top > way && room.bottom - body.bottom > way;
    const Direction wanted = keys.next();
    step(sprite, world, {.direction = wanted, .start = true});
    if (!clear) continue;
    ++roomy;
    ASSERT_EQ(world.fish[0].actor.direction, wanted) << "tick " << t;
  }
  EXPECT_GT(roomy, 1000);
}

/// Where a player who is after food steers, five times a second.
Direction towards_food(const Sprite& sprite, const World& world) {
  const Vec2 mouth = mouth_of(sprite, world.fish[0]);
  Vec2 way{0, 0};
  float least = 1e9f;
  for (const Flake& flake : world.flakes) {
    const Vec2 d{flake.at.x - mouth.x, flake.at.y - mouth.y};
    if (std::hypot(d.x, d.y) >= least) continue;
    least = std::hypot(d.x, d.y);
    way = d;
  }
  return least < 1e9f ? vsprite::nearest_direction(way) : Direction::Rest;
}

TEST(Aquarium, ThePlayerWhoFeedsIsOverruledInLessThanAFifthOfTheTicks) {
  const Sprite sprite = vsprite::testing::tiny_sprite();
  World world = make_world(sprite, 5);
  Direction held = Direction::Right;
  for (int t = 0; t < 1800 * kTicksPerSecond; ++t) {
    if (t % 6 == 0) held = towards_food(sprite, world);
    step(sprite, world, {.direction = held, .start = true});
  }
  const double share = double(world.refused_ticks) / world.steered_ticks;
  RecordProperty("overruled_percent", std::to_string(100 * share));
  EXPECT_GT(world.steered_ticks, 50000);
  EXPECT_LT(share, 0.2);
}

TEST(Aquarium, AFishThatIsDrivenAtAWallTurnsBeforeIt) {
  const Sprite sprite = vsprite::testing::tiny_sprite();
  World world = make_world(sprite, 5, 2);
  int refused = 0;
  for (int t = 0; t < 30 * kTicksPerSecond; ++t) {
    step(sprite, world, {.direction = Direction::Right});
    refused += world.fish[0].actor.direction != Direction::Right ? 1 : 0;
    const Fish& fish = world.fish[0];
    ASSERT_LE(overhang(room_of(fish), body_box(sprite, fish.actor)),
              kSoftGlass * sprite.data().body_length)
        << "tick " << t;
  }
  EXPECT_GT(refused, 100);
}

TEST(Aquarium, AFishWhoseKeyIsReleasedGlidesToAStop) {
  const Sprite sprite = vsprite::testing::tiny_sprite();
  World world = playing_world(sprite);
  for (int t = 0; t < 4; ++t) step(sprite, world, {.direction = Direction::Right});
  const auto way_of_a_tick = [&](Direction direction) {
    const Vec2 before = place_of(world.fish[0]);
    step(sprite, world, {.direction = direction});
    const Vec2 after = place_of(world.fish[0]);
    return std::hypot(after.x - before.x, after.y - before.y);
  };
  const float first = way_of_a_tick(Direction::Right);
  float last = first;
  for (int t = 0; t < 60; ++t) {
    const float now = way_of_a_tick(Direction::Rest);
    EXPECT_GT(now, 0.8f * last - 0.1f) << "tick " << t;
    last = now;
  }
  EXPECT_LT(last, 0.5f * first);
}

TEST(Aquarium, TheSameKeysGiveTheSameStates) {
  const Sprite sprite = vsprite::testing::tiny_sprite();
  const auto run = [&](std::uint64_t seed) {
    World world = make_world(sprite, seed);
    RandomKeys keys(3);
    std::vector<std::uint64_t> hashes;
    for (int t = 0; t < 90 * kTicksPerSecond; ++t) {
      step(sprite, world, {.direction = keys.next()});
      if (t % 100 == 0) hashes.push_back(states_hash(world));
    }
    return hashes;
  };
  EXPECT_EQ(run(11), run(11));
  EXPECT_NE(run(11), run(12));
}

TEST(Aquarium, NothingMovesWhilePaused) {
  const Sprite sprite = vsprite::testing::tiny_sprite();
  World world = playing_world(sprite);
  world.paused = true;
  const std::uint64_t before = states_hash(world);
  for (int t = 0; t < 50; ++t) step(sprite, world, {.direction = Direction::Up, .start = true});
  EXPECT_EQ(states_hash(world), before);
  EXPECT_TRUE(world.events.empty());
}

TEST(Aquarium, TheFirstKeyStartsTheRoundAndTheClockEndsIt) {
  const Sprite sprite = vsprite::testing::tiny_sprite();
  World world = make_world(sprite, 1);
  for (int t = 0; t < 100; ++t) step(sprite, world, {});
  EXPECT_EQ(world.phase, Phase::Ready);
  int ticks = 0;
  do {
    step(sprite, world, {.direction = Direction::Left});
    ++ticks;
  } while (world.phase == Phase::Playing && ticks < 10000);
  EXPECT_EQ(ticks, static_cast<int>(kRoundSeconds) * kTicksPerSecond);
  EXPECT_EQ(world.phase, Phase::Over);
  EXPECT_EQ(world.events.back().kind, EventKind::End);
  for (int t = 0; t < 100; ++t) step(sprite, world, {.direction = Direction::Left});
  EXPECT_EQ(world.phase, Phase::Over) << "a held key must not start the next round";
  step(sprite, world, {.start = true});
  EXPECT_EQ(world.phase, Phase::Playing);
  EXPECT_EQ(world.score, 0);
}

TEST(Aquarium, AFlakeAtTheMouthIsEatenAndOneBehindTheTailIsNot) {
  const Sprite sprite = vsprite::testing::tiny_sprite();
  World world = playing_world(sprite);
  Flake behind = flake_at_mouth(sprite, world);
  const Fish& fish = world.fish[0];
  behind.id = 901;
  behind.at.x -= 0.9f * sprite.data().body_length * fish.scale * fish.heading.x;
  behind.column = behind.at.x;
  world.flakes = {flake_at_mouth(sprite, world), behind};
  step(sprite, world, {.direction = Direction::Right});
  EXPECT_EQ(world.eaten, 1);
  EXPECT_EQ(world.score, 10);
  const bool kept = std::any_of(world.flakes.begin(), world.flakes.end(),
                                [](const Flake& flake) { return flake.id == 901; });
  EXPECT_TRUE(kept);
}

TEST(Aquarium, QuickCatchesCountMoreUpToFiveTimesAndAPauseStartsAnew) {
  const Sprite sprite = vsprite::testing::tiny_sprite();
  World world = playing_world(sprite);
  const auto catch_one = [&] {
    world.flakes = {flake_at_mouth(sprite, world)};
    const int before = world.score;
    step(sprite, world, {.direction = Direction::Rest});
    return world.score - before;
  };
  std::vector<int> points;
  for (int k = 0; k < 7; ++k) points.push_back(catch_one());
  EXPECT_EQ(points, (std::vector<int>{10, 20, 30, 40, 50, 50, 50}));
  for (int t = 0; t < 4 * kTicksPerSecond; ++t) {
    world.flakes.clear();
    step(sprite, world, {.direction = Direction::Rest});
  }
  EXPECT_EQ(catch_one(), 10);
}

TEST(Aquarium, FoodKeepsComingAndDissolvesOnTheGravel) {
  const Sprite sprite = vsprite::testing::tiny_sprite();
  World world = make_world(sprite, 3, 2);
  std::uint32_t newest = 0;
  for (int t = 0; t < static_cast<int>(kRoundSeconds) * kTicksPerSecond - 1; ++t) {
    step(sprite, world, {.direction = Direction::Up});
    for (const Flake& flake : world.flakes) {
      newest = std::max(newest, flake.id);
      EXPECT_GT(flake.at.x, 60.0f);
      EXPECT_LT(flake.at.x, kTankWidth - 60);
      EXPECT_LT(flake.at.y, kFloor);
    }
  }
  EXPECT_GT(newest, 25u);
}

TEST(Aquarium, ThePointerLeadsTheFishThere) {
  const Sprite sprite = vsprite::testing::tiny_sprite();
  World world = playing_world(sprite);
  const Vec2 target{900, 250};
  float nearest = 1e9f;
  for (int t = 0; t < 12 * kTicksPerSecond; ++t) {
    step(sprite, world, {.target = target});
    const Vec2 at = place_of(world.fish[0]);
    nearest = std::min(nearest, std::hypot(at.x - target.x, at.y - target.y));
  }
  EXPECT_LT(nearest, 0.4f * sprite.data().body_length * world.fish[0].scale);
}

TEST(Aquarium, OtherFishKeepAliveByThemselves) {
  const Sprite sprite = vsprite::testing::tiny_sprite();
  World world = make_world(sprite, 9, 4);
  std::vector<float> travelled(world.fish.size());
  for (int t = 0; t < 60 * kTicksPerSecond; ++t) {
    std::vector<Vec2> before;
    for (const Fish& fish : world.fish) before.push_back(place_of(fish));
    step(sprite, world, {});
    for (std::size_t k = 0; k < before.size(); ++k) {
      const Vec2 at = place_of(world.fish[k]);
      travelled[k] += std::hypot(at.x - before[k].x, at.y - before[k].y);
    }
  }
  for (std::size_t k = 0; k < travelled.size(); ++k) EXPECT_GT(travelled[k], 300) << "fish " << k;
}

TEST(BestScore, IsKeptWholeAndAnUnwritablePlaceIsNoError) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "aquarium_best_test";
  std::filesystem::remove_all(folder);
  const std::string path = (folder / "deep" / "aquarium.best").string();
  EXPECT_EQ(load_best_score(path), 0);
  save_best_score(path, 420);
  EXPECT_EQ(load_best_score(path), 420);
  std::ofstream(path) << "no number\n";
  EXPECT_EQ(load_best_score(path), 0);
  save_best_score("/proc/no/such/place", 7);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace aquarium
