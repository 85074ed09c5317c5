// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// capture/choreography.h - where the fish swims, frame by frame.
//
// The film is a chain of legs. A leg turns the fish to a new heading (pitch and, where it has to
// face the other way, yaw in three dimensions), then swims on in bursts and glides. The next
// heading is the one whose turn and whose sector have been filmed least, among those for which
// there is room. Now and then the fish rests, or leaves the picture and comes back.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "goldfish.h"

namespace vsprite::capture {

struct ChoreographyConfig {
  int frames = 6720;  ///< length of the film
  double fps = 30;
  double width = 640;    ///< px
  double height = 480;   ///< px
  double nose = 55;      ///< px from the body's centre to the nose
  double tail = 108;     ///< px from the body's centre to the tips of the tail
  double margin = 26;    ///< px from that line to back and belly
  int rest_every = 8;    ///< legs between pauses
  int leave_every = 30;  ///< legs between exits
  std::uint64_t seed = 66;
};

inline constexpr int kRest = 8;  ///< index of rest in `Choreography::turns`

struct Choreography {
  std::vector<FishPose> poses;                ///< (frames)
  std::array<std::array<int, 9>, 9> turns{};  ///< legs from heading a to heading b
  int exits = 0;
};

/// The same config gives the same film.
Choreography choreograph(const ChoreographyConfig& config);

}  // namespace vsprite::capture
