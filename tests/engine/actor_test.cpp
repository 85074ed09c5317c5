// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/actor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "support/plain_actor.h"
#include "support/tiny_sprite.h"
#include "vsprite/policy.h"

namespace vsprite {
namespace {

using testing::tiny_heading;
using testing::tiny_sample;

TEST(Actor, StartsAtTheStartSampleWithoutACommand) {
  const Sprite sprite = testing::tiny_sprite();
  const Actor actor = make_actor(sprite, {3.5f, -2}, 9);
  EXPECT_EQ(actor.position, to_position({3.5f, -2}));
  EXPECT_EQ(actor.sample, 1u);
  EXPECT_EQ(actor.direction, Direction::None);
  EXPECT_EQ(actor.table, 8 * testing::kTinyStages);
  EXPECT_EQ(actor.shown, 1);
  EXPECT_EQ(actor.random, 9u);
}

TEST(Actor, NaturalPlaybackReproducesTheFilmedDisplacement) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite);
  // 11 samples of the first clip, one of them shown for two ticks: 12 ticks of 2 px.
  for (int tick = 0; tick < 12; ++tick) {
    step(sprite, actor);
    EXPECT_EQ(actor.jumped, 0);
    EXPECT_EQ(actor.position.x, (tick + 1) * 2 * kFixedOne);
  }
  EXPECT_EQ(actor.sample, tiny_sample(0, 11));
}

TEST(Actor, ASampleIsShownForItsDuration) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite);
  std::vector<std::uint32_t> shown;
  for (int tick = 0; tick < 5; ++tick) {
    step(sprite, actor);
    shown.push_back(actor.sample);
  }
  EXPECT_EQ(shown, (std::vector<std::uint32_t>{2, 3, 3, 4, 5}));  // sample 3 lasts two ticks
}

TEST(Actor, MovesByTheSampleThatWasShownSoThatDrawingNeverJumps) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite);
  std::mt19937 random(3);
  for (int tick = 0; tick < 2000; ++tick) {
    set_direction(sprite, actor, static_cast<Direction>(random() % kDirectionCount));
    const Vec2 before = draw_position(sprite, actor, 1.0f);
    step(sprite, actor);
    const Vec2 after = draw_position(sprite, actor, 0.0f);
    ASSERT_NEAR(before.x, after.x, 1e-3);
    ASSERT_NEAR(before.y, after.y, 1e-3);
  }
}

TEST(Actor, EntersTheSwitchingChainAtKAndLeavesItOneStageASample) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite);
  set_direction(sprite, actor, Direction::Down);
  EXPECT_EQ(actor.stage, 3);
  for (unsigned due : {3u, 2u, 2u, 1u, 0u, 0u, 0u}) {  // the third tick is the second of a long sample
    step(sprite, actor);
    EXPECT_EQ(actor.table, 2 * testing::kTinyStages + due) << "tick " << actor.tick;
  }
}

TEST(Actor, TheSameCommandAgainRestartsNothing) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite), other = actor;
  set_direction(sprite, actor, Direction::LeftUp);
  set_direction(sprite, other, Direction::LeftUp);
  for (int tick = 0; tick < 100; ++tick) {
    set_direction(sprite, actor, Direction::LeftUp);
    step(sprite, actor);
    step(sprite, other);
    ASSERT_EQ(std::memcmp(&actor, &other, sizeof actor), 0);
  }
}

TEST(Actor, TwoCommandsThatFollowTheSameTablesRestartNothing) {
  SpriteData data = testing::tiny_sprite_data();
  data.modes[0].table_of[2] = Direction::RightDown;  // Down is not served
  const Sprite sprite = *make_sprite(std::move(data));
  Actor actor = make_actor(sprite);
  set_direction(sprite, actor, Direction::RightDown);
  step(sprite, actor);
  step(sprite, actor);
  const int stage = actor.stage;
  set_direction(sprite, actor, Direction::Down);
  EXPECT_EQ(actor.direction, Direction::Down);
  EXPECT_EQ(actor.stage, stage);
}

