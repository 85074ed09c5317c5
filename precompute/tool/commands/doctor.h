// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// commands/doctor.h - verdicts: a line each, with what to do about it.
#pragma once

#include <string>
#include <vector>

#include "tool/project.h"
#include "tool/settings.h"

namespace vsprite {

struct Finding {
  const char* name;   ///< what was looked at, for scripts: "camera", "light", "pack", ...
  const char* state;  ///< "ok", "warning" or "broken"
  std::string message;
  std::string remedy = {};  ///< empty where nothing is to be done
};
using Findings = std::vector<Finding>;

inline constexpr const char* kOk = "ok";
inline constexpr const char* kWarning = "warning";
inline constexpr const char* kBroken = "broken";

/// A film before it is built: looks at some hundred frames. `measures` receives the numbers.
void check_film(const Settings& settings, const std::string& path, Findings& findings,
                Json& measures);

}  // namespace vsprite
