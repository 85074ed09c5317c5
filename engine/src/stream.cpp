// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Least recently used pictures go first. A picture whose bytes are damaged is remembered, so that
// it is tried once only.
#include "vsprite/stream.h"

#include <list>
#include <new>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace vsprite {

struct FrameCache::Impl {
  struct Entry {
    std::uint32_t sample = 0;
    Image image;
  };
  using Entries = std::list<Entry>;  // the newest in front

  const Sprite& sprite;
  std::size_t budget;
  FrameCacheStats stats;
  Entries entries;
  std::unordered_map<std::uint32_t, Entries::iterator> by_sample;
  std::unordered_set<std::uint32_t> damaged;

  bool bring_to_front(std::uint32_t sample);
  bool decode_to_front(std::uint32_t sample);
  void drop_oldest();
};

bool FrameCache::Impl::bring_to_front(std::uint32_t sample) {
  const auto found = by_sample.find(sample);
  if (found == by_sample.end()) return false;
  ++stats.hits;
  entries.splice(entries.begin(), entries, found->second);
  return true;
}

bool FrameCache::Impl::decode_to_front(std::uint32_t sample) {
  if (damaged.contains(sample)) return false;
  ++stats.misses;
  Entries fresh(1);
  fresh.front().sample = sample;
  if (auto decoded = sprite.decode_frame(sample, fresh.front().image); !decoded) {
    // Want of memory passes, damage does not.
    if (decoded.error().code != ErrorCode::OutOfMemory) damaged.insert(sample);
    return false;
  }
  by_sample[sample] = fresh.begin();
  stats.bytes += fresh.front().image.rgba.size();
  entries.splice(entries.begin(), fresh);
  drop_oldest();
  return true;
}

void FrameCache::Impl::drop_oldest() {
  while (stats.bytes > budget && entries.size() > 2) {
    stats.bytes -= entries.back().image.rgba.size();
    by_sample.erase(entries.back().sample);
    entries.pop_back();
  }
}

FrameCache::FrameCache(const Sprite& sprite, std::size_t budget)
    : impl_(new Impl{sprite, budget, {}, {}, {}, {}}) {}

FrameCache::~FrameCache() = default;

ImageView FrameCache::frame(std::uint32_t sample) noexcept {
  bool shown = false;
  try {
    shown = impl_->bring_to_front(sample) || impl_->decode_to_front(sample);
  } catch (const std::bad_alloc&) {
    // Drawing never fails: the last good picture stands in.
  }
  if (!shown) ++impl_->stats.damaged;
  return impl_->entries.empty() ? ImageView() : ImageView(impl_->entries.front().image);
}

const FrameCacheStats& FrameCache::stats() const noexcept { return impl_->stats; }

}  // namespace vsprite
