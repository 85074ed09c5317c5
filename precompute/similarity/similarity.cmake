# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
target_sources(vsprite_precompute PRIVATE
  similarity/features.cpp
  similarity/label.cpp
  similarity/ask.cpp
  similarity/classifier.cpp
  similarity/held_out.cpp
  similarity/distance.cpp
  similarity/transitions.cpp
)
