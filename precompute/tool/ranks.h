// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/ranks.h - the search for pairs spread over the processes of `mpirun` (built with
// VSPRITE_MPI).
//
// Every process reads the work folder, which all must see. Process r finds the tiles t with
// t mod processes = r; the first one gathers them in their order, keeps them for a resumption, and
// does everything else. A tile does not depend on who finds it: the same bytes for any number.
#pragma once

#include <functional>

#include "tool/stages.h"

namespace vsprite {

/// Runs `first` in the first process, with a search that spreads over all of them; the others find
/// their tiles and return 0. Without `mpirun` this is `first({})`. `jobs`: threads of each process.
/// Errors: those of `first`; what another process could not read.
Result<int> run_over_ranks(const Result<std::string>& folder, int jobs,
                           const std::function<Result<int>(const PairSearch&)>& first);

}  // namespace vsprite
