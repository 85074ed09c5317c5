// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/replay.h"

#include <gtest/gtest.h>

#include <cstring>
#include <deque>
#include <random>

#include "support/naive_actions.h"
#include "support/pack_bytes.h"
#include "vsprite/action.h"

namespace vsprite {
namespace {

using Kind = ReplayCommand::Kind;

const Sprite& acting_sprite() {
  static const Sprite sprite = *make_sprite(testing::acting_sprite_data());
  return sprite;
}

bool equal(const Actor& a, const Actor& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// Anything that a game may do.
ReplayCommand random_command(std::mt19937& random, std::uint32_t actors) {
  const auto number = [&] { return static_cast<float>(static_cast<int>(random() % 400) - 200); };
  ReplayCommand command;
  command.actor = static_cast<std::uint32_t>(random() % actors);
  command.kind = static_cast<Kind>(random() % 10);
  command.direction = static_cast<Direction>(random() % 10);
  command.hold = random() % 2 != 0;
  command.action = static_cast<std::uint16_t>(random() % 6);
  command.within = static_cast<int>(random() % 10) - 1;
  command.vector = {number(), number()};
  command.number = 5;
  if (command.kind == Kind::Scale) command.vector = {0.5f, 2};
  return command;
}

std::vector<Actor> make_crowd(const Sprite& sprite, int count) {
  std::vector<Actor> actors;
  for (int k = 0; k < count; ++k)
    actors.push_back(
        make_actor(sprite, {static_cast<float>(k), 7}, static_cast<unsigned>(k), k % 2));
  return actors;
}

Replay record(const Sprite& sprite, int ticks, std::uint32_t seed, std::vector<Actor>& actors) {
  std::mt19937 random(seed);
  ReplayRecorder recorder(sprite, actors);
  for (int t = 0; t < ticks; ++t) {
    for (auto k = random() % 3; k > 0; --k)
      recorder.command(sprite, actors,
                       random_command(random, static_cast<std::uint32_t>(actors.size())));
    step(sprite, actors);
    recorder.tick(actors);
  }
  return recorder.replay();
}

TEST(Replay, MakesTheSameRunAgain) {
  const Sprite& sprite = acting_sprite();
  std::vector<Actor> actors = make_crowd(sprite, 5), again;
  const Replay replay = record(sprite, 3000, 1, actors);
  EXPECT_FALSE(run_replay(sprite, replay, again));
  ASSERT_EQ(again.size(), actors.size());
  for (std::size_t k = 0; k < actors.size(); ++k) EXPECT_TRUE(equal(actors[k], again[k]));
}

TEST(Replay, AnHourComesThroughItsFile) {
  const Sprite& sprite = acting_sprite();
  const testing::TempFolder folder;
  std::vector<Actor> actors = make_crowd(sprite, 1), again;
  const Replay replay = record(sprite, 108000, 2, actors);
  ASSERT_TRUE(save_replay(folder.file("hour.vsr"), replay));
  const auto loaded = load_replay(folder.file("hour.vsr"), sprite);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->hashes, replay.hashes);
  EXPECT_EQ(loaded->commands.size(), replay.commands.size());
  EXPECT_FALSE(run_replay(sprite, *loaded, again));
  EXPECT_TRUE(equal(actors[0], again[0]));
}

// Actions, owners and both modes; the value changes only with what an actor does.
TEST(Replay, AnHourIsTheSameByEveryCompiler) {
  const Sprite& sprite = acting_sprite();
  std::vector<Actor> actors = make_crowd(sprite, 2);
  const Replay replay = record(sprite, 108000, 42, actors);
  std::uint64_t all = 0;
  for (const std::uint64_t hash : replay.hashes) all = (all << 7 | all >> 57) ^ hash;
  EXPECT_EQ(all, 10205774456930189796u);
}

TEST(Replay, NamesTheTickAtWhichItWentAnotherWay) {
  const Sprite& sprite = acting_sprite();
  std::vector<Actor> actors = make_crowd(sprite, 3), again;
  Replay replay = record(sprite, 500, 3, actors);
  ReplayCommand extra{.tick = 217, .actor = 1, .kind = Kind::Play, .action = 5, .within = 0};
  replay.commands.insert(
      std::upper_bound(replay.commands.begin(), replay.commands.end(), extra,
                       [](const auto& a, const auto& b) { return a.tick < b.tick; }),
      extra);
  const auto divergence = run_replay(sprite, replay, again);
  ASSERT_TRUE(divergence);
  EXPECT_EQ(divergence->tick, 218u);
  EXPECT_EQ(divergence->recorded, replay.hashes[217]);
  EXPECT_NE(divergence->found, divergence->recorded);
}

// Two machines: each does its own commands at once and hears of the other's up to nine ticks later,
// goes back to its copy of that tick, and steps forward again. In the end both are in the same
// state.
TEST(Replay, RollingBackToACopyBringsTwoMachinesTogether) {
  const Sprite& sprite = acting_sprite();
  struct Machine {
    std::vector<Actor> actors;
    std::deque<std::vector<Actor>> past;  // before tick t - k
    std::vector<ReplayCommand> known;
  };
  constexpr std::uint64_t kTicks = 1500, kDelay = 9;
  std::vector<Actor> truth = make_crowd(sprite, 2);
  Machine machines[2] = {{truth, {}, {}}, {truth, {}, {}}};
  std::mt19937 random(4);
  std::vector<ReplayCommand> all;
  for (std::uint64_t t = 0; t < kTicks; ++t)
    for (std::uint32_t who = 0; who < 2; ++who) {
      if (random() % 4 != 0) continue;
      all.push_back(random_command(random, 1));
      all.back().tick = t;
      all.back().actor = who;
    }
  const auto advance = [&](std::vector<Actor>& actors, const std::vector<ReplayCommand>& known,
                           std::uint64_t tick) {
    for (std::uint32_t who = 0; who < 2; ++who)
      for (const ReplayCommand& c : known)
        if (c.tick == tick && c.actor == who) apply(sprite, actors[who], c);
    step(sprite, actors);
  };
  for (std::uint64_t t = 0; t < kTicks + kDelay; ++t) {
    for (std::uint32_t m = 0; m < 2; ++m) {
      Machine& machine = machines[m];
      std::uint64_t from = t;
      for (const ReplayCommand& c : all) {
        const bool now = c.tick == t && c.actor == m;
        const bool late = c.tick + kDelay == t && c.actor != m;
        if (now || late) machine.known.push_back(c);
        if (late) from = c.tick;
      }
      if (from < t) machine.actors = machine.past[machine.past.size() - (t - from)];
      for (std::uint64_t again = from; again <= t; ++again) {
        if (again == t) machine.past.push_back(machine.actors);
        if (again < t) machine.past[machine.past.size() - (t - again)] = machine.actors;
        advance(machine.actors, machine.known, again);
      }
      if (machine.past.size() > kDelay) machine.past.pop_front();
    }
    advance(truth, all, t);
  }
  for (std::size_t k = 0; k < 2; ++k)
    for (const Machine& machine : machines) EXPECT_TRUE(equal(machine.actors[k], truth[k]));
}

TEST(Replay, EveryCutOffAndEveryFlippedBitOfAFileIsRefused) {
  const Sprite& sprite = acting_sprite();
  const testing::TempFolder folder;
  std::vector<Actor> actors = make_crowd(sprite, 2);
  ASSERT_TRUE(save_replay(folder.file("a.vsr"), record(sprite, 12, 5, actors)));
  const testing::ByteVector good = testing::read_bytes(folder.file("a.vsr"));
  const auto refuses = [&](const testing::ByteVector& bytes) {
    testing::write_bytes(folder.file("b.vsr"), bytes);
    return !load_replay(folder.file("b.vsr"), sprite);
  };
  EXPECT_FALSE(refuses(good));
  for (std::size_t size = 0; size < good.size(); size += 3)
    EXPECT_TRUE(refuses({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)})) << size;
  for (std::size_t bit = 0; bit < 8 * good.size(); bit += 5) {
    testing::ByteVector bytes = good;
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ 1u << bit % 8);
    EXPECT_TRUE(refuses(bytes)) << bit;
  }
}

