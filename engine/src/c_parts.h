// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// c_parts.h - what the files of the C interface share: handles, the thread's last error, and the
// checks of arguments. Actors are copied in and out, so that a caller's bytes need no alignment.
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "memory.h"
#include "vsprite/c_api.h"
#include "vsprite/puppet.h"
#include "vsprite/vsprite.h"

namespace vsprite::c {

// The actor of C is the actor of C++, field by field.
#define VSPRITE_SAME(field) offsetof(vsprite_actor, field) == offsetof(Actor, field)
static_assert(sizeof(vsprite_actor) == sizeof(Actor) && offsetof(Actor, position) == 0 &&
              offsetof(vsprite_actor, y) == offsetof(Position, y) && VSPRITE_SAME(tick) &&
              VSPRITE_SAME(random) && VSPRITE_SAME(sample) && VSPRITE_SAME(shown) &&
              VSPRITE_SAME(mode) && VSPRITE_SAME(direction) && VSPRITE_SAME(group) &&
              VSPRITE_SAME(bent) && VSPRITE_SAME(stage) && VSPRITE_SAME(table) &&
              VSPRITE_SAME(jumped) && VSPRITE_SAME(skipped) && VSPRITE_SAME(play) &&
              VSPRITE_SAME(owner) && VSPRITE_SAME(action) && VSPRITE_SAME(queued) &&
              VSPRITE_SAME(due) && VSPRITE_SAME(clock) && VSPRITE_SAME(offset_x) &&
              VSPRITE_SAME(offset_y) && VSPRITE_SAME(drive_x) && VSPRITE_SAME(drive_y));
#undef VSPRITE_SAME
static_assert(sizeof(vsprite_sample_event) == sizeof(SampleEvent) &&
              offsetof(vsprite_sample_event, name) == offsetof(SampleEvent, name));

// What a handle is, so that one of another kind, or a closed one whose memory was not yet given to
// somebody else, is told from an open one.
enum class Kind : std::uint32_t {
  Closed = 0,
  Sprite = 0x56535031,
  Frames = 0x56535032,
  Keys = 0x56535033,
  Hash = 0x56535034,
  Canvas = 0x56535035,
  Recording = 0x56535036,
  Replay = 0x56535037,
  Puppets = 0x56535038
};

}  // namespace vsprite::c

struct vsprite_sprite {
  static constexpr vsprite::c::Kind kKind = vsprite::c::Kind::Sprite;
  vsprite::c::Kind kind = kKind;
  std::atomic<std::uint32_t> users{1};  // itself, and what was made with it
  vsprite::detail::Memory* memory = nullptr;
  std::optional<vsprite::Sprite> engine;
  vsprite_source source{};  // its `close` is still due
};

struct vsprite_frames {
  static constexpr vsprite::c::Kind kKind = vsprite::c::Kind::Frames;
  vsprite::c::Kind kind = kKind;
  vsprite_sprite* sprite = nullptr;
  vsprite::FrameCache cache;
  vsprite::Image shadow;  ///< handed out last
  vsprite_frames(vsprite_sprite* of, std::size_t budget) : sprite(of), cache(*of->engine, budget) {}
};

struct vsprite_keys {
  static constexpr vsprite::c::Kind kKind = vsprite::c::Kind::Keys;
  vsprite::c::Kind kind = kKind;
  vsprite_sprite* sprite = nullptr;
  vsprite::KeyScript script;
};

struct vsprite_hash {
  static constexpr vsprite::c::Kind kKind = vsprite::c::Kind::Hash;
  vsprite::c::Kind kind = kKind;
  vsprite::StateHash states;
};

struct vsprite_canvas {
  static constexpr vsprite::c::Kind kKind = vsprite::c::Kind::Canvas;
  vsprite::c::Kind kind = kKind;
  vsprite::Image image;
};

