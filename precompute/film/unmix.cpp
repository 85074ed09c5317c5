// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Seeds, local foreground, projection. Colour-difference keys after Vlahos; the foreground's local
// Gaussian after Chuang et al., "A Bayesian Approach to Digital Matting" (2001), but solved in
// closed form along the line from the known plate, without search.
#include "film/unmix.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "film/light.h"

namespace vsprite::detail {
namespace {

constexpr int kMargin = 4;              // cells around the silhouette
constexpr int kReach = 2;               // cells around the region that are looked at
constexpr float kSpill = 0.05f;         // share of the plate in a foreground near it, and at the
constexpr float kRimSpill = 0.08f;      // rim, where screen light falls from behind
constexpr float kFarWeight = 0.02f;     // of the wide neighbourhood against the near one
constexpr float kGlobalWeight = 1e-4f;  // of the whole patch
constexpr float kUnexplained = 12;      // residual of what no mixture explains
constexpr float kCovered = 0.8f;        // share of the screen that is gone where that is opaque
constexpr std::size_t kRoom = 16;       // cells behind the last

// sigma_n in linear light of `codes` code values at each sum of four.
std::vector<float> noise_of_sums(float codes) {
  const auto& light = linear_of_sums();
  std::vector<float> noise(light.size());
  for (std::size_t s = 0; s < noise.size(); ++s) {
    const std::size_t above = std::min(s + 4, noise.size() - 1);
    const std::size_t below = s > 4 ? s - 4 : 0;
    noise[s] = codes * 4 * (light[above] - light[below]) / static_cast<float>(above - below);
  }
  return noise;
}

struct Pointers {
  float* at[3];
  explicit Pointers(std::vector<float> (&planes)[3], std::size_t offset = 0)
      : at{planes[0].data() + offset, planes[1].data() + offset, planes[2].data() + offset} {}
};
struct ConstPointers {
  const float* at[3];
  explicit ConstPointers(const std::vector<float> (&planes)[3], std::size_t offset = 0)
      : at{planes[0].data() + offset, planes[1].data() + offset, planes[2].data() + offset} {}
};

// The largest in a square of (2 radius + 1)^2.
std::vector<float> largest_around(const std::vector<float>& plane, int width, int height,
                                  int radius) {
  const auto w = static_cast<std::size_t>(width);
  std::vector<float> rows = plane;
  for (int y = 0; y < height; ++y)
    for (int k = 1; k <= radius; ++k) {
      const float* in = plane.data() + static_cast<std::size_t>(y) * w;
      float* out = rows.data() + static_cast<std::size_t>(y) * w;
      for (int x = k; x < width; ++x) out[x] = std::max(out[x], in[x - k]);
      for (int x = 0; x + k < width; ++x) out[x] = std::max(out[x], in[x + k]);
    }
  std::vector<float> both = rows;
  for (int y = 0; y < height; ++y)
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, height - 1); ++v) {
      const float* in = rows.data() + static_cast<std::size_t>(v) * w;
      float* out = both.data() + static_cast<std::size_t>(y) * w;
      for (int x = 0; x < width; ++x) out[x] = std::max(out[x], in[x]);
    }
  return both;
}

// Means over 3 x 3 of the spans.
void blur_spans(const Patch& patch, const std::vector<float>& in, std::vector<float>& out) {
  const std::vector<float> zeros(static_cast<std::size_t>(patch.width));
  for (int y = 0; y < patch.height; ++y)
    if (const Span span = patch.spans[static_cast<std::size_t>(y)]; span.size())
      lanes().blur3(rows_around(in, patch.width, patch.height, y, zeros), patch.width, span.begin,
                    span.end, out.data() + static_cast<std::ptrdiff_t>(y) * patch.width);
}

