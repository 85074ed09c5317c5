# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
target_sources(vsprite_precompute PRIVATE
  film/video.cpp
  film/source.cpp
  film/container.cpp
  film/hdr.cpp
  film/sender.cpp
  film/decoder.cpp
  film/color.cpp
  film/light.cpp
  film/lanes.cpp
  film/grid.cpp
  film/silhouette.cpp
  film/cut.cpp
  film/behind.cpp
  film/measure_subject.cpp
  film/plate.cpp
  film/unmix.cpp
  film/matte.cpp
  film/touch_up.cpp
  film/cast_shadow.cpp
  film/coverage.cpp
  film/subject.cpp
  film/extract.cpp
  film/floor.cpp
  film/match.cpp
  film/contact.cpp
  film/checkup.cpp
)

# Nobody reads errno after a square root, or traps on a comparison; without them the loops over cells
# become lanes. The results are the same bytes. The scope is that of precompute/, where these files
# are compiled.
set_source_files_properties(film/silhouette.cpp film/unmix.cpp film/matte.cpp film/grid.cpp
  film/lanes.cpp film/behind.cpp PROPERTIES COMPILE_OPTIONS "-fno-math-errno;-fno-trapping-math")
