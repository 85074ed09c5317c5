// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Seeds, local foreground, projection. Colour-difference keys after Vlahos; the foreground's local
// Gaussian after Chuang et al., "A Bayesian Approach to Digital Matting" (2001), but solved in
// closed form along the line from the known plate, without search.
#include "film/unmix.h"

#include <algorithm>
#include <cmath>

#include "film/light.h"

namespace vsprite::detail {
namespace {

constexpr int kMargin = 4;              // cells around the silhouette
constexpr float kSpill = 0.05f;         // share of the plate in a foreground near it, and at the
constexpr float kRimSpill = 0.08f;      // rim, where screen light falls from behind
constexpr float kShading = 0.1f;        // relative sigma of the foreground's brightness
constexpr float kHue = 0.04f;           // sigma of its colour, relative to its luma
constexpr float kFarWeight = 0.02f;     // of the wide neighbourhood against the near one
constexpr float kGlobalWeight = 1e-4f;  // of the whole patch

float luma(float r, float g, float b) { return 0.2126f * r + 0.7152f * g + 0.0722f * b; }

// Evidence of coverage in one cell, before any foreground is known.
struct Evidence {
  std::vector<float> key;    // v / normaliser, or distance against its local maximum
  std::vector<float> raw;    // v, or the same
  std::vector<float> bound;  // alpha below this puts F outside the gamut
};

// Smallest alpha for which F = B + D / alpha lies in [0, 1]^3; two sigma of noise are taken off.
float gamut_bound(const Patch& patch, std::size_t i) {
  float bound = 0;
  for (int p = 0; p < 3; ++p) {
    const float b = patch.plate[p][i];
    const float d = patch.frame[p][i] - b;
    const float sure = std::abs(d) - 2 * patch.noise[p][i];
    if (sure <= 0) continue;
    const float room = d > 0 ? 1 - b : b;
    bound = std::max(bound, room > 1e-4f ? sure / room : 1.0f);
  }
  return std::min(bound, 1.0f);
}

std::vector<float> largest_around(const std::vector<float>& plane, int width, int height,
                                  int radius) {
  std::vector<float> rows = plane;
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  };
  for (int y = 0; y < height; ++y)
    for (int k = 1; k <= radius; ++k) {
      for (int x = k; x < width; ++x)
        rows[at(x, y)] = std::max(rows[at(x, y)], plane[at(x - k, y)]);
      for (int x = 0; x + k < width; ++x)
        rows[at(x, y)] = std::max(rows[at(x, y)], plane[at(x + k, y)]);
    }
  std::vector<float> both = rows;
  for (int y = 0; y < height; ++y)
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, height - 1); ++v)
      for (int x = 0; x < width; ++x) both[at(x, y)] = std::max(both[at(x, y)], rows[at(x, v)]);
  return both;
}

Evidence gather_evidence(const ScreenModel& screen, const Patch& patch) {
  Evidence e;
  const std::size_t n = patch.cells();
  e.key.assign(n, 0);
  e.raw.assign(n, 0);
  e.bound.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    if (!patch.region.in[i]) continue;
    e.bound[i] = gamut_bound(patch, i);
    const float b =
        key_strength(screen.key, patch.plate[0][i], patch.plate[1][i], patch.plate[2][i]);
    if (screen.key >= 0 && b > 0.02f) {
      e.raw[i] =
          1 - key_strength(screen.key, patch.frame[0][i], patch.frame[1][i], patch.frame[2][i]) / b;
      e.key[i] = e.raw[i] / screen.key_normaliser;
    } else {
      float d = 0;
      for (int p = 0; p < 3; ++p) {
        const float x = patch.frame[p][i] - patch.plate[p][i];
        d += x * x;
      }
      e.raw[i] = std::sqrt(d);
    }
  }
  if (screen.key >= 0) return e;
  // No key: the distance to the plate against the largest in 9 x 9.
  const std::vector<float> most = largest_around(e.raw, patch.width, patch.height, 4);
  for (std::size_t i = 0; i < n; ++i)
    if (patch.region.in[i]) e.key[i] = 1.25f * e.raw[i] / std::clamp(most[i], 0.02f, 0.3f);
  e.raw = e.key;
  return e;
}

