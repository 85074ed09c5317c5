// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Recordings. The file (.vsr), little-endian: 8 bytes magic; u32 version 1; u32 actors; u64 ticks,
// commands, sprite; the actors, 64 bytes each in the order of their fields; u64 hash of every tick;
// the commands, 36 bytes each; XXH3-64 of all of it.
#include "vsprite/replay.h"

#include <algorithm>
#include <cmath>

#include "pack_format.h"
#include "vsprite/action.h"
#include "vsprite/owner.h"

namespace vsprite {
namespace {

using detail::Bytes;
using detail::Cursor;

constexpr std::array<std::uint8_t, 8> kReplayMagic{0x89, 'V', 'S', 'R', '\r', '\n', 0x1A, '\n'};
constexpr std::uint32_t kReplayVersion = 1;
constexpr std::size_t kReplayHeadBytes = 40, kActorBytes = 64, kCommandBytes = 36, kSumBytes = 8;
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;

// Every field of an actor, in order; `each` is called with it.
template <class A, class F>
void for_fields(A& a, const F& each) {
  each(a.position.x), each(a.position.y), each(a.tick), each(a.random), each(a.sample);
  each(a.shown), each(a.mode), each(a.direction), each(a.group), each(a.bent), each(a.stage);
  each(a.table), each(a.jumped), each(a.skipped), each(a.play), each(a.owner), each(a.action);
  each(a.queued), each(a.due), each(a.clock), each(a.offset_x);
  each(a.offset_y), each(a.drive_x), each(a.drive_y);
}

template <class C, class F>
void for_command_fields(C& c, const F& each) {
  each(c.tick), each(c.actor), each(c.kind), each(c.direction), each(c.action), each(c.within);
  each(c.vector.x), each(c.vector.y), each(c.number);
}

void put_actor(Bytes& out, const Actor& actor) {
  for_fields(actor, [&](const auto& field) { out.put(field); });
}

Error bad_replay(const std::string& path, const std::string& what,
                 ErrorCode code = ErrorCode::CorruptData) {
  return {code, path + ": " + what};
}

Result<Replay> parse_replay(const std::string& path, std::span<const std::uint8_t> bytes,
                            const Sprite& sprite) {
  if (bytes.size() < kReplayHeadBytes + kSumBytes ||
      !std::equal(kReplayMagic.begin(), kReplayMagic.end(), bytes.begin()))
    return bad_replay(path, "not a replay (.vsr)", ErrorCode::BadFormat);
  Cursor cursor(bytes.subspan(kReplayMagic.size()));
  const auto version = cursor.get<std::uint32_t>();
  if (version != kReplayVersion)
    return bad_replay(path, "replay version " + std::to_string(version) + ", this build reads 1",
                      ErrorCode::UnsupportedVersion);
  const std::uint64_t actors = cursor.get<std::uint32_t>();
  const auto ticks = cursor.get<std::uint64_t>(), commands = cursor.get<std::uint64_t>();
  Replay replay;
  replay.sprite = cursor.get<std::uint64_t>();
  const std::uint64_t left = bytes.size() - kReplayHeadBytes - kSumBytes;
  const bool fits = actors > 0 && actors <= left / kActorBytes && ticks <= left / 8 &&
                    commands <= left / kCommandBytes &&
                    actors * kActorBytes + ticks * 8 + commands * kCommandBytes == left;
  if (!fits)
    return bad_replay(path, std::to_string(actors) + " actors, " + std::to_string(ticks) +
                                " ticks and " + std::to_string(commands) +
                                " commands do not make its " + std::to_string(bytes.size()) +
                                " bytes");
  Cursor end(bytes.last(kSumBytes));
  if (detail::hash_bytes(bytes.first(bytes.size() - kSumBytes)) != end.get<std::uint64_t>())
    return bad_replay(path, "its sum does not fit its bytes");
  replay.start.resize(actors);
  replay.hashes.resize(ticks);
  replay.commands.resize(commands);
  const auto get = [&](auto& field) { field = cursor.get<std::decay_t<decltype(field)>>(); };
  for (Actor& actor : replay.start) {
    for_fields(actor, get);
    if (!is_valid(sprite, actor))
      return bad_replay(path,
                        "an actor is in a state that this pack does not know: it was "
                        "recorded with another one");
  }
  for (std::uint64_t& hash : replay.hashes) get(hash);
  std::uint64_t before = 0;
  for (ReplayCommand& command : replay.commands) {
    for_command_fields(command, get);
    command.hold = cursor.get<std::uint32_t>() != 0;
    const bool in_order = command.tick >= before && command.tick < ticks;
    if (!in_order || command.actor >= actors || !is_valid(sprite, command))
      return bad_replay(path, "command " + std::to_string(&command - replay.commands.data()) +
                                  " cannot be done with this pack");
    before = command.tick;
  }
  return replay;
}

}  // namespace

void apply(const Sprite& sprite, Actor& actor, const ReplayCommand& c) noexcept {
  using Kind = ReplayCommand::Kind;
  switch (c.kind) {
    case Kind::Direction:
      return set_direction(sprite, actor, c.direction);
    case Kind::Heading:
      return set_heading(sprite, actor, c.vector);
    case Kind::Target:
      return set_target(sprite, actor, c.vector, c.number);
    case Kind::Play:
      return play(sprite, actor, c.action, c.within, c.hold);
    case Kind::Queue:
      return queue(sprite, actor, c.action, c.hold);
    case Kind::Release:
      return release(sprite, actor, c.within);
    case Kind::Cancel:
      return cancel(sprite, actor);
    case Kind::Follow:
      return follow(sprite, actor, c.vector);
    case Kind::Scale:
      return own_scaled(actor, c.vector);
    case Kind::Recorded:
      return own_recorded(actor);
  }
}

std::vector<ReplayCommand> commands_at(const Sprite& sprite, const KeyScript& script,
                                       std::uint64_t tick) {
  using Kind = ReplayCommand::Kind;
  using Verb = ScriptAction::Verb;
  std::vector<ReplayCommand> commands;
  for (const ScriptAction& a : script.actions) {
    if (a.tick != tick) continue;
    const bool named = a.verb != Verb::Release && a.verb != Verb::Cancel;
    const int action = named ? find_action(sprite, a.name) : 0;
    if (action < 0) continue;
    ReplayCommand command;
    command.kind = a.verb == Verb::Release  ? Kind::Release
                   : a.verb == Verb::Cancel ? Kind::Cancel
                   : a.verb == Verb::Queue  ? Kind::Queue
                                            : Kind::Play;
    command.hold = a.verb == Verb::Hold;
    command.action = static_cast<std::uint16_t>(action);
    command.within = a.within;
    commands.push_back(command);
  }
  return commands;
}

bool is_valid(const Sprite& sprite, const Actor& a) noexcept {
  const SpriteData& data = sprite.data();
  if (a.mode >= data.modes.size() || a.sample >= data.samples.size()) return false;
  const ControlMode& mode = data.modes[a.mode];
  const std::uint32_t groups = mode.headings + 2;
  if (data.samples[a.sample].kept == 0 || a.shown < 1 || a.group >= groups || a.bent >= groups ||
      a.stage >= mode.stages || a.table >= mode.tables() || a.jumped > 1 || a.skipped > 1 ||
      static_cast<int>(a.direction) >= kDirectionCount)
    return false;
  if (a.skipped == 1 && (a.sample == 0 || !sprite.is_natural(a.sample - 1, a.sample))) return false;
  if ((a.owner & kOwnerKind) > static_cast<std::uint8_t>(PositionOwner::Game)) return false;
  const auto actions = sprite.actions();
  if (a.action > actions.size() || a.queued > actions.size()) return false;
  if (a.action == 0) return a.play == 0 && a.queued == 0 && a.due == 0;
  const int phase = a.play & kPlayPhase;
  if (phase >= Action::kPhases) return false;
  const std::int32_t table = actions[a.action - 1u].tables[static_cast<std::size_t>(phase)];
  if (table < 0) return false;
  const bool inside =
      data.samples[a.sample].tag == data.actions[static_cast<std::size_t>(table)].tag;
  return inside || (a.play & kPlayApproach) != 0;
}

bool is_valid(const Sprite& sprite, const ReplayCommand& c) noexcept {
  using Kind = ReplayCommand::Kind;
  const bool named = c.kind == Kind::Play || c.kind == Kind::Queue;
  return c.kind <= Kind::Recorded && static_cast<int>(c.direction) < kDirectionCount &&
         (!named || c.action < sprite.actions().size()) && c.within >= -1 && c.within <= 65535;
}

std::uint64_t hash_states(std::span<const Actor> actors) noexcept {
  std::uint64_t hash = 0;
  std::array<std::uint8_t, kActorBytes + 8> row;
  for (const Actor& actor : actors) {
    std::size_t at = 0;
    const auto put = [&](const auto& field) {
      auto bits = static_cast<std::uint64_t>(field);
      for (std::size_t k = 0; k < sizeof field; ++k, bits >>= 8)
        row[at++] = static_cast<std::uint8_t>(bits);
    };
    for_fields(actor, put);
    put(hash);
    hash = detail::hash_bytes(row);
  }
  return hash;
}

ReplayRecorder::ReplayRecorder(const Sprite& sprite, std::span<const Actor> start) {
  replay_.sprite = sprite.identity();
  replay_.start.assign(start.begin(), start.end());
}

void ReplayRecorder::command(const Sprite& sprite, std::span<Actor> actors, ReplayCommand command) {
  command.tick = replay_.hashes.size();
  apply(sprite, actors[command.actor], command);
  replay_.commands.push_back(command);
}

void ReplayRecorder::reserve(std::size_t more) {
  auto& commands = replay_.commands;
  const std::size_t due = commands.size() + more;
  if (due > commands.capacity()) commands.reserve(std::max(due, 2 * commands.capacity()));
}

void ReplayRecorder::tick(std::span<const Actor> actors) {
  replay_.hashes.push_back(hash_states(actors));
}

ReplayPlayer::ReplayPlayer(const Sprite& sprite, const Replay& replay)
    : sprite_(&sprite), replay_(&replay), actors_(replay.start) {}

std::optional<Divergence> ReplayPlayer::step() {
  const auto& commands = replay_->commands;
  for (; next_ < commands.size() && commands[next_].tick == tick_; ++next_)
    apply(*sprite_, actors_[commands[next_].actor], commands[next_]);
  vsprite::step(*sprite_, actors_);
  const std::uint64_t recorded = replay_->hashes[tick_++], found = hash_states(actors_);
  if (found != recorded) return Divergence{tick_, recorded, found};
  return std::nullopt;
}

std::optional<Divergence> run_replay(const Sprite& sprite, const Replay& replay,
                                     std::vector<Actor>& actors, StateHash* hash) {
  ReplayPlayer player(sprite, replay);
  std::optional<Divergence> divergence;
  while (!player.is_at_end() && !divergence) {
    divergence = player.step();
    if (hash != nullptr) hash->add(player.actors().front());
  }
  actors.assign(player.actors().begin(), player.actors().end());
  return divergence;
}

Result<void> save_replay(const std::string& path, const Replay& replay) {
  try {
    Bytes out;
    out.data.assign(kReplayMagic.begin(), kReplayMagic.end());
    out.put(kReplayVersion);
    out.put(static_cast<std::uint32_t>(replay.start.size()));
    out.put(std::uint64_t{replay.hashes.size()});
    out.put(std::uint64_t{replay.commands.size()});
    out.put(replay.sprite);
    for (const Actor& actor : replay.start) put_actor(out, actor);
    for (const std::uint64_t hash : replay.hashes) out.put(hash);
    for (const ReplayCommand& command : replay.commands) {
      for_command_fields(command, [&](const auto& field) { out.put(field); });
      out.put(static_cast<std::uint32_t>(command.hold ? 1 : 0));
    }
    out.put(detail::hash_bytes(out.data));
    auto file = detail::FileWriter::create(path);
    if (!file) return file.error();
    if (auto wrote = file->write(0, out.data); !wrote) return wrote;
    return file->finish();
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, path + ": out of memory"};
  }
}

Result<Replay> load_replay(const std::string& path, const Sprite& sprite) {
  try {
    const auto bytes = detail::read_file(path, kMostBytes);
    if (!bytes) return bytes.error();
    return parse_replay(path, *bytes, sprite);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, path + ": out of memory"};
  }
}

}  // namespace vsprite
