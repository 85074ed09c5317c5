// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Sequence headers: ITU-T H.264 7.3.2.1, H.265 7.3.2.2, H.262 6.2.2.1, T.81 B.2.2. The codecs'
// start codes do not clash: an H.264 sequence set has an odd header byte, an H.265 one 0x42 0x01,
// an MPEG-2 one 0xB3.
#include "film/coded_size.h"

#include <algorithm>
#include <vector>

namespace vsprite::detail {
namespace {

constexpr int kMaxSide = 1 << 16;

std::optional<CodedSize> sane(std::int64_t width, std::int64_t height) {
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) return std::nullopt;
  return CodedSize{static_cast<int>(width), static_cast<int>(height)};
}

// Bits of a header without its emulation bytes; zeros past the end, where `past` turns true.
class Bits {
 public:
  explicit Bits(std::span<const std::uint8_t> unit) {
    int zeros = 0;
    for (const std::uint8_t byte : unit.first(std::min<std::size_t>(unit.size(), 512))) {
      if (zeros >= 2 && byte == 3) {
        zeros = 0;
        continue;
      }
      zeros = byte == 0 ? zeros + 1 : 0;
      bytes_.push_back(byte);
    }
  }
  bool past() const { return at_ > 8 * bytes_.size(); }
  std::uint32_t take(int count) {
    std::uint32_t value = 0;
    for (; count > 0; --count, ++at_)
      value = value << 1 | (at_ < 8 * bytes_.size() ? bytes_[at_ / 8] >> (7 - at_ % 8) & 1u : 0u);
    return value;
  }
  void skip(int count) { at_ += static_cast<std::size_t>(count); }
  // Exponential Golomb codes, unsigned and signed.
  std::int64_t golomb() {
    int zeros = 0;
    while (zeros < 32 && !past() && take(1) == 0) ++zeros;
    return (std::int64_t{1} << zeros) - 1 + (zeros ? take(zeros) : 0u);
  }
  std::int64_t signed_golomb() {
    const std::int64_t k = golomb();
    return k % 2 ? (k + 1) / 2 : -(k / 2);
  }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

void skip_scaling_lists(Bits& bits, int lists) {
  for (int list = 0; list < lists; ++list) {
    if (!bits.take(1)) continue;
    std::int64_t next = 8;
    for (int k = 0; k < (list < 6 ? 16 : 64) && next != 0; ++k)
      next = (next + bits.signed_golomb()) & 255;
  }
}

std::optional<CodedSize> h264_size(Bits bits) {
  const std::uint32_t profile = bits.take(8);
  bits.skip(16);
  bits.golomb();
  bool high = false;
  std::int64_t chroma = 1;
  for (const std::uint32_t p : {100u, 110u, 122u, 244u, 44u, 83u, 86u, 118u, 128u, 138u})
    high = high || profile == p;
  if (!high && profile != 66 && profile != 77 && profile != 88) return std::nullopt;
  if (high) {
    chroma = bits.golomb();
    if (chroma == 3) bits.skip(1);
    bits.golomb();
    bits.golomb();
    bits.skip(1);
    if (bits.take(1)) skip_scaling_lists(bits, chroma == 3 ? 12 : 8);
  }
  bits.golomb();
  const std::int64_t order = bits.golomb();
  if (order == 0) bits.golomb();
  if (order == 1) {
    bits.skip(1);
    bits.golomb();
    bits.golomb();
    for (std::int64_t k = bits.golomb(); k > 0 && !bits.past(); --k) bits.golomb();
  }
  bits.golomb();
  bits.skip(1);
  const std::int64_t columns = bits.golomb() + 1;
  const std::int64_t rows = bits.golomb() + 1;
  const std::int64_t fields = bits.take(1) ? 1 : 2;
  bits.skip(fields == 2 ? 2 : 1);
  std::int64_t cut[4] = {};  // left, right, top, bottom
  if (bits.take(1))
    for (std::int64_t& side : cut) side = bits.golomb();
  if (bits.past()) return std::nullopt;
  const std::int64_t across = chroma == 1 || chroma == 2 ? 2 : 1;
  const std::int64_t down = (chroma == 1 ? 2 : 1) * fields;
  return sane(16 * columns - across * (cut[0] + cut[1]),
              16 * rows * fields - down * (cut[2] + cut[3]));
}

std::optional<CodedSize> h265_size(Bits bits) {
  bits.skip(4);
  const int layers = static_cast<int>(bits.take(3));
  bits.skip(1 + 96);
  std::uint32_t present = 0;
  for (int layer = 0; layers > 0 && layer < 8; ++layer) present = present << 2 | bits.take(2);
  for (int layer = 0; layer < layers; ++layer) {
    const std::uint32_t flags = present >> (14 - 2 * layer) & 3;
    bits.skip((flags & 2 ? 88 : 0) + (flags & 1 ? 8 : 0));
  }
  bits.golomb();
  if (bits.golomb() == 3) bits.skip(1);
  const std::int64_t width = bits.golomb();
  const std::int64_t height = bits.golomb();
  if (bits.past()) return std::nullopt;
  return sane(width, height);
}

// Segments of a JPEG picture up to its frame header.
std::optional<CodedSize> jpeg_size(std::span<const std::uint8_t> p) {
  std::size_t at = 2;
  while (at + 9 <= p.size() && p[at] == 0xFF) {
    const int kind = p[at + 1];
    if (kind >= 0xC0 && kind <= 0xC2)
      return sane(p[at + 7] << 8 | p[at + 8], p[at + 5] << 8 | p[at + 6]);
    at += 2 + static_cast<std::size_t>(p[at + 2] << 8 | p[at + 3]);
  }
  return std::nullopt;
}

}  // namespace

std::optional<CodedSize> find_coded_size(std::span<const std::uint8_t> p) {
  if (p.size() > 3 && p[0] == 0xFF && p[1] == 0xD8) return jpeg_size(p);
  // Video with start codes begins with one; headers come before the picture.
  if (p.size() < 5 || p[0] != 0 || p[1] != 0 || (p[2] != 1 && (p[2] != 0 || p[3] != 1)))
    return std::nullopt;
  for (std::size_t at = 0; at + 6 < p.size() && at < 65536; ++at) {
    if (p[at] != 0 || p[at + 1] != 0 || p[at + 2] != 1) continue;
    const std::uint8_t* head = p.data() + at + 3;
    std::optional<CodedSize> size;
    if ((head[0] & 0x9F) == 7) size = h264_size(Bits(p.subspan(at + 4)));
    if (head[0] == 0x42 && head[1] == 1) size = h265_size(Bits(p.subspan(at + 5)));
    if (head[0] == 0xB3) size = sane(head[1] << 4 | head[2] >> 4, (head[2] & 15) << 8 | head[3]);
    if (size) return size;
  }
  return std::nullopt;
}

}  // namespace vsprite::detail
