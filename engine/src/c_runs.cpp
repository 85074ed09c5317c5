// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Runs by the C interface: key scripts, hashes of states, recordings.
#include "c_parts.h"

using namespace vsprite;
using namespace vsprite::c;
using detail::MemoryScope;

namespace {

constexpr std::size_t kMostRecorded = std::size_t{1} << 20;
constexpr const char* kNoKeys = "open keys are due";
constexpr const char* kNoRecording = "an open recording is due";
constexpr const char* kNoReplay = "an open replay is due";

// The command of C as that of C++; only what its kind takes is looked at.
vsprite_status read_command(const char* call, const Sprite& sprite, const vsprite_command* theirs,
                            ReplayCommand& command) noexcept {
  using Kind = ReplayCommand::Kind;
  vsprite_command c{};
  if (const vsprite_status wrong = take_in(call, theirs, c)) return wrong;
  if (c.kind < 0 || c.kind > static_cast<std::int32_t>(Kind::Recorded))
    return bad(call, "no such kind of command");
  command.kind = static_cast<Kind>(c.kind);
  switch (command.kind) {
    case Kind::Direction:
      if (c.direction < 0 || c.direction >= kDirectionCount) return bad(call, "no such direction");
      command.direction = static_cast<Direction>(c.direction);
      break;
    case Kind::Play:
    case Kind::Queue:
      if (const vsprite_status wrong = check_action(call, sprite, c.action)) return wrong;
      command.action = static_cast<std::uint16_t>(c.action);
      command.hold = c.hold != 0;
      if (command.kind == Kind::Queue) break;
      [[fallthrough]];
    case Kind::Release:
      if (!is_within(c.within)) return bad(call, kNotWithin);
      command.within = c.within;
      break;
    case Kind::Target:
      if (!is_finite(c.radius) || c.radius < 0) return bad(call, kNotFinite);
      command.number = c.radius;
      [[fallthrough]];
    case Kind::Heading:
    case Kind::Follow:
    case Kind::Scale:
      if (!is_finite(c.x, c.y)) return bad(call, kNotFinite);
      if (command.kind == Kind::Scale && !is_factor(c.x, c.y)) return bad(call, kNotFinite);
      command.vector = {c.x, c.y};
      break;
    case Kind::Cancel:
    case Kind::Recorded:
      break;
  }
  return VSPRITE_OK;
}

vsprite_status read_recorded(const char* call, const vsprite_recording* recording,
                             std::uint32_t index, const vsprite_actor* theirs,
                             Actor& actor) noexcept {
  if (!is_open(recording)) return bad(call, kNoRecording);
  if (index >= recording->actors.size())
    return bad_index(call, "actor", index, recording->actors.size());
  return read_actor(call, *recording->sprite->engine, theirs, actor);
}

vsprite_status read_all(const char* call, const Sprite& sprite, const vsprite_actor* theirs,
                        std::vector<Actor>& actors) noexcept {
  if (theirs == nullptr) return bad(call, kNoActor);
  copy_actors(actors.data(), theirs, actors.size());
  for (const Actor& actor : actors)
    if (!is_playable(sprite, actor)) return bad(call, kStrange);
  return VSPRITE_OK;
}

// Where the caller wants the actors of a replay.
vsprite_status check_room(const char* call, const vsprite_replay* replay,
                          const vsprite_actor* actors, std::size_t count) noexcept {
  if (!is_open(replay)) return bad(call, kNoReplay);
  if (actors == nullptr) return bad(call, kNoActor);
  const std::size_t due = replay->recorded.start.size();
  return count == due ? VSPRITE_OK : bad_index(call, "room for actors", count, due);
}

void hand_out_actors(const vsprite_replay& replay, vsprite_actor* actors) noexcept {
  const std::span<const Actor> now = replay.player.actors();
  std::memcpy(actors, now.data(), now.size_bytes());
}

}  // namespace

// Key scripts.