// Holes are filled unless a cell of theirs looks like screen.
void fill_holes(const Patch& patch, const Evidence& e, Mask& seeds) {
  Mask rest(seeds.width, seeds.height);
  for (std::size_t i = 0; i < rest.in.size(); ++i) rest.in[i] = seeds.in[i] ? 0 : 1;
  std::vector<int> labels;
  const int parts = connected_parts(rest, labels);
  std::vector<std::uint8_t> open(static_cast<std::size_t>(parts) + 1);
  for (int y = 0; y < rest.height; ++y)
    for (int x = 0; x < rest.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(rest.width) +
                            static_cast<std::size_t>(x);
      const bool border = x == 0 || y == 0 || x == rest.width - 1 || y == rest.height - 1;
      if (border || !patch.region.in[i] || (e.raw[i] < 0.35f && e.bound[i] < 0.5f))
        open[static_cast<std::size_t>(labels[i])] = 1;
    }
  for (std::size_t i = 0; i < rest.in.size(); ++i)
    if (rest.in[i] && !open[static_cast<std::size_t>(labels[i])]) seeds.in[i] = 1;
}

// A screen without a key says nothing of translucence: what stands out, two cells inside, is
// opaque.
void add_inside(const ScreenModel& screen, const Patch& patch, Mask& seeds) {
  Mask strong(patch.width, patch.height);
  for (std::size_t i = 0; i < strong.in.size(); ++i)
    strong.in[i] = patch.core.in[i] && patch.contrast[i] > 2 * screen.threshold ? 1 : 0;
  const Mask inside = erode(strong, 2);
  for (std::size_t i = 0; i < inside.in.size(); ++i) seeds.in[i] |= inside.in[i];
}

void find_seeds(const ScreenModel& screen, const Patch& patch, const Evidence& e, Mask& seeds) {
  const std::size_t n = patch.cells();
  // Deep inside less is enough, but not of a subject much stronger than the key: there half the
  // strength is a translucent fin.
  const float enough = screen.key_normaliser > 1.5f ? 0.8f : 0.5f;
  Mask sure(patch.width, patch.height);
  Mask likely(patch.width, patch.height);
  for (std::size_t i = 0; i < n; ++i) {
    const float score = std::max(e.key[i], 1.15f * e.bound[i]);
    sure.in[i] = patch.region.in[i] && score > 0.85f ? 1 : 0;
    likely.in[i] = patch.region.in[i] && score > enough ? 1 : 0;
  }
  seeds = erode(erode(dilate(sure, 1), 1), 1);
  if (screen.key < 0) add_inside(screen, patch, seeds);
  const Mask all_likely = erode(likely, 2);
  const auto depth = distance_to(patch.region, 0);
  for (std::size_t i = 0; i < n; ++i)
    if (depth[i] > 5 * 5 && all_likely.in[i]) seeds.in[i] = 1;
  fill_holes(patch, e, seeds);
}

// Weighted sums of 1, the three channels and their six products: near (sigma 2 cells), wide (sigma
// about 10, kept in squares of four by four cells) and over the patch.
struct Moments {
  static constexpr int kCount = 10;
  static constexpr int kCoarse = 4;
  std::vector<float> near[kCount], wide[kCount];
  int wide_width = 0, wide_height = 0;
  float all[kCount] = {};
};

void gather_moments(const Patch& patch, const std::vector<float>& weight,
                    const std::vector<float> (&color)[3], Moments& m) {
  const std::size_t n = patch.cells();
  m.wide_width = (patch.width + Moments::kCoarse - 1) / Moments::kCoarse;
  m.wide_height = (patch.height + Moments::kCoarse - 1) / Moments::kCoarse;
  for (auto& plane : m.near) plane.assign(n, 0);
  for (auto& plane : m.wide)
    plane.assign(static_cast<std::size_t>(m.wide_width) * static_cast<std::size_t>(m.wide_height),
                 0);
  std::size_t i = 0;
  for (int y = 0; y < patch.height; ++y)
    for (int x = 0; x < patch.width; ++x, ++i) {
      const float w = weight[i];
      if (!(w > 0)) continue;
      const float r = color[0][i];
      const float g = color[1][i];
      const float b = color[2][i];
      const float value[Moments::kCount] = {1, r, g, b, r * r, r * g, r * b, g * g, g * b, b * b};
      const std::size_t square =
          static_cast<std::size_t>(y / Moments::kCoarse) * static_cast<std::size_t>(m.wide_width) +
          static_cast<std::size_t>(x / Moments::kCoarse);
      for (int k = 0; k < Moments::kCount; ++k) {
        m.near[k][i] = w * value[k];
        m.wide[k][square] += w * value[k] / (Moments::kCoarse * Moments::kCoarse);
      }
    }
  std::vector<float> scratch;
  for (int k = 0; k < Moments::kCount; ++k) {
    double all = 0;
    for (const float value : m.wide[k]) all += static_cast<double>(value);
    m.all[k] = static_cast<float>(all);
    blur(m.near[k], patch.width, patch.height, 2, 2, scratch);
    blur(m.wide[k], m.wide_width, m.wide_height, 2, 3, scratch);
  }
}

