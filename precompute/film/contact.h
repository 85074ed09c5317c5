// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/contact.h - pictures that show what the keyer made of a film.
#pragma once

#include <span>

#include "film/matte.h"
#include "film/video.h"
#include "vsprite/image.h"

namespace vsprite {

struct ContactConfig {
  int cell_width = 320;  ///< px, bound of one picture
  int cell_height = 240;
  /// A fourth picture in each row: the cut-out over this, which is stretched over the film's frame.
  /// Opaque; empty: no fourth picture.
  Image background;
  bool overview = false;  ///< before all others the whole frame, with the window marked
};

/// Rows of three: the film, the matte, the cut-out over a checkerboard; one row a frame, all cut to
/// the same window about the subject, the anchor marked on the matte. `frames` and `keyed` go
/// together, index by index.
Image make_contact_sheet(std::span<const Frame> frames, std::span<const KeyedFrame> keyed,
                         const ContactConfig& config = {});

/// A frame at most 640 px wide with a box about each part; the boxes are numbered from 1 where
/// there are several.
Image show_parts(const Frame& frame, std::span<const Blob> parts);

}  // namespace vsprite
