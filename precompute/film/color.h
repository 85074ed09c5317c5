// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/color.h - from the planes of a film to encoded R, G, B and back, in integers.
#pragma once

#include <array>
#include <cstdint>

#include "film/video.h"
#include "vsprite/image.h"

namespace vsprite {

/// R, G, B = (luma (Y - black) + of_cb (Cb - 128) + of_cr (Cr - 128)) / 65536, code values 0..255.
struct RgbOfYcc {
  int black = 16;
  int luma = 76309;
  int red_of_cr = 104597, green_of_cb = -25675, green_of_cr = -53279, blue_of_cb = 132201;

  /// `scale` x R, G, B of a colour whose Y is given as a sum of `scale` values; 0..255 x scale.
  std::array<int, 3> sums(int y_sum, int cb, int cr, int scale) const noexcept;
};
RgbOfYcc rgb_of_ycc(const Coding& coding) noexcept;

/// Y, Cb, Cr of encoded R, G, B, 0..255 each, as code values of a film.
struct YccOfRgb {
  float red, green, blue;    ///< weights of luma, their sum is 1
  float black, luma, color;  ///< Y = black + luma y, Cb = 128 + color (b - y) / (2 - 2 blue)
  /// Rounded and bounded.
  std::array<std::uint8_t, 3> codes(float r, float g, float b) const noexcept;
};
YccOfRgb ycc_of_rgb(const Coding& coding) noexcept;

/// Encoded R, G, B at a pixel; a cell's colour is that of its four pixels.
std::array<std::uint8_t, 3> rgb_at(const Frame& frame, int x, int y) noexcept;
/// The whole frame, alpha 255.
Image to_image(const Frame& frame);
/// R, G, B to planes (alpha is ignored): a cell's colour is the mean of its pixels'.
Frame to_frame(ImageView image, int index = 0, const Coding& coding = {});

}  // namespace vsprite
