#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# The library's packages hold the same files, of the right machine, and serve users' projects wherever they are
# unpacked. With POSE_WALL in the environment (the native command), a controller linked from the package must print the
# numbers of `pose_wall run`.
# usage: check_package.sh CMAKE SOURCE_DIR PACKAGES_DIR ARCHITECTURE CC CXX TOOLCHAIN_FILE [EMULATOR...]
# TOOLCHAIN_FILE: - for none
set -eu
cmake=$1 source=$2 packages=$3 architecture=$4 cc=$5 cxx=$6 toolchain=$7
shift 7
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
complain() { echo "$1"; exit 1; }

deb=$(ls "$packages"/libpose-wall-dev_*_"$architecture".deb)
tgz=$(ls "$packages"/libpose-wall-dev_*_"$architecture".tar.gz)
for field in Package:libpose-wall-dev "Architecture:$architecture" Section:libdevel Depends: "Version:$(
  sed -n 's/^project(pose_wall VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt")"; do
  found=$(dpkg-deb -f "$deb" "${field%%:*}")
  [ "$found" = "${field#*:}" ] || complain "$deb: ${field%%:*} is '$found', not '${field#*:}'"
done
[ -n "$(dpkg-deb -f "$deb" Maintainer)" ] && [ -n "$(dpkg-deb -f "$deb" Description)" ] ||
  complain "$deb: no maintainer or no description"

# Moved twice: to where it is unpacked, and from there to a prefix of another name and depth.
mkdir -p "$work/deb" "$work/tgz/some" "$work/a/b"
dpkg-deb -x "$deb" "$work/deb"
tar -xzf "$tgz" -C "$work/tgz/some"
diff -r "$work/deb/usr" "$work/tgz/some" || complain "DEB and TGZ hold different files"
mv "$work/deb/usr" "$work/a/b/moved"
for file in lib/libpose_wall.a include/pose_wall.h include/pose_wall.hpp lib/pkgconfig/pose_wall.pc \
  lib/cmake/pose_wall/pose_wall-config.cmake share/doc/libpose-wall-dev/copyright \
  share/doc/libpose-wall-dev/pose_wall.spdx.json share/doc/libpose-wall-dev/plc/FB_PoseWall.st; do
  [ -s "$work/a/b/moved/$file" ] || complain "the package has no $file"
done
case $architecture in
  amd64) machine=X86-64 ;;
  arm64) machine=AArch64 ;;
  *) complain "architecture $architecture is not known here" ;;
esac
readelf -h "$work/a/b/moved/lib/libpose_wall.a" | grep -q "Machine:.*$machine" ||
  complain "the archive is not for $machine"

for prefix in "$work/a/b/moved" "$work/tgz/some"; do
  "$source/tests/checks/consume.sh" "$cmake" "$source" "$prefix" "$cc" "$cxx" "$toolchain" "$@"
done
[ -n "${POSE_WALL:-}" ] || exit 0
export PKG_CONFIG_LIBDIR="$work/a/b/moved/lib/pkgconfig"
# shellcheck disable=SC2046  # words
"$cc" -std=c99 -O2 "$source/tools/plc/controller.c" $(pkg-config --cflags --libs pose_wall) -o "$work/controller"
python3 "$source/tests/checks/check_controller.py" "$source" "$POSE_WALL" "$work/controller" "$@"
