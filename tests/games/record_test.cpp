// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/record.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "support/temp_folder.h"
#include "vsprite/compose.h"

namespace vsprite {
namespace {

/// PATH for the length of a test.
class Path {
 public:
  explicit Path(const std::string& value) : before_(std::getenv("PATH")) {
    ::setenv("PATH", value.c_str(), 1);
  }
  ~Path() { ::setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_;
};

/// A program named ffmpeg that does what `script` says.
void make_ffmpeg(const testing::TempFolder& folder, const std::string& script) {
  std::ofstream(folder.file("ffmpeg")) << "#!/bin/sh\n" << script << "\n";
  ::chmod(folder.file("ffmpeg").c_str(), 0755);
}

TEST(Film, IsWrittenWholeWithOddSizesCutToEven) {
  const testing::TempFolder folder;
  FilmWriter film;
  const Result<void> opened = film.open(folder.file("a.mp4"), 65, 49, 30);
  if (!opened && opened.error().code == ErrorCode::Unavailable)
    GTEST_SKIP() << opened.error().message;
  ASSERT_TRUE(opened) << opened.error().message;
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(film.add(make_image(65, 49, static_cast<std::uint8_t>(50 * i), 90, 120)));
  }
  const Result<void> closed = film.close();
  ASSERT_TRUE(closed) << closed.error().message;
  EXPECT_EQ(folder.count(), 1u);
  const auto bytes = testing::read_bytes(folder.file("a.mp4"));
  ASSERT_GT(bytes.size(), 500u);
  EXPECT_EQ(std::string(bytes.begin() + 4, bytes.begin() + 8), "ftyp");
}

TEST(Film, LeavesNothingWhenItIsNotClosed) {
  const testing::TempFolder folder;
  {
    FilmWriter film;
    if (!film.open(folder.file("a.mp4"), 64, 48, 30)) GTEST_SKIP() << "no ffmpeg";
    ASSERT_TRUE(film.add(make_image(64, 48, 1, 2, 3)));
  }
  EXPECT_EQ(folder.count(), 0u);
}

TEST(Film, SaysThatFfmpegIsMissing) {
  const testing::TempFolder folder;
  const Path path(folder.path());
  FilmWriter film;
  const Result<void> opened = film.open(folder.file("a.mp4"), 64, 48, 30);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::Unavailable);
  EXPECT_NE(opened.error().message.find("ffmpeg"), std::string::npos);
  EXPECT_EQ(folder.count(), 0u);
}

TEST(Film, AProgramThatDiesEarlyIsAnErrorWithItsWordsAndNoSignal) {
  const testing::TempFolder programs, folder;
  make_ffmpeg(programs, "echo 'the moon is full' >&2; exit 3");
  const Path path(programs.path() + ":/usr/bin:/bin");
  FilmWriter film;
  ASSERT_TRUE(film.open(folder.file("a.mp4"), 320, 240, 30));
  Result<void> done;
  for (int i = 0; i < 50 && done; ++i) done = film.add(make_image(320, 240, 1, 2, 3));
  if (done) done = film.close();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::CannotWrite);
  EXPECT_NE(done.error().message.find("the moon is full"), std::string::npos)
      << done.error().message;
}

TEST(Film, AFailureAtTheEndLeavesTheOldFileAlone) {
  const testing::TempFolder programs, folder;
  make_ffmpeg(programs, "cat > /dev/null; exit 1");
  const Path path(programs.path() + ":/usr/bin:/bin");
  testing::write_bytes(folder.file("a.mp4"), {1, 2, 3});
  FilmWriter film;
  ASSERT_TRUE(film.open(folder.file("a.mp4"), 64, 48, 30));
  ASSERT_TRUE(film.add(make_image(64, 48, 1, 2, 3)));
  EXPECT_FALSE(film.close());
  EXPECT_EQ(testing::read_bytes(folder.file("a.mp4")).size(), 3u);
  EXPECT_EQ(folder.count(), 1u);
}

TEST(Film, AFolderThatIsNotThereIsNamed) {
  FilmWriter film;
  const Result<void> opened = film.open("/no/such/folder/a.mp4", 64, 48, 30);
  ASSERT_FALSE(opened);
  if (opened.error().code == ErrorCode::Unavailable) GTEST_SKIP() << opened.error().message;
  EXPECT_EQ(opened.error().code, ErrorCode::CannotCreate);
  EXPECT_NE(opened.error().message.find("/no/such/folder/a.mp4"), std::string::npos);
}

TEST(Picture, ComesBackAsItWas) {
  const testing::TempFolder folder;
  const Image image = make_checkerboard(20, 10, 3);
  ASSERT_TRUE(save_png(folder.file("a.png"), image));
  const Result<Image> back = read_png(folder.file("a.png"));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->rgba, image.rgba);
  EXPECT_EQ(save_png("/no/such/folder/a.png", image).error().code, ErrorCode::CannotCreate);
}

}  // namespace
}  // namespace vsprite
