#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Makes the picture of README.md and those of the guided tour (tools/README.md) anew, by the commands that they show.
# usage: make.sh POSE_WALL       needs rsvg-convert (librsvg2-bin) and chromium
set -eu
pose_wall=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$pose_wall" demo --quiet --output front
rsvg-convert --width 1100 front/demo.svg > "$here/../picture/demo.png"
"$pose_wall" demo --quiet --scene props --sensor vlp16 --frames 30 --output demo
rsvg-convert --width 1000 demo/demo.svg > "$here/demo_props.png"
"$pose_wall" sim --quiet --scene nominal --sensor os1-64 --frames 60 --set speed_mps=0.3 --output road
"$pose_wall" report --quiet --config road/pose_wall.yaml --truth road/truth.csv --output road.html road/frames
chromium --headless=new --no-sandbox --disable-gpu --hide-scrollbars --host-resolver-rules='MAP * ~NOTFOUND' \
  --window-size=1150,1000 --virtual-time-budget=3000 \
  --screenshot="$here/report.png" "file://$folder/road.html" 2> said || {
  cat said
  exit 1
}
ls -l "$here"