// Evidence of coverage before any foreground is known: v, or the distance to the plate against its
// largest nearby; and the smallest alpha for which F lies in the gamut.
void gather_evidence(const ScreenModel& screen, Patch& patch) {
  const std::size_t n = patch.cells();
  patch.bound.resize(n + kRoom);
  if (screen.key < 0)
    patch.key.assign(n + kRoom, 0);
  else
    patch.key.resize(n + kRoom);
  const KeyShape shape = shape_of(screen.key);
  each_span(patch, [&](std::size_t at, std::size_t count) {
    const ConstPointers frame(patch.frame, at);
    const ConstPointers plate(patch.plate, at);
    const ConstPointers noise(patch.noise, at);
    lanes().gamut_bound(frame.at, plate.at, noise.at, count, patch.bound.data() + at);
    if (screen.key >= 0)
      lanes().key_share(frame.at, plate.at, shape, count, patch.key.data() + at);
    else
      lanes().distance(frame.at, plate.at, count, patch.key.data() + at);
  });
  if (screen.key >= 0) return;
  for (std::size_t i = 0; i < n; ++i)
    if (!patch.region.in[i]) patch.key[i] = 0;
  // Fur that leaves a third of a white screen in sight stands out as much as a whole animal does
  // before black: the film says how much is all. Before a plate of any texture it cannot.
  // Before a plain one what is much fainter than that is translucent, however wide: a fly's wings.
  const bool plain = screen.kind == KeyKind::Color;
  const float usual = plain ? std::max(screen.key_normaliser, 0.3f) : 0.3f;
  const float least = plain ? 0.4f * usual : 0.02f;
  const float gain = plain ? 1.0f : 1.25f;
  const std::vector<float> most = largest_around(patch.key, patch.width, patch.height, 4);
  for (std::size_t i = 0; i < n; ++i) patch.key[i] *= gain / std::clamp(most[i], least, usual);
}

// The pointer is a local one: bytes may alias the vector's own.
Mask outside_of(Mask mask) {
  std::uint8_t* in = mask.in.data();
  for (std::size_t i = 0, n = mask.in.size(); i < n; ++i) in[i] ^= 1;
  return mask;
}

// Holes are filled unless a cell of theirs looks like screen.
void fill_holes(const Patch& patch, Mask& seeds) {
  const Mask rest = outside_of(seeds);
  std::vector<int> labels;
  const int parts = connected_parts(rest, labels);
  std::vector<std::uint8_t> open(static_cast<std::size_t>(parts) + 1);
  open[0] = 1;
  int closed = parts;
  for (int y = 0; y < rest.height && closed > 0; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(rest.width);
    const bool edge = y == 0 || y == rest.height - 1;
    for (int x = 0; x < rest.width; ++x) {
      const std::size_t i = row + static_cast<std::size_t>(x);
      std::uint8_t& state = open[static_cast<std::size_t>(labels[i])];
      if (state) continue;
      const bool like = !patch.region.in[i] || (patch.key[i] < 0.35f && patch.bound[i] < 0.5f);
      if (!edge && x > 0 && x < rest.width - 1 && !like) continue;
      state = 1;
      --closed;
    }
  }
  if (closed == 0) return;
  for (std::size_t i = 0; i < rest.in.size(); ++i)
    if (!open[static_cast<std::size_t>(labels[i])]) seeds.in[i] = 1;
}

// A standing plate of any texture says nothing of translucence: what stands out, two cells inside,
// is opaque; and all of what was cut out.
void add_inside(const ScreenModel& screen, const Patch& patch, Mask& seeds) {
  Mask strong = patch.core;
  if (screen.subject_cost.empty()) {
    lanes().above(patch.contrast.data(), 2 * screen.threshold, strong.in.size(), strong.in.data());
    lanes().spread_into(patch.core.in.data(), strong.in.size(), false, strong.in.data());
  }
  const Mask inside = erode(strong, 2);
  lanes().spread_into(inside.in.data(), seeds.in.size(), true, seeds.in.data());
}

