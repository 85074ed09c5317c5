// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// creature.h - a filmed thing without a film: an ellipse that swims in a circle, nodding as it
// goes.
#pragma once

#include <cmath>
#include <vector>

#include "similarity/features.h"

namespace vsprite::testing {

/// `count` samples in clips of `clip`; one turn takes 64 samples, so the samples repeat.
inline FeatureSet make_creature(int count, int clip, int grid = 16) {
  std::vector<SampleRow> rows;
  for (int i = 0; i < count; ++i) {
    const double heading = 2 * kPi * (i % 64) / 64;
    SampleRow r;
    r.sample = r.frame = i;
    r.clip = i / clip;
    r.width = r.height = 24;
    r.anchor_x = r.anchor_y = 12 + 0.01 * (i % 3);
    r.velocity_x = 60 * std::cos(heading);
    r.velocity_y = 60 * std::sin(heading);
    r.area = 100 + i % 5;
    rows.push_back(r);
  }
  return make_feature_set(rows, 30, grid, [](int i) {
    const double h = 2 * kPi * (i % 64) / 64, c = std::cos(h), s = std::sin(h);
    Image image{24, 24, std::vector<std::uint8_t>(4 * 24 * 24, 0)};
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 24; ++x) {
        const double u = c * (x - 11.5) + s * (y - 11.5), v = -s * (x - 11.5) + c * (y - 11.5);
        if (u * u / 100 + v * v / 16 > 1) continue;
        std::uint8_t* p = image.rgba.data() + 4 * (24 * y + x);
        p[0] = static_cast<std::uint8_t>(120 + 12 * u);
        p[1] = static_cast<std::uint8_t>(90 + 5 * (i % 64 / 8));
        p[2] = 40;
        p[3] = 255;
      }
    }
    return image;
  });
}

}  // namespace vsprite::testing
