// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/cast_shadow.h - the soft shadow that a subject casts on what is behind it.
//
// Where the plate lies in shade the film shows C = s B in linear light, every channel alike. The
// shade 1 - s is measured from means over neighbouring cells that the subject leaves free, and
// counts where it stands out of the plate's noise, keeps to that line, and belongs to a part that
// comes near the subject.
#pragma once

#include "film/matte.h"
#include "film/unmix.h"

namespace vsprite::detail {

/// Takes out of the matte what is shade beside the subject: a thin cover of nothing but plate in
/// shade, where the subject nearby is of another colour. A subject that is black, or as grey as its
/// background, tells it from its own soft edge by nothing, and keeps it.
void leave_to_shadow(Patch& patch);

/// Fills the shade of a frame whose parts have been found. Behind the subject it is carried on for
/// some cells, so that no light rim shows through a soft edge; further in it is 0. Cost: as many
/// cells as the subject and its neighbourhood have, some 100 ns each.
void measure_shadow(const ScreenModel& screen, const Frame& frame, KeyedFrame& keyed);

}  // namespace vsprite::detail
