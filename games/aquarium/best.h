// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// best.h - the best score, in a small text file of the player's own.
#pragma once

#include <string>

namespace aquarium {

/// $XDG_DATA_HOME/vsprite/aquarium.best, else ~/.local/share/...; empty if neither is set.
std::string best_score_path();

/// 0 if there is none or it makes no sense.
int load_best_score(const std::string& path);

/// Written beside the target, synced and renamed. A place that cannot be written is no error: the
/// score is then simply not kept.
void save_best_score(const std::string& path, int score);

}  // namespace aquarium
