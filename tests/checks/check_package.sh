#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# The library's packages hold the same files, of the right machine, and serve users' projects wherever they are
# unpacked. The command's package (amd64) depends on what the command needs, and the command runs. The daemon's (amd64)
# runs and finds its program of ROS 1. With POSE_WALL in the
# environment (the native command), a controller linked from the package must print the numbers of `pose_wall run`. The
# Python package (amd64) asks for NumPy and, where that is installed, computes what was tested.
# usage: check_package.sh CMAKE SOURCE_DIR PACKAGES_DIR ARCHITECTURE CC CXX TOOLCHAIN_FILE [EMULATOR...]
# TOOLCHAIN_FILE: - for none
set -eu
cmake=$1 source=$2 packages=$3 architecture=$4 cc=$5 cxx=$6 toolchain=$7
shift 7
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
complain() { echo "$1"; exit 1; }

version=$(sed -n 's/^project(pose_wall VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt")
named() { # package, ending: packages of older versions may lie beside
  [ -s "$packages/$1_${version}_$architecture.$2" ] || complain "$packages has no $1_${version}_$architecture.$2"
}

if [ "$architecture" = amd64 ]; then
  named pose-wall deb
  deb=$packages/pose-wall_${version}_$architecture.deb
  depends=$(dpkg-deb -f "$deb" Depends)
  case $depends in
    *libyaml*) ;;
    *) complain "$deb: depends on '$depends'; the command needs libyaml" ;;
  esac
  dpkg-deb -x "$deb" "$work/command"
  found=$("$work/command/usr/bin/pose_wall" --version) || complain "$deb: the command does not run"
  case $found in
    *"$version"*) ;;
    *) complain "$deb: the command says it is '$found', not $version" ;;
  esac
  for file in man/man1/pose_wall.1 bash-completion/completions/pose_wall zsh/site-functions/_pose_wall \
    fish/vendor_completions.d/pose_wall.fish pose_wall/config/vlp16.yaml; do
    [ -s "$work/command/usr/share/$file" ] || complain "$deb has no share/$file"
  done
  # Elsewhere than in the source tree, whose configs it would find as well.
  found=$(cd / && "$work/command/usr/bin/pose_wall" check-config vlp16) || complain "$deb: --config vlp16 is not found"
  case $found in
    *"share/pose_wall/config/vlp16.yaml"*) ;;
    *) complain "$deb: the config vlp16 is not the package's" ;;
  esac

  named pose-walld deb
  deb=$packages/pose-walld_${version}_$architecture.deb
  dpkg-deb -x "$deb" "$work/daemon"
  found=$("$work/daemon/usr/bin/pose_walld" --version) || complain "$deb: the daemon does not run"
  case $found in
    *"$version"*) ;;
    *) complain "$deb: the daemon says it is '$found', not $version" ;;
  esac
  # The topic is refused after the program was found, or because this build has no ROS 1.
  found=$("$work/daemon/usr/bin/pose_walld" --set source=ros1 --set "pointcloud_topic=no topic" 2>&1) || true
  case $found in
    *"is no topic of ROS"* | *"this build has no ROS 1"*) ;;
    *) complain "$deb: the daemon does not find its program of ROS 1: $found" ;;
  esac

  named python3-pose-wall deb
  deb=$packages/python3-pose-wall_${version}_$architecture.deb
  depends=$(dpkg-deb -f "$deb" Depends)
  case $depends in
    *python3-numpy*libc6*) ;;
    *) complain "$deb: depends on '$depends'; the module needs python3-numpy and libc6" ;;
  esac
  dpkg-deb -x "$deb" "$work/python"
  if /usr/bin/python3 -c "import numpy" 2> /dev/null; then
    found=$(PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$work/python/usr/lib/python3/dist-packages" /usr/bin/python3 -c \
      'import pose_wall; print(pose_wall.__version__, pose_wall.__file__, pose_wall.self_test())') ||
      complain "$deb: the module does not work"
    case $found in
      "$version $work/python/"*) ;;
      *) complain "$deb: the module says '$found', not $version" ;;
    esac
  else
    echo "not tried: $deb, for NumPy is not installed (python3-numpy)"
  fi
fi

named libpose-wall-dev deb
named libpose-wall-dev tar.gz
deb=$packages/libpose-wall-dev_${version}_$architecture.deb
tgz=${deb%.deb}.tar.gz
for field in Package:libpose-wall-dev "Architecture:$architecture" Section:libdevel Depends: "Version:$version"; do
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
for file in lib/libpose_wall.a lib/libpose_wall_motion.a lib/libpose_wall_planar.a \
  include/pose_wall.h include/pose_wall.hpp \
  include/pose_wall_motion.h include/pose_wall_planar.h include/pose_wall_planar_slam.h \
  lib/pkgconfig/pose_wall.pc lib/pkgconfig/pose_wall_motion.pc lib/pkgconfig/pose_wall_planar.pc \
  lib/cmake/pose_wall/pose_wall-config.cmake share/doc/libpose-wall-dev/copyright \
  share/doc/libpose-wall-dev/pose_wall.spdx.json share/doc/libpose-wall-dev/plc/FB_PoseWall.st; do
  [ -s "$work/a/b/moved/$file" ] || complain "the package has no $file"
done
for file in lib/libpose_wall_traced.a include/pose_wall_trace.h \
  lib/libpose_wall_motion_traced.a include/pose_wall_motion_trace.h; do
  [ ! -e "$work/a/b/moved/$file" ] || complain "the package has $file, which is for the command alone"
done
case $architecture in
  amd64) machine=X86-64 ;;
  arm64) machine=AArch64 ;;
  *) complain "architecture $architecture is not known here" ;;
esac
for archive in pose_wall pose_wall_motion pose_wall_planar; do
  readelf -h "$work/a/b/moved/lib/lib$archive.a" | grep -q "Machine:.*$machine" ||
    complain "lib$archive.a is not for $machine"
done

for prefix in "$work/a/b/moved" "$work/tgz/some"; do
  "$source/tests/checks/consume.sh" "$cmake" "$source" "$prefix" "$cc" "$cxx" "$toolchain" "$@"
done
[ -n "${POSE_WALL:-}" ] || exit 0
export PKG_CONFIG_LIBDIR="$work/a/b/moved/lib/pkgconfig"
# shellcheck disable=SC2046  # words
"$cc" -std=c99 -O2 "$source/tools/apps/plc/controller.c" $(pkg-config --cflags --libs pose_wall) -o "$work/controller"
python3 "$source/tests/checks/check_controller.py" "$source" "$POSE_WALL" "$work/controller" "$@"
