// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// decoder_thread.h - the background thread of a FrameCache: numbers of samples go in, pictures come
// out. Both sides hold the lock for a few list operations, never while they decode.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <list>
#include <mutex>
#include <thread>

#include "frame_codec.h"
#include "vsprite/sprite.h"

namespace vsprite::detail {

struct DecodedFrame {
  std::uint32_t sample = 0;
  bool is_guess = false;  ///< was asked for `later`
  TrimmedImage image;     ///< of no size: could not be decoded
};

class DecoderThread {
 public:
  static constexpr std::size_t kMostReady = 256;  ///< pictures that wait to be taken

  /// May throw std::system_error: no thread can be had.
  explicit DecoderThread(const Sprite& sprite);
  ~DecoderThread();
  DecoderThread(const DecoderThread&) = delete;
  DecoderThread& operator=(const DecoderThread&) = delete;

  /// Hands over both lists, unless the lock is taken this very moment; then they stay as they are.
  /// All of `soon` comes before any of `later`, of which the oldest are dropped when there are
  /// many.
  void ask(std::deque<std::uint32_t>& soon, std::deque<std::uint32_t>& later,
           std::deque<std::uint32_t>& dropped);
  /// Moves what is ready to the end of `frames`.
  void take(std::list<DecodedFrame>& frames);

 private:
  void run();
  bool decode_one();  ///< false: it is to end

  const Sprite& sprite_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::uint32_t> soon_, later_;
  std::list<DecodedFrame> ready_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace vsprite::detail