TEST(Replay, NoStateThatIsCalledValidFaults) {
  const Sprite& sprite = acting_sprite();
  std::mt19937 random(6);
  std::vector<Actor> actors = make_crowd(sprite, 1);
  int valid = 0;
  for (int trial = 0; trial < 200000; ++trial) {
    Actor actor = actors[0];
    if (trial % 50 == 0) apply(sprite, actors[0], random_command(random, 1)), step(sprite, actors);
    for (auto k = random() % 3; k > 0; --k) {
      auto* bytes = reinterpret_cast<unsigned char*>(&actor);
      bytes[random() % sizeof actor] = static_cast<unsigned char>(random() % 8);
    }
    if (!is_valid(sprite, actor)) continue;
    ++valid;
    for (int t = 0; t < 20; ++t) {
      step(sprite, actor);
      ASSERT_TRUE(is_valid(sprite, actor)) << trial;
    }
  }
  EXPECT_GT(valid, 10000);
}

TEST(Replay, OfAnotherPackIsRefusedOrFoundOut) {
  const testing::TempFolder folder;
  std::vector<Actor> actors = make_crowd(acting_sprite(), 1);
  play(acting_sprite(), actors[0], 5, 3);
  ASSERT_TRUE(save_replay(folder.file("a.vsr"), record(acting_sprite(), 50, 8, actors)));
  const auto loaded = load_replay(folder.file("a.vsr"), testing::tiny_sprite());
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().code, ErrorCode::CorruptData);
  EXPECT_EQ(load_replay(folder.file("none.vsr"), acting_sprite()).error().code,
            ErrorCode::NotFound);
}

}  // namespace
}  // namespace vsprite
