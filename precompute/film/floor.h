// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/floor.h - the floor that a subject walks on, from what is known of it or from the film.
//
// On a floor a subject's size in the picture is k (y - h): in proportion to how far its feet lie
// below the horizon. So the sizes of all samples against their feet give a line that meets 0 at
// the horizon. The line is that of the median slope (Theil and Sen), which strides, crouches and
// jumps of single frames do not move.
#pragma once

#include <optional>
#include <span>

#include "vsprite/ground.h"

namespace vsprite {

/// What is known of the floor, film px. Given neither `horizon` nor `fitted`: there is none.
struct FloorChoice {
  std::optional<double> horizon;
  bool fitted = false;
  double line = 0;   ///< 0: the feet of the nearest sample
  double focal = 0;  ///< 0: 0.8 film widths, a phone's

  bool is_there() const { return fitted || horizon.has_value(); }
};

/// A place of the film on the floor, and the size there of what is 1 large on the ground line.
struct FloorPlace {
  double x = 0, y = 0;  ///< as vsprite/ground.h has it, film px of the ground line
  double scale = 1;
};
/// Pre: y is below the horizon.
FloorPlace on_floor(const Ground& ground, double x, double y);

/// One sight of the subject, film px.
struct Standing {
  double feet = 0;    ///< y
  double height = 0;  ///< or any other length of it: the square root of its area is steadier
};

/// Film px; `width` of the film. Pre: choice.is_there().
/// Errors: BadContent (nothing to fit: the subject keeps its size; feet above the horizon; a ground
/// line above it), naming what was found.
Result<Ground> find_floor(std::span<const Standing> sights, const FloorChoice& choice, int width);

}  // namespace vsprite