TEST(Actor, ReachesEveryHeadingAndHoldsIt) {
  const Sprite sprite = testing::tiny_sprite();
  for (int mode = 0; mode < 2; ++mode) {
    for (int d = 0; d < kCompassCount; ++d) {
      Actor actor = make_actor(sprite, {}, 0, mode);
      set_direction(sprite, actor, static_cast<Direction>(d));
      for (int tick = 0; tick < 30; ++tick) step(sprite, actor);
      for (int tick = 0; tick < 60; ++tick) {
        step(sprite, actor);
        ASSERT_EQ(tiny_heading(actor.sample), d) << "mode " << mode;
      }
    }
    Actor actor = make_actor(sprite, {}, 0, mode);
    set_direction(sprite, actor, Direction::Rest);
    for (int tick = 0; tick < 60; ++tick) step(sprite, actor);
    EXPECT_EQ(tiny_heading(actor.sample), -1);
  }
}

TEST(Actor, TurnsUntilTheSampleGoesTheCommandedWayThenCruises) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite, {}, 0, 1);
  set_direction(sprite, actor, Direction::Left);
  EXPECT_EQ(actor.stage, 1);
  for (int tick = 0; tick < 30; ++tick) {
    const std::uint8_t before = actor.stage;
    step(sprite, actor);
    if (actor.shown == 1) {
      EXPECT_EQ(actor.table, 4 * 2 + before);
    }
    const bool turned = tiny_heading(actor.sample) == 4;
    EXPECT_EQ(actor.stage, before == 1 && !turned ? 1 : 0) << "tick " << tick;
  }
  EXPECT_EQ(actor.stage, 0);
}

// The feet do not slide: where a sample is left out, its displacement comes with the next tick's.
TEST(Actor, ASampleLeftOutStillMovesTheActor) {
  SpriteData data = testing::tiny_sprite_data();
  ControlMode& mode = data.modes[1];
  mode.bend_cos = kUnitOne, mode.bend_sin = 0;
  for (std::size_t table = 0; table < mode.tables(); ++table) {
    mode.next[table * testing::kTinySamples + tiny_sample(0, 1)] = tiny_sample(0, 3);
  }
  const Sprite sprite = *make_sprite(std::move(data));
  Actor actor = make_actor(sprite, {}, 0, 1);
  actor.sample = tiny_sample(0, 1);
  step(sprite, actor);
  EXPECT_EQ(actor.sample, tiny_sample(0, 3));
  EXPECT_EQ(actor.skipped, 1);
  EXPECT_EQ(actor.jumped, 1);
  EXPECT_FLOAT_EQ(shown_cost(sprite, tiny_sample(0, 1), actor), 0.2f);
  EXPECT_EQ(actor.position.x, 2 * kFixedOne);
  step(sprite, actor);  // its own 2 px and the two ticks of sample 2
  EXPECT_EQ(actor.position.x, 8 * kFixedOne);
  EXPECT_EQ(actor.skipped, 0);
}

TEST(Actor, BendsThePathTowardsTheCommandByFifteenDegreesAtMost) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite, {}, 0, 1);
  const auto move = [&](int heading, Direction command) {
    Actor trial = actor;
    trial.sample = tiny_sample(heading, 0);
    trial.bent = static_cast<std::uint8_t>(command);
    step(sprite, trial);
    const double x = static_cast<double>(trial.position.x),
                 y = static_cast<double>(trial.position.y);
    EXPECT_NEAR(std::hypot(x, y) / kFixedOne, 2, 1e-4);
    return std::atan2(y, x) * 180 / 3.14159265358979;
  };
  EXPECT_NEAR(move(0, Direction::Right), 0, 1e-3);
  EXPECT_NEAR(move(0, Direction::RightDown), 15, 1e-3);
  EXPECT_NEAR(move(0, Direction::RightUp), -15, 1e-3);
  EXPECT_NEAR(move(1, Direction::Right), 30, 1e-3);
  EXPECT_NEAR(std::fabs(move(0, Direction::Left)), 15, 1e-3);
  EXPECT_NEAR(move(2, Direction::Rest), 90, 1e-3);
}

