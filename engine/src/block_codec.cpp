// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The encoder follows what is usual for S3TC: the ends of a block's colours along their principal
// axis, then the ends that fit the chosen steps best in the sense of least squares, then a search
// about those; alphas likewise, by search alone.
#include "block_codec.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <initializer_list>
#include <utility>

#include "srgb_tables.h"

namespace vsprite::detail {
namespace {

constexpr int kTexels = 16;
using Plane = std::array<int, kTexels>;
struct Texels {
  std::array<Plane, 3> colour{};
  Plane alpha{};
};

// [alpha << 8 | encoded linear premultiplied light] -> the nearest premultiplied encoded value.
const std::array<std::uint8_t, 65536>& premultiplied_table() {
  static const auto table = [] {
    std::array<std::uint8_t, 65536> t{};
    for (std::size_t a = 1; a < 256; ++a) {
      std::size_t p = 0;
      const auto off = [&](std::size_t e, std::size_t value) {
        const int light = kPremultipliedLinear[a << 8 | value];
        return light > kLinear[e] ? light - kLinear[e] : kLinear[e] - light;
      };
      for (std::size_t e = 0; e < 256; ++e) {
        while (p < a && off(e, p + 1) <= off(e, p)) ++p;
        t[a << 8 | e] = static_cast<std::uint8_t>(p);
      }
    }
    return t;
  }();
  return table;
}

// ---- the steps between two ends ----

std::array<int, 8> alpha_steps(int first, int second) {
  std::array<int, 8> steps{first, second};
  if (first > second) {
    for (int k = 2; k < 8; ++k)
      steps[static_cast<std::size_t>(k)] = (first * (8 - k) + second * (k - 1)) / 7;
  } else {
    for (int k = 2; k < 6; ++k)
      steps[static_cast<std::size_t>(k)] = (first * (6 - k) + second * (k - 1)) / 5;
    steps[6] = 0;
    steps[7] = 255;
  }
  return steps;
}

struct Ends {
  std::array<std::array<int, 3>, 2> of{};  ///< red, green, blue in 5, 6, 5 bits
};
constexpr std::array<int, 3> kLargest{31, 63, 31};

int expand_bits(int value, std::size_t channel) {
  return channel == 1 ? value << 2 | value >> 4 : value << 3 | value >> 2;
}

using Colours = std::array<std::array<int, 4>, 3>;  // [channel][step]
Colours colour_steps(const Ends& ends) {
  Colours steps{};
  for (std::size_t c = 0; c < 3; ++c) {
    const int a = expand_bits(ends.of[0][c], c), b = expand_bits(ends.of[1][c], c);
    steps[c] = {a, b, (2 * a + b) / 3, (a + 2 * b) / 3};
  }
  return steps;
}

// ---- encoding ----

struct ColourFit {
  Ends ends;
  std::array<std::uint8_t, kTexels> steps{};
  int error = 0;
};

// The nearest step of every texel, and the sum of squares.
ColourFit fit_steps(const Texels& texels, const Ends& ends) {
  ColourFit fit{ends, {}, 0};
  const Colours colours = colour_steps(ends);
  Plane best, step{};
  best.fill(1 << 30);
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t t = 0; t < kTexels; ++t) {
      const int r = texels.colour[0][t] - colours[0][k], g = texels.colour[1][t] - colours[1][k],
                b = texels.colour[2][t] - colours[2][k];
      const int error = r * r + g * g + b * b;
      step[t] = error < best[t] ? static_cast<int>(k) : step[t];
      best[t] = std::min(best[t], error);
    }
  }
  for (std::size_t t = 0; t < kTexels; ++t) {
    fit.error += best[t];
    fit.steps[t] = static_cast<std::uint8_t>(step[t]);
  }
  return fit;
}

int quantise(float value, std::size_t channel) {
  const auto most = static_cast<float>(kLargest[channel]);
  return static_cast<int>(std::clamp(value / 255.0f * most + 0.5f, 0.0f, most));
}

