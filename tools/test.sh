#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Builds pose_wall on a fresh Debian or Ubuntu machine and runs its tests. Installs what is missing (and says what).
# Tests on recorded frames run where POSE_WALL_DATA names their folder and are skipped elsewhere.
# usage: test.sh [PRESET [CTEST_OPTION...]]
#   PRESET        of CMakePresets.json: release (when none is named), arm64 (AArch64 under qemu), ...
#   CTEST_OPTION  for example -R '^unit\.' to run the tests of that name alone
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/shell/steps.sh
. tools/shell/packages.sh

preset=${1:-release}
if ! packages=$(packages_of "$preset"); then
  echo "usage: $0 [PRESET [CTEST_OPTION...]]; there is no preset '$preset', there are: $presets_to_test"
  exit 2
fi
[ $# -eq 0 ] || shift
if [ $# -gt 0 ] && [ "${1#-}" = "$1" ]; then
  echo "usage: $0 [PRESET [CTEST_OPTION...]]; '$1' is no option of ctest, one preset is tested at a time"
  exit 2
fi
# shellcheck disable=SC2086  # a list of words
need_packages $packages
need_cmake
need_three
step "Configuring $preset" cmake --preset "$preset" -DPOSE_WALL_BUILD_TESTS=ON
step "Building $preset" cmake --build --preset "$preset"
step "Testing $preset" ctest --preset "$preset" "$@"
echo
sed -n '/tests passed/,$p' "$step_log"
case $preset in
  release | debug)
    [ -n "${POSE_WALL_DATA:-}" ] || echo "POSE_WALL_DATA is not set: the tests on recorded frames were skipped."
    ;;
esac