TEST(Actor, AStickChoosesTheNearestServedHeadingAndDoesNotDither) {
  SpriteData data = testing::tiny_sprite_data();
  data.modes[1].served = data.modes[1].served_headings = 0x11;  // a side view: right and left
  const Sprite sprite = *make_sprite(std::move(data));
  Actor actor = make_actor(sprite, {}, 0, 1);
  const auto aim = [&](double degrees) {
    const double a = degrees * 3.14159265358979 / 180;
    set_heading(sprite, actor,
                {static_cast<float>(3 * std::cos(a)), static_cast<float>(3 * std::sin(a))});
    return actor.direction;
  };
  EXPECT_EQ(aim(10), Direction::Right);
  EXPECT_EQ(aim(59), Direction::Right);
  EXPECT_EQ(aim(90), Direction::Rest);
  EXPECT_EQ(aim(150), Direction::Left);
  set_heading(sprite, actor, {});
  EXPECT_EQ(actor.direction, Direction::None);
  set_heading(sprite, actor, {std::nanf(""), 1});
  EXPECT_EQ(actor.direction, Direction::None);
}

TEST(Actor, NearTiesAreDrawnFromTheSeedAndKeepTheCommand) {
  const Sprite sprite = testing::tiny_sprite();
  const StepWish wish{.slack = 0.35f};
  const auto run = [&](std::uint64_t seed) {
    Actor actor = make_actor(sprite, {}, seed);
    set_direction(sprite, actor, Direction::Down);
    StateHash hash;
    for (int tick = 0; tick < 600; ++tick) {
      const std::uint32_t before = actor.sample;
      step(sprite, actor, wish);
      EXPECT_TRUE(actor.shown > 1 || std::isfinite(sprite.transition_cost(before, actor.sample)));
      hash.add(actor);
    }
    const Vec2 at = to_pixels(actor.position);
    EXPECT_GT(at.y, 700);
    EXPECT_LT(std::fabs(at.x), 300);
    return hash.digest();
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
  Actor plain = make_actor(sprite), none = plain;
  for (int tick = 0; tick < 300; ++tick) {
    step(sprite, plain);
    step(sprite, none, StepWish{});
    ASSERT_EQ(std::memcmp(&plain, &none, sizeof plain), 0) << "no slack, no difference";
  }
}

TEST(Actor, OfNearTiesTheOneWithMostRoomIsTaken) {
  const Sprite sprite = testing::tiny_sprite();
  // No command: every heading is as good as another. The wall lies to the right.
  const StepWish wish{.slack = 1, .clearance = [](const void*, Vec2 p) { return -p.x; }};
  Actor actor = make_actor(sprite);
  for (int tick = 0; tick < 200; ++tick) step(sprite, actor, wish);
  EXPECT_LT(to_pixels(actor.position).x, -100);
}

// Two loops to the right, of 30 and 90 px/s; from every sample one may change to the other.
SpriteData two_paces() {
  SpriteData data;
  data.name = "two paces";
  constexpr std::uint32_t kLoop = 12;
  data.row_start.assign(1, 0);
  ControlMode mode;
  mode.name = "paper";
  mode.alpha = 0.9f;
  mode.cap = 1;
  for (std::uint32_t i = 0; i < 2 * kLoop; ++i) {
    Sample s;
    s.velocity = {i < kLoop ? 30.0f : 90.0f, 0};
    s.step_x = step_per_tick(s.velocity.x, 30, 1);
    s.clip = i / kLoop;
    s.kept = 1;
    data.samples.push_back(s);
    const std::uint32_t own = i / kLoop * kLoop, after = (i + 1) % kLoop;
    std::vector<Transition> row{{own + after, after == 0 ? 0.1f : 0.0f},
                                {kLoop - own + after, 0.15f}};
    std::sort(row.begin(), row.end(), [](auto& a, auto& b) { return a.to < b.to; });
    data.transitions.insert(data.transitions.end(), row.begin(), row.end());
    data.row_start.push_back(static_cast<std::uint32_t>(data.transitions.size()));
  }
  for (std::size_t k = 0; k < mode.tables() * 2 * kLoop; ++k) {
    const auto i = static_cast<std::uint32_t>(k % (2 * kLoop));
    mode.next.push_back(i / kLoop * kLoop + (i + 1) % kLoop);
  }
  mode.go.assign(mode.next.size(), 1);
  data.modes.push_back(mode);
  return data;
}

TEST(Actor, ThePaceIsPreferredWhereTheFilmLeavesAChoice) {
  const Sprite sprite = *make_sprite(two_paces());
  for (const Pace pace : {Pace::Slow, Pace::Fast}) {
    for (const std::uint32_t start : {3u, 15u}) {
      Actor actor = make_actor(sprite);
      actor.sample = start;
      for (int tick = 0; tick < 100; ++tick) step(sprite, actor, {.slack = 0.2f, .pace = pace});
      EXPECT_EQ(actor.sample >= 12, pace == Pace::Fast) << "from " << start;
      actor.sample = start;
      for (int tick = 0; tick < 100; ++tick) step(sprite, actor, {.slack = 0, .pace = pace});
      EXPECT_EQ(actor.sample >= 12, start >= 12) << "without slack";
    }
  }
}

TEST(Actor, JumpedTellsEveryTransitionThatIsNotTheFilmsOwn) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite);
  std::mt19937 random(11);
  int jumps = 0;
  for (int tick = 0; tick < 3000; ++tick) {
    if (tick % 40 == 0) set_direction(sprite, actor, static_cast<Direction>(random() % 10));
    const Actor before = actor;
    step(sprite, actor);
    const bool changed = actor.shown == 1;
    ASSERT_EQ(actor.jumped, changed && !sprite.is_natural(before.sample, actor.sample));
    const float cost = shown_cost(sprite, before.sample, actor);
    ASSERT_EQ(cost > 0, actor.jumped == 1);
    jumps += actor.jumped;
  }
  EXPECT_GT(jumps, 100);
}

