// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/checkup.h - what a film is like, before anything is built from it: measured on runs of
// consecutive frames spread over the film. Nothing here decides a byte of a pack.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "film/matte.h"
#include "film/video.h"
#include "vsprite/geometry.h"

namespace vsprite {

/// The share of a part that shows as holes, 0..1: what the outside does not reach, inside its box.
double hole_share(const KeyedFrame& keyed, const Blob& blob);

/// Black bars about the picture, px; 0: none on that side.
struct Bars {
  int top = 0, bottom = 0, left = 0, right = 0;
  bool any() const noexcept { return top + bottom + left + right > 0; }
  /// "black bars (top 20 px, bottom 20 px)".
  std::string text() const;
  /// Frames of `width` x `height` without them and the two pixels beside them, in even numbers, as
  /// ffmpeg's filter says it: "crop=640:436:0:22".
  std::string crop(int width, int height) const;
};
/// Lines of all frames that are flat and black, where the picture beside them begins along the
/// whole side: a subject before black has none. `frames`: of one size.
Bars find_bars(std::span<const Frame> frames);

/// Consecutive frames from somewhere in the film, and what the keyer made of them.
struct Burst {
  std::vector<Frame> frames;
  std::vector<KeyedFrame> keyed;  ///< index by index
};

/// What was measured. Shares are of the frames that were looked at, 0..1.
struct Checkup {
  int frames = 0;  ///< looked at

  bool plain = false;         ///< the background shows too little to tell a moving camera by
  double camera_shake = 0;    ///< px, median way of the background from one frame to the next
  double camera_shift = 0;    ///< px, largest way of the background between any two runs
  double exposure_shift = 0;  ///< share of its brightness by which the background changes, largest
  double exposure_step = 0;   ///< likewise, from one frame to the next
  double white_shift = 0;     ///< code values of Cb and Cr by which it changes, largest

  double repeated = 0;   ///< share of the moving frames that repeat the one before
  double irregular = 0;  ///< share of frames that come early or late by over a quarter

  double unevenness = 0;  ///< brightest less darkest tenth of the background, share of its mean
  double lost = 0;        ///< share of the subject that shows as holes, median

  double present = 0, whole = 0, several = 0;  ///< shares
  double body = 0;                             ///< px, median longer side of the whole subject
  double edge_slow = 0, edge_fast = 0;     ///< px, width of the soft edge: slowest, fastest third
  double speed_usual = 0, speed_fast = 0;  ///< px/s: median of what moves, 95th percentile
  double still = 0;                        ///< share of the whole frames in which it rests
  std::array<double, kCompassCount> headings{};  ///< share of the whole frames, by direction
};

/// Collects run after run; memory stays that of a few numbers a frame.
class CheckupMeter {
 public:
  explicit CheckupMeter(double fps, double seconds_per_tick) : fps_(fps), tick_(seconds_per_tick) {}
  void add(const Burst& burst);
  Checkup finish() const;

 private:
  /// A frame's brightness at a quarter of its size or less, and where the subject is not.
  struct Small {
    int width = 0, height = 0, factor = 1;
    std::vector<float> y;
    std::vector<std::uint8_t> cb, cr;
    std::vector<std::uint8_t> bare;
  };
  struct Seen {
    bool present = false, whole = false, several = false;
    double side = 0, area = 0, edge = 0, lost = 0;
    double speed = -1;  ///< px/s; below 0: not known
    Vec2 heading{};
  };
  /// How the light changed from one to the other where both are bare: medians.
  struct Light {
    double exposure = 0, cb = 0, cr = 0;
  };
  static Small shrink(const Frame& frame, const KeyedFrame& keyed);
  static Light compare_light(const Small& from, const Small& to);
  void add_subject(const Burst& burst);
  void add_background(const Burst& burst);

  double fps_, tick_;
  std::vector<Seen> seen_;
  std::vector<Small> firsts_;  ///< of each run, at most some dozens
  std::vector<double> shakes_, steps_;
  int textured_ = 0, looked_ = 0;
  int moving_ = 0, repeated_ = 0;
  int gaps_ = 0, irregular_ = 0;
  std::vector<double> uneven_;
};

}  // namespace vsprite
