# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# cmake -DPROGRAM=<file> [-DEMULATOR=<words>] -DEXPECTED=<file> "-DHEADERS=<file>;..." -P check_abi.cmake
# Runs the program and compares what it prints with the file, which must hold every struct of the headers.
separate_arguments(EMULATOR)
execute_process(COMMAND ${EMULATOR} ${PROGRAM} OUTPUT_VARIABLE printed RESULT_VARIABLE status)
file(READ ${EXPECTED} expected)
set(structs)
foreach(header IN LISTS HEADERS)
  file(STRINGS ${header} more REGEX "^typedef struct pose_wall_[a-z0-9_]+ {")
  list(APPEND structs ${more})
endforeach()
list(TRANSFORM structs REPLACE "typedef struct ([a-z0-9_]+).*" "\\1")
foreach(struct IN LISTS structs)
  if(NOT "\n${expected}" MATCHES "\n${struct} [0-9]+\n")
    message(FATAL_ERROR "${EXPECTED} does not hold ${struct}: let abi_layout.py find it, too")
  endif()
endforeach()
if(NOT status EQUAL 0)
  message(FATAL_ERROR "A public struct holds implicit padding (or the program failed, status ${status}):\n${printed}")
endif()
if(NOT printed STREQUAL expected)
  message(FATAL_ERROR "The public structs are laid out otherwise than ${EXPECTED} says. If that is meant, raise "
                      "POSE_WALL_ABI_VERSION and put this into the file:\n${printed}")
endif()
