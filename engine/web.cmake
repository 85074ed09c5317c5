# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT

# The same sources once more, by Emscripten: player.html and the games' pages, in share/vsprite beside
# the folder of the programs, where `vsprite export --to html` looks for them.
include(ExternalProject)
find_program(EMSCRIPTEN_COMPILER em++ REQUIRED)
find_file(EMSCRIPTEN_TOOLCHAIN Emscripten.cmake PATHS /usr/share/emscripten/cmake/Modules/Platform
  $ENV{EMSDK}/upstream/emscripten/cmake/Modules/Platform REQUIRED)
# Debian's emscripten finds node's own modules by NODE_PATH where node comes from elsewhere.
ExternalProject_Add(web
  SOURCE_DIR ${PROJECT_SOURCE_DIR} BINARY_DIR ${CMAKE_BINARY_DIR}/web
  CMAKE_GENERATOR ${CMAKE_GENERATOR}
  CMAKE_ARGS -DCMAKE_TOOLCHAIN_FILE=${EMSCRIPTEN_TOOLCHAIN} -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_RUNTIME_OUTPUT_DIRECTORY=${CMAKE_BINARY_DIR}/share/vsprite
    -DVSPRITE_PRECOMPUTE=OFF -DVSPRITE_TESTS=OFF -DVSPRITE_SHARED=OFF -DVSPRITE_INSTALL=OFF
    -DVSPRITE_PNG=OFF -DVSPRITE_SIMD=OFF -DVSPRITE_THREADS=OFF
  BUILD_COMMAND ${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs
    ${CMAKE_COMMAND} --build <BINARY_DIR> --target player aquarium hello
  BUILD_ALWAYS ON INSTALL_COMMAND "" USES_TERMINAL_BUILD ON)
install(FILES ${CMAKE_BINARY_DIR}/share/vsprite/player.html
  ${CMAKE_BINARY_DIR}/share/vsprite/aquarium.html DESTINATION share/vsprite COMPONENT tools)
