// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/video.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "support/synthetic_film.h"
#include "support/temp_folder.h"

namespace vsprite {
namespace {

using testing::encode_film;
using testing::TempFolder;

// Flat frames; the level of the first row of blocks counts them.
std::vector<Frame> counting_frames(int count, int width = 160, int height = 120) {
  std::vector<Frame> frames;
  for (int i = 0; i < count; ++i) {
    Frame f{width, height, i,
            std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height))};
    for (auto& byte : f.bgr) byte = static_cast<std::uint8_t>(40 + 4 * (i % 40));
    frames.push_back(std::move(f));
  }
  return frames;
}

// Frames until the end or the error.
Result<int> read_all(FilmReader& film) {
  Frame frame;
  int count = 0;
  for (;;) {
    auto more = film.read(frame);
    if (!more) return more.error();
    if (!*more) return count;
    ++count;
  }
}

TEST(Video, DecodesEveryFrameInOrder) {
  const TempFolder folder;
  const std::string path = folder.file("a b.mp4");
  if (!encode_film(counting_frames(40), path, "-c:v libx264 -crf 12 -pix_fmt yuv420p",
                   "30000/1001"))
    GTEST_SKIP() << "no ffmpeg";
  auto film = FilmReader::open(path);
  ASSERT_TRUE(film) << film.error().message;
  EXPECT_EQ(film->info().width, 160);
  EXPECT_EQ(film->info().height, 120);
  EXPECT_EQ(film->info().fps_numerator, 30000u);
  EXPECT_EQ(film->info().fps_denominator, 1001u);
  Frame frame;
  int first = 0;
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(*film->read(frame));
    EXPECT_EQ(frame.index, i);
    const int level = frame.bgr[3 * (60 * 160 + 80)];
    if (i == 0) first = level;  // the decoder's rounding darkens all alike
    EXPECT_NEAR(level - first, 4 * i, 2);
  }
  EXPECT_FALSE(*film->read(frame));
  EXPECT_FALSE(*film->read(frame)) << "the end stays the end";
}

TEST(Video, SaysWhatIsNoFilm) {
  const TempFolder folder;
  EXPECT_EQ(FilmReader::open(folder.file("none.mp4")).error().code, ErrorCode::NotFound);
  EXPECT_EQ(FilmReader::open(folder.path()).error().code, ErrorCode::CannotRead);
  const std::string text = folder.file("x.txt");
  std::ofstream(text) << "not a film, however long it may be\n";
  const auto refused = FilmReader::open(text);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::BadFormat);
  EXPECT_NE(refused.error().message.find("no film"), std::string::npos);
  std::ofstream(folder.file("empty.mp4")).flush();
  EXPECT_EQ(FilmReader::open(folder.file("empty.mp4")).error().code, ErrorCode::BadFormat);
}

TEST(Video, TruncatedFilmIsCorrupt) {
  const TempFolder folder;
  const std::string path = folder.file("cut.mp4");
  const testing::SyntheticFilm scene;
  std::vector<Frame> frames;
  for (int i = 0; i < 40; ++i) frames.push_back(scene.frame(i, {{60.0 + 4 * i, 120}}));
  if (!encode_film(frames, path, "-c:v libx264 -crf 18 -pix_fmt yuv420p -movflags +faststart"))
    GTEST_SKIP() << "no ffmpeg";
  std::filesystem::resize_file(path, std::filesystem::file_size(path) * 6 / 10);
  auto film = FilmReader::open(path);
  ASSERT_TRUE(film) << film.error().message;
  const auto count = read_all(*film);
  ASSERT_FALSE(count) << *count;
  EXPECT_EQ(count.error().code, ErrorCode::CorruptData) << count.error().message;
}

// Two sizes one after the other in one stream, as a broken cut or a screen recorder leaves them.
TEST(Video, ChangedFrameSizeIsRefusedWhereItChanges) {
  const TempFolder folder;
  for (const std::string codec : {"libx264 -f h264", "mpeg2video -f mpeg2video"}) {
    const std::string large = folder.file("large");
    const std::string small = folder.file("small");
    const std::string options = "-pix_fmt yuv420p -c:v " + codec;
    if (!encode_film(counting_frames(30, 320, 240), large, options) ||
        !encode_film(counting_frames(30, 160, 120), small, options))
      GTEST_SKIP() << "no ffmpeg";
    const std::string path = folder.file(codec.starts_with("lib") ? "two.h264" : "two.m2v");
    {
      std::ofstream two(path, std::ios::binary);
      two << std::ifstream(large, std::ios::binary).rdbuf()
          << std::ifstream(small, std::ios::binary).rdbuf();
    }
    auto film = FilmReader::open(path);
    ASSERT_TRUE(film) << codec << ": " << film.error().message;
    const auto count = read_all(*film);
    ASSERT_FALSE(count) << codec << ": " << *count;
    EXPECT_EQ(count.error().code, ErrorCode::CorruptData);
    EXPECT_NE(count.error().message.find("frame 30 is 160 x 120 px, the first 320 x 240"),
              std::string::npos)
        << codec << ": " << count.error().message;
  }
}

TEST(Video, KilledDecoderIsNamedAndReaped) {
  const TempFolder folder;
  const std::string path = folder.file("long.mp4");
  if (!encode_film(counting_frames(120, 320, 240), path)) GTEST_SKIP() << "no ffmpeg";
  {
    auto film = FilmReader::open(path);
    ASSERT_TRUE(film) << film.error().message;
    std::ifstream children("/proc/self/task/" + std::to_string(getpid()) + "/children");
    pid_t child = 0;
    ASSERT_TRUE(children >> child);
    kill(child, SIGSEGV);
    const auto count = read_all(*film);
    ASSERT_FALSE(count);
    EXPECT_EQ(count.error().code, ErrorCode::DecoderFailed);
    EXPECT_NE(count.error().message.find("SIGSEGV"), std::string::npos) << count.error().message;
  }
  { auto left_unread = FilmReader::open(path); }
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

}  // namespace
}  // namespace vsprite
