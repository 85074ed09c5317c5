// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Parts that meet, hide, lie about: which one is the subject, and what becomes of each frame.
#include "film/subject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "film/extract.h"

namespace vsprite {
namespace {

constexpr int kWidth = 640, kHeight = 480;

Blob blob_at(double x, double y, int wide = 40, int high = 40) {
  Blob blob;
  blob.box = {static_cast<int>(x) - wide / 2, static_cast<int>(y) - high / 2, wide, high};
  blob.area = 0.8 * wide * high;
  blob.anchor_x = x;
  blob.anchor_y = y;
  blob.label = 1;
  blob.touches_border = blob.box.x <= 0 || blob.box.y <= 0 ||
                        blob.box.x + blob.box.width >= kWidth ||
                        blob.box.y + blob.box.height >= kHeight;
  return blob;
}

// A subject that walks to the right, 2 px a frame, in the middle of the picture.
std::vector<FrameSummary> walk(int count) {
  std::vector<FrameSummary> frames;
  for (int i = 0; i < count; ++i) frames.push_back({i, {blob_at(100 + 2 * i, 240)}, 5.0});
  return frames;
}

void add(FrameSummary& frame, Blob blob) {
  blob.label = static_cast<int>(frame.blobs.size()) + 1;
  frame.blobs.push_back(blob);
  std::sort(frame.blobs.begin(), frame.blobs.end(),
            [](const Blob& a, const Blob& b) { return a.area > b.area; });
}

Track follow(const std::vector<FrameSummary>& frames, int number = SubjectChoice::kOnly) {
  auto track = follow_subject(frames, 30, kWidth, kHeight, {number});
  EXPECT_TRUE(track) << track.error().message;
  return *track;
}

// A hand reaches down from the upper border, holds the subject, lets go and leaves.
TEST(Subject, AHandEndsTheClipUntilItHasLeft) {
  auto frames = walk(120);
  for (int f = 40; f < 90; ++f) {
    auto& blobs = frames[static_cast<std::size_t>(f)].blobs;
    const double x = blobs[0].anchor_x;
    if (f >= 50 && f < 70)
      blobs = {blob_at(x, 130, 60, 262)};  // one part, from the border to below the subject
    else
      add(frames[static_cast<std::size_t>(f)], blob_at(x, 80, 60, 180));
  }
  const Track track = follow(frames);
  for (int f = 0; f < 120; ++f) {
    const Fate due = f >= 50 && f < 90 ? Fate::Touched : Fate::Kept;
    EXPECT_EQ(track.fate[static_cast<std::size_t>(f)], due) << f;
  }
}

// Things move at the border all the time, and one of them vanishes as the subject swells a little.
TEST(Subject, WhatMovesAtTheBorderWithoutTouchingEndsNoClip) {
  auto frames = walk(120);
  for (int f = 20; f < 110; ++f)
    if (f % 7 != 0) add(frames[static_cast<std::size_t>(f)], blob_at(30, 460 - f % 5, 80, 90));
  frames[56].blobs = {blob_at(212, 240, 50, 44)};
  const Track track = follow(frames);
  EXPECT_EQ(std::count(track.fate.begin(), track.fate.end(), Fate::Kept), 120);
}

// The hand that let go has left; another one that stays at the border far away is not waited for.
TEST(Subject, AClipGoesOnWhenTheHandThatTouchedHasLeft) {
  auto frames = walk(120);
  for (int f = 40; f < 120; ++f) {
    auto& blobs = frames[static_cast<std::size_t>(f)].blobs;
    const double x = blobs[0].anchor_x;
    if (f >= 50 && f < 60) blobs = {blob_at(x, 130, 60, 262)};
    if (f < 50 || (f >= 60 && f < 70))
      add(frames[static_cast<std::size_t>(f)], blob_at(x, 80, 60, 180));
    add(frames[static_cast<std::size_t>(f)], blob_at(600, 450, 90, 90));
  }
  const Track track = follow(frames, SubjectChoice::kLargest);
  EXPECT_EQ(std::count(track.fate.begin(), track.fate.end(), Fate::Touched), 20);
}

// A fish too large for the picture, crumbs beside it: cut by the border, touched by nobody.
TEST(Subject, ASubjectThatTheBorderCutsIsNotTouched) {
  std::vector<FrameSummary> frames;
  for (int i = 0; i < 60; ++i) {
    FrameSummary frame{i, {}, 5.0};
    add(frame, blob_at(i < 3 ? 222 : 200 - 0.1 * i, 240, 420 - i % 9, 300));
    if (i % 2 == 0) add(frame, blob_at(500, 100, 30, 30));
    frames.push_back(frame);
  }
  const Track track = follow(frames, SubjectChoice::kLargest);
  EXPECT_EQ(std::count(track.fate.begin(), track.fate.end(), Fate::Border), 57);
}

TEST(Subject, WalkingOutOfThePictureIsNoTouch) {
  std::vector<FrameSummary> frames;
  for (int i = 0; i < 60; ++i) {
    const double x = 600 + i;
    if (x - 20 < kWidth) frames.push_back({i, {blob_at(std::min(x, 630.0), 240)}, 5.0});
  }
  const Track track = follow(frames);
  EXPECT_EQ(track.fate.front(), Fate::Kept);
  EXPECT_EQ(track.fate.back(), Fate::Border);
  EXPECT_EQ(std::count(track.fate.begin(), track.fate.end(), Fate::Touched), 0);
}

TEST(Subject, AThingThatLiesStillIsNoRivalAndHidesTheSubjectWhereTheyTouch) {
  auto frames = walk(200);
  for (int f = 20; f < 200; ++f) {
    auto& blobs = frames[static_cast<std::size_t>(f)].blobs;
    const double x = blobs[0].anchor_x;
    if (std::abs(x - 400) < 45)
      blobs = {blob_at(0.5 * (x + 400), 240, 80, 40)};
    else
      add(frames[static_cast<std::size_t>(f)], blob_at(400, 240, 44, 44));
  }
  const Track track = follow(frames);
  for (int f = 0; f < 200; ++f) {
    const auto at = static_cast<std::size_t>(f);
    const double x = 100 + 2 * f;
    const bool meet = f >= 20 && std::abs(x - 400) < 45;
    EXPECT_EQ(track.fate[at], meet ? Fate::Hidden : Fate::Kept) << f;
    if (!meet) {
      EXPECT_NEAR(track.blob[at]->anchor_x, x, 1e-9) << f;
    }
  }
}

TEST(Subject, RestingAloneIsNotLyingAbout) {
  std::vector<FrameSummary> frames;
  for (int i = 0; i < 200; ++i) frames.push_back({i, {blob_at(300, 240)}, 0.2});
  const Track track = follow(frames);
  EXPECT_EQ(std::count(track.fate.begin(), track.fate.end(), Fate::Kept), 200);
}

// Two of one size that circle; the picture of a refusal numbers them, and each can be asked for.
std::vector<FrameSummary> pair_of_walkers() {
  std::vector<FrameSummary> frames;
  for (int i = 0; i < 100; ++i) {
    FrameSummary frame{i, {}, 5.0};
    add(frame, blob_at(200 + 60 * std::cos(0.1 * i), 120 + 40 * std::sin(0.1 * i), 44, 40));
    add(frame, blob_at(420 + 60 * std::sin(0.1 * i), 340 + 40 * std::cos(0.1 * i)));
    frames.push_back(frame);
  }
  return frames;
}

TEST(Subject, OneOfSeveralIsFollowedByItsNumber) {
  const auto frames = pair_of_walkers();
  const Rivals rivals = find_rivals(frames, 30);
  ASSERT_EQ(rivals.parts.size(), 2u);
  EXPECT_EQ(rivals.frames, 100);
  for (int number : {1, 2}) {
    const Track track = follow(frames, number);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      ASSERT_TRUE(track.blob[f]);
      EXPECT_EQ(track.blob[f]->anchor_y < 200, number == 1) << f;
    }
  }
  EXPECT_EQ(follow_subject(frames, 30, kWidth, kHeight, {}).error().code, ErrorCode::BadContent);
  const auto third = follow_subject(frames, 30, kWidth, kHeight, {3});
  ASSERT_FALSE(third);
  EXPECT_NE(third.error().message.find("--subject 3: the film shows 2"), std::string::npos);
  EXPECT_EQ(find_rivals(walk(40), 30).position, -1);
}

// The smaller one, number 2, leaves to the right while the other one swims about; a third one comes
// in from the left and goes again; then number 2 comes back where it left.
TEST(Subject, TheOneThatLeftIsGoneUntilItIsBack) {
  std::vector<FrameSummary> frames;
  const auto other_x = [](int i) { return 300 + 100 * std::sin(0.05 * i); };
  const auto x = [](int i) { return i < 100 ? 400 + 4.0 * i : 660 - 4.0 * (i - 160); };
  const auto is_there = [&](int i) { return x(i) < 640; };
  for (int i = 0; i < 220; ++i) {
    FrameSummary frame{i, {}, 5.0};
    if (i % 50 != 7) add(frame, blob_at(other_x(i), 160, 44, 40));  // one frame in 50 without it
    if (is_there(i)) add(frame, blob_at(x(i), 240));
    if (i >= 75 && i < 155) add(frame, blob_at(10 + 4 * std::min(i - 75, 155 - i), 380));
    frames.push_back(frame);
  }
  for (int number : {1, 2}) {
    const Track track = follow(frames, number);
    for (int i = 0; i < 220; ++i) {
      const Blob* blob = track.blob[static_cast<std::size_t>(i)];
      const bool due = number == 1 ? i % 50 != 7 : is_there(i);
      ASSERT_EQ(blob != nullptr, due) << number << " in frame " << i;
      if (due) {
        EXPECT_EQ(blob->anchor_y, number == 1 ? 160 : 240) << number << " in frame " << i;
      }
    }
    EXPECT_EQ(track.fate[100], number == 1 ? Fate::Kept : Fate::Empty);
  }
}

// Two go past each other, one part while they touch, no larger than one while one is before the
// other: each goes on as it came. The same where they stay so for `stay` frames and drift.
TEST(Subject, EachGoesOnAsItCameWhereTwoMeetAndPart) {
  for (int stay : {0, 40}) {
    std::vector<FrameSummary> frames;
    const auto at = [&](int i, double sign) {
      const int steps = i < 53 ? i : std::max(53, i - stay);
      const int drift = 2 * std::clamp(i - 65, 0, std::max(stay - 20, 0));
      return 320 + drift - sign * (210 - 4.0 * steps);
    };
    const auto apart = [&](int i) { return std::abs(at(i, 1) - at(i, -1)) > 42; };
    for (int i = 0; i < 100 + stay; ++i) {
      FrameSummary frame{i, {}, 5.0};
      const double one = at(i, 1), two = at(i, -1);
      if (apart(i)) {
        add(frame, blob_at(one, 242, 42, 40));
        add(frame, blob_at(two, 240));
      } else {
        const int wide = 42 + static_cast<int>(std::abs(one - two));
        add(frame, blob_at(0.5 * (one + two), 241, wide, 42));
      }
      frames.push_back(frame);
    }
    for (int number : {1, 2}) {
      const Track track = follow(frames, number);
      for (int i = 0; i < 100 + stay; ++i) {
        const auto f = static_cast<std::size_t>(i);
        ASSERT_EQ(track.fate[f], apart(i) ? Fate::Kept : Fate::Hidden) << number << " at " << i;
        if (apart(i)) {
          EXPECT_EQ(track.blob[f]->anchor_y, number == 1 ? 242 : 240) << number << " at " << i;
        }
      }
    }
  }
}

// Number 2 is out of sight for a while, nowhere near the border, and comes out elsewhere.
TEST(Subject, TheOneOfSeveralThatWasHiddenIsFoundAgain) {
  auto frames = pair_of_walkers();
  for (std::size_t f = 40; f < 50; ++f) frames[f].blobs.pop_back();
  for (std::size_t f = 50; f < 100; ++f) frames[f].blobs[1].anchor_x -= 110;
  const Track track = follow(frames, 2);
  for (std::size_t f = 0; f < 100; ++f) {
    const bool seen = f < 40 || f >= 50;
    ASSERT_EQ(track.blob[f] != nullptr, seen) << f;
    if (seen) {
      EXPECT_GT(track.blob[f]->anchor_y, 200) << f;
    }
  }
}

TEST(Extract, AFrameThatTheCameraLeftOutIsTimeNotSpeed) {
  std::vector<FrameSummary> frames;
  for (int i = 0; i < 40; ++i) {
    const double x = 100 + 4 * (i < 20 ? i : i + 1);
    frames.push_back({i, {blob_at(x, 240)}, 5.0});
  }
  frames[20].lost_before = 1;
  const auto result = extract(frames, 30, "a.mp4", {});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->missing, 1);
  EXPECT_EQ(result->rows[19].duration, 2);
  for (const SampleRow& row : result->rows) EXPECT_NEAR(row.velocity_x, 120, 1e-6) << row.frame;
}