// A veil moves its screen one way, towards its own colour. What is lighter than a grey screen close
// to what is darker, folds of a cloth or a white bird's grey wings, is opaque, and so is what lies
// between them and can be as grey as the screen.
void add_two_sided(const Patch& patch, Mask& sure) {
  constexpr float kBeyond = 2;      // noise
  constexpr float kShade = 0.5f;    // a cast shadow leaves more of the light,
  constexpr float kTinted = 0.88f;  // and about as much of every channel
  constexpr int kClose = 8;         // cells
  constexpr int kDeep = 4;          // cells inside the region
  Mask lighter(patch.width, patch.height);
  Mask darker(patch.width, patch.height);
  each_span(patch, [&](std::size_t at, std::size_t count) {
    const ConstPointers frame(patch.frame, at);
    const ConstPointers plate(patch.plate, at);
    const ConstPointers noise(patch.noise, at);
    const auto sum = [](const ConstPointers& of, std::size_t i) {
      return of.at[0][i] + of.at[1][i] + of.at[2][i];
    };
    const auto like_shade = [](const ConstPointers& c, const ConstPointers& b, std::size_t i) {
      float least_left = 1;
      float most_left = 0;
      for (int p = 0; p < 3; ++p) {
        const float left = c.at[p][i] / std::max(b.at[p][i], 1e-4f);
        least_left = std::min(least_left, left);
        most_left = std::max(most_left, left);
      }
      return most_left > kShade && least_left > kTinted * most_left;
    };
    for (std::size_t i = 0; i < count; ++i) {
      if (!patch.region.in[at + i]) continue;
      const float away = sum(frame, i) - sum(plate, i);
      const float least = kBeyond * sum(noise, i);
      lighter.in[at + i] = away > least ? 1 : 0;
      darker.in[at + i] = away < -least && !like_shade(frame, plate, i) ? 1 : 0;
    }
  });
  Mask both = reshape(lighter, {-1, 1 + kClose});
  for (const Mask& with : {reshape(darker, {-1, 1 + kClose}), erode_disc(patch.region, kDeep)})
    lanes().spread_into(with.in.data(), both.in.size(), false, both.in.data());
  lanes().spread_into(both.in.data(), both.in.size(), true, sure.in.data());
}

void find_seeds(const ScreenModel& screen, Patch& patch) {
  const std::size_t n = patch.cells();
  // Deep inside less is enough, but not of a subject that is much stronger than the key or, before
  // a plain screen, has only its own strength to go by: there half of it is a translucent fin.
  const bool own_strength = screen.key < 0 && screen.kind == KeyKind::Color;
  const float enough = own_strength || screen.key_normaliser > 1.5f ? 0.8f : 0.5f;
  Mask sure(patch.width, patch.height);
  Mask likely(patch.width, patch.height);
  const float inverse = screen.key >= 0 ? 1 / screen.key_normaliser : 1.0f;
  each_span(patch, [&](std::size_t at, std::size_t count) {
    lanes().score({patch.key.data() + at, patch.bound.data() + at, patch.region.in.data() + at,
                   inverse, 0.85f, enough},
                  count, sure.in.data() + at, likely.in.data() + at);
  });
  if (own_strength) add_two_sided(patch, sure);
  patch.seeds = reshape(sure, {1, -2});
  if (screen.kind == KeyKind::Plate) add_inside(screen, patch, patch.seeds);
  Mask deep = erode_disc(patch.region, 5);
  const Mask all_likely = erode(likely, 2);
  lanes().spread_into(all_likely.in.data(), n, false, deep.in.data());
  lanes().spread_into(deep.in.data(), n, true, patch.seeds.in.data());
  fill_holes(patch, patch.seeds);
}

// A row of ten moments of `width` squares; each is followed by zeros, kEdge at least.
struct MomentRows {
  static constexpr int kEdge = 4;
  int width, height;
  std::size_t stride;  // from a moment to the next
  std::size_t all() const { return kMoments * stride; }
  std::size_t at(int y) const { return kEdge + static_cast<std::size_t>(y) * all(); }
  std::size_t size() const { return at(height) + kEdge; }
};

MomentRows near_rows(const Patch& patch) {
  const int w = (patch.width + 1) / 2;
  const auto stride = (static_cast<std::size_t>(w + MomentRows::kEdge) + 31) / 32 * 32;
  return {w, (patch.height + 1) / 2, stride};
}
// Of 4 x 4 cells; a moment's place in a row is half of that in the row of 2 x 2.
MomentRows wide_rows(const MomentRows& near) {
  return {(near.width + 1) / 2, (near.height + 1) / 2, near.stride / 2};
}

