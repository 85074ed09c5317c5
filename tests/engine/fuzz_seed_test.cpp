// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Seeds of the pack fuzzer that the pack's own writer makes: a sprite of three samples with the
// parts that a pack may lack. They follow the writer: VSPRITE_UPDATE_GOLDEN=1 writes them anew.
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/pack_bytes.h"
#include "vsprite/compose.h"
#include "vsprite/shadow.h"

namespace vsprite {
namespace {

SpriteData three_samples() {
  SpriteData data = testing::long_sprite_data(3);
  for (Sample& s : data.samples) {
    s.width = 9;
    s.height = 7;
    s.anchor = {4.5f, 3.5f};
  }
  return data;
}

// What the committed seed holds, where it is what the writer writes; else nothing.
Result<Sprite> seed(const std::string& name, const SpriteData& data, PictureForm form) {
  const std::string committed = std::string(VSPRITE_SOURCE_DIR) + "/tests/fuzz/corpus/pack/" + name;
  const testing::TempFolder folder;
  const bool update = std::getenv("VSPRITE_UPDATE_GOLDEN") != nullptr;
  const std::string written = update ? committed : folder.file(name);
  const auto picture = [&](std::uint32_t i) -> Result<Image> {
    return testing::tiny_picture(data, i);
  };
  if (auto saved = save_pack(written, data, picture, {}, form); !saved) return saved.error();
  const testing::ByteVector bytes = testing::read_bytes(committed);
  EXPECT_LE(bytes.size(), 4096u);
  if (bytes != testing::read_bytes(written))
    return Error{ErrorCode::CorruptData, committed + " is not what save_pack writes"};
  EXPECT_TRUE(testing::verify_bytes(bytes).empty());
  return load_pack(committed);
}

TEST(FuzzSeeds, PicturesForTheGpuAreWhatThePackWriterWrites) {
  const auto sprite = seed("gpu-pictures", three_samples(), PictureForm::Blocks);
  ASSERT_TRUE(sprite) << sprite.error().message;
  EXPECT_TRUE(sprite->has_blocks());
}

TEST(FuzzSeeds, FilmedShadowsAreWhatThePackWriterWrites) {
  SpriteData data = three_samples();
  for (const std::uint32_t sample : {0u, 2u}) {
    Image shade = make_image(5, 4, 0, 0, 0, 0);
    for (std::size_t i = 0; i < 20; ++i)
      shade.rgba[4 * i + 3] = static_cast<std::uint8_t>(9 * i + 7 * sample);
    ASSERT_TRUE(add_shadow(data, sample, shade, {2, 1.5f}));
  }
  const auto sprite = seed("filmed-shadows", data, PictureForm::Exact);
  ASSERT_TRUE(sprite) << sprite.error().message;
  EXPECT_EQ(sprite->data().shadows.size(), 2u);
}

}  // namespace
}  // namespace vsprite
