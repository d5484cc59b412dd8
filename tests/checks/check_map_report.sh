#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# check_map_report.sh POSE_WALL PYTHON [SCREENSHOT_PREFIX]: a report of a map and of scans that are found in it, used in
# a headless browser. The log is a robot's round in a drawn room.
set -eu
pose_wall=$1 python=$2
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$python" - "$folder" <<'END'
import math, pathlib, sys
WALLS = [(-6, -3.5, 6, -3.5), (6, -3.5, 6, 1), (6, 1, 4.5, 1), (4.5, 1, 4.5, 3.5), (4.5, 3.5, -6, 3.5),
         (-6, 3.5, -4.5, -3.5), (-1, -1, 0, -1.4), (0, -1.4, 0, -0.4), (0, -0.4, -1, -1)]
def seen(x, y, angle):
    c, s, best = math.cos(angle), math.sin(angle), 80.0
    for x1, y1, x2, y2 in WALLS:
        ex, ey = x2 - x1, y2 - y1
        det = c * ey - s * ex
        if abs(det) < 1e-12:
            continue
        t, u = ((x1 - x) * ey - (y1 - y) * ex) / det, ((x1 - x) * s - (y1 - y) * c) / det
        if t > 0 and 0 <= u <= 1:
            best = min(best, t)
    return best
lines = []
for k in range(100):
    a = 0.05 * k
    x, y = 2 + 1.5 * math.sin(a), -1.5 * math.cos(a)
    ranges = " ".join(f"{seen(x, y, a + math.radians(i - 90)):.3f}" for i in range(180))
    pose = f"{x:.6f} {y:.6f} {a:.6f}"
    lines.append(f"FLASER 180 {ranges} {pose} {pose} {1000 + 0.1 * k:.6f} host 0.1\n")
pathlib.Path(sys.argv[1], "room.clf").write_text("".join(lines))
END
"$pose_wall" map --quiet --output "$folder/map" --poses "$folder/poses.tum" "$folder/room.clf"
"$pose_wall" localise --quiet --output "$folder/found" --set map_is_whole=1 --set work=1000000000 \
  --truth "$folder/poses.tum" "$folder/map" "$folder/room.clf" > /dev/null
"$pose_wall" report --quiet --output "$folder/report.html" "$folder/map" "$folder/found"
"$python" "$here/check_map_page.py" "$folder/report.html" 2 ${3:+"$3"}

# A check that cannot fail is none.
sed 's/^show_all();/show_nothing();/' "$folder/report.html" > "$folder/broken.html"
if "$python" "$here/check_map_page.py" "$folder/broken.html" 2 > /dev/null 2>&1; then
  echo "a page with a broken script was let through"
  exit 1
fi
