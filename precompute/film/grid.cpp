// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The chroma grid and the map operations of the keyer: integers, or float sums in a fixed order.
#include "film/grid.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "film/color.h"
#include "film/lanes.h"

namespace vsprite::detail {

void make_grid(const Frame& frame, const Window& window, std::span<const Span> spans, Grid& grid) {
  grid.left = window.left;
  grid.top = window.top;
  grid.width = window.width;
  grid.height = window.height;
  for (auto& plane : grid.plane) plane.resize(grid.cells());
  const RgbOfYcc m = rgb_of_ycc(frame.coding);
  const auto stride = static_cast<std::size_t>(frame.width);
  const auto cell_stride = static_cast<std::size_t>(frame.cell_width());
  const int whole = std::min(window.width, frame.width / 2 - window.left);
  for (int y = 0; y < grid.height; ++y) {
    const Span span = spans[static_cast<std::size_t>(y)];
    const auto skipped = static_cast<std::size_t>(span.begin);
    const int pixel_row = 2 * (window.top + y);
    const std::uint8_t* top = frame.y.data() + static_cast<std::size_t>(pixel_row) * stride +
                              2 * static_cast<std::size_t>(window.left);
    const std::uint8_t* low = pixel_row + 1 < frame.height ? top + stride : top;
    const std::size_t from = static_cast<std::size_t>(window.top + y) * cell_stride +
                             static_cast<std::size_t>(window.left);
    const std::size_t to = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width);
    const auto out = [&](std::size_t p) { return grid.plane[p].data() + to; };
    lanes().sum_cells(m, top + 2 * skipped, low + 2 * skipped, frame.cb.data() + from + skipped,
                      frame.cr.data() + from + skipped, std::min(whole, span.end) - span.begin,
                      out(0) + skipped, out(1) + skipped, out(2) + skipped);
    for (int x = std::max(whole, span.begin); x < span.end; ++x) {
      const auto i = static_cast<std::size_t>(x);
      const auto rgb =
          m.sums(2 * (top[2 * x] + low[2 * x]), frame.cb[from + i], frame.cr[from + i], 4);
      for (std::size_t p = 0; p < 3; ++p) out(p)[x] = static_cast<std::uint16_t>(rgb[p]);
    }
  }
}

void make_grid(const Frame& frame, Grid& grid) {
  const Window all{0, 0, frame.cell_width(), frame.cell_height()};
  const std::vector<Span> spans(static_cast<std::size_t>(all.height), Span{0, all.width});
  make_grid(frame, all, spans, grid);
}

namespace {

// A mask with 64 cells a word, or its complement; cells behind the last are 0.
struct Bits {
  int width, height;
  std::size_t words;  // a row
  std::vector<std::uint64_t> in, next;

