# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
target_sources(vsprite_precompute PRIVATE
  film/video.cpp
  film/coded_size.cpp
  film/light.cpp
  film/grid.cpp
  film/silhouette.cpp
  film/plate.cpp
  film/unmix.cpp
  film/matte.cpp
  film/extract.cpp
  film/contact.cpp
)
