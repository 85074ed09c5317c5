// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The keyer against the exact truth of the bundled film, beside plain projection that is given the
// true plate and the true foreground colour of every pixel of the same decoded frames.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "capture/goldfish.h"
#include "film/matte.h"
#include "support/synthetic_film.h"
#include "support/temp_folder.h"

namespace vsprite {
namespace {

using testing::SyntheticFilm;

constexpr int kFrames = 60;
constexpr int kBand = 8;  // px about the soft edge

// Frames as decoded, each with its number in the capture.
struct Decoded {
  std::vector<Frame> frames;
  std::vector<int> numbers;
};

Decoded read_film(const std::string& path, int every, int numbered) {
  Decoded film;
  auto reader = FilmReader::open(path);
  Frame frame;
  while (reader && *reader->read(frame)) {
    if (frame.index % every) continue;
    film.frames.push_back(frame);
    film.numbers.push_back(frame.index * numbered);
  }
  return film;
}

// The bundled film; where it is not built yet, its sampled frames encoded as a film of their own.
Decoded bundled_film(const capture::GoldfishFilm& truth, const testing::TempFolder& folder) {
  const int step = truth.frame_count() / kFrames;
  const std::string bundled = VSPRITE_SOURCE_DIR "/assets/goldfish.mp4";
  if (std::filesystem::exists(bundled)) return read_film(bundled, step, 1);
  std::vector<Frame> frames;
  capture::TruthFrame t;
  for (int i = 0; i < kFrames; ++i) {
    truth.render(i * step, t);
    frames.push_back(to_frame(t.composite, i));
  }
  if (!testing::encode_film(frames, folder.file("fish.mp4"),
                            "-c:v libx264 -crf 20 -pix_fmt yuv420p"))
    return {};
  return read_film(folder.file("fish.mp4"), 1, step);
}

// 1 within kBand of a pixel that is neither clear nor opaque.
std::vector<char> band_of(const capture::TruthFrame& t) {
  std::vector<char> rows(t.alpha.size());
  std::vector<char> both(t.alpha.size());
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * t.width + x); };
  for (int y = 0; y < t.height; ++y)
    for (int x = 0; x < t.width; ++x)
      if (const float a = t.alpha[at(x, y)]; a > 0.02f && a < 0.98f)
        for (int u = std::max(x - kBand, 0); u <= std::min(x + kBand, t.width - 1); ++u)
          rows[at(u, y)] = 1;
  for (int y = 0; y < t.height; ++y)
    for (int x = 0; x < t.width; ++x)
      if (rows[at(x, y)])
        for (int v = std::max(y - kBand, 0); v <= std::min(y + kBand, t.height - 1); ++v)
          both[at(x, v)] = 1;
  return both;
}

// alpha = (C - B) . (F - B) / |F - B|^2; where the truth has no foreground, the fish's mean colour.
double projected(const capture::TruthFrame& t, const Image& frame, std::size_t i,
                 const double (&mean)[3]) {
  double top = 0;
  double bottom = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double b = static_cast<double>(t.plate[3 * i + c]);
    const double f = t.alpha[i] > 0 ? static_cast<double>(t.foreground[3 * i + c]) : mean[c];
    top += (SyntheticFilm::linear(frame.rgba[4 * i + c]) - b) * (f - b);
    bottom += (f - b) * (f - b);
  }
  return bottom > 1e-9 ? std::clamp(top / bottom, 0.0, 1.0) : 0.0;
}

// Position: the centroid of the whole keyed matte against that of the whole true alpha.
struct Sums {
  double keyed = 0, plain = 0, rest = 0;
  double band_pixels = 0, rest_pixels = 0;
  std::vector<double> position;
};

void compare(const capture::TruthFrame& t, const Frame& frame, const KeyedFrame& keyed,
             Sums& sums) {
  double mean[3] = {};
  double area = 0;
  for (std::size_t i = 0; i < t.alpha.size(); ++i) {
    area += static_cast<double>(t.alpha[i]);
    for (std::size_t c = 0; c < 3; ++c)
      mean[c] += static_cast<double>(t.alpha[i]) * static_cast<double>(t.foreground[3 * i + c]);
  }
  for (double& m : mean) m /= area;
  const auto band = band_of(t);
  const Image picture = to_image(frame);
  double weight = 0;
  double x_sum = 0;
  double y_sum = 0;
  for (int y = 0; y < t.height; ++y)
    for (int x = 0; x < t.width; ++x) {
      const auto i = static_cast<std::size_t>(y * t.width + x);
      const int u = x - keyed.crop.x;
      const int v = y - keyed.crop.y;
      const bool inside = u >= 0 && v >= 0 && u < keyed.crop.width && v < keyed.crop.height;
      const double a =
          inside
              ? keyed.straight.rgba[static_cast<std::size_t>(4 * (v * keyed.crop.width + u) + 3)] /
                    255.0
              : 0.0;
      const double truth = static_cast<double>(t.alpha[i]);
      weight += a;
      x_sum += a * (x + 0.5);
      y_sum += a * (y + 0.5);
      if (band[i]) {
        sums.keyed += std::abs(a - truth);
        sums.plain += std::abs(projected(t, picture, i, mean) - truth);
        sums.band_pixels += 1;
      } else {
        sums.rest += std::abs(a - truth);
        sums.rest_pixels += 1;
      }
    }
  if (weight > 0)
    sums.position.push_back(
        std::hypot(x_sum / weight - t.centroid_x, y_sum / weight - t.centroid_y));
}

TEST(MatteTruth, IsAsGoodAsProjectionThatKnowsTheTruth) {
  const testing::TempFolder folder;
  const capture::GoldfishFilm truth;
  const Decoded film = bundled_film(truth, folder);
  if (film.frames.empty()) GTEST_SKIP() << "no ffmpeg and no assets/goldfish.mp4";
  const auto screen = measure_screen(film.frames, {});
  ASSERT_TRUE(screen) << screen.error().message;
  Keyer keyer(*screen, {});
  Sums sums;
  capture::TruthFrame t;
  for (std::size_t f = 0; f < film.frames.size(); ++f) {
    const auto bounds = truth.bounds(film.numbers[f]);
    if (!bounds.visible || bounds.touches_border) continue;
    truth.render(film.numbers[f], t);
    compare(t, film.frames[f], keyer.key(film.frames[f], nullptr), sums);
  }
  ASSERT_GT(sums.position.size(), 20u);
  std::sort(sums.position.begin(), sums.position.end());
  const double keyed = sums.keyed / sums.band_pixels;
  const double plain = sums.plain / sums.band_pixels;
  const double rest = sums.rest / sums.rest_pixels;
  const double position = sums.position[sums.position.size() / 2];
  std::printf(
      "%zu frames: alpha error within %d px of the edge %.4f, plain projection %.4f, ratio %.2f; "
      "elsewhere %.5f; position %.3f px median, %.3f px at most\n",
      sums.position.size(), kBand, keyed, plain, keyed / plain, rest, position,
      sums.position.back());
  EXPECT_LE(keyed, 1.3 * plain);
  EXPECT_LE(keyed, 0.04);
  EXPECT_LE(rest, 0.002);
  EXPECT_LE(position, 0.5);
}

}  // namespace
}  // namespace vsprite