// A body whose tail comes and goes as a part of its own is whole when they are one.
TEST(Subject, ATailThatPartsAndJoinsHidesNothing) {
  auto frames = walk(100);
  for (std::size_t f = 0; f < 100; ++f)
    if (f % 9 == 0) {
      const double x = frames[f].blobs[0].anchor_x;
      frames[f].blobs = {blob_at(x + 4, 240, 30, 40)};
      add(frames[f], blob_at(x - 18, 240, 10, 40));
    }
  const Track track = follow(frames);
  EXPECT_EQ(std::count(track.fate.begin(), track.fate.end(), Fate::Kept), 100);
}

TEST(Extract, ADraftShowsEverySampleForTwoFrames) {
  std::vector<FrameSummary> frames;
  for (int i = 0; i < 40; ++i) frames.push_back({2 * i, {blob_at(100 + 4 * i, 240)}, 5.0});
  const auto result = extract(frames, 30, "a.mp4", {.stride = 2});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->rows[10].frame, 20);
  EXPECT_EQ(result->rows[10].duration, 2);
  EXPECT_NEAR(result->rows[10].velocity_x, 60, 1e-6);
}

TEST(Extract, MirroredSamplesFollowAndGoTheOtherWay) {
  const auto result = extract(walk(40), 30, "a.mp4", {.mirror = true});
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_EQ(result->rows.size(), 80u);
  for (std::size_t i = 0; i < 40; ++i) {
    const SampleRow &row = result->rows[i], &other = result->rows[40 + i];
    EXPECT_EQ(other.mirror_of, static_cast<int>(i));
    EXPECT_EQ(other.clip, row.clip + 1);
    EXPECT_EQ(other.velocity_x, -row.velocity_x);
    EXPECT_EQ(other.anchor_x - other.left, row.left + row.width - row.anchor_x);
  }
}

