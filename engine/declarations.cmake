# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT

# Run at build time: writes OUT, what vsprite_cdef() returns: the declarations of HEADER, without
# comments and macros.
cmake_policy(VERSION 3.25)
file(READ ${HEADER} text)
string(REGEX REPLACE "^.*up to the line \"end of the declarations\"\\. \\*/" "" text "${text}")
string(REGEX REPLACE "/\\* end of the declarations.*$" "" text "${text}")
string(REGEX REPLACE "/\\*[^*]*\\*+([^/*][^*]*\\*+)*/" "" text "${text}")
string(REPLACE "VSPRITE_API " "" text "${text}")
string(REGEX REPLACE "[ \t]*\n[ \t\n]*" "\n" text "${text}")
file(CONFIGURE OUTPUT ${OUT} CONTENT "// Made by engine/declarations.cmake from c_api.h.
#pragma once
namespace vsprite::detail {
inline constexpr char kDeclarations[] = R\"c(@text@)c\";
}
" @ONLY)
