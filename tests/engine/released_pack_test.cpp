// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// One pack of every version ever released, read for ever. A file here never changes; a new version
// of the format adds one (VSPRITE_UPDATE_GOLDEN=1 writes it, where there is none).
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "support/pack_bytes.h"
#include "vsprite/actor.h"

namespace vsprite {
namespace {

std::string released(const std::string& version) {
  return std::string(VSPRITE_SOURCE_DIR) + "/tests/packs/" + version + ".vsp";
}

// The tiny sprite with two stages in the mode of the paper and smaller pictures: fit to be kept.
SpriteData small_data() {
  SpriteData data = testing::tiny_sprite_data();
  for (Sample& s : data.samples) {
    if (s.kept == 0) continue;
    s.width = static_cast<std::uint16_t>(s.width - 14);
    s.height = static_cast<std::uint16_t>(s.height - 14);
    s.anchor = {static_cast<float>(s.width) / 2, static_cast<float>(s.height) / 2};
  }
  data.modes[0] = testing::tiny::make_mode(data, "paper", 2, false);
  return data;
}

void write_missing(const std::string& path, PictureForm form) {
  if (std::getenv("VSPRITE_UPDATE_GOLDEN") == nullptr || std::filesystem::exists(path)) return;
  const SpriteData data = small_data();
  const auto saved = save_pack(
      path, data,
      [&](std::uint32_t sample) { return Result<Image>(testing::tiny_picture(data, sample)); }, {},
      form);
  ASSERT_TRUE(saved) << saved.error().message;
}

// Of every tick of half a minute in every direction and mode.
std::uint64_t hash_of_states(const Sprite& sprite) {
  StateHash hash;
  for (int mode = 0; mode < static_cast<int>(sprite.data().modes.size()); ++mode) {
    Actor actor = make_actor(sprite, {0, 0}, 0, mode);
    for (int tick = 0; tick < 900; ++tick) {
      if (tick % 90 == 0) set_direction(sprite, actor, static_cast<Direction>(tick / 90));
      step(sprite, actor);
      hash.add(actor);
    }
  }
  return hash.digest();
}

std::uint64_t hash_of_pictures(const Sprite& sprite) {
  std::vector<std::uint8_t> all;
  Image image;
  for (std::uint32_t i = 0; i < sprite.samples().size(); ++i) {
    EXPECT_TRUE(sprite.decode_frame(i, image));
    all.insert(all.end(), image.rgba.begin(), image.rgba.end());
  }
  return detail::hash_bytes(all);
}

TEST(ReleasedPack, Version1_0IsReadForEver) {
  write_missing(released("1.0"), PictureForm::Exact);
  EXPECT_LE(std::filesystem::file_size(released("1.0")), 65536u);
  const auto issues = verify_pack(released("1.0"));
  ASSERT_TRUE(issues) << issues.error().message;
  EXPECT_TRUE(issues->empty());
  const auto sprite = load_pack(released("1.0"));
  ASSERT_TRUE(sprite) << sprite.error().message;
  EXPECT_EQ(sprite->data().name, "tiny");
  EXPECT_EQ(sprite->samples().size(), 103u);
  EXPECT_EQ(sprite->data().modes.size(), 2u);
  EXPECT_EQ(hash_of_states(*sprite), 6341516569115839497u);
  EXPECT_EQ(hash_of_pictures(*sprite), 17269800096067365075u);
}

TEST(ReleasedPack, Version1_1IsReadForEver) {
  write_missing(released("1.1"), PictureForm::Blocks);
  EXPECT_LE(std::filesystem::file_size(released("1.1")), 65536u);
  const auto issues = verify_pack(released("1.1"));
  ASSERT_TRUE(issues) << issues.error().message;
  EXPECT_TRUE(issues->empty());
  const auto info = read_pack_info(released("1.1"));
  ASSERT_TRUE(info && info->loss);
  EXPECT_EQ(info->minor, 1);
  EXPECT_NEAR(info->loss->colour, 36.8, 0.05);
  EXPECT_NEAR(info->loss->alpha, 44.9, 0.05);
  const auto sprite = load_pack(released("1.1"));
  ASSERT_TRUE(sprite) << sprite.error().message;
  EXPECT_TRUE(sprite->has_blocks());
  EXPECT_EQ(hash_of_states(*sprite), 6341516569115839497u);
  EXPECT_EQ(hash_of_pictures(*sprite), 13490897127314643463u);
}

class ReleasedPackBytes : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, ReleasedPackBytes, ::testing::Values("1.0", "1.1"));
TEST_P(ReleasedPackBytes, EveryTruncationAndEveryFlippedBitIsDetected) {
  testing::ByteVector bytes = testing::read_bytes(released(GetParam()));
  ASSERT_FALSE(bytes.empty());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_FALSE(testing::verify_bytes(std::span(bytes).first(size), 1).empty()) << size;
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    bytes[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
    ASSERT_FALSE(testing::verify_bytes(bytes, 1).empty()) << "bit " << bit;
    bytes[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
  }
}

}  // namespace
}  // namespace vsprite
