// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// capture/raster.h - triangles to coverage and colour, averaged over pixel and shutter.
//
// Each of the shutter's moments is drawn with 2 x 2 samples a pixel, on grids shifted against one
// another. The body is drawn with a depth buffer, then the fins over it from back to front.
#pragma once

#include <vector>

#include "fish_model.h"
#include "skin.h"
#include "vec.h"
#include "vsprite/geometry.h"

namespace vsprite::capture {

/// Sums over all samples of a pixel, linear light, colour multiplied by alpha.
struct Coverage {
  Rect box;                   ///< film px, inside the frame; empty if nothing shows
  std::vector<float> alpha;   ///< (box) 0 .. 1
  std::vector<float> colour;  ///< (box, 3) alpha F
};

/// What surrounds the fish: light from above and in front, and the screen's own colour.
struct Surroundings {
  Vec3 screen{0.055f, 0.14f, 0.34f};  ///< linear R G B, the mean of the plate
  float light = 1;
};

/// Draws `moments` (one mesh each, in the order of time) into a frame of width x height.
void rasterize(const std::vector<Mesh>& moments, const Skin& skin, const Surroundings& around,
               int width, int height, Coverage& out);

}  // namespace vsprite::capture
