// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Plain loops without branches on data: Highway compiles this file once for every instruction set
// and the compiler makes lanes of them. Selections compute both sides, so that they become blends.
#include "film/lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "film/lanes.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace vsprite::detail::HWY_NAMESPACE {
namespace {

inline float smaller(float a, float b) { return a < b ? a : b; }
inline float larger_of(float a, float b) { return a > b ? a : b; }
inline float bounded(float v, float low, float high) { return smaller(larger_of(v, low), high); }
inline float magnitude(float v) { return v < 0 ? -v : v; }

// Within 0.1 code values of the sRGB curve: two roots and a line.
inline float encode(float x) {
  const float s = std::sqrt(x);
  const float q = std::sqrt(s);
  const float curve = 212.60225f * s + 76.02294f * q - 14.105422f * x - 19.611817f;
  return x < 0.0031308f ? 3294.6f * x : curve;
}

void count_different(const std::uint8_t* __restrict top, const std::uint8_t* __restrict low,
                     const std::uint8_t* __restrict cb, const std::uint8_t* __restrict cr,
                     const std::uint16_t* __restrict plate_y,
                     const std::uint8_t* __restrict plate_cb,
                     const std::uint8_t* __restrict plate_cr, int n, int block,
                     const RowLimits* __restrict limits, int* __restrict counts) {
  for (int first = 0; first < n; first += block, ++limits, ++counts) {
    const int end = std::min(first + block, n);
    const RowLimits limit = *limits;
    int count = 0;
    int i = first;
#if HWY_TARGET != HWY_SCALAR
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::CappedTag<std::uint16_t, 32> d;
    const hn::RebindToSigned<decltype(d)> di;
    const hn::Rebind<std::uint8_t, decltype(d)> db;
    const hn::Repartition<std::uint8_t, decltype(d)> wide;
    const int step = static_cast<int>(hn::Lanes(d));
    const auto low_byte = hn::Set(d, 0xFF);
    const auto pairs = [&](const std::uint8_t* p) {
      const auto v = hn::BitCast(d, hn::LoadU(wide, p));
      return hn::Add(hn::And(v, low_byte), hn::ShiftRight<8>(v));
    };
    const auto color = [&](const std::uint8_t* a, const std::uint8_t* b, std::int16_t shift) {
      const auto va = hn::BitCast(di, hn::PromoteTo(d, hn::LoadU(db, a)));
      const auto vb = hn::BitCast(di, hn::PromoteTo(d, hn::LoadU(db, b)));
      return hn::Abs(hn::Sub(hn::Sub(va, vb), hn::Set(di, shift)));
    };
    for (; i + step <= end; i += step) {
      const auto sum = hn::Add(pairs(top + 2 * i), pairs(low + 2 * i));
      const auto plate = hn::BitCast(di, hn::LoadU(d, plate_y + i));
      const auto y =
          hn::Abs(hn::Sub(hn::Sub(hn::BitCast(di, sum), plate), hn::Set(di, limit.shift_y)));
      const auto c = hn::Max(color(cb + i, plate_cb + i, limit.shift_cb),
                             color(cr + i, plate_cr + i, limit.shift_cr));
      const auto out =
          hn::Or(hn::Gt(y, hn::Set(di, limit.limit_y)), hn::Gt(c, hn::Set(di, limit.limit_c)));
      count += static_cast<int>(hn::CountTrue(di, out));
    }
#endif
    for (; i < end; ++i) {
      const int sum = top[2 * i] + top[2 * i + 1] + low[2 * i] + low[2 * i + 1];
      const int y = std::abs(sum - plate_y[i] - limit.shift_y);
      const int b = std::abs(cb[i] - plate_cb[i] - limit.shift_cb);
      const int r = std::abs(cr[i] - plate_cr[i] - limit.shift_cr);
      count += y > limit.limit_y || std::max(b, r) > limit.limit_c;
    }
    *counts += count;
  }
}

void sum_cells(const RgbOfYcc& m, const std::uint8_t* __restrict top,
               const std::uint8_t* __restrict low, const std::uint8_t* __restrict cb,
               const std::uint8_t* __restrict cr, int n, std::uint16_t* __restrict red,
               std::uint16_t* __restrict green, std::uint16_t* __restrict blue) {
  const int luma = m.luma;
  const int offset = 32768 - luma * 4 * m.black;
  const int rv = 4 * m.red_of_cr;
  const int gu = 4 * m.green_of_cb;
  const int gv = 4 * m.green_of_cr;
  const int bu = 4 * m.blue_of_cb;
  for (int i = 0; i < n; ++i) {
    const int sum = top[2 * i] + top[2 * i + 1] + low[2 * i] + low[2 * i + 1];
    const int base = luma * sum + offset;
    const int u = cb[i] - 128;
    const int v = cr[i] - 128;
    red[i] = static_cast<std::uint16_t>(std::min(std::max((base + rv * v) >> 16, 0), 1020));
    green[i] =
        static_cast<std::uint16_t>(std::min(std::max((base + gu * u + gv * v) >> 16, 0), 1020));
    blue[i] = static_cast<std::uint16_t>(std::min(std::max((base + bu * u) >> 16, 0), 1020));
  }
}

void contrast(const std::uint16_t* const (&sums)[3], ConstPlanes plate, const RowTerms (&drift)[3],
              RowScale scale, int n, float* __restrict out) {
  const std::uint16_t* __restrict sr = sums[0];
  const std::uint16_t* __restrict sg = sums[1];
  const std::uint16_t* __restrict sb = sums[2];
  const float* __restrict pr = plate[0];
  const float* __restrict pg = plate[1];
  const float* __restrict pb = plate[2];
  for (int i = 0; i < n; ++i) {
    const float u = scale.first + scale.step * static_cast<float>(i);
    const auto left = [u](std::uint16_t sum, float p, RowTerms t) {
      return 0.25f * static_cast<float>(sum) - p - (t.a + u * (t.b + u * t.c));
    };
    const float r = left(sr[i], pr[i], drift[0]);
    const float g = left(sg[i], pg[i], drift[1]);
    const float b = left(sb[i], pb[i], drift[2]);
    const float y = 0.114f * b + 0.587f * g + 0.299f * r;
    const float cb = 0.564f * (b - y);
    const float cr = 0.713f * (r - y);
    out[i] = std::sqrt(y * y + 2 * (cb * cb + cr * cr));
  }
}

void look_up(const float* __restrict table, const std::uint16_t* __restrict index, int n,
             float* __restrict out) {
  for (int i = 0; i < n; ++i) out[i] = table[index[i]];
}

void shift(const float* __restrict base, const float* __restrict slope, RowTerms t, RowScale scale,
           int n, float* __restrict out) {
  for (int i = 0; i < n; ++i) {
    const float u = scale.first + scale.step * static_cast<float>(i);
    out[i] = bounded(base[i] + slope[i] * (t.a + u * (t.b + u * t.c)), 0, 1);
  }
}

void forgive_shadows(ConstPlanes frame, ConstPlanes plate, std::size_t n,
                     float* __restrict contrast_out) {
  const float* __restrict c0 = frame[0];
  const float* __restrict c1 = frame[1];
  const float* __restrict c2 = frame[2];
  const float* __restrict b0 = plate[0];
  const float* __restrict b1 = plate[1];
  const float* __restrict b2 = plate[2];
  for (std::size_t i = 0; i < n; ++i) {
    const float bb = b0[i] * b0[i] + b1[i] * b1[i] + b2[i] * b2[i];
    const float cb = c0[i] * b0[i] + c1[i] * b1[i] + c2[i] * b2[i];
    const float s = cb / larger_of(bb, 1e-12f);
    const float r0 = c0[i] - s * b0[i];
    const float r1 = c1[i] - s * b1[i];
    const float r2 = c2[i] - s * b2[i];
    const float rest = r0 * r0 + r1 * r1 + r2 * r2;
    float forgiven = rest < 0.12f * 0.12f * s * s * bb ? 0.0f : contrast_out[i];
    forgiven = s < 0.35f ? contrast_out[i] : forgiven;
    contrast_out[i] = s > 1.3f ? contrast_out[i] : forgiven;
  }
}

void above(const float* __restrict values, float limit, std::size_t n,
           std::uint8_t* __restrict out) {
  for (std::size_t i = 0; i < n; ++i) out[i] = values[i] > limit ? 1 : 0;
}

void spread_into(const std::uint8_t* __restrict in, std::size_t n, bool larger,
                 std::uint8_t* __restrict inout) {
  if (larger)
    for (std::size_t i = 0; i < n; ++i) inout[i] = inout[i] > in[i] ? inout[i] : in[i];
  else
    for (std::size_t i = 0; i < n; ++i) inout[i] = inout[i] < in[i] ? inout[i] : in[i];
}

void pack_bits(const std::uint8_t* __restrict in, int n, bool complement,
               std::uint64_t* __restrict bits) {
  std::fill_n(bits, (n + 63) / 64, std::uint64_t{0});
  int x = 0;
#if HWY_TARGET != HWY_SCALAR
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<std::uint8_t, 64> d;
  const int step = static_cast<int>(hn::Lanes(d));
  auto* bytes = reinterpret_cast<std::uint8_t*>(bits);
  const auto pack = [&](int at, std::uint8_t* to) {
    const auto out = hn::Eq(hn::LoadU(d, in + at), hn::Zero(d));
    hn::StoreMaskBits(d, complement ? out : hn::Not(out), to);
  };
  for (; x + step <= n; x += step) pack(x, bytes + x / 8);
  if (x > 0 && x < n) {  // the last ones with some of those before
    std::uint64_t last = 0;
    pack(n - step, reinterpret_cast<std::uint8_t*>(&last));
    bits[x / 64] |= last >> (x - (n - step)) << (x % 64);
    x = n;
  }
#endif
  for (; x < n; ++x)
    bits[x / 64] |= static_cast<std::uint64_t>((in[x] != 0) != complement) << (x % 64);
}

void unpack_bits(const std::uint64_t* __restrict bits, int n, bool complement,
                 std::uint8_t* __restrict out) {
  int x = 0;
#if HWY_TARGET != HWY_SCALAR
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<std::uint8_t, 64> d;
  const int step = static_cast<int>(hn::Lanes(d));
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(bits);
  const auto flip = hn::Set(d, static_cast<std::uint8_t>(complement ? 1 : 0));
  const auto unpack = [&](const std::uint8_t* from, int at) {
    const auto in = hn::LoadMaskBits(d, from);
    hn::StoreU(hn::Xor(hn::IfThenElseZero(in, hn::Set(d, std::uint8_t{1})), flip), d, out + at);
  };
  for (; x + step <= n; x += step) unpack(bytes + x / 8, x);
  if (x > 0 && x < n) {  // the last ones with some of those before
    const int at = n - step;
    std::uint64_t last = bits[at / 64] >> (at % 64);
    if (at % 64 > 0) last |= bits[at / 64 + 1] << (64 - at % 64);
    unpack(reinterpret_cast<const std::uint8_t*>(&last), at);
    x = n;
  }
#endif
  for (; x < n; ++x)
    out[x] = static_cast<std::uint8_t>(((bits[x / 64] >> (x % 64)) & 1) ^ (complement ? 1 : 0));
}

void sum5(const float* __restrict in, std::ptrdiff_t stride, std::size_t n, float scale,
          float* __restrict out) {
  const float* __restrict a = in - stride;
  const float* __restrict b = in + stride;
  const float* __restrict aa = a - stride;
  const float* __restrict bb = b + stride;
  if (stride == 1)
    for (std::size_t x = 0; x < n; ++x) out[x] = (in[x] + b[x] + a[x] + bb[x] + aa[x]) * scale;
  else
    for (std::size_t x = 0; x < n; ++x) out[x] = (in[x] + a[x] + b[x] + aa[x] + bb[x]) * scale;
}

void sum3(const float* __restrict in, std::size_t n, float* __restrict out) {
  const float* __restrict a = in - 1;
  const float* __restrict b = in + 1;
  for (std::size_t x = 0; x < n; ++x) out[x] = a[x] + in[x] + b[x];
}

void add_far(const float* __restrict a, const float* __restrict middle, const float* __restrict b,
             const float* __restrict far, float whole, int n, float* __restrict out) {
  constexpr float kNinth = 1.0f / 9;
  for (int x = 0; x < n; ++x) out[x] = kNinth * (a[x] + middle[x] + b[x]) + far[x] + whole;
}

// Mean of value(row, cell) over 3 x 3.
template <class Value>
inline float mean9(Value value, int x) {
  constexpr float kNinth = 1.0f / 9;
  const auto three = [&](int row) { return value(row, x - 1) + value(row, x) + value(row, x + 1); };
  return kNinth * (three(0) + three(1) + three(2));
}

// Cells of three rows; with `kEdge` zeros to the left and right.
template <bool kEdge>
struct Cells {
  const float* __restrict above, * __restrict middle, * __restrict below;
  int width;
  Cells(const RowsAround& rows, int w)
      : above(rows.above), middle(rows.middle), below(rows.below), width(w) {}
  float operator()(int row, int x) const {
    if (kEdge && (x < 0 || x >= width)) return 0;
    return row == 0 ? above[x] : row == 1 ? middle[x] : below[x];
  }
};

// Calls `inside(x)` for the cells that have neighbours on both sides, `edge(x)` for the others.
template <class Inside, class Edge>
inline void each_cell(int width, int begin, int end, Inside inside, Edge edge) {
  if (begin == 0 && end > 0) edge(0);
  if (end == width && width > 1 && begin < end) edge(width - 1);
  const int last = std::min(end, width - 1);
  for (int x = std::max(begin, 1); x < last; ++x) inside(x);
}

void blur3(const RowsAround& in, int width, int begin, int end, float* __restrict out) {
  const Cells<false> cells(in, width);
  const Cells<true> padded(in, width);
  each_cell(
      width, begin, end, [&](int x) { out[x] = mean9(cells, x); },
      [&](int x) { out[x] = mean9(padded, x); });
}

template <class Value>
inline float gain_at(const Value& a, const Value& g, int x) {
  constexpr float kRidge = 1e-4f;
  const float mean_a = mean9(a, x);
  const float mean_g = mean9(g, x);
  const float both = mean9([&](int row, int i) { return a(row, i) * g(row, i); }, x);
  const float square = mean9([&](int row, int i) { return g(row, i) * g(row, i); }, x);
  return (both - mean_a * mean_g) / (larger_of(square - mean_g * mean_g, 0) + kRidge);
}

void gain(const RowsAround& a, const RowsAround& g, int width, int begin, int end,
          float* __restrict out) {
  const Cells<false> alpha(a, width), guide(g, width);
  const Cells<true> padded_alpha(a, width), padded_guide(g, width);
  each_cell(
      width, begin, end, [&](int x) { out[x] = gain_at(alpha, guide, x); },
      [&](int x) { out[x] = gain_at(padded_alpha, padded_guide, x); });
}

void gamut_bound(ConstPlanes frame, ConstPlanes plate, ConstPlanes noise, std::size_t n,
                 float* __restrict bound) {
  const float* __restrict c0 = frame[0];
  const float* __restrict c1 = frame[1];
  const float* __restrict c2 = frame[2];
  const float* __restrict b0 = plate[0];
  const float* __restrict b1 = plate[1];
  const float* __restrict b2 = plate[2];
  const float* __restrict s0 = noise[0];
  const float* __restrict s1 = noise[1];
  const float* __restrict s2 = noise[2];
  const auto least = [](float c, float b, float s) {
    const float d = c - b;
    const float sure = magnitude(d) - 2 * s;
    const float room = d > 0 ? 1 - b : b;
    return larger_of(sure, 0) / larger_of(room, 1e-4f);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const float r = least(c0[i], b0[i], s0[i]);
    const float g = least(c1[i], b1[i], s1[i]);
    const float b = least(c2[i], b2[i], s2[i]);
    bound[i] = smaller(larger_of(larger_of(r, g), b), 1);
  }
}

inline float key_of(float main, float one, float two, bool single) {
  return single ? main - larger_of(one, two) : smaller(one, two) - main;
}

template <bool kSingle>
void key_share_of(ConstPlanes frame, ConstPlanes plate, KeyShape shape, std::size_t n,
                  float* __restrict share) {
  const float* __restrict cm = frame[shape.main];
  const float* __restrict c1 = frame[shape.one];
  const float* __restrict c2 = frame[shape.two];
  const float* __restrict bm = plate[shape.main];
  const float* __restrict b1 = plate[shape.one];
  const float* __restrict b2 = plate[shape.two];
  for (std::size_t i = 0; i < n; ++i) {
    const float key = key_of(bm[i], b1[i], b2[i], kSingle);
    const float v = 1 - key_of(cm[i], c1[i], c2[i], kSingle) / larger_of(key, 0.02f);
    const float dm = cm[i] - bm[i];
    const float d1 = c1[i] - b1[i];
    const float d2 = c2[i] - b2[i];
    const float away = std::sqrt(dm * dm + d1 * d1 + d2 * d2);
    share[i] = key > 0.02f ? v : away;
  }
}

void key_share(ConstPlanes frame, ConstPlanes plate, KeyShape shape, std::size_t n, float* share) {
  if (shape.single)
    key_share_of<true>(frame, plate, shape, n, share);
  else
    key_share_of<false>(frame, plate, shape, n, share);
}

void distance(ConstPlanes frame, ConstPlanes plate, std::size_t n, float* __restrict out) {
  const float* __restrict c0 = frame[0];
  const float* __restrict c1 = frame[1];
  const float* __restrict c2 = frame[2];
  const float* __restrict b0 = plate[0];
  const float* __restrict b1 = plate[1];
  const float* __restrict b2 = plate[2];
  for (std::size_t i = 0; i < n; ++i) {
    const float r = c0[i] - b0[i];
    const float g = c1[i] - b1[i];
    const float b = c2[i] - b2[i];
    out[i] = std::sqrt(r * r + g * g + b * b);
  }
}

void score(const ScoreRow& row, std::size_t n, std::uint8_t* __restrict sure,
           std::uint8_t* __restrict likely) {
  const float* __restrict key = row.key;
  const float* __restrict bound = row.bound;
  const std::uint8_t* __restrict region = row.region;
  const float inverse = row.inverse;
  const float most = row.sure;
  const float enough = row.likely;
  for (std::size_t i = 0; i < n; ++i) {
    const float s = larger_of(key[i] * inverse, 1.15f * bound[i]);
    const int in = region[i];
    sure[i] = static_cast<std::uint8_t>(s > most ? in : 0);
    likely[i] = static_cast<std::uint8_t>(s > enough ? in : 0);
  }
}

void moments(const float* top_weight, const float* low_weight, ConstPlanes top, ConstPlanes low,
             int n, float* const (&out)[kMoments]) {
  constexpr int kRun = 64;
  float sum[kMoments][kRun];
  for (int first = 0; first < n; first += kRun) {
    const int count = std::min(kRun, n - first);
    const auto add = [&](const float* __restrict weight, const float* __restrict r,
                         const float* __restrict g, const float* __restrict b, auto more) {
      const auto into = [more](float& to, float v) { to = more ? to + v : v; };
      for (int i = 0; i < count; ++i) {
        const float w = 0.25f * weight[i];
        const float wr = w * r[i];
        const float wg = w * g[i];
        const float wb = w * b[i];
        into(sum[0][i], w);
        into(sum[1][i], wr);
        into(sum[2][i], wg);
        into(sum[3][i], wb);
        into(sum[4][i], wr * r[i]);
        into(sum[5][i], wr * g[i]);
        into(sum[6][i], wr * b[i]);
        into(sum[7][i], wg * g[i]);
        into(sum[8][i], wg * b[i]);
        into(sum[9][i], wb * b[i]);
      }
    };
    add(top_weight + first, top[0] + first, top[1] + first, top[2] + first, std::false_type{});
    if (low_weight)
      add(low_weight + first, low[0] + first, low[1] + first, low[2] + first, std::true_type{});
    if (count % 2)
      for (auto& row : sum) row[count] = 0;
    for (int k = 0; k < kMoments; ++k) {
      float* __restrict o = out[k] + first / 2;
      for (int i = 0; i < (count + 1) / 2; ++i) o[i] = sum[k][2 * i] + sum[k][2 * i + 1];
    }
  }
}

void double_row(const float* __restrict first, float a, const float* __restrict second, float b,
                int n, float* __restrict out) {
  const auto mixed = [=](int i) { return a * first[i] + b * second[i]; };
  out[0] = mixed(0);
  out[2 * n - 1] = mixed(n - 1);
  int i = 0;
#if HWY_TARGET != HWY_SCALAR
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<float, 16> d;
  const int step = static_cast<int>(hn::Lanes(d));
  const auto set = [d](float v) { return hn::Set(d, v); };
  const auto mix = [&](int at) {
    return hn::Add(hn::Mul(set(a), hn::LoadU(d, first + at)),
                   hn::Mul(set(b), hn::LoadU(d, second + at)));
  };
  if (n > step)
    for (; i + 1 < n; i += step) {
      const int at = std::min(i, n - 1 - step);  // the last ones with some of those before
      const auto left = mix(at);
      const auto right = mix(at + 1);
      hn::StoreInterleaved2(hn::Add(hn::Mul(set(0.75f), left), hn::Mul(set(0.25f), right)),
                            hn::Add(hn::Mul(set(0.25f), left), hn::Mul(set(0.75f), right)), d,
                            out + 2 * at + 1);
    }
#endif
  for (; i + 1 < n; ++i) {
    const float left = mixed(i);
    const float right = mixed(i + 1);
    out[2 * i + 1] = 0.75f * left + 0.25f * right;
    out[2 * i + 2] = 0.25f * left + 0.75f * right;
  }
}

// S = a^2 Sigma_F + gain sigma_n^2 I: u . adj(S) v, and the determinant.
struct Metric {
  float rr, rg, rb, gg, gb, bb, determinant;
};
inline Metric metric_of(const float (&c)[6], const float (&noise)[3], float a, float gain) {
  const float aa = a * a;
  const float s0 = aa * c[0] + gain * noise[0];
  const float s1 = aa * c[1];
  const float s2 = aa * c[2];
  const float s3 = aa * c[3] + gain * noise[1];
  const float s4 = aa * c[4];
  const float s5 = aa * c[5] + gain * noise[2];
  Metric m;
  m.rr = s3 * s5 - s4 * s4;
  m.rg = s2 * s4 - s1 * s5;
  m.rb = s1 * s4 - s2 * s3;
  m.gg = s0 * s5 - s2 * s2;
  m.gb = s1 * s2 - s0 * s4;
  m.bb = s0 * s3 - s1 * s1;
  m.determinant = s0 * m.rr + s1 * m.rg + s2 * m.rb;
  return m;
}
inline float product(const Metric& m, const float (&u)[3], const float (&v)[3]) {
  return u[0] * (m.rr * v[0] + m.rg * v[1] + m.rb * v[2]) +
         u[1] * (m.rg * v[0] + m.gg * v[1] + m.gb * v[2]) +
         u[2] * (m.rb * v[0] + m.gb * v[1] + m.bb * v[2]);
}

constexpr float kShading = 0.1f;  // relative sigma of the foreground's brightness
constexpr float kHue = 0.04f;     // sigma of its colour, relative to its luma
constexpr int kBlock = 16;        // cells projected together

// The means, then two rounds of the projection from alpha = 1/2.
template <bool kAlpha>
void project_block(const ProjectionRow& row, float spill, int at) {
  float mean_r[kBlock], mean_g[kBlock], mean_b[kBlock], alpha[kBlock], residual[kBlock];
  const float* const* m = row.moment;
  for (int k = 0; k < kBlock; ++k) {
    const int i = at + k;
    const float inverse = m[0][i] > 0 ? 1 / m[0][i] : 0.0f;
    const float pure[3] = {m[1][i] * inverse, m[2][i] * inverse, m[3][i] * inverse};
    const float plate[3] = {row.plate[0][i], row.plate[1][i], row.plate[2][i]};
    const float known = m[0][i] > 0 ? spill : 0.0f;
    mean_r[k] = pure[0] + known * plate[0];
    mean_g[k] = pure[1] + known * plate[1];
    mean_b[k] = pure[2] + known * plate[2];
    if constexpr (!kAlpha) continue;
    const float hue = kHue * (0.2126f * pure[0] + 0.7152f * pure[1] + 0.0722f * pure[2]);
    const float keep = kShading * kShading - 1;
    const float c[6] = {larger_of(m[4][i] * inverse + keep * pure[0] * pure[0], 0) + hue * hue,
                        m[5][i] * inverse + keep * pure[0] * pure[1],
                        m[6][i] * inverse + keep * pure[0] * pure[2],
                        larger_of(m[7][i] * inverse + keep * pure[1] * pure[1], 0) + hue * hue,
                        m[8][i] * inverse + keep * pure[1] * pure[2],
                        larger_of(m[9][i] * inverse + keep * pure[2] * pure[2], 0) + hue * hue};
    const float noise[3] = {row.noise[0][i] * row.noise[0][i], row.noise[1][i] * row.noise[1][i],
                            row.noise[2][i] * row.noise[2][i]};
    const float d[3] = {row.frame[0][i] - plate[0], row.frame[1][i] - plate[1],
                        row.frame[2][i] - plate[2]};
    const float f[3] = {mean_r[k] - plate[0], mean_g[k] - plate[1], mean_b[k] - plate[2]};
    float a = 0.5f;
    for (int round = 0; round < 2; ++round) {
      const Metric metric = metric_of(c, noise, a, 1);
      const float bottom = product(metric, f, f);
      const float top = product(metric, d, f);
      a = bounded(bottom > 0 ? top / bottom : 0.0f, 0.02f, 1);
    }
    a = larger_of(a, row.bound[i]);
    alpha[k] = a;
    const Metric wide = metric_of(c, noise, a, 9);
    const float left[3] = {d[0] - a * f[0], d[1] - a * f[1], d[2] - a * f[2]};
    residual[k] = wide.determinant > 0 ? product(wide, left, left) / wide.determinant : 0.0f;
  }
  int kind[kBlock];
  for (int k = 0; k < kBlock; ++k) kind[k] = row.mode[at + k];
  const auto put = [&kind](const float* __restrict made, int least, float* __restrict out) {
    for (int k = 0; k < kBlock; ++k) out[k] = kind[k] >= least ? made[k] : out[k];
  };
  put(mean_r, 1, row.mean[0] + at);
  put(mean_g, 1, row.mean[1] + at);
  put(mean_b, 1, row.mean[2] + at);
  if constexpr (kAlpha) {
    put(alpha, 2, row.alpha + at);
    if (row.residual) put(residual, 2, row.residual + at);
  }
}

bool modes(const std::uint8_t* __restrict seeds, const std::uint8_t* __restrict region,
           const std::uint8_t* __restrict means, std::size_t n, std::uint8_t* __restrict mode,
           float* __restrict alpha) {
  const std::uint8_t* __restrict wanted = means ? means : seeds;
  const int known = means ? 1 : 0;
  int most = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const int open = region[i] ? 2 : 0;
    const int m = seeds[i] ? known & wanted[i] : open;
    mode[i] = static_cast<std::uint8_t>(m);
    most |= m;
  }
  for (std::size_t i = 0; i < n; ++i) alpha[i] = seeds[i] ? 1.0f : 0.0f;
  return most != 0;
}

