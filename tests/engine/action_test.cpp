// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/action.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "support/naive_actions.h"
#include "support/pack_bytes.h"
#include "vsprite/input.h"

namespace vsprite {
namespace {

using testing::tiny_sample;

const Sprite& acting_sprite() {
  static const Sprite sprite = *make_sprite(testing::acting_sprite_data());
  return sprite;
}

std::string shown_tag(const Sprite& sprite, const Actor& actor) {
  return sprite.data().tags[sprite.samples()[actor.sample].tag];
}

// Tags in the order in which they were shown, each once.
std::vector<std::string> tags_of(const Sprite& sprite, Actor& actor, int ticks) {
  std::vector<std::string> tags{shown_tag(sprite, actor)};
  for (int t = 0; t < ticks; ++t) {
    step(sprite, actor);
    if (const std::string tag = shown_tag(sprite, actor); tag != tags.back()) tags.push_back(tag);
  }
  return tags;
}

TEST(Play, NamesAreTheTagsAndWhatPhasesMakeTogether) {
  std::vector<std::string> names;
  for (const Action& action : acting_sprite().actions()) names.push_back(action.name);
  EXPECT_EQ(names, (std::vector<std::string>{"idle", "jump.start", "jump", "jump.air", "jump.end",
                                             "wave"}));
  EXPECT_EQ(find_action(acting_sprite(), "fly"), -1);
  Actor actor = make_actor(acting_sprite());
  const Actor before = actor;
  EXPECT_FALSE(play(acting_sprite(), actor, "fly"));
  EXPECT_EQ(std::memcmp(&actor, &before, sizeof actor), 0);
}

TEST(Play, ZeroTicksIsACutOnTheNextFrame) {
  const Sprite& sprite = acting_sprite();
  Actor actor = make_actor(sprite);
  actor.sample = tiny_sample(0, 2);  // shown for two ticks: it has to end early
  play(sprite, actor, "wave", 0);
  step(sprite, actor);
  EXPECT_EQ(actor.sample, tiny_sample(6, 0));
  EXPECT_EQ(actor.jumped, 1);
  EXPECT_FLOAT_EQ(shown_cost(sprite, tiny_sample(0, 2), actor), 2);
}

TEST(Play, MoreTimeBuysASmootherWay) {
  const Sprite& sprite = acting_sprite();
  const auto dearest = [&](int within) {
    Actor actor = make_actor(sprite);
    actor.sample = tiny_sample(7, 7);
    play(sprite, actor, "wave", within);
    float worst = 0;
    for (int t = 0; (actor.play & kPlayApproach) != 0; ++t) {
      const std::uint32_t before = actor.sample;
      step(sprite, actor);
      worst = std::max(worst, shown_cost(sprite, before, actor));
      EXPECT_LE(t, within < 0 ? 100 : std::max(within, 1) - 1);
    }
    return worst;
  };
  EXPECT_FLOAT_EQ(dearest(2), 2);     // no way in two ticks but a cut
  EXPECT_FLOAT_EQ(dearest(8), 0.3f);  // time for a turn
  EXPECT_FLOAT_EQ(dearest(kNoDeadline), 0.3f);
}

TEST(Play, OneShotReturnsToWhatIsCommandedThen) {
  const Sprite& sprite = acting_sprite();
  Actor actor = make_actor(sprite, {}, 0, 1);
  play(sprite, actor, "wave", 4);
  set_direction(sprite, actor, Direction::Right);  // while it plays
  int showing = 0;
  for (int t = 0; t < 60; ++t) {
    step(sprite, actor);
    showing += is_showing_action(actor);
  }
  EXPECT_EQ(showing, 13);  // all twelve samples, one of them for two ticks
  EXPECT_EQ(actor.action, 0);
  EXPECT_EQ(testing::tiny_heading(actor.sample), 0);
}

TEST(Play, PhasesStayInTheAirUntilTheGameSaysSo) {
  const Sprite& sprite = acting_sprite();
  Actor actor = make_actor(sprite);
  actor.sample = testing::kTinyFirstIdle;
  play(sprite, actor, "jump");
  EXPECT_EQ(tags_of(sprite, actor, 40).back(), "jump.air");
  EXPECT_EQ(actor.sample, tiny_sample(2, 7));  // nothing closes inside it: the last sample is held
  release(sprite, actor);
  const std::vector<std::string> landing = tags_of(sprite, actor, 8);
  ASSERT_GE(landing.size(), 2u);
  EXPECT_EQ(landing[1], "jump.end");
  EXPECT_EQ(actor.action, 0);
}

TEST(Play, AReleasedJumpLandsWithinItsDeadline) {
  const Sprite& sprite = acting_sprite();
  for (int wait = 0; wait < 6; ++wait) {
    Actor actor = make_actor(sprite);
    play(sprite, actor, "jump", 0);
    for (int t = 0; t < 5 + wait; ++t) step(sprite, actor);
    ASSERT_EQ(shown_tag(sprite, actor), "jump.air");
    release(sprite, actor, 2);
    step(sprite, actor);
    step(sprite, actor);
    EXPECT_EQ(shown_tag(sprite, actor), "jump.end") << wait;
    for (int t = 0; t < 5; ++t) step(sprite, actor);
    EXPECT_EQ(actor.action, 0);
  }
}

TEST(Play, AHeldTagLoopsInsideItself) {
  const Sprite& sprite = acting_sprite();
  Actor actor = make_actor(sprite);
  play(sprite, actor, "wave", 0, true);
  EXPECT_EQ(tags_of(sprite, actor, 200), (std::vector<std::string>{"", "wave"}));
  release(sprite, actor);
  step(sprite, actor);
  step(sprite, actor);
  EXPECT_EQ(actor.action, 0);
}

TEST(Play, QueuedFollowsAndCancelEndsIt) {
  const Sprite& sprite = acting_sprite();
  const int wave = find_action(sprite, "wave"), idle = find_action(sprite, "idle");
  Actor actor = make_actor(sprite);
  play(sprite, actor, wave, 0);
  queue(sprite, actor, idle);
  const std::vector<std::string> tags = tags_of(sprite, actor, 30);
  EXPECT_NE(std::find(tags.begin(), tags.end(), "idle"), tags.end());
  EXPECT_LT(std::find(tags.begin(), tags.end(), "wave"),
            std::find(tags.begin(), tags.end(), "idle"));
  play(sprite, actor, wave, 0, true);
  queue(sprite, actor, idle);
  step(sprite, actor);
  cancel(sprite, actor);
  EXPECT_EQ(actor.action, 0);
  EXPECT_EQ(actor.queued, 0);
}

TEST(Play, RandomUseNeverLeavesTheTransitionsButByACut) {
  const Sprite& sprite = acting_sprite();
  Actor actor = make_actor(sprite, {}, 0, 1);
  std::mt19937 random(11);
  for (int t = 0; t < 50000; ++t) {
    const int what = static_cast<int>(random() % 40), action = static_cast<int>(random() % 6);
    if (what == 0) play(sprite, actor, action, static_cast<int>(random() % 12) - 1, t % 2 == 0);
    if (what == 1) queue(sprite, actor, action, t % 2 == 0);
    if (what == 2) release(sprite, actor, static_cast<int>(random() % 6) - 1);
    if (what == 3) cancel(sprite, actor);
    if (what < 9) set_direction(sprite, actor, static_cast<Direction>(random() % 10));
    const Actor before = actor;
    step(sprite, actor);
    ASSERT_EQ(actor.tick, before.tick + 1);
    ASSERT_EQ(sprite.samples()[actor.sample].kept, 1u);
    ASSERT_TRUE(std::isfinite(shown_cost(sprite, before.sample, actor)));
  }
}

TEST(Play, AScriptPlaysActions) {
  const auto script =
      parse_key_script("0 right; 1 play jump 4; 2 release; 2 left; 3 hold wave", 30);
  ASSERT_TRUE(script) << script.error().message;
  EXPECT_EQ(script->entries.size(), 2u);
  ASSERT_EQ(script->actions.size(), 3u);
  EXPECT_EQ(script->actions[0].tick, 30u);
  EXPECT_EQ(script->actions[0].within, 4);
  EXPECT_EQ(script->actions[2].name, "wave");
  EXPECT_TRUE(check_key_script(acting_sprite(), *script));
  const auto known = check_key_script(acting_sprite(), *parse_key_script("0 play fly", 30));
  ASSERT_FALSE(known);
  EXPECT_NE(known.error().message.find("no action \"fly\", the pack has idle, jump"),
            std::string::npos);
  for (const char* bad : {"1 play", "1 play jump soon", "1 release now", "1 cancel jump",
                          "1 play jump 4 5", "1 play jump -1", "1 queue jump 3"})
    EXPECT_FALSE(parse_key_script(bad, 30)) << bad;
}

// ---- the section ACTN ----

testing::ByteVector acting_pack() {
  const testing::TempFolder folder;
  const SpriteData data = testing::acting_sprite_data();
  const auto saved = save_pack(folder.file("a.vsp"), data, [&](std::uint32_t sample) {
    return Result<Image>(testing::tiny_picture(data, sample));
  });
  return saved ? testing::read_bytes(folder.file("a.vsp")) : testing::ByteVector();
}

TEST(ActionSection, ComesBackAsItWasWritten) {
  const auto sprite = testing::load_bytes(acting_pack());
  ASSERT_TRUE(sprite) << sprite.error().message;
  const SpriteData due = testing::acting_sprite_data();
  EXPECT_EQ(sprite->data().action_tau, due.action_tau);
  EXPECT_EQ(sprite->data().action_horizon, due.action_horizon);
  ASSERT_EQ(sprite->data().actions.size(), due.actions.size());
  for (std::size_t k = 0; k < due.actions.size(); ++k) {
    const ActionTable &got = sprite->data().actions[k], &want = due.actions[k];
    EXPECT_EQ(got.value, want.value);
    EXPECT_EQ(got.next, want.next);
    EXPECT_EQ(got.cut, want.cut);
    EXPECT_EQ(got.stay, want.stay);
    EXPECT_EQ(got.in_time, want.in_time);
  }
}

TEST(ActionSection, EveryFaultHasItsCode) {
  const auto code = [](const std::function<void(ActionTable&, SpriteData&)>& spoil) {
    SpriteData data = testing::acting_sprite_data();
    spoil(data.actions[1], data);  // jump.start
    const auto bad = detail::check_sprite_data(data);
    return bad ? bad->issue.code : std::string();
  };
  using T = ActionTable;
  using S = SpriteData;
  EXPECT_EQ(code([](T&, S&) {}), "");
  EXPECT_EQ(code([](T&, S& d) { d.action_tau = 0; }), "action-tau");
  EXPECT_EQ(code([](T& t, S&) { t.tag = 77; }), "action-tag");
  EXPECT_EQ(code([](T& t, S&) { t.value.pop_back(); }), "action-size");
  EXPECT_EQ(code([](T& t, S&) { t.next[0] = 1; }), "action-kept");
  EXPECT_EQ(code([](T& t, S&) { t.next[5] = 0xFFFFFFF0u; }), "action-next");
  EXPECT_EQ(code([](T& t, S&) { t.next[5] = 50; }), "action-next");
  EXPECT_EQ(code([](T& t, S&) { t.value[5] = 0; }), "action-value");
  EXPECT_EQ(code([](T& t, S&) { t.cut[5] = 6; }), "action-cut");
  EXPECT_EQ(code([](T& t, S&) { t.cut[5] = 0xFFFFFFF0u; }), "action-cut");
  EXPECT_EQ(code([](T& t, S&) { t.stay[5] = 6; }), "action-stay");
  EXPECT_EQ(code([](T& t, S&) { t.in_time[testing::tiny_sample(0, 3)] = tiny_sample(0, 4); }),
            "action-deadline");
}

// Sums made right again: what is wrong has to be found by its meaning, or does no harm.
TEST(ActionSection, NoHostileSectionIsAccepted) {
  const testing::PackParts good = testing::PackParts::split(acting_pack());
  std::mt19937 random(3);
  for (int trial = 0; trial < 3000; ++trial) {
    testing::PackParts parts = good;
    testing::ByteVector& bytes = parts["ACTN"].bytes;
    if (trial % 3 == 0) {
      bytes.resize(random() % bytes.size());
      EXPECT_FALSE(testing::load_bytes(parts.join()));
      continue;
    }
    const std::size_t at = trial % 3 == 1 ? random() % 24 : random() % bytes.size();
    bytes[at] = static_cast<std::uint8_t>(random());
    const auto sprite = testing::load_bytes(parts.join());
    if (!sprite) continue;
    Actor actor = make_actor(*sprite);
    for (int t = 0; t < 40; ++t) {
      if (t % 8 == 0)
        play(*sprite, actor, static_cast<int>(random() % sprite->actions().size()), t % 5);
      step(*sprite, actor);
      ASSERT_EQ(sprite->samples()[actor.sample].kept, 1u);
    }
  }
  testing::PackParts twice = good;
  twice.parts.insert(twice.parts.begin() + 3, good.parts[std::size_t{5}]);
  EXPECT_FALSE(testing::load_bytes(twice.join()));
}

}  // namespace
}  // namespace vsprite
