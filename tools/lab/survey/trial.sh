#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Tries sensors in a real road: frames with their truth, results, errors, and a table of what became of them.
#
#   tools/lab/survey/trial.sh SURFACE PATH FOLDER [SENSOR...]       PATH: -, the tool proposes one; sensors: see
#                                                               `pose_wall sim --list`
#
# FOLDER gets one folder for each sensor: frames, truth.csv, pose_wall.yaml, out.csv, errors.txt of `pose_wall eval`.
# POSE_WALL names the command; default: build/release/pose_wall. SET holds more words for `pose_wall sim`, as
# SET="--set range_noise_m=0.02 --set dropout=0.02". Frames are 10 s apart, since poses may be far apart: each stands
# alone.
set -euo pipefail

if [ $# -lt 3 ]; then
  sed -n '5,14s/^# \{0,1\}//p' "$0"
  exit 2
fi
surface=$1 path=$2 folder=$3
shift 3
pose_wall=${POSE_WALL:-build/release/pose_wall}
along=(--path "$path")
[ "$path" != - ] || along=()
[ $# -gt 0 ] || set -- velodyne-vlp16 ouster-os1-64 ouster-os0-128 mid360 hesai-xt32

# Of one sensor: values and valid ones, those of them that are wrong, |error| and level of all that were measured (the
# median of angles in degrees, of distances in mm), million steps of work a frame (median, most; an OS1-64 takes 6 to 7
# on an ordinary road), and the reasons that most values give.
row() { # sensor, folder
  awk -F, -v sensor="$1" '
    function median(of, n,   i, j, t) {
      for (i = 2; i <= n; ++i) { t = of[i]; for (j = i - 1; j > 0 && of[j] > t; --j) of[j + 1] = of[j]; of[j + 1] = t }
      return n > 0 ? of[int((n + 1) / 2)] : "nan"
    }
    BEGIN { count = split("roll pitch yaw d_lf d_lb d_rf d_rb", name, " ") }
    FNR == 1 { for (i = 1; i <= NF; ++i) column[FILENAME, $i] = i; next }
    FILENAME == ARGV[1] { for (q = 1; q <= count; ++q) truth[FNR, q] = $column[FILENAME, name[q]]; next }
    {
      step[++frames] = $column[FILENAME, "work"] / 1e6
      if (step[frames] > most) most = step[frames]
      for (q = 1; q <= count; ++q) {
        state = $column[FILENAME, name[q] "_state"]
        raw = $column[FILENAME, name[q] "_raw"]
        level = $column[FILENAME, name[q] "_pl"]
        ++values
        valid += state == "valid"
        if (state != "valid") {
          n = split($column[FILENAME, name[q] "_reason"], why, "|")
          for (i = 1; i <= n; ++i) ++reasons[why[i]]
        }
        if (truth[FNR, q] == "" || (state != "valid" && state != "degraded")) continue
        error = raw - truth[FNR, q]; if (error < 0) error = -error
        unit = q <= 3 ? 57.29578 : 1000
        limit = q <= 3 ? 1 : 100
        misleading += state == "valid" && error * unit > limit
        beyond += error > level
        if (q <= 3) { angle[++angles] = error * unit; angle_level[angles] = level * unit }
        else { way[++ways] = error * unit; way_level[ways] = level * unit }
      }
    }
    END {
      for (k = 1; k <= 3; ++k) {
        best = ""
        for (r in reasons) if (r != "" && r != "stamp_leap" && (best == "" || reasons[r] > reasons[best])) best = r
        if (best != "") { told = told (k > 1 ? ", " : "") best " " reasons[best]; delete reasons[best] }
      }
      printf "%-14s %5d of %5d %10d %10d   %6.2f / %6.2f deg   %5.0f / %5.0f mm   %5.1f, %5.1f   %s\n", sensor, valid,
        values, misleading, beyond, median(angle, angles), median(angle_level, angles), median(way, ways),
        median(way_level, ways), median(step, frames), most, told
    }' "$2/truth.csv" "$2/out.csv"
}

printf '%-14s %14s %10s %10s   %s   %s   %s   %s\n' sensor valid misleading '> level' 'angles: error / level' \
  'ways: error / level' 'million steps' 'reasons of what is not valid'
for sensor in "$@"; do
  of=$folder/$sensor
  # shellcheck disable=SC2086  # words
  "$pose_wall" sim --quiet --surface "$surface" "${along[@]}" --sensor "$sensor" --rate 0.1 ${SET:-} --output "$of"
  "$pose_wall" run --quiet -c "$of/pose_wall.yaml" --output "$of/out.csv" "$of/frames"
  "$pose_wall" eval "$of/out.csv" "$of/truth.csv" > "$of/errors.txt" || true # a verdict, no failure
  row "$sensor" "$of"
done