void set_sure(const std::uint8_t* __restrict seeds, std::size_t n, float* __restrict values) {
  for (std::size_t i = 0; i < n; ++i) values[i] = seeds[i] ? 1.0f : values[i];
}

void project(const ProjectionRow& row, float spill, int begin, int end, int n) {
  for (int at = begin; at < end;) {
    const int first = std::max(std::min(at, n - kBlock), 0);
    std::uint8_t most = 0;
    for (int k = 0; k < kBlock; ++k) most = std::max(most, row.mode[first + k]);
    if (most == 2)
      project_block<true>(row, spill, first);
    else if (most == 1)
      project_block<false>(row, spill, first);
    at += kBlock;
  }
}

constexpr float kBetter = 2;  // residual less that makes a colourless part sure
// Distance from grey over brightness from which a foreground is coloured, and surely is.
constexpr float kColored = 0.3f;
constexpr float kSurely = 0.5f;

void colorless(ConstPlanes frame, ConstPlanes plate, ConstPlanes noise, ConstPlanes mean,
               const float* __restrict bound, const float* __restrict residual, float most,
               std::size_t n, float* __restrict alpha, float* __restrict share) {
  const float* __restrict c0 = frame[0];
  const float* __restrict c1 = frame[1];
  const float* __restrict c2 = frame[2];
  const float* __restrict b0 = plate[0];
  const float* __restrict b1 = plate[1];
  const float* __restrict b2 = plate[2];
  const float* __restrict s0 = noise[0];
  const float* __restrict s1 = noise[1];
  const float* __restrict s2 = noise[2];
  const float* __restrict f0 = mean[0];
  const float* __restrict f1 = mean[1];
  const float* __restrict f2 = mean[2];
  for (std::size_t i = 0; i < n; ++i) {
    // Each less its grey: c and b meet where the part is colourless.
    const float bright = (f0[i] + f1[i] + f2[i]) * (1.0f / 3);
    const float seen = (c0[i] + c1[i] + c2[i]) * (1.0f / 3);
    const float behind = (b0[i] + b1[i] + b2[i]) * (1.0f / 3);
    const float fr = f0[i] - bright, fg = f1[i] - bright, fb = f2[i] - bright;
    const float cr = c0[i] - seen, cg = c1[i] - seen, cb = c2[i] - seen;
    const float br = b0[i] - behind, bg = b1[i] - behind, bb = b2[i] - behind;
    const float strength = larger_of(br * br + bg * bg + bb * bb, 1e-9f);
    const float left = bounded((cr * br + cg * bg + cb * bb) / strength, 0, 0.98f);
    const float r = cr - left * br, g = cg - left * bg, b = cb - left * bb;
    const float hue = kHue * (seen - left * behind);
    const float sigma = s0[i] * s0[i] + s1[i] * s1[i] + s2[i] * s2[i];
    const float odd = (r * r + g * g + b * b) / (3 * sigma + hue * hue + 1e-12f);
    const float away = std::sqrt(fr * fr + fg * fg + fb * fb) / larger_of(bright, 1e-3f);
    const float colored = bounded((away - kColored) / (kSurely - kColored), 0, 1);
    const float a = larger_of(1 - left, bound[i]);
    const float sure = colored * bounded((residual[i] - odd) / kBetter, 0, 1);
    alpha[i] = a;
    share[i] = a < most ? sure : 0;
  }
}

