// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// A pack of 100,000 samples, whose tables are read and checked by two threads where there are two.
#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "support/pack_bytes.h"
#include "support/plain_actor.h"
#include "vsprite/compose.h"

namespace vsprite {
namespace {

using testing::ByteVector;

constexpr std::uint32_t kSamples = 100'000;

const ByteVector& large_pack_bytes() {
  static const ByteVector bytes = [] {
    const testing::TempFolder folder;
    const auto saved = save_pack(
        folder.file("large.vsp"), testing::long_sprite_data(kSamples), [](std::uint32_t i) {
          return Result<Image>(make_image(2, 2, static_cast<std::uint8_t>(i), 0, 0));
        });
    return saved ? testing::read_bytes(folder.file("large.vsp")) : ByteVector();
  }();
  return bytes;
}

TEST(LargePack, ComesBackAsItWasWrittenAndIsSound) {
  const Sprite sprite = *testing::load_bytes(large_pack_bytes());
  const SpriteData& is = sprite.data();
  const SpriteData due = testing::long_sprite_data(kSamples);
  EXPECT_EQ(is.row_start, due.row_start);
  ASSERT_EQ(is.transitions.size(), due.transitions.size());
  for (std::size_t k = 0; k < due.transitions.size(); ++k) {
    ASSERT_EQ(is.transitions[k].to, due.transitions[k].to);
    ASSERT_EQ(is.transitions[k].cost, due.transitions[k].cost);
  }
  EXPECT_EQ(is.modes[0].next, due.modes[0].next);
  EXPECT_EQ(is.modes[0].go, due.modes[0].go);
  EXPECT_TRUE(testing::verify_bytes(large_pack_bytes()).empty());
}

// By every sample once round, beside an actor that is stepped by the tables themselves.
TEST(LargePack, StepsThroughAllItsSamplesAndDrawsThem) {
  const Sprite sprite = *testing::load_bytes(large_pack_bytes());
  Actor actor = make_actor(sprite, {}, 0, 0), plain = actor;
  set_direction(sprite, actor, Direction::Right);
  set_direction(sprite, plain, Direction::Right);
  Image canvas = make_checkerboard(8, 8), picture;
  std::set<std::uint32_t> shown;
  for (std::uint32_t tick = 0; tick < kSamples + 10; ++tick) {
    step(sprite, actor);
    testing::plain_tick(sprite, plain);
    ASSERT_EQ(std::memcmp(&actor, &plain, sizeof actor), 0) << tick;
    shown.insert(actor.sample);
    if (tick % 1000 != 0) continue;
    ASSERT_TRUE(sprite.decode_frame(actor.sample, picture));
    draw_sample(canvas, picture, sprite.samples()[actor.sample], {4, 4});
    ASSERT_EQ(ImageView(canvas).pixel(4, 4)[0], static_cast<std::uint8_t>(actor.sample));
  }
  EXPECT_EQ(shown.size(), kSamples);
}

TEST(LargePack, NamesTheFirstFaultOfEitherHalf) {
  const auto refusal = [](std::initializer_list<std::uint32_t> samples) {
    SpriteData data = testing::long_sprite_data(kSamples);
    for (const std::uint32_t i : samples) data.modes[0].next[i] = (i + 500) % kSamples;
    return make_sprite(std::move(data)).error().message;
  };
  EXPECT_NE(refusal({25'000}).find("sample 25000"), std::string::npos) << refusal({25'000});
  EXPECT_NE(refusal({99'999}).find("sample 99999"), std::string::npos);
  EXPECT_NE(refusal({30'000, 70'000}).find("sample 30000"), std::string::npos);
}

TEST(LargePack, AnyFlippedByteOfItsTablesIsFound) {
  ByteVector bytes = large_pack_bytes();
  for (std::size_t section = 0; section < testing::get_at<std::uint32_t>(bytes, 12); ++section) {
    const std::size_t entry = detail::kHeaderBytes + section * detail::kEntryBytes;
    const std::string name(bytes.begin() + static_cast<std::ptrdiff_t>(entry),
                           bytes.begin() + static_cast<std::ptrdiff_t>(entry) + 4);
    if (name == "FRAM") continue;  // checked picture by picture
    const auto at = testing::get_at<std::uint64_t>(bytes, entry + 8);
    const auto size = testing::get_at<std::uint64_t>(bytes, entry + 16);
    for (const std::uint64_t k : {std::uint64_t{0}, size / 3, size - 1}) {
      bytes[at + k] ^= 0x10;
      const auto loaded = testing::load_bytes(bytes);
      bytes[at + k] ^= 0x10;
      ASSERT_FALSE(loaded) << name << " " << k;
      EXPECT_NE(loaded.error().message.find(name + ": the section's sum"), std::string::npos)
          << loaded.error().message;
    }
  }
}

// It may be a script's function, which no other thread may call.
TEST(LargePack, ACallersReaderIsCalledByTheThreadThatOpens) {
  std::set<std::thread::id> callers;
  const ByteVector& bytes = large_pack_bytes();
  const auto loaded = load_pack({bytes.size(), "reader", [&](std::uint64_t from, auto out) {
                                   callers.insert(std::this_thread::get_id());
                                   std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(from),
                                               out.size(), out.begin());
                                   return true;
                                 }});
  ASSERT_TRUE(loaded);
  EXPECT_EQ(callers, std::set{std::this_thread::get_id()});
}

}  // namespace
}  // namespace vsprite
