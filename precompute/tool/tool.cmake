# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT

# The work folder and its stages, in the library, so that tests reach them without the program.
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(pugixml REQUIRED)
pkg_check_modules(TOOL_DEPS REQUIRED IMPORTED_TARGET libzstd libxxhash sqlite3)
find_path(TOMLPLUSPLUS_INCLUDE toml++/toml.h REQUIRED)  # header-only: the library is built with exceptions
target_sources(vsprite_precompute PRIVATE
  tool/atlas.cpp
  tool/budget.cpp
  tool/build_pack.cpp
  tool/cast.cpp
  tool/cast_file.cpp
  tool/control.cpp
  tool/files.cpp
  tool/export.cpp
  tool/export_films.cpp
  tool/export_sheets.cpp
  tool/film_report.cpp
  tool/keyed.cpp
  tool/label_store.cpp
  tool/label_session.cpp
  tool/labels.cpp
  tool/path_edit.cpp
  tool/points_edit.cpp
  tool/points_text.cpp
  tool/svg_points.cpp
  tool/page.cpp
  tool/path_film.cpp
  tool/path_script.cpp
  tool/pictures.cpp
  tool/played.cpp
  tool/preview.cpp
  tool/project.cpp
  tool/report.cpp
  tool/scene_script.cpp
  tool/segment.cpp
  tool/settings.cpp
  tool/shadows.cpp
  tool/tiles.cpp
  tool/stages.cpp
  tool/train.cpp
  tool/views_file.cpp
  tool/work_files.cpp
)
target_link_libraries(vsprite_precompute PUBLIC nlohmann_json::nlohmann_json PRIVATE PkgConfig::TOOL_DEPS
  pugixml::pugixml)

add_executable(vsprite
  tool/main.cpp
  tool/commands/build.cpp
  tool/commands/console.cpp
  tool/commands/doctor.cpp
  tool/commands/doctor_film.cpp
  tool/commands/dump.cpp
  tool/commands/export.cpp
  tool/commands/fit.cpp
  tool/commands/help.cpp
  tool/commands/inspect.cpp
  tool/commands/label.cpp
  tool/commands/loops.cpp
  tool/commands/parse.cpp
  tool/commands/train.cpp
  tool/commands/path.cpp
  tool/commands/path_scene.cpp
  tool/commands/path_window.cpp
  tool/commands/points.cpp
  tool/commands/report.cpp
)
target_link_libraries(vsprite PRIVATE vsprite_flags vsprite_precompute CLI11::CLI11 TBB::tbb)
if(TARGET vsprite_window)
  target_sources(vsprite PRIVATE tool/commands/play.cpp)
  target_compile_definitions(vsprite PRIVATE VSPRITE_WINDOW)
  target_link_libraries(vsprite PRIVATE vsprite_window)
endif()
if(VSPRITE_MPI)
  set(MPI_CXX_SKIP_MPICXX ON)
  find_package(MPI REQUIRED COMPONENTS CXX)
  target_sources(vsprite PRIVATE tool/ranks.cpp)
  target_compile_definitions(vsprite PRIVATE VSPRITE_MPI)
  target_link_libraries(vsprite PRIVATE MPI::MPI_CXX)
endif()
