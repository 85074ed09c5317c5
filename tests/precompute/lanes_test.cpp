// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/lanes.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "film/matte.h"
#include "support/plain_lanes.h"
#include "support/synthetic_film.h"

namespace vsprite {
namespace {

using testing::SyntheticFilm;

// Runs `body` once for every instruction set of this machine that the program was compiled for.
template <class Body>
void on_every_target(Body body) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    body(hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

class Random {
 public:
  std::uint8_t byte() { return static_cast<std::uint8_t>(next() >> 24); }
  float unit() { return static_cast<float>(next() >> 8) / (1 << 24); }

 private:
  std::uint32_t next() { return state_ = state_ * 1664525u + 1013904223u; }
  std::uint32_t state_ = 5;
};

TEST(Lanes, ClassifyAsTheFormulaDoes) {
  constexpr int kCells = 77;
  Random random;
  std::vector<std::uint8_t> y(4 * kCells), cb(kCells), cr(kCells), pb(kCells), pr(kCells);
  std::vector<std::uint16_t> py(kCells);
  for (auto* plane : {&y, &cb, &cr, &pb, &pr})
    for (auto& value : *plane) value = static_cast<std::uint8_t>(110 + random.byte() / 8);
  for (auto& value : py) value = static_cast<std::uint16_t>(440 + random.byte() / 2);
  for (int n = 0; n <= kCells; n += 7) {
    const detail::RowLimits limits{-3, 30, 2, -1, 12};
    const int due =
        testing::plain_count_different(y.data(), y.data() + 2 * kCells, cb.data(), cr.data(),
                                       py.data(), pb.data(), pr.data(), n, limits);
    on_every_target([&](const char* target) {
      const std::vector<detail::RowLimits> all(3, limits);
      std::vector<int> counts(3);
      detail::lanes().count_different(y.data(), y.data() + 2 * kCells, cb.data(), cr.data(),
                                      py.data(), pb.data(), pr.data(), n, 32, all.data(),
                                      counts.data());
      EXPECT_EQ(counts[0] + counts[1] + counts[2], due) << target << ", " << n << " cells";
    });
  }
}

TEST(Lanes, ProjectAsTheFormulaDoes) {
  constexpr int kCells = 48;
  Random random;
  std::vector<std::vector<float>> planes(22, std::vector<float>(kCells));
  std::vector<std::uint8_t> mode(kCells, 2);
  detail::ProjectionRow row{};
  row.mode = mode.data();
  std::size_t next = 0;
  for (auto& moment : row.moment) moment = planes[next++].data();
  for (auto* part : {&row.frame, &row.plate, &row.noise})
    for (auto& plane : *part) plane = planes[next++].data();
  row.bound = planes[next++].data();
  std::vector<float> mean[3] = {planes[0], planes[0], planes[0]};
  std::vector<float> alpha(kCells);
  for (int p = 0; p < 3; ++p) row.mean[p] = mean[p].data();
  row.alpha = alpha.data();
  for (std::size_t i = 0; i < kCells; ++i) {
    for (std::size_t k = 10; k < 16; ++k) planes[k][i] = random.unit();
    for (std::size_t k = 16; k < 19; ++k) planes[k][i] = 0.01f + 0.02f * random.unit();
    const float w = 0.2f + random.unit();
    const float c[3] = {random.unit(), random.unit(), random.unit()};
    planes[0][i] = w;
    for (std::size_t p = 0, k = 4; p < 3; ++p) {
      planes[1 + p][i] = w * c[p];
      for (std::size_t q = p; q < 3; ++q, ++k)
        planes[k][i] = w * (c[p] * c[q] + (p == q ? 0.01f : 0.002f));
    }
  }
  on_every_target([&](const char* target) {
    detail::lanes().project(row, 0.05f, 0, kCells, kCells);
    for (int i = 0; i < kCells; ++i)
      ASSERT_NEAR(alpha[static_cast<std::size_t>(i)], testing::plain_projection(row, 0.05f, i),
                  2e-3)
          << target << ", cell " << i;
  });
}

// Sprites do not depend on the machine: whole frames, byte for byte.
TEST(Lanes, EveryInstructionSetGivesTheSameBytes) {
  const SyntheticFilm film;
  std::vector<Frame> frames;
  for (int i = 0; i < 12; ++i) frames.push_back(film.frame(i, {{70.0 + 13 * i, 90.0 + 4 * i}}));
  std::vector<KeyedFrame> first;
  int targets = 0;
  on_every_target([&](const char* target) {
    const auto screen = measure_screen(frames, {});
    ASSERT_TRUE(screen);
    Keyer keyer(*screen, {});
    std::vector<KeyedFrame> keyed;
    for (const Frame& frame : frames) keyed.push_back(keyer.key(frame, &frames[0]));
    if (++targets == 1) first = keyed;
    for (std::size_t i = 0; i < keyed.size(); ++i) {
      EXPECT_EQ(keyed[i].straight.rgba, first[i].straight.rgba) << target << ", frame " << i;
      EXPECT_EQ(keyed[i].blobs[0].anchor_x, first[i].blobs[0].anchor_x) << target;
      EXPECT_EQ(keyed[i].difference, first[i].difference) << target;
    }
  });
  EXPECT_GE(targets, 1);
}

}  // namespace
}  // namespace vsprite