void clear_gaps(const MomentRows& rows, float* row) {
  for (std::size_t k = 0; k < kMoments; ++k)
    std::fill(row + k * rows.stride + rows.width, row + (k + 1) * rows.stride, 0.0f);
}

// Sums over 5 x 5, three times.
void blur_wide(const MomentRows& rows, std::vector<float>& plane, std::vector<float>& scratch) {
  constexpr float kFifth = 1.0f / 5;
  scratch.resize(rows.size() + 4 * rows.all());  // two rows of zeros on both sides
  std::fill_n(scratch.begin(), rows.at(2), 0.0f);
  std::fill(scratch.begin() + static_cast<std::ptrdiff_t>(rows.at(rows.height + 2)), scratch.end(),
            0.0f);
  for (int pass = 0; pass < 3; ++pass) {
    for (int y = 0; y < rows.height; ++y) {
      float* out = scratch.data() + rows.at(y + 2);
      lanes().sum5(plane.data() + rows.at(y), 1, rows.all(), kFifth, out);
      clear_gaps(rows, out);
    }
    for (int y = 0; y < rows.height; ++y)
      lanes().sum5(scratch.data() + rows.at(y + 2), static_cast<std::ptrdiff_t>(rows.all()),
                   rows.all(), kFifth, plane.data() + rows.at(y));
  }
}

// The squares of row y that are read when rows of cells are doubled from it and its neighbours.
Span squares_read(const Patch& patch, const MomentRows& near, int y) {
  Span all{near.width, 0};
  for (int row = std::max(2 * y - 1, 0); row < std::min(2 * y + 3, patch.height); ++row)
    if (const Span span = patch.spans[static_cast<std::size_t>(row)]; span.size())
      all = {std::min(all.begin, std::max(span.begin / 2 - 1, 0)),
             std::max(all.end, std::min((span.end + 1) / 2 + 1, near.width))};
  return all;
}
// Of all three rows that a mean at one of those is made of.
Span squares_blurred(const Patch& patch, const MomentRows& near, int y) {
  Span all{near.width, 0};
  for (int row = y - 1; row <= y + 1; ++row)
    if (const Span span = squares_read(patch, near, row); span.size())
      all = {std::min(all.begin, span.begin), std::max(all.end, span.end)};
  return all;
}

// The moments of the cells, in squares of 2 x 2; about them zeros as far as they are looked at.
void fill_near(Patch& patch, const MomentRows& near, const std::vector<float>& weight,
               const std::vector<float> (&color)[3]) {
  patch.near.resize(near.size() + near.all());  // a row of zeros below
  for (int y = 0; y <= near.height; ++y) {
    float* row = patch.near.data() + near.at(y);
    if (const Span clear = squares_blurred(patch, near, y); clear.size())
      for (std::size_t k = 0; k < kMoments; ++k)
        std::fill_n(row + k * near.stride + clear.begin - 1, clear.size() + 2, 0.0f);
    if (y == near.height) break;
    const bool both = 2 * y + 1 < patch.height;
    const Span upper = patch.spans[static_cast<std::size_t>(2 * y)];
    const Span lower = both ? patch.spans[static_cast<std::size_t>(2 * y + 1)] : Span{};
    Span span = upper.size() ? upper : lower;
    if (upper.size() && lower.size())
      span = {std::min(upper.begin, lower.begin), std::max(upper.end, lower.end)};
    if (span.size() == 0) continue;
    span.begin &= ~1;
    const auto skipped = static_cast<std::size_t>(span.begin);
    const auto top =
        static_cast<std::size_t>(2 * y) * static_cast<std::size_t>(patch.width) + skipped;
    const auto low = both ? top + static_cast<std::size_t>(patch.width) : top;
    float* out[kMoments];
    for (std::size_t k = 0; k < kMoments; ++k) out[k] = row + k * near.stride + skipped / 2;
    const ConstPointers first(color, top);
    const ConstPointers second(color, low);
    lanes().moments(weight.data() + top, both ? weight.data() + low : nullptr, first.at, second.at,
                    span.size(), out);
  }
}

