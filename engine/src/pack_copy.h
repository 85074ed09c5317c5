// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// pack_copy.h - sections that are read apart from the sprite, and put in by copying a pack.
#pragma once

#include "pack_format.h"
#include "vsprite/pack.h"

namespace vsprite::detail {

/// Header and section table alone. Errors: those of load_pack that concern them.
Result<PackContent> read_table(const ByteSource& source);

/// The first section of that name, or null.
const SectionEntry* find_section(const PackContent& content, std::string_view name);

/// All of it, its sum checked. The caller has looked at its size. May throw std::bad_alloc. Errors:
/// CannotRead, CorruptData.
Result<std::vector<std::uint8_t>> read_section(const ByteSource& source, const SectionEntry& entry);

/// Writes the pack to `to`, with `given` in the place of its sections of those names; none where
/// there are no bytes. The file appears whole or not at all. Errors: those of read_table,
/// CannotRead, CannotCreate, CannotWrite.
Result<void> copy_with_sections(const ByteSource& source, const std::string& to,
                                std::span<const PackExtra> given);

}  // namespace vsprite::detail
