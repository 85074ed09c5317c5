// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// points.h - the window behind `vsprite points --window`: control points are placed over the views,
// and the character that they make moves beside them.
#pragma once

#include <functional>
#include <string>

#include "tool/points_edit.h"

namespace vsprite {

struct PointsWindowOptions {
  std::size_t first_sheet = 0;
  bool headless = false;     ///< draws into memory
  int frames = 0;            ///< pictures drawn until it ends; 0: until closed
  std::string screenshot{};  ///< PNG of the last picture; empty: none
  int width = 1280;          ///< desktop units
  int height = 760;
  /// Called when the points were saved, with a line about it.
  std::function<void(const std::string&)> saved{};
};

/// Returns when the window was closed. `edit` keeps what was placed.
/// Errors: Unavailable (no display), CannotCreate, CannotWrite (the screenshot; a file that cannot
/// be saved is said in the window, which stays open).
Result<void> points_window(PointsFile& file, PointsEdit& edit, const PointsWindowOptions& options);

}  // namespace vsprite
