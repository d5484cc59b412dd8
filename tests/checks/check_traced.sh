#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Nothing of a trace is in the archive that is delivered, not even a local symbol; and the one that takes notes
# defines what its header declares and no more, so that both may be in one program.
# usage: check_traced.sh NM ARCHIVE TRACED_ARCHIVE HEADER
set -eu
export LC_ALL=C
nm=$1 archive=$2 traced=$3 header=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$nm" "$archive" > "$work/plain"
[ -s "$work/plain" ] || { echo "$archive defines nothing: nothing was checked"; exit 1; }
if grep -i 'trace' "$work/plain"; then
  echo "$archive holds the symbols above, which belong to the traced library"
  exit 1
fi
"$nm" "$traced" | awk 'NF == 3 && $2 ~ /^[A-Zu]$/ {print $3}' | sort -u > "$work/defined"
sed -e 's:/\*.*\*/::' "$header" | sed '/\/\*/,/\*\//d' | grep -oE 'pose_wall_(motion_)?trace_[a-z0-9_]+\(' | tr -d '(' |
  sort -u > "$work/declared"
[ -s "$work/declared" ] || { echo "$header declares nothing: nothing was checked"; exit 1; }
if ! diff "$work/declared" "$work/defined"; then
  echo "$traced defines (>) otherwise than $header declares (<)"
  exit 1
fi
echo "$(wc -l < "$work/plain") symbols without a trace; the traced library defines $(tr '\n' ' ' < "$work/defined")"
