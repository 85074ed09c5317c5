// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// make_film KIND FILE [FRAMES] - small films for the tests of the tool, in well under a second.
//
//   circle  a soft comet swims in circles before an uneven, desaturated, noisy blue: every heading
//   line    the same comet swims to the right, leaves and comes back: one heading
//   two     two comets of one size
//   blank   the screen, and nobody there
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

constexpr int kWidth = 160, kHeight = 120, kPeriod = 75;
constexpr double kTurn = 6.283185307179586;

struct Comet {
  double x, y, heading;
};

/// Head, neck and tail: discs whose edge falls off over two pixels. The tail is swept back.
double coverage(const Comet& comet, double x, double y) {
  constexpr double kBack[3] = {0, 9, 16}, kRadius[3] = {10, 7, 4};
  double most = 0;
  for (int k = 0; k < 3; ++k) {
    const double dx = x - comet.x + kBack[k] * std::cos(comet.heading);
    const double dy = y - comet.y + kBack[k] * std::sin(comet.heading);
    most = std::max(most, std::clamp((kRadius[k] - std::hypot(dx, dy)) / 2 + 0.5, 0.0, 1.0));
  }
  return most;
}

Comet circling(double x, double y, double radius, double phase) {
  return {x + radius * std::cos(phase), y + radius * std::sin(phase), phase + kTurn / 4};
}

std::vector<Comet> comets(const std::string& kind, int frame) {
  const double phase = kTurn * (frame % kPeriod) / kPeriod;
  if (kind == "circle") return {circling(80, 60, 34, phase)};
  if (kind == "two") return {circling(42, 60, 15, phase), circling(118, 60, 15, phase + 2)};
  if (kind == "line") return {{-40.0 + 240.0 * (frame % kPeriod) / kPeriod, 60, 0}};
  return {};
}

void draw(const std::vector<Comet>& subject, std::uint32_t& noise, std::vector<std::uint8_t>& rgb) {
  std::size_t at = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double uneven = 6 * std::sin(x / 50.0) + 4 * std::cos(y / 40.0);
      double alpha = 0;
      for (const Comet& comet : subject) alpha = std::max(alpha, coverage(comet, x + 0.5, y + 0.5));
      const double front[3] = {230, 150, 40}, back[3] = {70 + uneven, 95 + uneven, 150 + uneven};
      for (int c = 0; c < 3; ++c) {
        noise = noise * 1664525u + 1013904223u;
        const double grain = static_cast<double>(noise >> 24) / 64 - 2;
        const double value = alpha * front[c] + (1 - alpha) * back[c] + grain;
        rgb[at++] = static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return std::fputs("usage: make_film KIND FILE [FRAMES]\n", stderr), 2;
  const std::string kind = argv[1];
  const int frames = argc > 3 ? std::atoi(argv[3]) : 240;
  const std::string command =
      "ffmpeg -v error -y -f rawvideo -pix_fmt rgb24 -s 160x120 -r 25 -i - -threads 1 -c:v libx264 "
      "-preset ultrafast -crf 12 -pix_fmt yuv420p '" +
      std::string(argv[2]) + "'";
  std::FILE* pipe = ::popen(command.c_str(), "w");
  if (pipe == nullptr) return std::perror("ffmpeg"), 1;
  std::vector<std::uint8_t> rgb(std::size_t{3} * kWidth * kHeight);
  std::uint32_t noise = 7;
  for (int frame = 0; frame < frames; ++frame) {
    draw(comets(kind, frame), noise, rgb);
    if (std::fwrite(rgb.data(), 1, rgb.size(), pipe) != rgb.size()) return ::pclose(pipe), 1;
  }
  return ::pclose(pipe) == 0 ? 0 : 1;
}
