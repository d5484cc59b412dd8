#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# The archive defines exactly the functions of its headers and asks for nothing but what the lists allow: no heap, no
# C++ runtime, no stdio, no abort; the engine no clock and no thread either.
# usage: check_symbols.sh NM ARCHIVE "HEADER..." "SYMBOLS_ALLOWED..."
set -eu
export LC_ALL=C
nm=$1 archive=$2 header=$3 allowed=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# shellcheck disable=SC2086
names=$(basename -a $header | tr '\n' ' ' | sed 's/ $//')

"$nm" "$archive" > "$work/nm"
awk 'NF == 3 && $2 ~ /^[A-Zu]$/ {print $3}' "$work/nm" | sort -u > "$work/defined"
awk 'NF == 2 && $1 ~ /^[UwvWV]$/ {print $2}' "$work/nm" | sort -u > "$work/imported"
# Comments end up on lines of their own or behind code; a declaration's name is what stands before "(".
# shellcheck disable=SC2086  # lists of files
sed -e 's://.*::' -e 's:/\*.*\*/::' $header | sed '/\/\*/,/\*\//d' | grep -v typedef |
  grep -oE 'pose_wall_[a-z0-9_]+\(' | tr -d '(' | sort -u > "$work/declared"
# shellcheck disable=SC2086
sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' $allowed | sort -u > "$work/allowed"

status=0
complain() { # list, what it means
  if [ -s "$1" ]; then
    sed "s|^|$2: |" "$1"
    status=1
  fi
}
grep -v '^pose_wall_' "$work/defined" > "$work/foreign" || true
complain "$work/foreign" "defined but not named pose_wall_*"
comm -13 "$work/defined" "$work/declared" > "$work/missing"
complain "$work/missing" "declared in $names but not defined"
comm -23 "$work/defined" "$work/declared" | grep '^pose_wall_' > "$work/undeclared" || true
complain "$work/undeclared" "defined but not declared in $names"
comm -23 "$work/imported" "$work/allowed" > "$work/forbidden"
complain "$work/forbidden" "imported but not on the list of allowed symbols"
[ -s "$work/defined" ] || { echo "$archive defines nothing: nothing was checked"; status=1; }

if [ "$status" -eq 0 ]; then
  echo "defines $(wc -l < "$work/defined") functions, imports $(tr '\n' ' ' < "$work/imported")"
fi
exit "$status"
