// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/reload.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "support/process.h"
#include "support/temp_folder.h"
#include "support/tiny_sprite.h"
#include "vsprite/pack.h"
#include "vsprite/stream.h"

namespace vsprite {
namespace {

class Reload : public ::testing::Test {
 protected:
  void save(const std::string& name) {
    SpriteData data = testing::tiny_sprite_data();
    data.name = name;
    ASSERT_TRUE(save_pack(path_, data, [&](std::uint32_t sample) {
      return Result<Image>(testing::tiny_picture(data, sample));
    }));
  }
  // As a program that knows nothing of renaming writes it.
  void overwrite(const std::vector<std::uint8_t>& bytes) {
    std::ofstream file(path_, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  // What comes of a changed file, once it was looked at.
  static Result<std::optional<Sprite>> outcome(PackWatch& watch) {
    for (int wait = 0; wait < 10000; ++wait) {
      auto rebuilt = watch.poll();
      if (!rebuilt || *rebuilt) return rebuilt;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return std::optional<Sprite>();
  }
  testing::TempFolder folder_;
  std::string path_ = folder_.file("hero.vsp");
};

TEST_F(Reload, ARebuiltPackIsTakenOverOnceItStandsStill) {
  save("old");
  PackWatch watch(path_);
  EXPECT_FALSE(*watch.poll()) << "what was there before is known";
  save("new");
  EXPECT_FALSE(*watch.poll()) << "it may still be changing";
  const auto rebuilt = outcome(watch);
  ASSERT_TRUE(rebuilt && *rebuilt);
  EXPECT_EQ((*rebuilt)->data().name, "new");
  EXPECT_FALSE(*watch.poll()) << "taken over once";
}

TEST_F(Reload, ABadPackIsRefusedWithTheReasonAndTheOldOnePlaysOn) {
  save("old");
  const Sprite old = *load_pack(path_);
  PackWatch watch(path_);
  auto bytes = testing::read_bytes(path_);
  bytes.back() ^= 1;  // in the last picture, which load_pack does not look at
  std::filesystem::remove(path_);
  EXPECT_TRUE(watch.poll()) << "no file is no news";
  overwrite(bytes);
  const auto refused = outcome(watch);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::CorruptData);
  EXPECT_NE(refused.error().message.find("hero.vsp: FRAM: "), std::string::npos);
  EXPECT_TRUE(watch.poll()) << "said once";
  Image picture;
  EXPECT_TRUE(old.decode_frame(1, picture)) << "the old file is still open";
}

TEST_F(Reload, APackThatIsCutShortWhileItPlaysCostsPicturesAndNoSignal) {
  save("old");
  const Sprite old = *load_pack(path_);
  PackWatch watch(path_);
  overwrite({1, 2, 3});  // the very file that is open
  Image picture;
  EXPECT_FALSE(old.decode_frame(1, picture));
  FrameCache frames(old);
  EXPECT_EQ(frames.frame(1).width, 0);
  EXPECT_EQ(outcome(watch).error().code, ErrorCode::BadFormat);
}

TEST_F(Reload, AnActorStaysWhereItIsAndShowsTheSameFrame) {
  save("old");
  const Sprite from = *load_pack(path_);
  SpriteData changed = testing::tiny_sprite_data();
  for (Sample& s : changed.samples) s.frame += 3;  // three frames were added before
  const Sprite to = *make_sprite(changed);
  Actor actor = make_actor(from, {40, 50}, 9);
  set_direction(from, actor, Direction::Down);
  for (int tick = 0; tick < 20; ++tick) step(from, actor);
  const Actor same = carry_over(from, from, actor);
  EXPECT_EQ(same.sample, actor.sample);
  Actor now = carry_over(from, to, actor);
  EXPECT_EQ(now.position, actor.position);
  EXPECT_EQ(now.tick, actor.tick);
  EXPECT_EQ(now.direction, Direction::Down);
  EXPECT_LE(std::abs(static_cast<int>(to.samples()[now.sample].frame) -
                     static_cast<int>(from.samples()[actor.sample].frame)),
            3);
  for (int tick = 0; tick < 50; ++tick) step(to, now);  // and goes on
}

TEST_F(Reload, WhatIsBeingCheckedIsTakenOverBeforeWhatCameAfterIt) {
  save("old");
  PackWatch watch(path_);
  save("first");
  static_cast<void>(watch.poll());
  static_cast<void>(watch.poll());  // is checked from here on
  save("second");
  std::vector<std::string> names;
  for (int wait = 0; wait < 10000 && (names.empty() || names.back() != "second"); ++wait) {
    auto rebuilt = watch.poll();
    ASSERT_TRUE(rebuilt) << rebuilt.error().message;
    if (*rebuilt) names.push_back((*rebuilt)->data().name);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(names.back(), "second");
}

TEST_F(Reload, AWatchMayBeDroppedInTheMiddleOfACheck) {
  save("old");
  for (int round = 0; round < 20; ++round) {
    PackWatch watch(path_);
    save("new");
    static_cast<void>(watch.poll());
    static_cast<void>(watch.poll());
    PackWatch moved = std::move(watch);
    if (round % 2 == 0) static_cast<void>(moved.poll());
  }
}

TEST_F(Reload, AThousandReloadsLeaveNothingBehind) {
  save("old");
  const auto bytes = testing::read_bytes(path_);
  Sprite sprite = *load_pack(path_);
  PackWatch watch(path_);
  Actor actor = make_actor(sprite);
  const std::size_t files = testing::open_files();
  long pages = 0;
  for (int round = 0; round < 1000; ++round) {
    if (round == 200) pages = testing::resident_pages();
    const std::string fresh = folder_.file("fresh.vsp");
    std::ofstream(fresh, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    std::filesystem::rename(fresh, path_);
    auto rebuilt = outcome(watch);
    ASSERT_TRUE(rebuilt && *rebuilt) << round;
    actor = carry_over(sprite, **rebuilt, actor);
    sprite = std::move(**rebuilt);
    step(sprite, actor);
  }
  EXPECT_EQ(testing::open_files(), files);
  EXPECT_LE(testing::resident_pages(), pages + 256);
}

TEST_F(Reload, AThousandOpeningsLeaveNothingBehind) {
  save("hero");
  const std::size_t files = testing::open_files();
  long pages = 0;
  for (int round = 0; round < 1000; ++round) {
    if (round == 200) pages = testing::resident_pages();
    const Result<Sprite> sprite = load_pack(path_);
    ASSERT_TRUE(sprite);
    FrameCache frames(*sprite, 1 << 20);
    Actor actor = make_actor(*sprite);
    step(*sprite, actor);
    ASSERT_GT(frames.frame(actor.sample).width, 0);
  }
  EXPECT_EQ(testing::open_files(), files);
  EXPECT_LE(testing::resident_pages(), pages + 256);
}

}  // namespace
}  // namespace vsprite
