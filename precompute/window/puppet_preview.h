// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// puppet_preview.h - the character that points make, fitted anew while they are dragged.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tool/points_edit.h"
#include "vsprite/draw.h"
#include "vsprite/puppet.h"

namespace vsprite::window {

class PuppetPreview {
 public:
  /// Fits where the points have changed; a slow fit waits until a drag has come to rest for as long
  /// as it takes. `seconds`: since the last call.
  void follow(Renderer& renderer, const PointsEdit& edit, double seconds);
  /// The puppet for the parameters as they are. Pre: between begin_frame and end_frame.
  void draw(Renderer& renderer, const Rect& area);

  const std::vector<Puppet>& puppets() const { return puppets_; }
  const std::string& fault() const { return fault_; }  ///< why there is none for the points as is
  double fit_seconds() const { return fit_seconds_; }

  std::vector<double> parameters{};  ///< of the puppets, changed from outside
  bool playing = true;               ///< they go round by themselves
  std::size_t shown = 0;             ///< which puppet

 private:
  void fit(Renderer& renderer, const PointsEdit& edit);
  void find_reach();

  std::vector<Puppet> puppets_;
  PuppetPose pose_;
  Vec2 low_{}, high_{};  ///< px: what the examples' poses cover
  std::optional<PuppetSkin> skin_;
  std::size_t skin_of_ = 0;
  std::size_t version_ = 0;  ///< of the edit that was fitted last
  double fit_seconds_ = 0, since_ = 0, time_ = 0;
  std::string fault_;
};

}  // namespace vsprite::window
