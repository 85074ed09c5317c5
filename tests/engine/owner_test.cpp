// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/owner.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/naive_actions.h"
#include "vsprite/action.h"

namespace vsprite {
namespace {

Vec2 heading(double degrees, float speed) {
  const double a = degrees * 3.14159265358979 / 180;
  return {static_cast<float>(std::cos(a)) * speed, static_cast<float>(std::sin(a)) * speed};
}

TEST(Owner, TheGameMovesTheActorExactlyAsItSays) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite, {10, 20}, 0, 1);
  for (int t = 0; t < 90; ++t) {
    follow(sprite, actor, {30, -15});  // 1 and -0.5 px a tick
    step(sprite, actor);
  }
  EXPECT_EQ(actor.position, to_position({100, -25}));
}

TEST(Owner, TheDrawnCharacterTrailsTheBodyOnALeashAndNeverJumps) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite, {}, 0, 1);
  double farthest = 0;
  for (int t = 0; t < 600; ++t) {
    follow(sprite, actor, heading(t / 60 * 135, 70));
    const Vec2 before = draw_position(sprite, actor, 1);
    step(sprite, actor);
    const Vec2 now = draw_position(sprite, actor, 0), body = to_pixels(actor.position);
    ASSERT_NEAR(before.x, now.x, 0.01);  // the offset is kept in 1/64 px
    ASSERT_NEAR(before.y, now.y, 0.01);
    farthest = std::max(farthest, std::hypot(double{now.x - body.x}, double{now.y - body.y}));
  }
  EXPECT_GT(farthest, 2);
  EXPECT_LT(farthest, 20.0 / 3 + 0.02);
  own_recorded(actor);
  EXPECT_FLOAT_EQ(draw_position(sprite, actor, 0).x, to_pixels(actor.position).x);
}

// What the feet slide is what the drawn character moves beyond what was filmed.
TEST(Owner, TheSlipIsWhatIsDrawnBeyondWhatWasFilmed) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite, {}, 0, 1);
  for (int t = 0; t < 400; ++t) {
    follow(sprite, actor, heading(t / 50 * 100, 66));
    const Sample& s = sprite.samples()[actor.sample];
    const double rate = s.step_length > 0 && actor.direction != Direction::Rest ? 1.1 : 1;
    const double due = foot_slip(sprite, actor) / sprite.fps();
    const Vec2 from = draw_position(sprite, actor, 0), to = draw_position(sprite, actor, 1);
    const double x = double{to.x - from.x} - rate * double{s.velocity.x} / sprite.fps();
    const double y = double{to.y - from.y} - rate * double{s.velocity.y} / sprite.fps();
    ASSERT_NEAR(std::hypot(x, y), due, 0.03) << t;
    step(sprite, actor);
  }
}

TEST(Owner, TheFeetDoNotSlideWhereTheFilmGoesSo) {
  const Sprite sprite = testing::tiny_sprite();
  for (int mode = 0; mode < 2; ++mode) {
    for (int d = 0; d < 8; ++d) {
      for (const float speed : {50.0f, 60.0f, 70.0f}) {  // filmed at 60: 0.83x to 1.17x
        Actor actor = make_actor(sprite, {}, 0, mode);
        for (int t = 0; t < 120; ++t) {
          follow(sprite, actor, heading(45 * d, speed));
          step(sprite, actor);
          ASSERT_LT(foot_slip(sprite, actor), (t > 90 ? 0.01 : 3) * speed) << d << " " << speed;
        }
      }
    }
  }
}

TEST(Owner, TheFilmIsPlayedAtTheRateOfTheBody) {
  const Sprite sprite = testing::tiny_sprite();
  const auto samples_shown = [&](float speed) {
    Actor actor = make_actor(sprite, {}, 0, 1);
    int shown = 0;
    for (int t = 0; t < 1300; ++t) {
      follow(sprite, actor, {speed, 0});
      const std::uint32_t before = actor.sample;
      step(sprite, actor);
      shown += static_cast<int>(actor.sample + 12 - before) % 12;
    }
    return shown;
  };
  EXPECT_NEAR(samples_shown(60), 1200, 2);  // twelve samples last thirteen ticks
  EXPECT_NEAR(samples_shown(51), 1020, 2);
  EXPECT_NEAR(samples_shown(10000), 1500, 2);  // at most 1.25 times as fast
}

TEST(Owner, ABodyThatStandsIsShownAtRest) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite, {}, 0, 1);
  for (int t = 0; t < 60; ++t) {
    follow(sprite, actor, {0.5f, 0});
    step(sprite, actor);
  }
  EXPECT_EQ(testing::tiny_heading(actor.sample), -1);
  EXPECT_EQ(actor.direction, Direction::Rest);
  follow(sprite, actor, {std::nanf(""), HUGE_VALF});
  step(sprite, actor);
  EXPECT_EQ(actor.direction, Direction::Down);  // what is no number is 0
}

TEST(Owner, AFactorScalesWhatWasFilmed) {
  const Sprite sprite = testing::tiny_sprite();
  Actor filmed = make_actor(sprite), scaled = filmed;
  own_scaled(scaled, {2.5f, 0});
  for (int t = 0; t < 200; ++t) {
    const auto way = static_cast<Direction>(t / 20 % 8);
    set_direction(sprite, filmed, way);
    set_direction(sprite, scaled, way);
    const std::int64_t before = filmed.position.x, scaled_before = scaled.position.x;
    step(sprite, filmed);
    step(sprite, scaled);
    ASSERT_EQ(scaled.sample, filmed.sample);
    ASSERT_NEAR(static_cast<double>(scaled.position.x - scaled_before),
                2.5 * static_cast<double>(filmed.position.x - before), 1);
  }
  EXPECT_EQ(scaled.position.y, 0);
  own_recorded(scaled);
  EXPECT_EQ(scaled.owner, 0);
}

TEST(Owner, ActionsPlayAtTheirOwnPaceWhileTheGameMoves) {
  const Sprite sprite = *make_sprite(testing::acting_sprite_data());
  Actor actor = make_actor(sprite, {}, 0, 1);
  follow(sprite, actor, {90, 0});
  play(sprite, actor, "wave", 0);
  int ticks = 0;
  for (; actor.action != 0; ++ticks) step(sprite, actor);
  EXPECT_EQ(ticks, 14);
  EXPECT_EQ(actor.position.x, to_position({3.0f * 14, 0}).x);
}

}  // namespace
}  // namespace vsprite
