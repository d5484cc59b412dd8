# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# cmake -DPROGRAM=<file> [-DEMULATOR=<words>] -DEXPECTED=<file> -P check_abi.cmake
# Runs the program and compares what it prints with the file.
separate_arguments(EMULATOR)
execute_process(COMMAND ${EMULATOR} ${PROGRAM} OUTPUT_VARIABLE printed RESULT_VARIABLE status)
file(READ ${EXPECTED} expected)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "A public struct holds implicit padding (or the program failed, status ${status}):\n${printed}")
endif()
if(NOT printed STREQUAL expected)
  message(FATAL_ERROR "The public structs are laid out otherwise than ${EXPECTED} says. If that is meant, raise "
                      "POSE_WALL_ABI_VERSION and put this into the file:\n${printed}")
endif()
