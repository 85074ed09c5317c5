// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Packs by the C interface: where they are read from, and what is in them.
#include "c_parts.h"

using namespace vsprite;
using namespace vsprite::c;
using detail::Memory;
using detail::MemoryScope;

void vsprite::c::leave(vsprite_sprite* sprite) noexcept {
  if (sprite->users.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
  const vsprite_source source = sprite->source;
  Memory* memory = sprite->memory;
  delete sprite;
  detail::drop_memory(memory);
  if (source.close != nullptr) source.close(source.user);
}

namespace {

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

}  // namespace

vsprite_status vsprite_load_pack(const char* path, vsprite_sprite** sprite) {
  if (path == nullptr) return bad(__func__, kNoPath);
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
      return say(VSPRITE_UNAVAILABLE,
                 "vsprite_load_pack_from: this build of the library takes no allocator");
    memory = detail::make_memory({calls.user, calls.allocate, calls.release});
  }
  const vsprite_status status =
      allocator != nullptr && memory == nullptr
          ? say(VSPRITE_OUT_OF_MEMORY, "vsprite_load_pack_from: the allocator has no memory")
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
    return say(VSPRITE_CORRUPT_DATA, "%s: %s at byte %llu: %s",
               source.path != nullptr ? source.path : "pack",
               first.section.empty() ? "header" : first.section.c_str(),
               static_cast<unsigned long long>(first.offset), first.message.c_str());
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
  return say(VSPRITE_NOT_FOUND, "%s: no `%.200s` among %u names", __func__, name, count);
}
