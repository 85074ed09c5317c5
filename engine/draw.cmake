# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
include(${PROJECT_SOURCE_DIR}/shaders/embed.cmake)

# The renderer: OpenGL by a loader, no library of any window system.
if(NOT EMSCRIPTEN)  # which has its own
  find_path(GL_HEADERS GL/glcorearb.h REQUIRED)
endif()
add_library(vsprite_draw
  src/atlas.cpp src/draw.cpp src/draw_actor.cpp src/draw_effect.cpp src/draw_puppet.cpp
  src/draw_text.cpp src/font.cpp src/gl.cpp)
add_library(vsprite::draw ALIAS vsprite_draw)
set_target_properties(vsprite_draw PROPERTIES EXPORT_NAME draw)
target_include_directories(vsprite_draw PRIVATE src)
if(GL_HEADERS)
  target_include_directories(vsprite_draw SYSTEM PRIVATE ${GL_HEADERS})
endif()
target_link_libraries(vsprite_draw PUBLIC vsprite_engine PRIVATE $<BUILD_INTERFACE:vsprite_flags>)
target_sources(vsprite_draw PUBLIC FILE_SET HEADERS BASE_DIRS include FILES
  include/vsprite/draw.h include/vsprite/paint.h)
set_target_properties(vsprite_draw PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
vsprite_embed_shaders(vsprite_draw ${PROJECT_SOURCE_DIR}/shaders/sprite)
vsprite_embed_shaders(vsprite_draw ${PROJECT_SOURCE_DIR}/shaders/puppet)

# Window, keys, sound: one file per platform.
if(VSPRITE_WINDOW AND EMSCRIPTEN)
  include(page.cmake)
  target_sources(vsprite_draw PRIVATE src/html5.cpp src/input_state.cpp src/session.cpp)
  target_sources(vsprite_draw PUBLIC FILE_SET HEADERS FILES
    include/vsprite/session.h include/vsprite/window.h)
elseif(VSPRITE_WINDOW)
  pkg_check_modules(VSPRITE_SDL2 REQUIRED IMPORTED_TARGET sdl2)
  target_sources(vsprite_draw PRIVATE src/input_state.cpp src/sdl.cpp src/sdl_pictures.cpp src/session.cpp)
  target_sources(vsprite_draw PUBLIC FILE_SET HEADERS FILES
    include/vsprite/sdl.h include/vsprite/session.h include/vsprite/window.h)
  target_link_libraries(vsprite_draw PRIVATE PkgConfig::VSPRITE_SDL2)
endif()
