# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# pose_wall_engine_library(SOURCES a.cpp b.cpp ...)
#
# Makes two targets from the engine's sources:
#   pose_wall_objects  the objects as compiled, for white-box tests and stage benchmarks (internal names visible)
#   pose_wall          the archive users link (alias pose_wall::pose_wall): all objects in one, in which only
#                      pose_wall_* is global. Otherwise the weak Eigen and std symbols in here would be merged by the
#                      linker with those of a user's program, built with other flags.
function(pose_wall_engine_library)
  cmake_parse_arguments(PARSE_ARGV 0 engine "" "" "SOURCES")
  find_package(Eigen3 3.3 REQUIRED NO_MODULE)

  pose_wall_engine_objects(pose_wall_objects ${engine_SOURCES})
  pose_wall_delivered_archive(pose_wall pose_wall_engine.o pose_wall_*)
  target_include_directories(pose_wall INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(pose_wall INTERFACE m)
endfunction()

# The archive that users link, of the objects ${archive}_objects merged into one in which only `global` is global.
function(pose_wall_delivered_archive archive object global)
  if(POSE_WALL_QUICK_BUILD)  # check_tidy.sh compiles without, so that no #include is missing
    pose_wall_precompile_eigen(${archive}_objects)
  endif()
  if(POSE_WALL_CALL_GRAPH)
    target_compile_options(${archive}_objects PRIVATE -fcallgraph-info=su)  # beside the objects, for check_stack.py
  endif()
  pose_wall_one_object(${archive}_objects ${CMAKE_CURRENT_BINARY_DIR}/${object} ${global})
  add_library(${archive} STATIC ${CMAKE_CURRENT_BINARY_DIR}/${object})
  add_library(pose_wall::${archive} ALIAS ${archive})
  # C: whoever links the archive needs no C++ runtime.
  set_target_properties(${archive} PROPERTIES LINKER_LANGUAGE C ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
endfunction()

# The objects of the engine, compiled as every engine is.
function(pose_wall_engine_objects target)
  add_library(${target} OBJECT ${ARGN})
  pose_wall_compile_strictly(${target})
  pose_wall_engine_flags(${target})
  if(NOT POSE_WALL_BARE)  # where nothing is loaded to another place, tables of pointers need no relocation
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
  target_include_directories(${target}
    PUBLIC ${PROJECT_SOURCE_DIR}/include
    INTERFACE ${PROJECT_SOURCE_DIR}/src
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  # SYSTEM: Eigen's own headers are not held to our warnings.
  target_link_libraries(${target} PUBLIC Eigen3::Eigen)
endfunction()

function(pose_wall_precompile_eigen target)
  target_precompile_headers(${target} PRIVATE <Eigen/Core> <Eigen/Geometry> <Eigen/LU>)
endfunction()

# pose_wall_traced_library(ARCHIVE SOURCES more.cpp ...)
#
# ARCHIVE_traced: the sources of ARCHIVE_objects and these, compiled so that they take notes (src/base/gates). Only
# ARCHIVE_trace_* is global in it, so a program may link it beside the plain archive. Not installed.
# ARCHIVE_traced_objects: its objects.
function(pose_wall_traced_library archive)
  cmake_parse_arguments(PARSE_ARGV 1 traced "" "" "SOURCES")
  set(objects ${archive}_traced_objects)
  set(object ${CMAKE_CURRENT_BINARY_DIR}/${archive}_traced.o)
  get_target_property(plain_sources ${archive}_objects SOURCES)
  pose_wall_engine_objects(${objects} ${plain_sources} ${traced_SOURCES})
  target_compile_definitions(${objects} PRIVATE POSE_WALL_TRACE=1)
  # A frame at a time: rather compiled quickly than quick. The bits are the same, as digest.traced_as_noted shows.
  target_compile_options(${objects} PRIVATE $<$<CONFIG:Release>:-O1>)
  if(POSE_WALL_QUICK_BUILD)
    pose_wall_precompile_eigen(${objects})
  endif()
  pose_wall_one_object(${objects} ${object} ${archive}_trace_*)
  add_library(${archive}_traced STATIC ${object})
  set_target_properties(${archive}_traced PROPERTIES LINKER_LANGUAGE C)
  target_include_directories(${archive}_traced INTERFACE ${PROJECT_SOURCE_DIR}/include)
  target_link_libraries(${archive}_traced INTERFACE m)
endfunction()

# A release, and a subproject of a build without a build type: it gets a quick engine, too.
set(pose_wall_quick $<OR:$<CONFIG:Release>,$<STREQUAL:$<CONFIG>,>>)

# What keeps the C++ runtime out of what users link, and the symbols of ours inside.
function(pose_wall_bare_flags target)
  target_compile_options(${target} PRIVATE
    -fno-exceptions -fno-rtti -fno-threadsafe-statics
    -fvisibility=hidden -fvisibility-inlines-hidden -ffunction-sections
    $<${pose_wall_quick}:-O3>
    # Nothing is ever thrown through the engine; debuggers have tables of their own.
    $<$<NOT:$<CONFIG:Debug>>:-fno-asynchronous-unwind-tables -fno-unwind-tables>
    # Clang makes a call of bcmp, which is no C, of a memcmp that asks for equality alone
    $<$<CXX_COMPILER_ID:Clang>:-fno-builtin-bcmp>
    # std::atomic would call libgcc helpers, which a plain C link on AArch64 does not always have
    $<$<BOOL:${POSE_WALL_AARCH64}>:-mno-outline-atomics>)
endfunction()

# That, and what keeps the heap and other bits on other machines out of the engine.
function(pose_wall_engine_flags target)
  pose_wall_bare_flags(${target})
  # These change what a header means or the bits it computes: who includes engine headers must compile alike. Lanes that
  # do not count are computed with the others and may divide by zero, so nobody can have these trap anyway. A failed
  # Eigen assertion traps in every build type; Eigen's own would bring assert(), and with it stdio and abort().
  target_compile_options(${target} PUBLIC
    ${pose_wall_unfused_flags} -fno-math-errno -fno-trapping-math
    "-Deigen_assert(condition)=((condition)?(void)0:__builtin_trap())")
  target_compile_definitions(${target} PUBLIC EIGEN_DONT_VECTORIZE)
endfunction()

if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  set(POSE_WALL_AARCH64 ON)
else()
  set(POSE_WALL_AARCH64 OFF)
endif()

# GNU's: beside Clang CMake takes LLVM's where they are installed, and lld knows nothing of groups.
set(POSE_WALL_LD ${CMAKE_LINKER})
set(POSE_WALL_OBJCOPY ${CMAKE_OBJCOPY})
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND NOT CMAKE_CROSSCOMPILING)
  unset(POSE_WALL_LD)
  unset(POSE_WALL_OBJCOPY)
  find_program(POSE_WALL_LD NAMES ld.bfd ld)
  find_program(POSE_WALL_OBJCOPY NAMES objcopy)
endif()

# How objects become one. With it go all functions or none: --gc-sections has nothing to choose from in it.
set(POSE_WALL_MERGE ${POSE_WALL_LD} -r --force-group-allocation -T ${CMAKE_CURRENT_LIST_DIR}/one_object.ld)

# Merges the objects of a target and makes all symbols local but those of the pattern; hidden visibility alone leaves
# the standard library's templates global and weak wherever the compiler does not inline them. --force-group-allocation
# dissolves COMDAT groups: a group whose signature is local could not be merged any more.
function(pose_wall_one_object objects output global)
  if(NOT POSE_WALL_LD OR NOT POSE_WALL_OBJCOPY)
    message(FATAL_ERROR "pose_wall needs GNU ld and objcopy (package binutils) to build its archive; "
                        "here are '${POSE_WALL_LD}' and '${POSE_WALL_OBJCOPY}'")
  endif()
  # CMake counts a precompiled header among the objects.
  set(all_objects "$<FILTER:$<TARGET_OBJECTS:${objects}>,EXCLUDE,cmake_pch>")
  add_custom_command(OUTPUT ${output}
    COMMAND ${POSE_WALL_MERGE} -o ${output} "${all_objects}"
    COMMAND ${POSE_WALL_OBJCOPY} --wildcard --keep-global-symbol=${global} ${output}
    DEPENDS ${objects} "${all_objects}" ${PROJECT_SOURCE_DIR}/tools/cmake/one_object.ld
    COMMENT "Merging ${objects} into one object, ${global} global"
    COMMAND_EXPAND_LISTS VERBATIM)
  set_source_files_properties(${output} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
endfunction()
