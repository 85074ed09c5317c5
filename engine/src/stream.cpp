// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Least recently used pictures go first. A picture that cannot be decoded is remembered as damaged,
// so that it is tried once only.
#include "vsprite/stream.h"

#include <list>
#include <unordered_map>
#include <utility>

namespace vsprite {

struct FrameCache::Impl {
  struct Entry {
    std::uint32_t sample = 0;
    Image image;
    bool damaged = false;
  };
  using Entries = std::list<Entry>;  // the newest in front

  const Sprite& sprite;
  std::size_t budget;
  FrameCacheStats stats;
  Entries entries;
  std::unordered_map<std::uint32_t, Entries::iterator> by_sample;
  Image last_good;  // what stands in for a damaged picture

  Entry& find_or_decode(std::uint32_t sample);
  void drop_oldest();
};

FrameCache::Impl::Entry& FrameCache::Impl::find_or_decode(std::uint32_t sample) {
  if (const auto found = by_sample.find(sample); found != by_sample.end()) {
    ++stats.hits;
    entries.splice(entries.begin(), entries, found->second);
    return entries.front();
  }
  ++stats.misses;
  Entry entry;
  entry.sample = sample;
  if (!sprite.decode_frame(sample, entry.image)) {
    entry.damaged = true;
    entry.image = {};
  }
  entries.push_front(std::move(entry));
  by_sample[sample] = entries.begin();
  stats.bytes += entries.front().image.rgba.size();
  drop_oldest();
  return entries.front();
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

ImageView FrameCache::frame(std::uint32_t sample) {
  const Impl::Entry& entry = impl_->find_or_decode(sample);
  if (entry.damaged) {
    ++impl_->stats.damaged;
    return impl_->last_good;
  }
  return entry.image;
}

const FrameCacheStats& FrameCache::stats() const noexcept { return impl_->stats; }

}  // namespace vsprite
