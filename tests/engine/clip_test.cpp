// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/clip.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "support/temp_folder.h"
#include "support/tiny_sprite.h"
#include "vsprite/compose.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

using testing::tiny_sample;

PackClip turn() {
  return {.name = "turn",
          .start = {5 * kFixedOne, 7 * kFixedOne},
          .samples = {tiny_sample(0, 1), tiny_sample(0, 2), tiny_sample(0, 3), tiny_sample(1, 3)}};
}
// A pack of the tiny sprite in `folder`.
std::string tiny_pack(const testing::TempFolder& folder) {
  const SpriteData data = testing::tiny_sprite_data();
  const std::string path = folder.file("tiny.vsp");
  const auto picture = [&](std::uint32_t i) -> Result<Image> {
    return make_image(data.samples[i].width, data.samples[i].height, 9, 9, 9, 255);
  };
  EXPECT_TRUE(save_pack(path, data, picture));
  return path;
}
std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(PackClip, ComesBackAsItWasSavedAndThePackStaysWhole) {
  const testing::TempFolder folder;
  const std::string plain = tiny_pack(folder), with = folder.file("with.vsp");
  const std::vector<PackClip> clips = {turn(), {"rest", {}, {testing::kTinyFirstIdle}}};
  ASSERT_TRUE(save_clips(plain, with, clips));
  const auto sprite = load_pack(with);
  ASSERT_TRUE(sprite) << sprite.error().message;
  const auto loaded = load_clips(with, *sprite);
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->size(), 2u);
  EXPECT_EQ((*loaded)[0].name, "turn");
  EXPECT_EQ((*loaded)[0].start, turn().start);
  EXPECT_EQ((*loaded)[0].samples, turn().samples);
  EXPECT_EQ((*loaded)[1].samples, clips[1].samples);
  EXPECT_TRUE(verify_pack(with)->empty());
}

TEST(PackClip, TakingTheClipsAwayGivesTheOldBytes) {
  const testing::TempFolder folder;
  const std::string plain = tiny_pack(folder), with = folder.file("with.vsp");
  const std::vector<PackClip> clips = {turn()};
  ASSERT_TRUE(save_clips(plain, with, clips));
  ASSERT_TRUE(save_clips(with, with, {}));
  EXPECT_EQ(bytes_of(plain), bytes_of(with));
  EXPECT_TRUE(load_clips(plain, testing::tiny_sprite())->empty());
}

TEST(PackClip, PlaysSampleBySampleAndStopsAtItsEnd) {
  const Sprite sprite = testing::tiny_sprite();
  const PackClip clip = turn();
  ClipPlayer player = start_clip(clip);
  Position due = clip.start;
  for (std::size_t k = 0; k < clip.samples.size(); ++k) {
    const Sample& s = sprite.samples()[clip.samples[k]];
    for (int tick = 0; tick < s.duration; ++tick) {
      EXPECT_EQ(clip.samples[player.index], clip.samples[k]);
      EXPECT_EQ(player.position, due);
      due = {due.x + s.step_x, due.y + s.step_y};
      const bool is_last = k + 1 == clip.samples.size() && tick + 1 == s.duration;
      EXPECT_EQ(step(sprite, clip, player), !is_last);
    }
  }
}

TEST(PackClip, RefusesWhatItCouldNotPlay) {
  const testing::TempFolder folder;
  const std::string plain = tiny_pack(folder), with = folder.file("with.vsp");
  const auto refused = [&](PackClip clip, std::size_t copies = 1) {
    const std::vector<PackClip> clips(copies, clip);
    const auto saved = save_clips(plain, with, clips);
    return !saved && saved.error().code == ErrorCode::CorruptData && !std::filesystem::exists(with);
  };
  EXPECT_TRUE(refused({"none", {}, {}}));
  EXPECT_TRUE(refused({"", {}, {1}}));
  EXPECT_TRUE(refused({"lost", {}, {0}}));  // not a kept sample
  EXPECT_TRUE(refused({"far", {}, {testing::kTinySamples}}));
  EXPECT_TRUE(refused(turn(), 2));  // one name
}

TEST(PackClip, EveryChangedByteIsFound) {
  const testing::TempFolder folder;
  const std::string plain = tiny_pack(folder), with = folder.file("with.vsp");
  const std::vector<PackClip> clips = {turn()};
  ASSERT_TRUE(save_clips(plain, with, clips));
  const Sprite sprite = testing::tiny_sprite();
  std::string bytes = bytes_of(with);
  const std::uint64_t first = read_pack_info(with)->sections.back().offset;
  for (std::uint64_t at = first; at < bytes.size(); ++at) {
    std::string bad = bytes;
    bad[at] = static_cast<char>(bad[at] ^ 1);
    std::ofstream(folder.file("bad.vsp"), std::ios::binary) << bad;
    EXPECT_FALSE(load_clips(folder.file("bad.vsp"), sprite)) << at;
  }
}

}  // namespace
}  // namespace vsprite
