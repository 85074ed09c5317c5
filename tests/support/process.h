// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// process.h - what this process holds.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>

namespace vsprite::testing {

/// Pages of 4 KiB in memory; 0 under a sanitizer, which keeps what was freed.
inline long resident_pages() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return 0;
#else
  long size = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> size >> resident;
  return resident;
#endif
}

inline std::size_t open_files() {
  const std::filesystem::directory_iterator all("/proc/self/fd"), end;
  return static_cast<std::size_t>(std::distance(all, end));
}

}  // namespace vsprite::testing
