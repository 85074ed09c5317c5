// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/extract.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vsprite {
namespace {

Blob blob_at(double x, double y, int side = 40) {
  Blob blob;
  blob.box = {static_cast<int>(x) - side / 2, static_cast<int>(y) - side / 2, side, side};
  blob.area = 0.8 * side * side;
  blob.anchor_x = x;
  blob.anchor_y = y;
  blob.label = 1;
  return blob;
}

// A subject on a straight line, `speed` px a frame, each frame unlike the one before.
std::vector<FrameSummary> walk(int count, double speed = 3) {
  std::vector<FrameSummary> frames;
  for (int i = 0; i < count; ++i) frames.push_back({i, {blob_at(100 + speed * i, 80)}, 5.0});
  return frames;
}

TEST(Extract, KnownMotionGivesItsVelocity) {
  std::vector<FrameSummary> frames;
  for (int i = 0; i < 60; ++i)
    frames.push_back({i, {blob_at(300 + 100 * std::sin(0.1 * i), 200 + 2.5 * i)}, 5.0});
  const auto result = extract(frames, 30, "a.mp4", {});
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_EQ(result->rows.size(), 60u);
  for (int i = 8; i < 52; ++i) {
    const SampleRow& row = result->rows[static_cast<std::size_t>(i)];
    EXPECT_NEAR(row.velocity_x, 300 * std::cos(0.1 * i), 0.02 * 300) << i;
    EXPECT_NEAR(row.velocity_y, 75, 0.002) << "steady motion stays exact";
    EXPECT_EQ(row.sample, i);
    EXPECT_EQ(row.source, "a.mp4");
  }
}

TEST(Extract, DuplicateGivesItsTimeToTheSampleBefore) {
  auto frames = walk(30);
  for (const std::size_t f : {std::size_t{10}, std::size_t{20}, std::size_t{21}}) {
    frames[f].blobs = frames[f - 1].blobs;
    frames[f].difference = 0.1;
  }
  const auto result = extract(frames, 30, "a.mp4", {});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->count(Fate::Duplicate), 3);
  EXPECT_EQ(result->clips, 1);
  ASSERT_EQ(result->rows.size(), 27u);
  EXPECT_EQ(result->rows[9].duration, 2);
  int total = 0;
  for (const SampleRow& row : result->rows) {
    total += row.duration;
    EXPECT_NE(row.frame, 10);
  }
  EXPECT_EQ(total, 30);
  EXPECT_NEAR(result->rows[4].velocity_x, 90, 0.01) << "film time";
}

TEST(Extract, RestIsNotTakenForDuplicates) {
  std::vector<FrameSummary> frames;
  for (int i = 0; i < 60; ++i) frames.push_back({i, {blob_at(100, 80)}, i % 3 == 0 ? 0.3 : 0.0});
  const auto result = extract(frames, 30, "a.mp4", {});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->rows.size(), 60u);
  EXPECT_EQ(result->clips, 1);
}

TEST(Extract, ClipsEndWhereTheSubjectLeavesOrTheFilmCuts) {
  auto frames = walk(60);
  for (std::size_t f = 20; f < 24; ++f) frames[f].blobs[0].touches_border = true;
  frames[24].blobs.clear();
  for (std::size_t f = 40; f < 60; ++f) frames[f].blobs[0] = blob_at(400, 300);
  const auto result = extract(frames, 30, "a.mp4", {});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->clips, 3);
  EXPECT_EQ(result->count(Fate::Border), 4);
  EXPECT_EQ(result->count(Fate::Empty), 1);
  EXPECT_EQ(result->rows.size(), 55u);
  for (const SampleRow& row : result->rows)
    EXPECT_EQ(row.clip, row.frame < 20 ? 0 : row.frame < 40 ? 1 : 2);
}

TEST(Extract, ShortClipsAreDropped) {
  auto frames = walk(40);
  frames[5].blobs.clear();
  const auto result = extract(frames, 30, "a.mp4", {});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->count(Fate::Short), 5);
  EXPECT_EQ(result->rows.front().frame, 6);
}

