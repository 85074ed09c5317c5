// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/cut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "film/matte.h"
#include "support/keyed_alpha.h"
#include "support/synthetic_film.h"

namespace vsprite {
namespace {

using detail::GridCut;
using testing::alpha_of;
using testing::SyntheticFilm;

struct Random {
  std::uint32_t state = 5;
  int below(int n) {
    state = state * 1664525u + 1013904223u;
    return static_cast<int>((state >> 8) % static_cast<std::uint32_t>(n));
  }
};

// All labels of a small grid are tried: the cut is the least, and of those the fewest nodes.
TEST(GridCut, IsTheLeastOfAllCuts) {
  constexpr int kSide = 4;
  constexpr int kNodes = kSide * kSide;
  constexpr int kSteps[4][2] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};
  Random random;
  for (int trial = 0; trial < 40; ++trial) {
    GridCut graph(kSide, kSide);
    int terminal[kNodes];
    struct Edge {
      int a, b, capacity;
    };
    std::vector<Edge> edges;
    for (int i = 0; i < kNodes; ++i) {
      terminal[i] = random.below(41) - 20;
      graph.add_terminal(i % kSide, i / kSide, terminal[i]);
      for (int way = 0; way < 4; ++way) {
        const int x = i % kSide + kSteps[way][0];
        const int y = i / kSide + kSteps[way][1];
        if (x < 0 || x >= kSide || y >= kSide) continue;
        edges.push_back({i, y * kSide + x, random.below(12)});
        graph.set_edge(i % kSide, i / kSide, way, edges.back().capacity);
      }
    }
    const auto cost = [&](unsigned labels) {
      int sum = 0;
      for (int i = 0; i < kNodes; ++i)
        sum += labels >> i & 1 ? std::max(-terminal[i], 0) : std::max(terminal[i], 0);
      for (const Edge& e : edges)
        sum += (labels >> e.a & 1) != (labels >> e.b & 1) ? e.capacity : 0;
      return sum;
    };
    int least = 1 << 30;
    unsigned common = 0;  // what every least cut has with the source
    for (unsigned labels = 0; labels < 1u << kNodes; ++labels) {
      const int c = cost(labels);
      if (c < least) least = c, common = labels;
      if (c == least) common &= labels;
    }
    graph.solve();
    unsigned found = 0;
    for (int i = 0; i < kNodes; ++i) found |= graph.with_source(i % kSide, i / kSide) ? 1u << i : 0;
    EXPECT_EQ(cost(found), least) << trial;
    EXPECT_EQ(found, common) << trial;
  }
}

constexpr int kNavy[3] = {40, 44, 80}, kOrange[3] = {220, 130, 60};

bool on_patch(int x, int y) { return y < 160 && (x / 20 + 2 * (y / 20)) % 5 == 0; }

// An oval, orange above and navy below, with a round gap in the orange, before stripes with
// navy patches; in its shadow the stripes lie below it.
struct Oval {
  double x, y;
  bool gap(double px, double py) const { return std::hypot(px - x, py - (y - 20)) < 9; }
  bool has(double px, double py) const {
    return std::hypot((px - x) / 50, (py - y) / 40) < 1 && !gap(px, py);
  }
  bool shades(double px, double py) const {
    return std::hypot((px - x) / 54, (py - y - 50) / 20) < 1;
  }
};

Frame oval_frame(int index, const Oval& oval) {
  Image image{320, 240, {}};
  Random random{77u + 31u * static_cast<std::uint32_t>(index)};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const int stripe = x / 16 * 37 % 120;
      int rgb[3] = {90 + y / 30 * 12, 190 - stripe, 70 + stripe};
      if (on_patch(x, y)) std::copy_n(kNavy, 3, rgb);
      if (oval.has(x + 0.5, y + 0.5))
        std::copy_n(y + 0.5 < oval.y ? kOrange : kNavy, 3, rgb);
      else if (oval.shades(x + 0.5, y + 0.5))
        for (int& c : rgb)
          c = static_cast<int>(SyntheticFilm::code(0.65 * SyntheticFilm::linear(c)) + 0.5);
      for (const int c : rgb)
        image.rgba.push_back(static_cast<std::uint8_t>(c + random.below(3) - 1));
      image.rgba.push_back(255);
    }
  return to_frame(image, index);
}

class BeforeItsOwnColor : public ::testing::Test {
 protected:
  void SetUp() override {
    std::vector<Frame> frames;
    for (int i = 0; i < 24; ++i)
      frames.push_back(oval_frame(i, {60.0 + 8.5 * i, 60.0 + i * 29 % 100}));
    auto measured = measure_screen(frames, {});
    ASSERT_TRUE(measured) << measured.error().message;
    ASSERT_EQ(measured->kind, KeyKind::Plate) << measured->reason;
    screen = std::move(*measured);
    oval = {150, 118};
    keyed = Keyer(screen, {}).key(oval_frame(99, oval), nullptr);
  }
  ScreenModel screen;
  Oval oval{};
  KeyedFrame keyed;
};

TEST_F(BeforeItsOwnColor, ThereIsNoHole) {
  int patches = 0, least = 255;
  for (int top = 0; top < 240; top += 20)
    for (int left = 0; left < 320; left += 20) {
      const bool inside =
          top >= oval.y && oval.has(left - 2, top + 22) && oval.has(left + 22, top + 22);
      if (!on_patch(left, top) || !inside) continue;
      ++patches;
      for (int y = top; y < top + 20; ++y)
        for (int x = left; x < left + 20; ++x) least = std::min(least, alpha_of(keyed, x, y));
    }
  EXPECT_GT(patches, 0);
  EXPECT_EQ(least, 255);
}

TEST_F(BeforeItsOwnColor, ATrueGapStays) {
  for (int y = 94; y < 102; ++y)
    for (int x = 146; x < 154; ++x) EXPECT_LT(alpha_of(keyed, x, y), 26) << x << ' ' << y;
}

TEST_F(BeforeItsOwnColor, ABroadShadowIsNoneOfIt) {
  int all = 0, taken = 0;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      const bool near = std::hypot((x + 0.5 - oval.x) / 50, (y + 0.5 - oval.y) / 40) < 1.15;
      if (near || !oval.shades(x + 0.5, y + 0.5)) continue;
      ++all;
      taken += alpha_of(keyed, x, y) > 25 ? 1 : 0;
    }
  EXPECT_GT(all, 800);
  EXPECT_LE(50 * taken, all);
}

}  // namespace
}  // namespace vsprite
