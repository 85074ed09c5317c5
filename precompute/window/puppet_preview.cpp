// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "window/puppet_preview.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace vsprite::window {
namespace {

constexpr double kRound = 5;      // seconds of playing until all parameters are where they were
constexpr double kAtOnce = 0.05;  // a fit that takes no longer is made in every picture

}  // namespace

void PuppetPreview::fit(Renderer& renderer, const PointsEdit& edit) {
  version_ = edit.version();
  since_ = 0;
  const auto begun = std::chrono::steady_clock::now();
  auto made = fit_puppets(edit.set());
  fault_ = made ? std::string() : made.error().message;
  if (!made) return;  // the last good one goes on
  puppets_ = std::move(*made);
  shown = std::min(shown, puppets_.size() - 1);
  if (skin_) renderer.free_skin(*skin_);
  skin_.reset();
  const Puppet& puppet = puppets_[0];
  pose_ = make_pose(puppet);
  if (parameters.size() != puppet.parameters.size()) {
    parameters.clear();
    for (const PuppetParameter& p : puppet.parameters) parameters.push_back((p.low + p.high) / 2);
  }
  find_reach();
  fit_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

void PuppetPreview::find_reach() {
  low_ = {HUGE_VALF, HUGE_VALF}, high_ = {-HUGE_VALF, -HUGE_VALF};
  for (const Puppet& puppet : puppets_) {
    PuppetPose pose = make_pose(puppet);
    const auto dims = static_cast<std::size_t>(puppet.net.dims);
    const auto extend = [&](const RbfNetwork& net) {
      for (std::size_t k = 0; k + dims <= net.centers.size(); k += dims) {
        pose_puppet(puppet, std::span(net.centers).subspan(k, dims), pose);
        for (const Vec2 p : pose.points) {
          low_ = {std::min(low_.x, p.x + pose.center.x), std::min(low_.y, p.y + pose.center.y)};
          high_ = {std::max(high_.x, p.x + pose.center.x), std::max(high_.y, p.y + pose.center.y)};
        }
      }
    };
    extend(puppet.net);
    for (const ExampleSet& set : puppet.sets) {
      pose.set = static_cast<int>(&set - puppet.sets.data());
      extend(set.net);
    }
  }
}

void PuppetPreview::follow(Renderer& renderer, const PointsEdit& edit, double seconds) {
  since_ += seconds;
  const bool may_wait = fit_seconds_ > kAtOnce && edit.held();
  if (edit.version() != version_ && !(may_wait && since_ < 2 * fit_seconds_)) fit(renderer, edit);
  if (puppets_.empty()) return;
  if (!skin_ || skin_of_ != shown) {
    if (skin_) renderer.free_skin(*skin_);
    skin_.reset();
    auto skin = renderer.make_skin(puppets_[shown]);
    if (skin)
      skin_ = *skin;
    else
      fault_ = skin.error().message;
    skin_of_ = shown;
  }
  if (!playing) return;
  time_ += seconds;
  for (std::size_t d = 0; d < parameters.size(); ++d) {
    const PuppetParameter& p = puppets_[0].parameters[d];
    const double turn = time_ / kRound + 0.25 * static_cast<double>(d);
    parameters[d] = p.period > 0 ? p.low + p.period * (turn - std::floor(turn))
                                 : (p.low + p.high) / 2 +
                                       (p.high - p.low) / 2 * std::sin(2 * std::numbers::pi * turn);
  }
}

void PuppetPreview::draw(Renderer& renderer, const Rect& area) {
  if (!skin_ || puppets_.empty()) return;
  const Puppet& puppet = puppets_[shown];
  constexpr float kRoom = 0.94f;
  const float scale =
      kRoom * std::min(static_cast<float>(area.width) / std::max(high_.x - low_.x, 1.0f),
                       static_cast<float>(area.height) / std::max(high_.y - low_.y, 1.0f));
  const Vec2 corner{static_cast<float>(area.x) + static_cast<float>(area.width) / 2 -
                        scale * (low_.x + high_.x) / 2,
                    static_cast<float>(area.y) + static_cast<float>(area.height) / 2 -
                        scale * (low_.y + high_.y) / 2};
  pose_puppet(puppet, parameters, pose_);
  renderer.draw_puppet(puppet, pose_, *skin_,
                       {corner.x + scale * pose_.center.x, corner.y + scale * pose_.center.y},
                       scale);
}

}  // namespace vsprite::window
