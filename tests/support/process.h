// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// process.h - what this process holds.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>

namespace vsprite::testing {

/// Pages of 4 KiB in memory.
inline long resident_pages() {
  long size = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> size >> resident;
  return resident;
}

inline std::size_t open_files() {
  const std::filesystem::directory_iterator all("/proc/self/fd"), end;
  return static_cast<std::size_t>(std::distance(all, end));
}

}  // namespace vsprite::testing