// The outermost texels along the principal axis of the block's colours.
Ends principal_ends(const Texels& texels) {
  std::array<float, 3> mean{};
  for (std::size_t c = 0; c < 3; ++c) {
    int sum = 0;
    for (int v : texels.colour[c]) sum += v;
    mean[c] = static_cast<float>(sum) / kTexels;
  }
  std::array<std::array<float, 3>, 3> spread{};
  for (std::size_t t = 0; t < kTexels; ++t)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        spread[i][j] += (static_cast<float>(texels.colour[i][t]) - mean[i]) *
                        (static_cast<float>(texels.colour[j][t]) - mean[j]);
  std::size_t widest = 0;
  for (std::size_t c = 1; c < 3; ++c)
    if (spread[c][c] > spread[widest][widest]) widest = c;
  std::array<float, 3> axis = spread[widest];  // not orthogonal to the one that is sought
  for (int round = 0; round < 6; ++round) {
    std::array<float, 3> next{};
    float longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) next[i] += spread[i][j] * axis[j];
      longest = std::max(longest, std::max(next[i], -next[i]));
    }
    if (!(longest > 0)) break;
    for (float& value : next) value /= longest;
    axis = next;
  }
  std::size_t low = 0, high = 0;
  std::array<float, kTexels> along{};
  for (std::size_t t = 0; t < kTexels; ++t) {
    for (std::size_t c = 0; c < 3; ++c)
      along[t] += axis[c] * static_cast<float>(texels.colour[c][t]);
    if (along[t] < along[low]) low = t;
    if (along[t] > along[high]) high = t;
  }
  Ends ends;
  for (std::size_t c = 0; c < 3; ++c) {
    ends.of[0][c] = quantise(static_cast<float>(texels.colour[c][high]), c);
    ends.of[1][c] = quantise(static_cast<float>(texels.colour[c][low]), c);
  }
  return ends;
}

// The ends that come nearest to all texels with their steps as they are.
Ends least_squares_ends(const Texels& texels, const ColourFit& fit) {
  constexpr std::array<int, 4> kThirds{3, 0, 2, 1};  // share of the first end
  int aa = 0, ab = 0, bb = 0;
  std::array<int, 3> av{}, bv{};
  for (std::size_t t = 0; t < kTexels; ++t) {
    const int a = kThirds[fit.steps[t]], b = 3 - a;
    aa += a * a, ab += a * b, bb += b * b;
    for (std::size_t c = 0; c < 3; ++c) {
      av[c] += a * texels.colour[c][t];
      bv[c] += b * texels.colour[c][t];
    }
  }
  const int determinant = aa * bb - ab * ab;
  if (determinant == 0) return fit.ends;
  const float scale = 3.0f / static_cast<float>(determinant);
  Ends ends;
  for (std::size_t c = 0; c < 3; ++c) {
    ends.of[0][c] = quantise(static_cast<float>(av[c] * bb - bv[c] * ab) * scale, c);
    ends.of[1][c] = quantise(static_cast<float>(bv[c] * aa - av[c] * ab) * scale, c);
  }
  return ends;
}

// One step up or down of every number where that helps.
void search_about(const Texels& texels, ColourFit& fit) {
  for (std::size_t end = 0; end < 2; ++end) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (const int way : {-1, 1}) {
        Ends ends = fit.ends;
        ends.of[end][c] += way;
        if (ends.of[end][c] < 0 || ends.of[end][c] > kLargest[c] || fit.error == 0) continue;
        const ColourFit moved = fit_steps(texels, ends);
        if (moved.error < fit.error) fit = moved;
      }
    }
  }
}