void weigh_rim(const std::uint8_t* __restrict seeds, const float* __restrict soft,
               const float* __restrict alpha, ConstPlanes frame, ConstPlanes plate, std::size_t n,
               float* __restrict weight, Planes color) {
  for (std::size_t i = 0; i < n; ++i) {
    const float rim = bounded((soft[i] - 0.6f) / 0.4f, 0, 1);
    weight[i] = seeds[i] ? 1.0f : rim;
  }
  for (int p = 0; p < 3; ++p) {
    const float* __restrict c = frame[p];
    const float* __restrict b = plate[p];
    float* __restrict o = color[p];
    for (std::size_t i = 0; i < n; ++i) {
      const float unmixed = b[i] + (c[i] - b[i]) / larger_of(alpha[i], 0.02f);
      o[i] = seeds[i] ? c[i] : bounded(unmixed, 0, 1);
    }
  }
}

void detail(const std::uint8_t* __restrict y, const float* __restrict light,
            const std::uint16_t* __restrict plate, const float* __restrict drift, int n,
            float* __restrict out, float* __restrict out_plate) {
  for (int i = 0; i < n; ++i) {
    const float below = static_cast<float>(plate[i]) * (1.0f / 65535) + drift[i];
    out_plate[i] = bounded(below, 0, 1);
    out[i] = light[y[i]] - out_plate[i];
  }
}

