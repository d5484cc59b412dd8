#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Builds pose_wall on a fresh Debian or Ubuntu machine and runs its tests. Installs what is missing (and says what).
# Tests on recorded frames run where POSE_WALL_DATA names their folder and are skipped elsewhere.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/shell/steps.sh
. tools/shell/packages.sh

# shellcheck disable=SC2086  # lists of words
need_packages $packages_to_build $packages_to_test
need_cmake
step "Configuring" cmake --preset release -DPOSE_WALL_BUILD_TESTS=ON
step "Building" cmake --build --preset release
step "Testing" ctest --preset release
echo
sed -n '/tests passed/,$p' "$step_log"
if [ -z "${POSE_WALL_DATA:-}" ]; then
  echo "POSE_WALL_DATA is not set: the tests on recorded frames were skipped."
fi
