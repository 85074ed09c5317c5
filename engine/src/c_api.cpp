// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The C interface over the public C++ headers: arguments are checked here, then the engine is
// called. Actors are copied in and out, so that a caller's bytes need no alignment.
#include "vsprite/c_api.h"

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <optional>

#include "c_api_text.h"
#include "memory.h"
#include "vsprite/compose.h"
#include "vsprite/record.h"
#include "vsprite/vsprite.h"

using namespace vsprite;
using detail::Memory;
using detail::MemoryScope;

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
  Canvas = 0x56535035
};

struct vsprite_sprite {
  static constexpr Kind kKind = Kind::Sprite;
  Kind kind = kKind;
  std::atomic<std::uint32_t> users{1};  // itself, and what was made with it
  Memory* memory = nullptr;
  std::optional<Sprite> engine;
  vsprite_source source{};  // its `close` is still due
};

struct vsprite_frames {
  static constexpr Kind kKind = Kind::Frames;
  Kind kind = kKind;
  vsprite_sprite* sprite = nullptr;
  FrameCache cache;
  vsprite_frames(vsprite_sprite* of, std::size_t budget) : sprite(of), cache(*of->engine, budget) {}
};

struct vsprite_keys {
  static constexpr Kind kKind = Kind::Keys;
  Kind kind = kKind;
  vsprite_sprite* sprite = nullptr;
  KeyScript script;
};

struct vsprite_hash {
  static constexpr Kind kKind = Kind::Hash;
  Kind kind = kKind;
  StateHash states;
};

struct vsprite_canvas {
  static constexpr Kind kKind = Kind::Canvas;
  Kind kind = kKind;
  Image image;
};

namespace {

constexpr std::uint32_t kMostStruct = 4096;  // bytes; more is no struct_size
constexpr std::uint64_t kDefaultBudget = std::uint64_t{64} << 20;
constexpr std::uint32_t kMostSide = 16384;

// The only state outside of handles.
thread_local char last_error[512] = "";

vsprite_status fail(vsprite_status code, const char* text) noexcept {
  std::snprintf(last_error, sizeof last_error, "%s", text);
  return code;
}

vsprite_status bad(const char* call, const char* what) noexcept {
  std::snprintf(last_error, sizeof last_error, "%s: %s", call, what);
  return VSPRITE_BAD_ARGUMENT;
}

vsprite_status bad_index(const char* call, const char* what, std::uint64_t index,
                         std::uint64_t count) noexcept {
  std::snprintf(last_error, sizeof last_error, "%s: %s %llu of %llu", call, what,
                static_cast<unsigned long long>(index), static_cast<unsigned long long>(count));
  return VSPRITE_BAD_ARGUMENT;
}

vsprite_status code_of(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::NotFound:
      return VSPRITE_NOT_FOUND;
    case ErrorCode::CannotRead:
      return VSPRITE_CANNOT_READ;
    case ErrorCode::CannotCreate:
      return VSPRITE_CANNOT_CREATE;
    case ErrorCode::CannotWrite:
      return VSPRITE_CANNOT_WRITE;
    case ErrorCode::InUse:
      return VSPRITE_IN_USE;
    case ErrorCode::BadFormat:
      return VSPRITE_BAD_FORMAT;
    case ErrorCode::UnsupportedVersion:
      return VSPRITE_UNSUPPORTED_VERSION;
    case ErrorCode::CorruptData:
      return VSPRITE_CORRUPT_DATA;
    case ErrorCode::LimitExceeded:
      return VSPRITE_LIMIT_EXCEEDED;
    case ErrorCode::BadContent:
      return VSPRITE_BAD_CONTENT;
    case ErrorCode::BadSetting:
      return VSPRITE_BAD_SETTING;
    case ErrorCode::DecoderFailed:
      return VSPRITE_DECODER_FAILED;
    case ErrorCode::Unavailable:
      return VSPRITE_UNAVAILABLE;
    case ErrorCode::OutOfMemory:
      return VSPRITE_OUT_OF_MEMORY;
    case ErrorCode::Interrupted:
      return VSPRITE_INTERRUPTED;
    case ErrorCode::Internal:
      return VSPRITE_INTERNAL;
  }
  return VSPRITE_INTERNAL;
}

vsprite_status fail(const Error& error) noexcept {
  return fail(code_of(error.code), error.message.c_str());
}

