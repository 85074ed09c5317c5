// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// world.h - everything that happens in the tank: fish, flakes, the round and its score.
//
// One tick is one frame of the film. The world is deterministic: same pack, same seed, same inputs,
// the same `states_hash`. It draws nothing and hears nothing; `events` tells those who do.
// Tank pixels: 1280 x 720, x right, y down, surface at y = 0. An actor lives in its own sprite
// pixels; `scale` tank pixels make one of them, so a far fish is small, slow and has a wide room.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "random.h"
#include "vsprite/actor.h"
#include "walls.h"

namespace aquarium {

inline constexpr float kTankWidth = 1280;
inline constexpr float kTankHeight = 720;
inline constexpr float kFloor = 668;  ///< lowest point of a near body
inline constexpr float kRoundSeconds = 60;
inline constexpr int kMaxCombo = 5;

/// What a fish without a player is about to do.
struct Mind {
  enum class Wish : std::uint8_t { Swim, Glide, Rest, Feed } wish = Wish::Glide;
  vsprite::Direction direction = vsprite::Direction::None;
  int ticks_left = 0;
  std::uint32_t flake = 0;  ///< id of the one it is after
};

struct Fish {
  vsprite::Actor actor;
  float scale = 1;              ///< tank px per sprite px
  float depth = 0;              ///< 0 at the front glass .. 1 at the back
  vsprite::Vec2 heading{1, 0};  ///< smoothed, unit length
  vsprite::Vec2 glide;          ///< sprite px it went in the last tick
  Guard guard;
  Mind mind;
};

struct Flake {
  std::uint32_t id = 0;
  vsprite::Vec2 at;         ///< tank px
  float column = 0;         ///< x about which it sways
  float fall = 0;           ///< tank px a tick
  float phase = 0;          ///< of the swaying, turns
  float size = 8;           ///< tank px
  std::uint8_t dainty = 0;  ///< 1: worth three
  int age = 0;              ///< ticks
  int rested = 0;           ///< ticks on the floor
};

enum class EventKind : std::uint8_t { Bite, Stolen, Splash, Start, LastSeconds, End };
struct Event {
  EventKind kind = EventKind::Bite;
  vsprite::Vec2 at;
  int points = 0;
  int combo = 0;
};

enum class Phase : std::uint8_t { Ready, Playing, Over };

/// What the player does in one tick.
struct Input {
  vsprite::Direction direction = vsprite::Direction::None;
  std::optional<vsprite::Vec2> target = {};  ///< tank px; replaces `direction`
  bool start = false;                        ///< begins a new round once one is over
};

struct World {
  std::vector<Fish> fish;  ///< the player's first, then the others from near to far
  std::vector<Flake> flakes;
  std::vector<Event> events;  ///< of the last tick
  Random dice;
  int look_ahead = 30;  ///< ticks, measure_look_ahead
  Phase phase = Phase::Ready;
  bool paused = false;
  std::uint64_t tick = 0;
  int round_ticks = 0;  ///< left of the round
  int until_drop = 0;
  int since_bite = 0;
  int score = 0;
  int eaten = 0;
  int stolen = 0;
  int combo = 0;
  int best_combo = 0;
  int phase_ticks = 0;  ///< since the phase began
  std::uint32_t next_id = 1;
  int steered_ticks = 0;  ///< of all rounds
  int refused_ticks = 0;  ///< of these: the glass replaced the player's command
};

/// A tank with the player's fish and `others` (2..6) that live by themselves.
World make_world(const vsprite::Sprite& sprite, std::uint64_t seed, int others = 4);

/// One tick; nothing moves while paused.
void step(const vsprite::Sprite& sprite, World& world, const Input& input);

/// Where the drawn body may be, in the fish's own sprite pixels.
Box room_of(const Fish& fish) noexcept;

/// The mouth, estimated: anchor + 0.4 body lengths along the heading; tank px.
vsprite::Vec2 mouth_of(const vsprite::Sprite& sprite, const Fish& fish) noexcept;

/// What a resting fish adds to the film's way in the tick to come, sprite px. From swimming to
/// standing the film takes three frames: water does not stop a body so fast, so it glides.
vsprite::Vec2 glide_of(const vsprite::Sprite& sprite, const Fish& fish) noexcept;

/// The anchor, tank px.
vsprite::Vec2 place_of(const Fish& fish) noexcept;

/// Seconds left of the round, rounded up.
int seconds_left(const vsprite::Sprite& sprite, const World& world) noexcept;

/// FNV-1a over every state that matters to a replay.
std::uint64_t states_hash(const World& world) noexcept;

}  // namespace aquarium
