// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Everything per pixel is a look into a table and a sum of products. The tables are made with a
// logarithm and an exponential of our own, because those of libm differ between machines.
#include "film/hdr.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace vsprite::detail {
namespace {

constexpr double kWhite = 203;   // cd/m2 of plain video's white
constexpr double kPeak = 1000;   // cd/m2 of the display that HLG is meant for
constexpr double kKnee = 0.8;    // of white
constexpr int kOne = 65536;      // white, in light
constexpr int kSteps = 4092;     // encoded R, G, B: 10 bits and two for the matrix's fractions
constexpr int kCoarse = 64;      // light a step of the table above white
constexpr int kCodeUnits = 256;  // of a code value of the plain picture

double log_of(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752) m *= 2, --exponent;
  const double s = (m - 1) / (m + 1);
  double term = s, sum = 0;
  for (int k = 1; k < 40; k += 2, term *= s * s) sum += term / k;
  return 2 * sum + exponent * 0.69314718055994531;
}

double exp_of(double x) {
  const double k = std::floor(x / 0.69314718055994531 + 0.5);
  const double r = x - k * 0.69314718055994531;
  double term = 1, sum = 1;
  for (int n = 1; n < 20; ++n) sum += term *= r / n;
  return std::ldexp(sum, static_cast<int>(k));
}

double power(double x, double y) { return x > 0 ? exp_of(y * log_of(x)) : 0; }

// cd/m2 of an encoded 0..1 (SMPTE ST 2084).
double pq_light(double encoded) {
  const double p = power(encoded, 32 / 2523.0);
  return 10000 * power(std::max(p - 0.8359375, 0.0) / (18.8515625 - 18.6875 * p), 8192 / 1305.0);
}

// Scene light 0..1 of an encoded 0..1 (ARIB STD-B67).
double hlg_scene(double encoded) {
  constexpr double a = 0.17883277, b = 0.28466892, c = 0.55991073;
  if (encoded <= 0.5) return encoded * encoded / 3;
  return (exp_of((encoded - c) / a) + b) / 12;
}

double srgb_light(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : power((encoded + 0.055) / 1.055, 2.4);
}

double srgb_code(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * power(light, 1 / 2.4) - 0.055;
}

double knee(double x) {
  if (x <= kKnee) return x;
  constexpr double most = (kPeak / kWhite - kKnee) / (1 - kKnee);
  const double s = (x - kKnee) / (1 - kKnee);
  return std::min(kKnee + (1 - kKnee) * s / (s + 1) * (most + 1) / most, 1.0);
}

int whole(double x) { return static_cast<int>(x + 0.5); }

// Encoded steps -> light; for HLG the light of the scene, 65536 = all of it.
const std::array<std::int32_t, kSteps + 1>& light_table(Transfer transfer) {
  const auto made = [](double (*light)(double)) {
    std::array<std::int32_t, kSteps + 1> table{};
    for (int i = 0; i <= kSteps; ++i)
      table[static_cast<std::size_t>(i)] = whole(kOne * light(i / double{kSteps}));
    return table;
  };
  if (transfer == Transfer::Pq) {
    static const auto table = made([](double v) { return pq_light(v) / kWhite; });
    return table;
  }
  if (transfer == Transfer::Hlg) {
    static const auto table = made(hlg_scene);
    return table;
  }
  static const auto table = made(srgb_light);
  return table;
}

// The display's gain on an HLG scene of luminance i / 65536: light = scene * gain / 65536.
const std::vector<std::int32_t>& hlg_gain() {
  static const std::vector<std::int32_t> table = [] {
    std::vector<std::int32_t> made;
    for (int i = 0; i <= kOne; ++i)
      made.push_back(whole(kOne * (kPeak / kWhite) * power(i / double{kOne}, 0.2)));
    return made;
  }();
  return table;
}

// Light -> encoded plain video, in kCodeUnits: fine up to white, coarse above.
struct Encoder {
  std::vector<std::uint16_t> fine, coarse;
  Encoder() {
    const auto code = [](double light) {
      return static_cast<std::uint16_t>(whole(255.0 * kCodeUnits * srgb_code(knee(light))));
    };
    for (int i = 0; i <= kOne; ++i) fine.push_back(code(i / double{kOne}));
    for (int i = 0; i <= (50 - 1) * kOne / kCoarse; ++i)
      coarse.push_back(code(1 + i * double{kCoarse} / kOne));
  }
  int operator()(std::int64_t light) const {
    if (light <= 0) return 0;
    if (light <= kOne) return fine[static_cast<std::size_t>(light)];
    const auto step = static_cast<std::size_t>((light - kOne) / kCoarse);
    return coarse[std::min(step, coarse.size() - 1)];
  }
};

const Encoder& encoder() {
  static const Encoder made;
  return made;
}

// 10-bit Y'CbCr -> encoded steps, in 1/65536; BT.2020 or whatever the film says.
struct Decoder {
  int black, luma, red_of_cr, green_of_cb, green_of_cr, blue_of_cb;
};

