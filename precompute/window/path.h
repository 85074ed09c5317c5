// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// path.h - the window behind `vsprite path --window`: a path is drawn over the backdrop, and the
// sprite follows it while it is still being searched.
#pragma once

#include <functional>
#include <string>

#include "control/path_cost.h"
#include "tool/path_edit.h"
#include "tool/path_film.h"

namespace vsprite {

struct PathWindowOptions {
  std::string script{};  ///< what the path is saved to
  std::string head{};    ///< comments that stand before its points
  PathPicture picture{};
  const Backdrop* backdrop = nullptr;  ///< of the picture's size; null or empty: a plain ground
  PathWeights weights{};
  int beam = 50000;
  int jobs = 0;
  bool headless = false;     ///< draws into memory
  int frames = 0;            ///< pictures drawn until it ends; 0: until closed
  std::string screenshot{};  ///< PNG of the last picture; empty: none
  int width = 1280;          ///< desktop units
  int height = 760;
  /// Called when the path was saved, with a line about it.
  std::function<void(const std::string&)> saved{};
};

/// Returns when the window was closed. `edit` keeps what was drawn.
/// Errors: Unavailable (no display), CannotCreate, CannotWrite (the screenshot; a script that
/// cannot be saved is said in the window, which stays open), CorruptData.
Result<void> path_window(const Sprite& sprite, PathEdit& edit, const PathWindowOptions& options);

}  // namespace vsprite
