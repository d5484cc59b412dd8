# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors

# A short soak, so that the tool is run at all: frames of a simulated road as fast as they go, three at once into a
# queue of two places (some are overtaken and must be accounted for), with a black box. Its exit status is the test.
set(soak_folder ${CMAKE_CURRENT_BINARY_DIR}/soak_road)
add_test(NAME runtime.soak_road
  COMMAND pose_wall_cli sim --scene clean --sensor vlp16 --frames 4 --output ${soak_folder})
set_tests_properties(runtime.soak_road PROPERTIES LABELS runtime TIMEOUT 60 FIXTURES_SETUP soak_road)
# A box that is there is kept, and its soak refused.
add_test(NAME runtime.soak_no_box COMMAND ${CMAKE_COMMAND} -E rm -f ${CMAKE_CURRENT_BINARY_DIR}/soak.box)
set_tests_properties(runtime.soak_no_box PROPERTIES LABELS runtime FIXTURES_SETUP soak_road)
add_test(NAME runtime.soak
  COMMAND pose_wall_soak --config ${soak_folder}/pose_wall.yaml --accelerated 1500 --burst 3 --points 3000
  --box ${CMAKE_CURRENT_BINARY_DIR}/soak.box --box-mb 4 ${soak_folder}/frames)
set_tests_properties(runtime.soak PROPERTIES LABELS runtime TIMEOUT 120 FIXTURES_REQUIRED soak_road)
