// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/measure_subject.h - what a screen's model has to know of the subject.
#pragma once

#include <span>

#include "film/plate.h"

namespace vsprite::detail {

/// Completes a model whose screen is measured: how strong the subject's colours are against the
/// key, how far it stands out, how large it is and, before a standing plate, which colours it has.
/// `frames`: those that the screen was measured on. On the threads of the arena that it is called
/// in; the result does not depend on them.
void measure_subject(std::span<const Frame> frames, ScreenModel& screen);

}  // namespace vsprite::detail
