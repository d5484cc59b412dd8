#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# A user's C project gets pose_wall::pose_wall from the installed package, which asks for no Eigen and no C++.
# usage: check_consumer.sh CMAKE SOURCE_DIR BUILD_DIR
set -eu
cmake=$1 source=$2 build=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cmake" --install "$build" --prefix "$work/installed" > "$work/log" || { cat "$work/log"; exit 1; }
if grep -rIlE 'Eigen3|<Eigen/' "$work/installed"; then
  echo "the installed files above need Eigen; a user has none"
  exit 1
fi
"$cmake" -S "$source/tests/checks/consumer" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/installed" \
  -DEXAMPLE="$source/tools/example.c" -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON
"$cmake" --build "$work/build"
"$work/build/consumer" > "$work/log" || { cat "$work/log"; echo "the example failed"; exit 1; }
echo "installed package: found, linked, runs"
