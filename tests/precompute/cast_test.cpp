// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "film/match.h"
#include "tool/cast_file.h"

namespace vsprite {
namespace {

std::string fault_of(const std::string& text) {
  const auto clips = parse_cast(text, "/dev/hero.toml");  // /dev/null is the one file that is there
  return clips ? "" : clips.error().message;
}

TEST(CastFile, ReadsEveryKeyOfAClip) {
  const auto clips = parse_cast(
      "match = false\n[[clip]]\nfile = \"null\"\nframes = [12, 107]\ntag = \"walk\"\n"
      "key = \"#20c040\"\nmirror = true\nvelocity = [-140, 2.5]\nsubject = \"largest\"\n"
      "body = [-18, -60.5, 18, 0]\n"
      "match = true\n[[clip]]\nfile = \"null\"\n",
      "/dev/hero.toml");
  ASSERT_TRUE(clips);
  const CastClip& walk = (*clips)[0];
  EXPECT_EQ(walk.path, "/dev/null");
  EXPECT_EQ(walk.first, 12);
  EXPECT_EQ(walk.last, 107);
  EXPECT_EQ(walk.tag, "walk");
  EXPECT_EQ(walk.key, "#20c040");
  EXPECT_EQ(walk.mirror, std::optional(true));
  EXPECT_EQ((*walk.velocity)[0], -140);
  EXPECT_EQ((*walk.velocity)[1], 2.5);
  EXPECT_EQ(walk.body, std::optional(std::array{-18.0, -60.5, 18.0, 0.0}));
  EXPECT_FALSE((*clips)[1].body);
  EXPECT_TRUE(walk.match);
  EXPECT_FALSE((*clips)[1].match);
  EXPECT_FALSE((*clips)[1].mirror);
  EXPECT_EQ((*clips)[1].last, INT_MAX);
}

TEST(CastFile, NamesLineAndRemedyOfAFault) {
  const std::string clip = "[[clip]]\nfile = \"null\"\n";
  EXPECT_EQ(fault_of("[[clip]\n").substr(0, 25), "/dev/hero.toml:1:8: not T");
  EXPECT_EQ(fault_of(""),
            "/dev/hero.toml: a cast lists its clips, 1 to 1000: `[[clip]]`, below it "
            "`file = \"walk.mp4\"`");
  EXPECT_EQ(fault_of(clip + "tags = \"walk\"\n"),
            "/dev/hero.toml:3:1: unknown key `tags`; did you mean `tag`?");
  EXPECT_EQ(fault_of(clip + "velocity = 140\n"),
            "/dev/hero.toml:3:12: velocity: two numbers, px/s to the right and down, such as "
            "[140, 0] is due");
  EXPECT_EQ(fault_of(clip + "frames = [9, 3]\n"),
            "/dev/hero.toml:3:10: frames: the last, 3, comes before the first, 9");
  EXPECT_EQ(fault_of(clip + "body = [1, 2, 3]\n"),
            "/dev/hero.toml:3:8: body: left, top, right and bottom, px from the anchor, such as "
            "[-18, -60, 18, 0], is due");
  EXPECT_NE(fault_of(clip + "body = [1, 2, 0, 3]\n").find("lies left of its left one"),
            std::string::npos);
  EXPECT_NE(fault_of(clip + "body = [0, 0, 1, 1]\n" + clip + "body = [0, 0, 1, 2]\n")
                .find("/dev/hero.toml:6:8: body: another clip of the tag"),
            std::string::npos);
  EXPECT_EQ(fault_of(clip + "mirror = \"yes\"\n"),
            "/dev/hero.toml:3:10: mirror: true or false is due");
  EXPECT_NE(fault_of(clip + "key = \"greenish\"\n")
                .find("/dev/hero.toml:3:7: key: 'greenish' is unknown"),
            std::string::npos);
  EXPECT_NE(fault_of("[[clip]]\ntag = \"walk\"\n").find("a clip without a file"),
            std::string::npos);
  EXPECT_EQ(fault_of("[[clip]]\nfile = \"gone.mp4\"\n"),
            "/dev/gone.mp4: no such file; /dev/hero.toml:1 names it");
}

Image picture(int side, std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  Image image{side, side, {}};
  for (int p = 0; p < side * side; ++p)
    for (const std::uint8_t value : {red, green, blue, std::uint8_t{255}})
      image.rgba.push_back(value);
  return image;
}

TEST(Match, BringsTheMeanColorToTheReference) {
  MeanColor dark, bright;
  dark.add(picture(8, 60, 80, 100));
  bright.add(picture(8, 90, 100, 105));
  const Matching matching = match_clip(100, dark, 100, bright);
  EXPECT_EQ(matching.scale, 1);
  const Image made = redrawn(picture(8, 60, 80, 100), 1, 8, 8, matching.gain);
  const std::size_t middle = 4 * (4 * 8 + 4);
  EXPECT_NEAR(made.rgba[middle], 90, 1);
  EXPECT_NEAR(made.rgba[middle + 1], 100, 1);
  EXPECT_NEAR(made.rgba[middle + 2], 105, 1);
}

TEST(Match, ScalesByTheRootOfTheAreasUnlessAnotherPoseExplainsThem) {
  const MeanColor none;
  EXPECT_NEAR(match_clip(64, none, 100, none).scale, 1.25, 1e-9);
  EXPECT_NEAR(match_clip(400, none, 100, none).scale, 0.5, 1e-9);
  EXPECT_EQ(match_clip(90, none, 100, none).scale, 1);
}

TEST(Match, RedrawingKeepsCoverageAndPlace) {
  Image image{40, 40, std::vector<std::uint8_t>(4 * 40 * 40, 0)};
  for (int y = 10; y < 30; ++y)
    for (int x = 16; x < 24; ++x)
      for (int c = 0; c < 4; ++c)
        image.rgba[static_cast<std::size_t>(4 * (40 * y + x) + c)] = c < 3 ? 120 : 255;
  const double gain[3] = {1, 1, 1};
  for (const double scale : {0.5, 0.8, 1.0, 1.25, 2.0}) {
    const int side = static_cast<int>(40 * scale);
    const Image made = redrawn(image, 1 / scale, side, side, gain);
    double area = 0, x_sum = 0;
    for (int p = 0; p < side * side; ++p) {
      const double alpha = made.rgba[static_cast<std::size_t>(4 * p + 3)] / 255.0;
      area += alpha, x_sum += alpha * (p % side + 0.5);
      if (alpha > 0.5) {
        EXPECT_EQ(made.rgba[static_cast<std::size_t>(4 * p)], 120);
      }
    }
    EXPECT_NEAR(area, 160 * scale * scale, 0.01 * 160 * scale * scale) << scale;
    EXPECT_NEAR(x_sum / area, 20 * scale, 0.02) << scale;
  }
}

std::vector<SampleRow> steady(int count, int duration) {
  std::vector<SampleRow> rows(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    rows[static_cast<std::size_t>(i)].sample = i;
    rows[static_cast<std::size_t>(i)].duration = duration;
    rows[static_cast<std::size_t>(i)].clip = i >= count / 2;
  }
  return rows;
}

TEST(Match, RetimingKeepsEveryClipsTime) {
  for (const Rate from : {Rate{24, 1}, Rate{25, 1}, Rate{60, 1}, Rate{30000, 1001}, Rate{12, 1}}) {
    const auto rows = steady(240, 1);
    const auto made = retimed(rows, from, {30, 1});
    int ticks[2] = {};
    for (const SampleRow& row : made) ticks[row.clip] += row.duration;
    const double due = 120.0 * from.denominator / from.numerator * 30;
    EXPECT_NEAR(ticks[0], due, 0.5) << from.numerator;
    EXPECT_EQ(ticks[0], ticks[1]) << from.numerator;
    EXPECT_EQ(made.size(), from.numerator == 60 ? 120u : 240u) << from.numerator;
  }
  EXPECT_EQ(retimed(steady(10, 3), {30, 1}, {30, 1})[4].duration, 3);
}

}  // namespace
}  // namespace vsprite
