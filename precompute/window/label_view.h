// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// label_view.h - what the label window shows. Decides nothing: buttons come back as actions.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tool/label_session.h"
#include "vsprite/draw.h"
#include "window/label_keys.h"

namespace vsprite::window {

inline constexpr int kLabelGrounds = 5;
inline constexpr float kSlowest = 0.1f, kFastest = 2;

/// What the person has set, and what was said last.
struct LabelLook {
  float speed = 0.5f;  ///< of the film's
  int ground = 0;      ///< 0..kLabelGrounds-1
  bool help = false;
  std::string said;  ///< about the last answer
};

/// One picture of the loop.
struct PlayedFrame {
  int sample = 0;
  Vec2 place{};      ///< film px, of the anchor; continuous over the cut
  double until = 0;  ///< film frames from the loop's start
};

/// The jump with its neighbours: up to 12 samples, the cut, up to 12 samples.
struct PlayedJump {
  std::vector<PlayedFrame> frames;
  double cut = 0;      ///< film frames from the start
  double length = 0;   ///< film frames, with the pause at the end
  Vec2 low{}, high{};  ///< film px: what the anchors and pictures cover
};
/// From `from` to the sample after `to`; at a clip's end to `to` itself.
PlayedJump make_jump(const FeatureSet& set, int from, int to);

class LabelView {
 public:
  explicit LabelView(const LabelSession& session) : session_(session) {}

  /// A new pair is current: plays from the start.
  Result<void> show();
  /// `seconds`: since the last picture. Returns what was clicked.
  /// Pre: between begin_frame and end_frame, and in a frame of Dear ImGui.
  std::optional<LabelAction> draw(Renderer& renderer, const LabelKeys& keys, LabelLook& look,
                                  double seconds, float ui);

 private:
  void draw_ground(Renderer& renderer, const Rect& area, int ground) const;
  void draw_sample(Renderer& renderer, int sample, Vec2 at, float scale) const;
  void draw_still(Renderer& renderer, const Rect& area, int sample, float scale, int ground) const;
  void draw_loop(Renderer& renderer, const Rect& area, const LabelLook& look, double seconds);
  std::optional<LabelAction> draw_side(const Rect& area, const LabelKeys& keys, LabelLook& look,
                                       float ui) const;

  const LabelSession& session_;
  std::map<int, Image> pictures_;  ///< premultiplied, of the current pair
  PlayedJump jumps_[2];            ///< there, and back
  int playing_ = 0;
  double at_ = 0;  ///< film frames
};

}  // namespace vsprite::window
