// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Taking compressed pictures apart, on any bytes, and making them. The writer tries both ways of
// predicting a row and every factor of alpha; all its choices are integers.
#include "frame_codec.h"

#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdlib>
#include <cstring>

#include "pack_format.h"

namespace vsprite::detail {
namespace {

constexpr std::size_t kSlack = 64;       // two blocks are read as so many bytes
constexpr std::uint32_t kLeastGap = 16;  // transparent pixels that end a run

// Numbers of the row part: one byte each where the width allows, else two.
class RowNumbers {
 public:
  RowNumbers(std::span<const std::uint8_t> bytes, int width) : bytes_(bytes), wide_(width > 255) {}
  // False: the bytes have come to an end.
  bool get(std::uint32_t& value) {
    const std::size_t size = wide_ ? 2 : 1;
    if (bytes_.size() - at_ < size) return false;
    value = bytes_[at_];
    if (wide_) value |= std::uint32_t{bytes_[at_ + 1]} << 8;
    at_ += size;
    return true;
  }
  std::size_t used() const { return at_; }

 private:
  std::span<const std::uint8_t> bytes_;
  bool wide_;
  std::size_t at_ = 0;
};

bool read_row(RowNumbers& numbers, FrameParts& parts) {
  std::uint32_t head = 0;
  if (!numbers.get(head)) return false;
  parts.rows.push_back({head / 2, head % 2 != 0});
  std::uint32_t end = 0;
  for (std::uint32_t k = 0; k < head / 2; ++k) {
    std::uint32_t gap = 0, count = 0;
    if (!numbers.get(gap) || !numbers.get(count)) return false;
    const auto left = static_cast<std::uint32_t>(parts.width) - end;
    if (count == 0 || gap > left || count > left - gap) return false;
    parts.runs.push_back({end + gap, end + gap + count});
    end += gap + count;
    parts.pixels += count;
  }
  return true;
}

std::size_t block_count(std::size_t pixels) { return (pixels + kBlock - 1) / kBlock; }

// Bytes of a block, by its codes.
constexpr std::array<std::uint8_t, 4096> kBlockBytes = [] {
  std::array<std::uint8_t, 4096> bytes{};
  for (unsigned codes = 0; codes < 4096; ++codes)
    for (unsigned shift = 0; shift < 12; shift += 3)
      bytes[codes] = static_cast<std::uint8_t>(bytes[codes] + kWidths[codes >> shift & 7]);
  return bytes;
}();

// Bytes of all residuals, from the widths of the blocks.
std::size_t residual_bytes(const std::uint8_t* widths, std::size_t blocks) {
  std::size_t sum = 0;
  for (std::size_t b = 0; b < blocks; ++b) sum += kBlockBytes[block_codes(widths, b) & 0xFFF];
  return sum;
}

}  // namespace

std::span<std::uint8_t> FrameCodec::input(std::size_t bytes) {
  size_ = bytes;
  buffer_.resize(bytes + kSlack);
  return {buffer_.data(), bytes};
}

bool FrameCodec::read_parts(int width, int height) {
  const std::span<const std::uint8_t> bytes = this->bytes();
  if (bytes.size() < kFrameHead || bytes[0] != kFrameForm) return false;
  parts_.width = width;
  parts_.height = height;
  for (std::size_t c = 0; c < 3; ++c) {
    parts_.factors[c] = static_cast<std::int8_t>(bytes[1 + c]);
    if (std::abs(parts_.factors[c]) > kMaxFactor) return false;
  }
  parts_.rows.clear();
  parts_.runs.clear();
  parts_.pixels = 0;
  RowNumbers numbers(bytes.subspan(kFrameHead), width);
  for (int y = 0; y < height; ++y)
    if (!read_row(numbers, parts_)) return false;
  const std::size_t blocks = block_count(parts_.pixels);
  const std::size_t at = kFrameHead + numbers.used(), width_bytes = (12 * blocks + 7) / 8;
  if (bytes.size() - at < width_bytes) return false;
  parts_.widths = bytes.data() + at;
  parts_.residuals = parts_.widths + width_bytes;
  const bool is_padded = blocks % 2 == 0 || parts_.widths[width_bytes - 1] >> 4 == 0;
  return is_padded && residual_bytes(parts_.widths, blocks) == bytes.size() - at - width_bytes;
}

bool FrameCodec::decode(int width, int height, Image& image) {
  if (is_blocks()) {
    if (!unsqueeze_blocks(bytes(), width, height, blocks_)) return false;
    decode_blocks(blocks_, width, height, image);
    return true;
  }
  if (!read_parts(width, height)) return false;
  image.rgba.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  image.width = width;
  image.height = height;
  scratch_.resize(decode_scratch(parts_));
  decode_parts(parts_, scratch_, image.rgba.data());
  return true;
}

bool FrameCodec::decode(int width, int height, TrimmedImage& image) {
  image.width = width;
  image.height = height;
  image.rows.clear();
  image.rgba.clear();
  image.blocks.clear();
  if (is_blocks()) return unsqueeze_blocks(bytes(), width, height, image.blocks);
  if (!decode(width, height, whole_)) return false;
  image.rows.reserve(parts_.rows.size());
  std::size_t pixels = 0;
  const Run* run = parts_.runs.data();
  for (const RowHead& head : parts_.rows) {
    image.rows.push_back(head.runs == 0 ? Run{} : Run{run->begin, run[head.runs - 1].end});
    run += head.runs;
    pixels += image.rows.back().end - image.rows.back().begin;
  }
  image.rgba.reserve(4 * pixels);
  const std::uint8_t* from = whole_.rgba.data();
  for (const Run& row : image.rows) {
    image.rgba.insert(image.rgba.end(), from + std::size_t{4} * row.begin,
                      from + std::size_t{4} * row.end);
    from += 4 * static_cast<std::size_t>(width);
  }
  return true;
}

void expand(const TrimmedImage& trimmed, Image& image) {
  if (!trimmed.blocks.empty())
    return decode_blocks(trimmed.blocks, trimmed.width, trimmed.height, image);
  const auto width = static_cast<std::size_t>(trimmed.width);
  image.rgba.clear();
  image.rgba.reserve(4 * width * trimmed.rows.size());
  const std::uint8_t* from = trimmed.rgba.data();
  std::size_t blank = 0;  // since the last pixels
  for (const Run& row : trimmed.rows) {
    const std::size_t bytes = std::size_t{4} * (row.end - row.begin);
    if (bytes > 0) {
      image.rgba.resize(image.rgba.size() + 4 * (blank + row.begin));
      image.rgba.insert(image.rgba.end(), from, from + bytes);
      from += bytes;
      blank = width - row.end;
    } else {
      blank += width;
    }
  }
  image.rgba.resize(image.rgba.size() + 4 * blank);
  image.width = trimmed.width;
  image.height = trimmed.height;
}

namespace {

// Residuals of one channel, modulo 256, as signed numbers.
using Plane = std::vector<std::int8_t>;
using Planes = std::array<Plane, 4>;

std::vector<Run> find_runs(const Image& image, int y) {
  const auto width = static_cast<std::uint32_t>(image.width);
  const std::uint8_t* row = image.rgba.data() + std::size_t{4} * width * static_cast<unsigned>(y);
  std::vector<Run> runs;
  for (std::uint32_t x = 0; x < width; ++x) {
    const std::uint8_t* p = row + std::size_t{4} * x;
    if ((p[0] | p[1] | p[2] | p[3]) == 0) continue;
    if (runs.empty() || x - runs.back().end >= kLeastGap)
      runs.push_back({x, x + 1});
    else
      runs.back().end = x + 1;
  }
  return runs;
}

std::int8_t wrap(int value) { return static_cast<std::int8_t>(static_cast<std::uint8_t>(value)); }

// Residuals of a row in one of the two ways of predicting it.
Planes predict_row(const Image& image, int y, std::span<const Run> runs, bool is_smooth) {
  const std::size_t stride = std::size_t{4} * static_cast<std::size_t>(image.width);
  const std::uint8_t* row = image.rgba.data() + stride * static_cast<std::size_t>(y);
  Planes planes;
  for (std::size_t c = 0; c < 4; ++c) {
    for (const Run& run : runs) {
      int before = 0;
      for (std::size_t x = run.begin; x < run.end; ++x) {
        const std::uint8_t* p = row + 4 * x + c;
        const int change = *p - (y == 0 ? 0 : *(p - stride));
        planes[c].push_back(wrap(change - (is_smooth ? before : 0)));
        before = change;
      }
    }
  }
  return planes;
}

// Bits of a value with its sign: 0 needs none, -1 one, 1 and -2 two.
constexpr std::array<std::uint8_t, 256> kBitsOf = [] {
  std::array<std::uint8_t, 256> bits{};
  for (unsigned v = 1; v < 256; ++v)
    bits[v] = static_cast<std::uint8_t>(1 + std::bit_width(v < 128 ? v : 255 - v));
  return bits;
}();

unsigned bits_of(int value) { return kBitsOf[static_cast<std::uint8_t>(value)]; }

unsigned row_price(const Planes& planes) {
  unsigned price = 0;
  for (std::size_t i = 0; i < planes[0].size(); ++i) {
    const int green = planes[kGreen][i];
    price += bits_of(planes[kAlpha][i]) + bits_of(green) + bits_of(planes[kRed][i] - green) +
             bits_of(planes[kBlue][i] - green);
  }
  return price;
}

// The code of the least width of at least so many bits.
constexpr std::array<std::uint8_t, 9> kCodeOf = [] {
  std::array<std::uint8_t, 9> codes{};
  for (std::size_t bits = 0; bits < codes.size(); ++bits)
    while (kWidths[codes[bits]] < bits) ++codes[bits];
  return codes;
}();

// The code of the least width that holds the block's residuals: bits_of the widest, all at once.
unsigned block_code(std::span<const std::int8_t> block) {
  static_assert(kBlock == 8);
  std::uint64_t values = 0;
  if (block.size() == kBlock)
    std::memcpy(&values, block.data(), kBlock);
  else
    std::memcpy(&values, block.data(), block.size());
  const std::uint64_t negative = (values >> 7) & 0x0101010101010101u;
  std::uint64_t folded = values ^ (negative * 0xFF);  // v or ~v
  folded |= folded >> 32, folded |= folded >> 16, folded |= folded >> 8;
  const auto bits = values == 0 ? 0u : 1u + static_cast<unsigned>(std::bit_width(folded & 0xFF));
  return kCodeOf[bits];
}

std::span<const std::int8_t> block_of(const Plane& plane, std::size_t b) {
  return std::span(plane).subspan(b * kBlock, std::min(kBlock, plane.size() - b * kBlock));
}

std::size_t plane_price(const Plane& plane) {
  std::size_t bytes = 0;
  for (std::size_t b = 0; b < block_count(plane.size()); ++b)
    bytes += kWidths[block_code(block_of(plane, b))];
  return bytes;
}

// What is left of a colour beyond its share of alpha (and of green).
void take_residue(const Plane& color, const Plane& alpha, const Plane* green, int factor,
                  Plane& rest) {
  rest.resize(color.size());
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const int predicted = (alpha[i] * factor >> kFactorShift) + (green ? (*green)[i] : 0);
    rest[i] = wrap(color[i] - predicted);
  }
}

// Replaces the channel by what is left of it at the best factor, which is returned.
std::int8_t decouple(Plane& color, const Plane& alpha, const Plane* green) {
  Plane rest, best;
  int best_factor = 0;
  std::size_t least = ~std::size_t{0};
  for (int factor = green ? -kMaxFactor : 0; factor <= kMaxFactor; ++factor) {
    take_residue(color, alpha, green, factor, rest);
    const std::size_t price = plane_price(rest);
    if (price >= least) continue;
    least = price;
    std::swap(best, rest);
    best_factor = factor;
  }
  color = std::move(best);
  return static_cast<std::int8_t>(best_factor);
}

void put_number(std::vector<std::uint8_t>& out, int width, std::size_t value) {
  out.push_back(static_cast<std::uint8_t>(value));
  if (width > 255) out.push_back(static_cast<std::uint8_t>(value >> 8));
}

void put_row(std::vector<std::uint8_t>& out, int width, std::span<const Run> runs, bool is_smooth) {
  put_number(out, width, 2 * runs.size() + is_smooth);
  std::uint32_t end = 0;
  for (const Run& run : runs) {
    put_number(out, width, run.begin - end);
    put_number(out, width, run.end - run.begin);
    end = run.end;
  }
}

// Widths of all blocks, then their residuals.
void put_planes(std::vector<std::uint8_t>& out, const Planes& planes) {
  constexpr std::array<Channel, 4> kOrder{kAlpha, kRed, kGreen, kBlue};
  const std::size_t blocks = block_count(planes[0].size()), at = out.size();
  out.resize(at + (12 * blocks + 7) / 8);
  for (std::size_t b = 0; b < blocks; ++b) {
    unsigned codes = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto block = block_of(planes[kOrder[k]], b);
      const unsigned code = block_code(block);
      codes |= code << (3 * k);
      std::uint64_t bits = 0;
      const unsigned width = kWidths[code];
      for (std::size_t i = 0; i < block.size(); ++i) {
        const std::uint64_t low = static_cast<std::uint8_t>(block[i]) & ((1u << width) - 1);
        bits |= width == 0 ? 0 : low << (i * width);
      }
      for (unsigned byte = 0; byte < width; ++byte)
        out.push_back(static_cast<std::uint8_t>(bits >> (8 * byte)));
    }
    codes <<= b % 2 * 4;
    out[at + b * 12 / 8] |= static_cast<std::uint8_t>(codes);
    out[at + b * 12 / 8 + 1] |= static_cast<std::uint8_t>(codes >> 8);
  }
}

}  // namespace

