// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/replay.h - a run that can be made again: what was done to which actor at which tick, and
// a hash of all states after every tick.
//
// Same sprite, same start, same commands: the same states, on every machine and by every compiler.
// A run that does not repeat is found at the very tick at which it first went another way.
//
//     ReplayRecorder recorder(sprite, actors);
//     recorder.command(sprite, actors, {.actor = 0, .kind = ReplayCommand::Kind::Direction,
//                                       .direction = Direction::Left});   // done and noted
//     step(sprite, actors); recorder.tick(actors);
//     save_replay("run.vsr", recorder.replay());
//
// Rolling back needs none of this: an Actor is its own snapshot. Keep copies of the last few ticks,
// and when a late command of another player arrives, copy the one of its tick back, do the command,
// and step forward again.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vsprite/actor.h"
#include "vsprite/input.h"
#include "vsprite/result.h"

namespace vsprite {

/// One thing done to one actor between two ticks.
struct ReplayCommand {
  enum class Kind : std::uint8_t {
    Direction,  ///< set_direction(direction)
    Heading,    ///< set_heading(vector)
    Target,     ///< set_target(vector, number)
    Play,       ///< play(action, within, hold)
    Queue,      ///< queue(action, hold)
    Release,    ///< release(within)
    Cancel,     ///< cancel()
    Follow,     ///< follow(vector)
    Scale,      ///< own_scaled(vector)
    Recorded    ///< own_recorded()
  };
  std::uint64_t tick = 0;   ///< ticks made before it; filled in by the recorder
  std::uint32_t actor = 0;  ///< index
  Kind kind = Kind::Direction;
  vsprite::Direction direction = vsprite::Direction::None;
  bool hold = false;
  std::uint16_t action = 0;  ///< index into Sprite::actions()
  std::int32_t within = -1;
  Vec2 vector{};
  float number = 0;
};

/// Does it. Never fails or allocates; a command that is_valid() would refuse must not come here.
void apply(const Sprite& sprite, Actor& actor, const ReplayCommand& command) noexcept;

/// What a key script does with actions at `tick`; names that the sprite does not have are left out.
std::vector<ReplayCommand> commands_at(const Sprite& sprite, const KeyScript& script,
                                       std::uint64_t tick);

/// True if the actor may be stepped with this sprite, whoever sent its bytes: check what comes from
/// a file or a network.
bool is_valid(const Sprite& sprite, const Actor& actor) noexcept;
bool is_valid(const Sprite& sprite, const ReplayCommand& command) noexcept;

/// XXH3-64 of the states' bytes, little-endian.
std::uint64_t hash_states(std::span<const Actor> actors) noexcept;

struct Replay {
  std::uint64_t sprite = 0;             ///< Sprite::identity() of what it was recorded with
  std::vector<Actor> start;             ///< at least one
  std::vector<ReplayCommand> commands;  ///< ascending by tick
  std::vector<std::uint64_t> hashes;    ///< after every tick
};

class ReplayRecorder {
 public:
  ReplayRecorder(const Sprite& sprite, std::span<const Actor> start);
  /// Does the command and notes it.
  void command(const Sprite& sprite, std::span<Actor> actors, ReplayCommand command);
  /// Makes room for so many more commands, which then throw no std::bad_alloc.
  void reserve(std::size_t more);
  /// Call it after every step of all actors.
  void tick(std::span<const Actor> actors);
  const Replay& replay() const noexcept { return replay_; }

 private:
  Replay replay_;
};

/// Where a run went another way: the state after this tick (from 1) is not the recorded one.
struct Divergence {
  std::uint64_t tick = 0;
  std::uint64_t recorded = 0, found = 0;  ///< hashes
};
/// A recorded run that is made again, tick by tick. Borrows sprite and replay.
class ReplayPlayer {
 public:
  ReplayPlayer(const Sprite& sprite, const Replay& replay);
  bool is_at_end() const noexcept { return tick_ == replay_->hashes.size(); }
  std::uint64_t tick() const noexcept { return tick_; }  ///< ticks made so far
  std::span<const Actor> actors() const noexcept { return actors_; }
  /// One tick; where it is not what was recorded. Pre: !is_at_end().
  std::optional<Divergence> step();

 private:
  const Sprite* sprite_;
  const Replay* replay_;
  std::vector<Actor> actors_;
  std::size_t tick_ = 0, next_ = 0;  // next_: of the commands
};
/// Makes the run again, until its end or the first tick that differs. `actors` gets the states
/// there. `hash`, may be null: gets the states of actor 0.
std::optional<Divergence> run_replay(const Sprite& sprite, const Replay& replay,
                                     std::vector<Actor>& actors, StateHash* hash = nullptr);

/// Errors: CannotCreate, CannotWrite.
Result<void> save_replay(const std::string& path, const Replay& replay);
/// Every state and command is checked to be one that the sprite can take; that it is the sprite of
/// the recording is not (compare `sprite` with Sprite::identity()).
/// Errors: NotFound, CannotRead, LimitExceeded (more than 1 GiB), BadFormat, UnsupportedVersion,
/// CorruptData, OutOfMemory.
Result<Replay> load_replay(const std::string& path, const Sprite& sprite);

}  // namespace vsprite
