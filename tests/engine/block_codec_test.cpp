// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "block_codec.h"

#include <gtest/gtest.h>

#include <cmath>

#include "frame_codec.h"

namespace vsprite {
namespace {

using detail::kBlockBytes;

// A shaded disc with a soft edge, premultiplied.
Image shaded_disc(int width, int height) {
  Image image{width, height, {}};
  const float radius = 0.45f * static_cast<float>(std::min(width, height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float dx = static_cast<float>(x) + 0.5f - 0.5f * static_cast<float>(width);
      const float dy = static_cast<float>(y) + 0.5f - 0.5f * static_cast<float>(height);
      const float inside = (radius - std::sqrt(dx * dx + dy * dy)) / 6 + 0.5f;
      const auto alpha = static_cast<unsigned>(std::clamp(inside, 0.0f, 1.0f) * 255 + 0.5f);
      for (unsigned base : {230u, 140u, 60u}) {
        const unsigned shade = base * (60u + static_cast<unsigned>(40 * y / height)) / 100;
        image.rgba.push_back(static_cast<std::uint8_t>((shade * alpha + 127) / 255));
      }
      image.rgba.push_back(static_cast<std::uint8_t>(alpha));
    }
  }
  return image;
}

Image there_and_back(const Image& image) {
  Image out;
  detail::decode_blocks(detail::encode_blocks(image), image.width, image.height, out);
  return out;
}

std::vector<std::uint8_t> squeezed(const Image& image) {
  std::vector<std::uint8_t> out;
  detail::squeeze_blocks(detail::encode_blocks(image), out);
  return out;
}

// As the specification of S3TC has it, a texel at a time, in real numbers.
struct Texel {
  double red = 0, green = 0, blue = 0, alpha = 0;
};
Texel reference_texel(const std::uint8_t* block, int x, int y) {
  const int k = 4 * y + x;
  std::uint64_t alpha_codes = 0, color_codes = 0;
  for (int i = 7; i >= 2; --i) alpha_codes = alpha_codes << 8 | block[i];
  for (int i = 15; i >= 12; --i) color_codes = color_codes << 8 | block[i];
  const double a0 = block[0], a1 = block[1];
  const auto a = static_cast<double>(alpha_codes >> (3 * k) & 7);
  Texel out;
  if (a < 2)
    out.alpha = a < 1 ? a0 : a1;
  else if (a0 > a1)
    out.alpha = ((8 - a) * a0 + (a - 1) * a1) / 7;
  else
    out.alpha = a < 6 ? ((6 - a) * a0 + (a - 1) * a1) / 5 : a < 7 ? 0 : 255;
  const double share[4] = {0, 1, 1.0 / 3, 2.0 / 3};
  const double t = share[color_codes >> (2 * k) & 3];
  const auto end = [&](int at, unsigned shift, unsigned bits) {
    const unsigned word = block[at] | unsigned{block[at + 1]} << 8, most = (1u << bits) - 1;
    return 255.0 * (word >> shift & most) / most;
  };
  out.red = (1 - t) * end(8, 11, 5) + t * end(10, 11, 5);
  out.green = (1 - t) * end(8, 5, 6) + t * end(10, 5, 6);
  out.blue = (1 - t) * end(8, 0, 5) + t * end(10, 0, 5);
  return out;
}

double light(double encoded) {
  const double v = encoded / 255;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

TEST(BlockCodec, DecodesAsTheSpecificationOfS3tcSays) {
  const Image image = shaded_disc(37, 26);
  const auto blocks = detail::encode_blocks(image);
  const detail::BlockGrid grid(37, 26);
  Image out;
  detail::decode_blocks(blocks, 37, 26, out);
  for (int y = 0; y < 26; ++y) {
    for (int x = 0; x < 37; ++x) {
      const std::size_t block = static_cast<std::size_t>((y + 1) / 4) * grid.columns +
                                static_cast<std::size_t>((x + 1) / 4);
      const Texel due = reference_texel(&blocks[block * kBlockBytes], (x + 1) % 4, (y + 1) % 4);
      const std::uint8_t* p = &out.rgba[static_cast<std::size_t>(4 * (37 * y + x))];
      ASSERT_NEAR(p[3], due.alpha, 1.0) << x << ", " << y;
      if (p[3] < 40) continue;  // eight bits of premultiplied colour hold little there
      const double straight = light(255.0 * p[0] / p[3]) * p[3] / 255;
      ASSERT_NEAR(straight, std::min(light(due.red), p[3] / 255.0), 0.02) << x << ", " << y;
    }
  }
}

TEST(BlockCodec, LosesLittleAndNothingOfWhatIsClearOrOpaque) {
  for (const auto& [width, height] : {std::pair{64, 64}, {1, 1}, {3, 50}, {61, 5}, {40, 33}}) {
    const Image before = shaded_disc(width, height);
    const Image after = there_and_back(before);
    ASSERT_EQ(after.rgba.size(), before.rgba.size());
    detail::BlockLoss loss;
    loss.add(before, after);
    for (std::size_t i = 0; i < before.rgba.size(); i += 4) {
      const int was = before.rgba[i + 3], is = after.rgba[i + 3];
      if (was == 0 || was == 255) {
        ASSERT_EQ(is, was);
      }
      for (std::size_t c = 0; c < 3; ++c) ASSERT_LE(after.rgba[i + c], is);
    }
    const double pixels = static_cast<double>(std::max<std::uint64_t>(1, loss.pixels));
    // Seven steps between two alphas, three between two colours: an edge all over loses no more than
    // rounding to them. What has an inside loses 34 dB.
    const bool is_edge = std::min(width, height) < 12;
    EXPECT_LT(static_cast<double>(loss.colour) / (3 * pixels), is_edge ? 85.0 * 85 / 12 : 25);
    EXPECT_LT(static_cast<double>(loss.alpha) / pixels, is_edge ? 36.5 * 36.5 / 12 : 25);
  }
}

TEST(BlockCodec, NoPictureOfNoiseMakesAColourGreaterThanItsAlpha) {
  Image noise{30, 30, std::vector<std::uint8_t>(3600)};
  for (std::size_t i = 0; i < noise.rgba.size(); ++i)
    noise.rgba[i] = static_cast<std::uint8_t>(i * i * 2654435761u >> 9);
  premultiply(noise);
  const Image after = there_and_back(noise);
  for (std::size_t i = 0; i < after.rgba.size(); ++i)
    ASSERT_LE(after.rgba[i], after.rgba[i | 3]) << i;
}

TEST(BlockCodec, TheStoredFormGivesBackEveryBlock) {
  for (int side : {1, 2, 3, 6, 7, 33, 64, 100}) {
    const Image image = shaded_disc(side, side + 3);
    const auto blocks = detail::encode_blocks(image);
    std::vector<std::uint8_t> again;
    ASSERT_TRUE(detail::unsqueeze_blocks(squeezed(image), side, side + 3, again));
    ASSERT_EQ(again, blocks) << side;
  }
  const Image clear{100, 100, std::vector<std::uint8_t>(40000)};
  EXPECT_EQ(squeezed(clear).size(), 1u + (26 * 26 + 3) / 4);
}

TEST(BlockCodec, EveryPrefixOneByteMoreAndAnotherSizeAreRefused) {
  auto bytes = squeezed(shaded_disc(30, 22));
  std::vector<std::uint8_t> blocks;
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_FALSE(detail::unsqueeze_blocks(std::span(bytes).first(size), 30, 22, blocks)) << size;
  EXPECT_FALSE(detail::unsqueeze_blocks(bytes, 30, 27, blocks));
  EXPECT_FALSE(detail::unsqueeze_blocks(bytes, 12, 22, blocks));
  EXPECT_TRUE(detail::unsqueeze_blocks(bytes, 30, 22, blocks));
  bytes.push_back(0);
  EXPECT_FALSE(detail::unsqueeze_blocks(bytes, 30, 22, blocks));
}

TEST(BlockCodec, AnUnknownKindAndBitsBeyondTheLastBlockAreRefused) {
  std::vector<std::uint8_t> blocks;
  const std::vector<std::uint8_t> clear{detail::kBlockForm, 0};
  EXPECT_TRUE(detail::unsqueeze_blocks(clear, 2, 2, blocks));  // one block
  EXPECT_FALSE(
      detail::unsqueeze_blocks(std::vector<std::uint8_t>{detail::kBlockForm, 3}, 2, 2, blocks));
  EXPECT_FALSE(
      detail::unsqueeze_blocks(std::vector<std::uint8_t>{detail::kBlockForm, 4}, 2, 2, blocks));
  EXPECT_FALSE(detail::unsqueeze_blocks(std::vector<std::uint8_t>{1, 0}, 2, 2, blocks));
}

// What the frame codec is handed by a pack of either form.
TEST(BlockCodec, TheFrameCodecTellsTheFormsApart) {
  const Image image = shaded_disc(20, 30);
  const auto bytes = squeezed(image);
  detail::FrameCodec codec;
  const auto fill = [&] {
    std::copy(bytes.begin(), bytes.end(), codec.input(bytes.size()).begin());
  };
  Image whole, expanded;
  detail::TrimmedImage trimmed;
  fill();
  ASSERT_TRUE(codec.decode(20, 30, whole));
  fill();
  ASSERT_TRUE(codec.decode(20, 30, trimmed));
  EXPECT_EQ(trimmed.blocks, detail::encode_blocks(image));
  detail::expand(trimmed, expanded);
  EXPECT_EQ(expanded.rgba, whole.rgba);
  EXPECT_EQ(whole.rgba, there_and_back(image).rgba);
}

}  // namespace
}  // namespace vsprite
