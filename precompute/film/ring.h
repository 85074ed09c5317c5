// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/ring.h - decoded frames in memory that the decoder's process and its parent both see.
//
// The parent makes the memory and seals its size; each slot that the child may fill is granted by a
// byte on the socket between them, and comes back as the head of a frame. Frames take the slots in
// turn. What lies in a slot is only ever read as pixels.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace vsprite::detail {

class Ring {
 public:
  Ring() = default;
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;
  ~Ring() {
    if (memory_) munmap(memory_, bytes());
  }

  /// Gives the memory `fd` its size, for frames of `width` x `height` px, which nobody can change
  /// from then on, and maps it. False: errno tells.
  bool make(int fd, int width, int height) {
    lay_out(width, height);
    struct stat is {};
    return ftruncate(fd, static_cast<off_t>(bytes())) == 0 &&
           fcntl(fd, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) == 0 &&
           fstat(fd, &is) == 0 && static_cast<std::size_t>(is.st_size) == bytes() &&
           map(fd, width, height);
  }
  /// Maps what was made. False: errno tells.
  bool map(int fd, int width, int height) {
    lay_out(width, height);
    void* at = mmap(nullptr, bytes(), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    if (at == MAP_FAILED) return false;
    memory_ = static_cast<std::uint8_t*>(at);
    return true;
  }
  bool mapped() const { return memory_ != nullptr; }
  int slots() const { return slots_; }

  /// The next slot: Y, Cb, Cr and, of frames that have it, RGBA, one behind the other.
  std::uint8_t* next() {
    std::uint8_t* at = memory_ + static_cast<std::size_t>(turn_) * slot_;
    turn_ = (turn_ + 1) % slots_;
    return at;
  }

 private:
  static constexpr std::size_t kRoom = std::size_t{64} << 20;  // beyond it two slots have to do

  void lay_out(int width, int height) {
    const auto w = static_cast<std::size_t>(width);
    const auto h = static_cast<std::size_t>(height);
    const std::size_t planes = w * h + 2 * ((w + 1) / 2) * ((h + 1) / 2);
    slots_ = static_cast<int>(std::clamp(kRoom / planes, std::size_t{2}, std::size_t{4}));
    slot_ = (planes + 4 * w * h + 4095) / 4096 * 4096;  // pages never touched take no memory
  }
  std::size_t bytes() const { return static_cast<std::size_t>(slots_) * slot_; }

  std::uint8_t* memory_ = nullptr;
  std::size_t slot_ = 0;
  int slots_ = 0, turn_ = 0;
};

}  // namespace vsprite::detail
