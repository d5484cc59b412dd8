# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# By Debian's Python, whose packages bring NumPy.
find_program(POSE_WALL_PEER_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH DOC "Python with Debian's packages")
add_test(NAME python.package
  COMMAND ${POSE_WALL_PEER_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/python/python_test.py ${PROJECT_SOURCE_DIR}
    $<TARGET_FILE:pose_wall_cli> $<TARGET_FILE:pose_wall_abi_layout>)
set_tests_properties(python.package PROPERTIES
  LABELS python TIMEOUT 600 SKIP_REGULAR_EXPRESSION "SKIPPED:"
  ENVIRONMENT "POSE_WALL_LIBRARY=$<TARGET_FILE:pose_wall_shared>")
