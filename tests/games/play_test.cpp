// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "window/play.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "support/gl_stage.h"
#include "support/temp_folder.h"
#include "support/tiny_sprite.h"
#include "vsprite/image.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

using testing::TempFolder;

Sprite tiny_pack(const TempFolder& folder, std::uint32_t served = 0xFF) {
  SpriteData data = testing::tiny_sprite_data();
  for (ControlMode& mode : data.modes) {
    mode.served = served;
    for (int d = 0; d < kCompassCount; ++d) {
      const auto i = static_cast<std::size_t>(d);
      if ((served >> d & 1u) == 0) mode.table_of[i] = d == 7 ? Direction::Right : Direction::Rest;
    }
  }
  const auto picture = [&](std::uint32_t i) -> Result<Image> {
    return testing::tiny_picture(data, i);
  };
  const Result<void> saved = save_pack(folder.file("tiny.vsp"), data, picture);
  EXPECT_TRUE(saved) << saved.error().message;
  return *load_pack(folder.file("tiny.vsp"));
}

PlayOptions quick(const std::string& record) {
  return {.headless = true,
          .frames = 20,
          .keys = "0 right",
          .record = record,
          .width = 320,
          .height = 240};
}

/// Runs the window; skips the test where no OpenGL context can be had.
#define PLAY_OR_SKIP(sprite, options)                                                 \
  if (const Result<void> played = play_window(sprite, options); !played) {            \
    ASSERT_EQ(played.error().code, ErrorCode::Unavailable) << played.error().message; \
    GTEST_SKIP() << played.error().message;                                           \
  }

TEST(Play, ShowsTheSamePictureForTheSameKeys) {
  const TempFolder folder;
  const Sprite sprite = tiny_pack(folder);
  PLAY_OR_SKIP(sprite, quick(folder.file("a.png")));
  PLAY_OR_SKIP(sprite, quick(folder.file("b.png")));
  PlayOptions other = quick(folder.file("c.png"));
  other.keys = "0 down";
  PLAY_OR_SKIP(sprite, other);
  const Result<Image> a = read_png(folder.file("a.png"));
  ASSERT_TRUE(a) << a.error().message;
  EXPECT_EQ(a->width, 320);
  EXPECT_EQ(a->rgba, read_png(folder.file("b.png"))->rgba);
  EXPECT_NE(a->rgba, read_png(folder.file("c.png"))->rgba);
}

TEST(Play, WritesAFilmAndAScreenshot) {
  const TempFolder folder;
  const Sprite sprite = tiny_pack(folder);
  PlayOptions options = quick(folder.file("a.mp4"));
  options.screenshot = folder.file("a.png");
  PLAY_OR_SKIP(sprite, options);
  EXPECT_GT(testing::read_bytes(folder.file("a.mp4")).size(), 1000u);
  EXPECT_TRUE(read_png(folder.file("a.png")));
}

// The pack is rebuilt, then spoiled, under a running window.
TEST(Play, TakesARebuiltPackOverAndKeepsTheOldOneInPlaceOfABadOne) {
  const TempFolder folder;
  const Sprite sprite = tiny_pack(folder);
  PlayOptions options = quick("");
  options.frames = 1000;
  options.width = 64;
  options.height = 48;
  options.watched = folder.file("tiny.vsp");
  std::vector<std::string> told;
  options.tell = [&](const std::string& what) { told.push_back(what); };
  std::vector<Actor> states;
  bool is_spoiled = false;
  options.after_tick = [&](const Actor& actor) {
    states.push_back(actor);
    if (actor.tick == 5) static_cast<void>(tiny_pack(folder));
    if (told.size() == 1 && !is_spoiled) {
      std::ofstream(options.watched, std::ios::trunc) << "no pack";
      is_spoiled = true;
    }
    if (told.size() < 2) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  };
  PLAY_OR_SKIP(sprite, options);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_NE(told[0].find("tiny.vsp was rebuilt"), std::string::npos) << told[0];
  EXPECT_NE(told[1].find("the old pack plays on: "), std::string::npos) << told[1];
  EXPECT_NE(told[1].find("tiny.vsp: "), std::string::npos) << told[1];
  ASSERT_EQ(states.size(), 1000u) << "no tick was lost";
  for (std::size_t i = 1; i < states.size(); ++i) ASSERT_EQ(states[i].tick, states[i - 1].tick + 1);
}

TEST(Play, RefusesAModeThatThePackDoesNotHave) {
  const TempFolder folder;
  PlayOptions options = quick("");
  options.mode = "sideways";
  const Result<void> played = play_window(tiny_pack(folder), options);
  ASSERT_FALSE(played);
  EXPECT_EQ(played.error().code, ErrorCode::BadSetting);
  EXPECT_NE(played.error().message.find("paper"), std::string::npos) << played.error().message;
}

TEST(Play, SaysWhichDirectionsCannotBeServed) {
  const TempFolder folder;
  EXPECT_EQ(describe_directions(tiny_pack(folder)), "");
  const std::string some = describe_directions(tiny_pack(folder, 0x7F));
  EXPECT_NE(some.find("right+up: "), std::string::npos) << some;
  EXPECT_NE(some.find("right is followed instead"), std::string::npos) << some;
  EXPECT_NE(describe_directions(tiny_pack(folder, 0)).find("plays by itself"), std::string::npos);
}

}  // namespace
}  // namespace vsprite
