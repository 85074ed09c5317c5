// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/video.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
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
    Frame f;
    f.resize(width, height);
    f.y.assign(f.y.size(), static_cast<std::uint8_t>(40 + 4 * (i % 40)));
    f.cb.assign(f.cb.size(), 110);
    f.cr.assign(f.cr.size(), 140);
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
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(*film->read(frame));
    EXPECT_EQ(frame.index, i);
    EXPECT_NEAR(frame.y[60 * 160 + 80], 40 + 4 * i, 1);
    EXPECT_NEAR(frame.cb[30 * 80 + 40], 110, 1);
    EXPECT_NEAR(frame.cr[30 * 80 + 40], 140, 1);
    const FilmInfo& info = film->info();
    EXPECT_EQ(frame.time * info.time_numerator * 30000 / info.time_denominator, i * 1001);
  }
  EXPECT_FALSE(*film->read(frame));
  EXPECT_FALSE(*film->read(frame)) << "the end stays the end";
}

// What the planes mean comes with them.
TEST(Video, TellsHowTheFilmIsCoded) {
  const TempFolder folder;
  const std::string path = folder.file("tagged.mp4");
  if (!encode_film(counting_frames(3, 159, 121), path,
                   "-c:v libx264 -pix_fmt yuv444p10 -color_trc arib-std-b67 -colorspace bt709 "
                   "-color_primaries bt709") ||
      std::system(("ffmpeg -v error -i '" + path + "' -c copy -metadata:s:v rotate=90 '" +
                   folder.file("turned.mp4") + "'")
                      .c_str()) != 0)
    GTEST_SKIP() << "no ffmpeg";
  auto film = FilmReader::open(folder.file("turned.mp4"));
  ASSERT_TRUE(film) << film.error().message;
  const FilmInfo& info = film->info();
  EXPECT_EQ(info.coding.matrix, Matrix::Bt709);
  EXPECT_FALSE(info.coding.full_range);
  EXPECT_EQ(info.transfer, Transfer::Hlg);
  EXPECT_EQ(info.pixel_format, "yuv444p10le");
  EXPECT_EQ(info.bits, 10);
  EXPECT_EQ(info.rotation, 270) << "the tag counts against the clock";
  EXPECT_FALSE(info.interlaced);
  Frame frame;
  ASSERT_TRUE(*film->read(frame));
  EXPECT_EQ(frame.y.size(), 159u * 121u);
  EXPECT_EQ(frame.cb.size(), 80u * 61u);
}

// Key frames where there are many, the whole film where there are few; the same spread either way.
TEST(Video, SamplesAreSpreadOverTheFilm) {
  const TempFolder folder;
  for (const std::string keys : {"1", "4", "250"}) {
    const std::string path = folder.file(keys + ".mp4");
    if (!encode_film(counting_frames(160), path,
                     "-c:v libx264 -crf 12 -pix_fmt yuv420p -g " + keys))
      GTEST_SKIP() << "no ffmpeg";
    const auto frames = sample_frames(path, 40);
    ASSERT_TRUE(frames) << frames.error().message;
    ASSERT_EQ(frames->size(), 40u) << keys;
    for (std::size_t k = 0; k < frames->size(); ++k) {
      const Frame& frame = (*frames)[k];
      EXPECT_NEAR(frame.index, 4 * static_cast<int>(k), 3) << keys;
      EXPECT_NEAR(frame.y[0], 40 + 4 * (frame.index % 40), 1) << keys << ", " << k;
    }
  }
}

