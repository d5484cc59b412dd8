#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# A program linked of two libraries holds the functions of both: as many of each name as the two have together.
# usage: check_kept.sh NM FIRST SECOND PROGRAM
set -eu
export LC_ALL=C
nm=$1 first=$2 second=$3 program=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

functions() { "$nm" --defined-only "$@" | awk 'NF == 3 && $2 ~ /^[TtWwu]$/ {print $3}' | sort; }
functions "$first" "$second" | uniq -c > "$work/given"
functions "$program" | uniq -c > "$work/kept"
# By name: how many were given, how many are there. What only the program has (main, start-up code) is left out.
awk 'NR == FNR {kept[$2] = $1; next}
     {all += $1}
     kept[$2] + 0 < $1 {print $2 ": " kept[$2] + 0 " of " $1 " left"; bad = 1}
     $1 > 1 {twice += 1}
     END {if (!twice) {print "no function is in both: nothing was checked"; exit 1}
          if (bad) exit 1; print all " functions, " twice " names in both, all kept"}' "$work/kept" "$work/given"