  std::uint64_t* row(std::vector<std::uint64_t>& of, int y) const {
    return of.data() + static_cast<std::size_t>(y) * words;
  }
};

// The vectors are a word longer than the rows: the lanes read ahead.
Bits pack(const Mask& mask, bool complement) {
  Bits bits{mask.width, mask.height, (static_cast<std::size_t>(mask.width) + 63) / 64, {}, {}};
  bits.in.resize(bits.words * static_cast<std::size_t>(mask.height) + 1);
  for (int y = 0; y < mask.height; ++y)
    lanes().pack_bits(mask.row(y), mask.width, complement, bits.row(bits.in, y));
  bits.next.resize(bits.in.size());
  return bits;
}

Mask unpack(const Bits& bits, bool complement) {
  Mask mask(bits.width, bits.height);
  for (int y = 0; y < mask.height; ++y)
    lanes().unpack_bits(bits.in.data() + static_cast<std::size_t>(y) * bits.words, mask.width,
                        complement, mask.row(y));
  return mask;
}

// Each cell with its neighbours to the left and right.
void widen_row(const std::uint64_t* in, std::size_t words, std::uint64_t* out) {
  for (std::size_t k = 0; k < words; ++k) {
    const std::uint64_t before = k > 0 ? in[k - 1] >> 63 : 0;
    const std::uint64_t behind = k + 1 < words ? in[k + 1] << 63 : 0;
    out[k] = in[k] | in[k] << 1 | in[k] >> 1 | before | behind;
  }
}

// Each cell of `next` with those of `in` that lie `steps` rows above and below.
void add_rows(Bits& bits, int steps) {
  const std::size_t apart = static_cast<std::size_t>(std::min(steps, bits.height)) * bits.words;
  const std::size_t all = static_cast<std::size_t>(bits.height) * bits.words;
  const std::uint64_t* in = bits.in.data();
  std::uint64_t* out = bits.next.data();
  for (std::size_t k = apart; k < all; ++k) out[k] |= in[k - apart];
  for (std::size_t k = apart; k < all; ++k) out[k - apart] |= in[k];
}

// Squares of 2 radius + 1.
void grow_square(Bits& bits, int radius) {
  for (int k = 0; k < radius; ++k) {
    for (int y = 0; y < bits.height; ++y)
      widen_row(bits.row(bits.in, y), bits.words, bits.row(bits.next, y));
    std::swap(bits.in, bits.next);
  }
  if (radius == 0) return;
  bits.next = bits.in;
  for (int k = 1; k <= radius; ++k) add_rows(bits, k);
  std::swap(bits.in, bits.next);
}

// One step to the four neighbours.
void grow_cross(Bits& bits) {
  for (int y = 0; y < bits.height; ++y)
    widen_row(bits.row(bits.in, y), bits.words, bits.row(bits.next, y));
  add_rows(bits, 1);
  std::swap(bits.in, bits.next);
}

// What is lost by shrinking is what the rest gains: outside counts as in.
Mask spread(const Mask& mask, int square, int crosses, bool larger) {
  Bits bits = pack(mask, !larger);
  grow_square(bits, square);
  for (int k = 0; k < crosses; ++k) grow_cross(bits);
  return unpack(bits, !larger);
}

void complement(Bits& bits) {
  const std::uint64_t last = ~std::uint64_t{0} >> (63 - (bits.width + 63) % 64);
  for (int y = 0; y < bits.height; ++y) {
    std::uint64_t* row = bits.row(bits.in, y);
    for (std::size_t k = 0; k < bits.words; ++k) row[k] = ~row[k];
    if (bits.words > 0) row[bits.words - 1] &= last;
  }
}

// Squares and crosses in the proportion that makes an octagon.
Mask spread_disc(const Mask& mask, int radius, bool larger) {
  const int square = (5 * radius + 6) / 12;
  return spread(mask, square, radius - square, larger);
}

// A running sum in double, so that what leaves the box leaves nothing behind.
void blur_rows(const float* in, float* out, int width, int height, int radius) {
  const float scale = 1.0f / static_cast<float>(2 * radius + 1);
  for (int y = 0; y < height; ++y, in += width, out += width) {
    double sum = 0;
    for (int x = 0; x < std::min(radius, width); ++x) sum += static_cast<double>(in[x]);
    for (int x = 0; x < width; ++x) {
      if (x + radius < width) sum += static_cast<double>(in[x + radius]);
      if (x - radius - 1 >= 0) sum -= static_cast<double>(in[x - radius - 1]);
      out[x] = static_cast<float>(sum) * scale;
    }
  }
}

void blur_columns(const float* in, float* out, int width, int height, int radius) {
  const float scale = 1.0f / static_cast<float>(2 * radius + 1);
  std::vector<double> sums(static_cast<std::size_t>(width), 0.0);
  const auto row = [&](int y) { return in + static_cast<std::ptrdiff_t>(y) * width; };
  for (int y = 0; y < std::min(radius, height); ++y)
    for (int x = 0; x < width; ++x)
      sums[static_cast<std::size_t>(x)] += static_cast<double>(row(y)[x]);
  for (int y = 0; y < height; ++y, out += width) {
    if (y + radius < height)
      for (int x = 0; x < width; ++x)
        sums[static_cast<std::size_t>(x)] += static_cast<double>(row(y + radius)[x]);
    if (y - radius - 1 >= 0)
      for (int x = 0; x < width; ++x)
        sums[static_cast<std::size_t>(x)] -= static_cast<double>(row(y - radius - 1)[x]);
    for (int x = 0; x < width; ++x)
      out[x] = static_cast<float>(sums[static_cast<std::size_t>(x)]) * scale;
  }
}

}  // namespace

Mask dilate(const Mask& mask, int radius) { return spread(mask, radius, 0, true); }
Mask erode(const Mask& mask, int radius) { return spread(mask, radius, 0, false); }
Mask reshape(const Mask& mask, std::initializer_list<int> radii) {
  Bits bits = pack(mask, false);
  for (const int radius : radii) {
    if (radius < 0) complement(bits);
    grow_square(bits, std::abs(radius));
    if (radius < 0) complement(bits);
  }
  return unpack(bits, false);
}
Mask dilate_disc(const Mask& mask, int radius) { return spread_disc(mask, radius, true); }
Mask erode_disc(const Mask& mask, int radius) { return spread_disc(mask, radius, false); }

