// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/flip.h - turning round by a mirror image, as every drawn game does.
//
// A film of a walk to the right, mirrored, also walks left, but no accepted transition joins the
// two: the walker never turned. With flips every sample i is paired with its own mirror image m(i)
// at a set distance p, so that the transition rule gives
//
//     T(i -> m(i+1)) = (D(i, m(i)) + D(i+1, m(i+1))) / 2 = p
//
// and everything after it treats the flip as the jump that it is.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "similarity/distance.h"
#include "similarity/features.h"
#include "similarity/transitions.h"

namespace vsprite {

/// Adds a pair (i, m(i)) of distance `price` for every mirrored sample, or lowers the one that
/// there is. `pairs` stays ascending by (i, j). `price`: 0..1, in units of the threshold.
void add_flips(std::span<const SampleRow> rows, float price, std::vector<PairDistance>& pairs);

/// True if the film itself turns round: some kept sample's mirror image was kept too, so a way of
/// accepted transitions joins the two.
bool turns_by_itself(std::span<const SampleRow> rows, std::span<const std::uint8_t> kept);

}  // namespace vsprite
