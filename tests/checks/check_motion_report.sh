#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# check_motion_report.sh POSE_WALL PYTHON [SCREENSHOT_PREFIX]: a report of a motion table, used in a headless browser.
# The table is written by hand: which states there are does not hang on what the library makes of some road.
set -eu
pose_wall=$1 python=$2
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$python" - "$folder" <<'END'
import pathlib, sys
head = ("frame,source,stamp_ns,x,y,z,qx,qy,qz,qw,along_state,along_m,along_sigma,along_pl,across_pl,up_pl,roll_pl,"
        "pitch_pl,yaw_pl,reason,total_ms,step_x,step_y,step_z,step_rx,step_ry,step_rz,step_along_pl,step_across_pl,"
        "step_up_pl,step_yaw_pl")
rows, truth = [head], ["frame,stamp_ns,x,y,z,qx,qy,qz,qw"]
for i in range(60):
    state, reason, level = "measured", "first" if i == 0 else "", 0.05
    if 20 <= i < 30:
        state, reason, level = "unobservable", "smooth|few_patches", 0.05 + 0.2 * (i - 19)
    if 30 <= i < 35:
        state, reason = "ambiguous", "second_peak"
    x, y = 0.3 * i, 0.002 * i * i
    pose, level = f"{x},{y},0,0,0,0,1", f"{level}"
    if 40 <= i < 43:
        state, reason, pose, x, level = "lost", "few_matches", ",,,,,,", "", "inf"
    if i == 50:
        state, reason, pose, x, level = "unreadable", "unreadable", ",,,,,,", "", ""
    step = "0.3,0,0,0,0,0,0.02,0.01,0.01,0.001" if i and pose[0] != "," else ",,,,,,,,,"
    rows.append(f"{i},road/{i:06}.pcd,{i * 100000000},{pose},{state},{x},0.01,{level},.01,.01,.001,.001,.001,{reason},"
                f"2.5,{step}")
    truth.append(f"{i},{i * 100000000},{0.301 * i},{0.002 * i * i},1.4,0,0,0,1")
folder = pathlib.Path(sys.argv[1])
(folder / "motion.csv").write_text("\n".join(rows) + "\n")
(folder / "truth.csv").write_text("\n".join(truth) + "\n")
END
"$pose_wall" report --quiet --truth "$folder/truth.csv" --output "$folder/report.html" "$folder/motion.csv"
"$python" "$here/check_motion_page.py" "$folder/report.html" 60 41 ${3:+"$3"}

# A check that cannot fail is none.
sed 's/function show_frame/function show_no_frame/' "$folder/report.html" > "$folder/broken.html"
if "$python" "$here/check_motion_page.py" "$folder/broken.html" 60 41 > /dev/null 2>&1; then
  echo "a page with a broken script was let through"
  exit 1
fi