void luma_drift(const float* __restrict slope, const RowTerms (&drift)[3],
                const float (&weights)[3], int first, double step, int n, float* __restrict out) {
  const RowTerms red = drift[0], green = drift[1], blue = drift[2];
  const float wr = weights[0], wg = weights[1], wb = weights[2];
  for (int i = 0; i < n; ++i) {
    const float u = static_cast<float>(step * (first + i) - 1);
    const float r = red.a + u * (red.b + u * red.c);
    const float g = green.a + u * (green.b + u * green.c);
    const float b = blue.a + u * (blue.b + u * blue.c);
    const float both = slope[i] * (wr * r + wg * g + wb * b);
    out[2 * i] = both;
    out[2 * i + 1] = both;
  }
}

void halve(const float* __restrict top, const float* __restrict low, int n, float* __restrict out) {
  for (int i = 0; i < n; ++i)
    out[i] = 0.25f * (top[2 * i] + top[2 * i + 1] + low[2 * i] + low[2 * i + 1]);
}

void mark_inner(const std::uint8_t* __restrict some, const std::uint8_t* __restrict full,
                std::size_t n, std::uint8_t* __restrict inner, float* __restrict gain_of) {
  for (std::size_t i = 0; i < n; ++i) {
    const int in = full[i];
    inner[i] = static_cast<std::uint8_t>(some[i] ? in : 2);
  }
  for (std::size_t i = 0; i < n; ++i) gain_of[i] = inner[i] ? 0.0f : gain_of[i];
}

