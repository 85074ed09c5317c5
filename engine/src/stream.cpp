// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// One list, what was shown or wanted last in front; the end is dropped. Pictures are held trimmed,
// so that twice as much of what may be shown next fits into the budget, and handed out whole, in
// one of two places. Where not even that fits, guesses are not decoded and dropped in turns: none
// takes the place of what was wanted within the tick. A picture whose bytes are damaged is
// remembered, so that it is tried once only. All of this belongs to the caller's thread; the other
// one only turns numbers of samples into pictures.
#include "vsprite/stream.h"

#include <array>
#include <chrono>
#include <cstring>
#include <deque>
#include <list>
#include <new>
#include <system_error>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "decoder_thread.h"
#include "pack_format.h"
#include "vsprite/owner.h"

namespace vsprite {

namespace {

// Samples ahead of an actor: under its present command, and under every other.
constexpr int kSoon = 1, kLater = 1;
constexpr int kMostTicks = 32;  // of looking for them
constexpr std::size_t kSeen = 4096;

struct Held {
  std::uint32_t sample = 0;
  std::int64_t wanted = 0;  ///< when, microseconds
  detail::TrimmedImage image;
};

/// Handed out.
struct Shown {
  std::uint32_t sample = kNoSample;
  Image image;
};

std::int64_t now() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

struct FrameCache::Impl {
  using Entries = std::list<Held>;

  const Sprite& sprite;
  std::size_t budget;
  std::int64_t tick_us;
  FrameCacheStats stats{};
  Entries entries{};  ///< shown or wanted last: in front
  std::unordered_map<std::uint32_t, Entries::iterator> by_sample{};
  std::array<Shown, 2> shown{};  ///< the last two, the last one first
  std::array<std::vector<std::uint8_t>, 2> shown_blocks{};  ///< the same of blocks()
  std::unordered_set<std::uint32_t> damaged{};
  struct Asked {
    bool is_guess = false;  ///< for later only
    std::int64_t wanted = 0;
  };
  std::unordered_map<std::uint32_t, Asked> asked{};  ///< of the thread, and not yet taken over
  std::deque<std::uint32_t> soon{}, later{}, dropped{};
  /// Actors that were looked at, and when; a place for each by its bytes.
  struct Seen {
    std::uint64_t actor = 0;
    std::int64_t at = 0;
  };
  std::vector<Seen> seen = std::vector<Seen>(kSeen);
  std::unique_ptr<detail::DecoderThread> thread{};

