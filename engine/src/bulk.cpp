// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "bulk.h"

#include <new>
#if VSPRITE_THREADS
#include <system_error>
#include <thread>
#endif
#ifdef __linux__
#include <sys/mman.h>
#endif

#include "memory.h"

namespace vsprite::detail {

void prefer_large_pages([[maybe_unused]] void* memory,
                        [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
  constexpr std::uintptr_t kLargePage = std::uintptr_t{2} << 20;
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (begin + kLargePage - 1) / kLargePage * kLargePage;
  const std::uintptr_t last = (begin + bytes) / kLargePage * kLargePage;
  if (first < last) ::madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
}

void run_both([[maybe_unused]] std::uint64_t bytes, const std::function<void()>& first,
              const std::function<void()>& second) {
#if VSPRITE_THREADS
  if (bytes >= kBulkBytes && std::thread::hardware_concurrency() > 1) {
    struct Helper {
      bool is_out_of_memory = false;
      std::thread thread;
      ~Helper() {
        if (thread.joinable()) thread.join();
      }
    } helper;
    try {
      helper.thread = std::thread([&, memory = current_memory()] {
        const MemoryScope scope(memory);
        try {
          second();
        } catch (const std::bad_alloc&) {
          helper.is_out_of_memory = true;
        }
      });
    } catch (const std::system_error&) {
      // The machine has none to give: one after the other.
    }
    if (helper.thread.joinable()) {
      first();
      helper.thread.join();
      if (helper.is_out_of_memory) throw std::bad_alloc();
      return;
    }
  }
#endif
  first();
  second();
}

}  // namespace vsprite::detail