vsprite_status vsprite_load_keys(vsprite_sprite* sprite, const char* script, vsprite_keys** keys) {
  if (keys == nullptr) return bad(__func__, kNoResult);
  *keys = nullptr;
  if (!is_open(sprite)) return bad(__func__, kNoSprite);
  if (script == nullptr) return bad(__func__, "a script is due, null was found");
  return guarded([&]() -> vsprite_status {
    const MemoryScope scope(sprite->memory);
    auto parsed = load_key_script(script, sprite->engine->fps());
    if (!parsed) return fail(parsed.error());
    if (auto known = check_key_script(*sprite->engine, *parsed); !known) return fail(known.error());
    auto handle = std::make_unique<vsprite_keys>();
    handle->script = std::move(*parsed);
    handle->sprite = sprite;
    sprite->users.fetch_add(1, std::memory_order_relaxed);
    *keys = handle.release();
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_close_keys(vsprite_keys** keys) { return close_user(__func__, keys); }

vsprite_status vsprite_apply_keys(const vsprite_keys* keys, vsprite_actor* theirs) {
  if (!is_open(keys)) return bad(__func__, kNoKeys);
  const Sprite& engine = *keys->sprite->engine;
  Actor actor;
  if (const vsprite_status wrong = read_actor(__func__, engine, theirs, actor)) return wrong;
  set_direction(engine, actor, keys->script.at(actor.tick));
  play_script(engine, keys->script, actor.tick, actor);
  std::memcpy(theirs, &actor, sizeof actor);
  return VSPRITE_OK;
}

// The same run everywhere.

vsprite_status vsprite_make_hash(vsprite_hash** hash) {
  if (hash == nullptr) return bad(__func__, kNoResult);
  *hash = nullptr;
  return guarded([&] {
    *hash = new vsprite_hash;
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_close_hash(vsprite_hash** hash) {
  return close_handle(__func__, hash, [](vsprite_hash* h) { delete h; });
}

vsprite_status vsprite_add_to_hash(vsprite_hash* hash, const vsprite_actor* theirs) {
  if (!is_open(hash)) return bad(__func__, "an open hash is due");
  if (theirs == nullptr) return bad(__func__, kNoActor);
  Actor actor;
  copy_actors(&actor, theirs, 1);
  hash->states.add(actor);
  return VSPRITE_OK;
}

vsprite_status vsprite_get_hash(const vsprite_hash* hash, std::uint64_t* states_hash) {
  if (!is_open(hash)) return bad(__func__, "an open hash is due");
  if (states_hash == nullptr) return bad(__func__, kNoResult);
  *states_hash = hash->states.digest();
  return VSPRITE_OK;
}

vsprite_status vsprite_hash_actors(const vsprite_actor* actors, std::size_t count,
                                   std::uint64_t* hash) {
  if (actors == nullptr && count > 0) return bad(__func__, kNoActor);
  if (hash == nullptr) return bad(__func__, kNoResult);
  return guarded([&] {
    std::vector<Actor> copies(count);
    if (count > 0) copy_actors(copies.data(), actors, count);
    *hash = hash_states(copies);
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_run_replay(const vsprite_sprite* sprite, const char* path,
                                  vsprite_replay_report* out) {
  if (!is_open(sprite)) return bad(__func__, kNoSprite);
  if (path == nullptr) return bad(__func__, kNoPath);
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  return guarded([&]() -> vsprite_status {
    const MemoryScope scope(sprite->memory);
    const auto replay = load_replay(path, *sprite->engine);
    if (!replay) return fail(replay.error());
    std::vector<Actor> actors;
    StateHash hash;
    const auto divergence = run_replay(*sprite->engine, *replay, actors, &hash);
    vsprite_replay_report report{};
    report.same_pack = replay->sprite == sprite->engine->identity() ? 1 : 0;
    report.ticks = replay->hashes.size();
    report.actors = actors.size();
    report.diverged_tick = divergence ? divergence->tick : 0;
    report.states_hash = hash.digest();
    hand_out(report, size, out);
    return VSPRITE_OK;
  });
}

// Recordings.

vsprite_status vsprite_make_recording(vsprite_sprite* sprite, const vsprite_actor* actors,
                                      std::size_t count, vsprite_recording** recording) {
  if (recording == nullptr) return bad(__func__, kNoResult);
  *recording = nullptr;
  if (!is_open(sprite)) return bad(__func__, kNoSprite);
  if (count < 1 || count > kMostRecorded) return bad(__func__, "1 to 1048576 actors are due");
  return guarded([&]() -> vsprite_status {
    const MemoryScope scope(sprite->memory);
    std::vector<Actor> start(count);
    if (const vsprite_status wrong =
            read_all("vsprite_make_recording", *sprite->engine, actors, start))
      return wrong;
    *recording = new vsprite_recording(sprite, std::move(start));
    sprite->users.fetch_add(1, std::memory_order_relaxed);
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_close_recording(vsprite_recording** recording) {
  return close_user(__func__, recording);
}

vsprite_status vsprite_record_command(vsprite_recording* recording, std::uint32_t index,
                                      vsprite_actor* theirs, const vsprite_command* asked) {
  Actor actor;
  if (const vsprite_status wrong = read_recorded(__func__, recording, index, theirs, actor))
    return wrong;
  const Sprite& engine = *recording->sprite->engine;
  ReplayCommand command;
  command.actor = index;
  if (const vsprite_status wrong = read_command(__func__, engine, asked, command)) return wrong;
  return guarded([&] {
    const MemoryScope scope(recording->sprite->memory);
    recording->actors[index] = actor;
    recording->recorder.command(engine, recording->actors, command);
    std::memcpy(theirs, &recording->actors[index], sizeof actor);
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_record_keys(vsprite_recording* recording, std::uint32_t index,
                                   vsprite_actor* theirs, const vsprite_keys* keys) {
  Actor actor;
  if (const vsprite_status wrong = read_recorded(__func__, recording, index, theirs, actor))
    return wrong;
  if (!is_open(keys)) return bad(__func__, kNoKeys);
  if (keys->sprite != recording->sprite) return bad(__func__, "the keys are of another sprite");
  return guarded([&] {
    const MemoryScope scope(recording->sprite->memory);
    const Sprite& engine = *recording->sprite->engine;
    auto commands = commands_at(engine, keys->script, actor.tick);
    Actor turned = actor;
    const Direction wanted = keys->script.at(actor.tick);
    set_direction(engine, turned, wanted);
    if (std::memcmp(&turned, &actor, sizeof actor) != 0)
      commands.insert(commands.begin(), ReplayCommand{.direction = wanted});
    recording->recorder.reserve(commands.size());
    recording->actors[index] = actor;
    for (ReplayCommand& command : commands) {
      command.actor = index;
      recording->recorder.command(engine, recording->actors, command);
    }
    std::memcpy(theirs, &recording->actors[index], sizeof actor);
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_record_tick(vsprite_recording* recording, const vsprite_actor* actors,
                                   std::size_t count) {
  if (!is_open(recording)) return bad(__func__, kNoRecording);
  if (count != recording->actors.size())
    return bad_index(__func__, "actors", count, recording->actors.size());
  return guarded([&]() -> vsprite_status {
    const MemoryScope scope(recording->sprite->memory);
    if (const vsprite_status wrong =
            read_all("vsprite_record_tick", *recording->sprite->engine, actors, recording->actors))
      return wrong;
    recording->recorder.tick(recording->actors);
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_save_recording(const vsprite_recording* recording, const char* path) {
  if (!is_open(recording)) return bad(__func__, kNoRecording);
  if (path == nullptr) return bad(__func__, kNoPath);
  return guarded([&]() -> vsprite_status {
    const MemoryScope scope(recording->sprite->memory);
    const Result<void> saved = save_replay(path, recording->recorder.replay());
    return saved ? VSPRITE_OK : fail(saved.error());
  });
}

vsprite_status vsprite_load_replay(vsprite_sprite* sprite, const char* path,
                                   vsprite_replay** replay) {
  if (replay == nullptr) return bad(__func__, kNoResult);
  *replay = nullptr;
  if (!is_open(sprite)) return bad(__func__, kNoSprite);
  if (path == nullptr) return bad(__func__, kNoPath);
  return guarded([&]() -> vsprite_status {
    const MemoryScope scope(sprite->memory);
    auto loaded = load_replay(path, *sprite->engine);
    if (!loaded) return fail(loaded.error());
    *replay = new vsprite_replay(sprite, std::move(*loaded));
    sprite->users.fetch_add(1, std::memory_order_relaxed);
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_close_replay(vsprite_replay** replay) {
  return close_user(__func__, replay);
}

vsprite_status vsprite_get_replay(const vsprite_replay* replay, vsprite_replay_info* out) {
  if (!is_open(replay)) return bad(__func__, kNoReplay);
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  const Replay& run = replay->recorded;
  vsprite_replay_info info{};
  info.same_pack = run.sprite == replay->sprite->engine->identity() ? 1 : 0;
  info.ticks = run.hashes.size();
  info.actors = run.start.size();
  hand_out(info, size, out);
  return VSPRITE_OK;
}

vsprite_status vsprite_start_replay(vsprite_replay* replay, vsprite_actor* actors,
                                    std::size_t count) {
  if (const vsprite_status wrong = check_room(__func__, replay, actors, count)) return wrong;
  return guarded([&] {
    const MemoryScope scope(replay->sprite->memory);
    replay->player = ReplayPlayer(*replay->sprite->engine, replay->recorded);
    hand_out_actors(*replay, actors);
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_step_replay(vsprite_replay* replay, vsprite_actor* actors,
                                   std::size_t count) {
  if (const vsprite_status wrong = check_room(__func__, replay, actors, count)) return wrong;
  const std::uint64_t ticks = replay->recorded.hashes.size();
  if (replay->player.is_at_end()) return bad_index(__func__, "tick", ticks, ticks);
  const std::optional<Divergence> other = replay->player.step();
  hand_out_actors(*replay, actors);
  if (!other) return VSPRITE_OK;
  return say(VSPRITE_BAD_CONTENT, "%s: after tick %llu the states are not those recorded", __func__,
             static_cast<unsigned long long>(other->tick));
}
