// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// What other keyers and renderers write: pictures in a row, alpha of their own, a matte beside.
#include "film/source.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "film/matte.h"
#include "film/video.h"
#include "support/synthetic_film.h"
#include "support/temp_folder.h"
#include "vsprite/image.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;
using testing::TempFolder;

constexpr int kWidth = 64, kHeight = 48;

// A soft disc whose colours and alphas take many values, and which moves 3 px a frame.
Image picture(int index) {
  Image image{kWidth, kHeight, {}};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double d = std::hypot(x - 14.0 - 3 * index, y - 24.0);
      const int a = static_cast<int>(std::clamp(40 * (13 - d), 0.0, 255.0));
      for (const int v : {(5 * x + y) & 255, (3 * y + x) & 255, 200 - x, a})
        image.rgba.push_back(static_cast<std::uint8_t>(a > 0 ? v : 0));
    }
  return image;
}

void write_picture(const Image& image, const std::string& path) {
  testing::write_bytes(path, *encode_png(image));
}

std::vector<Frame> read_frames(const FilmSource& source) {
  auto film = FilmReader::open(source);
  EXPECT_TRUE(film) << film.error().message;
  std::vector<Frame> frames;
  while (film) {
    Frame frame;
    const auto more = film->read(frame);
    EXPECT_TRUE(more) << more.error().message;
    if (!more || !*more) break;
    frames.push_back(std::move(frame));
  }
  return frames;
}

TEST(Source, NaturalOrderCountsDigits) {
  std::vector<std::string> names = {"a10.png", "a9.png", "a09.png", "a1b2", "a1b10", "B", "a"};
  std::sort(names.begin(), names.end(), natural_less);
  EXPECT_EQ(names,
            (std::vector<std::string>{"B", "a", "a1b2", "a1b10", "a09.png", "a9.png", "a10.png"}));
}

TEST(Source, PicturesComeInNaturalOrderAndALostOneIsTime) {
  const TempFolder folder;
  for (const int i : {8, 9, 10, 13})
    write_picture(picture(i - 8), folder.file("f" + std::to_string(i) + ".png"));
  for (const std::string name : {"", "/f%d.png", "/f*.png"}) {
    const auto frames = read_frames(folder.path() + name);
    ASSERT_EQ(frames.size(), 4u) << name;
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(frames[static_cast<std::size_t>(i)].index, i);
      EXPECT_EQ(frames[static_cast<std::size_t>(i)].lost_before, i == 3 ? 2 : 0);
    }
    EXPECT_EQ(frames[2].rgba, picture(2).rgba) << "as stored";
  }
}

TEST(Source, AFolderOfClipsIsItsClips) {
  const TempFolder folder;
  for (const char* name : {"b10.mp4", "b9.mov"}) testing::write_bytes(folder.file(name), {1});
  fs::create_directory(folder.file("b1"));
  write_picture(picture(0), folder.file("b1/a.png"));
  const auto clips = find_clips(folder.path());
  ASSERT_TRUE(clips) << clips.error().message;
  EXPECT_EQ(*clips, (std::vector<std::string>{folder.file("b1"), folder.file("b9.mov"),
                                              folder.file("b10.mp4")}));
}

TEST(Source, ADamagedPictureIsNamed) {
  const TempFolder folder;
  for (int i = 0; i < 3; ++i) write_picture(picture(i), folder.file(std::to_string(i) + ".png"));
  fs::resize_file(folder.file("2.png"), fs::file_size(folder.file("2.png")) / 2);
  auto film = FilmReader::open(folder.path());
  ASSERT_TRUE(film);
  Frame frame;
  ASSERT_TRUE(*film->read(frame));
  ASSERT_TRUE(*film->read(frame));
  const auto last = film->read(frame);
  ASSERT_FALSE(last);
  EXPECT_EQ(last.error().code, ErrorCode::CorruptData);
  EXPECT_NE(last.error().message.find("2.png"), std::string::npos) << last.error().message;
}

