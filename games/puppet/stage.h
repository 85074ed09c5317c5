// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// stage.h - what happens: held keys and a point to reach for in, poses out, 60 times a second. The
// stage is 1280 x 720 px.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "vsprite/geometry.h"
#include "vsprite/puppet.h"
#include "vsprite/result.h"

namespace vsprite::puppet {

inline constexpr Vec2 kStage{1280, 720};
inline constexpr float kGround = 610;
inline constexpr float kSole = 8;  ///< px of mesh below a shoe
inline constexpr Vec2 kShoulder{560, 380};
inline constexpr double kTicksPerSecond = 60;

enum class Scene { Face, Walk, Jump, Arm };
inline constexpr int kSceneCount = 4;

/// One puppet where it stands.
struct Character {
  const Puppet* puppet = nullptr;
  PuppetPose pose;
  Vec2 at;  ///< of the barycentre, stage px
  float scale = 1;
};

/// The five puppets of a pack, by name.
struct Cast {
  const Puppet *face = nullptr, *john = nullptr, *jayne = nullptr, *jump = nullptr, *arm = nullptr;
};
/// Errors: BadContent, naming the puppet that is not there.
Result<Cast> find_cast(const std::vector<Puppet>& puppets, const std::string& pack);

struct Held {
  float x = 0, y = 0;           ///< -1, 0 or 1: right, down
  std::optional<Vec2> pointer;  ///< stage px, when it has moved
};
Held held(Direction direction) noexcept;

class Stage {
 public:
  explicit Stage(const Cast& cast);

  Scene scene = Scene::Face;
  /// One tick of the scene that is seen. Does not allocate.
  void step(const Held& keys) noexcept;
  /// Those of the scene, from the back to the front.
  const std::vector<Character>& characters(Scene of) const noexcept {
    return actors_[static_cast<std::size_t>(of)];
  }
  Vec2 face() const noexcept { return {rotation_, expression_}; }  ///< each 0..1 of its range
  float walked() const noexcept { return walked_; }                ///< px that the ground has gone
  Vec2 target() const noexcept { return target_; }                 ///< of the hand
  Vec2 hand() const noexcept;                                      ///< stage px

 private:
  std::vector<Character>& all(Scene of) { return actors_[static_cast<std::size_t>(of)]; }
  void step_face(const Held& keys) noexcept;
  void step_walk(const Held& keys) noexcept;
  void step_jump(const Held& keys) noexcept;
  void step_arm(const Held& keys) noexcept;

  Cast cast_;
  std::array<std::vector<Character>, kSceneCount> actors_;
  float rotation_ = 0.5f, expression_ = 0.4f, turn_ = 0, mood_ = 0;  // speeds
  float phase_ = 0, pace_ = 0.8f, walked_ = 0, stride_ = 1;          // cycles; cycles a second
  float time_ = 0.2f, flight_ = -1, ground_x_ = 260,
        ground_y_ = 0;  // of the jump, -1: on the ground
  PuppetPose target_pose_;
  Vec2 target_{760, 300};
  double shoulder_ = 0.4, elbow_ = -1, upper_ = 1, fore_ = 1;
};

}  // namespace vsprite::puppet
