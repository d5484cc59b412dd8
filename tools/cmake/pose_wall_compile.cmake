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
