// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// capture/statistics.h - what the film holds, counted over the frames in which the fish is whole.
#pragma once

#include <array>
#include <string>

#include "goldfish.h"

namespace vsprite::capture {

struct FilmStatistics {
  int frames = 0, whole = 0, cut = 0, empty = 0;  ///< fish whole in the frame, cut by it, not there
  int entries = 0;                                ///< times that it comes (back) into the frame
  std::array<int, 8> sector{};                    ///< whole frames travelled in each compass sector
  int slow = 0;                                   ///< whole frames below 30 px/s
  std::array<double, 5> speed{};              ///< px/s at 5, 25, 50, 75, 95 % of the moving ones
  std::array<std::array<int, 9>, 9> turns{};  ///< changes of commanded heading; 8 is rest
  int facing_turns = 0;                       ///< half turns of yaw, left to right or back
  int towards_camera = 0;                     ///< those that show the face
  double fastest_pitch = 0;                   ///< degrees a frame
};

FilmStatistics measure(const GoldfishFilm& film);

/// The same as a table.
std::string statistics_text(const GoldfishFilm& film);

}  // namespace vsprite::capture
