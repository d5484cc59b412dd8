# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# The same by Clang, with the headers, libraries and binutils of Debian's cross compiler.
include(${CMAKE_CURRENT_LIST_DIR}/aarch64-linux-gnu.cmake)

set(CMAKE_C_COMPILER clang)
set(CMAKE_CXX_COMPILER clang++)
set(CMAKE_C_COMPILER_TARGET aarch64-linux-gnu)
set(CMAKE_CXX_COMPILER_TARGET aarch64-linux-gnu)
find_program(CMAKE_LINKER aarch64-linux-gnu-ld REQUIRED)
find_program(CMAKE_OBJCOPY aarch64-linux-gnu-objcopy REQUIRED)
find_program(CMAKE_OBJDUMP aarch64-linux-gnu-objdump REQUIRED)
