// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// make_film KIND FILE [FRAMES [SCALE [EXPOSURE [RATE]]]] - small films for the tests of the tool,
// in well under a second.
//
//   circle  a soft comet swims in circles before an uneven, desaturated, noisy blue: every heading
//   shadow  the same, and a soft shadow below it takes two fifths of the light
//   line    the same comet swims to the right, leaves and comes back: one heading
//   two     two comets of one size
//   blank   the screen, and nobody there
//   idle, walk, run, jump   as a generator makes them: a figure on the spot that faces right, the
//           screen painted in a green that changes over time, shows through between arm and body,
//           and tints the figure
//   floor   the walking one on a floor seen in perspective: horizon at y = 30, a circle of radius
//           70 about a place 80 behind the line y = 110, the camera's focal length 160 px
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
  if (kind == "circle" || kind == "shadow") return {circling(80, 60, 34, phase)};
  if (kind == "two") return {circling(42, 60, 15, phase), circling(118, 60, 15, phase + 2)};
  if (kind == "line") return {{-40.0 + 240.0 * (frame % kPeriod) / kPeriod, 60, 0}};
  return {};
}

/// A limb from (ax, ay) to (bx, by).
struct Limb {
  double ax, ay, bx, by, radius;
};

double distance_to(const Limb& limb, double x, double y) {
  const double dx = limb.bx - limb.ax, dy = limb.by - limb.ay, length = dx * dx + dy * dy;
  const double t =
      length > 0 ? std::clamp(((x - limb.ax) * dx + (y - limb.ay) * dy) / length, 0.0, 1.0) : 0;
  return std::hypot(x - limb.ax - t * dx, y - limb.ay - t * dy) - limb.radius;
}

/// The figure at `seconds` of its action, hip at the origin, about 60 px high.
std::vector<Limb> figure(const std::string& kind, double seconds) {
  const double pace = kind == "walk"    ? 1
                      : kind == "run"   ? 1.5
                      : kind == "idle"  ? 0.5
                      : kind == "floor" ? 1.0
                                        : 0;
  const double stride = kind == "walk" ? 0.45 : kind == "run" ? 0.8 : 0.06;
  const double phase = kTurn * pace * seconds;
  const double air = kind == "jump" ? 14 * std::sin(kTurn / 2 * std::fmod(seconds, 1.0)) : 0;
  const double up = air + 1.0 * std::cos(2 * phase), lean = kind == "run" ? 5 : 2;
  std::vector<Limb> limbs{{0, -up, lean, -22 - up, 6},                     // body
                          {lean + 2, -34 - up, lean + 2, -34 - up, 7},     // head
                          {lean + 9, -33 - up, lean + 10, -33 - up, 2},    // nose
                          {lean - 1, -21 - up, lean - 15, -13 - up, 2.2},  // arm akimbo
                          {lean - 15, -13 - up, -4, -3 - up, 2.2}};
  for (const double side : {0.0, kTurn / 2}) {
    const double thigh = stride * std::sin(phase + side) + 0.02 * air;
    const double shin = thigh - stride * (1 + std::cos(phase + side)) / 2 - 0.04 * air;
    const double kx = 12 * std::sin(thigh), ky = 12 * std::cos(thigh) - up;
    limbs.push_back({0, -up, kx, ky, 3.2});
    limbs.push_back({kx, ky, kx + 11 * std::sin(shin), ky + 11 * std::cos(shin), 2.8});
  }
  return limbs;
}

/// Where the figure's hip is drawn, and how large.
struct Standpoint {
  double x = 80, y = 78, scale = 1;
};

Standpoint on_floor(int frame) {
  constexpr double kHorizon = 30, kLine = 110, kFocal = 160, kRadius = 70, kDepth = 80, kLeg = 25.8;
  const double phase = kTurn * (frame % 150) / 150;
  const double s = kFocal / (kFocal + kDepth - kRadius * std::sin(phase));
  return {80 + s * kRadius * std::cos(phase), kHorizon + (kLine - kHorizon) * s - kLeg * s, s};
}

bool is_figure(const std::string& kind) {
  return kind == "idle" || kind == "walk" || kind == "run" || kind == "jump" || kind == "floor";
}

