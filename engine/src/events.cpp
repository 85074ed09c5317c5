// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The section EVNT (engine/PACK.md), and asking for what happened.
#include "vsprite/events.h"

#include <algorithm>
#include <set>

#include "sections.h"
#include "vsprite/owner.h"

namespace vsprite {
namespace detail {
namespace {

constexpr std::size_t kEventHeadBytes = 16, kEventBytes = 8;
constexpr std::uint32_t kMaxNames = 4096;
constexpr std::uint64_t kMaxEvents = 1u << 24;

Finding bad_event(std::string_view code, const std::string& what, std::uint64_t offset = 0) {
  return finding(code, "EVNT", offset, what);
}

}  // namespace

Bytes event_bytes(const SpriteData& data) {
  Bytes out;
  out.put(static_cast<std::uint32_t>(data.event_names.size()));
  out.put(std::uint32_t{0});
  out.put(std::uint64_t{data.events.size()});
  for (const SampleEvent& event : data.events) {
    out.put(event.sample);
    out.put(event.name);
  }
  for (const std::string& name : data.event_names) {
    out.put(static_cast<std::uint16_t>(name.size()));
    out.text(name);
  }
  return out;
}

Check read_events(std::span<const std::uint8_t> bytes, std::uint64_t offset, SpriteData& data) {
  const auto cut_off = [&](const std::string& what) {
    return bad_event("event-size", what + ", " + std::to_string(bytes.size()) + " bytes are there",
                     offset);
  };
  if (bytes.size() < kEventHeadBytes) return cut_off("16 bytes are due at least");
  Cursor cursor(bytes);
  const auto names = cursor.get<std::uint32_t>();
  if (cursor.get<std::uint32_t>() != 0)
    return bad_event("reserved", "reserved bytes are not 0", offset + 4);
  const auto events = cursor.get<std::uint64_t>();
  if (names == 0 || names > kMaxNames || events > kMaxEvents ||
      events * kEventBytes + 2 * std::uint64_t{names} > cursor.left())
    return cut_off(std::to_string(events) + " events of " + std::to_string(names) + " names");
  data.events.resize(events);
  for (SampleEvent& event : data.events) {
    event.sample = cursor.get<std::uint32_t>();
    event.name = cursor.get<std::uint32_t>();
  }
  data.event_names.resize(names);
  for (std::string& name : data.event_names) {
    const std::size_t length = cursor.left() < 2 ? SIZE_MAX : cursor.get<std::uint16_t>();
    if (length > cursor.left()) return cut_off("a name is cut off");
    const auto text = cursor.take(length);
    name.assign(text.begin(), text.end());
  }
  if (cursor.left() != 0) return cut_off("they end " + std::to_string(cursor.left()) + " before");
  return {};
}

Check check_events(const SpriteData& data) {
  std::set<std::string_view> seen;
  for (const std::string& name : data.event_names) {
    const bool control = std::any_of(name.begin(), name.end(), [](char c) {
      return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    });
    if (name.empty() || name.size() > kMaxText || control || !seen.insert(name).second)
      return bad_event("event-name", "`" + name + "`: names of 1 to 255 bytes are due, each once");
  }
  if (data.event_names.size() > kMaxNames || data.events.size() > kMaxEvents)
    return bad_event("event-size", "too many events");
  for (std::size_t k = 0; k < data.events.size(); ++k) {
    const SampleEvent& event = data.events[k];
    const std::string at = "event " + std::to_string(k) + ": ";
    if (event.sample >= data.samples.size())
      return bad_event("event-sample", at + "at sample " + std::to_string(event.sample) + " of " +
                                           std::to_string(data.samples.size()));
    if (event.name >= data.event_names.size())
      return bad_event("event-name", at + "has name " + std::to_string(event.name) + " of " +
                                         std::to_string(data.event_names.size()));
    if (k > 0 && !(data.events[k - 1] < event))
      return bad_event("event-order", at + "not in ascending order");
  }
  return {};
}

}  // namespace detail

TickEvents events_of(const Sprite& sprite, const Actor& actor) noexcept {
  TickEvents now;
  // What the game moves may have passed a sample's first tick within this one.
  const bool by_game = (actor.owner & kOwnerKind) == static_cast<std::uint8_t>(PositionOwner::Game);
  now.frame_shown = (actor.shown == 1 || by_game) && (actor.owner & kOwnerStill) == 0;
  if (!now.frame_shown) return now;
  now.jump_taken = actor.jumped != 0;
  const auto& events = sprite.data().events;
  const std::uint32_t first = actor.sample - actor.skipped;
  const auto begin = std::lower_bound(events.begin(), events.end(), SampleEvent{first, 0});
  const auto end = std::lower_bound(begin, events.end(), SampleEvent{actor.sample + 1, 0});
  now.named = {events.data() + (begin - events.begin()), static_cast<std::size_t>(end - begin)};
  return now;
}

int find_event(const Sprite& sprite, std::string_view name) noexcept {
  const auto& names = sprite.data().event_names;
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

}  // namespace vsprite
