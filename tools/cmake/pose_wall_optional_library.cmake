# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# Kinds of input that take a library of their own. One that is missing leaves the rest as it is: the command then says
# which package and option it takes.
function(pose_wall_optional_library name what header library)
  option(POSE_WALL_READ_${name} "Read ${what}, where the library is found" ON)
  if(NOT POSE_WALL_READ_${name})
    return()
  endif()
  find_path(${name}_INCLUDE_DIR ${header})
  find_library(${name}_LIBRARY ${library})
  mark_as_advanced(${name}_INCLUDE_DIR ${name}_LIBRARY)
  if(NOT ${name}_INCLUDE_DIR OR NOT ${name}_LIBRARY)
    message(STATUS "Not read by this build: ${what} (no ${header} and lib${library})")
    return()
  endif()
  target_compile_definitions(pose_wall_files PRIVATE POSE_WALL_HAS_${name}=1)
  target_include_directories(pose_wall_files SYSTEM PRIVATE ${${name}_INCLUDE_DIR})
  target_link_libraries(pose_wall_files PRIVATE ${${name}_LIBRARY})
endfunction()

pose_wall_optional_library(LZ4 "lz4 in bags" lz4frame.h lz4)
pose_wall_optional_library(ZSTD "zstd in bags" zstd.h zstd)
pose_wall_optional_library(BZIP2 "bz2 in bags" bzlib.h bz2)
pose_wall_optional_library(ZLIB "logs packed by gzip" zlib.h z)
pose_wall_optional_library(SQLITE "ROS 2 bags in SQLite" sqlite3.h sqlite3)
pose_wall_optional_library(PCAP "captures of packets" pcap/pcap.h pcap)