void put_colours(const Texels& texels, std::uint8_t* out) {
  ColourFit fit = fit_steps(texels, principal_ends(texels));
  for (int round = 0; round < 3 && fit.error > 0; ++round) {
    const ColourFit next = fit_steps(texels, least_squares_ends(texels, fit));
    if (next.error >= fit.error) break;
    fit = next;
  }
  search_about(texels, fit);
  std::uint32_t steps = 0;
  for (std::size_t t = 0; t < kTexels; ++t) steps |= std::uint32_t{fit.steps[t]} << (2 * t);
  for (std::size_t end = 0; end < 2; ++end) {
    const auto& e = fit.ends.of[end];
    const int word = e[0] << 11 | e[1] << 5 | e[2];
    out[2 * end] = static_cast<std::uint8_t>(word);
    out[2 * end + 1] = static_cast<std::uint8_t>(word >> 8);
  }
  for (unsigned k = 0; k < 4; ++k) out[4 + k] = static_cast<std::uint8_t>(steps >> (8 * k));
}

struct AlphaFit {
  int first = 0, second = 0;
  int error = 0;
};

// What is clear or opaque has to stay so.
AlphaFit fit_alphas(const Plane& alpha, int first, int second) {
  constexpr int kForbidden = 1 << 24;
  AlphaFit fit{first, second, 0};
  Plane least;
  least.fill(1 << 20);
  for (const int step : alpha_steps(first, second)) {
    for (std::size_t t = 0; t < kTexels; ++t) {
      const int off = alpha[t] - step;
      least[t] = std::min(least[t], off * off);
    }
  }
  for (std::size_t t = 0; t < kTexels; ++t) {
    const bool is_end = alpha[t] == 0 || alpha[t] == 255;
    fit.error += is_end && least[t] != 0 ? kForbidden : least[t];
  }
  return fit;
}

// Ends nearer to the best ones, as long as the steps between them are of the same kind.
void search_alphas(const Plane& alpha, AlphaFit& best) {
  for (const int reach : {12, 5, 2, 1}) {
    for (const auto& [first, second] :
         {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, 1}, {1, -1}}) {
      const int a = best.first + reach * first, b = best.second + reach * second;
      if (best.error == 0 || (a > b) != (best.first > best.second)) continue;
      if (std::min(a, b) < 0 || std::max(a, b) > 255) continue;
      const AlphaFit moved = fit_alphas(alpha, a, b);
      if (moved.error < best.error) best = moved;
    }
  }
}

void put_alphas(const Plane& alpha, std::uint8_t* out) {
  const auto [low, high] = std::minmax_element(alpha.begin(), alpha.end());
  int inner_low = 255, inner_high = 0;  // of those between
  for (const int a : alpha) {
    if (a != 0) inner_low = std::min(inner_low, a);
    if (a != 255) inner_high = std::max(inner_high, a);
  }
  AlphaFit best = fit_alphas(alpha, *high, *low);
  search_alphas(alpha, best);
  if (best.error > 0 && inner_low <= inner_high) {
    AlphaFit other = fit_alphas(alpha, inner_low, inner_high);
    search_alphas(alpha, other);
    if (other.error < best.error) best = other;
  }
  const std::array<int, 8> steps = alpha_steps(best.first, best.second);
  std::uint64_t codes = 0;
  for (std::size_t t = 0; t < kTexels; ++t) {
    const auto off = [&](int step) { return (alpha[t] - step) * (alpha[t] - step); };
    const auto nearest =
        std::min_element(steps.begin(), steps.end(), [&](int x, int y) { return off(x) < off(y); });
    codes |= static_cast<std::uint64_t>(nearest - steps.begin()) << (3 * t);
  }
  out[0] = static_cast<std::uint8_t>(best.first);
  out[1] = static_cast<std::uint8_t>(best.second);
  for (unsigned k = 0; k < 6; ++k) out[2 + k] = static_cast<std::uint8_t>(codes >> (8 * k));
}

constexpr std::array<std::uint8_t, 8> kOpaque{255, 255};

void encode_block(const Texels& texels, std::uint8_t* out) {
  const auto is = [&](int value) {
    return std::all_of(texels.alpha.begin(), texels.alpha.end(), [=](int a) { return a == value; });
  };
  if (is(0)) return;  // zeros are there already
  if (is(255))
    std::copy(kOpaque.begin(), kOpaque.end(), out);
  else
    put_alphas(texels.alpha, out);
  put_colours(texels, out + 8);
}

