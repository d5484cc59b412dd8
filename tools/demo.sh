#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Builds pose_wall on a fresh Debian or Ubuntu machine and runs its demo: a simulated roadway, the engine on it, a table
# in the terminal and a picture. Installs what is missing (and says what). Arguments go to `pose_wall demo`.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/shell/steps.sh
. tools/shell/packages.sh

# shellcheck disable=SC2086  # a list of words
need_packages $packages_to_build $packages_to_read
need_cmake
need_three
step "Configuring" cmake --preset release -DPOSE_WALL_BUILD_TESTS=OFF
step "Building" cmake --build --preset release --target pose_wall_cli
echo
exec build/release/pose_wall demo "$@"
