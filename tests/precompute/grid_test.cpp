// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace vsprite {
namespace {

using detail::Mask;

// A third of the cells, in clumps.
Mask scattered(int width, int height) {
  Mask mask(width, height);
  std::uint32_t state = static_cast<std::uint32_t>(width);
  for (auto& in : mask.in) {
    state = state * 1664525u + 1013904223u;
    in = state >> 30 == 0 ? 1 : 0;
  }
  return mask;
}

// Cell by cell; outside counts as neither.
Mask plain(const Mask& mask, int radius) {
  Mask out = mask;
  const std::uint8_t wins = radius > 0 ? 1 : 0;
  const int r = std::abs(radius);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      for (int v = std::max(y - r, 0); v <= std::min(y + r, mask.height - 1); ++v)
        for (int u = std::max(x - r, 0); u <= std::min(x + r, mask.width - 1); ++u)
          if (mask.row(v)[u] == wins) out.row(y)[x] = wins;
  return out;
}

// Widths about whole and broken words and lanes.
TEST(Grid, MasksGrowAndShrinkCellByCell) {
  for (const int width : {1, 2, 15, 16, 17, 31, 33, 63, 64, 65, 79, 95, 100, 127, 128, 130, 200}) {
    const Mask mask = scattered(width, 9);
    for (const int radius : {1, 2}) {
      EXPECT_EQ(detail::dilate(mask, radius).in, plain(mask, radius).in) << width;
      EXPECT_EQ(detail::erode(mask, radius).in, plain(mask, -radius).in) << width;
    }
    EXPECT_EQ(detail::reshape(mask, {1, -2, 1}).in, plain(plain(plain(mask, 1), -2), 1).in)
        << width;
    EXPECT_EQ(detail::reshape(mask, {-1, 2}).in, plain(plain(mask, -1), 2).in) << width;
  }
}

}  // namespace
}  // namespace vsprite