// A place in a film is what reading it from the start gives there, whatever refers to what.
TEST(Video, ReadsARangeFromTheKeyFrameBeforeIt) {
  const TempFolder folder;
  struct Kind {
    const char *name, *options;
  };
  const Kind kinds[] = {{"closed.mp4", "-c:v libx264 -crf 30 -pix_fmt yuv420p -g 12 -bf 3"},
                        {"open.mp4",
                         "-c:v libx264 -crf 30 -pix_fmt yuv420p -g 12 -bf 3 -x264-params "
                         "open-gop=1:scenecut=0"},
                        {"mpeg2.mpg", "-c:v mpeg2video -q:v 8 -g 12 -bf 2"},
                        {"bare.h264", "-c:v libx264 -crf 30 -pix_fmt yuv420p -g 12 -bf 3"},
                        {"lone.mp4", "-c:v libx264 -crf 30 -pix_fmt yuv420p -g 250"}};
  for (const Kind& kind : kinds) {
    const std::string path = folder.file(kind.name);
    if (!encode_film(counting_frames(60), path, kind.options)) GTEST_SKIP() << "no ffmpeg";
    auto whole = FilmReader::open(path);
    ASSERT_TRUE(whole) << whole.error().message;
    std::vector<Frame> frames;
    for (Frame frame; *whole->read(frame);) frames.push_back(frame);
    ASSERT_GE(frames.size(), 58u) << kind.name;
    for (const int first : {0, 1, 11, 12, 13, 23, 24, 35, 50, 57}) {
      FilmSource source(path);
      source.first = first, source.end = first + 4;
      auto film = FilmReader::open_range(source);
      ASSERT_TRUE(film) << kind.name << ", " << first << ": " << film.error().message;
      Frame frame;
      int at = first;
      for (auto more = film->read(frame); more && *more; more = film->read(frame), ++at) {
        ASSERT_LT(at, static_cast<int>(frames.size()));
        const Frame& due = frames[static_cast<std::size_t>(at)];
        EXPECT_EQ(frame.index, due.index) << kind.name << ", " << first;
        EXPECT_TRUE(frame.y == due.y && frame.cb == due.cb) << kind.name << ", " << first;
      }
      EXPECT_EQ(at, std::min(first + 4, static_cast<int>(frames.size())))
          << kind.name << ", " << first;
    }
  }
}

TEST(Video, SaysWhatIsNoFilm) {
  const TempFolder folder;
  EXPECT_EQ(FilmReader::open(folder.file("none.mp4")).error().code, ErrorCode::NotFound);
  EXPECT_EQ(FilmReader::open(folder.path()).error().code, ErrorCode::BadFormat);
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
    // libavcodec's MPEG-2 decoder loses the last picture of the first size.
    const std::string where = codec.starts_with("lib") ? "frame 30" : "frame 29";
    EXPECT_NE(count.error().message.find(where + " is 160 x 120 px, the first 320 x 240"),
              std::string::npos)
        << codec << ": " << count.error().message;
  }
}

// A phone held upright stores a lying picture and the turn that sets it right.
TEST(Video, AFilmWithADisplayRotationComesOutUpright) {
  const TempFolder folder;
  const testing::SyntheticFilm scene;
  std::vector<Frame> frames;
  for (int i = 0; i < 4; ++i) frames.push_back(scene.frame(i, {{60.0 + 20 * i, 80}}));
  // Lossless, so that turned pictures are the same pictures.
  const std::string codec = "-c:v libx264 -qp 0 -pix_fmt yuv420p ";
  const std::string upright = folder.file("upright.mp4");
  if (!encode_film(frames, upright, codec)) GTEST_SKIP() << "no ffmpeg";
  struct Turn {
    const char* filter;  // lays the picture down
    const char* tag;     // sets it up again: degrees counterclockwise where a stream is copied
    int clockwise;
  };
  constexpr Turn kTurns[] = {
      {"transpose=2", "270", 90}, {"hflip,vflip", "180", 180}, {"transpose=1", "90", 270}};
  for (const auto& [filter, degrees, clockwise] : kTurns) {
    const std::string path = folder.file(std::string(degrees) + ".mp4");
    const std::string lying = folder.file("lying.mp4");
    ASSERT_TRUE(encode_film(frames, lying, codec + "-vf " + filter));
    const std::string turn = "ffmpeg -y -v error -i '" + lying +
                             "' -c copy -metadata:s:v:0 rotate=" + degrees + " '" + path + "'";
    ASSERT_EQ(std::system(turn.c_str()), 0);
    auto film = FilmReader::open(path), due = FilmReader::open(upright);
    ASSERT_TRUE(film && due);
    EXPECT_EQ(film->info().rotation, clockwise);
    EXPECT_EQ(film->info().width, 320);
    Frame frame, original;
    for (int i = 0; i < 4; ++i) {
      ASSERT_TRUE(*film->read(frame) && *due->read(original));
      EXPECT_EQ(frame.y, original.y) << degrees << " frame " << i;
      EXPECT_EQ(frame.cb, original.cb) << degrees << " frame " << i;
    }
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