  bool bring_to_front(std::uint32_t sample, std::int64_t time);
  bool show(std::uint32_t sample);
  bool decode_to_front(std::uint32_t sample);
  void put_in_front(Entries& one);
  void drop_oldest();
  bool is_full(std::size_t more, std::int64_t time) const;
  bool start();
  void take_over();
  bool is_seen(const Actor& actor, std::int64_t time);
  void want(std::uint32_t sample, bool is_guess, std::int64_t time);
  void walk(Actor actor, int count, bool is_guess, std::int64_t time);
};

bool FrameCache::Impl::bring_to_front(std::uint32_t sample, std::int64_t time) {
  const auto found = by_sample.find(sample);
  if (found == by_sample.end()) return false;
  found->second->wanted = time;
  entries.splice(entries.begin(), entries, found->second);
  return true;
}

void FrameCache::Impl::put_in_front(Entries& one) {
  by_sample[one.front().sample] = one.begin();
  stats.bytes += one.front().image.bytes();
  entries.splice(entries.begin(), one, one.begin());
}

// Whole, in the first of the two places. False: not held.
bool FrameCache::Impl::show(std::uint32_t sample) {
  if (!bring_to_front(sample, now())) return false;
  if (shown[1].sample == sample) {
    std::swap(shown[0], shown[1]);
  } else if (shown[0].sample != sample) {
    Shown& place = shown[1];
    place.sample = kNoSample;
    stats.bytes -= place.image.rgba.size();
    place.image.rgba.clear();
    detail::expand(by_sample.find(sample)->second->image, place.image);
    stats.bytes += place.image.rgba.size();
    place.sample = sample;
    std::swap(shown[0], shown[1]);
  }
  return true;
}

bool FrameCache::Impl::decode_to_front(std::uint32_t sample) {
  if (damaged.contains(sample)) return false;
  ++stats.misses;
  Entries fresh(1);
  fresh.front().sample = sample;
  fresh.front().wanted = now();
  if (auto decoded = sprite.impl().decode_trimmed(sample, fresh.front().image); !decoded) {
    // Want of memory passes, damage does not.
    if (decoded.error().code != ErrorCode::OutOfMemory) damaged.insert(sample);
    return false;
  }
  put_in_front(fresh);
  return true;
}

void FrameCache::Impl::drop_oldest() {
  while (stats.bytes > budget && !entries.empty()) {
    stats.bytes -= entries.back().image.bytes();
    by_sample.erase(entries.back().sample);
    entries.pop_back();
  }
}

// True if something would have to go that was shown or wanted in this tick. (At its beginning the
// pictures of the last one were drawn half a tick ago, at two frames a tick.)
bool FrameCache::Impl::is_full(std::size_t more, std::int64_t time) const {
  return !entries.empty() && stats.bytes + more > budget &&
         time - entries.back().wanted < tick_us * 2 / 5;
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
  std::list<detail::DecodedFrame> ready;
  thread->take(ready);
  if (ready.empty()) return;
  const std::int64_t time = now();
  for (detail::DecodedFrame& frame : ready) {
    const auto found = asked.find(frame.sample);
    const Asked by = found == asked.end() ? Asked{frame.is_guess, time} : found->second;
    if (frame.image.width == 0) continue;  // cannot be decoded, and is not asked for again
    if (found != asked.end()) asked.erase(found);
    if (by_sample.contains(frame.sample)) continue;
    ++stats.ahead;
    if (by.is_guess && is_full(frame.image.bytes(), time)) continue;
    Entries fresh(1);
    fresh.front() = {frame.sample, by.wanted, std::move(frame.image)};
    put_in_front(fresh);
  }
  drop_oldest();
}

void FrameCache::Impl::want(std::uint32_t sample, bool is_guess, std::int64_t time) {
  if (bring_to_front(sample, time) || damaged.contains(sample)) return;
  if (is_guess && is_full(budget / 64, time)) return;
  const auto [before, is_new] = asked.try_emplace(sample, Asked{is_guess, time});
  before->second.wanted = time;
  if (!is_new && (is_guess || !before->second.is_guess)) return;
  before->second.is_guess = is_guess;
  (is_guess ? later : soon).push_back(sample);
}

void FrameCache::Impl::walk(Actor actor, int count, bool is_guess, std::int64_t time) {
  for (int tick = 0; tick < kMostTicks && count > 0; ++tick) {
    const std::uint32_t before = actor.sample;
    step(sprite, actor);
    if (actor.sample == before) continue;
    want(actor.sample, is_guess, time);
    --count;
  }
}

// Between two ticks an actor is drawn more than once; it is looked at once.
bool FrameCache::Impl::is_seen(const Actor& actor, std::int64_t time) {
  const std::uint64_t sum =
      detail::hash_bytes({reinterpret_cast<const std::uint8_t*>(&actor), sizeof actor});
  Seen& place = seen[sum % kSeen];
  if (place.actor == sum && time - place.at < tick_us) return true;
  place = {sum, time};
  return false;
}

FrameCache::FrameCache(const Sprite& sprite, std::size_t budget)
    : impl_(new Impl{sprite, budget, static_cast<std::int64_t>(1e6 / sprite.fps())}) {}

FrameCache::~FrameCache() = default;

ImageView FrameCache::frame(std::uint32_t sample) noexcept {
  Impl& m = *impl_;
  bool is_good = false;
  try {
    m.take_over();
    is_good = m.show(sample);
    if (is_good) ++m.stats.hits;
    is_good = is_good || (m.decode_to_front(sample) && m.show(sample));
  } catch (const std::bad_alloc&) {
    // Drawing never fails: the last good picture stands in.
  }
  if (!is_good) ++m.stats.damaged;
  m.drop_oldest();
  return m.shown[0].sample == kNoSample ? ImageView() : ImageView(m.shown[0].image);
}

BlockView FrameCache::blocks(std::uint32_t sample) noexcept {
  Impl& m = *impl_;
  if (!m.sprite.has_blocks()) return {};
  BlockView view;
  try {
    m.take_over();
    const bool is_held = m.bring_to_front(sample, now());
    if (is_held || m.decode_to_front(sample)) {
      const detail::TrimmedImage& held = m.by_sample.find(sample)->second->image;
      std::vector<std::uint8_t>& place = m.shown_blocks[1];
      m.stats.bytes -= place.size();
      place.clear();
      place = held.blocks;
      m.stats.bytes += place.size();
      std::swap(m.shown_blocks[0], m.shown_blocks[1]);
      if (!held.blocks.empty()) view = {m.shown_blocks[0].data(), held.width, held.height};
      if (is_held && view.bytes != nullptr) ++m.stats.hits;
    }
  } catch (const std::bad_alloc&) {
    // As if there were none.
  }
  m.drop_oldest();
  return view;
}

void FrameCache::look_ahead(const Actor& actor) noexcept {
  Impl& m = *impl_;
  try {
    const std::int64_t time = now();
    if (!m.start() || m.is_seen(actor, time)) return;
    m.take_over();
    if ((actor.owner & kOwnerKind) == static_cast<int>(PositionOwner::Game)) {  // it knows where to
      for (std::uint32_t s = actor.sample; s < actor.sample + kSoon; ++s) {
        if (!m.sprite.is_natural(s, s + 1)) break;
        m.want(s + 1, false, time);
      }
    } else {
      m.walk(actor, kSoon, false, time);
      for (int d = 0; d < kDirectionCount; ++d) {
        Actor other = actor;
        set_direction(m.sprite, other, static_cast<Direction>(d));
        if (std::memcmp(&other, &actor, sizeof actor) != 0) m.walk(other, kLater, true, time);
      }
    }
    m.drop_oldest();
    if (m.soon.empty() && m.later.empty()) return;
    m.thread->ask(m.soon, m.later, m.dropped);
    for (const std::uint32_t sample : m.dropped) m.asked.erase(sample);
    m.dropped.clear();
  } catch (const std::bad_alloc&) {
    // Then they are decoded when they are asked for.
  }
}

const FrameCacheStats& FrameCache::stats() const noexcept { return impl_->stats; }

}  // namespace vsprite