TEST(Actor, AimsAtATargetAndRestsThere) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite, {}, 0, 1);
  for (int tick = 0; tick < 400; ++tick) {
    set_target(sprite, actor, {300, 170}, 30);
    step(sprite, actor);
  }
  const Vec2 at = to_pixels(actor.position);
  EXPECT_LT(std::hypot(at.x - 300, at.y - 170), 60);
  EXPECT_EQ(actor.direction, Direction::Rest);
}

TEST(Actor, ATargetOnASectorBorderDoesNotMakeItDither) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite);
  int changes = 0;
  for (int tick = 0; tick < 200; ++tick) {
    const float wobble = tick % 2 ? 4.0f : -4.0f;  // about 22.5 degrees, +-2
    const Direction before = actor.direction;
    set_target(sprite, actor, {100, 41.4f + wobble}, 1);
    changes += actor.direction != before;
  }
  EXPECT_EQ(changes, 1);
}

TEST(Actor, StateHashIsTheDocumentedOne) {
  StateHash hash;
  EXPECT_EQ(hash.digest(), 0x2D06800538D394C2u);  // XXH3-64 of nothing
  Actor actor;
  actor.tick = 1;
  actor.sample = 2;
  actor.position = {-3, 4};
  actor.table = 5;
  hash.add(actor);
  StateHash other;
  actor.table = 6;
  other.add(actor);
  EXPECT_NE(hash.digest(), other.digest());
}