void draw_figure(const std::string& kind, int frame, double scale, double exposure, double rate,
                 std::uint32_t& noise, std::vector<std::uint8_t>& rgb) {
  const double seconds = frame / rate;
  const std::vector<Limb> limbs = figure(kind, seconds);
  Standpoint at_hip;
  at_hip.scale = scale;
  if (kind == "floor") at_hip = on_floor(frame);
  const double drift = 6 * std::sin(0.8 * seconds + scale);
  const double screen[3] = {46 + drift, 176 - drift, 70 + 2 * drift}, coat[3] = {196, 92, 84};
  std::size_t at = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      double nearest = 1e9;
      for (const Limb& limb : limbs)
        nearest = std::min(nearest, distance_to(limb, (x + 0.5 - at_hip.x) / at_hip.scale,
                                                (y + 0.5 - at_hip.y) / at_hip.scale));
      const double alpha = std::clamp(0.5 - nearest * at_hip.scale / 1.5, 0.0, 1.0);
      for (int c = 0; c < 3; ++c) {
        noise = noise * 1664525u + 1013904223u;
        const double grain = static_cast<double>(noise >> 24) / 128 - 1;
        const double tinted = 0.94 * coat[c] + 0.06 * screen[c] - 12 * std::min(0.0, nearest / 6);
        const double value = alpha * exposure * tinted + (1 - alpha) * screen[c] + grain;
        rgb[at++] = static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
      }
    }
  }
}

/// What is left of a code value where a comet's shadow takes `dark` of the light.
double shade(const Comet& comet, double dark, double x, double y) {
  const double r = std::hypot((x - comet.x - 4) / 14, (y - comet.y - 14) / 8);
  return std::pow(1 - dark * std::clamp(1.5 - r, 0.0, 1.0), 1 / 2.2);
}

void draw(const std::vector<Comet>& subject, double dark, std::uint32_t& noise,
          std::vector<std::uint8_t>& rgb) {
  std::size_t at = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double uneven = 6 * std::sin(x / 50.0) + 4 * std::cos(y / 40.0);
      double alpha = 0;
      for (const Comet& comet : subject) alpha = std::max(alpha, coverage(comet, x + 0.5, y + 0.5));
      const double lit = dark > 0 ? shade(subject[0], dark, x + 0.5, y + 0.5) : 1;
      const double front[3] = {230, 150, 40},
                   back[3] = {lit * (70 + uneven), lit * (95 + uneven), lit * (150 + uneven)};
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
  if (argc < 3)
    return std::fputs("usage: make_film KIND FILE [FRAMES [SCALE [EXPOSURE [RATE]]]]\n", stderr), 2;
  const std::string kind = argv[1];
  const int frames = argc > 3 ? std::atoi(argv[3]) : 240;
  const double scale = argc > 4 ? std::atof(argv[4]) : 1,
               exposure = argc > 5 ? std::atof(argv[5]) : 1;
  const int rate = argc > 6 ? std::atoi(argv[6]) : 25;
  const std::string command = "ffmpeg -v error -y -f rawvideo -pix_fmt rgb24 -s 160x120 -r " +
                              std::to_string(rate) +
                              " -i - -threads 1 -c:v libx264 "
                              "-preset ultrafast -crf 12 -pix_fmt yuv420p '" +
                              std::string(argv[2]) + "'";
  std::FILE* pipe = ::popen(command.c_str(), "w");
  if (pipe == nullptr) return std::perror("ffmpeg"), 1;
  std::vector<std::uint8_t> rgb(std::size_t{3} * kWidth * kHeight);
  std::uint32_t noise = 7;
  for (int frame = 0; frame < frames; ++frame) {
    if (is_figure(kind))
      draw_figure(kind, frame, scale, exposure, rate, noise, rgb);
    else
      draw(comets(kind, frame), kind == "shadow" ? 0.4 : 0, noise, rgb);
    if (std::fwrite(rgb.data(), 1, rgb.size(), pipe) != rgb.size()) return ::pclose(pipe), 1;
  }
  return ::pclose(pipe) == 0 ? 0 : 1;
}
