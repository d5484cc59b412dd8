# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# cmake --install: headers, archives, package config, pkg-config files, bill of materials, what a controller needs; and
# the command and the daemon where they are built. find_package(pose_wall) gives pose_wall::pose_wall,
# pose_wall::pose_wall_motion and pose_wall::pose_wall_planar, and pose_wall::pose_wall_runtime where that is built.
# Components: development, command, daemon; python, which only who names it gets (tools/apps/python/CMakeLists.txt).
include(CMakePackageConfigHelpers)
include(pose_wall_sbom)

set(pose_wall_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pose_wall)
set(pose_wall_pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(GLOB pose_wall_public_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/pose_wall*.h*
  ${PROJECT_SOURCE_DIR}/include/pose_wall*.def)
list(FILTER pose_wall_public_headers EXCLUDE REGEX "_trace\\.h$")  # of libraries that stay in the build
install(FILES ${pose_wall_public_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
set(pose_wall_archives pose_wall pose_wall_motion pose_wall_planar)
if(TARGET pose_wall_runtime)
  list(APPEND pose_wall_archives pose_wall_runtime)
endif()
install(TARGETS ${pose_wall_archives} EXPORT pose_wall ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  COMPONENT development)
# The exported targets need nothing that a package config would have to look for, so they are the config.
install(EXPORT pose_wall FILE pose_wall-config.cmake NAMESPACE pose_wall:: DESTINATION ${pose_wall_package_dir}
  COMPONENT development)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pose_wall-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/pose_wall-config-version.cmake DESTINATION ${pose_wall_package_dir}
  COMPONENT development)

# A relative path, whatever the prefix: with an absolute CMAKE_INSTALL_LIBDIR the package cannot be moved anyway.
file(RELATIVE_PATH pose_wall_prefix_from_pc /prefix/${pose_wall_pc_dir} /prefix)
string(REGEX REPLACE "/$" "" pose_wall_prefix_from_pc "${pose_wall_prefix_from_pc}")
foreach(archive IN LISTS pose_wall_archives)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/${archive}.pc.in ${PROJECT_BINARY_DIR}/${archive}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${archive}.pc DESTINATION ${pose_wall_pc_dir} COMPONENT development)
endforeach()

set(pose_wall_doc_dir ${CMAKE_INSTALL_DATAROOTDIR}/doc/libpose-wall-dev)
pose_wall_sbom(${PROJECT_BINARY_DIR}/pose_wall.spdx.json pose_wall pose_wall_motion pose_wall_planar)
install(FILES ${PROJECT_BINARY_DIR}/pose_wall.spdx.json DESTINATION ${pose_wall_doc_dir} COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${pose_wall_doc_dir} RENAME copyright COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/include/README.md ${PROJECT_SOURCE_DIR}/include/AXES.md
  ${PROJECT_SOURCE_DIR}/include/DEFINITIONS.md
  ${PROJECT_SOURCE_DIR}/include/SAFETY.md
  ${PROJECT_SOURCE_DIR}/include/LIMITS.md ${PROJECT_SOURCE_DIR}/include/SIZES.md
  ${PROJECT_SOURCE_DIR}/tools/apps/c/example.c ${PROJECT_SOURCE_DIR}/tools/apps/c/two_engines.c
  DESTINATION ${pose_wall_doc_dir} COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/src/planar/stop/README.md DESTINATION ${pose_wall_doc_dir} RENAME planar_stop.md
  COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/tools/apps/plc/ DESTINATION ${pose_wall_doc_dir}/plc COMPONENT development
  FILES_MATCHING PATTERN "FB_PoseWall.*" PATTERN "controller.c" PATTERN "README.md"
  PATTERN "*.dbc" PATTERN "can_*.[ch]")
if(TARGET pose_wall_cli)
  install(TARGETS pose_wall_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/pose-wall RENAME copyright
    COMPONENT command)
  if(POSE_WALL_HAS_THREE)
    install(FILES ${POSE_WALL_THREE_MODULES}/three/LICENSE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/pose-wall
      RENAME copyright.three COMPONENT command)
  endif()
  # Found by name: --config vlp16.
  file(GLOB pose_wall_configs CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/config/*.yaml)
  install(FILES ${pose_wall_configs} DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/pose_wall/config COMPONENT command)
  set(pose_wall_words ${PROJECT_BINARY_DIR}/words)
  install(FILES ${pose_wall_words}/pose_wall.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
  install(FILES ${pose_wall_words}/pose_wall.bash RENAME pose_wall
    DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions COMPONENT command)
  install(FILES ${pose_wall_words}/_pose_wall DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/zsh/site-functions
    COMPONENT command)
  install(FILES ${pose_wall_words}/pose_wall.fish DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/fish/vendor_completions.d
    COMPONENT command)
endif()
if(TARGET pose_walld)
  set(pose_wall_daemon_dir ${PROJECT_SOURCE_DIR}/tools/apps/live)
  install(TARGETS pose_walld pose_wall_sensor RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT daemon)
  if(TARGET pose_walld_ros1)
    # For pose_walld alone, which looks there.
    install(TARGETS pose_walld_ros1 RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/pose_wall COMPONENT daemon)
  endif()
  # Where systemd looks whatever the prefix is: /usr/lib/systemd in a package.
  install(FILES ${pose_wall_daemon_dir}/pose_walld.service DESTINATION lib/systemd/system COMPONENT daemon)
  # The package's postinst copies it to /etc/pose_wall/pose_wall.yaml, where none is.
  install(FILES ${pose_wall_daemon_dir}/pose_walld.yaml DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/pose_wall
    COMPONENT daemon)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/pose-walld RENAME copyright
    COMPONENT daemon)
  if(POSE_WALL_HAS_THREE)
    install(FILES ${POSE_WALL_THREE_MODULES}/three/LICENSE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/pose-walld
      RENAME copyright.three COMPONENT daemon)
  endif()
  foreach(place . commissioning foxglove modbus mqtt recorder ros1 ros2)
    install(FILES ${pose_wall_daemon_dir}/${place}/README.md
      DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/pose-walld/${place} COMPONENT daemon)
  endforeach()
  install(DIRECTORY ${pose_wall_daemon_dir}/manual DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/pose-walld
    COMPONENT daemon)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/tools/apps/plc/can/
    DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/pose-walld/can COMPONENT daemon
    FILES_MATCHING PATTERN "*.dbc" PATTERN "README.md")
endif()
if(PROJECT_IS_TOP_LEVEL)
  include(pose_wall_package)
endif()
