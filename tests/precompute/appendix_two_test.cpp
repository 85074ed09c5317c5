// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Poggio & Brunelli 1992, Appendix 2: "is it possible to learn the movement of an object looking
// directly at the pixel level of the images?" No.
#include <gtest/gtest.h>

#include "support/wire_cube.h"

namespace vsprite {
namespace {

// Mean over the views half way between the examples.
wire_cube::Likeness mean_likeness(const RbfConfig& config, bool pixels) {
  const auto net = fit_rbf(wire_cube::examples(pixels), config);
  wire_cube::Likeness sum;
  const auto places = wire_cube::between();
  for (const auto& at : places) {
    const auto truth = wire_cube::draw(wire_cube::corners(at[0], at[1]));
    const auto found = wire_cube::predicted(*net, at);
    const auto one =
        wire_cube::compare(pixels ? found : wire_cube::draw(wire_cube::to_corners(found)), truth);
    sum.light += one.light / static_cast<double>(places.size());
    sum.correlation += one.correlation / static_cast<double>(places.size());
  }
  return sum;
}

TEST(AppendixTwo, NarrowGaussiansOverPixelsGoDarkBetweenTheViews) {
  const auto dark = mean_likeness({.kernel = Kernel::Gaussian, .degree = -1, .width = 0.1}, true);
  EXPECT_LT(dark.light, 0.3);
}

TEST(AppendixTwo, WideKernelsOverPixelsShowGhosts) {
  for (const RbfConfig& config :
       {RbfConfig{.kernel = Kernel::Gaussian, .degree = -1, .width = 0.35},
        RbfConfig{.kernel = Kernel::Multiquadric, .degree = 0, .width = 0.3},
        RbfConfig{.kernel = Kernel::ThinPlate}}) {
    const auto ghosts = mean_likeness(config, true);
    EXPECT_GT(ghosts.light, 0.7) << kernel_name(config.kernel);
    EXPECT_LT(ghosts.correlation, 0.7) << kernel_name(config.kernel);
  }
}

TEST(AppendixTwo, ControlPointsShowTheCube) {
  for (const RbfConfig& config :
       {RbfConfig{.kernel = Kernel::Gaussian, .degree = 1, .width = 0.7},
        RbfConfig{.kernel = Kernel::Multiquadric, .degree = 0, .width = 0.7},
        RbfConfig{.kernel = Kernel::ThinPlate}}) {
    const auto cube = mean_likeness(config, false);
    EXPECT_NEAR(cube.light, 1, 0.05) << kernel_name(config.kernel);
    EXPECT_GT(cube.correlation, 0.9) << kernel_name(config.kernel);
  }
}

}  // namespace
}  // namespace vsprite
