# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# pose_walld seen from outside, by programs that others wrote. Debian's Python is taken: its packages bring the peers.
find_program(POSE_WALL_PEER_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH DOC "Python with Debian's packages")
if(NOT POSE_WALL_PEER_PYTHON)
  find_program(POSE_WALL_PEER_PYTHON python3)
endif()
set(POSE_WALL_NODE_MODULES ${PROJECT_BINARY_DIR}/../node_modules CACHE PATH
  "Where `npm ci` put the packages of tests/live/peer/package.json")
set(POSE_WALL_OPCUA_MODULES ${PROJECT_BINARY_DIR}/../opcua/node_modules CACHE PATH
  "Where `npm ci` put the packages of tools/apps/opcua/package.json")

# pose_wall_live_peer(<name> [<argument>...]): live/<name>_peer.py
function(pose_wall_live_peer name)
  add_test(NAME live.${name}_peer
    COMMAND ${POSE_WALL_PEER_PYTHON} -W ignore ${CMAKE_CURRENT_SOURCE_DIR}/live/${name}_peer.py ${PROJECT_SOURCE_DIR}
      $<TARGET_FILE:pose_wall_cli> $<TARGET_FILE:pose_walld> ${ARGN})
  set_tests_properties(live.${name}_peer PROPERTIES LABELS live TIMEOUT 600 SKIP_RETURN_CODE 77)
  if(name MATCHES "^(page|view|ros1|ros2|endurance)$")
    # They measure rates, and a busy machine drops frames.
    set_tests_properties(live.${name}_peer PROPERTIES RUN_SERIAL ON)
  else()
    # They wait more than they work: one of them at a time, beside tests that work.
    set_tests_properties(live.${name}_peer PROPERTIES RESOURCE_LOCK live_peers COST 1000)
  endif()
endfunction()

pose_wall_live_peer(daemon $<TARGET_FILE:pose_wall_sensor>)
if(POSE_WALL_HAS_LIVE_modbus)
  pose_wall_live_peer(modbus)
endif()
pose_wall_live_peer(recorder ${POSE_WALL_NODE_MODULES})
if(TARGET pose_wall_can)
  add_executable(pose_wall_can_frames live/can_frames.c)
  pose_wall_compile_strictly(pose_wall_can_frames)
  target_link_libraries(pose_wall_can_frames PRIVATE pose_wall_can)
  pose_wall_live_peer(can $<TARGET_FILE:pose_wall_can_frames> ${POSE_WALL_NODE_MODULES})
endif()
if(POSE_WALL_HAS_LIVE_mqtt)
  pose_wall_live_peer(mqtt)
endif()
if(POSE_WALL_HAS_LIVE_page)
  pose_wall_live_peer(page)
  pose_wall_live_peer(commission)
  pose_wall_live_peer(view $<BOOL:${POSE_WALL_HAS_THREE}>)
  pose_wall_live_peer(monitor $<TARGET_FILE:pose_wall_sensor>)
  pose_wall_live_peer(opcua $<TARGET_FILE:pose_wall_sensor> ${POSE_WALL_NODE_MODULES} ${POSE_WALL_OPCUA_MODULES})
endif()
if(POSE_WALL_HAS_LIVE_foxglove)
  pose_wall_live_peer(foxglove ${POSE_WALL_NODE_MODULES})
endif()
if(POSE_WALL_HAS_LIVE_ros1)
  pose_wall_live_peer(ros1 ${POSE_WALL_NODE_MODULES})
endif()
add_test(NAME live.ros_types_are_generated
  COMMAND ${POSE_WALL_PEER_PYTHON} ${PROJECT_SOURCE_DIR}/tools/apps/live/ros_messages/generate_types.py --check)
set_tests_properties(live.ros_types_are_generated PROPERTIES LABELS live SKIP_RETURN_CODE 77)
pose_wall_live_peer(ros2_packages)
add_custom_target(pose_wall_live_peers)  # what tools/test_live.sh builds of them
if(POSE_WALL_HAS_LIVE_ros2)
  find_path(FASTDDS_INCLUDE_DIR fastdds/dds/domain/DomainParticipant.hpp)
  find_library(FASTRTPS_LIBRARY fastrtps)
  find_library(FASTCDR_LIBRARY fastcdr)
  mark_as_advanced(FASTDDS_INCLUDE_DIR FASTRTPS_LIBRARY FASTCDR_LIBRARY)
  if(FASTDDS_INCLUDE_DIR AND FASTRTPS_LIBRARY AND FASTCDR_LIBRARY)
    # Of another make of DDS than the edge's, and without a line of its code. Its headers are not strict.
    add_executable(pose_wall_ros2_peer live/ros2_peer/main.cpp)
    target_include_directories(pose_wall_ros2_peer SYSTEM PRIVATE ${FASTDDS_INCLUDE_DIR})
    target_compile_features(pose_wall_ros2_peer PRIVATE cxx_std_17)
    target_link_libraries(pose_wall_ros2_peer PRIVATE ${FASTRTPS_LIBRARY} ${FASTCDR_LIBRARY} Threads::Threads)
    add_dependencies(pose_wall_live_peers pose_wall_ros2_peer)
    pose_wall_live_peer(ros2 $<TARGET_FILE:pose_wall_ros2_peer>)
    if(POSE_WALL_HAS_LIVE_ros1 AND POSE_WALL_HAS_LIVE_page AND POSE_WALL_HAS_LIVE_modbus AND POSE_WALL_HAS_LIVE_mqtt)
      pose_wall_live_peer(endurance $<TARGET_FILE:pose_wall_sensor> $<TARGET_FILE:pose_wall_ros2_peer>)
    endif()
  else()
    message(STATUS "Test live.ros2_peer left out: it takes libfastrtps-dev and libfastcdr-dev")
  endif()
endif()