void raise_alpha(const AlphaRow& row, int n, std::uint8_t* __restrict out) {
  const float* __restrict alpha = row.alpha;
  const float* __restrict gain_of = row.gain;
  const float* __restrict guide = row.guide;
  const float* __restrict above_plate = row.detail;
  const float shade = row.shade;
  const float scale = 1 / (1 - shade);
  const float low = row.low;
  const float high = row.high;
  for (int i = 0; i < n; ++i) {
    const float a = alpha[i] + gain_of[i] * (above_plate[i] - guide[i]);
    float clear = (a - shade) * scale;
    clear = clear < low ? 0.0f : clear;
    clear = clear > high ? 1.0f : clear;
    out[i] = static_cast<std::uint8_t>(static_cast<int>(clear * 255 + 0.5f));
  }
}

void settle(const std::uint8_t* __restrict inner, int n, std::uint8_t* __restrict alpha) {
  for (int i = 0; i < n; ++i) {
    const int keep = inner[i] == 0 ? 255 : 0;
    const int set = inner[i] == 1 ? 255 : 0;
    const int left = (alpha[2 * i] & keep) | set;
    const int right = (alpha[2 * i + 1] & keep) | set;
    alpha[2 * i] = static_cast<std::uint8_t>(left);
    alpha[2 * i + 1] = static_cast<std::uint8_t>(right);
  }
}

