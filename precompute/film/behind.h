// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/behind.h - the plate behind a subject that stands in one place for most of the film.
//
// There the median over time shows the subject. Where more than a few samples differ from it, each
// cell has several colours that it may have when bare; the one is taken that continues what lies
// around the place and the cells beside it. A place that was never bare is filled in smoothly.
#pragma once

#include <vector>

#include "film/grid.h"

namespace vsprite::detail {

/// Corrects `centre` (of cells, R G B code values, medians of `grids` over time) where the subject
/// rests. `noise`: of bare samples, code values. True if anything changed. Cost: a
/// look at every sample, more for the cells in doubt. `invented`: 1 where it was filled in; empty
/// where nothing was looked for.
bool look_behind(const std::vector<Grid>& grids, float noise, std::vector<float> (&centre)[3],
                 Mask& invented);

}  // namespace vsprite::detail
