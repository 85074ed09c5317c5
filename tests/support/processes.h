// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// processes.h - processes that solve together (control/spread.h), as threads that copy bytes.
#pragma once

#include <barrier>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "control/spread.h"

namespace vsprite::testing {

class Processes {
 public:
  explicit Processes(std::size_t count)
      : count_(count), all_(static_cast<std::ptrdiff_t>(count)), sent_(count) {}

  /// Calls `work(spread)` in each.
  template <class Work>
  void run(const Work& work) {
    std::vector<std::thread> threads;
    for (std::size_t rank = 0; rank < count_; ++rank)
      threads.emplace_back([this, rank, &work] { work(spread_of(rank)); });
    for (std::thread& thread : threads) thread.join();
  }
  /// Bytes that process 0 got.
  std::size_t gathered() const { return gathered_; }

 private:
  Spread spread_of(std::size_t rank) {
    const auto share = [this, rank](std::size_t owner, std::span<std::byte> bytes) {
      if (rank == owner) shared_ = bytes;
      all_.arrive_and_wait();
      if (rank != owner) copy(shared_, bytes);
      all_.arrive_and_wait();
    };
    const auto gather = [this, rank](std::size_t owner, std::span<std::byte> bytes) {
      std::unique_lock lock(mutex_);
      if (rank == owner) {
        sent_[owner].emplace_back(bytes.begin(), bytes.end());
        there_.notify_all();
        return;
      }
      there_.wait(lock, [&] { return !sent_[owner].empty(); });
      copy(sent_[owner].front(), bytes);
      sent_[owner].pop_front();
      gathered_ += bytes.size();
    };
    return {rank, count_, share, gather};
  }
  /// What is sent must be what is waited for.
  static void copy(std::span<const std::byte> from, std::span<std::byte> to) {
    if (from.size() != to.size()) std::abort();
    std::memcpy(to.data(), from.data(), to.size());
  }

  std::size_t count_;
  std::barrier<> all_;
  std::span<const std::byte> shared_;
  std::mutex mutex_;
  std::condition_variable there_;
  std::vector<std::deque<std::vector<std::byte>>> sent_;
  std::size_t gathered_ = 0;
};

}  // namespace vsprite::testing
