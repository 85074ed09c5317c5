// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// options.h - the options that only the aquarium has, taken out before the common ones are read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene.h"
#include "vsprite/result.h"

namespace aquarium {

inline constexpr const char* kOwnUsage =
    "\nonly here:\n"
    "  --size WxH       of the window, or of the film (1280x720)\n"
    "  --mute           without sound; M turns it on\n"
    "  --quality Q      low (400 lines), middle (540), high; auto: what the machine can keep up\n"
    "  --others N       fish that live by themselves, 2 to 6 (4)\n\n"
    "the pointer leads the fish while a button is held; P pause, M sound, F1 overlay\n";

struct Options {
  int width = 1280;
  int height = 720;
  bool mute = false;
  int others = 4;
  std::optional<Quality> quality;  ///< empty: automatic
  std::vector<char*> rest;         ///< the words that are not ours, the program's name first
};

/// Errors: BadSetting, naming the option.
vsprite::Result<Options> take_own_options(int argc, char** argv);

/// goldfish.vsp here, in build/, or beside or above the program; "build/goldfish.vsp" if nowhere.
std::string find_bundled_pack();

}  // namespace aquarium