// The four squares about a cell and their bilinear shares.
struct Squares {
  std::size_t at[4];
  float share[4];

  Squares(const Moments& m, int x, int y) {
    const auto axis = [](int cell, int count, int& low, int& high, float& second) {
      const int shifted = 2 * cell + 1 - Moments::kCoarse;  // half cells from the first middle
      low = shifted < 0 ? 0 : shifted / (2 * Moments::kCoarse);
      high = std::min(low + 1, count - 1);
      second = shifted < 0 ? 0.0f
                           : static_cast<float>(shifted % (2 * Moments::kCoarse)) /
                                 static_cast<float>(2 * Moments::kCoarse);
    };
    int left = 0;
    int right = 0;
    int top = 0;
    int low = 0;
    float u = 0;
    float v = 0;
    axis(x, m.wide_width, left, right, u);
    axis(y, m.wide_height, top, low, v);
    const auto index = [&](int cx, int cy) {
      return static_cast<std::size_t>(cy) * static_cast<std::size_t>(m.wide_width) +
             static_cast<std::size_t>(cx);
    };
    at[0] = index(left, top);
    at[1] = index(right, top);
    at[2] = index(left, low);
    at[3] = index(right, low);
    share[0] = (1 - u) * (1 - v);
    share[1] = u * (1 - v);
    share[2] = (1 - u) * v;
    share[3] = u * v;
  }
};

struct Foreground {
  float mean[3];
  float covariance[6];  // rr rg rb gg gb bb
};

Foreground foreground_at(const Patch& patch, const Moments& m, std::size_t i, float spill) {
  const Squares squares(m, static_cast<int>(i % static_cast<std::size_t>(patch.width)),
                        static_cast<int>(i / static_cast<std::size_t>(patch.width)));
  float sum[Moments::kCount];
  for (int k = 0; k < Moments::kCount; ++k) {
    float wide = 0;
    for (int s = 0; s < 4; ++s) wide += squares.share[s] * m.wide[k][squares.at[s]];
    sum[k] = m.near[k][i] + kFarWeight * wide + kGlobalWeight * m.all[k];
  }
  Foreground f{};
  if (!(sum[0] > 0)) return f;
  const float inverse = 1 / sum[0];
  for (int p = 0; p < 3; ++p) f.mean[p] = sum[1 + p] * inverse;
  constexpr int kFirst[6] = {0, 0, 0, 1, 1, 2};
  constexpr int kSecond[6] = {0, 1, 2, 1, 2, 2};
  const float hue = kHue * luma(f.mean[0], f.mean[1], f.mean[2]);
  for (int k = 0; k < 6; ++k) {
    const float product = f.mean[kFirst[k]] * f.mean[kSecond[k]];
    f.covariance[k] = sum[4 + k] * inverse - product + kShading * kShading * product;
    if (kFirst[k] == kSecond[k]) f.covariance[k] = std::max(f.covariance[k], 0.0f) + hue * hue;
  }
  for (int p = 0; p < 3; ++p) f.mean[p] += spill * patch.plate[p][i];
  return f;
}

// S = a^2 Sigma_F + g sigma_n^2 I; its adjugate, and its determinant.
struct Metric {
  float rr, rg, rb, gg, gb, bb, determinant;

