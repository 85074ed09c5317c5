// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Loading and verifying. Both read through the same code (pack_read.cpp); loading stops where the
// tables are sound, verifying goes on to padding, sums and every picture.
#include "vsprite/pack.h"

#define XXH_STATIC_LINKING_ONLY  // the size of the streaming state
#include <xxhash.h>

#include <algorithm>
#include <cmath>

#include "pack_format.h"
#include "sections.h"

namespace vsprite {
namespace detail {
namespace {

Error error_of(const ByteSource& source, const Finding& found) {
  // A message about the file itself begins with its name already.
  if (found.issue.code == "unreadable") return {found.error, found.issue.message};
  const std::string section = found.issue.section.empty() ? "" : found.issue.section + ": ";
  return {found.error, source.name() + ": " + section + found.issue.message};
}

bool is_zero(const ByteSource& source, std::uint64_t from, std::uint64_t to) {
  std::vector<std::uint8_t> bytes(to - from);
  if (!source.read(from, bytes)) return false;
  return std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t b) { return b == 0; });
}

void verify_padding(const ByteSource& source, const PackContent& content,
                    std::vector<PackIssue>& issues) {
  std::uint64_t end = kHeaderBytes + content.sections.size() * kEntryBytes;
  for (const SectionEntry& entry : content.sections) {
    if (!is_zero(source, end, entry.offset)) {
      issues.push_back(
          finding("padding", entry.name, end, "the bytes before the section are not 0").issue);
    }
    end = entry.offset + entry.bytes;
  }
}

// In pieces: FRAM, and sections that this build does not know, may be larger than memory.
void verify_sum(const ByteSource& source, const SectionEntry& entry,
                std::vector<PackIssue>& issues) {
  XXH3_state_t sum;
  XXH3_64bits_reset(&sum);
  std::vector<std::uint8_t> piece(std::min<std::uint64_t>(entry.bytes, 1 << 20));
  for (std::uint64_t at = 0; at < entry.bytes; at += piece.size()) {
    const auto size = std::min<std::uint64_t>(piece.size(), entry.bytes - at);
    const std::span<std::uint8_t> part(piece.data(), size);
    if (!source.read(entry.offset + at, part)) break;
    XXH3_64bits_update(&sum, part.data(), part.size());
  }
  if (XXH3_64bits_digest(&sum) == entry.sum) return;
  issues.push_back(
      finding("section-sum", entry.name, entry.offset, "the section's sum does not fit its bytes")
          .issue);
}

bool is_premultiplied(const Image& image) {
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const std::uint8_t alpha = image.rgba[i + 3];
    if (image.rgba[i] > alpha || image.rgba[i + 1] > alpha || image.rgba[i + 2] > alpha)
      return false;
  }
  return true;
}

void verify_frames(const ByteSource& source, const PackContent& content, std::size_t most,
                   std::vector<PackIssue>& issues) {
  FrameCodec codec;
  Image image;
  for (std::size_t i = 0; i < content.frames.size() && issues.size() < most; ++i) {
    const FrameEntry& frame = content.frames[i];
    const Sample& sample = content.data.samples[i];
    if (sample.kept == 0) continue;
    const std::uint64_t offset = content.fram_offset + frame.offset;
    const auto report = [&](std::string_view code, const std::string& what) {
      issues.push_back(
          finding(code, "FRAM", offset, "picture of sample " + std::to_string(i) + ": " + what)
              .issue);
    };
    const auto bytes = codec.input(frame.bytes);
    if (!source.read(offset, bytes) || hash_bytes(bytes) != frame.sum) {
      report("frame-sum", "its sum does not fit its bytes");
    } else if (!codec.decode(sample.width, sample.height, image)) {
      report("frame-decode", "its bytes are not a picture of " + std::to_string(sample.width) +
                                 " x " + std::to_string(sample.height) + " pixels");
    } else if (!is_premultiplied(image)) {
      report("frame-colour", "a colour is greater than its alpha");
    }
  }
}

}  // namespace

Result<Sprite> load_pack_from(ByteSource source) {
  try {
    PackContent content;
    if (Check bad = read_header(source, content)) return error_of(source, *bad);
    if (Check bad = read_content(source, content)) return error_of(source, *bad);
    auto impl = std::make_unique<Sprite::Impl>();
    impl->data = std::move(content.data);
    complete(*impl);
    impl->frames = std::move(content.frames);
    impl->fram_offset = content.fram_offset;
    impl->identity = content.identity;
    impl->has_blocks = content.loss.has_value();
    impl->source = std::move(source);
    return Sprite(std::move(impl));
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, source.name() + ": out of memory while loading"};
  }
}

Result<std::vector<PackIssue>> verify_pack_from(ByteSource source, std::size_t most) {
  try {
    PackContent content;
    std::vector<PackIssue> issues;
    if (Check bad = read_header(source, content)) {
      if (bad->issue.code == "unreadable") return error_of(source, *bad);
      return std::vector<PackIssue>{bad->issue};
    }
    verify_padding(source, content, issues);
    for (const SectionEntry& entry : content.sections) verify_sum(source, entry, issues);
    if (issues.size() >= most) return issues;
    if (Check bad = read_content(source, content)) {
      if (bad->issue.code == "unreadable") return error_of(source, *bad);
      // A table whose sum is wrong has been reported already.
      if (bad->issue.code != "section-sum") issues.push_back(bad->issue);
      return issues;
    }
    verify_frames(source, content, most, issues);
    for (const FilmedShadow& shadow : content.data.shadows) {
      if (issues.size() >= most) break;
      if (Check bad = verify_shadow(shadow)) issues.push_back(bad->issue);
    }
    return issues;
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, source.name() + ": out of memory while verifying"};
  }
}

}  // namespace detail

Result<Sprite> load_pack(const std::string& path) {
  auto source = detail::ByteSource::open(path);
  if (!source) return source.error();
  return detail::load_pack_from(std::move(*source));
}

Result<Sprite> load_pack(PackReader reader) {
  return detail::load_pack_from(detail::ByteSource::call(std::move(reader)));
}

Result<std::vector<PackIssue>> verify_pack(PackReader reader) {
  return detail::verify_pack_from(detail::ByteSource::call(std::move(reader)));
}

Result<std::vector<PackIssue>> verify_pack(const std::string& path) {
  auto source = detail::ByteSource::open(path);
  if (!source) return source.error();
  return detail::verify_pack_from(std::move(*source));
}

Result<PackInfo> read_pack_info(const std::string& path) {
  auto source = detail::ByteSource::open(path);
  if (!source) return source.error();
  try {
    detail::PackContent content;
    detail::Check bad = detail::read_header(*source, content);
    if (!bad) bad = detail::read_loss(*source, content);
    if (bad) return detail::error_of(*source, *bad);
    PackInfo info{.major = content.major,
                  .minor = content.minor,
                  .bytes = source->size(),
                  .sections = {},
                  .loss = {}};
    if (content.loss) {
      const auto ratio = [](double error) { return 10 * std::log10(255.0 * 255.0 / error); };
      info.loss = PackLoss{ratio(content.loss->colour), ratio(content.loss->alpha)};
    }
    for (const detail::SectionEntry& entry : content.sections) {
      info.sections.push_back({entry.name, entry.offset, entry.bytes});
    }
    return info;
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, path + ": out of memory"};
  }
}

}  // namespace vsprite