// Weighted sums of 1, the three channels and their six products under a near window (sigma about 2
// cells, kept in squares of 2 x 2) and a wide one (sigma about 10, in squares of 4 x 4), with a
// trace of the whole patch. Filled are the squares that are read.
void gather_moments(Patch& patch, const std::vector<float>& weight,
                    const std::vector<float> (&color)[3]) {
  const Lanes& run = lanes();
  const MomentRows near = near_rows(patch);
  const MomentRows wide = wide_rows(near);
  fill_near(patch, near, weight, color);
  patch.wide.assign(wide.size(), 0.0f);
  // Of the whole patch; ten sums at a time, each in its own order.
  double all[kMoments] = {};
  for (int y = 0; y < wide.height; ++y) {
    Span span = squares_read(patch, near, 2 * y);
    if (const Span low = squares_read(patch, near, 2 * y + 1); low.size())
      span = {std::min(span.begin, low.begin), std::max(span.end, low.end)};
    if (span.size() == 0) continue;
    const auto first = static_cast<std::size_t>(span.begin / 2);
    const auto count = static_cast<std::size_t>((span.end + 1) / 2) - first;
    const float* in = patch.near.data() + near.at(2 * y) + 2 * first;
    float* out = patch.wide.data() + wide.at(y) + first;
    for (std::size_t k = 0; k < kMoments; ++k)
      run.halve(in + k * near.stride, in + near.all() + k * near.stride, static_cast<int>(count),
                out + k * wide.stride);
    for (std::size_t x = 0; x < count; ++x)
      for (std::size_t k = 0; k < kMoments; ++k)
        all[k] += static_cast<double>(out[k * wide.stride + x]);
  }
  blur_wide(wide, patch.wide, patch.scratch);
  // near + far wide + whole; the rows of the near sums are blurred when all three are there.
  std::vector<float>& sums = patch.scratch;
  sums.assign(3 * near.all(), 0.0f);
  const auto row_of_sums = [&](int y) {
    return sums.data() + static_cast<std::size_t>((y + 3) % 3) * near.all();
  };
  const auto add_up = [&](int y) {
    const Span span = squares_blurred(patch, near, y);
    const float* in = patch.near.data() + near.at(y) + span.begin;
    for (std::size_t k = 0; k < kMoments && span.size(); ++k)
      run.sum3(in + k * near.stride, static_cast<std::size_t>(span.size()),
               row_of_sums(y) + k * near.stride + span.begin);
  };
  patch.far.resize(2 * wide.stride);
  float* const far = patch.far.data();
  add_up(0);
  for (int y = 0; y < near.height; ++y) {
    add_up(y + 1);
    const Span span = squares_read(patch, near, y);
    if (span.size() == 0) continue;
    const int second = std::min(std::max(y % 2 ? y / 2 + 1 : y / 2 - 1, 0), wide.height - 1);
    const int from = std::max(span.begin / 2 - 1, 0);
    const int count = std::min((span.end + 1) / 2 + 1, wide.width) - from;
    for (std::size_t k = 0; k < kMoments; ++k) {
      const std::size_t at = k * wide.stride + static_cast<std::size_t>(from);
      run.double_row(patch.wide.data() + wide.at(y / 2) + at, 0.75f * kFarWeight,
                     patch.wide.data() + wide.at(second) + at, 0.25f * kFarWeight, count,
                     far + 2 * from);
      const std::size_t to = k * near.stride + static_cast<std::size_t>(span.begin);
      run.add_far(row_of_sums(y - 1) + to, row_of_sums(y) + to, row_of_sums(y + 1) + to,
                  far + span.begin, kGlobalWeight * static_cast<float>(all[k]), span.size(),
                  patch.near.data() + near.at(y) + to);
    }
  }
}

