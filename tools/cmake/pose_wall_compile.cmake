# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

set(pose_wall_conversion_warnings -Wconversion -Wsign-conversion)

# Language level and warnings of every target of ours; PRIVATE, so that no flag reaches a user's code.
function(pose_wall_compile_strictly target)
  target_compile_features(${target} PRIVATE cxx_std_17)
  set_target_properties(${target} PROPERTIES
    CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF
    C_STANDARD 99 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow ${pose_wall_conversion_warnings}
    $<$<BOOL:${POSE_WALL_WERROR}>:-Werror>)
endfunction()

# pose_wall_unfused_flags_for(<out> <flag>...)
#
# What keeps each product and each sum rounded on its own beside a user's flags: fused, they have other bits. These
# flags stand behind the user's own and win. -ffp-contract=off binds Clang. GCC's vectoriser makes one instruction of
# pairs a*b-c, a*b+c all the same. Seen with GCC 12.2: vfmaddsub of FMA, FMA4 and AVX-512, fcmla and vcmla of Armv8.3,
# fcmla of SVE. On x86-64 flags deny it the instructions, which costs nothing. On Arm none does, so the vectoriser stays
# off where they exist: 2 to 4 % more instructions of a frame, 13 % of the stop (count.py).
function(pose_wall_unfused_flags_for out)
  set(flags -ffp-contract=off)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64|i[3-6]86)$")
    list(APPEND flags -mno-fma -mno-fma4 -mno-avx512f)
  elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm)" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(FILTER ARGN INCLUDE REGEX "^-m")
    execute_process(COMMAND ${CMAKE_CXX_COMPILER} ${ARGN} -dM -E -x c++ /dev/null
      OUTPUT_VARIABLE macros COMMAND_ERROR_IS_FATAL ANY)
    if(macros MATCHES "__ARM_FEATURE_(COMPLEX|SVE) ")  # base/math/finite.hpp refuses to compile where this missed them
      list(APPEND flags -fno-tree-vectorize -DPOSE_WALL_UNFUSED=1)
    endif()
  endif()
  set(${out} ${flags} PARENT_SCOPE)
endfunction()

string(TOUPPER "${CMAKE_BUILD_TYPE}" pose_wall_build_type)
separate_arguments(pose_wall_user_flags UNIX_COMMAND "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${pose_wall_build_type}}")
get_directory_property(pose_wall_user_options COMPILE_OPTIONS)
pose_wall_unfused_flags_for(pose_wall_unfused_flags ${pose_wall_user_flags} ${pose_wall_user_options})
