#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# check_report_view.sh POSE_WALL PYTHON HAS_THREE [SCREENSHOT_PREFIX]: what a reader does with a report of a simulated
# drive and with one of its table, in a headless browser. HAS_THREE: 1 where the build found three.js.
set -eu
pose_wall=$1 python=$2 has_three=$3
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$pose_wall" sim --scene nominal --sensor vlp16 --frames 40 --set speed_mps=0.3 --quiet --output "$folder/road"
"$pose_wall" report --quiet --config "$folder/road/pose_wall.yaml" --truth "$folder/road/truth.csv" \
  --output "$folder/report.html" "$folder/road/frames"
"$pose_wall" run --quiet --config "$folder/road/pose_wall.yaml" --output "$folder/out.csv" "$folder/road/frames" \
  2> /dev/null
"$pose_wall" report --quiet --output "$folder/table.html" "$folder/out.csv"
use() { # report
  "$python" "$here/check_report_view.py" "$1" "$folder/table.html" "$folder/out.csv" "$has_three" ${2:+"$2"}
}
use "$folder/report.html" ${4:+"$4"}

# A check that cannot fail is none.
sed 's/for (let f = this.frame + step;/for (let f = this.frame;/' "$folder/report.html" > "$folder/broken.html"
if use "$folder/broken.html" > /dev/null 2>&1; then
  echo "a time line that stands still was let through"
  exit 1
fi