struct vsprite_recording {
  static constexpr vsprite::c::Kind kKind = vsprite::c::Kind::Recording;
  vsprite::c::Kind kind = kKind;
  vsprite_sprite* sprite = nullptr;
  std::vector<vsprite::Actor> actors;  // room for the caller's
  vsprite::ReplayRecorder recorder;
  vsprite_recording(vsprite_sprite* of, std::vector<vsprite::Actor> start)
      : sprite(of), actors(std::move(start)), recorder(*of->engine, actors) {}
};

struct vsprite_replay {
  static constexpr vsprite::c::Kind kKind = vsprite::c::Kind::Replay;
  vsprite::c::Kind kind = kKind;
  vsprite_sprite* sprite = nullptr;
  vsprite::Replay recorded;
  vsprite::ReplayPlayer player;
  vsprite_replay(vsprite_sprite* of, vsprite::Replay run)
      : sprite(of), recorded(std::move(run)), player(*of->engine, recorded) {}
};

struct vsprite_puppets {
  static constexpr vsprite::c::Kind kKind = vsprite::c::Kind::Puppets;
  vsprite::c::Kind kind = kKind;
  std::vector<vsprite::Puppet> puppets;
  std::vector<vsprite::PuppetPose> poses;  // of each
  vsprite::PuppetPainter painter;
};

