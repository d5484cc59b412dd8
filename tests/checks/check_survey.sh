#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# tools/lab/survey/trial.sh in a box of four faces: all values are valid and none is wrong, and the table says so. The
# same box as a class of a campaign, on its card by name. Its rock is flat, and a blasted road beside it is not.
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

trial=$source/tools/lab/survey/trial.sh
if ! table=$("$trial" "$work/box.obj" "$work/path.tum" "$work/trial" vlp16 2> "$work/errors"); then
  cat "$work/errors"
  ! grep -q libembree "$work/errors" || exit 77
  exit 1
fi
echo "$table"
echo "$table" | grep -Eq '^vlp16 +14 of +14 +0 +0 ' ||
  { echo "not all of the 14 values are valid and true"; exit 1; }
[ -s "$work/trial/vlp16/errors.txt" ] || { echo "there is no errors.txt"; exit 1; }

# Near the ends of the box, where the floor ends, angles are not valid.
card=$work/campaign/card.md
"$POSE_WALL" campaign --quiet --scenes clean --sensors vlp16 --draws 1 --surface "$work/box.obj" \
  --output "$work/campaign"
grep -Eq '^\| surveyed \| vlp16 \| mine \| 1 \| 6[0-9] \| [89][0-9.]+ % \| [89][0-9.]+ % \| 100 % ' "$card" ||
  { grep '^| surveyed' "$card"; echo "the card has no row of the box, mostly valid"; exit 1; }
grep -q "each frame by itself: $work/box.obj" "$card" || { echo "the card names no box"; exit 1; }

"$(dirname "$POSE_WALL")/pose_wall_rock" --surface "$work/box.obj" --scene mine_blasted --roads 1 \
  --output "$work/rock" > "$work/rock.txt"
grep -Eq '^walls +along +2 m +0\.0 +0\.0 ' "$work/rock.txt" ||
  { cat "$work/rock.txt"; echo "a box has rough walls"; exit 1; }
awk -F, '$1 == "mine_blasted" && $2 == "walls" && $3 == "along" && $4 == 2 { found = $5 > 0.005 } END { exit !found }' \
  "$work/rock/spectra.csv" || { echo "blasted walls are as flat as a box"; exit 1; }
grep -q '</svg>' "$work/rock/spectra.svg" || { echo "there is no picture"; exit 1; }
