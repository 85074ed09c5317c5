// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The aquarium as a program: runs offscreen, repeats itself, and says in one sentence what is
// wrong.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/tiny_sprite.h"
#include "vsprite/image.h"
#include "vsprite/pack.h"

namespace {

struct Outcome {
  int code = -1;
  std::string text;  ///< stdout and stderr
};

Outcome run(const std::string& arguments) {
  const std::string command = std::string("XDG_DATA_HOME=/proc/nowhere ") + AQUARIUM_PROGRAM + " " +
                              arguments + " 2>&1 </dev/null";
  Outcome outcome;
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer;
  while (std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.text.append(buffer.data(), n);
  outcome.code = WEXITSTATUS(pclose(pipe));
  return outcome;
}

class AquariumProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(::testing::TempDir()) / ("aquarium_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    const vsprite::SpriteData data = vsprite::testing::tiny_sprite_data();
    const auto saved = vsprite::save_pack(pack(), data, [&](std::uint32_t sample) {
      return vsprite::Result<vsprite::Image>(vsprite::testing::tiny_picture(data, sample));
    });
    ASSERT_TRUE(saved) << saved.error().message;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string pack() const { return (folder_ / "tiny.vsp").string(); }
  std::string picture() const { return (folder_ / "last.png").string(); }

  std::filesystem::path folder_;
};

/// "1 sentence": one line, no full stop.
void expect_one_sentence(const std::string& text) {
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  EXPECT_EQ(text.find(".\n"), std::string::npos) << text;
}

TEST_F(AquariumProgram, PlaysTwentyFramesHeadlessAndKeepsTheLast) {
  const Outcome run_once = run(pack() +
                               " --headless --frames 20 --size 320x180 --keys '0.1 right' "
                               "--record " +
                               picture());
  ASSERT_EQ(run_once.code, 0) << run_once.text;
  EXPECT_NE(run_once.text.find("20 ticks"), std::string::npos) << run_once.text;
  const auto image = vsprite::read_png(picture());
  ASSERT_TRUE(image);
  EXPECT_EQ(image->width, 320);
  EXPECT_EQ(image->height, 180);
  // Water above gravel: the top is bluer than red, the foot is not black.
  const vsprite::ImageView view = *image;
  EXPECT_GT(view.pixel(160, 60)[2], view.pixel(160, 60)[0] + 20);
  EXPECT_GT(view.pixel(160, 170)[0], 20);
}

TEST_F(AquariumProgram, TheSameScriptAndSeedGiveTheSameLine) {
  const std::string arguments =
      pack() + " --headless --frames 20 --size 32x18 --keys '0 right; 0.4 up' --seed ";
  const Outcome first = run(arguments + "4");
  ASSERT_EQ(first.code, 0) << first.text;
  EXPECT_EQ(run(arguments + "4").text, first.text);
  EXPECT_NE(run(arguments + "5").text, first.text);
}

TEST_F(AquariumProgram, RefusesWhatItCannotUseInOneSentence) {
  const Outcome option = run(pack() + " --headless --sizes 3x3");
  EXPECT_EQ(option.code, 2);
  EXPECT_NE(option.text.find("--sizes"), std::string::npos) << option.text;
  expect_one_sentence(option.text);

  const Outcome size = run("--size 12");
  EXPECT_EQ(size.code, 2);
  EXPECT_NE(size.text.find("--size"), std::string::npos) << size.text;
  expect_one_sentence(size.text);

  const Outcome missing = run((folder_ / "none.vsp").string() + " --headless");
  EXPECT_EQ(missing.code, 66);
  EXPECT_NE(missing.text.find("none.vsp"), std::string::npos) << missing.text;
  expect_one_sentence(missing.text);

  const std::string bad = (folder_ / "bad.vsp").string();
  std::ofstream(bad) << "this is not a pack, although it is long enough to hold a header of one";
  const Outcome broken = run(bad + " --headless");
  EXPECT_EQ(broken.code, 3);
  expect_one_sentence(broken.text);
}

}  // namespace
