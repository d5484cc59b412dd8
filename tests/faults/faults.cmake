# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# The stages' entry points and pthread_create go through the tests, which let them fail.
set(symbols_file ${CMAKE_CURRENT_LIST_DIR}/wrapped_symbols.h)
file(STRINGS ${symbols_file} symbols REGEX "^#define POSE_WALL_WRAPPED_")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${symbols_file})
foreach(line IN LISTS symbols)
  string(REGEX REPLACE "^.*\"([^\"]+)\".*$" "\\1" symbol "${line}")
  target_link_options(pose_wall_faults_tests PRIVATE "-Wl,--wrap=${symbol}")
endforeach()
target_link_libraries(pose_wall_faults_tests PRIVATE pose_wall_sim)
