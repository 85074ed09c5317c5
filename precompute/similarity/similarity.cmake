# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
target_sources(vsprite_precompute PRIVATE
  similarity/cells.cpp
  similarity/kernels.cpp
  similarity/features.cpp
  similarity/label.cpp
  similarity/ask.cpp
  similarity/classifier.cpp
  similarity/held_out.cpp
  similarity/distance.cpp
  similarity/transitions.cpp
  similarity/joins.cpp
)
# Highway: the kernels of all pairs, one copy for each instruction set.
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
target_link_libraries(vsprite_precompute PRIVATE PkgConfig::HWY)
