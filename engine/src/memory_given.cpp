// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The shared library's own operator new and delete. They are not exported, and the C++ library is
// linked into it, so that nobody else's new and delete meet them. In front of each block stands
// whose it is.
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "memory.h"

namespace vsprite::detail {

struct Memory {
  MemoryCalls calls;
  std::atomic<std::uint64_t> users{1};  // its blocks, and who made it
};

namespace {

constinit thread_local Memory* current = nullptr;

struct BlockHead {
  Memory* memory;  // null: malloc
  void* base;
  std::size_t bytes, alignment;
};
constexpr std::size_t kLeastAlignment = 16;
static_assert(sizeof(BlockHead) % kLeastAlignment == 0);

void* take_from(Memory* memory, std::size_t bytes, std::size_t alignment) noexcept {
  if (memory != nullptr) return memory->calls.allocate(memory->calls.user, bytes, alignment);
  if (alignment <= kLeastAlignment) return std::malloc(bytes);
  return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

void* take(std::size_t bytes, std::size_t alignment) noexcept {
  if (alignment < kLeastAlignment) alignment = kLeastAlignment;
  const std::size_t head = alignment < sizeof(BlockHead) ? sizeof(BlockHead) : alignment;
  if (bytes > SIZE_MAX / 2 - head) return nullptr;
  void* base = take_from(current, bytes + head, alignment);
  if (base == nullptr) return nullptr;
  if (current != nullptr) current->users.fetch_add(1, std::memory_order_relaxed);
  char* block = static_cast<char*>(base) + head;
  ::new (block - sizeof(BlockHead)) BlockHead{current, base, bytes + head, alignment};
  return block;
}

void* take_or_throw(std::size_t bytes, std::size_t alignment) {
  if (void* block = take(bytes, alignment)) return block;
  throw std::bad_alloc();
}

void give_back(void* block) noexcept {
  if (block == nullptr) return;
  const BlockHead head =
      *reinterpret_cast<BlockHead*>(static_cast<char*>(block) - sizeof(BlockHead));
  if (head.memory == nullptr) return std::free(head.base);
  head.memory->calls.release(head.memory->calls.user, head.base, head.bytes, head.alignment);
  drop_memory(head.memory);
}

}  // namespace

bool memory_can_be_given() noexcept { return true; }

Memory* make_memory(const MemoryCalls& calls) noexcept {
  void* place = calls.allocate(calls.user, sizeof(Memory), kLeastAlignment);
  return place == nullptr ? nullptr : ::new (place) Memory{calls};
}

void drop_memory(Memory* memory) noexcept {
  if (memory == nullptr || memory->users.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
  const MemoryCalls calls = memory->calls;
  calls.release(calls.user, memory, sizeof(Memory), kLeastAlignment);
}

Memory* current_memory() noexcept { return current; }

MemoryScope::MemoryScope(Memory* memory) noexcept : before_(current) { current = memory; }
MemoryScope::~MemoryScope() { current = before_; }

}  // namespace vsprite::detail

using vsprite::detail::give_back;
using vsprite::detail::take;
using vsprite::detail::take_or_throw;
using Alignment = std::align_val_t;

void* operator new(std::size_t n) { return take_or_throw(n, 0); }
void* operator new(std::size_t n, Alignment a) {
  return take_or_throw(n, static_cast<std::size_t>(a));
}
void* operator new(std::size_t n, const std::nothrow_t&) noexcept { return take(n, 0); }
void* operator new(std::size_t n, Alignment a, const std::nothrow_t&) noexcept {
  return take(n, static_cast<std::size_t>(a));
}
void operator delete(void* p) noexcept { give_back(p); }
void operator delete(void* p, std::size_t) noexcept { give_back(p); }
void operator delete(void* p, Alignment) noexcept { give_back(p); }
void operator delete(void* p, std::size_t, Alignment) noexcept { give_back(p); }
void operator delete(void* p, const std::nothrow_t&) noexcept { give_back(p); }
void operator delete(void* p, Alignment, const std::nothrow_t&) noexcept { give_back(p); }
