// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "frame_codec.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vsprite {
namespace {

using detail::FrameCodec;

// A grainy disc with a soft edge and holes, premultiplied.
Image grainy_disc(int width, int height, std::uint64_t seed) {
  Image image{width, height, {}};
  std::uint64_t state = seed * 2654435761u + 1;
  const auto noise = [&] {
    return (state = state * 6364136223846793005u + 1442695040888963407u) >> 56;
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int dx = 2 * x - width, dy = 2 * y - height, radius = std::min(width, height);
      const int inside = std::clamp((radius * radius - dx * dx - dy * dy) / 4, 0, 255);
      const auto alpha = noise() < 12 ? 0u : static_cast<unsigned>(inside);
      for (unsigned base : {200u, 120u, 40u})
        image.rgba.push_back(static_cast<std::uint8_t>(alpha * (base + noise() % 30) / 255));
      image.rgba.push_back(static_cast<std::uint8_t>(alpha));
    }
  }
  return image;
}

std::vector<Image> pictures() {
  std::vector<Image> all;
  for (int side : {1, 2, 7, 8, 15, 16, 17, 31, 64, 100, 255, 256, 300}) {
    all.push_back(grainy_disc(side, 65 - std::min(side, 64), static_cast<unsigned>(side)));
    all.push_back(grainy_disc(side, side, static_cast<unsigned>(side)));
  }
  Image noise = grainy_disc(77, 33, 5);
  for (std::size_t i = 0; i < noise.rgba.size(); ++i)
    noise.rgba[i] = static_cast<std::uint8_t>(i * i * 2654435761u >> 7);
  all.push_back(noise);  // no premultiplied picture at all, and yet exact
  all.push_back({40, 30, std::vector<std::uint8_t>(4800, 0)});
  all.push_back({40, 30, std::vector<std::uint8_t>(4800, 255)});
  return all;
}

bool decode(FrameCodec& codec, std::span<const std::uint8_t> bytes, int width, int height,
            Image& image) {
  const std::vector<std::uint8_t> kept(bytes.begin(), bytes.end());
  const auto to = codec.input(kept.size());
  std::copy(kept.begin(), kept.end(), to.begin());
  return codec.decode(width, height, image);
}

TEST(FrameCodec, GivesBackEveryPictureExactlyWithEveryInstructionSet) {
  FrameCodec codec;
  const auto targets = detail::frame_targets();
  ASSERT_GE(targets.size(), 2u) << "plain loops and at least one other";
  for (int target = -1; target < static_cast<int>(targets.size()); ++target) {
    detail::use_frame_target(target);
    Image out;
    for (const Image& picture : pictures()) {
      ASSERT_TRUE(decode(codec, codec.encode(picture), picture.width, picture.height, out));
      ASSERT_EQ(out.rgba, picture.rgba) << picture.width << " x " << picture.height;
    }
  }
  detail::use_frame_target(-1);
}

TEST(FrameCodec, ATrimmedPictureHoldsNoMarginsAndIsMadeWholeAgain) {
  FrameCodec codec;
  for (const Image& picture : pictures()) {
    const auto encoded = codec.encode(picture);
    const std::vector<std::uint8_t> bytes(encoded.begin(), encoded.end());
    std::copy(bytes.begin(), bytes.end(), codec.input(bytes.size()).begin());
    detail::TrimmedImage trimmed;
    ASSERT_TRUE(codec.decode(picture.width, picture.height, trimmed));
    ASSERT_LE(trimmed.rgba.size(), picture.rgba.size());
    Image whole{3, 3, std::vector<std::uint8_t>(36, 7)};  // what it held is gone
    detail::expand(trimmed, whole);
    ASSERT_EQ(whole.rgba, picture.rgba) << picture.width << " x " << picture.height;
    ASSERT_EQ(whole.width, picture.width);
    ASSERT_EQ(whole.height, picture.height);
  }
}

TEST(FrameCodec, TransparentPicturesCostAByteARow) {
  FrameCodec codec;
  EXPECT_EQ(codec.encode({200, 90, std::vector<std::uint8_t>(72000, 0)}).size(), 94u);
}

TEST(FrameCodec, EveryPrefixOneByteMoreAndAnotherSizeAreRefused) {
  FrameCodec codec;
  const Image picture = grainy_disc(30, 22, 3);
  const auto encoded = codec.encode(picture);
  std::vector<std::uint8_t> bytes(encoded.begin(), encoded.end());
  Image out;
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_FALSE(decode(codec, std::span(bytes).first(size), 30, 22, out)) << size;
  EXPECT_FALSE(decode(codec, bytes, 30, 23, out));
  EXPECT_FALSE(decode(codec, bytes, 12, 22, out));
  EXPECT_TRUE(decode(codec, bytes, 30, 22, out));
  bytes.push_back(0);
  EXPECT_FALSE(decode(codec, bytes, 30, 22, out));
}

}  // namespace
}  // namespace vsprite
