// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/hdr.h - high dynamic range and wide colour (BT.2100, BT.2020) brought to plain video by one
// fixed curve, in integers.
//
//   code -> light of the display, white = 1   HLG: inverse OETF, then Ys^0.2 (a display of 1,000
//                                             cd/m2, BT.2100); PQ: its EOTF; white is 203 cd/m2
//                                             (BT.2408) in both. Plain BT.2020: as sRGB.
//   BT.2020 -> BT.709 primaries               BT.2087; what lies outside is cut off
//   knee                                      below 0.8 as it is; above, 1,000 cd/m2 becomes 1:
//                                             s = (x - 0.8) / 0.2, S = that of 1,000 cd/m2,
//                                             0.8 + 0.2 (s / (s + 1)) ((S + 1) / S)
//   light -> code                             sRGB, BT.709 matrix, 16..235
#pragma once

#include <cstddef>
#include <cstdint>

#include "film/video.h"

namespace vsprite::detail {

/// 10-bit Y'CbCr 4:2:0, strides in samples.
struct Planes10 {
  const std::uint16_t* y = nullptr;
  const std::uint16_t* cb = nullptr;
  const std::uint16_t* cr = nullptr;
  std::ptrdiff_t y_stride = 0, color_stride = 0;
};

/// Display light of a 10-bit code value on a grey, white = 65536.
std::int64_t light_of(Transfer transfer, int code, bool full_range);

/// Maps a frame of `out`'s size, coded as `coding` and `transfer`, into `out`, which becomes 8-bit
/// BT.709.
void map_to_sdr(const Planes10& in, Transfer transfer, const Coding& coding, Frame& out);

}  // namespace vsprite::detail
