# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT

# vsprite_window - the windows of the tool; the one part of precompute that may link the renderer.
if(NOT VSPRITE_DRAW OR NOT VSPRITE_WINDOW)
  return()
endif()
# Debian's Dear ImGui holds its SDL2 and OpenGL 3 backends; their headers lie one folder deeper.
pkg_check_modules(WINDOW_DEPS REQUIRED IMPORTED_TARGET sdl2)
pkg_check_modules(IMGUI REQUIRED imgui)
find_path(IMGUI_BACKENDS imgui_impl_sdl.h PATHS ${IMGUI_INCLUDE_DIRS} PATH_SUFFIXES backends imgui/backends REQUIRED)
add_library(vsprite_window STATIC window/key.cpp window/key_job.cpp window/key_view.cpp window/label.cpp window/label_keys.cpp window/label_view.cpp
  window/overlay.cpp window/path.cpp window/path_search.cpp window/path_view.cpp window/play.cpp
  window/play_view.cpp window/points.cpp window/points_view.cpp window/puppet_preview.cpp)
target_include_directories(vsprite_window PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_include_directories(vsprite_window SYSTEM PRIVATE ${IMGUI_INCLUDE_DIRS} ${IMGUI_BACKENDS})
target_link_libraries(vsprite_window PUBLIC vsprite_engine vsprite_precompute
  PRIVATE $<BUILD_INTERFACE:vsprite_flags> vsprite_draw PkgConfig::WINDOW_DEPS ${IMGUI_LIBRARIES}
  ${CMAKE_DL_LIBS})
vsprite_embed_shaders(vsprite_window ${PROJECT_SOURCE_DIR}/shaders/play)