namespace vsprite::c {

inline constexpr std::uint32_t kMostStruct = 4096;  // bytes; more is no struct_size

// The sentence of the calling thread's last failure is kept; each returns the code.
[[gnu::format(printf, 2, 3)]] vsprite_status say(vsprite_status code, const char* format,
                                                 ...) noexcept;
vsprite_status fail(const Error& error) noexcept;
vsprite_status bad(const char* call, const char* what) noexcept;
vsprite_status bad_index(const char* call, const char* what, std::uint64_t index,
                         std::uint64_t count) noexcept;

// Whatever is thrown ends here.
template <class F>
vsprite_status guarded(const F& call) noexcept {
  try {
    return call();
  } catch (const std::bad_alloc&) {
    return say(VSPRITE_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return say(VSPRITE_INTERNAL, "%s", error.what());
  } catch (...) {
    return say(VSPRITE_INTERNAL, "an unknown defect");
  }
}

// A handle of another kind may be less aligned than `Handle` is: its first bytes, copied, say what
// it is.
template <class Handle>
bool is_open(const Handle* handle) noexcept {
  if (handle == nullptr) return false;
  Kind kind{};
  std::memcpy(&kind, static_cast<const void*>(handle), sizeof kind);
  return kind == Handle::kKind;
}

// A struct of the caller's, of whatever version.
template <class T>
vsprite_status size_of(const char* call, const T* theirs, std::uint32_t& size) noexcept {
  if (theirs == nullptr) return bad(call, "a struct is due, null was found");
  std::memcpy(&size, theirs, sizeof size);
  // The first version of each is the smallest that was ever handed out.
  if (size >= sizeof(T) && size <= kMostStruct) return VSPRITE_OK;
  return say(VSPRITE_BAD_ARGUMENT, "%s: struct_size %u, %u is due", call, size,
             static_cast<unsigned>(sizeof(T)));
}

template <class T>
vsprite_status take_in(const char* call, const T* theirs, T& ours) noexcept {
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(call, theirs, size)) return wrong;
  std::memcpy(&ours, theirs, sizeof(T));
  const auto* bytes = reinterpret_cast<const unsigned char*>(theirs);
  for (std::size_t at = sizeof(T); at < size; ++at) {
    if (bytes[at] == 0) continue;
    return say(VSPRITE_UNSUPPORTED_VERSION,
               "%s: byte %zu of a struct of %u bytes is not 0, this version knows %zu", call, at,
               size, sizeof(T));
  }
  return VSPRITE_OK;
}

template <class T>
void hand_out(T ours, std::uint32_t size, T* theirs) noexcept {
  ours.struct_size = size;
  std::memcpy(theirs, &ours, sizeof(T));
  std::memset(reinterpret_cast<unsigned char*>(theirs) + sizeof(T), 0, size - sizeof(T));
}

inline bool is_finite(float x, float y = 0, float z = 0) noexcept {
  return std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
}

inline void copy_actors(Actor* to, const vsprite_actor* from, std::size_t count) noexcept {
  std::memcpy(static_cast<void*>(to), from, count * sizeof(Actor));
}

inline constexpr const char* kNoSprite = "an open sprite is due";
inline constexpr const char* kNoFrames = "open frames are due";
inline constexpr const char* kNoCanvas = "an open canvas is due";
inline constexpr const char* kNoPath = "a path is due, null was found";
inline constexpr const char* kNoActor = "an actor is due, null was found";
inline constexpr const char* kStrange = "the actor is in a state that this sprite does not know";
inline constexpr const char* kNotFinite = "a number is not finite, or out of range";
inline constexpr const char* kNotWithin = "within -1 to 65535 ticks is due";
inline constexpr const char* kNoResult = "a place for the result is due, null was found";

/// VSPRITE_OK if the sprite has such an action.
inline vsprite_status check_action(const char* call, const Sprite& sprite,
                                   std::uint32_t action) noexcept {
  const std::size_t count = sprite.actions().size();
  return action < count ? VSPRITE_OK : bad_index(call, "action", action, count);
}

inline bool is_within(std::int32_t within) noexcept {
  return within >= kNoDeadline && within <= 65535;
}

// What the film's motion may be multiplied by.
inline bool is_factor(float x, float y) noexcept {
  return std::fabs(x) <= 16 && std::fabs(y) <= 16;
}

// Positions are fixed point: far out they would overflow.
inline bool is_playable(const Sprite& sprite, const Actor& actor) noexcept {
  constexpr std::int64_t kFar = std::int64_t{1} << 62;
  const Position p = actor.position;
  return p.x > -kFar && p.x < kFar && p.y > -kFar && p.y < kFar && is_valid(sprite, actor);
}

inline vsprite_status read_actor(const char* call, const Sprite& sprite,
                                 const vsprite_actor* theirs, Actor& actor) noexcept {
  if (theirs == nullptr) return bad(call, kNoActor);
  copy_actors(&actor, theirs, 1);
  return is_playable(sprite, actor) ? VSPRITE_OK : bad(call, kStrange);
}

template <class F>
vsprite_status with_actor(const char* call, const vsprite_sprite* sprite,
                          const vsprite_actor* theirs, const F& use) noexcept {
  if (!is_open(sprite)) return bad(call, kNoSprite);
  Actor actor;
  if (const vsprite_status wrong = read_actor(call, *sprite->engine, theirs, actor)) return wrong;
  use(*sprite->engine, actor);
  return VSPRITE_OK;
}

template <class F>
vsprite_status change_actor(const char* call, const vsprite_sprite* sprite, vsprite_actor* theirs,
                            const F& change) noexcept {
  return with_actor(call, sprite, theirs, [&](const Sprite& engine, Actor& actor) {
    change(engine, actor);
    std::memcpy(theirs, &actor, sizeof actor);
  });
}

// Drops one use of the sprite, and it with the last.
void leave(vsprite_sprite* sprite) noexcept;

// Closes a handle of which `before` does the rest; a null one is closed already.
template <class Handle, class F>
vsprite_status close_handle(const char* call, Handle** handle, const F& destroy) noexcept {
  if (handle == nullptr) return bad(call, "the address of a handle is due, null was found");
  if (*handle == nullptr) return VSPRITE_OK;
  if (!is_open(*handle)) return bad(call, "the handle is of another kind, or closed already");
  (*handle)->kind = Kind::Closed;
  destroy(*handle);
  *handle = nullptr;
  return VSPRITE_OK;
}

// The same for what keeps its sprite.
template <class Handle>
vsprite_status close_user(const char* call, Handle** handle) noexcept {
  return close_handle(call, handle, [](Handle* h) {
    vsprite_sprite* sprite = h->sprite;
    delete h;
    leave(sprite);
  });
}

}  // namespace vsprite::c