template <bool kSingle>
void take_hue_out(KeyShape shape, ConstPlanes mean, const float* __restrict alpha,
                  const std::uint8_t* __restrict inner, std::size_t n, Planes own) {
  const float* __restrict mm = mean[shape.main];
  const float* __restrict m1 = mean[shape.one];
  const float* __restrict m2 = mean[shape.two];
  float* __restrict om = own[shape.main];
  float* __restrict o1 = own[shape.one];
  float* __restrict o2 = own[shape.two];
  for (std::size_t i = 0; i < n; ++i) {
    const float allowed = larger_of(key_of(mm[i], m1[i], m2[i], kSingle), 0);
    float excess = larger_of(key_of(om[i], o1[i], o2[i], kSingle) - allowed, 0);
    excess = inner[i] == 1 ? 0.0f : excess;
    excess = alpha[i] > 0 ? excess : 0.0f;
    if (kSingle) {
      om[i] = larger_of(om[i] - excess, 0);
    } else {
      o1[i] = larger_of(o1[i] - excess, 0);
      o2[i] = larger_of(o2[i] - excess, 0);
    }
  }
}

void own_color(const float* __restrict alpha, ConstPlanes frame, ConstPlanes plate,
               ConstPlanes mean, const std::uint8_t* inner, bool keyed, KeyShape shape,
               std::size_t n, Planes own) {
  for (int p = 0; p < 3; ++p) {
    const float* __restrict c = frame[p];
    const float* __restrict b = plate[p];
    const float* __restrict m = mean[p];
    float* __restrict o = own[p];
    for (std::size_t i = 0; i < n; ++i) {
      const float a = alpha[i];
      const float trust = a * a * a;
      const float unmixed = bounded(b[i] + (c[i] - b[i]) / larger_of(a, 1e-3f), 0, 1);
      const float f = (trust * unmixed + 0.05f * m[i]) / (trust + 0.05f);
      o[i] = a > 0 ? f : 0.0f;
    }
  }
  if (!keyed) return;
  if (shape.single)
    take_hue_out<true>(shape, mean, alpha, inner, n, own);
  else
    take_hue_out<false>(shape, mean, alpha, inner, n, own);
}

