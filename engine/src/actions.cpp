// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The section ACTN (engine/PACK.md): the tables of the tags, and which tags make one action.
#include <cmath>

#include "sections.h"

namespace vsprite::detail {
namespace {

constexpr std::size_t kActionHeadBytes = 16, kTableHeadBytes = 8;
constexpr std::uint32_t kMaxHorizon = 64;
constexpr std::uint64_t kPlainArrays = 5;

Finding bad_table(std::string_view code, const ActionTable& table, const std::string& what) {
  return finding(code, "ACTN", 0, "tag " + std::to_string(table.tag) + ": " + what);
}

// V falls along `next`, by at least a little at every sample, so that every way ends.
Check check_way(const SpriteData& data, const ActionTable& t, std::uint32_t i) {
  const std::uint32_t next = t.next[i];
  const std::string at = "sample " + std::to_string(i) + ": ";
  if (is_first(data, i) && data.samples[i].tag == t.tag) {
    if (next == i && t.value[i] == 0) return {};
    return bad_table("action-next", t, at + "a first sample of the tag is not its own end");
  }
  if (next >= data.samples.size() || !leads(data, i, next))
    return bad_table("action-next", t, at + "next is no transition");
  if (!std::isfinite(t.value[i]) || !(t.value[next] < t.value[i]) || !(t.value[next] >= 0))
    return bad_table("action-value", t, at + "the cost to go does not fall along the way");
  return {};
}

Check check_cut(const SpriteData& data, const ActionTable& t, std::uint32_t i) {
  const std::uint32_t to = t.cut[i];
  const bool fits = to < data.samples.size() && is_first(data, to) &&
                    data.samples[to].tag == t.tag && std::isfinite(t.cut_cost[i]) &&
                    t.cut_cost[i] >= 0;
  if (fits) return {};
  return bad_table("action-cut", t,
                   "sample " + std::to_string(i) + ": its cut leads to no first sample of the tag");
}

Check check_stay(const SpriteData& data, const ActionTable& t, std::uint32_t i) {
  const std::uint32_t to = t.stay[i];
  if (data.samples[i].tag != t.tag ? to == kNoSample : to == i) return {};
  if (to < data.samples.size() && data.samples[i].tag == t.tag && data.samples[to].tag == t.tag &&
      leads(data, i, to))
    return {};
  return bad_table("action-stay", t,
                   "sample " + std::to_string(i) + ": what follows it is not of the tag");
}

// What is left of a deadline after a sample decides what may follow: at its end only a first one.
Check check_deadlines(const SpriteData& data, const ActionTable& t, std::uint32_t i) {
  const std::size_t n = data.samples.size();
  for (std::uint32_t m = 1; m <= data.action_horizon; ++m) {
    const std::uint32_t to = t.in_time[(m - 1) * n + i];
    const std::uint32_t lasts = data.samples[i].duration;
    const bool first = to < n && is_first(data, to) && data.samples[to].tag == t.tag;
    if (t.next[i] == i ? to == i : to == t.cut[i]) continue;
    if (m >= lasts && to < n && leads(data, i, to) && (first || m > lasts)) continue;
    return bad_table("action-deadline", t,
                     "sample " + std::to_string(i) + ", " + std::to_string(m) +
                         " ticks left: what follows does not come in time");
  }
  return {};
}

Check check_table(const SpriteData& data, const ActionTable& t) {
  const std::size_t n = data.samples.size();
  if (t.tag >= data.tags.size())
    return bad_table("action-tag", t, "there are " + std::to_string(data.tags.size()) + " tags");
  if (t.value.size() != n || t.next.size() != n || t.cut_cost.size() != n || t.cut.size() != n ||
      t.stay.size() != n || t.in_time.size() != n * data.action_horizon)
    return bad_table("action-size", t, "an array is not as long as there are samples");
  for (std::uint32_t i = 0; i < n; ++i) {
    if (data.samples[i].kept == 0) {
      bool none = t.next[i] == kNoSample && t.cut[i] == kNoSample && t.stay[i] == kNoSample &&
                  t.value[i] == 0 && t.cut_cost[i] == 0;
      for (std::uint32_t m = 0; m < data.action_horizon; ++m)
        none = none && t.in_time[m * n + i] == kNoSample;
      if (none) continue;
      return bad_table("action-kept", t,
                       "sample " + std::to_string(i) + " was not kept but leads somewhere");
    }
    if (Check bad = check_way(data, t, i)) return bad;
    if (Check bad = check_cut(data, t, i)) return bad;
    if (Check bad = check_stay(data, t, i)) return bad;
    if (Check bad = check_deadlines(data, t, i)) return bad;
  }
  return {};
}

}  // namespace

Bytes action_bytes(const SpriteData& data) {
  Bytes out;
  out.put(static_cast<std::uint32_t>(data.actions.size()));
  out.put(data.action_horizon);
  out.put(data.action_tau);
  out.put(std::uint32_t{0});
  for (const ActionTable& t : data.actions) {
    out.put(t.tag);
    out.put(std::uint16_t{0});
    out.put(std::uint32_t{0});
    for (const float value : t.value) out.put(value);
    for (const std::uint32_t next : t.next) out.put(next);
    for (const float cost : t.cut_cost) out.put(cost);
    for (const std::uint32_t cut : t.cut) out.put(cut);
    for (const std::uint32_t stay : t.stay) out.put(stay);
    for (const std::uint32_t next : t.in_time) out.put(next);
  }
  return out;
}

Check read_actions(std::span<const std::uint8_t> bytes, std::uint64_t offset, SpriteData& data) {
  const std::uint64_t n = data.samples.size();
  const auto wrong_size = [&](std::uint64_t due) {
    return finding(
        "action-size", "ACTN", offset,
        std::to_string(due) + " bytes are due, " + std::to_string(bytes.size()) + " are there");
  };
  if (bytes.size() < kActionHeadBytes) return wrong_size(kActionHeadBytes);
  Cursor cursor(bytes);
  const auto count = cursor.get<std::uint32_t>();
  data.action_horizon = cursor.get<std::uint32_t>();
  data.action_tau = cursor.get<float>();
  if (cursor.get<std::uint32_t>() != 0)
    return finding("reserved", "ACTN", offset + 12, "reserved bytes are not 0");
  if (count == 0 || count > data.tags.size() || data.action_horizon > kMaxHorizon)
    return finding("action-count", "ACTN", offset,
                   std::to_string(count) + " tables of " + std::to_string(data.action_horizon) +
                       " deadlines, 1 to " + std::to_string(data.tags.size()) + " of at most " +
                       std::to_string(kMaxHorizon) + " are due");
  const std::uint64_t table = kTableHeadBytes + 4 * n * (kPlainArrays + data.action_horizon);
  if (bytes.size() != kActionHeadBytes + count * table) return wrong_size(kActionHeadBytes + count * table);
  data.actions.resize(count);
  for (ActionTable& t : data.actions) {
    t.tag = cursor.get<std::uint16_t>();
    if (cursor.get<std::uint16_t>() != 0 || cursor.get<std::uint32_t>() != 0)
      return finding("reserved", "ACTN", offset, "reserved bytes of a table are not 0");
    t.value.resize(n), t.next.resize(n), t.cut_cost.resize(n), t.cut.resize(n), t.stay.resize(n);
    t.in_time.resize(n * data.action_horizon);
    for (float& value : t.value) value = cursor.get<float>();
    for (std::uint32_t& next : t.next) next = cursor.get<std::uint32_t>();
    for (float& cost : t.cut_cost) cost = cursor.get<float>();
    for (std::uint32_t& cut : t.cut) cut = cursor.get<std::uint32_t>();
    for (std::uint32_t& stay : t.stay) stay = cursor.get<std::uint32_t>();
    for (std::uint32_t& next : t.in_time) next = cursor.get<std::uint32_t>();
  }
  return {};
}

Check check_actions(const SpriteData& data) {
  if (!std::isfinite(data.action_tau) || !(data.action_tau > 0))
    return finding("action-tau", "ACTN", 0, "the price of a tick is not a finite number > 0");
  if (data.action_horizon > kMaxHorizon)
    return finding("action-count", "ACTN", 0, "more than 64 deadlines");
  for (std::size_t k = 0; k < data.actions.size(); ++k) {
    if (k > 0 && data.actions[k].tag <= data.actions[k - 1].tag)
      return bad_table("action-tag", data.actions[k], "the tables do not ascend by tag");
    if (Check bad = check_table(data, data.actions[k])) return bad;
  }
  return {};
}

std::vector<Action> list_actions(const SpriteData& data) {
  constexpr std::array<std::string_view, Action::kPhases> kSuffix{".start", ".air", ".end"};
  std::vector<Action> actions;
  const auto action_of = [&](std::string_view name) -> Action& {
    for (Action& action : actions)
      if (action.name == name) return action;
    actions.push_back({std::string(name), {-1, -1, -1}, false});
    return actions.back();
  };
  for (std::size_t k = 0; k < data.actions.size(); ++k) {
    const std::string_view tag = data.tags[data.actions[k].tag];
    const auto index = static_cast<std::int32_t>(k);
    action_of(tag).tables[Action::kStart] = index;
    const std::size_t dot = std::min(tag.rfind('.'), tag.size());
    const auto phase = std::find(kSuffix.begin(), kSuffix.end(), tag.substr(dot));
    if (phase == kSuffix.end() || dot == 0) continue;
    // A tag `jump` beside jump.air is what comes first.
    Action& whole = action_of(tag.substr(0, dot));
    whole.tables[static_cast<std::size_t>(phase - kSuffix.begin())] = index;
    whole.has_phases = true;
  }
  return actions;
}

}  // namespace vsprite::detail
