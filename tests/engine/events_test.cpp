// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/events.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "support/naive_actions.h"
#include "support/pack_bytes.h"
#include "vsprite/action.h"
#include "vsprite/body.h"
#include "vsprite/owner.h"

namespace vsprite {
namespace {

using testing::tiny_sample;

// A step at the third and ninth sample of every heading, and a turn's end at some.
SpriteData eventful_data() {
  SpriteData data = testing::acting_sprite_data();
  data.event_names = {"step", "blink"};
  for (int h = 0; h < 8; ++h) {
    data.events.push_back({tiny_sample(h, 2), 0});
    data.events.push_back({tiny_sample(h, 8), 0});
    data.events.push_back({tiny_sample(h, 8), 1});
  }
  for (std::uint16_t tag = 0; tag < data.tags.size(); ++tag)
    data.bodies.push_back({tag, -5, -4, 6, static_cast<float>(tag)});
  return data;
}

TEST(Events, EachComesOnceWhenItsSampleComesToBeShown) {
  const Sprite sprite = *make_sprite(eventful_data());
  Actor actor = make_actor(sprite);
  set_direction(sprite, actor, Direction::Right);
  const auto step_name = static_cast<std::uint32_t>(find_event(sprite, "step"));
  int steps = 0, blinks = 0, shown = 0;
  for (int t = 0; t < 13 * 20; ++t) {  // the third sample is shown for two ticks
    step(sprite, actor);
    const TickEvents now = events_of(sprite, actor);
    shown += now.frame_shown;
    for (const SampleEvent& e : now.named) (e.name == step_name ? steps : blinks) += 1;
  }
  EXPECT_EQ(shown, 12 * 20);
  EXPECT_EQ(steps, 40);
  EXPECT_EQ(blinks, 20);
  EXPECT_EQ(find_event(sprite, "roar"), -1);
}

TEST(Events, NoneIsLostOrDoubledAtAnyRateOfABodyMovedByTheGame) {
  const Sprite sprite = *make_sprite(eventful_data());
  for (const float speed : {48.0f, 57.0f, 60.0f, 66.0f, 75.0f, 200.0f}) {
    Actor actor = make_actor(sprite, {}, 0, 1);
    int steps = 0, rounds = 0;
    for (int t = 0; t < 3000; ++t) {
      follow(sprite, actor, {speed, 0});
      const std::uint32_t before = actor.sample;
      step(sprite, actor);
      rounds += actor.sample < before;
      for (const SampleEvent& e : events_of(sprite, actor).named) steps += e.name == 0;
    }
    EXPECT_NEAR(steps, 2 * rounds, 2) << speed;
    EXPECT_GT(rounds, 150) << speed;
  }
}

TEST(Events, AJumpIsTakenWhereThePictureDoesNotFollowItsPredecessor) {
  const Sprite sprite = *make_sprite(eventful_data());
  Actor actor = make_actor(sprite, {}, 0, 1);
  std::mt19937 random(2);
  for (int t = 0; t < 2000; ++t) {
    if (t % 10 == 0) set_direction(sprite, actor, static_cast<Direction>(random() % 10));
    const std::uint32_t before = actor.sample;
    step(sprite, actor);
    const TickEvents now = events_of(sprite, actor);
    ASSERT_EQ(now.frame_shown, actor.sample != before);
    ASSERT_EQ(now.jump_taken, now.frame_shown && !sprite.is_natural(before, actor.sample));
  }
}

TEST(Events, AHeldSampleIsShownOnce) {
  const Sprite sprite = *make_sprite(eventful_data());
  Actor actor = make_actor(sprite);
  play(sprite, actor, "jump", 0);
  int shown = 0;
  for (int t = 0; t < 100; ++t) {
    step(sprite, actor);
    shown += events_of(sprite, actor).frame_shown;
  }
  EXPECT_EQ(shown, 8);  // three of the start, five of the air, the last of which is held
}

TEST(Body, TheBoxIsTheTagsAndFollowsTheActor) {
  const Sprite sprite = *make_sprite(eventful_data());
  Actor actor = make_actor(sprite, {100, 50});
  actor.sample = tiny_sample(6, 4);
  const Box box = body_box(sprite, actor, 2);
  EXPECT_FLOAT_EQ(box.left, 90);
  EXPECT_FLOAT_EQ(box.right, 112);
  EXPECT_FLOAT_EQ(box.bottom, 60);
  const Box plain = body_box(testing::tiny_sprite(), actor);
  EXPECT_FLOAT_EQ(plain.left, 90);  // half the body length
}

TEST(Body, APointHitsWhatOneSeesOfThePicture) {
  const Sprite sprite = testing::tiny_sprite();
  Actor actor = make_actor(sprite, {100, 50});
  const Image picture = testing::tiny_picture(sprite.data(), actor.sample);
  const Sample& s = sprite.samples()[actor.sample];
  const Box drawn = drawn_box(sprite, actor);
  EXPECT_FLOAT_EQ(drawn.right - drawn.left, s.width);
  int seen = 0, hits = 0;
  for (int y = 0; y < s.height; ++y)
    for (int x = 0; x < s.width; ++x) {
      const bool opaque = picture.rgba[static_cast<std::size_t>(4 * (y * s.width + x) + 3)] >= 128;
      const Vec2 at{drawn.left + static_cast<float>(x) + 0.5f,
                    drawn.top + static_cast<float>(y) + 0.5f};
      seen += opaque;
      hits += hit(sprite, actor, picture, at);
      EXPECT_EQ(hit(sprite, actor, picture, at), opaque);
    }
  EXPECT_GT(hits, 50);
  EXPECT_EQ(hits, seen);
  EXPECT_FALSE(hit(sprite, actor, picture, {drawn.left - 0.5f, 50}));
  EXPECT_FALSE(hit(sprite, actor, Image{}, {100, 50}));
}

testing::ByteVector eventful_pack() {
  const testing::TempFolder folder;
  const SpriteData data = eventful_data();
  const auto saved = save_pack(folder.file("a.vsp"), data, [&](std::uint32_t sample) {
    return Result<Image>(testing::tiny_picture(data, sample));
  });
  return saved ? testing::read_bytes(folder.file("a.vsp")) : testing::ByteVector();
}

TEST(EventSection, ComesBackAsItWasWritten) {
  const auto sprite = testing::load_bytes(eventful_pack());
  ASSERT_TRUE(sprite) << sprite.error().message;
  const SpriteData due = eventful_data();
  EXPECT_EQ(sprite->data().events, due.events);
  EXPECT_EQ(sprite->data().event_names, due.event_names);
  ASSERT_EQ(sprite->data().bodies.size(), due.bodies.size());
  EXPECT_EQ(sprite->data().bodies[3].bottom, due.bodies[3].bottom);
  EXPECT_TRUE(testing::verify_bytes(eventful_pack()).empty());
}

TEST(EventSection, EveryFaultHasItsCode) {
  const auto code = [](const std::function<void(SpriteData&)>& spoil) {
    SpriteData data = eventful_data();
    spoil(data);
    const auto bad = detail::check_sprite_data(data);
    return bad ? bad->issue.code : std::string();
  };
  using S = SpriteData;
  EXPECT_EQ(code([](S&) {}), "");
  EXPECT_EQ(code([](S& d) { d.events[1].sample = 0xFFFFFFFFu; }), "event-sample");
  EXPECT_EQ(code([](S& d) { d.events[1].name = 2; }), "event-name");
  EXPECT_EQ(code([](S& d) { d.events[1] = d.events[0]; }), "event-order");
  EXPECT_EQ(code([](S& d) { d.event_names[1] = "step"; }), "event-name");
  EXPECT_EQ(code([](S& d) { d.bodies[2].left = 7; }), "body-box");
  EXPECT_EQ(code([](S& d) { d.bodies[2].top = std::nanf(""); }), "body-box");
  EXPECT_EQ(code([](S& d) { d.bodies[2].tag = 1; }), "body-tag");
  EXPECT_EQ(code([](S& d) { d.bodies.pop_back(); }), "body-tag");
}

TEST(EventSection, NoHostileSectionIsAccepted) {
  const testing::PackParts good = testing::PackParts::split(eventful_pack());
  std::mt19937 random(3);
  for (const char* name : {"EVNT", "BODY"}) {
    for (int trial = 0; trial < 500; ++trial) {
      testing::PackParts parts = good;
      testing::ByteVector& bytes = parts[name].bytes;
      if (trial % 2 == 0) {
        bytes.resize(random() % bytes.size());
        EXPECT_FALSE(testing::load_bytes(parts.join()));
        continue;
      }
      bytes[trial % 4 == 1 ? random() % 16 : random() % bytes.size()] =
          static_cast<std::uint8_t>(random());
      const auto sprite = testing::load_bytes(parts.join());
      if (!sprite) continue;
      Actor actor = make_actor(*sprite);
      for (int t = 0; t < 40; ++t) {
        step(*sprite, actor);
        for (const SampleEvent& e : events_of(*sprite, actor).named)
          ASSERT_LT(e.name, sprite->data().event_names.size());
      }
    }
  }
}

}  // namespace
}  // namespace vsprite