void encode_weighted(const float* __restrict weight, float* __restrict plane, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) plane[i] = weight[i] * encode(plane[i]);
}

// Four codes 0..255 as one word, which lanes store without shuffling bytes.
inline void store_rgba(int r, int g, int b, int a, std::uint8_t* rgba) {
  static_assert(std::endian::native == std::endian::little);
  const std::uint32_t word = static_cast<std::uint32_t>(r) | static_cast<std::uint32_t>(g) << 8 |
                             static_cast<std::uint32_t>(b) << 16 |
                             static_cast<std::uint32_t>(a) << 24;
  std::memcpy(rgba, &word, sizeof word);
}

void paint_filmed(const RgbOfYcc& m, const std::uint8_t* __restrict y,
                  const std::uint8_t* __restrict cb, const std::uint8_t* __restrict cr, int n,
                  std::uint8_t* __restrict rgba) {
  const int offset = 32768 - m.luma * m.black;
  const auto paint = [&](int i, int red, int green, int blue) {
    const int base = m.luma * y[i] + offset;
    const int r = std::min(std::max((base + red) >> 16, 0), 255);
    const int g = std::min(std::max((base + green) >> 16, 0), 255);
    const int b = std::min(std::max((base + blue) >> 16, 0), 255);
    store_rgba(r, g, b, 255, rgba + 4 * i);
  };
  const auto paint_cell = [&](int i, bool both) {
    const int u = cb[i] - 128;
    const int v = cr[i] - 128;
    const int red = m.red_of_cr * v;
    const int green = m.green_of_cb * u + m.green_of_cr * v;
    const int blue = m.blue_of_cb * u;
    paint(2 * i, red, green, blue);
    if (both) paint(2 * i + 1, red, green, blue);
  };
  for (int i = 0; i < n / 2; ++i) paint_cell(i, true);
  if (n % 2) paint_cell(n / 2, false);
}

