// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// pack_format.h - the bytes of a pack (engine/PACK.md), and what reading, writing and verifying
// share.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "file.h"
#include "frame_codec.h"
#include "ticks.h"
#include "vsprite/pack.h"

namespace vsprite::detail {

inline constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'V', 'S', 'P', '\r', '\n', 0x1A, '\n'};
inline constexpr std::size_t kHeaderBytes = 64;
inline constexpr std::size_t kEntryBytes = 32;
inline constexpr std::size_t kAlignment = 64;
inline constexpr std::size_t kMetaBytes = 32;  ///< before the texts
inline constexpr std::size_t kSampleBytes = 60;
inline constexpr std::size_t kFrameBytes = 24;
inline constexpr std::size_t kModeBytes = 128;  ///< before the name
inline constexpr std::size_t kLossBytes = 16;

// Flags of a CTRL section.
inline constexpr unsigned kByState = 1, kPlaysThrough = 2;

inline constexpr std::uint64_t kMaxFileBytes = std::uint64_t{8} << 30;
inline constexpr std::uint32_t kMaxSections = 64;
inline constexpr std::uint32_t kMaxSamples = 1'000'000;
inline constexpr std::uint32_t kMaxTransitions = 1u << 30;
inline constexpr std::uint32_t kMaxTags = 4096;
inline constexpr std::uint32_t kMaxText = 255;
inline constexpr std::uint32_t kMaxModes = 16;
inline constexpr std::uint32_t kMaxTables = 256;  ///< a table index fits in a byte
inline constexpr std::uint32_t kMaxPixels = 1u << 24;

/// A PackIssue together with the code under which load_pack reports it.
struct Finding {
  ErrorCode error = ErrorCode::CorruptData;
  PackIssue issue;
};
using Check = std::optional<Finding>;  ///< empty: nothing found

Finding finding(std::string_view code, std::string_view section, std::uint64_t offset,
                std::string message, ErrorCode error = ErrorCode::CorruptData);

/// Meaning, not bytes: every index, order and range that playing relies on. The section and the
/// offset of the finding name the section of a pack; offset is 0.
Check check_sprite_data(const SpriteData& data);
/// True if `to` is the film's own continuation of `from`. Pre: both < N.
bool is_natural(const SpriteData& data, std::uint32_t from, std::uint32_t to) noexcept;
/// The entry of a jump, or null. Pre: both < N.
const Transition* find_transition(const SpriteData& data, std::uint32_t from,
                                  std::uint32_t to) noexcept;
/// What is not in a file but follows from it. May throw std::bad_alloc.
void complete(Sprite::Impl& impl);
/// What a pack asks for beyond that: a picture for every kept sample.
Check check_picture_sizes(const SpriteData& data);

/// One line of the section table.
struct SectionEntry {
  std::string name;
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  std::uint64_t sum = 0;
};

/// One line of FIDX.
struct FrameEntry {
  std::uint64_t offset = 0;  ///< inside FRAM
  std::uint32_t bytes = 0;   ///< compressed; 0 where the sample was not kept
  std::uint64_t sum = 0;     ///< XXH3-64 of the compressed bytes
};

/// LOSS: mean squared errors of the pictures, values 0..255.
struct PictureErrors {
  double colour = 0, alpha = 0;
};

/// Everything of a pack but its pictures.
struct PackContent {
  std::uint16_t major = 0, minor = 0;
  std::uint64_t identity = 0;  ///< the header's sum
  std::vector<SectionEntry> sections;
  SpriteData data;
  std::vector<FrameEntry> frames;
  std::uint64_t fram_offset = 0;
  std::optional<PictureErrors> loss;
};

/// Reads and checks header, tables and indices: what load_pack relies on.
Check read_header(const ByteSource& source, PackContent& content);
Check read_loss(const ByteSource& source, PackContent& content);
Check read_content(const ByteSource& source, PackContent& content);
/// load_pack and verify_pack from any source; verifying stops after `most` issues.
Result<Sprite> load_pack_from(ByteSource source);
Result<std::vector<PackIssue>> verify_pack_from(ByteSource source, std::size_t most = 1000);

std::uint64_t hash_bytes(std::span<const std::uint8_t> bytes) noexcept;

/// Appends numbers, little-endian.
class Bytes {
 public:
  template <class T>
  void put(T value) {
    static_assert(sizeof(T) <= 8);
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof(T));
    if constexpr (std::endian::native == std::endian::big) bits >>= 8 * (8 - sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      data.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
    }
  }
  void text(std::string_view value) { data.insert(data.end(), value.begin(), value.end()); }
  void pad_to(std::size_t multiple) {
    while (data.size() % multiple != 0) data.push_back(0);
  }
  std::vector<std::uint8_t> data;
};

/// Header and section table of a file of `end` bytes, with their sum.
Bytes header_bytes(std::span<const SectionEntry> sections, std::uint64_t end, std::uint16_t minor);

/// Takes numbers off the front, little-endian. Pre: enough bytes are left.
class Cursor {
 public:
  explicit Cursor(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  template <class T>
  T get() noexcept {
    T value;
    std::array<std::uint8_t, sizeof(T)> raw;
    std::copy_n(bytes_.begin(), sizeof(T), raw.begin());
    if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
    std::memcpy(&value, raw.data(), sizeof(T));
    bytes_ = bytes_.subspan(sizeof(T));
    return value;
  }
  /// As many as `out` holds.
  template <class T>
  void get_all(std::span<T> out) noexcept {
    static_assert(std::is_arithmetic_v<T>);
    if constexpr (std::endian::native == std::endian::big) {
      for (T& value : out) value = get<T>();
    } else if (!out.empty()) {
      std::memcpy(out.data(), take(out.size_bytes()).data(), out.size_bytes());
    }
  }
  std::span<const std::uint8_t> take(std::size_t count) noexcept {
    const auto front = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return front;
  }
  std::size_t left() const noexcept { return bytes_.size(); }

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace vsprite::detail

namespace vsprite {

struct Sprite::Impl {
  SpriteData data;
  std::vector<detail::TickTable> ticks;  ///< a mode
  std::uint64_t identity = 0;
  std::vector<Action> action_list;
  std::vector<std::uint32_t> pace;  ///< (N) mean step length about a sample, 1/65536 px
  std::uint32_t usual_step = 0;     ///< median length of the steps of moving samples, 1/65536 px
  detail::ByteSource source;        ///< where the pictures lie
  std::vector<detail::FrameEntry> frames;  ///< empty: a sprite from data alone
  std::uint64_t fram_offset = 0;
  bool has_blocks = false;         ///< the pack has LOSS
  mutable std::mutex mutex;        ///< guards the two below
  mutable std::size_t codecs = 0;  ///< made so far
  mutable std::vector<std::unique_ptr<detail::FrameCodec>> idle;

  /// As Sprite::decode_frame.
  Result<void> decode_trimmed(std::uint32_t sample, detail::TrimmedImage& out) const;
};

}  // namespace vsprite
