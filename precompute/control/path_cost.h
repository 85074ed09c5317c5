// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/path_cost.h - what it costs to show a sample on a drawn path.
//
//     C(k) = T_(i_k-1, i_k) + w1 a(i_k, l_k) + w2 d(p_k, l_k)^2            [NIPS section 3, eq. 1]
//     a(i, l) = f |angle(v_i, l)| + (1 - f) pi,   f = min(1, |v_i| / v0)
//
// a tick. l_k is the segment that is being followed: the next one as soon as the projection of the
// position passes the end of the current one, so that a path may cross itself. p_k moves by the
// step of the sample shown before, so d is known before the next sample is chosen: the cost splits
// into what a sequence pays by moving on, and what each of its successors adds.
//
// The paper leaves speed and timing free: tau = 0. Then whoever dawdles looks cheap for as long as
// it dawdles, and a beam that compares sequences of equal duration may lose all that ever arrive.
// With tau > 0 a tick has a price, and sequences are compared by cost + tau (ticks to go at the
// usual speed).
//
// Costs count in whole 1/2^20 of the classifier's threshold: sums do not depend on their order.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "vsprite/geometry.h"
#include "vsprite/result.h"
#include "vsprite/sprite.h"

namespace vsprite {

using Cost = std::int64_t;
inline constexpr double kCostOne = 1 << 20;
inline constexpr Cost kNoCost = INT64_MAX;
inline constexpr double kPathUnit = 65536;  ///< of a position, per px
inline constexpr double kPathArcUnit = 64;  ///< of progress, per px

struct PathWeights {
  double w1 = 1;           ///< per radian off the segment and tick, 0..1000
  double w2 = 1e-3;        ///< per squared px off the segment and tick, 0..1000
  double tau = 0;          ///< per tick, 0..1000
  double usual_speed = 1;  ///< px/s, > 0: at which the rest of the path is expected to be covered
  double v0 = 1;           ///< px/s, > 0: a slower sample's direction means little
  double least_speed = 0;  ///< px/s of progress along the path, >= 0; 0 = any
  double patience = 2;     ///< s: whoever falls behind `least_speed` by what this long a rest
                           ///< would cost is dropped
};

/// A straight piece of the path; 1/65536 px from the path's first point.
struct PathSegment {
  double x = 0, y = 0;            ///< where it starts
  double unit_x = 1, unit_y = 0;  ///< its direction
  double length = 0;              ///< > 0
  double arc = 0;                 ///< length of all segments before, 1/64 px
  double heading = 0;             ///< angle_of its direction
  std::uint32_t direction = 0;    ///< equal for segments of equal direction, from 0
};

/// Where a sequence has come to. Positions: 1/65536 px from the path's first point.
struct PathState {
  Cost cost = 0;  ///< of all ticks up to the one in which `sample` appears
  std::int32_t x = 0, y = 0;
  std::uint32_t sample = 0;
  std::uint32_t segment = 0;
  std::uint32_t arc = 0;   ///< progress along the path, 1/64 px
  std::int32_t slack = 0;  ///< how much further it may fall behind, 1/64 px
};

/// How a tick or a sample ends.
enum class PathEnd : std::uint8_t { OnTheWay, Arrived, Dropped };

/// The path, the weights, and what equation 1 needs to know of every sample. Borrows the sprite.
class PathCost {
 public:
  /// Points in px; equal neighbours count once.
  /// Errors: BadContent (fewer than two different points, not finite), LimitExceeded (more than
  /// 1,000,000 points, 30,000 px from the first, 30,000,000 px long).
  static Result<PathCost> make(const Sprite& sprite, std::span<const Vec2> points,
                               const PathWeights& weights);

  const Sprite& sprite() const { return *sprite_; }
  std::span<const PathSegment> segments() const { return segments_; }
  std::uint32_t direction_count() const { return direction_count_; }
  std::uint32_t longest_duration() const { return longest_duration_; }
  double length() const { return length_; }
  Vec2 origin() const { return origin_; }

  /// a(i, l) in radians.
  double angle(std::uint32_t sample, std::uint32_t segment) const;
  /// w1 a(i, l) as a cost.
  std::uint32_t angle_cost(std::uint32_t sample, std::uint32_t segment) const;
  /// T as a cost.
  static std::uint32_t transition_cost(float cost);

  /// A sequence that begins with `sample` at the path's first point.
  PathState seed(std::uint32_t sample) const;

  /// One tick of `sample`'s motion: position, then segment. Dropped: out of reach of the numbers.
  PathEnd move(std::uint32_t sample, std::int32_t& x, std::int32_t& y,
               std::uint32_t& segment) const;
  /// d(p, l), signed, px; l the infinite line.
  double deviation(std::int32_t x, std::int32_t y, std::uint32_t segment) const;
  /// Distance to the segment itself, from its start to its end, px.
  double distance(std::int32_t x, std::int32_t y, std::uint32_t segment) const;
  /// w2 d(p, l)^2 as a cost.
  Cost deviation_cost(std::int32_t x, std::int32_t y, std::uint32_t segment) const;

