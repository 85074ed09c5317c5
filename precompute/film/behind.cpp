// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Background as a labelling of each cell with one of the colours seen there, after Cohen,
// "Background Estimation as a Labeling Problem" (2005), solved by iterated conditional modes from
// a smooth prior instead of graph cuts: only the subject's own place is in doubt.
#include "film/behind.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "film/silhouette.h"

namespace vsprite::detail {
namespace {

constexpr float kDoubt = 0.15f;  // share of samples unlike the median that puts it in doubt
constexpr float kLeast = 0.05f;  // share of samples that makes a colour a candidate
constexpr int kMost = 4;         // candidates of a cell
constexpr int kRounds = 6;       // of the choice
constexpr float kSeam = 30;      // code values: a step between cells costs no more
constexpr float kPlain = 8;      // code values: a place rougher than that says little of its inside
constexpr float kRare = 10;      // code values: what a colour hardly ever seen costs
constexpr float kLoose = 4;      // weight of a colour's unrest
constexpr float kForeign = 12;   // code values from what lies around: never bare, if it also
constexpr float kUnrest = 2.4f;  // moves in time by more than that many sigma of noise
constexpr int kForeignReach = 3;  // cells over which that is averaged

using Color = std::array<float, 3>;

float away(const Color& a, const Color& b) {
  return std::sqrt(distance_squared(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
}

Color sample_of(const Grid& grid, std::size_t i) {
  return {0.25f * grid.plane[0][i], 0.25f * grid.plane[1][i], 0.25f * grid.plane[2][i]};
}

// Parts at the picture's border are left out: what moves there is rather the surroundings.
void drop_at_border(Mask& mask) {
  std::vector<int> labels;
  const int parts = connected_parts(mask, labels);
  std::vector<std::uint8_t> out(static_cast<std::size_t>(parts) + 1);
  out[0] = 1;
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      if (x == 0 || y == 0 || x == mask.width - 1 || y == mask.height - 1)
        out[static_cast<std::size_t>(labels[static_cast<std::size_t>(y * mask.width + x)])] = 1;
  for (std::size_t i = 0; i < mask.in.size(); ++i)
    if (out[static_cast<std::size_t>(labels[i])]) mask.in[i] = 0;
}

// Parts of what is out that do not reach the picture's border are in.
void fill_enclosed(Mask& mask) {
  Mask rest(mask.width, mask.height);
  for (std::size_t i = 0; i < rest.in.size(); ++i) rest.in[i] = mask.in[i] ? 0 : 1;
  drop_at_border(rest);
  for (std::size_t i = 0; i < rest.in.size(); ++i) mask.in[i] |= rest.in[i];
}

// Where the median may show the subject: much differs from it in time, or that encloses it.
Mask find_doubtful(const std::vector<Grid>& grids, float reach, const std::vector<Color>& centre) {
  Mask doubtful(grids[0].width, grids[0].height);
  const float least = kDoubt * static_cast<float>(grids.size());
  for (std::size_t i = 0; i < centre.size(); ++i) {
    int unlike = 0;
    for (const Grid& grid : grids) unlike += away(sample_of(grid, i), centre[i]) > reach;
    doubtful.in[i] = static_cast<float>(unlike) > least ? 1 : 0;
  }
  doubtful = dilate(erode(doubtful, 1), 2);
  const int closing = std::max(doubtful.width / 40, 2);
  doubtful = dilate_disc(doubtful, closing);
  fill_enclosed(doubtful);
  return dilate(erode_disc(doubtful, closing), 2);
}

// Fills the cells without weight from those with one: means over squares of 2 x 2, squares of
// those, and down again.
void fill_smoothly(std::vector<Color>& color, std::vector<float>& weight, int w, int h) {
  if (std::find(weight.begin(), weight.end(), 0.0f) == weight.end() || (w <= 1 && h <= 1)) return;
  const int half_w = (w + 1) / 2;
  const int half_h = (h + 1) / 2;
  std::vector<Color> half(static_cast<std::size_t>(half_w * half_h));
  std::vector<float> known(half.size());
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const auto i = static_cast<std::size_t>(y * w + x);
      const auto o = static_cast<std::size_t>(y / 2 * half_w + x / 2);
      for (std::size_t p = 0; p < 3; ++p) half[o][p] += weight[i] * color[i][p];
      known[o] += weight[i];
    }
  for (std::size_t o = 0; o < half.size(); ++o) {
    for (float& c : half[o]) c /= std::max(known[o], 1.0f);
    known[o] = std::min(known[o], 1.0f);
  }
  fill_smoothly(half, known, half_w, half_h);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const auto i = static_cast<std::size_t>(y * w + x);
      if (weight[i] > 0) continue;
      const int left = std::clamp(x % 2 ? x / 2 : x / 2 - 1, 0, std::max(half_w - 2, 0));
      const int top = std::clamp(y % 2 ? y / 2 : y / 2 - 1, 0, std::max(half_h - 2, 0));
      const float u = half_w > 1 ? 0.5f * static_cast<float>(x - 2 * left) - 0.25f : 0.0f;
      const float v = half_h > 1 ? 0.5f * static_cast<float>(y - 2 * top) - 0.25f : 0.0f;
      const auto at = static_cast<std::size_t>(top * half_w + left);
      const std::size_t right = half_w > 1 ? 1 : 0;
      const std::size_t below = half_h > 1 ? static_cast<std::size_t>(half_w) : 0;
      for (std::size_t p = 0; p < 3; ++p)
        color[i][p] = (1 - v) * ((1 - u) * half[at][p] + u * half[at + right][p]) +
                      v * ((1 - u) * half[at + below][p] + u * half[at + below + right][p]);
    }
}

struct Candidate {
  Color color;
  float share;
  float unrest;  // rms of its samples about it, code values: bare screen has the film's noise alone
};

// The colours seen in one cell: the sample with the most others near, their mean, and so on with
// the rest.
void find_candidates(const std::vector<Grid>& grids, std::size_t i, float reach,
                     std::vector<Color>& samples, std::vector<Candidate>& candidates) {
  samples.clear();
  candidates.clear();
  for (const Grid& grid : grids) samples.push_back(sample_of(grid, i));
  const auto all = static_cast<float>(grids.size());
  for (int k = 0; k < kMost && !samples.empty(); ++k) {
    std::size_t best = 0;
    int most = 0;
    for (std::size_t a = 0; a < samples.size(); ++a) {
      int near = 0;
      for (const Color& b : samples) near += away(samples[a], b) < reach;
      if (near > most) most = near, best = a;
    }
    if (k > 0 && (static_cast<float>(most) < kLeast * all || most < 2)) return;
    const Color middle = samples[best];
    const auto rest = std::partition(samples.begin(), samples.end(), [&](const Color& other) {
      return !(away(other, middle) < reach);
    });
    const auto kept = static_cast<std::size_t>(rest - samples.begin());
    Color sum{};
    for (std::size_t a = kept; a < samples.size(); ++a)
      for (std::size_t p = 0; p < 3; ++p) sum[p] += samples[a][p];
    for (float& c : sum) c /= static_cast<float>(most);
    float square = 0;
    for (std::size_t a = kept; a < samples.size(); ++a) {
      const float d = away(samples[a], sum);
      square += d * d;
    }
    samples.resize(kept);
    const float share = static_cast<float>(most) / all;
    candidates.push_back({sum, share, std::sqrt(square / static_cast<float>(most))});
  }
}

// A cell in doubt: where it lies, what it may be.
struct Doubt {
  int x, y;
  std::vector<Candidate> candidates;
  float unrest = 0;  // of the one taken
};

// Takes for each cell in doubt the colour that steps least from its neighbours' and lies near what
// lies around.
void choose(std::vector<Doubt>& doubts, const std::vector<Color>& around, float prior, int w, int h,
            std::vector<Color>& centre) {
  const auto rarity = [](const Candidate& c) { return kRare * (1 - c.share) + kLoose * c.unrest; };
  for (const Doubt& d : doubts) {
    const auto i = static_cast<std::size_t>(d.y * w + d.x);
    const auto cost = [&](const Candidate& c) { return away(c.color, around[i]) + rarity(c); };
    centre[i] = std::min_element(d.candidates.begin(), d.candidates.end(),
                                 [&](const auto& a, const auto& b) { return cost(a) < cost(b); })
                    ->color;
  }
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    for (std::size_t k = 0; k < doubts.size(); ++k) {
      // There and back, so that what is sure gets in from all sides.
      Doubt& d = doubts[round % 2 ? doubts.size() - 1 - k : k];
      const auto i = static_cast<std::size_t>(d.y * w + d.x);
      const auto cost = [&](const Candidate& c) {
        float seams = 0;
        int count = 0;
        for (int v = std::max(d.y - 1, 0); v <= std::min(d.y + 1, h - 1); ++v)
          for (int u = std::max(d.x - 1, 0); u <= std::min(d.x + 1, w - 1); ++u) {
            if (u == d.x && v == d.y) continue;
            seams += std::min(away(c.color, centre[static_cast<std::size_t>(v * w + u)]), kSeam);
            ++count;
          }
        return seams / static_cast<float>(count) + prior * away(c.color, around[i]) + rarity(c);
      };
      const auto best =
          std::min_element(d.candidates.begin(), d.candidates.end(),
                           [&](const auto& a, const auto& b) { return cost(a) < cost(b); });
      changed = changed || best->color != centre[i];
      centre[i] = best->color;
      d.unrest = best->unrest;
    }
    if (!changed) return;
  }
}

// Cells in doubt whose colour, with those around, is foreign to the place and not at rest: never
// bare.
Mask find_foreign(const std::vector<Doubt>& doubts, float noise, int w, int h,
                  const std::vector<Color>& around, const std::vector<Color>& centre) {
  std::vector<float> far(centre.size()), unrest(far.size()), some(far.size()), scratch;
  for (const Doubt& d : doubts) {
    const auto i = static_cast<std::size_t>(d.y * w + d.x);
    some[i] = 1;
    far[i] = away(centre[i], around[i]);
    unrest[i] = d.unrest;
  }
  Mask odd(w, h);
  for (const Doubt& d : doubts) {
    const auto i = static_cast<std::size_t>(d.y * w + d.x);
    odd.in[i] = far[i] > kForeign && d.unrest > kUnrest * noise ? 1 : 0;
  }
  for (auto* plane : {&far, &unrest, &some}) blur(*plane, w, h, kForeignReach, 1, scratch);
  Mask foreign(w, h);
  for (const Doubt& d : doubts) {
    const auto i = static_cast<std::size_t>(d.y * w + d.x);
    foreign.in[i] = far[i] > kForeign * some[i] && unrest[i] > kUnrest * noise * some[i] ? 1 : 0;
  }
  // To the edge of what is foreign: the averages end before it.
  foreign = erode(foreign, 1);
  for (int step = 0; step < 2 * kForeignReach; ++step) {
    Mask grown = dilate(foreign, 1);
    for (std::size_t i = 0; i < grown.in.size(); ++i)
      grown.in[i] = foreign.in[i] || (grown.in[i] && odd.in[i]) ? 1 : 0;
    foreign = std::move(grown);
  }
  drop_at_border(foreign);
  return foreign;
}

// How much the picture changes within a few cells, near the cells in doubt.
float roughness(const Mask& doubtful, const std::vector<Color>& centre) {
  constexpr int kApart = 8;
  const Mask near = dilate(doubtful, 2 * kApart);
  double sum = 0;
  double count = 1;
  for (int y = 0; y < near.height; ++y)
    for (int x = 0; x + kApart < near.width; ++x) {
      const auto i = static_cast<std::size_t>(y * near.width + x);
      if (!near.in[i] || doubtful.in[i] || doubtful.in[i + kApart]) continue;
      sum += static_cast<double>(away(centre[i], centre[i + kApart]));
      count += 1;
    }
  return static_cast<float>(sum / count);
}

}  // namespace