Decoder decoder_of(const Coding& coding) {
  const double kr = coding.matrix == Matrix::Bt2020  ? 0.2627
                    : coding.matrix == Matrix::Bt709 ? 0.2126
                                                     : 0.299;
  const double kb = coding.matrix == Matrix::Bt2020  ? 0.0593
                    : coding.matrix == Matrix::Bt709 ? 0.0722
                                                     : 0.114;
  const double y = kSteps / (coding.full_range ? 1023.0 : 876.0);
  const double c = kSteps / (coding.full_range ? 1023.0 : 896.0);
  const auto fixed = [](double v) { return static_cast<int>(v * 65536 + (v < 0 ? -0.5 : 0.5)); };
  return {coding.full_range ? 0 : 64,
          fixed(y),
          fixed(2 * (1 - kr) * c),
          fixed(-2 * (1 - kb) * kb / (1 - kr - kb) * c),
          fixed(-2 * (1 - kr) * kr / (1 - kr - kb) * c),
          fixed(2 * (1 - kb) * c)};
}

using Light = std::array<std::int64_t, 3>;

// What the display shows of encoded steps, in its own primaries.
Light display_light(Transfer transfer, const std::array<std::int32_t, kSteps + 1>& table,
                    const std::array<int, 3>& encoded) {
  Light light;
  for (std::size_t c = 0; c < 3; ++c)
    light[c] = table[static_cast<std::size_t>(std::clamp(encoded[c], 0, kSteps))];
  if (transfer != Transfer::Hlg) return light;
  const std::int64_t scene = (17217 * light[0] + 44433 * light[1] + 3886 * light[2]) >> 16;
  const std::int64_t gain =
      hlg_gain()[static_cast<std::size_t>(std::min<std::int64_t>(scene, kOne))];
  for (std::int64_t& l : light) l = (l * gain + kOne / 2) >> 16;
  return light;
}

// BT.2087, rows that sum to 16384.
Light to_bt709(const Light& l) {
  return {(27205 * l[0] - 9627 * l[1] - 1194 * l[2] + 8192) >> 14,
          (-2041 * l[0] + 18562 * l[1] - 137 * l[2] + 8192) >> 14,
          (-298 * l[0] - 1648 * l[1] + 18330 * l[2] + 8192) >> 14};
}

}  // namespace

std::int64_t light_of(Transfer transfer, int code, bool full_range) {
  const Decoder d = decoder_of({Matrix::Bt2020, full_range, Siting::Unknown});
  const int step = ((code - d.black) * d.luma + 32768) >> 16;
  return display_light(transfer, light_table(transfer), {step, step, step})[0];
}

void map_to_sdr(const Planes10& in, Transfer transfer, const Coding& coding, Frame& out) {
  const Decoder d = decoder_of(coding);
  const auto& table = light_table(transfer);
  const Encoder& encode = encoder();
  out.coding = {Matrix::Bt709, false, coding.siting};
  const int width = out.width, height = out.height;
  for (int cy = 0; cy < out.cell_height(); ++cy) {
    const std::uint16_t* cb = in.cb + cy * in.color_stride;
    const std::uint16_t* cr = in.cr + cy * in.color_stride;
    for (int cx = 0; cx < out.cell_width(); ++cx) {
      const int u = (cb[cx] & 1023) - 512, v = (cr[cx] & 1023) - 512;
      const int red = d.red_of_cr * v + 32768;
      const int green = d.green_of_cb * u + d.green_of_cr * v + 32768;
      const int blue = d.blue_of_cb * u + 32768;
      int sum[3] = {}, seen = 0;
      for (int k = 0; k < 4; ++k) {
        const int x = 2 * cx + k % 2, y = 2 * cy + k / 2;
        if (x >= width || y >= height) continue;
        const int base = d.luma * ((in.y[y * in.y_stride + x] & 1023) - d.black);
        const Light light = to_bt709(display_light(
            transfer, table, {(base + red) >> 16, (base + green) >> 16, (base + blue) >> 16}));
        int code[3];
        for (std::size_t c = 0; c < 3; ++c) sum[c] += code[c] = encode(light[c]);
        ++seen;
        // 0.2126, 0.7152 and 0.0722 of 219 / 255, in 1/65536.
        const std::int64_t luma = std::int64_t{11966} * code[0] + std::int64_t{40254} * code[1] +
                                  std::int64_t{4064} * code[2];
        out.y[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
              static_cast<std::size_t>(x)] =
            static_cast<std::uint8_t>(16 + ((luma + (1 << 23)) >> 24));
      }
      const std::size_t cell =
          static_cast<std::size_t>(cy) * static_cast<std::size_t>(out.cell_width()) +
          static_cast<std::size_t>(cx);
      const auto color = [&](std::int64_t r, std::int64_t g, std::int64_t b) {
        const std::int64_t value = (r * sum[0] + g * sum[1] + b * sum[2]) / seen;
        return static_cast<std::uint8_t>(
            std::clamp<std::int64_t>(128 + ((value + (1 << 23)) >> 24), 16, 240));
      };
      // (B - Y) / 1.8556 and (R - Y) / 1.5748 of 224 / 255.
      out.cb[cell] = color(-6596, -22189, 28785);
      out.cr[cell] = color(28784, -26145, -2639);
    }
  }
}

}  // namespace vsprite::detail
