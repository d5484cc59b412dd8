#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Builds pose_walld on a fresh Debian 12 machine and tests its edges with programs that others wrote: sensors by UDP,
# ROS, Modbus TCP, a browser, recordings. Installs what is missing (and says what).
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/shell/steps.sh
. tools/shell/packages.sh

# shellcheck disable=SC2086  # lists of words
need_packages $packages_to_build $packages_to_read $packages_to_survey $packages_to_prove \
  $packages_to_live $packages_to_test $packages_to_test_live
need_cmake
need_three
need_peers
step "Configuring" cmake --preset release -DPOSE_WALL_BUILD_TESTS=ON
step "Building" cmake --build --preset release --target pose_walld pose_wall_sensor pose_wall_cli pose_wall_live_tests \
  pose_wall_live_peers
step "Testing the edges" ctest --preset release -L live
echo
sed -n '/tests passed/,$p' "$step_log"
