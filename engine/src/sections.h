// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// sections.h - sections that a pack may lack. Each has a source file of its own that holds how it
// is written, read and checked; sections.cpp lists them.
#pragma once

#include "pack_format.h"

namespace vsprite::detail {

struct OptionalSection {
  std::string_view name;
  Bytes bytes;
};
/// What `data` holds of them, in the order of the file.
std::vector<OptionalSection> optional_sections(const SpriteData& data);
/// Reads those that are there into content.data and checks what they say. Samples, transitions and
/// modes have been read and checked.
Check read_optional(const ByteSource& source, PackContent& content);
/// Their meaning, as check_sprite_data().
Check check_optional(const SpriteData& data);

/// True if `a` leads to `b` by the film itself or by a transition of the pack. Pre: a, b < N.
bool leads(const SpriteData& data, std::uint32_t a, std::uint32_t b) noexcept;
bool is_first(const SpriteData& data, std::uint32_t sample) noexcept;

// ACTN (actions.cpp). `read_*`: `bytes` is the whole section, at `offset` in the file.
Bytes action_bytes(const SpriteData& data);
Check read_actions(std::span<const std::uint8_t> bytes, std::uint64_t offset, SpriteData& data);
Check check_actions(const SpriteData& data);
std::vector<Action> list_actions(const SpriteData& data);

// EVNT (events.cpp).
Bytes event_bytes(const SpriteData& data);
Check read_events(std::span<const std::uint8_t> bytes, std::uint64_t offset, SpriteData& data);
Check check_events(const SpriteData& data);

// BODY (body.cpp).
Bytes body_bytes(const SpriteData& data);
Check read_bodies(std::span<const std::uint8_t> bytes, std::uint64_t offset, SpriteData& data);
Check check_bodies(const SpriteData& data);

// SHDW (shadow.cpp). `verify_shadow`: its picture too, which costs decoding it.
Bytes shadow_bytes(const SpriteData& data);
Check read_shadows(std::span<const std::uint8_t> bytes, std::uint64_t offset, SpriteData& data);
Check check_shadows(const SpriteData& data);
Check verify_shadow(const FilmedShadow& shadow);

}  // namespace vsprite::detail
