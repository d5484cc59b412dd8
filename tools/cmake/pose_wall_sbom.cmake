# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# pose_wall_sbom(<file> <library>...): writes the bill of materials (SPDX 2.3, JSON) whenever a library was built: with
# their digests, and with the version that stands in the very headers of Eigen they were compiled with.
function(pose_wall_sbom file)
  set(writer ${PROJECT_SOURCE_DIR}/tools/cmake/write_sbom.cmake)
  find_package(Eigen3 3.3 REQUIRED NO_MODULE)  # the engine's, seen from this folder
  get_target_property(eigen_folders Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  set(archives)
  foreach(library IN LISTS ARGN)
    list(APPEND archives $<TARGET_FILE:${library}>)
  endforeach()
  add_custom_command(OUTPUT ${file}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${file} "-DLIBRARIES=${archives}" -DVERSION=${PROJECT_VERSION}
      "-DEIGEN=${eigen_folders}" "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}" -P ${writer}
    DEPENDS ${ARGN} ${writer}
    COMMENT "Writing the bill of materials" VERBATIM)
  add_custom_target(pose_wall_sbom ALL DEPENDS ${file})
endfunction()