// Calls `with(begin, end)` for the runs of what is not 0; those less than a few blocks of lanes
// apart are one.
template <class With>
void each_run(const std::uint8_t* in, Span span, With with) {
  constexpr int kApart = 32;
  const auto nothing = [&](int x) {  // in eight cells, within the span
    std::uint64_t word;
    std::memcpy(&word, in + x, sizeof word);
    return word == 0;
  };
  for (int x = span.begin; x < span.end;) {
    if (!in[x]) {
      x += x + 8 <= span.end && nothing(x) ? 8 : 1;
      continue;
    }
    int end = x + 1;
    for (int next = end; next < span.end && next - end < kApart;) {
      if (next + 8 <= span.end && nothing(next)) {
        next += 8;
        continue;
      }
      if (in[next]) end = next + 1;
      ++next;
    }
    with(x, end);
    x = end;
  }
}

// Alpha and mean of what is not sure; `means`: the cells whose mean the despill wants too.
void solve_alpha(Patch& patch, float spill, const Mask* means) {
  const Lanes& run = lanes();
  const MomentRows near = near_rows(patch);
  const auto width = static_cast<std::size_t>(patch.width);
  patch.mode.assign(width + 2 * kRoom, 0);
  patch.open.clear();
  // Room for a block of lanes behind the last cell.
  const std::size_t stride = 2 * near.stride + kRoom;
  patch.rows.resize(kMoments * stride);
  ProjectionRow row{};
  row.mode = patch.mode.data();
  for (std::size_t k = 0; k < kMoments; ++k) row.moment[k] = patch.rows.data() + k * stride;
  for (int y = 0; y < patch.height; ++y) {
    const Span span = patch.spans[static_cast<std::size_t>(y)];
    if (span.size() == 0) continue;
    const std::size_t at = static_cast<std::size_t>(y) * width;
    float* alpha = patch.alpha.data() + at;
    std::fill_n(patch.residual.data() + at + span.begin, span.size(), 0.0f);
    // Blocks of lanes reach over the span's ends.
    const int before = std::min(span.begin, static_cast<int>(kRoom));
    std::fill_n(patch.mode.begin() + span.begin - before, before, std::uint8_t{0});
    std::fill_n(patch.mode.begin() + span.end, kRoom, std::uint8_t{0});
    const auto skipped = static_cast<std::size_t>(span.begin);
    if (!run.modes(patch.seeds.row(y) + skipped, patch.region.row(y) + skipped,
                   means ? means->row(y) + skipped : nullptr, static_cast<std::size_t>(span.size()),
                   patch.mode.data() + skipped, alpha + skipped))
      continue;
    const int second = std::min(std::max(y % 2 ? y / 2 + 1 : y / 2 - 1, 0), near.height - 1);
    const float* first_row = patch.near.data() + near.at(y / 2);
    const float* second_row = patch.near.data() + near.at(second);
    for (int p = 0; p < 3; ++p) {
      row.frame[p] = patch.frame[p].data() + at;
      row.plate[p] = patch.plate[p].data() + at;
      row.noise[p] = patch.noise[p].data() + at;
      row.mean[p] = patch.mean[p].data() + at;
    }
    row.bound = patch.bound.data() + at;
    row.alpha = alpha;
    row.residual = patch.residual.data() + at;
    each_run(patch.mode.data(), span, [&](int begin, int end) {
      // The run's squares and those beside them.
      const int from = std::max(begin / 2 - 1, 0);
      const int count = std::min((end + 1) / 2 + 1, near.width) - from;
      for (std::size_t k = 0; k < kMoments; ++k)
        run.double_row(first_row + k * near.stride + from, 0.75f,
                       second_row + k * near.stride + from, 0.25f, count,
                       patch.rows.data() + k * stride + 2 * from);
      run.project(row, spill, begin, end, patch.width);
      patch.open.push_back({y, {begin, end}});
    });
  }
}