// ---- decoding ----

std::uint64_t word_at(const std::uint8_t* bytes, unsigned count) {
  std::uint64_t word = 0;
  for (unsigned k = 0; k < count; ++k) word |= std::uint64_t{bytes[k]} << (8 * k);
  return word;
}

// The four colours, red lowest, without alpha.
std::array<std::uint32_t, 4> palette(const std::uint8_t* block) {
  Ends ends;
  for (std::size_t end = 0; end < 2; ++end) {
    const auto word = static_cast<int>(word_at(block + 8 + 2 * end, 2));
    ends.of[end] = {word >> 11, word >> 5 & 63, word & 31};
  }
  const Colours steps = colour_steps(ends);
  std::array<std::uint32_t, 4> colours{};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t c = 0; c < 3; ++c)
      colours[k] |= static_cast<std::uint32_t>(steps[c][k]) << (8 * c);
  return colours;
}

using Pixels = std::array<std::uint8_t, 4 * kTexels>;

void put_pixel(std::uint8_t* out, std::uint32_t pixel) {
  for (unsigned k = 0; k < 4; ++k) out[k] = static_cast<std::uint8_t>(pixel >> (8 * k));
}

void decode_block(const std::uint8_t* block, Pixels& out) {
  const std::array<std::uint32_t, 4> colours = palette(block);
  auto steps = static_cast<std::uint32_t>(word_at(block + 12, 4));
  if (std::equal(kOpaque.begin(), kOpaque.end(), block)) {
    for (std::size_t t = 0; t < kTexels; ++t, steps >>= 2)
      put_pixel(&out[4 * t], colours[steps & 3] | 0xFF000000u);
    return;
  }
  const std::array<int, 8> alphas = alpha_steps(block[0], block[1]);
  std::uint64_t alpha_codes = word_at(block + 2, 6);
  const auto& table = premultiplied_table();
  for (std::size_t t = 0; t < kTexels; ++t, steps >>= 2, alpha_codes >>= 3) {
    const auto alpha = static_cast<std::uint32_t>(alphas[alpha_codes & 7]);
    const std::uint8_t* row = &table[std::size_t{alpha} << 8];
    const std::uint32_t c = colours[steps & 3];
    put_pixel(&out[4 * t], row[c & 255] | std::uint32_t{row[c >> 8 & 255]} << 8 |
                               std::uint32_t{row[c >> 16 & 255]} << 16 | alpha << 24);
  }
}

bool is_clear(const std::uint8_t* block) {
  constexpr std::array<std::uint8_t, kBlockBytes> kZeros{};
  return std::memcmp(block, kZeros.data(), kBlockBytes) == 0;
}

}  // namespace

std::vector<std::uint8_t> encode_blocks(const Image& image) {
  const BlockGrid grid(image.width, image.height);
  std::vector<std::uint8_t> blocks(grid.count() * kBlockBytes);
  for (std::size_t b = 0; b < grid.count(); ++b) {
    Texels texels;
    const int left = 4 * static_cast<int>(b % grid.columns) - 1;
    const int top = 4 * static_cast<int>(b / grid.columns) - 1;
    for (int t = 0; t < kTexels; ++t) {
      const int x = left + t % 4, y = top + t / 4;
      if (x < 0 || y < 0 || x >= image.width || y >= image.height) continue;
      const std::uint8_t* p =
          &image.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                           static_cast<std::size_t>(x))];
      const auto at = static_cast<std::size_t>(t);
      texels.alpha[at] = p[3];
      for (std::size_t c = 0; c < 3; ++c)
        texels.colour[c][at] = kEncoded[kPremultipliedLinear[std::size_t{p[3]} << 8 | p[c]]];
    }
    encode_block(texels, &blocks[b * kBlockBytes]);
  }
  return blocks;
}

