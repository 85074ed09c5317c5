// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The list of the sections that a pack may lack.
#include "sections.h"

namespace vsprite::detail {
namespace {

struct Kind {
  std::string_view name;
  bool (*is_there)(const SpriteData&);
  Bytes (*write)(const SpriteData&);
  Check (*read)(std::span<const std::uint8_t>, std::uint64_t, SpriteData&);
  Check (*check)(const SpriteData&);
};

constexpr Kind kKinds[] = {
    {"ACTN", [](const SpriteData& data) { return !data.actions.empty(); }, action_bytes,
     read_actions, check_actions},
    {"EVNT",
     [](const SpriteData& data) { return !data.event_names.empty() || !data.events.empty(); },
     event_bytes, read_events, check_events},
    {"BODY", [](const SpriteData& data) { return !data.bodies.empty(); }, body_bytes, read_bodies,
     check_bodies},
    {"SHDW", [](const SpriteData& data) { return !data.shadows.empty(); }, shadow_bytes,
     read_shadows, check_shadows},
};

Check read_kind(const ByteSource& source, const Kind& kind, PackContent& content) {
  const SectionEntry* found = nullptr;
  for (const SectionEntry& entry : content.sections) {
    if (entry.name != kind.name) continue;
    if (found != nullptr)
      return finding("section-twice", kind.name, entry.offset, "stands there more than once");
    found = &entry;
  }
  if (found == nullptr) return {};
  std::vector<std::uint8_t> bytes(found->bytes);
  if (auto read = source.read(found->offset, bytes); !read)
    return finding("unreadable", kind.name, found->offset, read.error().message, read.error().code);
  if (hash_bytes(bytes) != found->sum)
    return finding("section-sum", kind.name, found->offset,
                   "the section's sum does not fit its bytes");
  Check bad = kind.read(bytes, found->offset, content.data);
  if (!bad) bad = kind.check(content.data);
  if (bad && bad->issue.offset == 0) bad->issue.offset = found->offset;
  return bad;
}

}  // namespace

std::vector<OptionalSection> optional_sections(const SpriteData& data) {
  std::vector<OptionalSection> sections;
  for (const Kind& kind : kKinds)
    if (kind.is_there(data)) sections.push_back({kind.name, kind.write(data)});
  return sections;
}

Check read_optional(const ByteSource& source, PackContent& content) {
  for (const Kind& kind : kKinds)
    if (Check bad = read_kind(source, kind, content)) return bad;
  return {};
}

Check check_optional(const SpriteData& data) {
  for (const Kind& kind : kKinds)
    if (Check bad = kind.is_there(data) ? kind.check(data) : Check{}) return bad;
  return {};
}

bool leads(const SpriteData& data, std::uint32_t a, std::uint32_t b) noexcept {
  return is_natural(data, a, b) || find_transition(data, a, b) != nullptr;
}

bool is_first(const SpriteData& data, std::uint32_t sample) noexcept {
  const Sample& s = data.samples[sample];
  if (s.kept == 0) return false;
  if (sample == 0) return true;
  const Sample& before = data.samples[sample - 1];
  return before.kept == 0 || before.clip != s.clip || before.tag != s.tag;
}

}  // namespace vsprite::detail

namespace vsprite {

std::span<const Action> Sprite::actions() const noexcept { return impl_->action_list; }

std::uint64_t Sprite::identity() const noexcept { return impl_->identity; }

bool Sprite::is_first(std::uint32_t sample) const noexcept {
  return detail::is_first(impl_->data, sample);
}

}  // namespace vsprite