TEST(Extract, RefusesSeveralSubjects) {
  auto frames = walk(30);
  for (std::size_t f = 10; f < 30; ++f) {
    frames[f].blobs.push_back(blob_at(300, 200, 34));
    frames[f].blobs.back().label = 2;
  }
  const auto result = extract(frames, 30, "a.mp4", {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::BadContent);
  EXPECT_NE(result.error().message.find("frame 10"), std::string::npos) << result.error().message;
  EXPECT_NE(result.error().message.find("(300, 200)"), std::string::npos);
}

TEST(Extract, SaysWhichPartWasFollowed) {
  auto frames = walk(30);
  for (auto& frame : frames) {
    frame.blobs.push_back(blob_at(300 - frame.index, 200, 38));
    frame.blobs.back().label = 2;
    frame.blobs.back().touches_border = frame.index < 4;
  }
  frames[29].blobs.clear();
  ExtractConfig config;
  config.subject.number = 2;
  const auto result = extract(frames, 30, "a.mp4", config);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->count(Fate::Border), 4);
  ASSERT_EQ(result->followed.size(), 30u);
  for (std::size_t f = 0; f < 29; ++f) EXPECT_EQ(result->followed[f], 1) << "frame " << f;
  EXPECT_EQ(result->followed[29], -1);
}

TEST(Extract, RefusesAFilmWithoutASubject) {
  std::vector<FrameSummary> frames(20);
  const auto result = extract(frames, 30, "a.mp4", {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::BadContent);
  EXPECT_NE(result.error().message.find("no subject"), std::string::npos);
}

TEST(Extract, SaysWhyNothingIsLeft) {
  auto frames = walk(30);
  for (auto& frame : frames) frame.blobs[0].touches_border = true;
  const auto result = extract(frames, 30, "a.mp4", {});
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("30 with the subject cut"), std::string::npos)
      << result.error().message;
}

// A crop of one colour, half covered in its left half.
KeyedFrame flat_crop(int side) {
  KeyedFrame keyed;
  keyed.crop = {20, 30, side, side};
  keyed.straight.width = keyed.straight.height = side;
  for (int i = 0; i < side * side; ++i) {
    const std::uint8_t a = i % side < side / 2 ? 128 : 255;
    keyed.straight.rgba.insert(keyed.straight.rgba.end(), {200, 100, 50, a});
    keyed.labels.push_back(1);
  }
  return keyed;
}

SampleRow row_for(const KeyedFrame& keyed, int max_size) {
  std::vector<FrameSummary> frames(10);
  Blob blob = blob_at(0, 0);
  blob.box = keyed.crop;
  for (int i = 0; i < 10; ++i) frames[static_cast<std::size_t>(i)] = {i, {blob}, 1.0};
  return extract(frames, 30, "a.mp4", {.max_size = max_size})->rows[0];
}

TEST(CutSample, IsACopyWithAMarginWhereItFits) {
  const KeyedFrame keyed = flat_crop(40);
  const SampleRow row = row_for(keyed, 64);
  EXPECT_EQ(row.scale, 1);
  const Image image = cut_sample(keyed, 1, row);
  ASSERT_EQ(image.width, 42);
  ASSERT_EQ(image.height, 42);
  EXPECT_EQ(image.rgba[3], 0);
  const std::uint8_t* first = image.rgba.data() + 4 * (42 + 1);
  EXPECT_EQ(std::vector<std::uint8_t>(first, first + 4),
            (std::vector<std::uint8_t>{200, 100, 50, 128}));
}

TEST(CutSample, ScalesToTheLimitAndKeepsColorAndCover) {
  const KeyedFrame keyed = flat_crop(100);
  const SampleRow row = row_for(keyed, 64);
  const Image image = cut_sample(keyed, 1, row);
  EXPECT_EQ(image.width, 64);
  EXPECT_EQ(image.height, 64);
  EXPECT_NEAR(row.width * row.scale, 64, 1e-9);
  double cover = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const std::uint8_t* p = image.rgba.data() + 4 * (64 * y + x);
      const bool margin = x == 0 || y == 0 || x == 63 || y == 63;
      EXPECT_EQ(p[3] == 0, margin) << x << ' ' << y;
      cover += p[3] / 255.0;
      if (p[3] > 0) {
        EXPECT_EQ(p[0], 200);
        EXPECT_EQ(p[1], 100);
        EXPECT_EQ(p[2], 50);
      }
    }
  const double truth = 100 * 100 * (0.5 * 128 / 255 + 0.5) * row.scale * row.scale;
  EXPECT_NEAR(cover, truth, 0.002 * truth);
}

TEST(CutSample, LeavesOtherPartsOut) {
  KeyedFrame keyed = flat_crop(40);
  for (std::size_t i = 0; i < keyed.labels.size(); i += 2) keyed.labels[i] = 2;
  const Image image = cut_sample(keyed, 1, row_for(keyed, 64));
  EXPECT_EQ(image.rgba[4 * (42 + 1) + 3], 0);
  EXPECT_EQ(image.rgba[4 * (42 + 2) + 3], 128);
}

}  // namespace
}  // namespace vsprite