Mask grow_into(const Mask& room, const Mask& mask, int steps) {
  const Bits open = pack(room, false);
  Bits bits = pack(mask, false);
  for (int step = 0; step < steps; ++step) {
    const std::vector<std::uint64_t> before = bits.in;
    grow_square(bits, 1);
    for (std::size_t k = 0; k < bits.in.size(); ++k)
      bits.in[k] = (bits.in[k] & open.in[k]) | before[k];
    if (bits.in == before) break;
  }
  return unpack(bits, false);
}

void blur(std::vector<float>& plane, int width, int height, int radius, int passes,
          std::vector<float>& scratch) {
  scratch.resize(plane.size());
  for (int pass = 0; pass < passes; ++pass) {
    blur_rows(plane.data(), scratch.data(), width, height, radius);
    blur_columns(scratch.data(), plane.data(), width, height, radius);
  }
}

void spans_of(const Mask& mask, int reach, std::vector<Span>& spans) {
  spans.assign(static_cast<std::size_t>(mask.height), {});
  for (int y = 0; y < mask.height; ++y) {
    const std::uint8_t* row = mask.row(y);
    const auto width = static_cast<std::size_t>(mask.width);
    const void* first = std::memchr(row, 1, width);
    if (!first) continue;
    const int begin = static_cast<int>(static_cast<const std::uint8_t*>(first) - row);
    int end = mask.width;
    while (!row[end - 1]) --end;
    const Span wide{std::max(begin - reach, 0), std::min(end + reach, mask.width)};
    for (int v = std::max(y - reach, 0); v <= std::min(y + reach, mask.height - 1); ++v) {
      Span& span = spans[static_cast<std::size_t>(v)];
      span =
          span.size() ? Span{std::min(span.begin, wide.begin), std::max(span.end, wide.end)} : wide;
    }
  }
}

namespace {

struct Run {
  int begin, end, part;
};

int root_of(std::vector<int>& parent, int part) {
  while (parent[static_cast<std::size_t>(part)] != part) {
    auto& up = parent[static_cast<std::size_t>(part)];
    up = parent[static_cast<std::size_t>(up)];
    part = up;
  }
  return part;
}

// Adds the runs of a row; those that touch one of the row above, `first` to `last` of the runs,
// corners too, are of its part.
void join_row(const std::uint8_t* in, int width, std::size_t first, std::size_t last,
              std::vector<Run>& runs, std::vector<int>& parent) {
  for (int x = 0; x < width;) {
    const auto left = static_cast<std::size_t>(width - x);
    const void* found = std::memchr(in + x, 1, left);
    if (!found) return;
    const int begin = static_cast<int>(static_cast<const std::uint8_t*>(found) - in);
    const void* out = std::memchr(in + begin, 0, static_cast<std::size_t>(width - begin));
    const int end = out ? static_cast<int>(static_cast<const std::uint8_t*>(out) - in) : width;
    int part = -1;
    while (first < last && runs[first].end < begin) ++first;
    for (std::size_t k = first; k < last && runs[k].begin <= end; ++k) {
      const int other = root_of(parent, runs[k].part);
      if (part < 0) {
        part = other;
      } else if (other != part) {
        parent[static_cast<std::size_t>(std::max(part, other))] = std::min(part, other);
        part = std::min(part, other);
      }
    }
    if (part < 0) {
      part = static_cast<int>(parent.size());
      parent.push_back(part);
    }
    runs.push_back({begin, end, part});
    x = end;
  }
}

}  // namespace

int connected_parts(const Mask& mask, std::vector<int>& labels) {
  labels.assign(mask.in.size(), 0);
  std::vector<int> parent{0};
  std::vector<Run> runs;
  std::vector<std::size_t> ends;  // of each row's runs
  for (int y = 0; y < mask.height; ++y) {
    const std::size_t last = runs.size();
    join_row(mask.row(y), mask.width, y > 1 ? ends[static_cast<std::size_t>(y) - 2] : 0, last, runs,
             parent);
    ends.push_back(runs.size());
  }
  std::vector<int> number(parent.size());
  int count = 0;
  for (std::size_t part = 1; part < parent.size(); ++part)
    number[part] = parent[part] == static_cast<int>(part)
                       ? ++count
                       : number[static_cast<std::size_t>(root_of(parent, static_cast<int>(part)))];
  std::size_t k = 0;
  for (std::size_t y = 0; y < ends.size(); ++y)
    for (; k < ends[y]; ++k) {
      int* row = labels.data() + y * static_cast<std::size_t>(mask.width);
      std::fill(row + runs[k].begin, row + runs[k].end,
                number[static_cast<std::size_t>(runs[k].part)]);
    }
  return count;
}

}  // namespace vsprite::detail
