# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
include(${PROJECT_SOURCE_DIR}/shaders/embed.cmake)
pkg_check_modules(DRAW_DEPS REQUIRED IMPORTED_TARGET sdl2 epoxy)
add_library(vsprite_draw
  src/atlas.cpp src/draw.cpp src/draw_effect.cpp src/draw_text.cpp src/font.cpp src/gl.cpp
  src/sdl.cpp src/session.cpp)
add_library(vsprite::draw ALIAS vsprite_draw)
set_target_properties(vsprite_draw PROPERTIES EXPORT_NAME draw)
target_include_directories(vsprite_draw PRIVATE src)
target_link_libraries(vsprite_draw PUBLIC vsprite_engine
  PRIVATE $<BUILD_INTERFACE:vsprite_flags> PkgConfig::DRAW_DEPS)
target_sources(vsprite_draw PUBLIC FILE_SET HEADERS BASE_DIRS include FILES
  include/vsprite/draw.h include/vsprite/paint.h include/vsprite/sdl.h
  include/vsprite/session.h)
set_target_properties(vsprite_draw PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
vsprite_embed_shaders(vsprite_draw ${PROJECT_SOURCE_DIR}/shaders/sprite)
