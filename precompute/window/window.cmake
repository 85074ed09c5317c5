# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT

# vsprite_window - the windows of the tool; the one part of precompute that may link the renderer.
if(NOT VSPRITE_DRAW)
  return()
endif()
add_library(vsprite_window STATIC window/play.cpp window/play_view.cpp)
target_include_directories(vsprite_window PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(vsprite_window PUBLIC vsprite_engine
  PRIVATE $<BUILD_INTERFACE:vsprite_flags> vsprite_draw)
vsprite_embed_shaders(vsprite_window ${PROJECT_SOURCE_DIR}/shaders/play)
