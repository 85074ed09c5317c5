# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT

# What a stranger gets: the installed tree and the packages.
if(NOT VSPRITE_INSTALL OR NOT TARGET vsprite OR NOT TARGET vsprite_shared OR NOT VSPRITE_DRAW OR VSPRITE_SANITIZE)
  return()
endif()
set(consumer_prefix ${CMAKE_CURRENT_BINARY_DIR}/installed)
foreach(kind install engine draw c pkgconfig)
  add_test(NAME consumer.${kind} COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/consumer_test.sh ${kind}
    ${PROJECT_BINARY_DIR} ${consumer_prefix} ${TINY_PACK})
  set_tests_properties(consumer.${kind} PROPERTIES LABELS "slow;consumer" TIMEOUT 300)
  if(NOT kind STREQUAL "install")
    set_tests_properties(consumer.${kind} PROPERTIES FIXTURES_REQUIRED "tiny_pack;installed")
  endif()
endforeach()
set_tests_properties(consumer.install PROPERTIES FIXTURES_SETUP installed)
set_tests_properties(consumer.draw PROPERTIES LABELS "slow;consumer;gl")
add_test(NAME consumer.package COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/package_test.sh
  ${PROJECT_BINARY_DIR} ${PROJECT_SOURCE_DIR})
set_tests_properties(consumer.package PROPERTIES LABELS "slow;consumer" TIMEOUT 900 SKIP_RETURN_CODE 77)
