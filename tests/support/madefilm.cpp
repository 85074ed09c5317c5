// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// madefilm walker|sparse FOLDER - writes a made film as numbered pictures with alpha, on which
// control is measured beside the real ones (assets/scripts/answers.sh).
//
// walker: a beetle seen from above, for 133 s in every heading; it turns by 2 degrees a frame and
//         pauses. sparse: a fish-like thing for 50 s, straight on for most of them, with 24 turns.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "similarity/features.h"
#include "vsprite/image.h"
#include "vsprite/random.h"

namespace {

using namespace vsprite;

struct Pose {
  double x = 0, y = 0, heading = 0;  // px, radians clockwise
  double turn = 0;                   // radians a frame
  double phase = 0, stride = 0;      // of legs or tail; how far they reach, 0..1
};

struct Color {
  double r = 0, g = 0, b = 0;
};

/// The colour at u px ahead of the body's centre and v px to its right; false: nothing there.
using Shape = std::function<bool(const Pose&, double u, double v, Color&)>;

bool in_ellipse(double u, double v, double a, double b) {
  return u * u / (a * a) + v * v / (b * b) < 1;
}

bool walker_shape(const Pose& p, double u, double v, Color& color) {
  const double bend = 60 * p.turn;  // the head looks into the turn
  if (in_ellipse(u - 17, v - bend, 9, 8)) {
    color = {60, 40, 30};
    return true;
  }
  if (in_ellipse(u + 8, v, 20, 13)) {
    color = {150 - 2 * u, 60 + 3 * std::abs(v), std::abs(v) < 1.2 ? 20.0 : 50.0};
    return true;
  }
  for (int leg = 0; leg < 3; ++leg) {
    const double side = v < 0 ? -1 : 1;
    const double swing = (leg + (side > 0)) % 2 == 0 ? std::sin(p.phase) : -std::sin(p.phase);
    const double foot = 12 - 14 * leg + 7 * p.stride * swing, hip = 6 - 10 * leg;
    const double along = (std::abs(v) - 8) / 16;
    if (along < 0 || along > 1) continue;
    if (std::abs(u - (hip + (foot - hip) * along)) < 1.8) {
      color = {40, 30, 25};
      return true;
    }
  }
  return false;
}

bool sparse_shape(const Pose& p, double u, double v, Color& color) {
  const double curve = -14 * p.turn / 0.1 * std::max(0.0, -u) / 40;
  const double wave = 0.12 * std::max(0.0, -u) * (0.3 + p.stride) * std::sin(p.phase + u / 18);
  const double w = v - curve - wave;
  const bool body = in_ellipse(u, w, 36, 12);
  const bool tail = u < -26 && u > -54 && std::abs(w) < 3 + 0.45 * (-26 - u);
  if (!body && !tail) return false;
  color = {220 + 0.8 * u, 120 + 2.5 * w, tail ? 30.0 : 60.0};
  return true;
}

Image render(const Pose& p, int width, int height, const Shape& shape) {
  constexpr int kReach = 62, kFine = 3;
  Image image{width, height,
              std::vector<std::uint8_t>(static_cast<std::size_t>(4 * width * height), 0)};
  const double c = std::cos(p.heading), s = std::sin(p.heading);
  for (int y = std::max(0, int(p.y) - kReach); y < std::min(height, int(p.y) + kReach); ++y) {
    for (int x = std::max(0, int(p.x) - kReach); x < std::min(width, int(p.x) + kReach); ++x) {
      Color sum, color;
      int hits = 0;
      for (int k = 0; k < kFine * kFine; ++k) {
        const double dx = x + (k % kFine + 0.5) / kFine - p.x;
        const double dy = y + (k / kFine + 0.5) / kFine - p.y;
        if (!shape(p, c * dx + s * dy, c * dy - s * dx, color)) continue;
        sum = {sum.r + color.r, sum.g + color.g, sum.b + color.b};
        ++hits;
      }
      if (hits == 0) continue;
      std::uint8_t* pixel = image.rgba.data() + 4 * (static_cast<std::size_t>(y) * width + x);
      const auto byte = [](double v) {
        return static_cast<std::uint8_t>(std::clamp(v + 0.5, 0.0, 255.0));
      };
      const double alpha = static_cast<double>(hits) / (kFine * kFine);
      pixel[0] = byte(sum.r / hits);
      pixel[1] = byte(sum.g / hits);
      pixel[2] = byte(sum.b / hits);
      pixel[3] = byte(255 * alpha);
    }
  }
  return image;
}

void advance(Pose& p, double speed) {
  p.heading += p.turn;
  p.x += speed * std::cos(p.heading);
  p.y += speed * std::sin(p.heading);
}

// Wanders by turns of random length and rests now and then; towards the middle when near an edge.
std::vector<Pose> walk(int width, int height) {
  constexpr int kFrames = 4000;
  constexpr double kSpeed = 1.5, kTurn = 2 * kPi / 180;  // px, radians a frame
  Random random{41};
  std::vector<Pose> poses;
  Pose p{width / 2.0, height / 2.0, 0, 0, 0, 0};
  double goal = 0, fast = 1, pace = 1;
  for (int left = 0; static_cast<int>(poses.size()) < kFrames; --left) {
    if (left <= 0) {
      left = 20 + static_cast<int>(random.below(45));
      goal = kTurn * (static_cast<double>(random.below(3)) - 1);
      fast = random.unit() < 0.12 ? 0 : 0.85 + 0.3 * random.unit();
    }
    const double dx = width / 2.0 - p.x, dy = height / 2.0 - p.y;
    double wanted = goal;
    if (std::abs(dx) > width / 2.0 - 80 || std::abs(dy) > height / 2.0 - 80) {
      const double off = std::remainder(std::atan2(dy, dx) - p.heading, 2 * kPi);
      if (std::abs(off) > 0.6) wanted = off > 0 ? kTurn : -kTurn;
      fast = std::max(fast, 0.85);
    }
    pace += 0.12 * (fast - pace);
    p.turn += 0.2 * (wanted * pace - p.turn);
    p.phase += 2 * kPi / 12 * pace;
    p.stride = std::min(1.0, pace);
    advance(p, kSpeed * pace);
    poses.push_back(p);
  }
  return poses;
}

// 24 legs of 45 frames in eight headings, each heading three times, with a turn of 18 frames before
// each; the next leg is drawn among those that stay in the picture.
std::vector<Pose> swim(int width, int height) {
  constexpr int kLegs = 24, kStraight = 45, kTurn = 18;
  constexpr double kSpeed = 3;  // px a frame
  Random random{42};
  std::vector<Pose> poses;
  Pose p{width / 2.0, height / 2.0, 0, 0, 0, 0};
  std::array<int, 8> filmed{};
  for (int leg = 0; leg < kLegs; ++leg) {
    int best = 0;
    double least = 1e9;
    for (int h = 0; h < 8; ++h) {
      const double x = p.x + 150 * std::cos(h * kPi / 4), y = p.y + 150 * std::sin(h * kPi / 4);
      const double outside = std::max({0.0, 70 - x, x - (width - 70), 70 - y, y - (height - 70)});
      const bool same = std::abs(std::remainder(h * kPi / 4 - p.heading, 2 * kPi)) < 0.2;
      const double price = outside + 20 * filmed[static_cast<std::size_t>(h)] + 10 * random.unit() +
                           (same ? 1e3 : 0);
      if (price < least) least = price, best = h;
    }
    ++filmed[static_cast<std::size_t>(best)];
    const double turn = std::remainder(best * kPi / 4 - p.heading, 2 * kPi);
    for (int t = 0; t < kTurn + kStraight; ++t) {
      const double u0 = std::min(1.0, double(t) / kTurn), u1 = std::min(1.0, (t + 1.0) / kTurn);
      const auto ease = [](double u) { return u * u * (3 - 2 * u); };
      p.turn = turn * (ease(u1) - ease(u0));
      p.stride += 0.1 * ((t % 30 < 14 ? 1.0 : 0.2) - p.stride);
      p.phase += 0.35 + 0.35 * p.stride;
      advance(p, kSpeed * (0.75 + 0.35 * p.stride));
      poses.push_back(p);
    }
  }
  return poses;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string kind = argc == 3 ? argv[1] : "";
  if (kind != "walker" && kind != "sparse") {
    std::fputs("usage: madefilm walker|sparse FOLDER\n", stderr);
    return 2;
  }
  const bool walks = kind == "walker";
  const int width = walks ? 480 : 640, height = walks ? 360 : 480;
  const std::vector<Pose> poses = walks ? walk(width, height) : swim(width, height);
  std::filesystem::create_directories(argv[2]);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    char name[32];
    std::snprintf(name, sizeof name, "/%05zu.png", k);
    const auto png =
        encode_png(render(poses[k], width, height, walks ? walker_shape : sparse_shape));
    std::ofstream file(argv[2] + std::string(name), std::ios::binary);
    if (png) file.write(reinterpret_cast<const char*>(png->data()), std::ssize(*png));
    if (!png || !file.flush()) {
      std::fprintf(stderr, "madefilm: error: %s%s: cannot be written\n", argv[2], name);
      return 4;
    }
  }
  return 0;
}
