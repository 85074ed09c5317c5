// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/pack.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <thread>

#include "support/pack_bytes.h"
#include "vsprite/actor.h"

namespace vsprite {
namespace {

using testing::ByteVector;
using testing::tiny_pack_bytes;

const SpriteData& tiny_data() {
  static const SpriteData data = testing::tiny_sprite_data();
  return data;
}

Result<void> save_tiny(const std::string& path) {
  return save_pack(path, tiny_data(), [](std::uint32_t sample) {
    return Result<Image>(testing::tiny_picture(tiny_data(), sample));
  });
}

TEST(Pack, GivesBackExactlyWhatWasSaved) {
  const auto sprite = testing::load_bytes(tiny_pack_bytes());
  ASSERT_TRUE(sprite) << sprite.error().message;
  const SpriteData& data = sprite->data();
  EXPECT_EQ(data.name, "tiny");
  EXPECT_EQ(data.tags, tiny_data().tags);
  EXPECT_EQ(data.fps_numerator, 30u);
  EXPECT_EQ(data.body_length, 20);
  EXPECT_EQ(data.start_sample, 1u);
  EXPECT_EQ(data.row_start, tiny_data().row_start);
  ASSERT_EQ(data.samples.size(), tiny_data().samples.size());
  ASSERT_EQ(data.transitions.size(), tiny_data().transitions.size());
  static_assert(sizeof(Sample) == 64 && sizeof(Transition) == 8, "compared as bytes");
  for (std::size_t i = 0; i < data.samples.size(); ++i) {
    Sample loaded = data.samples[i];
    EXPECT_EQ(loaded.step_length, step_length(loaded.step_x, loaded.step_y));
    loaded.step_length = 0;  // not in the file
    EXPECT_EQ(std::memcmp(&loaded, &tiny_data().samples[i], sizeof loaded), 0) << i;
  }
  EXPECT_EQ(std::memcmp(data.transitions.data(), tiny_data().transitions.data(),
                        8 * data.transitions.size()),
            0);
  for (std::size_t m = 0; m < 2; ++m) {
    EXPECT_EQ(data.modes[m].name, tiny_data().modes[m].name);
    EXPECT_EQ(data.modes[m].alpha, tiny_data().modes[m].alpha);
    EXPECT_EQ(data.modes[m].table_of, tiny_data().modes[m].table_of);
    EXPECT_EQ(data.modes[m].residual, tiny_data().modes[m].residual);
    EXPECT_EQ(data.modes[m].next, tiny_data().modes[m].next);
    EXPECT_EQ(data.modes[m].go, tiny_data().modes[m].go);
    EXPECT_EQ(data.modes[m].arrived, tiny_data().modes[m].arrived);
    EXPECT_EQ(data.modes[m].by_state, m == 1);
    EXPECT_EQ(data.modes[m].plays_through, m == 1);
    EXPECT_EQ(data.modes[m].turn_w1, tiny_data().modes[m].turn_w1);
    EXPECT_EQ(data.modes[m].bend_sin, tiny_data().modes[m].bend_sin);
    EXPECT_EQ(data.modes[m].served_headings, 0xFFu);
  }
}

TEST(Pack, GivesBackEveryPicturePremultiplied) {
  const Sprite sprite = *testing::load_bytes(tiny_pack_bytes());
  Image image;
  for (std::uint32_t i = 0; i < testing::kTinySamples; ++i) {
    ASSERT_TRUE(sprite.decode_frame(i, image));
    Image due = testing::tiny_picture(tiny_data(), i);
    if (i == 0) due = {};  // not kept
    premultiply(due);
    ASSERT_EQ(image.rgba, due.rgba) << "sample " << i;
    ASSERT_EQ(image.width, due.width);
  }
}

TEST(Pack, TheSameInputGivesTheSameBytesAndTheyAreValid) {
  const testing::TempFolder folder;
  ASSERT_TRUE(save_tiny(folder.file("a.vsp")));
  EXPECT_EQ(testing::read_bytes(folder.file("a.vsp")), tiny_pack_bytes());
  EXPECT_TRUE(testing::verify_bytes(tiny_pack_bytes()).empty());
  EXPECT_EQ(testing::PackParts::split(tiny_pack_bytes()).join(), tiny_pack_bytes());
}

TEST(Pack, InfoListsTheSections) {
  const testing::TempFolder folder;
  ASSERT_TRUE(save_tiny(folder.file("a.vsp")));
  const auto info = read_pack_info(folder.file("a.vsp"));
  ASSERT_TRUE(info) << info.error().message;
  EXPECT_EQ(info->major, 1);
  EXPECT_EQ(info->minor, 0);
  EXPECT_EQ(info->bytes, tiny_pack_bytes().size());
  std::string names;
  for (const PackSection& section : info->sections) names += section.name + " ";
  EXPECT_EQ(names, "META SAMP TRAN CTRL CTRL FIDX FRAM ");
}

TEST(Pack, UnknownSectionsAreSkippedButTheirSumIsVerified) {
  auto parts = testing::PackParts::split(tiny_pack_bytes());
  parts.parts.insert(parts.parts.begin() + 2, {"XTRA", {1, 2, 3}});
  ByteVector bytes = parts.join();
  EXPECT_TRUE(testing::load_bytes(bytes));
  EXPECT_TRUE(testing::verify_bytes(bytes).empty());
  const auto xtra = testing::get_at<std::uint64_t>(bytes, 64 + 2 * 32 + 8);
  bytes[xtra] ^= 1;
  ASSERT_EQ(testing::verify_bytes(bytes).size(), 1u);
  EXPECT_EQ(testing::verify_bytes(bytes)[0].section, "XTRA");
}

TEST(Pack, EveryPrefixIsRefusedAndSoIsOneByteMore) {
  const ByteVector& bytes = tiny_pack_bytes();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::span<const std::uint8_t> prefix(bytes.data(), size);
    ASSERT_FALSE(testing::load_bytes(prefix)) << size;
    ASSERT_FALSE(testing::verify_bytes(prefix).empty()) << size;
  }
  ByteVector longer = bytes;
  longer.push_back(0);
  EXPECT_FALSE(testing::load_bytes(longer));
}

TEST(Pack, ANewerMinorVersionWithSectionsOfOtherVersionsIsRead) {
  auto parts = testing::PackParts::split(tiny_pack_bytes());
  parts.parts.insert(parts.parts.begin(), {"XTRA", {1, 2, 3}});
  ByteVector bytes = parts.join();
  testing::put_at(bytes, 10, std::uint16_t{7});
  testing::put_at(bytes, 64 + 4, std::uint16_t{9});
  testing::put_at(bytes, 64 + 6, std::uint16_t{3});
  testing::seal_header(bytes);
  EXPECT_TRUE(testing::load_bytes(bytes));
  EXPECT_TRUE(testing::verify_bytes(bytes).empty());
}

TEST(Pack, OtherMajorVersionsAreRefusedWithAWayOut) {
  for (auto [major, minor, way_out] :
       {std::tuple{0, 0, "rebuild it with `vsprite build`"},
        {0, 2, "rebuild it with `vsprite build`"},
        {2, 0, "get a newer vsprite, or build the pack with this one"},
        {256, 1, "get a newer vsprite, or build the pack with this one"}}) {
    ByteVector bytes = tiny_pack_bytes();
    testing::put_at(bytes, 8, static_cast<std::uint16_t>(major));
    testing::put_at(bytes, 10, static_cast<std::uint16_t>(minor));
    const auto sprite = testing::load_bytes(bytes);
    ASSERT_FALSE(sprite);
    EXPECT_EQ(sprite.error().code, ErrorCode::UnsupportedVersion);
    EXPECT_EQ(sprite.error().message, "tiny.vsp: pack version " + std::to_string(major) + "." +
                                          std::to_string(minor) +
                                          ", this build reads 1.0 to 1.x: " + way_out);
  }
}

TEST(Pack, NamesFilesThatCannotBeOpened) {
  const testing::TempFolder folder;
  const auto none = load_pack(folder.file("none.vsp"));
  EXPECT_EQ(none.error().code, ErrorCode::NotFound);
  EXPECT_EQ(none.error().message, folder.file("none.vsp") + ": no such file");
  EXPECT_EQ(load_pack(folder.path()).error().code, ErrorCode::CannotRead);
  ASSERT_EQ(::mkfifo(folder.file("pipe.vsp").c_str(), 0600), 0);
  EXPECT_EQ(load_pack(folder.file("pipe.vsp")).error().code, ErrorCode::CannotRead);
  testing::write_bytes(folder.file("empty.vsp"), {});
  EXPECT_EQ(load_pack(folder.file("empty.vsp")).error().code, ErrorCode::BadFormat);
}

TEST(Pack, AFileCutShortInUseCostsPicturesNotTheProcess) {
  const testing::TempFolder folder;
  ASSERT_TRUE(save_tiny(folder.file("a.vsp")));
  const Sprite sprite = *load_pack(folder.file("a.vsp"));
  ASSERT_EQ(::truncate(folder.file("a.vsp").c_str(), 100), 0);
  Image image;
  const auto decoded = sprite.decode_frame(50, image);
  ASSERT_FALSE(decoded);
  EXPECT_EQ(decoded.error().code, ErrorCode::CannotRead);
  Actor actor = make_actor(sprite);
  for (int tick = 0; tick < 100; ++tick) step(sprite, actor);
}

TEST(Pack, AReplacedFileDoesNotDisturbALoadedSprite) {
  const testing::TempFolder folder;
  ASSERT_TRUE(save_tiny(folder.file("a.vsp")));
  const Sprite sprite = *load_pack(folder.file("a.vsp"));
  testing::write_bytes(folder.file("b.vsp"), {1, 2, 3});
  ASSERT_EQ(::rename(folder.file("b.vsp").c_str(), folder.file("a.vsp").c_str()), 0);
  Image image;
  EXPECT_TRUE(sprite.decode_frame(50, image));
}

TEST(Pack, ManyThreadsMayDecodeAtOnce) {
  const Sprite sprite = *testing::load_bytes(tiny_pack_bytes());
  std::vector<std::thread> threads;
  std::array<int, 4> good{};
  for (std::size_t t = 0; t < good.size(); ++t) {
    threads.emplace_back([&, t] {
      Image image;
      for (std::uint32_t i = 1; i < testing::kTinySamples; ++i) {
        good[t] += sprite.decode_frame(i, image).has_value();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(good, (std::array<int, 4>{102, 102, 102, 102}));
}

TEST(Pack, AFailedSaveLeavesTheOldFileAndNothingElse) {
  const testing::TempFolder folder;
  testing::write_bytes(folder.file("a.vsp"), {1, 2, 3});
  const auto saved = save_pack(folder.file("a.vsp"), tiny_data(), [](std::uint32_t sample) {
    if (sample == 40)
      return Result<Image>(Error{ErrorCode::CannotRead, "sprites/000040.png: gone"});
    return Result<Image>(testing::tiny_picture(tiny_data(), sample));
  });
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().message, "sprites/000040.png: gone");
  EXPECT_EQ(testing::read_bytes(folder.file("a.vsp")), (ByteVector{1, 2, 3}));
  EXPECT_EQ(folder.count(), 1u);
}

TEST(Pack, RefusesAPictureOfAnotherSize) {
  const testing::TempFolder folder;
  const auto saved = save_pack(folder.file("a.vsp"), tiny_data(), [](std::uint32_t) {
    return Result<Image>(Image{1, 1, {0, 0, 0, 0}});
  });
  EXPECT_EQ(saved.error().code, ErrorCode::CorruptData);
  EXPECT_EQ(saved.error().message,
            folder.file("a.vsp") + ": picture of sample 1 is 1 x 1, 23 x 21 is due");
  EXPECT_EQ(folder.count(), 0u);
}

TEST(Pack, AFullDiskIsASentence) {
  const testing::TempFolder folder;
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{20'000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto saved = save_tiny(folder.file("a.vsp"));
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().code, ErrorCode::CannotWrite);
  EXPECT_NE(saved.error().message.find("File too large"), std::string::npos)
      << saved.error().message;
  EXPECT_EQ(folder.count(), 0u);
}

TEST(Pack, WhatAKilledWriterLeftBehindIsRemoved) {
  const testing::TempFolder folder;
  const std::string mine = folder.file("a.vsp.tmp." + std::to_string(::getpid()) + ".9999");
  testing::write_bytes(folder.file("a.vsp.tmp.2147483646.0"), {1});
  testing::write_bytes(folder.file("a.vsp.tmp.notes"), {1});
  testing::write_bytes(mine, {1});
  ASSERT_TRUE(save_tiny(folder.file("a.vsp")));
  EXPECT_EQ(folder.count(), 3u) << "the pack, the notes and the temporary of a living process";
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.vsp.tmp.2147483646.0")));
}

TEST(Pack, AMissingFolderCannotBeCreatedIn) {
  const testing::TempFolder folder;
  const auto saved = save_tiny(folder.file("none/a.vsp"));
  EXPECT_EQ(saved.error().code, ErrorCode::CannotCreate);
  EXPECT_NE(saved.error().message.find("No such file or directory"), std::string::npos);
}

}  // namespace
}  // namespace vsprite
