// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/ranks.h - a run spread over the processes of `mpirun` (built with VSPRITE_MPI).
//
// The first process runs the stages and alone writes and speaks. The others wait for its orders,
// and help with the search for pairs and with both solves:
//
//     pairs   process r finds the tiles t with t mod processes = r, from the work folder, which all
//             must see; the first gathers them in their order and keeps them for a resumption
//     solve   the first sends the problem; the blocks of headings are spread (control/spread.h)
//
// Neither a tile nor a block depends on who makes it: the same bytes for any number. mpirun ends
// all when one process fails; a failure that another process can foresee is the first's to report.
#pragma once

#include <functional>
#include <string>

#include "tool/stages.h"

namespace vsprite {

/// Runs `first` in the first process; the others do what it orders and return 0. Without `mpirun`
/// this is `first({})`. `jobs`: threads of each process, 0 = all that mpirun lets it have (it binds
/// processes to cores; with one process a machine use `--bind-to none`).
/// Errors: those of `first`; what another process could not read.
Result<int> run_over_ranks(const std::string& folder, int jobs,
                           const std::function<Result<int>(const Sharing&)>& first);

}  // namespace vsprite