// Brightness of the pixel itself, trusted as far as it is covered: what its luma is above that of
// the mixture expected.
void paint_own(const PaintRow& row, int n, std::uint8_t* __restrict rgba) {
  const float* __restrict weight = row.weight;
  const float* __restrict cr = row.color[0];
  const float* __restrict cg = row.color[1];
  const float* __restrict cb = row.color[2];
  const float* __restrict above_plate = row.detail;
  const float* __restrict plate = row.plate;
  const std::uint8_t* __restrict alpha = row.alpha;
  const float wr = row.red;
  const float wg = row.green;
  const float wb = row.blue;
  for (int i = 0; i < n; ++i) {
    const float inverse = 1 / larger_of(weight[i], 1e-4f);
    const float r = cr[i] * inverse;
    const float g = cg[i] * inverse;
    const float b = cb[i] * inverse;
    const float a = static_cast<float>(alpha[i]) * (1.0f / 255);
    // Luma is linear in encoded values, and light from there: (code / 255)^2.2 nearly.
    const float y = (wr * r + wg * g + wb * b) * (1.0f / 255);
    const float light = y * (0.012522878f + y * (0.682171111f + y * 0.305306011f));
    const float expected = larger_of(a * light + (1 - a) * plate[i], 0);
    const float seen = larger_of(plate[i] + above_plate[i], 0);
    const float lift = a * a * (encode(seen) - encode(expected));
    const int keep = alpha[i] ? -1 : 0;
    const auto code = [lift, keep](float v) {
      return static_cast<int>(bounded(v + lift + 0.5f, 0, 255)) & keep;
    };
    store_rgba(code(r), code(g), code(b), alpha[i], rgba + 4 * i);
  }
}

void cover(const std::uint8_t* __restrict top, const std::uint8_t* __restrict low, int n,
           std::uint8_t* __restrict some, std::uint8_t* __restrict half) {
  for (int i = 0; i < n; ++i) {
    const int sum = top[2 * i] + top[2 * i + 1] + low[2 * i] + low[2 * i + 1];
    some[i] = sum > 0 ? 1 : 0;
    half[i] = sum >= 510 ? 1 : 0;
  }
}

void name_pixels(const std::uint8_t* __restrict alpha, const int* __restrict label, int n,
                 std::uint8_t* __restrict out) {
  for (int i = 0; i < n; ++i) {
    const auto name = static_cast<std::uint8_t>(label[i]);
    const std::uint8_t left = alpha[2 * i] ? name : std::uint8_t{0};
    const std::uint8_t right = alpha[2 * i + 1] ? name : std::uint8_t{0};
    out[2 * i] = left;
    out[2 * i + 1] = right;
  }
}

std::uint32_t difference(const std::uint8_t* __restrict a, const std::uint8_t* __restrict b,
                         int n) {
  std::uint32_t sum = 0;
  for (int i = 0; i < n; ++i) sum += static_cast<std::uint32_t>(std::abs(a[i] - b[i]));
  return sum;
}

}  // namespace

const Lanes* get_lanes() {
  static constexpr Lanes kLanes = {
      count_different, sum_cells,   contrast,    look_up,         shift,        forgive_shadows,
      above,           spread_into, pack_bits,   unpack_bits,     sum5,         sum3,
      add_far,         blur3,       gamut_bound, key_share,       distance,     score,
      moments,         double_row,  project,     modes,           set_sure,     colorless,
      weigh_rim,       luma_drift,  detail,      halve,           gain,         mark_inner,
      raise_alpha,     settle,      own_color,   encode_weighted, paint_filmed, paint_own,
      cover,           name_pixels, difference};
  return &kLanes;
}

}  // namespace vsprite::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vsprite::detail {

HWY_EXPORT(get_lanes);

const Lanes& lanes() { return *HWY_DYNAMIC_DISPATCH(get_lanes)(); }

}  // namespace vsprite::detail
#endif
