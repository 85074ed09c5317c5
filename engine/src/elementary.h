// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// elementary.h - exp and log to about one unit in the last place, of additions and multiplications
// in a fixed order: libm's differ between CPUs, these do not.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace vsprite::detail {

/// Cephes' rational approximation on [-ln 2 / 2, ln 2 / 2]. 0 below -708, infinity above 709.
inline double portable_exp(double x) noexcept {
  if (std::isnan(x)) return x;
  if (x < -708) return 0;
  if (x > 709) return HUGE_VAL;
  const double n = std::floor(1.4426950408889634 * x + 0.5);
  x -= n * 6.93145751953125e-1;
  x -= n * 1.42860682030941723212e-6;
  const double xx = x * x;
  const double p = x * ((1.26177193074810590878e-4 * xx + 3.02994407707441961300e-2) * xx +
                        9.99999999999999999910e-1);
  const double q = ((3.00198505138664455042e-6 * xx + 2.52448340349684104192e-3) * xx +
                    2.27265548208155028766e-1) *
                       xx +
                   2.0;
  const auto exponent = static_cast<std::uint64_t>(static_cast<std::int64_t>(n) + 1023);
  return (1 + 2 * p / (q - p)) * std::bit_cast<double>(exponent << 52);
}

/// 2 artanh((m - 1) / (m + 1)) for the mantissa m in [sqrt(1/2), sqrt(2)). Pre: x > 0, finite.
inline double portable_log(double x) noexcept {
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752) {
    m *= 2;
    --exponent;
  }
  const double f = (m - 1) / (m + 1), ff = f * f;
  double sum = 0;
  for (int k = 23; k >= 3; k -= 2) sum = (sum + 1.0 / k) * ff;
  const double e = exponent;
  return e * 6.93145751953125e-1 + (2 * f * (1 + sum) + e * 1.42860682030941723212e-6);
}

}  // namespace vsprite::detail
