# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT

# player.html - `vsprite play` as a page: the template that `vsprite export --to html` puts packs into.
add_executable(player ${CMAKE_CURRENT_LIST_DIR}/player.cpp ${CMAKE_CURRENT_LIST_DIR}/play.cpp
  ${CMAKE_CURRENT_LIST_DIR}/play_view.cpp)
target_include_directories(player PRIVATE ${PROJECT_SOURCE_DIR}/precompute)
target_link_libraries(player PRIVATE vsprite_flags vsprite::draw)
vsprite_embed_shaders(player ${PROJECT_SOURCE_DIR}/shaders/play)
vsprite_page(player)
