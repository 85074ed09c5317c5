# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT

# vsprite_embed_shaders(TARGET DIR): every DIR/<name>.vert and .frag becomes a string_view
# vsprite::shaders::<folder>::<name>_vert / <name>_frag in the generated header "shaders/<folder>.h".
set(VSPRITE_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_script.cmake CACHE INTERNAL "")
function(vsprite_embed_shaders target dir)
  get_filename_component(folder ${dir} NAME)
  file(GLOB sources CONFIGURE_DEPENDS ${dir}/*.vert ${dir}/*.frag)
  set(header ${CMAKE_CURRENT_BINARY_DIR}/embedded/shaders/${folder}.h)
  add_custom_command(OUTPUT ${header}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${folder} "-DSOURCES=${sources}" -DHEADER=${header}
      -P ${VSPRITE_EMBED_SCRIPT}
    DEPENDS ${sources} ${VSPRITE_EMBED_SCRIPT} VERBATIM
    COMMENT "embedding the shaders of ${folder}")
  target_sources(${target} PRIVATE ${header})
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/embedded)
endfunction()