TEST(Extract, TheFilmCutsWhereThePictureChangesAtOnce) {
  auto frames = walk(60);
  frames[30].difference = 60;
  const auto result = extract(frames, 30, "a.mp4", {});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->clips, 2);
  EXPECT_EQ(result->cuts, 1);
  EXPECT_EQ(result->rows[30].clip, 1);
}

TEST(Extract, GroundAnchorLiesBelowTheCentroid) {
  auto frames = walk(40);
  for (std::size_t f = 0; f < frames.size(); ++f)
    frames[f].ground = {f == 20 ? 250.0 : 259.5};  // one frame flickers
  const auto result = extract(frames, 30, "a.mp4", {.ground = true});
  ASSERT_TRUE(result) << result.error().message;
  for (const SampleRow& row : result->rows) {
    EXPECT_EQ(row.anchor_y, 259.5);
    EXPECT_EQ(row.anchor_x, 100 + 2 * row.frame);
  }
}

TEST(Extract, GroundAnchorFollowsSteadyMotionDownThePictureToTheEndsOfTheClip) {
  auto frames = walk(40);
  for (std::size_t f = 0; f < frames.size(); ++f)
    frames[f].ground = {200 + 0.75 * static_cast<double>(f)};
  const auto result = extract(frames, 30, "a.mp4", {.ground = true});
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_EQ(result->rows.size(), 40u);
  for (const SampleRow& row : result->rows) EXPECT_EQ(row.anchor_y, 200 + 0.75 * row.frame);
}

// A box of 8 x 30 from (10, 20) on, and `skirt` rows of little coverage below it.
KeyedFrame box_with_skirt(int skirt) {
  KeyedFrame keyed;
  keyed.crop = {10, 20, 8, 30 + skirt};
  keyed.straight.width = 8;
  keyed.straight.height = 30 + skirt;
  keyed.straight.rgba.assign(4u * 8 * 30, 255);
  keyed.straight.rgba.resize(4u * 8 * static_cast<std::size_t>(30 + skirt), 80);
  keyed.labels.assign(8u * static_cast<std::size_t>(30 + skirt), 1);
  Blob blob;
  blob.box = keyed.crop;
  blob.area = 8 * (30 + skirt * 80 / 255.0);
  blob.label = 1;
  keyed.blobs = {blob};
  return keyed;
}

TEST(Extract, GroundLineIsWhereTheLowestPartEnds) {
  EXPECT_NEAR(ground_lines(box_with_skirt(0))[0], 50 - 0.0002 * 30, 1e-9);
}

TEST(Extract, LittleCoverageBelowTheFeetIsNotTheGround) {
  EXPECT_NEAR(ground_lines(box_with_skirt(6))[0], 50, 0.3);
}

}  // namespace
}  // namespace vsprite
