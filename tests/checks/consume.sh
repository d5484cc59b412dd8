#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Projects in C and in C++ get the library from the package under PREFIX, by find_package and by pkg-config, and run.
# usage: consume.sh CMAKE SOURCE_DIR PREFIX CC CXX TOOLCHAIN_FILE [EMULATOR...]          TOOLCHAIN_FILE: - for none
set -eu
cmake=$1 source=$2 prefix=$3 cc=$4 cxx=$5 toolchain=${6#-}
shift 6
consumer=$source/tests/checks/consumer
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

quietly() {
  "$@" > "$work/log" 2>&1 || { cat "$work/log"; echo "failed: $*"; exit 1; }
}

by_cmake() { # name source cpp library
  # Whoever has no Eigen must be served, too.
  quietly "$cmake" -S "$consumer" -B "$work/$1" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DEXAMPLE="$2" -DCPP="$3" \
    -DLIBRARY="$4" -DCMAKE_TOOLCHAIN_FILE="$toolchain" -DCMAKE_C_COMPILER="$cc" -DCMAKE_CXX_COMPILER="$cxx" \
    -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON
  grep -q "^pose_wall_DIR:PATH=$prefix/" "$work/$1/CMakeCache.txt" || { echo "another pose_wall was found"; exit 1; }
  quietly "$cmake" --build "$work/$1"
}

export PKG_CONFIG_LIBDIR="$prefix/lib/pkgconfig"
flags=$(pkg-config --cflags --libs pose_wall)
case " $flags " in
  *" -I$prefix/"*) ;;
  *" -I$prefix/lib/pkgconfig/../../include "*) ;;
  *) echo "pkg-config points elsewhere: $flags"; exit 1 ;;
esac

by_cmake c "$source/tools/apps/c/example.c" OFF pose_wall
by_cmake cpp "$consumer/consumer.cpp" ON pose_wall
mkdir "$work/pc"
# shellcheck disable=SC2086  # words
quietly "$cc" -std=c99 "$source/tools/apps/c/example.c" $flags -o "$work/pc/c"
# shellcheck disable=SC2086
quietly "$cxx" -std=c++17 "$consumer/consumer.cpp" $flags -o "$work/pc/cpp"

by_cmake motion "$consumer/motion.c" OFF pose_wall_motion
# shellcheck disable=SC2046  # words
quietly "$cc" -std=c99 "$consumer/motion.c" $(pkg-config --cflags --libs pose_wall_motion) -o "$work/pc/motion"
by_cmake planar "$consumer/planar.c" OFF pose_wall_planar
# shellcheck disable=SC2046  # words
quietly "$cc" -std=c99 "$consumer/planar.c" $(pkg-config --cflags --libs pose_wall_planar) -o "$work/pc/planar"

programs="c/consumer cpp/consumer pc/c pc/cpp motion/consumer pc/motion planar/consumer pc/planar"
if [ -e "$prefix/lib/libpose_wall_runtime.a" ]; then
  by_cmake runtime "$consumer/runtime.c" OFF pose_wall_runtime
  # shellcheck disable=SC2046  # words
  quietly "$cc" -std=c99 "$consumer/runtime.c" $(pkg-config --cflags --libs pose_wall_runtime) -o "$work/pc/runtime"
  programs="$programs runtime/consumer pc/runtime"
fi

for program in $programs; do
  "$@" "$work/$program" > "$work/output" || { cat "$work/output"; echo "$program failed"; exit 1; }
  mv "$work/output" "$work/$program.txt"
done
cmp "$work/c/consumer.txt" "$work/pc/c.txt"
echo "C and C++, find_package and pkg-config: found, linked, run; $(pkg-config --modversion pose_wall)"
