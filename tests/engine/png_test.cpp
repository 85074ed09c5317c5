// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "support/temp_folder.h"
#include "support/tiny_sprite.h"
#include "vsprite/image.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;
using testing::read_bytes;

const std::string kSuite = VSPRITE_SOURCE_DIR "/../shared/pngsuite/";

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kSuite + folder)) {
    names.push_back(entry.path().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// A JSON array of whole numbers.
std::vector<int> read_numbers(const std::string& path) {
  const auto bytes = read_bytes(path);
  std::vector<int> numbers;
  const char* at = reinterpret_cast<const char*>(bytes.data());
  const char* end = at + bytes.size();
  while (at < end) {
    if (*at < '0' || *at > '9') {
      ++at;
      continue;
    }
    int value = 0;
    for (; at < end && *at >= '0' && *at <= '9'; ++at) value = 10 * value + (*at - '0');
    numbers.push_back(value);
  }
  return numbers;
}

int largest_difference(const Image& image, const std::vector<int>& due) {
  if (image.rgba.size() != due.size()) return 256;
  int most = 0;
  const bool deep = *std::max_element(due.begin(), due.end()) > 255;
  for (std::size_t i = 0; i < due.size(); ++i) {
    most = std::max(most, std::abs(image.rgba[i] - (deep ? due[i] * 255 / 65535 : due[i])));
  }
  return most;
}

TEST(Png, ReadsAllOfPngSuiteAndRefusesItsBrokenFiles) {
  if (!fs::exists(kSuite)) GTEST_SKIP() << kSuite << " is not there";
  int valid = 0, refused = 0;
  for (const std::string& path : files_in("png")) {
    const std::string name = fs::path(path).stem();
    const auto image = read_png(path);
    if (name[0] == 'x') {
      EXPECT_FALSE(image) << name;
      refused += !image;
      continue;
    }
    ASSERT_TRUE(image) << image.error().message;
    const std::string eight_bit = kSuite + "json/" + name + "_to8.json";
    const auto due =
        read_numbers(fs::exists(eight_bit) ? eight_bit : kSuite + "json/" + name + ".json");
    const bool deep = name.substr(name.size() - 2) == "16";  // 16 bits a channel are scaled
    EXPECT_LE(largest_difference(*image, due), deep ? 1 : 0) << name;
    ++valid;
  }
  EXPECT_EQ(valid, 161);
  EXPECT_EQ(refused, 14);
}

TEST(Png, ReadsOrRefusesWhatOnceBrokeReaders) {
  if (!fs::exists(kSuite)) GTEST_SKIP() << kSuite << " is not there";
  int read = 0, refused = 0;
  for (const std::string& path : files_in("testpngs")) {
    if (fs::path(path).extension() != ".png") continue;
    EXPECT_TRUE(read_png(path)) << path;
  }
  for (const std::string& path : files_in("crashers")) {
    if (fs::path(path).extension() != ".png") continue;
    const auto image = read_png(path);
    ++(image ? read : refused);
    EXPECT_TRUE(image || image.error().message.find(path) == 0) << path;
  }
  EXPECT_GE(refused, 22);
  EXPECT_LE(read, 1);
}

Image noise(int width, int height) {
  std::mt19937 random(7);
  Image image{width, height, {}};
  image.rgba.resize(std::size_t{4} * static_cast<std::size_t>(width * height));
  for (auto& byte : image.rgba) byte = static_cast<std::uint8_t>(random() >> 24);
  return image;
}

TEST(Png, RoundTripIsExactAlsoWhereAlphaIsZero) {
  for (const Image& image : {noise(1, 1), noise(37, 5), noise(64, 64)}) {
    const auto bytes = encode_png(image);
    ASSERT_TRUE(bytes);
    const auto again = decode_png(*bytes, "round trip");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->rgba, image.rgba);
    EXPECT_EQ(*encode_png(*again), *bytes) << "the same pixels give the same bytes";
  }
}

TEST(Png, WritesAPartOfALargerPicture) {
  const Image image = noise(16, 16);
  const ImageView part(image.rgba.data() + 4 * (3 * 16 + 2), 5, 4, 64);
  const auto again = decode_png(*encode_png(part), "part");
  ASSERT_TRUE(again);
  EXPECT_EQ(again->width, 5);
  EXPECT_EQ(again->height, 4);
  EXPECT_EQ(again->rgba[0], image.rgba[4 * (3 * 16 + 2)]);
}

TEST(Png, EveryPrefixIsRefused) {
  const auto bytes = *encode_png(noise(9, 9));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ASSERT_FALSE(decode_png({bytes.data(), size}, "prefix")) << size << " of " << bytes.size();
  }
}

TEST(Png, NamesFileAndReason) {
  const testing::TempFolder folder;
  EXPECT_EQ(read_png(folder.file("none.png")).error().code, ErrorCode::NotFound);
  EXPECT_EQ(read_png(folder.path()).error().code, ErrorCode::CannotRead);
  testing::write_bytes(folder.file("text.png"), {'h', 'e', 'l', 'l', 'o'});
  const auto text = read_png(folder.file("text.png"));
  EXPECT_EQ(text.error().code, ErrorCode::BadFormat);
  EXPECT_EQ(text.error().message, folder.file("text.png") + ": not a PNG file");
}

// A header may claim 65,535 x 65,535 pixels; no memory is taken on its word.
TEST(Png, RefusesSizesThatItsBytesCannotHold) {
  auto bytes = *encode_png(noise(4, 4));
  const auto claim = [&](std::uint8_t high, std::uint8_t low) {
    bytes[18] = bytes[22] = high;
    bytes[19] = bytes[23] = low;
    bytes[29] = bytes[30] = bytes[31] = bytes[32] = 0;  // the checksum, to be made right
    std::uint32_t crc = 0xFFFFFFFFu;
    for (std::size_t i = 12; i < 29; ++i) {
      crc ^= bytes[i];
      for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? (crc >> 1) ^ 0xEDB88320u : crc >> 1;
    }
    for (int i = 0; i < 4; ++i)
      bytes[static_cast<std::size_t>(29 + i)] = static_cast<std::uint8_t>(~crc >> (24 - 8 * i));
  };
  claim(0x20, 0);
  EXPECT_EQ(decode_png(bytes, "claim").error().code, ErrorCode::CorruptData);
  claim(0xFF, 0xFF);
  EXPECT_EQ(decode_png(bytes, "claim").error().code, ErrorCode::LimitExceeded);
}

}  // namespace
}  // namespace vsprite
