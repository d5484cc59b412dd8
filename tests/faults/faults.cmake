# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# The steps of the engine and pthread_create go through the tests, which let them fail.
set(symbols_file ${CMAKE_CURRENT_LIST_DIR}/wrapped_symbols.txt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${symbols_file})
file(STRINGS ${symbols_file} rows REGEX "^[A-Z]")
set(header "#pragma once\n")
foreach(row IN LISTS rows)
  string(REPLACE " " ";" row "${row}")
  list(GET row 0 name)
  list(GET row 1 symbol)
  string(APPEND header "#define POSE_WALL_WRAPPED_${name} \"${symbol}\"\n")
  target_link_options(pose_wall_faults_tests PRIVATE "-Wl,--wrap=${symbol}")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/faults/wrapped_symbols.h CONTENT "${header}" @ONLY)
target_include_directories(pose_wall_faults_tests PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/faults)
target_link_libraries(pose_wall_faults_tests PRIVATE pose_wall_sim)

find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME faults.table_lists_the_cases
  COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_LIST_DIR}/case_table.py --check
  $<TARGET_FILE:pose_wall_faults_tests> ${CMAKE_CURRENT_LIST_DIR}/README.md)
set_tests_properties(faults.table_lists_the_cases PROPERTIES LABELS faults TIMEOUT 60)
