# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# POSE_WALL_SANITIZE=KIND, with any preset: `cmake --preset debug -DPOSE_WALL_SANITIZE=address`. Whatever is built below
# this folder is compiled and linked with it, GoogleTest's sources for another machine, too.
set(POSE_WALL_SANITIZE "" CACHE STRING
  "address (and undefined behaviour), thread, memory (Clang), fuzzer (Clang, with address), or nothing")
set_property(CACHE POSE_WALL_SANITIZE PROPERTY STRINGS "" address thread memory fuzzer)

# AddressSanitizer finds null pointers and wrong sizes by itself; nothing in the engine has a type at run time (vptr).
set(pose_wall_sanitize_address -fsanitize=address,undefined -fno-sanitize=null,object-size,vptr)
set(pose_wall_sanitize_thread -fsanitize=thread)
set(pose_wall_sanitize_memory -fsanitize=memory -fsanitize-memory-track-origins)
set(pose_wall_sanitize_fuzzer -fsanitize=fuzzer-no-link ${pose_wall_sanitize_address})

if(POSE_WALL_SANITIZE)
  set(flags ${pose_wall_sanitize_${POSE_WALL_SANITIZE}})
  if(NOT flags)
    message(FATAL_ERROR "POSE_WALL_SANITIZE=${POSE_WALL_SANITIZE}: there are address, thread, memory and fuzzer")
  endif()
  if(POSE_WALL_SANITIZE MATCHES "^(memory|fuzzer)$" AND NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "POSE_WALL_SANITIZE=${POSE_WALL_SANITIZE} needs clang; this is ${CMAKE_CXX_COMPILER_ID}")
  endif()
  # The first finding ends the program. -O1: unoptimised, what is compiled with sanitizers takes twice as long to run.
  add_compile_options(${flags} -fno-sanitize-recover=all -fno-omit-frame-pointer -O1 -g1)
  add_link_options(${flags})
endif()
