// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// capture/screen.h - the blue screen as a real one is, and the camera that films it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vec.h"
#include "vsprite/image.h"

namespace vsprite::capture {

/// (height, width, 3) linear R G B: grey-blue cloth, a soft hot spot, falling off to the corners.
std::vector<float> paint_screen(int width, int height, std::uint64_t seed);

/// Mean colour, linear.
Vec3 mean_colour(std::span<const float> plate);

/// The studio's light at a frame, 1 within half a percent.
float light_at(int frame);

/// Linear R G B (height, width, 3) to 8-bit sRGB with sensor noise of 2 to 3 code values. The noise
/// is a function of (seed, pixel) alone.
void expose(std::span<const float> linear, std::uint64_t seed, Image& out);

}  // namespace vsprite::capture
