// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/coverage.h - films and pictures that bring their own alpha: nothing to key, parts to find.
#pragma once

#include <span>

#include "film/matte.h"

namespace vsprite::detail {

/// True where any of the frames is anywhere less than opaque.
bool carries_coverage(std::span<const Frame> frames);

/// The model of such frames: kind Alpha, and how far the anchor's mask is to be opened.
ScreenModel coverage_model(std::span<const Frame> frames);

/// The parts of `frame`, its pixels as they are. Alphas of 1 and 2 far from anything are noise.
/// Pre: frame.rgba is not empty.
void take_coverage(const Frame& frame, int opening, KeyedFrame& result);

}  // namespace vsprite::detail
