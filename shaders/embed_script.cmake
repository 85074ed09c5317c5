# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT

# Run at build time by vsprite_embed_shaders: writes HEADER from SOURCES.
set(text "// Made by shaders/embed.cmake from shaders/${FOLDER}/.\n#pragma once\n\n#include <string_view>\n\n")
string(APPEND text "namespace vsprite::shaders::${FOLDER} {\n")
foreach(source IN LISTS SOURCES)
  get_filename_component(name ${source} NAME)
  string(REPLACE "." "_" name ${name})
  file(READ ${source} body)
  string(APPEND text "\ninline constexpr std::string_view ${name} = R\"glsl(${body})glsl\";\n")
endforeach()
string(APPEND text "\n}  // namespace vsprite::shaders::${FOLDER}\n")
file(CONFIGURE OUTPUT ${HEADER} CONTENT "\@text\@" @ONLY)
