// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/spread.h - one solve by several processes that share no memory.
//
// The tables of a mode fall into blocks of eight headings (lanes.h). Every process runs the same
// solve of the same problem, and block b is solved in process b mod count: its vectors of problems
// and its tables take memory there alone. Process 0 gathers the tables. A block is computed from
// the same numbers in the same order wherever that is: the same bytes for any number of processes.
//
// Spread is what grows with the headings. Not spread: the transitions and their prices (16 bytes a
// transition), which every process holds, and the gathered tables, which process 0 holds: it is the
// largest, and more processes do not make it smaller than these two.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace vsprite {

/// By default: one process, which solves all blocks.
struct Spread {
  std::size_t rank = 0, count = 1;
  /// The bytes of process `owner` become those of all. Called by all, in the same order, from one
  /// thread at a time.
  std::function<void(std::size_t owner, std::span<std::byte> bytes)> share;
  /// Those of `owner`, which is not 0, go to process 0. Called by these two, likewise.
  std::function<void(std::size_t owner, std::span<std::byte> bytes)> gather;

  std::size_t owner(std::size_t block) const { return block % count; }
  bool owns(std::size_t block) const { return owner(block) == rank; }
  template <class T>
  void share_block(std::size_t block, std::span<T> values) const {
    if (count > 1) share(owner(block), std::as_writable_bytes(values));
  }
  template <class T>
  void gather_block(std::size_t block, std::span<T> values) const {
    if (owner(block) != 0 && (rank == 0 || owns(block)))
      gather(owner(block), std::as_writable_bytes(values));
  }
};

}  // namespace vsprite
