# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
target_sources(vsprite_precompute PRIVATE
  synthesis/delaunay.cpp
  synthesis/hyperbf.cpp
  synthesis/puppet_fit.cpp
  synthesis/rbf_fit.cpp
  synthesis/rbf_system.cpp
  synthesis/view_check.cpp
)
