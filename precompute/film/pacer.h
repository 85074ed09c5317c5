// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/pacer.h - a film of uneven times brought to its own rate: which frames are missing, which
// are too much.
#pragma once

#include <cstdint>

#include "film/video.h"

namespace vsprite {

/// Follows the time stamps as a clock that drifts and trembles: what it is off by is forgotten at a
/// sixteenth a frame, so that a rate that is a little wrong loses no frames. In integers.
class Pacer {
 public:
  Pacer() = default;
  explicit Pacer(const FilmInfo& info)
      : numerator_(std::int64_t{info.fps_numerator} * info.time_numerator * kFrame),
        denominator_(std::int64_t{info.fps_denominator} * info.time_denominator) {}

  /// How many frames are missing before the one shown at `time`; -1: another stands for its time
  /// already. Time stamps that are absent or run backwards say nothing: 0.
  int lost_before(std::int64_t time) noexcept {
    const std::int64_t last = last_;
    last_ = time;
    if (last == Frame::kNoTime || time == Frame::kNoTime || time <= last || denominator_ <= 0)
      return 0;
    const std::int64_t ticks = time - last < kMostTicks ? time - last : kMostTicks;
    off_ += ticks * numerator_ / denominator_ - kFrame;
    if (off_ <= -kTolerance) {
      off_ += kFrame;
      return -1;
    }
    const std::int64_t lost = off_ < kTolerance ? 0 : (off_ + kFrame / 2) / kFrame;
    off_ -= lost * kFrame;
    off_ -= off_ / 16;
    return static_cast<int>(lost < kMostLost ? lost : kMostLost);
  }

 private:
  static constexpr std::int64_t kFrame = 1024, kTolerance = 640;  // 5/8 of a frame
  static constexpr std::int64_t kMostTicks = std::int64_t{1} << 32, kMostLost = 1 << 20;
  std::int64_t numerator_ = 0, denominator_ = 0, off_ = 0, last_ = Frame::kNoTime;
};

}  // namespace vsprite
