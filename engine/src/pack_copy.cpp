// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "pack_copy.h"

#include <algorithm>

namespace vsprite::detail {
namespace {

// Copies a section's bytes to `to`, in pieces.
Result<void> copy_section(const ByteSource& source, const SectionEntry& entry, std::uint64_t to,
                          FileWriter& file) {
  std::vector<std::uint8_t> piece(std::min<std::uint64_t>(entry.bytes, 1 << 20));
  for (std::uint64_t at = 0; at < entry.bytes; at += piece.size()) {
    piece.resize(std::min<std::uint64_t>(piece.size(), entry.bytes - at));
    if (auto read = source.read(entry.offset + at, piece); !read) return read;
    if (auto wrote = file.write(to + at, piece); !wrote) return wrote;
  }
  return {};
}

}  // namespace

Result<PackContent> read_table(const ByteSource& source) {
  PackContent content;
  const Check bad = read_header(source, content);
  if (!bad) return content;
  const bool named = bad->issue.code == "unreadable";
  return Error{bad->error, (named ? "" : source.name() + ": ") + bad->issue.message};
}

const SectionEntry* find_section(const PackContent& content, std::string_view name) {
  for (const SectionEntry& entry : content.sections)
    if (entry.name == name) return &entry;
  return nullptr;
}

Result<std::vector<std::uint8_t>> read_section(const ByteSource& source,
                                               const SectionEntry& entry) {
  std::vector<std::uint8_t> bytes(entry.bytes);
  if (auto read = source.read(entry.offset, bytes); !read) return read.error();
  if (hash_bytes(bytes) != entry.sum)
    return Error{ErrorCode::CorruptData,
                 source.name() + ": " + entry.name + ": its sum does not fit its bytes"};
  return bytes;
}

Result<void> copy_with_sections(const ByteSource& source, const std::string& to,
                                std::span<const PackExtra> given) {
  auto content = read_table(source);
  if (!content) return content.error();
  auto file = FileWriter::create(to);
  if (!file) return file.error();
  std::vector<SectionEntry> sections;
  for (const SectionEntry& entry : content->sections)
    if (std::none_of(given.begin(), given.end(),
                     [&](const PackExtra& extra) { return extra.name == entry.name; }))
      sections.push_back(entry);
  std::size_t count = sections.size();
  for (const PackExtra& extra : given) count += !extra.bytes.empty();
  std::uint64_t end = kHeaderBytes + count * kEntryBytes;
  // The gaps between sections are zeros: a hole in a new file reads as such.
  const auto place = [&end](std::uint64_t size) {
    const std::uint64_t at = (end + kAlignment - 1) / kAlignment * kAlignment;
    end = at + size;
    return at;
  };
  for (SectionEntry& entry : sections) {
    const std::uint64_t at = place(entry.bytes);
    if (auto copied = copy_section(source, entry, at, *file); !copied) return copied;
    entry.offset = at;
  }
  for (const PackExtra& extra : given) {
    if (extra.bytes.empty()) continue;
    const std::uint64_t at = place(extra.bytes.size());
    if (auto wrote = file->write(at, extra.bytes); !wrote) return wrote;
    sections.push_back({extra.name, at, extra.bytes.size(), hash_bytes(extra.bytes)});
  }
  if (auto wrote = file->write(0, header_bytes(sections, end, content->minor).data); !wrote)
    return wrote;
  return file->finish();
}

}  // namespace vsprite::detail

namespace vsprite {

Result<std::vector<std::uint8_t>> load_extra(const std::string& path, std::string_view name) {
  try {
    const auto source = detail::ByteSource::open(path);
    if (!source) return source.error();
    const auto content = detail::read_table(*source);
    if (!content) return content.error();
    const detail::SectionEntry* entry = detail::find_section(*content, name);
    if (entry == nullptr) return std::vector<std::uint8_t>{};
    return detail::read_section(*source, *entry);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory,
                 path + ": out of memory while reading " + std::string(name)};
  }
}

}  // namespace vsprite