TEST(Actor, TheSameKeysGiveTheSameStates) {
  const Sprite sprite = testing::tiny_sprite();
  const auto run = [&](unsigned seed) {
    Actor actor = make_actor(sprite);
    StateHash hash;
    std::mt19937 random(seed);
    for (int tick = 0; tick < 5000; ++tick) {
      if (random() % 20 == 0) set_direction(sprite, actor, static_cast<Direction>(random() % 10));
      step(sprite, actor);
      hash.add(actor);
    }
    return hash.digest();
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

// A freeze is a tick after a sample's duration that shows the same sample.
TEST(Actor, ACrowdStepsAsTheTablesOfThePackSay) {
  const Sprite sprite = testing::tiny_sprite();
  std::vector<Actor> crowd, plain;
  for (unsigned k = 0; k < 50; ++k) {
    crowd.push_back(make_actor(sprite, {static_cast<float>(k), -7}, k, static_cast<int>(k % 2)));
    crowd.back().sample = 1 + k;
  }
  plain = crowd;
  std::mt19937 random(11);
  for (int tick = 0; tick < 2000; ++tick) {
    for (std::size_t k = 0; k < crowd.size(); ++k) {
      if (random() % 8 == 0) {
        const auto direction = static_cast<Direction>(random() % kDirectionCount);
        set_direction(sprite, crowd[k], direction);
        set_direction(sprite, plain[k], direction);
      }
      testing::plain_tick(sprite, plain[k]);
    }
    step(sprite, crowd);
    ASSERT_EQ(std::memcmp(crowd.data(), plain.data(), crowd.size() * sizeof(Actor)), 0) << tick;
  }
}

TEST(Actor, AThousandChangesASecondLeaveNoTableAndReplayToTheSameStates) {
  const Sprite sprite = testing::tiny_sprite();
  for (int mode = 0; mode < 2; ++mode) {
    std::uint64_t first = 0;
    for (int run = 0; run < 2; ++run) {
      std::mt19937 keys(17);
      Actor actor = make_actor(sprite, {}, 0, mode);
      StateHash hash;
      for (int tick = 0; tick < 3000; ++tick) {
        for (int change = 0; change < 34; ++change) {  // opposite keys half of the time
          const auto d = static_cast<int>(keys() % kDirectionCount);
          const bool turn_back = d < kCompassCount && keys() % 2 == 0;
          set_direction(sprite, actor, static_cast<Direction>(turn_back ? (d + 4) % 8 : d));
        }
        const Actor before = actor;
        step(sprite, actor);
        hash.add(actor);
        ASSERT_TRUE(std::isfinite(shown_cost(sprite, before.sample, actor)));
        const bool over = before.shown >= sprite.samples()[before.sample].duration;
        ASSERT_EQ(over, actor.sample != before.sample);
      }
      if (run == 0) first = hash.digest();
      EXPECT_EQ(hash.digest(), first) << "mode " << mode;
    }
  }
}

TEST(Actor, AnHourOfRandomSteeringNeverFreezes) {
  const Sprite sprite = testing::tiny_sprite();
  for (int mode = 0; mode < 2; ++mode) {
    Actor actor = make_actor(sprite, {}, 0, mode);
    std::mt19937 random(5);
    std::int64_t x = 0, y = 0;  // as filmed; a bent path may differ from that
    for (int tick = 0; tick < 30 * 3600; ++tick) {
      if (random() % 15 == 0) set_direction(sprite, actor, static_cast<Direction>(random() % 10));
      const Actor before = actor;
      const Sample& shown = sprite.samples()[before.sample];
      step(sprite, actor);
      x += shown.step_x;
      y += shown.step_y;
      ASSERT_FALSE(before.shown >= shown.duration && actor.sample == before.sample);
    }
    if (mode == 0) {
      EXPECT_EQ(actor.position, (Position{x, y}));
    }
  }
}

}  // namespace
}  // namespace vsprite