std::span<const std::uint8_t> FrameCodec::encode(const Image& image) {
  assert(image.width > 0 && image.width <= 65535 && image.height > 0);
  Planes planes;
  std::vector<std::uint8_t> rows;
  for (int y = 0; y < image.height; ++y) {
    const auto runs = find_runs(image, y);
    const Planes plain = predict_row(image, y, runs, false);
    const Planes smooth = predict_row(image, y, runs, true);
    const bool is_smooth = row_price(smooth) < row_price(plain);
    put_row(rows, image.width, runs, is_smooth);
    for (std::size_t c = 0; c < 4; ++c) {
      const Plane& best = is_smooth ? smooth[c] : plain[c];
      planes[c].insert(planes[c].end(), best.begin(), best.end());
    }
  }
  const Plane green = planes[kGreen], &alpha = planes[kAlpha];
  const auto of_red = decouple(planes[kRed], alpha, &green);
  const auto of_green = decouple(planes[kGreen], alpha, nullptr);
  const auto of_blue = decouple(planes[kBlue], alpha, &green);
  buffer_ = {kFrameForm, static_cast<std::uint8_t>(of_red), static_cast<std::uint8_t>(of_green),
             static_cast<std::uint8_t>(of_blue)};
  buffer_.insert(buffer_.end(), rows.begin(), rows.end());
  put_planes(buffer_, planes);
  return buffer_;
}

std::uint64_t hash_bytes(std::span<const std::uint8_t> bytes) noexcept {
  return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace vsprite::detail
