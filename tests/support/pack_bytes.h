// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// pack_bytes.h - takes a pack apart and puts it together again with correct sums, so that what a
// test damages is what the reader has to find.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "pack_format.h"
#include "support/temp_folder.h"
#include "support/tiny_sprite.h"

namespace vsprite::testing {

using ByteVector = std::vector<std::uint8_t>;

template <class T>
void put_at(ByteVector& bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof value);
}
template <class T>
T get_at(const ByteVector& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

/// Makes the sum of header and section table right.
inline void seal_header(ByteVector& bytes) {
  const std::size_t count = get_at<std::uint32_t>(bytes, 12);
  const std::size_t end =
      std::min(bytes.size(), detail::kHeaderBytes + count * detail::kEntryBytes);
  put_at(bytes, 24, std::uint64_t{0});
  put_at(bytes, 24, detail::hash_bytes({bytes.data(), end}));
}

/// A pack as its sections.
struct PackParts {
  struct Part {
    std::string name;
    ByteVector bytes;
  };
  std::vector<Part> parts;
  std::uint16_t minor = 0;

  Part& operator[](const std::string& name) {
    return *std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.name == name; });
  }

  static PackParts split(const ByteVector& bytes) {
    PackParts out;
    out.minor = get_at<std::uint16_t>(bytes, 10);
    const std::size_t count = get_at<std::uint32_t>(bytes, 12);
    for (std::size_t s = 0; s < count; ++s) {
      const std::size_t at = detail::kHeaderBytes + s * detail::kEntryBytes;
      const auto offset = static_cast<std::ptrdiff_t>(get_at<std::uint64_t>(bytes, at + 8));
      const auto size = static_cast<std::ptrdiff_t>(get_at<std::uint64_t>(bytes, at + 16));
      out.parts.push_back({std::string(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                                       bytes.begin() + static_cast<std::ptrdiff_t>(at) + 4),
                           ByteVector(bytes.begin() + offset, bytes.begin() + offset + size)});
    }
    return out;
  }

  ByteVector join() const {
    ByteVector out(detail::kHeaderBytes + parts.size() * detail::kEntryBytes);
    for (std::size_t s = 0; s < parts.size(); ++s) {
      out.resize((out.size() + detail::kAlignment - 1) / detail::kAlignment * detail::kAlignment);
      const std::size_t at = detail::kHeaderBytes + s * detail::kEntryBytes;
      std::copy(parts[s].name.begin(), parts[s].name.end(),
                out.begin() + static_cast<std::ptrdiff_t>(at));
      put_at(out, at + 4, std::uint16_t{1});
      put_at(out, at + 8, std::uint64_t{out.size()});
      put_at(out, at + 16, std::uint64_t{parts[s].bytes.size()});
      put_at(out, at + 24, detail::hash_bytes(parts[s].bytes));
      out.insert(out.end(), parts[s].bytes.begin(), parts[s].bytes.end());
    }
    std::copy(detail::kMagic.begin(), detail::kMagic.end(), out.begin());
    put_at(out, 8, kPackMajor);
    put_at(out, 10, minor);
    put_at(out, 12, static_cast<std::uint32_t>(parts.size()));
    put_at(out, 16, std::uint64_t{out.size()});
    seal_header(out);
    return out;
  }
};

/// The bytes of the tiny sprite's pack, made once.
inline const ByteVector& tiny_pack_bytes() {
  static const ByteVector bytes = [] {
    const TempFolder folder;
    const SpriteData data = tiny_sprite_data();
    const auto saved = save_pack(folder.file("tiny.vsp"), data, [&](std::uint32_t sample) {
      return Result<Image>(tiny_picture(data, sample));
    });
    return saved ? read_bytes(folder.file("tiny.vsp")) : ByteVector();
  }();
  return bytes;
}

inline Result<Sprite> load_bytes(std::span<const std::uint8_t> bytes) {
  return detail::load_pack_from(detail::ByteSource::borrow(bytes, "tiny.vsp"));
}

inline std::vector<PackIssue> verify_bytes(std::span<const std::uint8_t> bytes,
                                           std::size_t most = 1000) {
  return *detail::verify_pack_from(detail::ByteSource::borrow(bytes, "tiny.vsp"), most);
}

}  // namespace vsprite::testing
