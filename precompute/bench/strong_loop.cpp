// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The rival of distance_bench, compiled as a careful user would: AVX2, FMA, sums in any order.
#include <cmath>

namespace vsprite::detail {

void strong_sums(const float* __restrict a, const float* __restrict b, int plane, float& color,
                 float& alpha) {
  float c = 0, l = 0;
#pragma omp simd reduction(+ : c, l)
  for (int p = 0; p < plane; ++p) {
    const float r = a[p + plane] - b[p + plane], g = a[p + 2 * plane] - b[p + 2 * plane];
    const float u = a[p + 3 * plane] - b[p + 3 * plane];
    c += (a[p] < b[p] ? a[p] : b[p]) * (r * r + g * g + u * u);
    l += std::fabs(a[p] - b[p]);
  }
  color = c, alpha = l;
}

}  // namespace vsprite::detail
