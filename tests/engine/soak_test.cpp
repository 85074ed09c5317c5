// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// A thousand hours of play, and fingers faster than any.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "support/naive_actions.h"
#include "support/plain_actor.h"
#include "support/process.h"
#include "vsprite/action.h"

namespace vsprite {
namespace {

constexpr std::uint64_t kHour = 3600 * 30;

bool equal(const Actor& a, const Actor& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// Beside an actor stepped as actor.h says it, by another program: the same bytes, so that the
// position is exact, and never the same sample twice where its time is over.
TEST(Soak, AThousandHoursOfRandomSteeringNeitherFreezeNorDrift) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite, {}, 0, 1), plain = actor;
  std::mt19937 random(1);
  std::uint64_t frozen = 0, apart = 0;
  const long before = testing::resident_pages();
  for (std::uint64_t hour = 0; hour < 1000; ++hour) {
    for (std::uint64_t t = 0; t < kHour;) {
      const auto wanted = static_cast<Direction>(random() % kDirectionCount);
      set_direction(sprite, actor, wanted);
      set_direction(sprite, plain, wanted);
      for (auto k = 1 + random() % 100; k > 0 && t < kHour; --k, ++t) {
        const Actor last = actor;
        step(sprite, actor);
        testing::plain_tick(sprite, plain);
        frozen += actor.sample == last.sample && actor.shown <= last.shown;
      }
      apart += !equal(actor, plain);
    }
  }
  EXPECT_EQ(actor.tick, 1000 * kHour);
  EXPECT_EQ(frozen, 0u);
  EXPECT_EQ(apart, 0u);
  EXPECT_LE(testing::resident_pages(), before + 64);
}

TEST(Soak, AThousandChangesASecondNeverLeaveTheTransitions) {
  const Sprite sprite = *make_sprite(testing::acting_sprite_data());
  StateHash hashes[2];
  for (StateHash& hash : hashes) {
    std::mt19937 random(2);
    Actor actor = make_actor(sprite, {}, 0, 1);
    for (std::uint64_t t = 0; t < kHour / 4; ++t) {
      for (int change = 0; change < 33; ++change) {
        set_direction(sprite, actor, static_cast<Direction>(random() % kDirectionCount));
        if (random() % 200 == 0)
          play(sprite, actor, static_cast<int>(random() % sprite.actions().size()),
               static_cast<int>(random() % 10) - 1);
        if (random() % 200 == 0) release(sprite, actor);
      }
      const Actor last = actor;
      step(sprite, actor);
      hash.add(actor);
      const bool known = std::isfinite(shown_cost(sprite, last.sample, actor));
      ASSERT_TRUE(actor.sample == last.sample || actor.jumped == 0 || known) << t;
    }
  }
  EXPECT_EQ(hashes[0].digest(), hashes[1].digest());
}

}  // namespace
}  // namespace vsprite
