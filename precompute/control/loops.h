// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/loops.h - the best seamless loop of a wanted length: what engines want that only play.
//
// A loop is a closed walk s_0 -> s_1 -> ... -> s_m = s_0 over allowed samples that lasts n ticks.
// Its cost is the sum of T over its steps, 0 for the film's own continuation, and the cheapest is
// found exactly, by dynamic programming over the ticks from every sample s that a jump leads to,
//
//     C_0(s) = 0,    C_{t + d_i}(j) = min_i [C_t(i) + T_ij],    loop: C_n(s),
//
// d the durations. What already costs as much as the best loop so far is left out, which leaves the
// result as it is and most of the work undone. The walk may show a sample more than once.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vsprite/geometry.h"
#include "vsprite/result.h"
#include "vsprite/sprite.h"

namespace vsprite {

struct LoopLength {
  int least = 20;  ///< ticks, >= 1
  int most = 40;   ///< ticks, >= least
};

struct SeamlessLoop {
  std::vector<std::uint32_t> samples;  ///< in playing order; the dearest jump leads back to [0]
  int ticks = 0;                       ///< how long it lasts
  int jumps = 0;                       ///< steps that are not the film's own, >= 1
  double cost = 0;                     ///< sum of T
};

/// The cheapest loop over the samples with `allowed[i] != 0`, (N); of equally cheap ones the
/// shortest from the lowest sample. Empty: there is none of that length.
/// Cost: up to O(S n E) for S allowed samples with E transitions among them; on films, where most
/// is left out, some milliseconds.
std::optional<SeamlessLoop> find_loop(const Sprite& sprite,
                                      const std::vector<std::uint8_t>& allowed, LoopLength length);

/// Which samples travel a compass direction, within 22.5 degrees and at a quarter of the usual
/// speed; for Rest, which are slower than that. (N). Pre: not None.
std::vector<std::uint8_t> samples_towards(const Sprite& sprite, Direction direction);

/// How much the loop's jumps are seen: the mean difference of the two pictures across the worst
/// jump, anchor on anchor, over the median of the film's own steps in the loop. 1: as smooth as the
/// film. Differences are of premultiplied pixels over both pictures' boxes, and half a grey level
/// is added to both, so that a still film divides by no zero. Errors: those of decode_frame.
Result<double> measure_seam(const Sprite& sprite, const SeamlessLoop& loop);

}  // namespace vsprite
