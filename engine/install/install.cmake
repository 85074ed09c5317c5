# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT

# cmake --install and cpack. Three components, as Debian cuts packages: runtime (libvsprite.so.0), dev
# (headers, static libraries, CMake and pkg-config files) and tools (the program vsprite).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(here ${CMAKE_CURRENT_LIST_DIR})
set(cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/vsprite)

install(TARGETS vsprite_engine EXPORT vsprite-engine
  ARCHIVE COMPONENT dev FILE_SET HEADERS COMPONENT dev)
set(components engine)
if(TARGET vsprite_draw)
  install(TARGETS vsprite_draw EXPORT vsprite-draw
    ARCHIVE COMPONENT dev FILE_SET HEADERS COMPONENT dev)
  list(APPEND components draw)
endif()
if(TARGET vsprite_shared)
  install(TARGETS vsprite_shared EXPORT vsprite-c
    LIBRARY COMPONENT runtime NAMELINK_COMPONENT dev FILE_SET HEADERS COMPONENT dev)
  list(APPEND components c)
endif()
foreach(component ${components})
  install(EXPORT vsprite-${component} NAMESPACE vsprite:: DESTINATION ${cmake_dir} COMPONENT dev)
endforeach()

# What the static libraries need, by the names of pkg-config.
set(VSPRITE_ENGINE_NEEDS libxxhash)
if(VSPRITE_SIMD)
  list(APPEND VSPRITE_ENGINE_NEEDS libhwy)
endif()
if(VSPRITE_PNG)
  list(APPEND VSPRITE_ENGINE_NEEDS libpng)
endif()
set(VSPRITE_DRAW_NEEDS "")
if(VSPRITE_WINDOW)
  set(VSPRITE_DRAW_NEEDS sdl2)
endif()
configure_package_config_file(${here}/vspriteConfig.cmake.in ${PROJECT_BINARY_DIR}/vspriteConfig.cmake
  INSTALL_DESTINATION ${cmake_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/vspriteConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vspriteConfig.cmake ${PROJECT_BINARY_DIR}/vspriteConfigVersion.cmake
  DESTINATION ${cmake_dir} COMPONENT dev)

# vsprite_pc(NAME DESCRIPTION LIBRARY FURTHER-LIBS NEEDS...): wherever the tree is moved to.
file(RELATIVE_PATH VSPRITE_PC_PREFIX /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
function(vsprite_pc name description libs)
  string(REPLACE ";" ", " needs "${ARGN}")
  configure_file(${here}/vsprite.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
    COMPONENT dev)
endfunction()
set(threads "")
if(VSPRITE_THREADS)
  set(threads " -pthread")
endif()
vsprite_pc(vsprite "plays filmed characters (C++20, static)" "-lvsprite_engine${threads}"
  ${VSPRITE_ENGINE_NEEDS})
if(TARGET vsprite_draw)
  vsprite_pc(vsprite-draw "draws vsprite's characters with OpenGL (C++20, static)" -lvsprite_draw
    "vsprite = ${PROJECT_VERSION}" ${VSPRITE_DRAW_NEEDS})
endif()
if(TARGET vsprite_shared)
  vsprite_pc(vsprite-c "plays filmed characters (C, shared)" -lvsprite)
endif()

if(TARGET vsprite)
  install(TARGETS vsprite RUNTIME COMPONENT tools)
endif()
# One file of licences in each.
install(FILES ${PROJECT_SOURCE_DIR}/NOTICES DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libvsprite0
  RENAME copyright COMPONENT runtime)
install(FILES ${PROJECT_SOURCE_DIR}/NOTICES DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libvsprite-dev
  RENAME copyright COMPONENT dev)
install(FILES ${PROJECT_SOURCE_DIR}/NOTICES DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/vsprite-tools
  RENAME copyright COMPONENT tools)
include(${here}/packages.cmake)
