// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// synthetic_film.h - a soft-edged ellipse over an uneven, noisy screen, with its exact matte.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "film/color.h"
#include "film/video.h"

namespace vsprite::testing {

struct Disc {
  double x = 0, y = 0;          ///< centre, px
  double wide = 40, high = 24;  ///< radii, px
};

struct SyntheticFilm {
  int width = 320, height = 240;
  double screen[3] = {70, 90, 165};    ///< R G B, code values
  double subject[3] = {225, 120, 40};  ///< R G B, code values
  double noise = 2;                    ///< largest deviation, code values
  double softness = 3;                 ///< px over which the edge goes from 0 to 1
  double shade = 0;                    ///< of the shadow below each disc, 0..1

  static double linear(double code) {
    const double v = code / 255;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  }
  static double code(double light) {
    const double v = std::clamp(light, 0.0, 1.0);
    return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
  }
  /// Coverage at a pixel's centre.
  double alpha(const Disc& disc, int x, int y) const {
    const double u = (x + 0.5 - disc.x) / disc.wide;
    const double v = (y + 0.5 - disc.y) / disc.high;
    const double r = std::sqrt(u * u + v * v);
    return std::clamp(0.5 + (1 - r) * std::min(disc.wide, disc.high) / softness, 0.0, 1.0);
  }
  /// Of the light that reaches the plate, what a disc takes.
  double shade_at(const Disc& disc, int x, int y) const {
    const double u = (x + 0.5 - disc.x - 0.4 * disc.wide) / disc.wide;
    const double v = (y + 0.5 - disc.y - disc.high) / (0.7 * disc.high);
    return shade * std::clamp(2 - 2 * std::sqrt(u * u + v * v), 0.0, 1.0);
  }
  /// The plate without noise: light falls off to the right and to the lower edge.
  double plate(int channel, int x, int y) const {
    return screen[channel] * (1 - 0.15 * x / width - 0.1 * y * y / (1.0 * height * height));
  }

  Frame frame(int index, const std::vector<Disc>& discs) const {
    return to_frame(image(index, discs), index);
  }
  Image image(int index, const std::vector<Disc>& discs) const {
    Image made{width, height,
               std::vector<std::uint8_t>(static_cast<std::size_t>(4 * width * height), 255)};
    std::uint32_t state = 12345u + 977u * static_cast<std::uint32_t>(index);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        state = state * 1664525u + 1013904223u;
        const double wobble = noise * (static_cast<double>(state >> 8) / (1 << 23) - 1);
        double a = 0;
        double light = 1;
        for (const Disc& disc : discs) {
          a = std::max(a, alpha(disc, x, y));
          light *= 1 - shade_at(disc, x, y);
        }
        for (int c = 0; c < 3; ++c) {
          const double mixed = a * linear(subject[c]) + (1 - a) * light * linear(plate(c, x, y));
          made.rgba[static_cast<std::size_t>(4 * (y * width + x) + c)] =
              static_cast<std::uint8_t>(std::clamp(code(mixed) + wobble + 0.5, 0.0, 255.0));
        }
      }
    return made;
  }
};

/// Encodes frames with the program ffmpeg; false where that is not to be had.
inline bool encode_film(const std::vector<Frame>& frames, const std::string& path,
                        const std::string& options = "-c:v libx264 -crf 18 -pix_fmt yuv420p",
                        const std::string& rate = "30") {
  const std::string command = "ffmpeg -y -loglevel error -f rawvideo -pix_fmt yuv420p -s " +
                              std::to_string(frames[0].width) + "x" +
                              std::to_string(frames[0].height) + " -r " + rate + " -i - " +
                              options + " '" + path + "' 2>/dev/null";
  std::FILE* pipe = popen(command.c_str(), "w");
  if (!pipe) return false;
  for (const Frame& f : frames)
    for (const auto* plane : {&f.y, &f.cb, &f.cr})
      std::fwrite(plane->data(), 1, plane->size(), pipe);
  return pclose(pipe) == 0;
}

}  // namespace vsprite::testing
