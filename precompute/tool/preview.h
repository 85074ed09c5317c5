// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/preview.h - what the keyer makes of a film, seen in seconds: no work folder, no sprites.
#pragma once

#include <string>

#include "tool/project.h"
#include "tool/settings.h"
#include "vsprite/image.h"

namespace vsprite {

/// settings.background as a picture: as it is, or one pixel of a colour. Errors: those of read_png.
Result<Image> background_of(const Settings& settings);

/// Keys settings.preview frames spread over `film` and writes them to the contact sheet `output`.
/// Returns the background's reason and a row a frame: film frame, parts, area, border.
/// Errors: those of sample_frames and measure_screen; of the background picture; CannotWrite.
Result<Json> preview_film(const Settings& settings, const std::string& film,
                          const std::string& output);

}  // namespace vsprite
