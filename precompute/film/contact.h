// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/contact.h - one picture that shows what the keyer made of a film.
#pragma once

#include <span>

#include "film/matte.h"
#include "film/video.h"
#include "vsprite/image.h"

namespace vsprite {

/// Rows of three: the film, the matte, the cut-out over a checkerboard; one row a frame, all cut to
/// the same window about the subject, the anchor marked on the matte. `frames` and `keyed` go
/// together, index by index. `cell_width` and `cell_height` bound one picture, px.
Image make_contact_sheet(std::span<const Frame> frames, std::span<const KeyedFrame> keyed,
                         int cell_width = 320, int cell_height = 240);

}  // namespace vsprite
