# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
target_sources(vsprite_precompute PRIVATE
  control/actions.cpp
  control/action_bench.cpp
  control/advice.cpp
  control/bench.cpp
  control/choose.cpp
  control/flip.cpp
  control/follow_bench.cpp
  control/joint.cpp
  control/lanes.cpp
  control/loops.cpp
  control/solve.cpp
  control/reach.cpp
  control/response.cpp
  control/path_cost.cpp
  control/search.cpp
  control/replace.cpp
)
