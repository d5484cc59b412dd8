#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# The example of two engines is strict C99, links with the C compiler and the archive alone, releases all seven values
# while both sensors are right, and withholds what it must for each of its faults.
# usage: check_two_engines.sh CC INCLUDE_DIR ARCHIVE TWO_ENGINES.c [EMULATOR...]
set -eu
cc=$1 include=$2 archive=$3 source=$4
shift 4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cc" -std=c99 -pedantic-errors -Wall -Wextra -Werror -O2 -I"$include" "$source" "$archive" -lm -o "$work/two_engines"

faults=0
asks() { # what must be there, how often
  found=$(grep -cE "$1" "$work/output" || true)
  if [ "$found" -ne "$2" ]; then
    echo "$fault: $found lines hold '$1', not $2"
    faults=1
  fi
}
for fault in none scaled blind bit; do
  status=0
  "$@" "$work/two_engines" "$fault" > "$work/output" || status=$?
  [ "$fault" = none ] && expected=0 || expected=3
  [ "$status" -eq "$expected" ] || { echo "$fault: exit status $status, not $expected"; faults=1; }
  case $fault in
    none)
      asks ': 7 of 7 released' 12
      asks 'disagreed  0, missing  0$' 7
      ;;
    scaled)
      asks ': 3 of 7 released' 12
      asks '^d_.. .*disagreed 12, missing  0, latched$' 4
      asks '^yaw .*disagreed  0' 1
      ;;
    blind)
      asks ': 7 of 7 released' 6
      asks ': 0 of 7 released' 6
      asks 'disagreed  0, missing  6$' 7
      ;;
    bit)
      asks ': 7 of 7 released' 6
      asks 'withheld for good' 1
      ;;
  esac
  [ "$faults" -eq 0 ] || sed "s/^/  /" "$work/output"
done
[ "$faults" -eq 0 ] && echo "releases what agrees, withholds what does not"
exit "$faults"
