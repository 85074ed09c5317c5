# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
target_sources(vsprite_precompute PRIVATE
  film/video.cpp
  film/plate.cpp
  film/matte.cpp
  film/extract.cpp
)
