# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT

# vsprite_page(TARGET): the program becomes TARGET.html, one file with everything in it but the pack,
# which takes the place of @VSPRITE_PACK@ in base64. For builds by Emscripten.
set(VSPRITE_PAGE_SHELL ${CMAKE_CURRENT_LIST_DIR}/src/page.html CACHE INTERNAL "")
function(vsprite_page target)
  set_target_properties(${target} PROPERTIES SUFFIX .html LINK_DEPENDS ${VSPRITE_PAGE_SHELL})
  target_link_options(${target} PRIVATE
    --shell-file ${VSPRITE_PAGE_SHELL}
    -sSINGLE_FILE=1 -sENVIRONMENT=web -sMINIFY_HTML=0 -sFORCE_FILESYSTEM=1 -sEXIT_RUNTIME=1
    -sMIN_WEBGL_VERSION=2 -sMAX_WEBGL_VERSION=2
    -sALLOW_MEMORY_GROWTH=1 -sINITIAL_MEMORY=67108864
    # The game's loop waits in it for the next frame; no function on that way is called by pointer.
    -sASYNCIFY=1 -sASYNCIFY_IGNORE_INDIRECT=1 -sASYNCIFY_STACK_SIZE=65536
    -sEXPORTED_FUNCTIONS=_main,_malloc,_free)
endfunction()
