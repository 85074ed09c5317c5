// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Least recently used pictures go first. A picture whose bytes are damaged is remembered, so that
// it is tried once only. All of this belongs to the caller's thread; the other one only turns
// numbers of samples into pictures.
#include "vsprite/stream.h"

#include <array>
#include <cstring>
#include <deque>
#include <iterator>
#include <list>
#include <new>
#include <system_error>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "decoder_thread.h"
#include "vsprite/owner.h"

namespace vsprite {

namespace {

// Samples ahead of an actor: under its present command, and under every other.
constexpr int kSoon = 1, kLater = 1;
constexpr int kMostTicks = 32;  // of looking for them

}  // namespace

struct FrameCache::Impl {
  using Entries = std::list<detail::DecodedFrame>;  // the newest in front

  const Sprite& sprite;
  std::size_t budget;
  FrameCacheStats stats{};
  Entries entries{};  ///< shown, or soon to be
  Entries guesses{};  ///< only under another command
  std::size_t guess_bytes = 0;
  std::unordered_map<std::uint32_t, Entries::iterator> by_sample{};
  std::array<std::uint32_t, 2> shown{kNoSample, kNoSample};  ///< handed out last, never dropped
  std::unordered_set<std::uint32_t> damaged{};
  /// Of the thread, and not yet taken over: true, for later only.
  std::unordered_map<std::uint32_t, bool> asked{};
  std::deque<std::uint32_t> soon{}, later{}, dropped{};
  std::unique_ptr<detail::DecoderThread> thread{};

  bool bring_to_front(std::uint32_t sample);
  bool decode_to_front(std::uint32_t sample);
  void put_in_front(Entries& one);
  void drop_oldest();
  bool start();
  void take_over();
  void want(std::uint32_t sample, std::deque<std::uint32_t>& list);
  void walk(Actor actor, int count, std::deque<std::uint32_t>& list);
};

bool FrameCache::Impl::bring_to_front(std::uint32_t sample) {
  const auto found = by_sample.find(sample);
  if (found == by_sample.end()) return false;
  detail::DecodedFrame& one = *found->second;
  Entries& list = one.is_guess ? guesses : entries;
  if (one.is_guess) guess_bytes -= one.image.rgba.size();
  one.is_guess = false;
  entries.splice(entries.begin(), list, found->second);
  return true;
}

void FrameCache::Impl::put_in_front(Entries& one) {
  const detail::DecodedFrame& frame = one.front();
  by_sample[frame.sample] = one.begin();
  stats.bytes += frame.image.rgba.size();
  if (frame.is_guess) guess_bytes += frame.image.rgba.size();
  Entries& list = frame.is_guess ? guesses : entries;
  list.splice(list.begin(), one, one.begin());
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
  put_in_front(fresh);
  return true;
}

// Guesses may fill what is left, and a third in any case.
void FrameCache::Impl::drop_oldest() {
  const auto drop = [this](Entries& list, Entries::iterator at) {
    const std::size_t bytes = at->image.rgba.size();
    stats.bytes -= bytes;
    if (at->is_guess) guess_bytes -= bytes;
    by_sample.erase(at->sample);
    return list.erase(at);
  };
  while (stats.bytes > budget && guess_bytes > budget / 3) drop(guesses, std::prev(guesses.end()));
  auto at = entries.end();
  while (stats.bytes > budget && at != entries.begin()) {
    --at;
    if (at->sample != shown[0] && at->sample != shown[1]) at = drop(entries, at);
  }
  while (stats.bytes > budget && !guesses.empty()) drop(guesses, std::prev(guesses.end()));
}

// ---- ahead of time ----

bool FrameCache::Impl::start() {
#if VSPRITE_THREADS
  if (!thread) try {
      thread = std::make_unique<detail::DecoderThread>(sprite);
    } catch (const std::system_error&) {
      return false;  // the machine has none to give: tried again with the next call
    }
#endif
  return thread != nullptr;
}

void FrameCache::Impl::take_over() {
  if (!thread) return;
  Entries ready;
  thread->take(ready);
  while (!ready.empty()) {
    const std::uint32_t sample = ready.front().sample;
    const bool is_good = ready.front().image.width > 0;
    if (is_good) asked.erase(sample);  // what cannot be decoded is not asked for again
    if (!is_good || by_sample.contains(sample)) {
      ready.pop_front();
      continue;
    }
    ++stats.ahead;
    put_in_front(ready);
  }
  drop_oldest();
}

void FrameCache::Impl::want(std::uint32_t sample, std::deque<std::uint32_t>& list) {
  const bool is_guess = &list == &later;
  if (const auto held = by_sample.find(sample); held != by_sample.end()) {
    if (!is_guess)
      bring_to_front(sample);
    else if (held->second->is_guess)
      guesses.splice(guesses.begin(), guesses, held->second);
    return;
  }
  if (damaged.contains(sample)) return;
  const auto [asked_before, is_new] = asked.try_emplace(sample, is_guess);
  if (!is_new && (is_guess || !asked_before->second)) return;
  asked_before->second = is_guess;
  list.push_back(sample);
}

void FrameCache::Impl::walk(Actor actor, int count, std::deque<std::uint32_t>& list) {
  for (int tick = 0; tick < kMostTicks && count > 0; ++tick) {
    const std::uint32_t before = actor.sample;
    step(sprite, actor);
    if (actor.sample == before) continue;
    want(actor.sample, list);
    --count;
  }
}

FrameCache::FrameCache(const Sprite& sprite, std::size_t budget)
    : impl_(new Impl{sprite, budget}) {}

FrameCache::~FrameCache() = default;

ImageView FrameCache::frame(std::uint32_t sample) noexcept {
  Impl& m = *impl_;
  bool is_good = false;
  try {
    m.take_over();
    is_good = m.bring_to_front(sample);
    if (is_good) ++m.stats.hits;
    is_good = is_good || m.decode_to_front(sample);
  } catch (const std::bad_alloc&) {
    // Drawing never fails: the last good picture stands in.
  }
  if (!is_good) ++m.stats.damaged;
  if (is_good && sample != m.shown[0]) m.shown = {sample, m.shown[0]};
  m.drop_oldest();
  const auto found = m.by_sample.find(m.shown[0]);
  return found == m.by_sample.end() ? ImageView() : ImageView(found->second->image);
}

void FrameCache::look_ahead(const Actor& actor) noexcept {
  Impl& m = *impl_;
  try {
    if (!m.start()) return;
    m.take_over();
    if ((actor.owner & kOwnerKind) == static_cast<int>(PositionOwner::Game)) {  // it knows where to
      for (std::uint32_t s = actor.sample; s < actor.sample + kSoon; ++s) {
        if (!m.sprite.is_natural(s, s + 1)) break;
        m.want(s + 1, m.soon);
      }
    } else {
      m.walk(actor, kSoon, m.soon);
      for (int d = 0; d < kDirectionCount; ++d) {
        Actor other = actor;
        set_direction(m.sprite, other, static_cast<Direction>(d));
        if (std::memcmp(&other, &actor, sizeof actor) != 0) m.walk(other, kLater, m.later);
      }
    }
    m.thread->ask(m.soon, m.later, m.dropped);
    for (const std::uint32_t sample : m.dropped) m.asked.erase(sample);
    m.dropped.clear();
  } catch (const std::bad_alloc&) {
    // Then they are decoded when they are asked for.
  }
}

const FrameCacheStats& FrameCache::stats() const noexcept { return impl_->stats; }

}  // namespace vsprite
