# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# GTest::gtest_main: the system's library; for another machine, built from the sources libgtest-dev brings.
include(GoogleTest)
if(CMAKE_CROSSCOMPILING)
  set(POSE_WALL_GTEST_SOURCE /usr/src/googletest CACHE PATH "GoogleTest's sources (package libgtest-dev)")
  set(INSTALL_GTEST OFF)
  set(BUILD_GMOCK OFF)
  add_subdirectory(${POSE_WALL_GTEST_SOURCE} ${CMAKE_CURRENT_BINARY_DIR}/googletest EXCLUDE_FROM_ALL)
  target_compile_options(gtest PRIVATE -O1)  # optimised in full it takes longer to compile than that saves
  if(NOT TARGET GTest::gtest_main)
    add_library(GTest::gtest_main ALIAS gtest_main)
  endif()
else()
  find_package(GTest REQUIRED)
endif()
