#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Users' projects get the library from what cmake --install writes, also after it was moved; it asks for no Eigen.
# usage: check_consumer.sh CMAKE SOURCE_DIR BUILD_DIR CC CXX TOOLCHAIN_FILE [EMULATOR...]
# TOOLCHAIN_FILE: - for none
set -eu
cmake=$1 source=$2 build=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cmake" --install "$build" --prefix "$work/installed" > "$work/log" || { cat "$work/log"; exit 1; }
if grep -rIlE 'Eigen3|<Eigen/' "$work/installed"; then
  echo "the installed files above need Eigen; a user has none"
  exit 1
fi
mkdir "$work/elsewhere"
mv "$work/installed" "$work/elsewhere/moved"
"$source/tests/checks/consume.sh" "$cmake" "$source" "$work/elsewhere/moved" "$@"