void decode_blocks(std::span<const std::uint8_t> blocks, int width, int height, Image& out) {
  const BlockGrid grid(width, height);
  out.width = width;
  out.height = height;
  out.rgba.assign(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  const std::size_t stride = 4 * static_cast<std::size_t>(width);
  for (std::size_t b = 0; b < grid.count(); ++b) {
    const std::uint8_t* block = &blocks[b * kBlockBytes];
    if (is_clear(block)) continue;
    Pixels pixels;
    decode_block(block, pixels);
    const int left = 4 * static_cast<int>(b % grid.columns) - 1;
    const int top = 4 * static_cast<int>(b / grid.columns) - 1;
    const int first = std::max(0, -left), last = std::min(4, width - left);
    for (int y = std::max(0, -top); y < std::min(4, height - top) && first < last; ++y) {
      std::uint8_t* to = &out.rgba[static_cast<std::size_t>(top + y) * stride +
                                   4 * static_cast<std::size_t>(left + first)];
      const std::uint8_t* from = &pixels[static_cast<std::size_t>(4 * (4 * y + first))];
      if (last - first == 4)
        std::memcpy(to, from, 16);
      else
        std::memcpy(to, from, 4 * static_cast<std::size_t>(last - first));
    }
  }
}

void BlockLoss::add(const Image& before, const Image& after) {
  for (std::size_t i = 0; i < before.rgba.size(); i += 4) {
    if ((before.rgba[i + 3] | after.rgba[i + 3]) == 0) continue;
    const auto square = [&](std::size_t c) {
      const int off = before.rgba[i + c] - after.rgba[i + c];
      return static_cast<std::uint64_t>(off * off);
    };
    ++pixels;
    colour += square(0) + square(1) + square(2);
    alpha += square(3);
  }
}

namespace {
enum Kind : unsigned { kClear, kSolid, kMixed };
constexpr std::array<std::size_t, 3> kKindBytes{0, 8, kBlockBytes};
}  // namespace

void squeeze_blocks(std::span<const std::uint8_t> blocks, std::vector<std::uint8_t>& out) {
  const std::size_t count = blocks.size() / kBlockBytes;
  out.assign(1 + (count + 3) / 4, 0);
  out[0] = kBlockForm;
  for (std::size_t b = 0; b < count; ++b) {
    const std::uint8_t* block = &blocks[b * kBlockBytes];
    const bool is_solid = std::equal(kOpaque.begin(), kOpaque.end(), block);
    const Kind kind = is_clear(block) ? kClear : is_solid ? kSolid : kMixed;
    out[1 + b / 4] |= static_cast<std::uint8_t>(kind << (2 * (b % 4)));
    out.insert(out.end(), block + kBlockBytes - kKindBytes[kind], block + kBlockBytes);
  }
}

bool unsqueeze_blocks(std::span<const std::uint8_t> bytes, int width, int height,
                      std::vector<std::uint8_t>& blocks) {
  const std::size_t count = BlockGrid(width, height).count(), head = 1 + (count + 3) / 4;
  if (bytes.size() < head || bytes[0] != kBlockForm) return false;
  const auto kind_of = [&](std::size_t b) { return bytes[1 + b / 4] >> (2 * (b % 4)) & 3u; };
  std::size_t due = head;
  for (std::size_t b = 0; b < count; ++b) {
    if (kind_of(b) > kMixed) return false;
    due += kKindBytes[kind_of(b)];
  }
  const bool is_padded = count % 4 == 0 || bytes[head - 1] >> (2 * (count % 4)) == 0;
  if (due != bytes.size() || !is_padded) return false;
  blocks.assign(count * kBlockBytes, 0);
  const std::uint8_t* from = bytes.data() + head;
  for (std::size_t b = 0; b < count; ++b) {
    std::uint8_t* block = &blocks[b * kBlockBytes];
    const unsigned kind = kind_of(b);
    if (kind == kClear) continue;
    if (kind == kSolid) std::copy(kOpaque.begin(), kOpaque.end(), block);
    std::memcpy(block + kBlockBytes - kKindBytes[kind], from, kKindBytes[kind]);
    from += kKindBytes[kind];
  }
  return true;
}

}  // namespace vsprite::detail
