# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# pose_wall_test_kind(<kind> [WHITE_BOX] [NATIVE] [WORDS] TIMEOUT <seconds> [NEEDS <target>] [ONLY <target>...])
# The executable pose_wall_<kind>_tests from <kind>/**/*_test.cpp, one ctest entry per case, labelled with the kind.
# ONLY: links these beside the archive, and none of the tools. WORDS: they compute nothing themselves.
# Most of what tests take to compile is the same templates, so that a quick build compiles some files together: these
# cannot use one name for two things.
# Nothing is made when the folder is empty, a needed target is not part of this build, or a NATIVE kind is cross built.
function(pose_wall_test_kind kind)
  cmake_parse_arguments(PARSE_ARGV 1 kind "WHITE_BOX;NATIVE;WORDS" "TIMEOUT;NEEDS" "ONLY")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${kind}/*_test.cpp)
  if(CMAKE_CROSSCOMPILING)
    if(kind_NATIVE)
      return()
    endif()
    # The simulator runs on no controller, and slowly under emulation.
    list(FILTER sources EXCLUDE REGEX "/(sim_|frames_and_signs)[^/]*$")
    math(EXPR kind_TIMEOUT "10 * ${kind_TIMEOUT}")
  endif()
  if(NOT sources)
    return()
  endif()
  if(kind_NEEDS AND NOT TARGET ${kind_NEEDS})
    message(STATUS "Tests of kind '${kind}' left out: this build has no ${kind_NEEDS}")
    return()
  endif()

  set(target pose_wall_${kind}_tests)
  add_executable(${target} ${sources})
  pose_wall_compile_strictly(${target})
  # What is tested is optimised as ever. The tests hardly are, and those with sanitizers not at all: they would take
  # longer to compile than they save.
  target_compile_options(${target} PRIVATE $<IF:$<OR:$<BOOL:${kind_WORDS}>,$<CONFIG:Debug>>,-O0,-O1>)
  if(POSE_WALL_QUICK_BUILD)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
    list(LENGTH sources files)
    if(files GREATER 12)  # for less it would take longer than it saves
      target_precompile_headers(${target} PRIVATE <gtest/gtest.h> <algorithm> <filesystem> <fstream> <string> <vector>)
    endif()
  endif()
  # The objects come first: they define every pose_wall_*, so that tools which link the archive add no second copy.
  if(kind_WHITE_BOX)
    target_link_libraries(${target} PRIVATE pose_wall_objects)
  else()
    target_link_libraries(${target} PRIVATE pose_wall::pose_wall)
  endif()
  target_link_libraries(${target} PRIVATE ${kind_ONLY} pose_wall_test_support GTest::gtest_main)
  foreach(library IN ITEMS pose_wall_tools pose_wall_picture pose_wall_sim)
    if(TARGET ${library} AND NOT kind_ONLY)
      target_link_libraries(${target} PRIVATE ${library})
    endif()
  endforeach()
  gtest_discover_tests(${target}
    TEST_PREFIX "${kind}." DISCOVERY_TIMEOUT 60
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    PROPERTIES LABELS ${kind} TIMEOUT ${kind_TIMEOUT} SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\]")
endfunction()