  Metric(const Foreground& f, const Patch& patch, std::size_t i, float a, float gain) {
    const float* c = f.covariance;
    const float aa = a * a;
    const auto noise = [&](int p) { return gain * patch.noise[p][i] * patch.noise[p][i]; };
    const float s0 = aa * c[0] + noise(0);
    const float s1 = aa * c[1];
    const float s2 = aa * c[2];
    const float s3 = aa * c[3] + noise(1);
    const float s4 = aa * c[4];
    const float s5 = aa * c[5] + noise(2);
    rr = s3 * s5 - s4 * s4;
    rg = s2 * s4 - s1 * s5;
    rb = s1 * s4 - s2 * s3;
    gg = s0 * s5 - s2 * s2;
    gb = s1 * s2 - s0 * s4;
    bb = s0 * s3 - s1 * s1;
    determinant = s0 * rr + s1 * rg + s2 * rb;
  }
  float product(const float (&u)[3], const float (&v)[3]) const {
    return u[0] * (rr * v[0] + rg * v[1] + rb * v[2]) + u[1] * (rg * v[0] + gg * v[1] + gb * v[2]) +
           u[2] * (rb * v[0] + gb * v[1] + bb * v[2]);
  }
};

// Two rounds of the projection from alpha = 1/2. `residual`: Mahalanobis, of what the line leaves.
float project(const Patch& patch, const Foreground& f, std::size_t i, float least,
              float* residual) {
  float d[3];
  float m[3];
  for (int p = 0; p < 3; ++p) {
    d[p] = patch.frame[p][i] - patch.plate[p][i];
    m[p] = f.mean[p] - patch.plate[p][i];
  }
  float a = 0.5f;
  for (int round = 0; round < 2; ++round) {
    const Metric metric(f, patch, i, a, 1);
    const float bottom = metric.product(m, m);
    a = bottom > 0 ? metric.product(d, m) / bottom : 0.0f;
    a = std::clamp(a, 0.02f, 1.0f);
  }
  a = std::max(a, least);
  if (residual) {
    const Metric metric(f, patch, i, a, 9);
    const float r[3] = {d[0] - a * m[0], d[1] - a * m[1], d[2] - a * m[2]};
    *residual = metric.determinant > 0 ? metric.product(r, r) / metric.determinant : 0.0f;
  }
  return a;
}

void solve_alpha(Patch& patch, const Moments& m, const Evidence& e, float spill,
                 std::vector<float>* residual) {
  for (std::size_t i = 0; i < patch.cells(); ++i) {
    if (residual) (*residual)[i] = 0;
    if (!patch.region.in[i] && !patch.seeds.in[i]) {
      patch.alpha[i] = 0;
      continue;
    }
    // The neighbourhood of the seeds themselves is asked for at the end only, by the despill.
    if (patch.seeds.in[i] && residual) {
      patch.alpha[i] = 1;
      continue;
    }
    const Foreground f = foreground_at(patch, m, i, spill);
    for (int p = 0; p < 3; ++p) patch.mean[p][i] = f.mean[p];
    patch.alpha[i] = patch.seeds.in[i]
                         ? 1.0f
                         : project(patch, f, i, e.bound[i], residual ? &(*residual)[i] : nullptr);
  }
}

// What no mixture explains, with all its neighbours, is another part of the subject.
bool add_unexplained(const std::vector<float>& residual, Mask& seeds) {
  Mask odd(seeds.width, seeds.height);
  for (std::size_t i = 0; i < odd.in.size(); ++i)
    odd.in[i] = residual[i] > 12 || seeds.in[i] ? 1 : 0;
  const Mask core = erode(odd, 2);
  bool added = false;
  for (std::size_t i = 0; i < core.in.size(); ++i)
    if (core.in[i] && !seeds.in[i]) {
      seeds.in[i] = 1;
      added = true;
    }
  return added;
}

// Where the first alpha says nearly opaque, next to the seeds, it is the subject getting paler: the
// seeds grow over it, at most `kGrowth` cells, and the rim is then held against the paler colour.
void grow_seeds(Patch& patch) {
  constexpr int kGrowth = 8;
  constexpr float kNearlyOpaque = 0.88f;
  for (int step = 0; step < kGrowth; ++step) {
    const Mask near = dilate(patch.seeds, 1);
    bool grown = false;
    for (std::size_t i = 0; i < near.in.size(); ++i) {
      if (!near.in[i] || patch.seeds.in[i] || patch.alpha[i] <= kNearlyOpaque) continue;
      patch.seeds.in[i] = 1;
      patch.alpha[i] = 1;
      grown = true;
    }
    if (!grown) return;
  }
}

