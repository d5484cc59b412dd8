# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

find_package(Python3 REQUIRED COMPONENTS Interpreter)

# The steps of the engine and pthread_create go through the tests, which let them fail. Their symbols are looked up in
# the objects, so that no signature is written down twice.
set(wrapped ${CMAKE_CURRENT_BINARY_DIR}/faults)
file(MAKE_DIRECTORY ${wrapped})
set(objects "$<FILTER:$<TARGET_OBJECTS:pose_wall_objects>,EXCLUDE,cmake_pch>")
add_custom_command(OUTPUT ${wrapped}/wrapped_symbols.h ${wrapped}/wrapped_symbols.rsp
  COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_LIST_DIR}/wrapped_symbols.py ${CMAKE_NM}
          ${CMAKE_CURRENT_LIST_DIR}/wrapped_symbols.txt ${wrapped} "${objects}"
  DEPENDS ${CMAKE_CURRENT_LIST_DIR}/wrapped_symbols.py ${CMAKE_CURRENT_LIST_DIR}/wrapped_symbols.txt
          pose_wall_objects "${objects}"
  COMMENT "Looking up the steps that tests let fail"
  COMMAND_EXPAND_LISTS VERBATIM)
target_sources(pose_wall_faults_tests PRIVATE ${wrapped}/wrapped_symbols.h)
target_include_directories(pose_wall_faults_tests PRIVATE ${wrapped})
target_link_options(pose_wall_faults_tests PRIVATE "@${wrapped}/wrapped_symbols.rsp")
set_property(TARGET pose_wall_faults_tests APPEND PROPERTY LINK_DEPENDS ${wrapped}/wrapped_symbols.rsp)
target_link_libraries(pose_wall_faults_tests PRIVATE pose_wall_sim)

add_test(NAME faults.table_lists_the_cases
  COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_LIST_DIR}/case_table.py --check
  $<TARGET_FILE:pose_wall_faults_tests> ${CMAKE_CURRENT_LIST_DIR}/README.md)
set_tests_properties(faults.table_lists_the_cases PROPERTIES LABELS faults TIMEOUT 60)
