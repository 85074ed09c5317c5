// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The matrices follow from the weights of red and blue in luma (ITU-T H.273, table 4):
//   R = Y + 2 (1 - kr) Cr,   B = Y + 2 (1 - kb) Cb,   G = (Y - kr R - kb B) / kg
#include "film/color.h"

#include <algorithm>

namespace vsprite {
namespace {

struct Weights {
  double red, blue;
};

Weights weights_of(Matrix matrix) {
  if (matrix == Matrix::Bt709) return {0.2126, 0.0722};
  if (matrix == Matrix::Bt2020) return {0.2627, 0.0593};
  return {0.299, 0.114};
}

int fixed(double v) { return static_cast<int>(v * 65536 + (v < 0 ? -0.5 : 0.5)); }

}  // namespace

RgbOfYcc rgb_of_ycc(const Coding& coding) noexcept {
  const auto [kr, kb] = weights_of(coding.matrix);
  const double kg = 1 - kr - kb;
  const double color = coding.full_range ? 1 : 255.0 / 224;
  RgbOfYcc m;
  m.black = coding.full_range ? 0 : 16;
  m.luma = fixed(coding.full_range ? 1 : 255.0 / 219);
  m.red_of_cr = fixed(2 * (1 - kr) * color);
  m.blue_of_cb = fixed(2 * (1 - kb) * color);
  m.green_of_cr = fixed(-2 * (1 - kr) * kr / kg * color);
  m.green_of_cb = fixed(-2 * (1 - kb) * kb / kg * color);
  return m;
}

std::array<int, 3> RgbOfYcc::sums(int y_sum, int cb, int cr, int scale) const noexcept {
  const int base = luma * (y_sum - scale * black) + 32768;
  const int u = scale * (cb - 128);
  const int v = scale * (cr - 128);
  const auto bounded = [scale](int value) { return std::clamp(value >> 16, 0, 255 * scale); };
  return {bounded(base + red_of_cr * v), bounded(base + green_of_cb * u + green_of_cr * v),
          bounded(base + blue_of_cb * u)};
}

YccOfRgb ycc_of_rgb(const Coding& coding) noexcept {
  const auto [kr, kb] = weights_of(coding.matrix);
  YccOfRgb m{};
  m.red = static_cast<float>(kr);
  m.blue = static_cast<float>(kb);
  m.green = static_cast<float>(1 - kr - kb);
  m.black = coding.full_range ? 0.0f : 16.0f;
  m.luma = coding.full_range ? 1.0f : 219.0f / 255;
  m.color = coding.full_range ? 1.0f : 224.0f / 255;
  return m;
}

std::array<std::uint8_t, 3> YccOfRgb::codes(float r, float g, float b) const noexcept {
  const float y = red * r + green * g + blue * b;
  const auto code = [](float v) {
    return static_cast<std::uint8_t>(std::clamp(v + 0.5f, 0.0f, 255.0f));
  };
  return {code(black + luma * y), code(128 + color * (b - y) / (2 - 2 * blue)),
          code(128 + color * (r - y) / (2 - 2 * red))};
}

std::array<std::uint8_t, 3> rgb_at(const Frame& frame, int x, int y) noexcept {
  const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                 static_cast<std::size_t>(x);
  const auto c = static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(frame.cell_width()) +
                 static_cast<std::size_t>(x / 2);
  const auto rgb = rgb_of_ycc(frame.coding).sums(frame.y[i], frame.cb[c], frame.cr[c], 1);
  return {static_cast<std::uint8_t>(rgb[0]), static_cast<std::uint8_t>(rgb[1]),
          static_cast<std::uint8_t>(rgb[2])};
}

Image to_image(const Frame& frame) {
  Image image{frame.width, frame.height, {}};
  image.rgba.reserve(4 * frame.y.size());
  const RgbOfYcc m = rgb_of_ycc(frame.coding);
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                     static_cast<std::size_t>(x);
      const auto c =
          static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(frame.cell_width()) +
          static_cast<std::size_t>(x / 2);
      for (const int value : m.sums(frame.y[i], frame.cb[c], frame.cr[c], 1))
        image.rgba.push_back(static_cast<std::uint8_t>(value));
      image.rgba.push_back(255);
    }
  return image;
}

Frame to_frame(ImageView image, int index, const Coding& coding) {
  Frame frame;
  frame.resize(image.width, image.height);
  frame.index = index;
  frame.coding = coding;
  frame.coding.siting = Siting::Center;
  const YccOfRgb to_ycc = ycc_of_rgb(coding);
  // The last pixel counts twice at an odd edge.
  std::size_t cell = 0;
  for (int cy = 0; cy < frame.cell_height(); ++cy)
    for (int cx = 0; cx < frame.cell_width(); ++cx, ++cell) {
      float sum[3] = {};
      for (int k = 0; k < 4; ++k) {
        const int x = std::min(2 * cx + k % 2, image.width - 1);
        const int y = std::min(2 * cy + k / 2, image.height - 1);
        const std::uint8_t* p = image.pixel(x, y);
        for (int c = 0; c < 3; ++c) sum[c] += p[c];
        frame.y[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                static_cast<std::size_t>(x)] = to_ycc.codes(p[0], p[1], p[2])[0];
      }
      const auto codes = to_ycc.codes(0.25f * sum[0], 0.25f * sum[1], 0.25f * sum[2]);
      frame.cb[cell] = codes[1];
      frame.cr[cell] = codes[2];
    }
  return frame;
}

}  // namespace vsprite
