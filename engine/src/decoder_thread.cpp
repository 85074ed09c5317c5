// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "decoder_thread.h"

#include <new>
#include <utility>

#include "memory.h"
#include "pack_format.h"

namespace vsprite::detail {

DecoderThread::DecoderThread(const Sprite& sprite)
    : sprite_(sprite), thread_([this, memory = current_memory()] {
        const MemoryScope scope(memory);
        run();
      }) {}

DecoderThread::~DecoderThread() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void DecoderThread::ask(std::deque<std::uint32_t>& soon, std::deque<std::uint32_t>& later,
                        std::deque<std::uint32_t>& dropped) {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  soon_.insert(soon_.end(), soon.begin(), soon.end());
  later_.insert(later_.end(), later.begin(), later.end());
  soon.clear();
  later.clear();
  constexpr std::size_t kMostLater = 4096;  // older ones have mostly passed by
  while (later_.size() > kMostLater) {
    dropped.push_back(later_.front());
    later_.pop_front();
  }
  changed_.notify_one();
}

void DecoderThread::take(std::list<DecodedFrame>& frames) {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock || ready_.empty()) return;
  const bool was_full = ready_.size() >= kMostReady;
  frames.splice(frames.end(), ready_);
  if (was_full) changed_.notify_one();
}

void DecoderThread::run() {
  try {
    while (decode_one()) {
    }
  } catch (const std::bad_alloc&) {
    // Whoever asks for a picture decodes it himself from now on.
  }
}

bool DecoderThread::decode_one() {
  std::list<DecodedFrame> fresh(1);
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] {
      return ends_ || (ready_.size() < kMostReady && !(soon_.empty() && later_.empty()));
    });
    if (ends_) return false;
    std::deque<std::uint32_t>& next = soon_.empty() ? later_ : soon_;
    fresh.front().sample = next.front();
    fresh.front().is_guess = &next == &later_;
    next.pop_front();
  }
  if (!sprite_.impl().decode_trimmed(fresh.front().sample, fresh.front().image))
    fresh.front().image = {};
  const std::lock_guard lock(mutex_);
  ready_.splice(ready_.end(), fresh);
  return true;
}

}  // namespace vsprite::detail