// Clear wings, lace or smoke beside a coloured body are no mixture with its colour: what takes from
// the screen's alone explains them better. Over some width, for rims are full of errors; and what
// has lost most of the screen may be a seed yet.
void allow_colorless(Patch& patch) {
  constexpr int kWide = 2;                   // cells to all sides
  std::vector<float>& alpha = patch.weight;  // both are made anew for their own uses
  std::vector<float>& share = patch.soft;
  share.resize(patch.cells() + kRoom);
  Mask wide(patch.width, patch.height);
  const Lanes& run = lanes();
  const auto first_of = [&](const RowSpan& row) {
    return static_cast<std::size_t>(row.y) * static_cast<std::size_t>(patch.width) +
           static_cast<std::size_t>(row.span.begin);
  };
  for (const RowSpan& row : patch.open) {
    const std::size_t at = first_of(row);
    const auto count = static_cast<std::size_t>(row.span.size());
    const ConstPointers frame(patch.frame, at);
    const ConstPointers plate(patch.plate, at);
    const ConstPointers noise(patch.noise, at);
    const ConstPointers mean(patch.mean, at);
    run.colorless(frame.at, plate.at, noise.at, mean.at, patch.bound.data() + at,
                  patch.residual.data() + at, kCovered, count, alpha.data() + at,
                  share.data() + at);
    run.above(share.data() + at, 0, count, wide.in.data() + at);
  }
  wide = reshape(wide, {-kWide, kWide});
  for (const RowSpan& row : patch.open) {
    const std::size_t at = first_of(row);
    for (std::size_t i = at; i < at + static_cast<std::size_t>(row.span.size()); ++i)
      if (wide.in[i]) {
        patch.alpha[i] += share[i] * (alpha[i] - patch.alpha[i]);
        patch.residual[i] *= 1 - share[i];
      }
  }
}

// What no mixture explains, with all its neighbours, is another part of the subject: surely if most
// of the screen is gone about there. A veil of another colour leaves it in sight.
bool add_unexplained(Patch& patch) {
  const std::size_t n = patch.cells();
  Mask odd(patch.width, patch.height);
  each_span(patch, [&](std::size_t at, std::size_t count) {
    lanes().above(patch.residual.data() + at, kUnexplained, count, odd.in.data() + at);
  });
  lanes().spread_into(patch.seeds.in.data(), n, true, odd.in.data());
  Mask core = erode(odd, 2);
  std::vector<float>& gone = patch.color[0];  // nothing else is in them yet
  std::vector<float>& about = patch.color[1];
  each_span(patch, [&](std::size_t at, std::size_t count) {
    for (std::size_t i = at; i < at + count; ++i) {
      const float most = patch.key[i] > patch.bound[i] ? patch.key[i] : patch.bound[i];  // >= 0
      gone[i] = most < 1 ? most : 1.0f;
    }
  });
  blur_spans(patch, gone, about);
  Mask covered(patch.width, patch.height);
  each_span(patch, [&](std::size_t at, std::size_t count) {
    lanes().above(about.data() + at, kCovered, count, covered.in.data() + at);
  });
  lanes().spread_into(covered.in.data(), n, false, core.in.data());
  lanes().spread_into(patch.seeds.in.data(), n, true, core.in.data());
  const bool added = core.in != patch.seeds.in;
  patch.seeds = std::move(core);
  return added;
}

// Where the first alpha says nearly opaque, next to the seeds, it is the subject getting paler: the
// seeds grow over it, at most `kGrowth` cells, and the rim is then held against the paler colour.
void grow_seeds(Patch& patch) {
  constexpr int kGrowth = 8;
  constexpr float kNearlyOpaque = 0.88f;
  Mask opaque(patch.width, patch.height);
  each_span(patch, [&](std::size_t at, std::size_t count) {
    lanes().above(patch.alpha.data() + at, kNearlyOpaque, count, opaque.in.data() + at);
  });
  patch.seeds = grow_into(opaque, patch.seeds, kGrowth);
  each_span(patch, [&](std::size_t at, std::size_t count) {
    lanes().set_sure(patch.seeds.in.data() + at, count, patch.alpha.data() + at);
  });
}

// What is looked at from here on. Returns its cells: a pixel is mixed from cells one apart.
Mask find_rim(Patch& patch) {
  patch.deep = erode_disc(patch.seeds, kUntouched);
  const Mask edge = outside_of(erode(patch.deep, 1));
  patch.rim.clear();
  for (int y = 0; y < patch.height; ++y)
    each_run(edge.row(y), patch.spans[static_cast<std::size_t>(y)], [&](int begin, int end) {
      patch.rim.push_back({y, {begin, end}});
    });
  return edge;
}

}  // namespace