// The rim's own colours, unmixed with the first alpha, join the seeds' by how opaque they are.
void weigh_rim(const Patch& patch, std::vector<float>& weight, std::vector<float> (&color)[3]) {
  const std::size_t n = patch.cells();
  std::vector<float> soft = patch.alpha;
  std::vector<float> scratch;
  blur(soft, patch.width, patch.height, 1, 1, scratch);
  for (std::size_t i = 0; i < n; ++i) {
    const float rim = std::clamp((soft[i] - 0.6f) / 0.4f, 0.0f, 1.0f);
    weight[i] = patch.seeds.in[i] ? 1.0f : rim;
    for (int p = 0; p < 3; ++p) {
      const float a = std::max(patch.alpha[i], 0.02f);
      color[p][i] =
          patch.seeds.in[i]
              ? patch.frame[p][i]
              : std::clamp(patch.plate[p][i] + (patch.frame[p][i] - patch.plate[p][i]) / a, 0.0f,
                           1.0f);
    }
  }
}

}  // namespace

void cut_patch(const ScreenModel& screen, const Silhouette& s, Patch& patch) {
  patch.left = std::max(s.left - kMargin, 0);
  patch.top = std::max(s.top - kMargin, 0);
  patch.width = std::min(s.right + kMargin, s.grid.width) - patch.left;
  patch.height = std::min(s.bottom + kMargin, s.grid.height) - patch.top;
  patch.core = Mask(patch.width, patch.height);
  const std::size_t n = patch.cells();
  patch.contrast.resize(n);
  for (int p = 0; p < 3; ++p) {
    patch.frame[p].resize(n);
    patch.plate[p].resize(n);
    patch.noise[p].resize(n);
    patch.mean[p].assign(n, 0);
  }
  patch.alpha.assign(n, 0);
  const auto& light = linear_of_sums();
  const float codes = std::max(2 * screen.noise[0], 1.0f);
  for (int y = 0; y < patch.height; ++y)
    for (int x = 0; x < patch.width; ++x) {
      const int gx = patch.left + x;
      const int gy = patch.top + y;
      const std::size_t from =
          static_cast<std::size_t>(gy) * static_cast<std::size_t>(s.grid.width) +
          static_cast<std::size_t>(gx);
      const std::size_t to = static_cast<std::size_t>(y) * static_cast<std::size_t>(patch.width) +
                             static_cast<std::size_t>(x);
      const double u = scaled(gx, s.grid.width);
      const double v = scaled(gy, s.grid.height);
      patch.core.in[to] = s.mask.in[from];
      patch.contrast[to] = s.contrast[from];
      for (int p = 0; p < 3; ++p) {
        const int plane = 2 - p;  // B G R to R G B
        const int sum = s.grid.plane[plane][from];
        const float plate = std::clamp(
            4 * (screen.cells[plane][from] + static_cast<float>(s.drift.at(plane, u, v))), 0.0f,
            1020.0f);
        const std::size_t low = std::min(static_cast<std::size_t>(plate), std::size_t{1019});
        patch.frame[p][to] = light[static_cast<std::size_t>(sum)];
        patch.plate[p][to] =
            light[low] + (light[low + 1] - light[low]) * (plate - static_cast<float>(low));
        const int above = std::min(sum + 4, 1020);
        const int below = std::max(sum - 4, 0);
        const float slope =
            4 * (light[static_cast<std::size_t>(above)] - light[static_cast<std::size_t>(below)]) /
            static_cast<float>(above - below);
        patch.noise[p][to] = codes * slope;
      }
    }
  patch.region = dilate(patch.core, 2);
}

void unmix(const ScreenModel& screen, Patch& patch) {
  const Evidence evidence = gather_evidence(screen, patch);
  find_seeds(screen, patch, evidence, patch.seeds);
  const std::size_t n = patch.cells();
  std::vector<float> weight(n);
  std::vector<float> color[3];
  for (int p = 0; p < 3; ++p) color[p] = patch.frame[p];
  std::vector<float> residual(n);
  Moments moments;
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < n; ++i) weight[i] = patch.seeds.in[i] ? 1.0f : 0.0f;
    gather_moments(patch, weight, color, moments);
    solve_alpha(patch, moments, evidence, kSpill, &residual);
    if (round > 0 || !add_unexplained(residual, patch.seeds)) break;
  }
  if (screen.key >= 0) grow_seeds(patch);
  weigh_rim(patch, weight, color);
  gather_moments(patch, weight, color, moments);
  solve_alpha(patch, moments, evidence, kRimSpill, nullptr);
}

}  // namespace vsprite::detail
