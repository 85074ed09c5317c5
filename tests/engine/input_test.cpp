// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/input.h"

#include <gtest/gtest.h>

#include "support/temp_folder.h"

namespace vsprite {
namespace {

TEST(Input, HeldKeysGiveADirectionAndOppositesCancel) {
  KeyState keys;
  EXPECT_EQ(keys.direction(), Direction::None);
  keys.press(Key::Right);
  EXPECT_EQ(keys.direction(), Direction::Right);
  keys.press(Key::Up);
  EXPECT_EQ(keys.direction(), Direction::RightUp);
  keys.press(Key::Left);
  EXPECT_EQ(keys.direction(), Direction::Up);
  keys.release(Key::Right);
  EXPECT_EQ(keys.direction(), Direction::LeftUp);
  keys.release_all();
  EXPECT_EQ(keys.direction(), Direction::None);
}

TEST(KeyScript, ActsFromTheFirstTickAtOrAfterItsTime) {
  const auto script = parse_key_script("0.0 right; 2.5 right+up; 4.01 none; 6 rest", 30);
  ASSERT_TRUE(script) << script.error().message;
  EXPECT_EQ(script->at(0), Direction::Right);
  EXPECT_EQ(script->at(74), Direction::Right);
  EXPECT_EQ(script->at(75), Direction::RightUp);
  EXPECT_EQ(script->at(120), Direction::RightUp);  // 4.01 * 30 = 120.3
  EXPECT_EQ(script->at(121), Direction::None);
  EXPECT_EQ(script->at(180), Direction::Rest);
  EXPECT_EQ(script->at(~std::uint64_t{0}), Direction::Rest);
}

TEST(KeyScript, WholeProductsStayWhole) {
  // In doubles 0.07 * 100 is 7.000000000000001.
  EXPECT_EQ(parse_key_script("0.07 up", 100)->entries[0].tick, 7u);
  EXPECT_EQ(parse_key_script("1.001 up", 30000.0 / 1001)->entries[0].tick, 30u);
}

TEST(KeyScript, OfSeveralInOneTickTheLastCountsAndOrderIsFree) {
  const auto script = parse_key_script("1.0 up\n0.01 left\n0.02 right  # both in tick 1\n\n;;", 30);
  ASSERT_TRUE(script) << script.error().message;
  EXPECT_EQ(script->at(0), Direction::None);
  EXPECT_EQ(script->at(1), Direction::Right);
  EXPECT_EQ(script->at(30), Direction::Up);
}

TEST(KeyScript, EmptyTextIsAScriptWithoutCommands) {
  for (const char* text : {"", " \n", "# only a comment", ";", "\r\n"}) {
    const auto script = parse_key_script(text, 30);
    ASSERT_TRUE(script) << text;
    EXPECT_EQ(script->at(100), Direction::None);
  }
}

TEST(KeyScript, NamesTheBadEntry) {
  const auto script = parse_key_script("0.0 right; 1 up # fine\n2.5 rihgt", 30);
  ASSERT_FALSE(script);
  EXPECT_EQ(script.error().code, ErrorCode::BadSetting);
  EXPECT_EQ(
      script.error().message,
      "key script: entry 3 \"2.5 rihgt\": unknown direction \"rihgt\", due one of right, left, "
      "up, down, a pair such as right+up, none, rest; or play, hold, queue, release, cancel");
}

TEST(KeyScript, RefusesTimesThatAreNone) {
  for (const char* text : {"-1 up", "nan up", "inf up", "1e300 up", "x up", "1,5 up", "0x10 up",
                           "up", "1.0", "+1 up", "1s up"}) {
    const auto script = parse_key_script(text, 30);
    ASSERT_FALSE(script) << text;
    EXPECT_EQ(script.error().code, ErrorCode::BadSetting);
    EXPECT_NE(script.error().message.find("entry 1"), std::string::npos);
  }
}

TEST(KeyScript, AnExistingFileIsReadAndAMissingOneIsNamed) {
  const testing::TempFolder folder;
  const std::string text = "0 down\n1 left # back\n";
  testing::write_bytes(folder.file("keys.txt"), {text.begin(), text.end()});
  const auto script = load_key_script(folder.file("keys.txt"), 10);
  ASSERT_TRUE(script) << script.error().message;
  EXPECT_EQ(script->at(10), Direction::Left);
  EXPECT_EQ(load_key_script("0 down; 1 left", 10)->at(10), Direction::Left);
  EXPECT_EQ(load_key_script("kyes.txt", 10).error().code, ErrorCode::NotFound);
  testing::write_bytes(folder.file("bad.txt"), {'?'});
  EXPECT_EQ(
      load_key_script(folder.file("bad.txt"), 10).error().message.find(folder.file("bad.txt")), 0u);
}

}  // namespace
}  // namespace vsprite
