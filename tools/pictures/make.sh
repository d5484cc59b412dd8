#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Makes the pictures of README.md and of the guided tour (tools/README.md) anew, by the commands that they show.
# usage: make.sh POSE_WALL [demo | report | states]...     all without a name
#   demo     demo.png and demo_props.png; needs rsvg-convert (librsvg2-bin)
#   report   report.png; needs chromium, as does
#   states   valid.png and not_valid.png: a road whose values are valid, and one whose values mostly are not
set -eu
pose_wall=$(realpath "$1")
shift
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# screenshot PAGE PICTURE WIDTH,HEIGHT SCALE
screenshot() {
  chromium --headless=new --no-sandbox --disable-gpu --hide-scrollbars --host-resolver-rules='MAP * ~NOTFOUND' \
    --window-size="$3" --force-device-scale-factor="$4" --virtual-time-budget=3000 \
    --screenshot="$2" "file://$folder/$1" 2> said || {
    cat said
    exit 1
  }
}

demo() {
  "$pose_wall" demo --quiet --output front
  rsvg-convert --width 1100 front/demo.svg > "$here/demo.png"
  "$pose_wall" demo --quiet --scene props --sensor vlp16 --frames 30 --output demo
  rsvg-convert --width 1000 demo/demo.svg > "$here/demo_props.png"
}

report() {
  "$pose_wall" sim --quiet --scene nominal --sensor os1-64 --frames 60 --set speed_mps=0.3 --output road
  "$pose_wall" report --quiet --config road/pose_wall.yaml --truth road/truth.csv --output road.html road/frames
  screenshot road.html "$here/report.png" 1150,1250 1
}

# state_picture PICTURE SCENE SENSOR FRAME TITLE: that frame of 20, and the verdict on all of them.
state_picture() {
  "$pose_wall" sim --quiet --scene "$2" --sensor "$3" --seed 1 --frames 20 --set speed_mps=0.3 --output "$2"
  "$pose_wall" report --quiet --language en --title "$5" --points 20000 --config "$2/pose_wall.yaml" \
    --truth "$2/truth.csv" --output "$2.html" "$2/frames"
  # A style behind the page's own wins.
  { cat "$2.html"; echo "<style>"; cat "$here/small_report.css"; echo "</style>"; } > "$2_small.html"
  screenshot "$2_small.html#$4" "$here/$1" 420,510 1.6
}

states() {
  state_picture valid.png shotcrete os1-64 10 "Shotcrete walls, 64 lines"
  state_picture not_valid.png hard_day vlp16 12 "A hard day, 16 lines"
}

[ $# -gt 0 ] || set -- demo report states
for name in "$@"; do
  "$name"
done
ls -l "$here"
