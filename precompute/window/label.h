// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// label.h - the window behind `vsprite label`: a jump played over and over, the tool's guess beside
// it, and one key that agrees or one that does not.
#pragma once

#include <functional>
#include <string>

#include "tool/label_session.h"

namespace vsprite {

struct LabelWindowOptions {
  std::string bind{};        ///< other keys, see label_keys.h
  bool headless = false;     ///< draws into memory
  int frames = 0;            ///< pictures drawn until it ends; 0: until closed
  std::string screenshot{};  ///< PNG of the last picture; empty: none
  int width = 1280;          ///< desktop units
  int height = 760;
  /// Called when an answer is durable, with a line about it.
  std::function<void(const std::string&)> kept{};
};

/// Returns when the window was closed. Every answer was durable before the next pair appeared.
/// Errors: BadSetting (keys), Unavailable (no display: names --answers), CannotWrite (a full disk:
/// the window closes, what was acknowledged is kept), CorruptData (a picture).
Result<void> label_window(LabelSession& session, const LabelWindowOptions& options);

}  // namespace vsprite
