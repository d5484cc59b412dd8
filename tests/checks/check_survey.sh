#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# tools/survey/trial.sh in a box of four faces: all values are valid and none is wrong, and the table says so.
# usage: check_survey.sh SOURCE_DIR POSE_WALL; 77: this build reads no surfaces
set -eu
source=$1
POSE_WALL=$2
export POSE_WALL
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for x in -30 30; do
  for y in -2.4 2.4; do
    for z in 0 3.6; do echo "v $x $y $z"; done
  done
done > "$work/box.obj"
printf 'f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\n' >> "$work/box.obj"
printf '%s\n' '0 0 0.2 1.3 0 0 0 1' '1 3 -0.2 1.4 0 0 0.0349995 0.9993873' > "$work/path.tum"

trial=$source/tools/survey/trial.sh
if ! table=$("$trial" "$work/box.obj" "$work/path.tum" "$work/trial" vlp16 2> "$work/errors"); then
  cat "$work/errors"
  ! grep -q libembree "$work/errors" || exit 77
  exit 1
fi
echo "$table"
echo "$table" | grep -Eq '^vlp16 +14 of +14 +0 +0 ' ||
  { echo "not all of the 14 values are valid and true"; exit 1; }
[ -s "$work/trial/vlp16/errors.txt" ] || { echo "there is no errors.txt"; exit 1; }