bool look_behind(const std::vector<Grid>& grids, float noise, std::vector<float> (&planes)[3],
                 Mask& foreign) {
  const float reach = std::clamp(3.5f * noise + 1, 12.0f, 24.0f);
  const int w = grids[0].width;
  const int h = grids[0].height;
  std::vector<Color> centre(grids[0].cells());
  for (std::size_t i = 0; i < centre.size(); ++i)
    centre[i] = {planes[0][i], planes[1][i], planes[2][i]};
  const std::vector<Color> before = centre;
  const Mask doubtful = find_doubtful(grids, reach, centre);
  std::vector<Doubt> doubts;
  std::vector<Color> samples;
  std::vector<float> weight(centre.size(), 1);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const auto i = static_cast<std::size_t>(y * w + x);
      if (!doubtful.in[i]) continue;
      weight[i] = 0;
      doubts.push_back({x, y, {}});
      find_candidates(grids, i, reach, samples, doubts.back().candidates);
    }
  // All of it moves: there is nothing around to go by.
  if (doubts.empty() || 2 * doubts.size() > centre.size()) return false;
  // Twice: what the first choice found bare is then around the rest.
  const float prior = kPlain / (kPlain + roughness(doubtful, centre));
  std::vector<Color> outside;
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<Color> around = centre;
    fill_smoothly(around, weight, w, h);
    if (pass == 0) outside = around;
    choose(doubts, around, prior, w, h, centre);
    foreign = find_foreign(doubts, noise, w, h, outside, centre);
    for (std::size_t i = 0; i < weight.size(); ++i) weight[i] = foreign.in[i] ? 0.0f : 1.0f;
  }
  for (std::size_t i = 0; i < centre.size(); ++i)
    if (foreign.in[i]) centre[i] = outside[i];
  for (std::size_t i = 0; i < centre.size(); ++i)
    for (std::size_t p = 0; p < 3; ++p) planes[p][i] = centre[i][p];
  return centre != before;
}

}  // namespace vsprite::detail