// Whatever is thrown ends here.
template <class F>
vsprite_status guarded(const F& call) noexcept {
  try {
    return call();
  } catch (const std::bad_alloc&) {
    return fail(VSPRITE_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return fail(VSPRITE_INTERNAL, error.what());
  } catch (...) {
    return fail(VSPRITE_INTERNAL, "an unknown defect");
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
  std::snprintf(last_error, sizeof last_error, "%s: struct_size %u, %u is due", call, size,
                static_cast<unsigned>(sizeof(T)));
  return VSPRITE_BAD_ARGUMENT;
}

template <class T>
vsprite_status take_in(const char* call, const T* theirs, T& ours) noexcept {
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(call, theirs, size)) return wrong;
  std::memcpy(&ours, theirs, sizeof(T));
  const auto* bytes = reinterpret_cast<const unsigned char*>(theirs);
  for (std::size_t at = sizeof(T); at < size; ++at) {
    if (bytes[at] == 0) continue;
    std::snprintf(last_error, sizeof last_error,
                  "%s: byte %zu of a struct of %u bytes is not 0, this version knows %zu", call, at,
                  size, sizeof(T));
    return VSPRITE_UNSUPPORTED_VERSION;
  }
  return VSPRITE_OK;
}

template <class T>
void hand_out(T ours, std::uint32_t size, T* theirs) noexcept {
  ours.struct_size = size;
  std::memcpy(theirs, &ours, sizeof(T));
  std::memset(reinterpret_cast<unsigned char*>(theirs) + sizeof(T), 0, size - sizeof(T));
}

bool is_finite(float x, float y = 0, float z = 0) noexcept {
  return std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
}

void copy_actors(Actor* to, const vsprite_actor* from, std::size_t count) noexcept {
  std::memcpy(static_cast<void*>(to), from, count * sizeof(Actor));
}

constexpr const char* kNoSprite = "an open sprite is due";
constexpr const char* kNoFrames = "open frames are due";
constexpr const char* kNoActor = "an actor is due, null was found";
constexpr const char* kStrange = "the actor is in a state that this sprite does not know";
constexpr const char* kNotFinite = "a number is not finite, or out of range";
constexpr const char* kNoResult = "a place for the result is due, null was found";

// Positions are fixed point: far out they would overflow.
bool is_playable(const Sprite& sprite, const Actor& actor) noexcept {
  constexpr std::int64_t kFar = std::int64_t{1} << 62;
  const Position p = actor.position;
  return p.x > -kFar && p.x < kFar && p.y > -kFar && p.y < kFar && is_valid(sprite, actor);
}

vsprite_status read_actor(const char* call, const Sprite& sprite, const vsprite_actor* theirs,
                          Actor& actor) noexcept {
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
void leave(vsprite_sprite* sprite) noexcept {
  if (sprite->users.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
  const vsprite_source source = sprite->source;
  Memory* memory = sprite->memory;
  delete sprite;
  detail::drop_memory(memory);
  if (source.close != nullptr) source.close(source.user);
}

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

PackReader reader_of(const vsprite_source& source) {
  PackReader reader{.bytes = source.bytes, .name = "pack", .read = {}};
  if (source.memory != nullptr) {
    const auto* bytes = static_cast<const std::uint8_t*>(source.memory);
    reader.read = [bytes](std::uint64_t offset, std::span<std::uint8_t> out) {
      if (!out.empty()) std::memcpy(out.data(), bytes + offset, out.size());
      return true;
    };
  } else {
    reader.read = [read = source.read, user = source.user](std::uint64_t offset,
                                                           std::span<std::uint8_t> out) {
      return read(user, offset, out.data(), out.size()) == 0;
    };
  }
  return reader;
}

vsprite_status check_source(const char* call, const vsprite_source* theirs,
                            vsprite_source& source) noexcept {
  if (const vsprite_status wrong = take_in(call, theirs, source)) return wrong;
  const int given =
      (source.path != nullptr) + (source.memory != nullptr) + (source.read != nullptr);
  return given == 1 ? VSPRITE_OK : bad(call, "one of path, memory and read is due");
}

Result<Sprite> load(const vsprite_source& source) {
  return source.path != nullptr ? load_pack(source.path) : load_pack(reader_of(source));
}

// The last step of loading: all that can fail has not happened yet.
vsprite_status load_handle(const vsprite_source& source, Memory* memory,
                           vsprite_sprite** out) noexcept {
  return guarded([&]() -> vsprite_status {
    const MemoryScope scope(memory);
    auto handle = std::make_unique<vsprite_sprite>();
    Result<Sprite> sprite = load(source);
    if (!sprite) return fail(sprite.error());
    handle->engine.emplace(std::move(*sprite));
    handle->memory = memory;
    handle->source = source;
    *out = handle.release();
    return VSPRITE_OK;
  });
}

struct ClearanceWorld {
  float (*clearance)(const void* world, float x, float y);
  const void* world;
};

float ask_clearance(const void* world, Vec2 position) {
  const auto* w = static_cast<const ClearanceWorld*>(world);
  return w->clearance(w->world, position.x, position.y);
}

std::uint32_t name_count(const Sprite& sprite, std::int32_t kind) noexcept {
  const SpriteData& data = sprite.data();
  switch (kind) {
    case VSPRITE_MODE:
      return static_cast<std::uint32_t>(data.modes.size());
    case VSPRITE_ACTION:
      return static_cast<std::uint32_t>(sprite.actions().size());
    case VSPRITE_EVENT:
      return static_cast<std::uint32_t>(data.event_names.size());
    case VSPRITE_TAG:
      return static_cast<std::uint32_t>(data.tags.size());
    default:
      return 0;
  }
}

const std::string& name_of(const Sprite& sprite, std::int32_t kind, std::uint32_t index) noexcept {
  const SpriteData& data = sprite.data();
  switch (kind) {
    case VSPRITE_MODE:
      return data.modes[index].name;
    case VSPRITE_ACTION:
      return sprite.actions()[index].name;
    case VSPRITE_EVENT:
      return data.event_names[index];
    default:
      return data.tags[index];
  }
}

bool is_kind(std::int32_t kind) noexcept { return kind >= VSPRITE_MODE && kind <= VSPRITE_TAG; }

bool is_within(std::int32_t within) noexcept { return within >= kNoDeadline && within <= 65535; }

vsprite_box to_c(const Box& b) noexcept { return {b.left, b.top, b.right, b.bottom}; }

Image plain_image(std::uint32_t width, std::uint32_t height, std::uint32_t colour) {
  return make_image(static_cast<int>(width), static_cast<int>(height),
                    static_cast<std::uint8_t>(colour >> 16), static_cast<std::uint8_t>(colour >> 8),
                    static_cast<std::uint8_t>(colour));
}

}  // namespace

// The library.

std::uint32_t vsprite_version(void) {
  return VSPRITE_VERSION_MAJOR << 16 | VSPRITE_VERSION_MINOR << 8 | VSPRITE_VERSION_PATCH;
}

const char* vsprite_last_error(void) { return last_error; }

const char* vsprite_status_name(vsprite_status status) {
  static constexpr const char* kNames[] = {
      "OK",          "NOT_FOUND",   "CANNOT_READ",         "CANNOT_CREATE", "CANNOT_WRITE",
      "IN_USE",      "BAD_FORMAT",  "UNSUPPORTED_VERSION", "CORRUPT_DATA",  "LIMIT_EXCEEDED",
      "BAD_CONTENT", "BAD_SETTING", "DECODER_FAILED",      "UNAVAILABLE",   "OUT_OF_MEMORY",
      "INTERRUPTED", "INTERNAL",    "BAD_ARGUMENT"};
  return status >= 0 && status <= VSPRITE_BAD_ARGUMENT ? kNames[status] : "?";
}

const char* vsprite_cdef(void) { return detail::kDeclarations; }

// Packs.

vsprite_status vsprite_load_pack(const char* path, vsprite_sprite** sprite) {
  if (path == nullptr) return bad(__func__, "a path is due, null was found");
  vsprite_source source{};
  source.struct_size = sizeof source;
  source.path = path;
  return vsprite_load_pack_from(&source, nullptr, sprite);
}

vsprite_status vsprite_load_pack_from(const vsprite_source* theirs,
                                      const vsprite_allocator* allocator, vsprite_sprite** sprite) {
  if (sprite == nullptr) return bad(__func__, kNoResult);
  *sprite = nullptr;
  vsprite_source source{};
  if (const vsprite_status wrong = check_source(__func__, theirs, source)) return wrong;
  Memory* memory = nullptr;
  if (allocator != nullptr) {
    vsprite_allocator calls{};
    if (const vsprite_status wrong = take_in(__func__, allocator, calls)) return wrong;
    if (calls.allocate == nullptr || calls.release == nullptr)
      return bad(__func__, "an allocator has both allocate and release");
    if (!detail::memory_can_be_given())
      return fail(VSPRITE_UNAVAILABLE,
                  "vsprite_load_pack_from: this build of the library takes no allocator");
    memory = detail::make_memory({calls.user, calls.allocate, calls.release});
  }
  const vsprite_status status =
      allocator != nullptr && memory == nullptr
          ? fail(VSPRITE_OUT_OF_MEMORY, "vsprite_load_pack_from: the allocator has no memory")
          : load_handle(source, memory, sprite);
  if (status == VSPRITE_OK) return status;
  detail::drop_memory(memory);
  if (source.close != nullptr) source.close(source.user);
  return status;
}

vsprite_status vsprite_close_sprite(vsprite_sprite** sprite) {
  return close_handle(__func__, sprite, [](vsprite_sprite* s) { leave(s); });
}

vsprite_status vsprite_verify_pack(const vsprite_source* theirs, std::uint32_t* issues) {
  if (issues != nullptr) *issues = 0;
  vsprite_source source{};
  if (const vsprite_status wrong = check_source(__func__, theirs, source)) return wrong;
  const vsprite_status status = guarded([&]() -> vsprite_status {
    const auto found =
        source.path != nullptr ? verify_pack(source.path) : verify_pack(reader_of(source));
    if (!found) return fail(found.error());
    if (issues != nullptr) *issues = static_cast<std::uint32_t>(found->size());
    if (found->empty()) return VSPRITE_OK;
    const PackIssue& first = found->front();
    std::snprintf(last_error, sizeof last_error, "%s: %s at byte %llu: %s",
                  source.path != nullptr ? source.path : "pack",
                  first.section.empty() ? "header" : first.section.c_str(),
                  static_cast<unsigned long long>(first.offset), first.message.c_str());
    return VSPRITE_CORRUPT_DATA;
  });
  if (source.close != nullptr) source.close(source.user);
  return status;
}

vsprite_status vsprite_get_info(const vsprite_sprite* sprite, vsprite_info* out) {
  if (!is_open(sprite)) return bad(__func__, kNoSprite);
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  const Sprite& engine = *sprite->engine;
  vsprite_info info{};
  info.samples = static_cast<std::uint32_t>(engine.samples().size());
  for (const Sample& s : engine.samples()) {
    info.kept += s.kept;
    info.most_width = std::max<std::uint32_t>(info.most_width, s.width);
    info.most_height = std::max<std::uint32_t>(info.most_height, s.height);
  }
  info.transitions = static_cast<std::uint32_t>(engine.data().transitions.size());
  info.modes = name_count(engine, VSPRITE_MODE);
  info.actions = name_count(engine, VSPRITE_ACTION);
  info.events = name_count(engine, VSPRITE_EVENT);
  info.tags = name_count(engine, VSPRITE_TAG);
  info.start_sample = engine.data().start_sample;
  info.served = engine.data().modes.front().served;
  info.fps = engine.fps();
  info.body_length = engine.data().body_length;
  info.identity = engine.identity();
  hand_out(info, size, out);
  return VSPRITE_OK;
}

vsprite_status vsprite_get_sample(const vsprite_sprite* sprite, std::uint32_t sample,
                                  vsprite_sample* out) {
  if (!is_open(sprite)) return bad(__func__, kNoSprite);
  const auto samples = sprite->engine->samples();
  if (sample >= samples.size()) return bad_index(__func__, "sample", sample, samples.size());
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  const Sample& s = samples[sample];
  hand_out(vsprite_sample{.struct_size = size,
                          .anchor_x = s.anchor.x,
                          .anchor_y = s.anchor.y,
                          .velocity_x = s.velocity.x,
                          .velocity_y = s.velocity.y,
                          .width = s.width,
                          .height = s.height,
                          .duration = s.duration,
                          .tag = s.tag,
                          .clip = s.clip,
                          .frame = s.frame,
                          .kept = s.kept},
           size, out);
  return VSPRITE_OK;
}

vsprite_status vsprite_get_name(const vsprite_sprite* sprite, std::int32_t kind,
                                std::uint32_t index, const char** name) {
  if (!is_open(sprite)) return bad(__func__, kNoSprite);
  if (name == nullptr) return bad(__func__, kNoResult);
  if (!is_kind(kind)) return bad(__func__, "no such kind of names");
  const std::uint32_t count = name_count(*sprite->engine, kind);
  if (index >= count) return bad_index(__func__, "name", index, count);
  *name = name_of(*sprite->engine, kind, index).c_str();
  return VSPRITE_OK;
}

vsprite_status vsprite_find(const vsprite_sprite* sprite, std::int32_t kind, const char* name,
                            std::uint32_t* index) {
  if (!is_open(sprite)) return bad(__func__, kNoSprite);
  if (name == nullptr || index == nullptr) return bad(__func__, kNoResult);
  if (!is_kind(kind)) return bad(__func__, "no such kind of names");
  const std::uint32_t count = name_count(*sprite->engine, kind);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (name_of(*sprite->engine, kind, i) != name) continue;
    *index = i;
    return VSPRITE_OK;
  }
  std::snprintf(last_error, sizeof last_error, "%s: no `%.200s` among %u names", __func__, name,
                count);
  return VSPRITE_NOT_FOUND;
}

// Actors.

vsprite_status vsprite_make_actor(const vsprite_sprite* sprite, float x, float y,
                                  std::uint64_t seed, std::uint32_t mode, vsprite_actor* actor) {
  if (!is_open(sprite)) return bad(__func__, kNoSprite);
  if (actor == nullptr) return bad(__func__, kNoActor);
  if (!is_finite(x, y)) return bad(__func__, kNotFinite);
  const std::size_t modes = sprite->engine->data().modes.size();
  if (mode >= modes) return bad_index(__func__, "mode", mode, modes);
  const Actor made = make_actor(*sprite->engine, {x, y}, seed, static_cast<int>(mode));
  std::memcpy(actor, &made, sizeof made);
  return VSPRITE_OK;
}

vsprite_status vsprite_check_actor(const vsprite_sprite* sprite, const vsprite_actor* actor) {
  return with_actor(__func__, sprite, actor, [](const Sprite&, const Actor&) {});
}

vsprite_status vsprite_set_direction(const vsprite_sprite* sprite, vsprite_actor* actor,
                                     std::int32_t direction) {
  if (direction < 0 || direction >= kDirectionCount) return bad(__func__, "no such direction");
  return change_actor(__func__, sprite, actor, [&](const Sprite& s, Actor& a) {
    set_direction(s, a, static_cast<Direction>(direction));
  });
}

std::int32_t vsprite_direction_from_axes(std::int32_t x, std::int32_t y) {
  return static_cast<std::int32_t>(direction_from_axes((x > 0) - (x < 0), (y > 0) - (y < 0)));
}

vsprite_status vsprite_set_heading(const vsprite_sprite* sprite, vsprite_actor* actor, float x,
                                   float y) {
  if (!is_finite(x, y)) return bad(__func__, kNotFinite);
  return change_actor(__func__, sprite, actor, [&](const Sprite& s, Actor& a) {
    set_heading(s, a, {x, y});
  });
}

vsprite_status vsprite_set_target(const vsprite_sprite* sprite, vsprite_actor* actor, float x,
                                  float y, float arrive_radius) {
  if (!is_finite(x, y, arrive_radius) || arrive_radius < 0) return bad(__func__, kNotFinite);
  return change_actor(__func__, sprite, actor, [&](const Sprite& s, Actor& a) {
    set_target(s, a, {x, y}, arrive_radius);
  });
}

vsprite_status vsprite_step(const vsprite_sprite* sprite, vsprite_actor* actor) {
  return change_actor(__func__, sprite, actor, [](const Sprite& s, Actor& a) { step(s, a); });
}

vsprite_status vsprite_step_many(const vsprite_sprite* sprite, vsprite_actor* actors,
                                 std::size_t count) {
  if (!is_open(sprite)) return bad(__func__, kNoSprite);
  if (actors == nullptr && count > 0) return bad(__func__, kNoActor);
  std::array<Actor, 128> some;
  for (std::size_t i = 0; i < count; ++i) {
    copy_actors(some.data(), actors + i, 1);
    if (is_playable(*sprite->engine, some[0])) continue;
    std::snprintf(last_error, sizeof last_error, "%s: actor %zu: %s", __func__, i, kStrange);
    return VSPRITE_BAD_ARGUMENT;
  }
  for (std::size_t at = 0; at < count;) {
    const std::size_t n = std::min(some.size(), count - at);
    copy_actors(some.data(), actors + at, n);
    step(*sprite->engine, std::span(some).first(n));
    std::memcpy(actors + at, some.data(), n * sizeof(Actor));
    at += n;
  }
  return VSPRITE_OK;
}

vsprite_status vsprite_step_wish(const vsprite_sprite* sprite, vsprite_actor* actor,
                                 const vsprite_wish* theirs) {
  vsprite_wish wish{};
  if (const vsprite_status wrong = take_in(__func__, theirs, wish)) return wrong;
  if (!is_finite(wish.slack) || wish.slack < 0) return bad(__func__, kNotFinite);
  if (wish.pace < 0 || wish.pace > 2) return bad(__func__, "no such pace");
  const ClearanceWorld world{wish.clearance, wish.world};
  StepWish asked;
  asked.slack = wish.slack;
  asked.pace = static_cast<Pace>(wish.pace);
  if (wish.clearance != nullptr) asked.clearance = ask_clearance;
  asked.world = &world;
  return change_actor(__func__, sprite, actor,
                      [&](const Sprite& s, Actor& a) { step(s, a, asked); });
}

vsprite_status vsprite_draw_position(const vsprite_sprite* sprite, const vsprite_actor* actor,
                                     float fraction, float* x, float* y) {
  if (x == nullptr || y == nullptr) return bad(__func__, kNoResult);
  if (!(fraction >= 0 && fraction <= 1)) return bad(__func__, kNotFinite);
  return with_actor(__func__, sprite, actor, [&](const Sprite& s, const Actor& a) {
    const Vec2 at = draw_position(s, a, fraction);
    *x = at.x;
    *y = at.y;
  });
}

vsprite_status vsprite_get_events(const vsprite_sprite* sprite, const vsprite_actor* actor,
                                  vsprite_tick_events* out) {
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  return with_actor(__func__, sprite, actor, [&](const Sprite& s, const Actor& a) {
    const TickEvents now = events_of(s, a);
    vsprite_tick_events events{};
    events.frame_shown = now.frame_shown ? 1 : 0;
    events.jump_taken = now.jump_taken ? 1 : 0;
    events.named_count = static_cast<std::uint32_t>(now.named.size());
    events.named = reinterpret_cast<const vsprite_sample_event*>(now.named.data());
    hand_out(events, size, out);
  });
}

// Actions.

namespace {

vsprite_status check_action(const char* call, const vsprite_sprite* sprite, std::uint32_t action,
                            std::int32_t within) noexcept {
  if (!is_open(sprite)) return bad(call, kNoSprite);
  const std::size_t count = sprite->engine->actions().size();
  if (action >= count) return bad_index(call, "action", action, count);
  return is_within(within) ? VSPRITE_OK : bad(call, "within -1 to 65535 ticks is due");
}

}  // namespace

vsprite_status vsprite_play(const vsprite_sprite* sprite, vsprite_actor* actor,
                            std::uint32_t action, std::int32_t within, std::int32_t hold) {
  if (const vsprite_status wrong = check_action(__func__, sprite, action, within)) return wrong;
  return change_actor(__func__, sprite, actor, [&](const Sprite& s, Actor& a) {
    play(s, a, static_cast<int>(action), within, hold != 0);
  });
}

vsprite_status vsprite_queue(const vsprite_sprite* sprite, vsprite_actor* actor,
                             std::uint32_t action, std::int32_t hold) {
  if (const vsprite_status wrong = check_action(__func__, sprite, action, kNoDeadline))
    return wrong;
  return change_actor(__func__, sprite, actor, [&](const Sprite& s, Actor& a) {
    queue(s, a, static_cast<int>(action), hold != 0);
  });
}

vsprite_status vsprite_release(const vsprite_sprite* sprite, vsprite_actor* actor,
                               std::int32_t within) {
  if (!is_within(within)) return bad(__func__, "within -1 to 65535 ticks is due");
  return change_actor(__func__, sprite, actor,
                      [&](const Sprite& s, Actor& a) { release(s, a, within); });
}

vsprite_status vsprite_cancel(const vsprite_sprite* sprite, vsprite_actor* actor) {
  return change_actor(__func__, sprite, actor, [](const Sprite& s, Actor& a) { cancel(s, a); });
}

// Who moves it.

vsprite_status vsprite_follow(const vsprite_sprite* sprite, vsprite_actor* actor, float x,
                              float y) {
  if (!is_finite(x, y)) return bad(__func__, kNotFinite);
  return change_actor(__func__, sprite, actor, [&](const Sprite& s, Actor& a) {
    follow(s, a, {x, y});
  });
}

vsprite_status vsprite_own_scaled(const vsprite_sprite* sprite, vsprite_actor* actor, float x,
                                  float y) {
  if (!(std::fabs(x) <= 16 && std::fabs(y) <= 16)) return bad(__func__, kNotFinite);
  return change_actor(__func__, sprite, actor, [&](const Sprite&, Actor& a) {
    own_scaled(a, {x, y});
  });
}

vsprite_status vsprite_own_recorded(const vsprite_sprite* sprite, vsprite_actor* actor) {
  return change_actor(__func__, sprite, actor, [](const Sprite&, Actor& a) { own_recorded(a); });
}

// Pictures.

vsprite_status vsprite_make_frames(vsprite_sprite* sprite, std::uint64_t budget,
                                   vsprite_frames** frames) {
  if (frames == nullptr) return bad(__func__, kNoResult);
  *frames = nullptr;
  if (!is_open(sprite)) return bad(__func__, kNoSprite);
  return guarded([&] {
    const MemoryScope scope(sprite->memory);
    if (budget == 0) budget = kDefaultBudget;
    *frames = new vsprite_frames(sprite, static_cast<std::size_t>(budget));
    sprite->users.fetch_add(1, std::memory_order_relaxed);
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_close_frames(vsprite_frames** frames) {
  return close_handle(__func__, frames, [](vsprite_frames* f) {
    vsprite_sprite* sprite = f->sprite;
    delete f;
    leave(sprite);
  });
}

vsprite_status vsprite_get_picture(vsprite_frames* frames, std::uint32_t sample,
                                   vsprite_picture* out) {
  if (!is_open(frames)) return bad(__func__, kNoFrames);
  const auto samples = frames->sprite->engine->samples();
  if (sample >= samples.size()) return bad_index(__func__, "sample", sample, samples.size());
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  const MemoryScope scope(frames->sprite->memory);
  const ImageView view = frames->cache.frame(sample);
  hand_out(vsprite_picture{.struct_size = size,
                           .width = static_cast<std::uint32_t>(view.width),
                           .height = static_cast<std::uint32_t>(view.height),
                           .stride = static_cast<std::uint32_t>(view.stride),
                           .rgba = view.rgba,
                           .anchor_x = samples[sample].anchor.x,
                           .anchor_y = samples[sample].anchor.y},
           size, out);
  return VSPRITE_OK;
}

vsprite_status vsprite_look_ahead(vsprite_frames* frames, const vsprite_actor* theirs) {
  if (!is_open(frames)) return bad(__func__, kNoFrames);
  Actor actor;
  if (const vsprite_status wrong = read_actor(__func__, *frames->sprite->engine, theirs, actor))
    return wrong;
  const MemoryScope scope(frames->sprite->memory);
  frames->cache.look_ahead(actor);
  return VSPRITE_OK;
}

vsprite_status vsprite_get_frames_stats(const vsprite_frames* frames, vsprite_frames_stats* out) {
  if (!is_open(frames)) return bad(__func__, kNoFrames);
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  const FrameCacheStats& s = frames->cache.stats();
  hand_out(vsprite_frames_stats{size, s.hits, s.misses, s.ahead, s.damaged, s.bytes}, size, out);
  return VSPRITE_OK;
}

// Where it is.

vsprite_status vsprite_body_box(const vsprite_sprite* sprite, const vsprite_actor* actor,
                                float scale, vsprite_box* box) {
  if (box == nullptr) return bad(__func__, kNoResult);
  if (!is_finite(scale) || scale <= 0) return bad(__func__, kNotFinite);
  return with_actor(__func__, sprite, actor,
                    [&](const Sprite& s, const Actor& a) { *box = to_c(body_box(s, a, scale)); });
}

vsprite_status vsprite_drawn_box(const vsprite_sprite* sprite, const vsprite_actor* actor,
                                 float scale, vsprite_box* box) {
  if (box == nullptr) return bad(__func__, kNoResult);
  if (!is_finite(scale) || scale <= 0) return bad(__func__, kNotFinite);
  return with_actor(__func__, sprite, actor,
                    [&](const Sprite& s, const Actor& a) { *box = to_c(drawn_box(s, a, scale)); });
}

vsprite_status vsprite_hit(vsprite_frames* frames, const vsprite_actor* theirs, float x, float y,
                           float scale, std::int32_t alpha, std::int32_t* is_hit) {
  if (!is_open(frames)) return bad(__func__, kNoFrames);
  if (is_hit == nullptr) return bad(__func__, kNoResult);
  if (!is_finite(x, y, scale) || scale <= 0 || alpha < 0 || alpha > 255)
    return bad(__func__, kNotFinite);
  const Sprite& engine = *frames->sprite->engine;
  Actor actor;
  if (const vsprite_status wrong = read_actor(__func__, engine, theirs, actor)) return wrong;
  const MemoryScope scope(frames->sprite->memory);
  const ImageView picture = frames->cache.frame(actor.sample);
  *is_hit = hit(engine, actor, picture, {x, y}, scale, static_cast<std::uint8_t>(alpha)) ? 1 : 0;
  return VSPRITE_OK;
}

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

// Drawing without a graphics library.

vsprite_status vsprite_make_canvas(std::uint32_t width, std::uint32_t height, std::uint32_t colour,
                                   vsprite_canvas** canvas) {
  if (canvas == nullptr) return bad(__func__, kNoResult);
  *canvas = nullptr;
  if (width < 1 || width > kMostSide || height < 1 || height > kMostSide)
    return bad(__func__, "1 to 16384 px a side are due");
  return guarded([&] {
    auto handle = std::make_unique<vsprite_canvas>();
    handle->image = plain_image(width, height, colour);
    *canvas = handle.release();
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_close_canvas(vsprite_canvas** canvas) {
  return close_handle(__func__, canvas, [](vsprite_canvas* c) { delete c; });
}

vsprite_status vsprite_clear_canvas(vsprite_canvas* canvas, std::uint32_t colour) {
  if (!is_open(canvas)) return bad(__func__, "an open canvas is due");
  return guarded([&] {
    canvas->image = plain_image(static_cast<std::uint32_t>(canvas->image.width),
                                static_cast<std::uint32_t>(canvas->image.height), colour);
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_draw_actor(vsprite_canvas* canvas, vsprite_frames* frames,
                                  const vsprite_actor* theirs, float fraction, float scale) {
  if (!is_open(canvas)) return bad(__func__, "an open canvas is due");
  if (!is_open(frames)) return bad(__func__, kNoFrames);
  if (!(fraction >= 0 && fraction <= 1) || !(scale > 0 && scale <= 1000))
    return bad(__func__, kNotFinite);
  const Sprite& engine = *frames->sprite->engine;
  Actor actor;
  if (const vsprite_status wrong = read_actor(__func__, engine, theirs, actor)) return wrong;
  const MemoryScope scope(frames->sprite->memory);
  DrawOptions options;
  options.scale = scale;
  draw_sample(canvas->image, frames->cache.frame(actor.sample), engine.samples()[actor.sample],
              draw_position(engine, actor, fraction), options);
  return VSPRITE_OK;
}

vsprite_status vsprite_get_canvas(const vsprite_canvas* canvas, vsprite_picture* out) {
  if (!is_open(canvas)) return bad(__func__, "an open canvas is due");
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  const ImageView view = canvas->image;
  vsprite_picture picture{};
  picture.width = static_cast<std::uint32_t>(view.width);
  picture.height = static_cast<std::uint32_t>(view.height);
  picture.stride = static_cast<std::uint32_t>(view.stride);
  picture.rgba = view.rgba;
  hand_out(picture, size, out);
  return VSPRITE_OK;
}

vsprite_status vsprite_save_canvas(const vsprite_canvas* canvas, const char* path) {
  if (!is_open(canvas)) return bad(__func__, "an open canvas is due");
  if (path == nullptr) return bad(__func__, "a path is due, null was found");
  return guarded([&]() -> vsprite_status {
    const Result<void> saved = save_png(path, canvas->image);
    return saved ? VSPRITE_OK : fail(saved.error());
  });
}
