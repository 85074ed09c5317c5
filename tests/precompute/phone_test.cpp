// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// What phones write: HEVC of 8 and 10 bits, HLG, PQ, uneven times. Each against its plain original.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "film/hdr.h"
#include "film/pacer.h"
#include "support/synthetic_film.h"
#include "support/temp_folder.h"

namespace vsprite {
namespace {

using testing::TempFolder;

bool run(const std::string& command) {
  return std::system((command + " 2>/dev/null").c_str()) == 0;
}

// Mean and largest |difference| of R, G, B, where the original is below the knee.
std::pair<double, int> apart(const Frame& a, const Frame& due) {
  double sum = 0;
  int most = 0, count = 0;
  for (int y = 8; y < a.height - 8; y += 3)
    for (int x = 8; x < a.width - 8; x += 3) {
      const auto p = rgb_at(a, x, y), q = rgb_at(due, x, y);
      if (std::max({q[0], q[1], q[2]}) > 228) continue;
      for (std::size_t c = 0; c < 3; ++c, ++count) {
        sum += std::abs(p[c] - q[c]);
        most = std::max(most, std::abs(p[c] - q[c]));
      }
    }
  return {sum / count, most};
}

// The curves of BT.2100 at a few codes, white being 203 cd/m2, against the formulas in libm.
TEST(Phone, HlgAndPqCodesAreTheLightThatTheStandardSays) {
  for (const int code : {64, 100, 200, 300, 400, 500, 600, 721}) {
    const double v = (code - 64) / 876.0;
    const double p = std::pow(v, 32 / 2523.0);
    const double pq =
        10000 / 203.0 *
        std::pow(std::max(p - 0.8359375, 0.0) / (18.8515625 - 18.6875 * p), 8192 / 1305.0);
    EXPECT_NEAR(static_cast<double>(detail::light_of(Transfer::Pq, code, false)) / 65536, pq,
                1e-3 + 4e-3 * pq)
        << code;
    const double scene =
        v <= 0.5 ? v * v / 3 : (std::exp((v - 0.55991073) / 0.17883277) + 0.28466892) / 12;
    EXPECT_NEAR(static_cast<double>(detail::light_of(Transfer::Hlg, code, false)) / 65536,
                1000 / 203.0 * std::pow(scene, 1.2), 2e-3)
        << code;
  }
  EXPECT_NEAR(static_cast<double>(detail::light_of(Transfer::Hlg, 721, false)) / 65536, 1, 0.01)
      << "three quarters of the signal are white";
}

// HEVC, and HDR made by another program (zimg) from the plain original, come back as the original.
TEST(Phone, HevcAndHighDynamicRangeComeBackAsTheirOriginal) {
  const TempFolder folder;
  const testing::SyntheticFilm scene;
  std::vector<Frame> frames;
  for (int i = 0; i < 6; ++i) frames.push_back(scene.frame(i, {{100.0 + 8 * i, 120}}));
  const std::string plain = folder.file("plain.mkv");
  if (!testing::encode_film(frames, plain,
                            "-c:v ffv1 -pix_fmt yuv420p -colorspace smpte170m -color_range tv"))
    GTEST_SKIP() << "no ffmpeg";
  const auto original = sample_frames(plain, 6);
  ASSERT_TRUE(original);
  const std::string in =
      "-vf zscale=min=170m:tin=iec61966-2-1:pin=709:rin=limited:m=gbr:t=linear:p=709:npl=203,"
      // agamma=false: HLG by its standard; zimg otherwise takes a short cut, a mean of 6 codes off.
      "format=gbrpf32le,zscale=min=gbr:tin=linear:pin=709:p=2020:npl=203:agamma=false:";
  for (const auto& [name, options] :
       {std::pair<std::string, std::string>{"8.mp4", "-pix_fmt yuv420p"},
        {"10.mp4", "-pix_fmt yuv420p10le"},
        {"hlg.mp4", in + "t=arib-std-b67:m=2020_ncl:r=limited,format=yuv420p10le -color_trc "
                         "arib-std-b67 -colorspace bt2020nc -color_primaries bt2020"},
        {"pq.mp4", in + "t=smpte2084:m=2020_ncl:r=limited,format=yuv420p10le -color_trc smpte2084 "
                        "-colorspace bt2020nc -color_primaries bt2020"}}) {
    const std::string path = folder.file(name);
    if (!run("ffmpeg -v error -y -i '" + plain + "' " + options +
             " -c:v libx265 -crf 8 -x265-params log-level=none '" + path + "'"))
      GTEST_SKIP() << "no ffmpeg with libx265 and zscale";
    const auto made = sample_frames(path, 6);
    ASSERT_TRUE(made) << made.error().message;
    ASSERT_EQ(made->size(), 6u) << name;
    const auto [mean, most] = apart((*made)[3], (*original)[3]);
    EXPECT_LT(mean, 2.5) << name;
    EXPECT_LT(most, 40) << name;
  }
}

// Frame i of a film at 30 a second, in 1/90000 s, trembling by up to a fifth of a frame.
std::int64_t trembling(int i) { return 3000 * i + (i * 7919 % 1201) - 600; }

TEST(Phone, ATremblingClockLosesNoFrame) {
  FilmInfo info;
  info.time_denominator = 90000;
  Pacer pacer(info);
  for (int i = 0; i < 5000; ++i) EXPECT_EQ(pacer.lost_before(trembling(i)), 0) << i;
  Pacer wrong(info);  // a rate that is off by half a percent
  for (int i = 0; i < 5000; ++i) EXPECT_EQ(wrong.lost_before(3015 * i), 0) << i;
}

TEST(Phone, LostFramesAreCountedAndSurplusOnesPassedOver) {
  FilmInfo info;
  info.time_denominator = 90000;
  Pacer pacer(info);
  int lost = 0, surplus = 0;
  for (int i = 0; i < 3000; ++i) {
    if (i % 100 == 50 || i % 100 == 51) continue;
    const int before = pacer.lost_before(trembling(i));
    lost += std::max(before, 0);
    if (i % 1000 == 0) surplus += pacer.lost_before(trembling(i) + 300) < 0;
  }
  EXPECT_EQ(lost, 60);
  EXPECT_EQ(surplus, 3);
}

// Every tenth frame is gone from a film of uneven times: the rest keep their places.
TEST(Phone, AFilmOfUnevenTimesRunsAtItsOwnRate) {
  const TempFolder folder;
  const testing::SyntheticFilm scene;
  std::vector<Frame> frames;
  for (int i = 0; i < 60; ++i) frames.push_back(scene.frame(i, {{60.0 + 3 * i, 120}}));
  const std::string even = folder.file("even.mp4"), uneven = folder.file("uneven.mp4");
  if (!testing::encode_film(frames, even) ||
      !run("ffmpeg -v error -y -i '" + even + "' -vf \"select='mod(n,10)-5'\" -vsync vfr '" +
           uneven + "'"))
    GTEST_SKIP() << "no ffmpeg";
  auto film = FilmReader::open(uneven);
  ASSERT_TRUE(film) << film.error().message;
  EXPECT_EQ(film->info().fps_numerator, 30u);
  Frame frame;
  int place = 0, count = 0;
  for (; *film->read(frame); ++count, ++place) {
    place += frame.lost_before;
    EXPECT_EQ(place, count + (count + 4) / 9) << "frame " << count;
  }
  EXPECT_EQ(count, 54);
}

}  // namespace
}  // namespace vsprite