  /// Shows `from`'s sample to its end. `to` holds then the place of the next sample and everything
  /// paid but T and the angle of that sample (`sample` is left as it was).
  PathEnd leave(const PathState& from, PathState& to) const;
  /// What the rest of the path is expected to cost: tau (ticks to go at the usual speed).
  Cost estimate(const PathState& state) const {
    return static_cast<Cost>(tau_per_arc_ * (arc_length_ - static_cast<double>(state.arc)));
  }

 private:
  struct Motion {
    std::int32_t step_x, step_y;
    std::uint32_t duration;
    float heading;  ///< of the velocity
    float trust;    ///< f
  };
  const Sprite* sprite_ = nullptr;
  std::vector<PathSegment> segments_;
  std::vector<Motion> motions_;  ///< (N)
  double w1_ = 0, w2_ = 0;       ///< times kCostOne
  double length_ = 0;
  double tau_per_arc_ = 0, arc_length_ = 0;
  Cost tau_ = 0;
  std::int32_t least_step_ = 0;  ///< progress a tick, 1/64 px
  std::int32_t full_slack_ = 0;
  std::uint32_t direction_count_ = 0;
  std::uint32_t longest_duration_ = 1;
  Vec2 origin_;
};

inline PathEnd PathCost::move(std::uint32_t sample, std::int32_t& x, std::int32_t& y,
                              std::uint32_t& segment) const {
  constexpr std::int64_t kEdge = std::int64_t{32000} << 16;
  const std::int64_t to_x = std::int64_t{x} + motions_[sample].step_x;
  const std::int64_t to_y = std::int64_t{y} + motions_[sample].step_y;
  if (to_x > kEdge || to_x < -kEdge || to_y > kEdge || to_y < -kEdge) return PathEnd::Dropped;
  x = static_cast<std::int32_t>(to_x);
  y = static_cast<std::int32_t>(to_y);
  for (;; ++segment) {
    const PathSegment& s = segments_[segment];
    const double along = (x - s.x) * s.unit_x + (y - s.y) * s.unit_y;
    if (along < s.length) return PathEnd::OnTheWay;
    if (segment + 1 == segments_.size()) return PathEnd::Arrived;
  }
}

inline Cost PathCost::deviation_cost(std::int32_t x, std::int32_t y, std::uint32_t segment) const {
  constexpr double kMost = 1099511627776.0;  // 2^40
  const PathSegment& s = segments_[segment];
  const double d = (y - s.y) * s.unit_x - (x - s.x) * s.unit_y;
  return static_cast<Cost>(std::min(w2_ * d * d + 0.5, kMost));
}

// move() and deviation_cost() in one, with everything in registers: half of a search is this.
inline PathEnd PathCost::leave(const PathState& from, PathState& to) const {
  constexpr std::int64_t kEdge = std::int64_t{32000} << 16;
  constexpr double kMost = 1099511627776.0;  // 2^40
  const Motion& m = motions_[from.sample];
  const PathSegment* s = segments_.data() + from.segment;
  std::int64_t x = from.x, y = from.y;
  Cost cost = from.cost;
  double along = 0;
  for (std::uint32_t tick = 1;; ++tick) {
    x += m.step_x;
    y += m.step_y;
    // One test for both ends of both axes.
    const auto from_edge = [](std::int64_t at) { return static_cast<std::uint64_t>(at + kEdge); };
    if (std::max(from_edge(x), from_edge(y)) > std::uint64_t{2} * kEdge) [[unlikely]] {
      to = from;
      to.cost = cost;
      return PathEnd::Dropped;
    }
    const auto at_x = static_cast<double>(x), at_y = static_cast<double>(y);
    double dx = at_x - s->x, dy = at_y - s->y;
    along = dx * s->unit_x + dy * s->unit_y;
    while (along >= s->length) [[unlikely]] {
        if (s == &segments_.back()) {
          to = from;
          to.cost = cost;
          return PathEnd::Arrived;
        }
        ++s;
        dx = at_x - s->x, dy = at_y - s->y;
        along = dx * s->unit_x + dy * s->unit_y;
      }
    const double d = dy * s->unit_x - dx * s->unit_y;
    cost += static_cast<Cost>(std::min(w2_ * d * d + 0.5, kMost)) + tau_;
    if (tick >= m.duration) break;
    cost += angle_cost(from.sample, static_cast<std::uint32_t>(s - segments_.data()));
  }
  const auto arc =
      static_cast<std::uint32_t>(s->arc + std::max(0.0, along) * (kPathArcUnit / kPathUnit));
  std::int64_t slack = from.slack;
  if (full_slack_ != 0) {
    slack += std::int64_t{arc} - std::int64_t{from.arc} - std::int64_t{least_step_} * m.duration;
    slack = std::min<std::int64_t>(slack, full_slack_);
  }
  to.cost = cost;
  to.x = static_cast<std::int32_t>(x);
  to.y = static_cast<std::int32_t>(y);
  to.sample = from.sample;
  to.segment = static_cast<std::uint32_t>(s - segments_.data());
  to.arc = arc;
  to.slack = static_cast<std::int32_t>(std::max<std::int64_t>(slack, 0));
  return slack < 0 ? PathEnd::Dropped : PathEnd::OnTheWay;
}

}  // namespace vsprite
