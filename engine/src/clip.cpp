// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The section CLIP (engine/PACK.md): read apart from the sprite, and written by copying a pack.

#include "vsprite/clip.h"

#include <set>

#include "pack_copy.h"

namespace vsprite {
namespace detail {
namespace {

constexpr std::uint32_t kMaxClips = 4096;
constexpr std::uint32_t kMaxClipSamples = 1u << 24;
constexpr std::size_t kClipBytes = 24;  // before the name

Error bad_clip(const std::string& path, const std::string& what) {
  return {ErrorCode::CorruptData, path + ": CLIP: " + what};
}

Bytes clip_bytes(std::span<const PackClip> clips) {
  Bytes out;
  out.put(static_cast<std::uint32_t>(clips.size()));
  out.put(std::uint32_t{0});
  for (const PackClip& clip : clips) {
    out.put(clip.start.x);
    out.put(clip.start.y);
    out.put(static_cast<std::uint32_t>(clip.samples.size()));
    out.put(static_cast<std::uint32_t>(clip.name.size()));
    out.text(clip.name);
    out.pad_to(4);
    for (const std::uint32_t sample : clip.samples) out.put(sample);
    out.pad_to(8);
  }
  return out;
}

Result<PackClip> read_clip(const std::string& path, Cursor& cursor, std::size_t index) {
  const std::string which = "clip " + std::to_string(index);
  PackClip clip;
  if (cursor.left() < kClipBytes) return bad_clip(path, which + " is cut off");
  clip.start.x = cursor.get<std::int64_t>();
  clip.start.y = cursor.get<std::int64_t>();
  const std::uint64_t count = cursor.get<std::uint32_t>(), name = cursor.get<std::uint32_t>();
  const std::uint64_t padded = (name + 3) / 4 * 4;
  const std::uint64_t due = (padded + 4 * count + 7) / 8 * 8;
  if (name == 0 || name > kMaxText || count == 0 || count > kMaxClipSamples || due > cursor.left())
    return bad_clip(path, which + ": " + std::to_string(count) + " samples and a name of " +
                              std::to_string(name) + " bytes need " + std::to_string(due) +
                              " bytes, " + std::to_string(cursor.left()) + " are left");
  const auto text = cursor.take(padded);
  clip.name.assign(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(name));
  clip.samples.resize(count);
  for (std::uint32_t& sample : clip.samples) sample = cursor.get<std::uint32_t>();
  cursor.take(due - padded - 4 * count);
  return clip;
}

// Meaning: what playing relies on.
Result<void> check_clips(const std::string& path, std::span<const PackClip> clips,
                         std::span<const Sample> samples) {
  std::set<std::string_view> names;
  if (clips.size() > kMaxClips)
    return bad_clip(path, std::to_string(clips.size()) + " clips, at most 4096 are due");
  for (const PackClip& clip : clips) {
    if (clip.name.empty() || clip.name.size() > kMaxText || !names.insert(clip.name).second)
      return bad_clip(path, "`" + clip.name + "`: names of 1 to 255 bytes are due, each once");
    if (clip.samples.empty() || clip.samples.size() > kMaxClipSamples)
      return bad_clip(path, clip.name + ": " + std::to_string(clip.samples.size()) + " samples");
    for (const std::uint32_t sample : clip.samples)
      if (sample >= samples.size() || samples[sample].kept == 0)
        return bad_clip(path, clip.name + ": sample " + std::to_string(sample) +
                                  " is not a kept one of this pack");
  }
  return {};
}

Result<std::vector<PackClip>> read_clips(const ByteSource& source, const Sprite& sprite) {
  const std::string& path = source.name();
  const auto content = read_table(source);
  if (!content) return content.error();
  std::vector<PackClip> clips;
  const SectionEntry* entry = find_section(*content, "CLIP");
  if (entry == nullptr) return clips;
  constexpr std::uint64_t kMost = std::uint64_t{1} << 30;
  if (entry->bytes < 8 || entry->bytes > kMost)
    return bad_clip(path, std::to_string(entry->bytes) + " bytes: 8 to 2^30 are due");
  const auto bytes = read_section(source, *entry);
  if (!bytes) return bytes.error();
  Cursor cursor(*bytes);
  const auto count = cursor.get<std::uint32_t>();
  cursor.get<std::uint32_t>();
  for (std::size_t k = 0; k < count; ++k) {
    auto clip = read_clip(path, cursor, k);
    if (!clip) return clip.error();
    clips.push_back(std::move(*clip));
  }
  if (cursor.left() != 0)
    return bad_clip(path, std::to_string(cursor.left()) + " bytes more than its clips need");
  if (auto checked = check_clips(path, clips, sprite.samples()); !checked) return checked.error();
  return clips;
}

}  // namespace
}  // namespace detail

Result<std::vector<PackClip>> load_clips(const std::string& path, const Sprite& sprite) {
  try {
    const auto source = detail::ByteSource::open(path);
    if (!source) return source.error();
    return detail::read_clips(*source, sprite);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, path + ": out of memory while reading clips"};
  }
}

Result<void> save_clips(const std::string& from, const std::string& to,
                        std::span<const PackClip> clips) {
  try {
    const auto sprite = load_pack(from);
    if (!sprite) return sprite.error();
    if (auto checked = detail::check_clips(to, clips, sprite->samples()); !checked) return checked;
    const auto source = detail::ByteSource::open(from);
    if (!source) return source.error();
    detail::Bytes bytes;
    if (!clips.empty()) bytes = detail::clip_bytes(clips);
    const PackExtra section{"CLIP", std::move(bytes.data)};
    return detail::copy_with_sections(*source, to, {&section, 1});
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, to + ": out of memory while writing clips"};
  }
}

ClipPlayer start_clip(const PackClip& clip) noexcept { return {.position = clip.start}; }

bool step(const Sprite& sprite, const PackClip& clip, ClipPlayer& player) noexcept {
  const Sample& sample = sprite.samples()[clip.samples[player.index]];
  const bool is_over = player.shown >= sample.duration;
  if (is_over && player.index + 1 == clip.samples.size()) return false;
  player.position.x += sample.step_x;
  player.position.y += sample.step_y;
  if (is_over) {
    ++player.index;
    player.shown = 1;
  } else {
    ++player.shown;
  }
  return true;
}

}  // namespace vsprite
