#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# check_report.sh POSE_WALL PYTHON [SCREENSHOT_PREFIX]: a report of a simulated drive, used in a headless browser.
set -eu
pose_wall=$1 python=$2
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$pose_wall" sim --scene nominal --sensor vlp16 --frames 40 --set speed_mps=0.3 --quiet --output "$folder/road"
echo "no cloud" > "$folder/road/frames/000017b.pcd"
status=0
"$pose_wall" report --quiet --config "$folder/road/pose_wall.yaml" --truth "$folder/road/truth.csv" \
  --output "$folder/report.html" "$folder/road/frames" 2> "$folder/said" || status=$?
if [ "$status" -ne 1 ] || ! grep -q 000017b.pcd "$folder/said" || grep -q "stamps differ" "$folder/said"; then
  cat "$folder/said"
  echo "the broken frame was not named, or took the truth of another"
  exit 1
fi
"$python" "$here/check_report_page.py" "$folder/report.html" 41 ${3:+"$3"}

# The same values from their table alone.
"$pose_wall" run --quiet --config "$folder/road/pose_wall.yaml" --output "$folder/out.csv" "$folder/road/frames" \
  2> /dev/null || true
"$pose_wall" report --quiet --output "$folder/table.html" "$folder/out.csv"
"$python" "$here/check_table_page.py" "$folder/table.html" 41
if "$python" "$here/check_table_page.py" "$folder/report.html" 41 > /dev/null 2>&1; then
  echo "a page of frames was let through as one of a table"
  exit 1
fi

# A check that cannot fail is none: a broken script, and a page that draws what is not valid as if it were.
for fault in 's/function show_frame/function show_no_frame/' 's/number not-valid/number/'; do
  sed "$fault" "$folder/report.html" > "$folder/broken.html"
  if "$python" "$here/check_report_page.py" "$folder/broken.html" 41 > /dev/null 2>&1; then
    echo "a broken page was let through: $fault"
    exit 1
  fi
done
