# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT

# Its operator new and delete take from the caller's allocator (src/memory.h). For that the C++ library
# is linked into it; sanitizers want their own operator new and the shared C++ library.
add_library(vsprite_shared SHARED $<TARGET_OBJECTS:vsprite_core>)
add_library(vsprite::c ALIAS vsprite_shared)
set_target_properties(vsprite_shared PROPERTIES OUTPUT_NAME vsprite EXPORT_NAME c
  VERSION ${PROJECT_VERSION} SOVERSION 0 CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
  LINK_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/exports.map)
target_include_directories(vsprite_shared PRIVATE src)
target_link_libraries(vsprite_shared PRIVATE $<BUILD_INTERFACE:vsprite_flags> ${engine_libs})
if(CMAKE_SYSTEM_NAME STREQUAL Linux)
  target_link_options(vsprite_shared PRIVATE
    -Wl,--gc-sections,--version-script=${CMAKE_CURRENT_SOURCE_DIR}/exports.map)
endif()
if(CMAKE_SYSTEM_NAME STREQUAL Linux AND NOT VSPRITE_SANITIZE)
  target_sources(vsprite_shared PRIVATE src/memory_given.cpp)
  target_link_options(vsprite_shared PRIVATE -static-libstdc++ -static-libgcc)
else()
  target_sources(vsprite_shared PRIVATE src/memory_malloc.cpp)
endif()
target_sources(vsprite_shared PUBLIC FILE_SET HEADERS BASE_DIRS include FILES include/vsprite/c_api.h)
