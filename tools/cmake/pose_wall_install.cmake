# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# cmake --install: header, archive, package config; find_package(pose_wall) then gives pose_wall::pose_wall.
include(CMakePackageConfigHelpers)

set(pose_wall_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pose_wall)
file(GLOB pose_wall_public_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/pose_wall*.h*)
install(FILES ${pose_wall_public_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
set(pose_wall_archives pose_wall)
if(TARGET pose_wall_runtime)
  list(APPEND pose_wall_archives pose_wall_runtime)
endif()
install(TARGETS ${pose_wall_archives} EXPORT pose_wall ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
# The exported targets need nothing that a package config would have to look for, so they are the config.
install(EXPORT pose_wall FILE pose_wall-config.cmake NAMESPACE pose_wall:: DESTINATION ${pose_wall_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pose_wall-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/pose_wall-config-version.cmake DESTINATION ${pose_wall_package_dir})
if(TARGET pose_wall_cli)
  install(TARGETS pose_wall_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
