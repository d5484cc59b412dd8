# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# AArch64 without an operating system and without a C library, as on bare metal or in a small real-time system: Clang,
# no library function known to the compiler, no unaligned access, no position-independent code, the oldest core. Eigen's
# headers want those of a C++ library, so these are read; nothing of the library itself is linked.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

set(CMAKE_C_COMPILER clang)
set(CMAKE_CXX_COMPILER clang++)
set(CMAKE_C_COMPILER_TARGET aarch64-none-elf)
set(CMAKE_CXX_COMPILER_TARGET aarch64-none-elf)
foreach(tool IN ITEMS NM READELF OBJCOPY OBJDUMP AR RANLIB)
  string(TOLOWER ${tool} name)
  find_program(CMAKE_${tool} aarch64-linux-gnu-${name} REQUIRED)
endforeach()
find_program(CMAKE_LINKER aarch64-linux-gnu-ld REQUIRED)

set(bare -mcpu=cortex-a53 -ffreestanding -fno-pic -mno-unaligned-access)
list(JOIN bare " " bare)
file(GLOB headers /usr/aarch64-linux-gnu/include/c++/*)
if(NOT headers)
  message(FATAL_ERROR "The headers of the C++ library for AArch64 are missing: install libstdc++-12-dev-arm64-cross "
                      "(or another version), which g++-aarch64-linux-gnu brings")
endif()
list(SORT headers COMPARE NATURAL)
list(GET headers -1 headers)
list(TRANSFORM headers REPLACE "(.+)" "-isystem \\1 -isystem \\1/aarch64-linux-gnu")
set(CMAKE_C_FLAGS_INIT "${bare}")
set(CMAKE_CXX_FLAGS_INIT "${bare} -D_GNU_SOURCE ${headers} -isystem /usr/aarch64-linux-gnu/include")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostdlib -static --ld-path=${CMAKE_LINKER}")

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static -cpu cortex-a53)
set(POSE_WALL_BARE ON CACHE BOOL "No library but the list of what the engine may ask for" FORCE)
