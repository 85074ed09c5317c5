// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// bulk.h - tables of many megabytes: memory in large pages, and two threads where there are two.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace vsprite::detail {

/// From so many bytes of tables on a second thread is worth starting.
inline constexpr std::uint64_t kBulkBytes = std::uint64_t{4} << 20;

/// Asks the system for large pages in fresh memory of any alignment: filling it then stops for one
/// page in 2 MB instead of one in 4 KB. Only a hint; memory too small for such a page stays as it
/// is.
void prefer_large_pages(void* memory, std::size_t bytes) noexcept;

/// An empty vector with room for `count`.
template <class T>
void reserve_bulk(std::vector<T>& out, std::size_t count) {
  out.reserve(count);
  prefer_large_pages(out.data(), count * sizeof(T));
}

/// Runs both jobs to their end, the second in a thread of its own if `bytes`, what they deal with,
/// are many, and a thread is to be had. Throws std::bad_alloc where either did.
void run_both(std::uint64_t bytes, const std::function<void()>& first,
              const std::function<void()>& second);

/// The same job for both halves of 0..count-1: job(first, behind the last).
template <class Job>
void run_halves(std::uint64_t bytes, std::uint32_t count, const Job& job) {
  const std::uint32_t half = count / 2;
  run_both(
      bytes, [&] { job(0u, half); }, [&] { job(half, count); });
}

}  // namespace vsprite::detail
