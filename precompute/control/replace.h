// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/replace.h - scenes: sprites on cue, by repeated replacement of subsequences.
//
// After Schoedl and Essa, Controlled Animation of Video Sprites (SCA 2002): a beam cannot look
// seconds ahead, so a whole sequence is kept, a part of it is replaced by another that fits at both
// ends, and the change stays if the sum of all costs falls:
//
//     C = sum over ticks of T + sum over terms of weight x (how far the term is from being met)
//
// What fits is found with the tables that steer the sprite: from somewhere in the sequence follow
// one direction for a while, then take an accepted transition back into the old sequence, whose
// rest moves along. Sprites take turns of kTurn proposals each, so that they make room for one
// another. Anytime: the best so far is always whole. The same seed and proposal count give the same
// result.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "control/search.h"
#include "vsprite/result.h"
#include "vsprite/sprite.h"

namespace vsprite {

/// One wish, per tick in [from, to). Distances count in the sprite's body lengths b.
struct SceneTerm {
  enum class Kind : std::uint8_t {
    Location,   ///< (max(0, |p - at| - radius) / b)^2
    Path,       ///< (d(p, l) / b)^2 + a(i, l), along `points` as in search.h
    Heading,    ///< a(i, l) in radians, l at `angle`
    Speed,      ///< ((|v| - speed) / v0)^2
    Pose,       ///< ticks of film between the sample and `sample`, at most 30, / 30; other clips 1
    Region,     ///< (how far p lies outside [low, high] / b)^2
    KeepClear,  ///< (max(0, distance - |p - p_other|) / b)^2
    Meet,       ///< (max(0, |p - p_other| - distance) / b)^2
  };
  Kind kind = Kind::Location;
  double weight = 1;
  std::uint32_t from = 0, to = std::numeric_limits<std::uint32_t>::max();  ///< ticks
  Vec2 at{};                                                               ///< Location
  double radius = 0;                                                       ///< Location, px
  std::vector<Vec2> points{};                                              ///< Path, px
  double angle = 0;                                                        ///< Heading, radians
  double speed = 0;                                                        ///< Speed, px/s
  std::uint32_t sample = 0;                                                ///< Pose
  Vec2 low{}, high{};                                                      ///< Region
  std::uint32_t other = 0;  ///< KeepClear, Meet: index of the other sprite
  double distance = 0;      ///< KeepClear, Meet, px
};

/// One sprite's part. Borrows the sprite.
struct SceneRole {
  const Sprite* sprite = nullptr;
  Vec2 start;
  std::vector<SceneTerm> terms;
};

struct Scene {
  std::uint32_t ticks = 0;
  std::vector<SceneRole> roles;
};

/// How far one term is from being met.
struct TermReport {
  std::size_t role = 0, term = 0;
  double cost = 0;   ///< its share of the sum
  double worst = 0;  ///< largest value in a tick, without the weight; of a path (d / b)^2 alone
  std::uint32_t worst_tick = 0;
};

struct SceneResult {
  std::vector<Clip>
      clips;  ///< one a role, scene.ticks long; ClipTick's segment, angle, deviation: 0
  double cost = 0;
  std::vector<TermReport> terms;
  std::uint64_t proposals = 0, accepted = 0;
};

struct ReplaceConfig {
  std::uint64_t seed = 1;
  std::uint64_t proposals = std::numeric_limits<std::uint64_t>::max();  ///< stop after so many
  /// What to start from: the samples of each role, each a successor of the one before. Empty: the
  /// sprites play by themselves.
  std::vector<std::vector<std::uint32_t>> start = {};
  /// Asked now and then with the cost so far; false stops the search. Must be set, or `proposals`.
  std::function<bool(std::uint64_t proposals, double cost)> go_on = {};
};

/// Errors: BadContent (a scene without sprites or ticks, a term that names a sample or sprite that
/// is not there, not finite), naming role and term from 1.
Result<void> check_scene(const Scene& scene);

/// Pre: check_scene.
SceneResult replace_search(const Scene& scene, const ReplaceConfig& config);

/// The rival: a beam of `width` over the same sum, tick by tick, without looking ahead.
/// Pre: check_scene; one role, every sample shown for one tick (asserted: this is for comparison).
SceneResult scene_beam(const Scene& scene, int width);

}  // namespace vsprite
