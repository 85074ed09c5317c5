// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Runs by the C interface: key scripts, hashes of states, recordings.
#include "c_parts.h"

using namespace vsprite;
using namespace vsprite::c;
using detail::MemoryScope;

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

vsprite_status vsprite_close_keys(vsprite_keys** keys) {
  return close_handle(__func__, keys, [](vsprite_keys* k) {
    vsprite_sprite* sprite = k->sprite;
    delete k;
    leave(sprite);
  });
}

vsprite_status vsprite_apply_keys(const vsprite_keys* keys, vsprite_actor* theirs) {
  if (!is_open(keys)) return bad(__func__, "open keys are due");
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
  if (path == nullptr) return bad(__func__, "a path is due, null was found");
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