// Lossless films with alpha give the pixels that went in; lossy ones come near.
TEST(Source, FilmsWithAlphaNeedNoKeying) {
  const TempFolder folder;
  for (int i = 0; i < 12; ++i)
    write_picture(picture(i), folder.file("p" + std::to_string(100 + i) + ".png"));
  for (const auto& [name, options, exact] :
       {std::tuple{"a.mkv", "-c:v ffv1 -pix_fmt bgra", true},
        {"b.mov", "-c:v qtrle", true},
        {"c.mov", "-c:v png", true},
        {"d.webm", "-c:v libvpx-vp9 -pix_fmt yuva420p -b:v 2M", false},
        {"e.mov", "-c:v prores_ks -profile:v 4444 -pix_fmt yuva444p10le", false}}) {
    const std::string path = folder.file(name);
    if (std::system(("ffmpeg -v error -y -r 30 -start_number 100 -i '" + folder.file("p%d.png") +
                     "' " + options + " '" + path + "' 2>/dev/null")
                        .c_str()) != 0)
      GTEST_SKIP() << "no ffmpeg with " << options;
    const auto frames = read_frames(path);
    ASSERT_EQ(frames.size(), 12u) << name;
    const auto screen = measure_screen(frames, {});
    ASSERT_TRUE(screen) << screen.error().message;
    EXPECT_EQ(screen->kind, KeyKind::Alpha) << name;
    const KeyedFrame keyed = Keyer(*screen, {}).key(frames[7], &frames[6]);
    ASSERT_EQ(keyed.blobs.size(), 1u) << name;
    EXPECT_NEAR(keyed.blobs[0].anchor_x, 14.5 + 21, exact ? 0.05 : 0.2) << name;
    EXPECT_GT(keyed.difference, 1) << name;
    if (exact) {
      EXPECT_EQ(frames[7].rgba, picture(7).rgba) << name;
    }
    double wrong = 0;
    for (std::size_t i = 3; i < frames[7].rgba.size(); i += 4)
      wrong += std::abs(frames[7].rgba[i] - picture(7).rgba[i]);
    EXPECT_LT(wrong / (kWidth * kHeight), exact ? 0.001 : 4) << name;
  }
}

TEST(Source, AMatteBesideTheFilmIsItsCoverage) {
  const TempFolder folder;
  fs::create_directory(folder.file("color")), fs::create_directory(folder.file("matte"));
  for (int i = 0; i < 9; ++i) {
    Image color = picture(i), matte = picture(i);
    for (std::size_t p = 0; p < color.rgba.size(); p += 4) {
      for (std::size_t c = 0; c < 3; ++c) matte.rgba[p + c] = matte.rgba[p + 3];
      matte.rgba[p + 3] = color.rgba[p + 3] = 255;
    }
    write_picture(color, folder.file("color/" + std::to_string(i) + ".png"));
    if (i < 8) write_picture(matte, folder.file("matte/" + std::to_string(i) + ".png"));
  }
  FilmSource source(folder.file("color"));
  source.matte = folder.file("matte");
  auto film = FilmReader::open(source);
  ASSERT_TRUE(film) << film.error().message;
  Frame frame;
  for (int i = 0; i < 8; ++i) {
    ASSERT_TRUE(*film->read(frame));
    EXPECT_EQ(frame.rgba, picture(i).rgba) << i;
  }
  const auto last = film->read(frame);
  ASSERT_FALSE(last) << "nine pictures, eight mattes";
  EXPECT_NE(last.error().message.find("fewer frames"), std::string::npos) << last.error().message;
}

// Every valid file of PngSuite comes through as its expected pixels, every broken one is refused.
TEST(Source, EveryKindOfPngIsExactOrRefused) {
  const std::string suite = VSPRITE_SOURCE_DIR "/../../shared/pngsuite";
  const std::string other = VSPRITE_SOURCE_DIR "/../shared/pngsuite";
  const std::string root = fs::exists(suite) ? suite : other;
  if (!fs::exists(root)) GTEST_SKIP() << "no PngSuite beside the project";
  int exact = 0, refused = 0;
  for (const auto& entry : fs::directory_iterator(root + "/png")) {
    const std::string stem = entry.path().stem().string();
    auto film = FilmReader::open(entry.path().string());
    Frame frame;
    const bool read = film && film->read(frame);
    if (stem.starts_with("x")) {
      EXPECT_FALSE(read) << stem;
      refused += !read;
      continue;
    }
    ASSERT_TRUE(read) << stem << ": " << film.error().message;
    const auto bytes = testing::read_bytes(root + "/json/" + stem + ".json");
    const auto due = nlohmann::json::parse(bytes).get<std::vector<int>>();
    ASSERT_EQ(frame.rgba.size(), due.size()) << stem;
    const bool deep = stem.ends_with("16");
    int most = 0;
    for (std::size_t i = 0; i < due.size(); ++i)
      most = std::max(most, std::abs(frame.rgba[i] - (deep ? (due[i] + 128) / 257 : due[i])));
    EXPECT_LE(most, deep ? 1 : 0) << stem;
    ++exact;
  }
  EXPECT_EQ(exact, 161);
  EXPECT_EQ(refused, 14);
}

}  // namespace
}  // namespace vsprite
