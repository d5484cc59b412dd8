# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# cpack --preset release (or arm64, armhf): libpose-wall-dev, and where they are built pose-wall (the command),
# pose-walld (the daemon) and python3-pose-wall, as TGZ and DEB.
if(POSE_WALL_AARCH64)
  set(pose_wall_architecture arm64)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|amd64|AMD64)$")
  set(pose_wall_architecture amd64)
elseif(CMAKE_SYSTEM_PROCESSOR STREQUAL "armv7")
  set(pose_wall_architecture armhf)
else()
  set(pose_wall_architecture ${CMAKE_SYSTEM_PROCESSOR})
endif()

set(CPACK_GENERATOR TGZ DEB)
set(CPACK_PACKAGE_NAME pose_wall)
set(CPACK_PACKAGE_VENDOR "the pose_wall authors")
set(CPACK_PACKAGE_CONTACT "the pose_wall authors" CACHE STRING "Maintainer of the packages: Name <address>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES OFF)  # would take the archive's symbols
set(CPACK_COMPONENTS_ALL development)
if(TARGET pose_wall_cli)
  list(APPEND CPACK_COMPONENTS_ALL command)
endif()
if(TARGET pose_walld)
  list(APPEND CPACK_COMPONENTS_ALL daemon)
endif()
if(TARGET pose_wall_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
if(TARGET pose_wall_cli OR TARGET pose_wall_python)
  # Without the first CPack fails, without the second the package silently depends on nothing.
  find_program(POSE_WALL_FILE file)
  find_program(POSE_WALL_SHLIBDEPS dpkg-shlibdeps)
  if(NOT POSE_WALL_FILE OR NOT POSE_WALL_SHLIBDEPS)
    list(REMOVE_ITEM CPACK_GENERATOR DEB)
    message(STATUS "cpack will make no .deb: what its programs depend on is looked up by file and dpkg-shlibdeps "
                   "(packages file, dpkg-dev), here are '${POSE_WALL_FILE}' and '${POSE_WALL_SHLIBDEPS}'")
  endif()
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)

set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_ARCHIVE_DEVELOPMENT_FILE_NAME libpose-wall-dev_${PROJECT_VERSION}_${pose_wall_architecture})
set(CPACK_ARCHIVE_COMMAND_FILE_NAME pose-wall_${PROJECT_VERSION}_${pose_wall_architecture})
set(CPACK_ARCHIVE_PYTHON_FILE_NAME python3-pose-wall_${PROJECT_VERSION}_${pose_wall_architecture})
set(CPACK_ARCHIVE_DAEMON_FILE_NAME pose-walld_${PROJECT_VERSION}_${pose_wall_architecture})

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${pose_wall_architecture})
set(CPACK_DEBIAN_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libpose-wall-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)  # a static archive needs nothing but who links it
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
  "pose of a tunnelling machine from one LiDAR: static library\n\
Roll, pitch, yaw and the distances to the walls of the roadway, each with a\n\
protection level. C header, CMake and pkg-config files, structured text for PLCs.")
set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME pose-wall)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMMAND_DESCRIPTION
  "pose of a tunnelling machine from one LiDAR: command\n\
Reads frames (PCD, KITTI .bin, PLY, bags, captures), writes one row per frame; simulates roads.")
set(CPACK_DEBIAN_DAEMON_PACKAGE_NAME pose-walld)
set(CPACK_DEBIAN_DAEMON_PACKAGE_SECTION science)
set(CPACK_DEBIAN_DAEMON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DAEMON_PACKAGE_RECOMMENDS pose-wall)
set(CPACK_DEBIAN_DAEMON_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/tools/apps/live/package/postinst ${PROJECT_SOURCE_DIR}/tools/apps/live/package/prerm
  ${PROJECT_SOURCE_DIR}/tools/apps/live/package/postrm)
set(CPACK_DEBIAN_DAEMON_DESCRIPTION
  "pose of a tunnelling machine from one LiDAR: daemon\n\
Takes a live sensor or ROS, publishes by ROS, Modbus TCP, MQTT and a web page, records.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-pose-wall)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.9), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS python3-yaml)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, pose-wall")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION
  "pose of a tunnelling machine from one LiDAR: Python package\n\
NumPy arrays in, dataclasses out: for those who replay recordings and\n\
tune settings.")
include(CPack)