void cut_patch(const ScreenModel& screen, const Silhouette& s, Patch& patch) {
  const Window& window = s.window;
  patch.left = std::max(s.box.left - kMargin, window.left);
  patch.top = std::max(s.box.top - kMargin, window.top);
  patch.width =
      std::min(s.box.left + s.box.width + kMargin, window.left + window.width) - patch.left;
  patch.height =
      std::min(s.box.top + s.box.height + kMargin, window.top + window.height) - patch.top;
  patch.core = Mask(patch.width, patch.height);
  const std::size_t n = patch.cells();
  patch.contrast.resize(n);
  for (int p = 0; p < 3; ++p)
    for (auto* plane : {&patch.frame[p], &patch.plate[p], &patch.noise[p], &patch.mean[p]})
      plane->resize(n + kRoom);
  patch.alpha.assign(n + kRoom, 0);
  const std::vector<float> noise = noise_of_sums(std::max(2 * screen.noise[0], 1.0f));
  const auto width = static_cast<std::size_t>(patch.width);
  for (int y = 0; y < patch.height; ++y) {
    const std::size_t from = static_cast<std::size_t>(patch.top - window.top + y) *
                                 static_cast<std::size_t>(window.width) +
                             static_cast<std::size_t>(patch.left - window.left);
    const std::size_t to = static_cast<std::size_t>(y) * width;
    std::copy_n(s.mask.in.data() + from, width, patch.core.row(y));
    if (screen.kind == KeyKind::Plate)
      std::copy_n(s.contrast.data() + from, width, patch.contrast.data() + to);
  }
  patch.region = dilate(patch.core, 2);
  spans_of(patch.region, kReach, patch.spans);
  each_span(patch, [&](std::size_t to, std::size_t count) {
    const std::size_t from = (static_cast<std::size_t>(patch.top - window.top) + to / width) *
                                 static_cast<std::size_t>(window.width) +
                             static_cast<std::size_t>(patch.left - window.left) + to % width;
    for (int p = 0; p < 3; ++p) {
      std::copy_n(s.frame[p].data() + from, count, patch.frame[p].data() + to);
      std::copy_n(s.plate[p].data() + from, count, patch.plate[p].data() + to);
      lanes().look_up(noise.data(), s.grid.plane[p].data() + from, static_cast<int>(count),
                      patch.noise[p].data() + to);
    }
  });
}

void unmix(const ScreenModel& screen, Patch& patch) {
  gather_evidence(screen, patch);
  find_seeds(screen, patch);
  const std::size_t n = patch.cells();
  patch.weight.assign(n + kRoom, 0);
  patch.residual.resize(n + kRoom);
  for (auto& plane : patch.color) plane.resize(n + kRoom);
  for (int round = 0; round < 2; ++round) {
    each_span(patch, [&](std::size_t at, std::size_t count) {
      std::fill_n(patch.weight.data() + at, count, 0.0f);
      lanes().set_sure(patch.seeds.in.data() + at, count, patch.weight.data() + at);
    });
    gather_moments(patch, patch.weight, patch.frame);
    solve_alpha(patch, kSpill, nullptr);
    if (screen.key >= 0) allow_colorless(patch);
    if (round > 0 || !add_unexplained(patch)) break;
  }
  if (screen.key >= 0) grow_seeds(patch);
  patch.soft.resize(n + kRoom);
  blur_spans(patch, patch.alpha, patch.soft);
  each_span(patch, [&](std::size_t at, std::size_t count) {
    const ConstPointers frame(patch.frame, at);
    const ConstPointers plate(patch.plate, at);
    const Pointers color(patch.color, at);
    lanes().weigh_rim(patch.seeds.in.data() + at, patch.soft.data() + at, patch.alpha.data() + at,
                      frame.at, plate.at, count, patch.weight.data() + at, color.at);
  });
  gather_moments(patch, patch.weight, patch.color);
  const Mask edge = find_rim(patch);
  solve_alpha(patch, kRimSpill, &edge);
  if (screen.key >= 0) allow_colorless(patch);
}

}  // namespace vsprite::detail
