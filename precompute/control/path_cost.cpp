// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// NIPS section 3.1. Departures: standing costs pi (DESIGN section 2); a sample that is shown for
// several ticks pays for each; a sequence that makes no headway is dropped, or resting on the line
// would fill the beam.
#include "control/path_cost.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "similarity/features.h"

namespace vsprite {
namespace {

constexpr double kReach = 30000;  // px from the first point
constexpr double kLongest = 3e7;  // px
constexpr std::size_t kMostPoints = 1000000;

std::string point_text(std::size_t index, Vec2 p) {
  return "point " + std::to_string(index + 1) + " (" + std::to_string(p.x) + " " +
         std::to_string(p.y) + ")";
}

Result<void> check_points(std::span<const Vec2> points) {
  if (points.size() > kMostPoints)
    return Error{ErrorCode::LimitExceeded, "a path of " + std::to_string(points.size()) +
                                               " points: at most 1000000 are read"};
  if (points.size() < 2)
    return Error{ErrorCode::BadContent, "a path of " + std::to_string(points.size()) +
                                            (points.size() == 1 ? " point" : " points") +
                                            ": two different points are due"};
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!std::isfinite(points[k].x) || !std::isfinite(points[k].y))
      return Error{ErrorCode::BadContent, point_text(k, points[k]) + ": not a finite place"};
    if (std::fabs(points[k].x - points[0].x) > kReach ||
        std::fabs(points[k].y - points[0].y) > kReach)
      return Error{ErrorCode::LimitExceeded,
                   point_text(k, points[k]) + ": at most 30000 px from the first are due"};
  }
  return {};
}

std::uint32_t whole(double cost) {
  constexpr double kMost = 4294967294.0;  // the last value marks the end of a list
  return static_cast<std::uint32_t>(std::min(cost + 0.5, kMost));
}

}  // namespace

Result<PathCost> PathCost::make(const Sprite& sprite, std::span<const Vec2> points,
                                const PathWeights& weights) {
  if (auto checked = check_points(points); !checked) return checked.error();
  PathCost out;
  out.sprite_ = &sprite;
  out.origin_ = points[0];
  out.w1_ = weights.w1 * kCostOne;
  out.w2_ = weights.w2 * kCostOne / (kPathUnit * kPathUnit);

  std::map<std::pair<double, double>, std::uint32_t> directions;
  double x = 0, y = 0;
  for (const Vec2& point : points.subspan(1)) {
    const double to_x = static_cast<double>(point.x) - static_cast<double>(out.origin_.x);
    const double to_y = static_cast<double>(point.y) - static_cast<double>(out.origin_.y);
    const double dx = to_x - x, dy = to_y - y, length = std::sqrt(dx * dx + dy * dy);
    if (length == 0) continue;
    PathSegment s{.x = x * kPathUnit,
                  .y = y * kPathUnit,
                  .unit_x = dx / length,
                  .unit_y = dy / length,
                  .length = length * kPathUnit,
                  .arc = out.length_ * kPathArcUnit,
                  .heading = angle_of(dx, dy)};
    const auto next_id = static_cast<std::uint32_t>(directions.size());
    s.direction = directions.try_emplace({s.unit_x, s.unit_y}, next_id).first->second;
    out.segments_.push_back(s);
    out.length_ += length;
    x = to_x;
    y = to_y;
  }
  if (out.segments_.empty())
    return Error{ErrorCode::BadContent, "a path of zero length: two different points are due"};
  if (out.length_ > kLongest)
    return Error{ErrorCode::LimitExceeded,
                 "a path of " + std::to_string(out.length_) + " px: at most 30000000 are searched"};
  out.direction_count_ = static_cast<std::uint32_t>(directions.size());

  for (const Sample& sample : sprite.samples()) {
    const double vx = static_cast<double>(sample.velocity.x);
    const double vy = static_cast<double>(sample.velocity.y);
    const double trust = std::min(1.0, std::sqrt(vx * vx + vy * vy) / weights.v0);
    out.motions_.push_back({sample.step_x, sample.step_y, sample.duration,
                            static_cast<float>(angle_of(vx, vy)), static_cast<float>(trust)});
    if (sample.kept)
      out.longest_duration_ = std::max<std::uint32_t>(out.longest_duration_, sample.duration);
  }
  out.tau_ = static_cast<Cost>(weights.tau * kCostOne + 0.5);
  out.tau_per_arc_ = weights.tau * kCostOne * sprite.fps() / (weights.usual_speed * kPathArcUnit);
  out.arc_length_ = out.length_ * kPathArcUnit;
  out.least_step_ =
      static_cast<std::int32_t>(weights.least_speed / sprite.fps() * kPathArcUnit + 0.5);
  out.full_slack_ = static_cast<std::int32_t>(
      std::min(1e9, weights.least_speed * weights.patience * kPathArcUnit + 0.5));
  return out;
}

double PathCost::angle(std::uint32_t sample, std::uint32_t segment) const {
  const Motion& m = motions_[sample];
  double turn = std::fabs(static_cast<double>(m.heading) - segments_[segment].heading);
  if (turn > kPi) turn = 2 * kPi - turn;
  const double trust = static_cast<double>(m.trust);
  return trust * turn + (1 - trust) * kPi;
}

std::uint32_t PathCost::angle_cost(std::uint32_t sample, std::uint32_t segment) const {
  return whole(w1_ * angle(sample, segment));
}

std::uint32_t PathCost::transition_cost(float cost) {
  return whole(static_cast<double>(cost) * kCostOne);
}

PathState PathCost::seed(std::uint32_t sample) const {
  PathState state;
  state.cost = angle_cost(sample, 0);
  state.sample = sample;
  state.slack = full_slack_;
  return state;
}

double PathCost::deviation(std::int32_t x, std::int32_t y, std::uint32_t segment) const {
  const PathSegment& s = segments_[segment];
  return ((y - s.y) * s.unit_x - (x - s.x) * s.unit_y) / kPathUnit;
}

double PathCost::distance(std::int32_t x, std::int32_t y, std::uint32_t segment) const {
  const PathSegment& s = segments_[segment];
  const double along = (x - s.x) * s.unit_x + (y - s.y) * s.unit_y;
  const double beyond = (along - std::clamp(along, 0.0, s.length)) / kPathUnit;
  const double across = deviation(x, y, segment);
  return std::sqrt(across * across + beyond * beyond);
}

}  // namespace vsprite
