// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// pose_truth.h - what a perfect eye would say about two samples of the bundled film.
//
// The film is rendered, so every point of the fish's surface is known. With p the points' places
// about their mean, v the fish's velocity and tau = 3 frames (100 ms: how long an eye follows a
// motion on),
//
//     e_ij = sqrt( mean |p_i - p_j|^2 + (tau |v_i - v_j|)^2 )     film px
//
// is how far off the fish is drawn where j stands for i. The film moves its own surface all the
// time, and nobody calls that a jump: a pair is acceptable where e is no larger than between
// neighbouring frames in 19 of 20 places of the film where the fish moves (7.3 px of its 160).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "capture/fish_model.h"
#include "capture/goldfish.h"
#include "similarity/features.h"

namespace vsprite::testing {

class PoseTruth {
 public:
  PoseTruth(const capture::GoldfishFilm& film, const FeatureSet& set) {
    const double tau = 3 / film.fps();
    std::vector<capture::Vec3> outline;
    for (const SampleRow& row : set.rows) {
      const capture::FishPose& pose = film.pose(row.frame);
      capture::outline_fish(pose, outline);
      Sample s{{}, tau * pose.velocity_x, tau * pose.velocity_y};
      double x = 0, y = 0;
      for (const auto& p : outline) x += double{p.x}, y += double{p.y};
      const auto n = static_cast<double>(outline.size());
      for (const auto& p : outline) {
        s.points.push_back(static_cast<float>(double{p.x} - x / n));
        s.points.push_back(static_cast<float>(double{p.y} - y / n));
      }
      samples_.push_back(std::move(s));
    }
    std::vector<double> own;
    for (std::size_t i = 0; i + 1 < set.rows.size(); ++i) {
      const bool together = set.rows[i].clip == set.rows[i + 1].clip &&
                            set.rows[i + 1].frame == set.rows[i].frame + 1;
      if (together && double{set.samples[i].speed} > set.moving_speed)
        own.push_back(difference(static_cast<int>(i), static_cast<int>(i) + 1));
    }
    std::sort(own.begin(), own.end());
    limit_ = own.empty() ? 0 : own[own.size() * 19 / 20];
  }

  /// Film px.
  double difference(int i, int j) const {
    const Sample& a = samples_[static_cast<std::size_t>(i)];
    const Sample& b = samples_[static_cast<std::size_t>(j)];
    float sum = 0;
    for (std::size_t k = 0; k < a.points.size(); ++k) {
      const float d = a.points[k] - b.points[k];
      sum += d * d;
    }
    const double place = 2 * double{sum} / static_cast<double>(a.points.size());
    const double x = a.lead_x - b.lead_x, y = a.lead_y - b.lead_y;
    return std::sqrt(place + x * x + y * y);
  }
  /// Film px.
  double limit() const { return limit_; }
  bool acceptable(int i, int j) const { return difference(i, j) <= limit_; }

 private:
  struct Sample {
    std::vector<float> points;      ///< x, y about their mean, film px
    double lead_x = 0, lead_y = 0;  ///< tau v
  };
  std::vector<Sample> samples_;
  double limit_ = 0;
};

}  // namespace vsprite::testing
