// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The static library: memory comes from the program's own operator new.
#include "memory.h"

namespace vsprite::detail {

bool memory_can_be_given() noexcept { return false; }
Memory* make_memory(const MemoryCalls&) noexcept { return nullptr; }
void drop_memory(Memory*) noexcept {}
Memory* current_memory() noexcept { return nullptr; }

MemoryScope::MemoryScope(Memory*) noexcept : before_(nullptr) {}
MemoryScope::~MemoryScope() = default;

}  // namespace vsprite::detail
