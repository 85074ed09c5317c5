// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// gl_stage.h - a renderer without a display for tests, and pictures to draw. Where no OpenGL
// context can be had the test is skipped, with the reason.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <random>

#include "vsprite/draw.h"
#include "vsprite/image.h"
#include "vsprite/window.h"

namespace vsprite::testing {

class GlTest : public ::testing::Test {
 protected:
  void SetUp() override { open({}); }
  void open(const RendererConfig& config) {
    renderer_.reset();
    window_.reset();
    const bool es = std::getenv("VSPRITE_TEST_ES") != nullptr;  // the same tests on OpenGL ES 3
    Result<Window> window = Window::open({.width = 320, .height = 240, .headless = true, .es = es});
    if (!window) GTEST_SKIP() << window.error().message;
    window_.emplace(std::move(*window));
    Result<Renderer> renderer = make_renderer(Window::gl_function, config);
    ASSERT_TRUE(renderer) << renderer.error().message;
    renderer_.emplace(std::move(*renderer));
    if (es) {
      ASSERT_EQ(renderer_->device().rfind("OpenGL ES", 0), 0u) << renderer_->device();
    }
  }
  Renderer& renderer() { return *renderer_; }

 private:
  std::optional<Window> window_;
  std::optional<Renderer> renderer_;
};

/// Noise with soft and hard edges, premultiplied.
inline Image noise_picture(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Image image{width, height, std::vector<std::uint8_t>(std::size_t(width * height) * 4)};
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const unsigned alpha = random() % 3 == 0 ? 255 : random() % 256;
    for (std::size_t c = 0; c < 3; ++c) {
      image.rgba[i + c] = static_cast<std::uint8_t>(random() % (alpha + 1));
    }
    image.rgba[i + 3] = static_cast<std::uint8_t>(alpha);
  }
  return image;
}

/// Largest difference of any channel; 999 if the sizes differ.
inline int largest_difference(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height) return 999;
  int most = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    most = std::max(most, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
  }
  return most;
}

inline std::uint32_t color_at(const Image& image, int x, int y) {
  const std::uint8_t* p = image.rgba.data() + (y * image.width + x) * 4;
  return static_cast<std::uint32_t>(p[0] << 16 | p[1] << 8 | p[2]);
}

}  // namespace vsprite::testing
