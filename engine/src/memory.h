// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// memory.h - whose memory the engine takes, for the C interface (c_api.h, vsprite_allocator).
//
// In the shared library `operator new` is the library's own (memory_given.cpp): it takes from the
// Memory of the innermost MemoryScope of the thread, or from malloc outside any. A block knows
// whose it is and goes back there, wherever it is deleted. The static library leaves `operator new`
// to the program (memory_malloc.cpp): there no memory can be given.
#pragma once

#include <cstddef>

namespace vsprite::detail {

struct MemoryCalls {
  void* user = nullptr;
  void* (*allocate)(void* user, std::size_t bytes, std::size_t alignment) = nullptr;
  void (*release)(void* user, void* memory, std::size_t bytes, std::size_t alignment) = nullptr;
};

/// Lives until it was dropped and its last block was deleted.
struct Memory;

bool memory_can_be_given() noexcept;
/// Null where the calls have none. Pre: memory_can_be_given().
Memory* make_memory(const MemoryCalls& calls) noexcept;
void drop_memory(Memory* memory) noexcept;  ///< null: nothing
/// Of this thread; null: malloc.
Memory* current_memory() noexcept;

/// While it lives, this thread takes from `memory`.
class MemoryScope {
 public:
  explicit MemoryScope(Memory* memory) noexcept;
  ~MemoryScope();
  MemoryScope(const MemoryScope&) = delete;
  MemoryScope& operator=(const MemoryScope&) = delete;

 private:
  [[maybe_unused]] Memory* before_;
};

}  // namespace vsprite::detail
