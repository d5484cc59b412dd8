#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Fuzzes, one process per target and as many side by side as the machine has processors, then shrinks what was found
# worth keeping and prints a table. Needs `cmake --preset fuzz && cmake --build --preset fuzz`.
# usage: tests/fuzz/run.sh [SECONDS per target, 60] [TARGET...]      without names: all targets
#        JOBS=n      so many side by side
#        TIMEOUT=n   an input that takes more than so many seconds (10) is a finding; more on a machine that is busy
# Grown corpora: build/fuzz/corpus/TARGET, begun from tests/fuzz/corpus/TARGET; findings: build/fuzz/findings/TARGET;
# logs: build/fuzz/logs/TARGET.log. Exit status 1 where there are findings.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=build/fuzz
seconds=${1:-60}
shift || true
case $seconds in *[!0-9]* | '') echo "usage: $0 [SECONDS] [TARGET...]" >&2 && exit 2 ;; esac
targets=${*:-$(find $build/tests -maxdepth 1 -name 'pose_wall_*_fuzz' | sed -E 's/.*pose_wall_(.*)_fuzz/\1/' | sort)}
[ -n "$targets" ] || { echo "nothing is built: cmake --preset fuzz && cmake --build --preset fuzz" >&2 && exit 2; }
mkdir -p $build/logs

# The largest input that is tried: as much as a target can use, no more.
max_len_of() {
  case $1 in
    sequence | motion | memento) echo 400 ;;
    config) echo 512 ;;
    work) echo 64 ;;
    planar_scans | planar_clouds | route) echo 400 ;;
    image | frame | pgm | carmen_log) echo 2048 ;;
    kitti | text_points | csv | hesai_angles) echo 1024 ;;
    config_file) echo 4096 ;;
    *) echo 14336 ;;
  esac
}

options_of() { # what both fuzzing and shrinking are given
  local words=tests/fuzz/words/$1.dict
  echo "-max_len=$(max_len_of "$1") -timeout=${TIMEOUT:-10} -report_slow_units=${TIMEOUT:-10} -rss_limit_mb=2048"
  echo "-artifact_prefix=$build/findings/$1/"
  [ ! -f "$words" ] || echo "-dict=$words"
}

fuzz() { # target
  local program=$build/tests/pose_wall_$1_fuzz corpus=$build/corpus/$1 noted=tests/fuzz/corpus/$1 options
  mkdir -p "$corpus" "$build/findings/$1" "$noted"
  options=$(options_of "$1" | tr '\n' ' ')
  # A crash ends libFuzzer; what is left of the time goes on behind it, so that one finding does not hide the next.
  local until=$(($(date +%s) + seconds)) left
  : > "$build/logs/$1.log"
  while left=$((until - $(date +%s))) && [ "$left" -gt 0 ]; do
    # shellcheck disable=SC2086  # a list of words
    "$program" $options -max_total_time=$left -print_final_stats=1 "$corpus" "$noted" \
      >> "$build/logs/$1.log" 2>&1 && break
    [ "$(find "$build/findings/$1" -type f | wc -l)" -lt 20 ] || break
  done
  # shellcheck disable=SC2086
  rm -rf "$corpus.small" && mkdir "$corpus.small" &&
    "$program" $options -merge=1 "$corpus.small" "$noted" "$corpus" >> "$build/logs/$1.merge.log" 2>&1 &&
    rm -rf "$corpus" && mv "$corpus.small" "$corpus"
}

row() { # target: executions, edges and features reached, findings
  local log=$build/logs/$1.log sum cov
  sum=$(awk '/stat::number_of_executed_units/ { n += $2 } END { print n + 0 }' "$log")
  cov=$(grep -oE 'cov: [0-9]+ ft: [0-9]+' "$log" | awk '{ if ($2 > c) c = $2; if ($4 > f) f = $4 }
    END { print c + 0, f + 0 }')
  # shellcheck disable=SC2086
  printf '%-12s %12s %8s %9s %8s %8s %9s\n' "$1" "$sum" $cov "$(find $build/corpus/$1 -type f | wc -l)" "$seconds" \
    "$(find "$build/findings/$1" -type f | wc -l)"
}

running=0
for target in $targets; do
  [ -x "$build/tests/pose_wall_${target}_fuzz" ] || { echo "no target $target" >&2 && exit 2; }
  fuzz "$target" &
  running=$((running + 1))
  if [ "$running" -ge "${JOBS:-$(nproc)}" ]; then
    wait -n || true
    running=$((running - 1))
  fi
done
wait || true

printf '%-12s %12s %8s %9s %8s %8s %9s\n' target executions edges features inputs seconds findings
for target in $targets; do row "$target"; done
for target in $targets; do
  grep -q 'stat::number_of_executed_units: *[1-9]' "$build/logs/$target.log" || {
    echo "$target has not run: see $build/logs/$target.log" && exit 1
  }
done
found=$(for target in $targets; do find "$build/findings/$target" -type f; done)
[ -n "$found" ] || exit 0
printf 'Findings, each again by build/fuzz/tests/pose_wall_TARGET_fuzz FILE:\n%s\n' "$found"
exit 1
