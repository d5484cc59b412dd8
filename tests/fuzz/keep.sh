#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Takes from the grown corpora (build/fuzz/corpus) into tests/fuzz/corpus what reaches most: files under 16 kB, so many
# per target that all of it stays under 600 kB. Inputs that have a name (findings that were mended) stay.
# usage: tests/fuzz/keep.sh [TARGET...]
set -euo pipefail
cd "$(dirname "$0")/../.."
build=build/fuzz
room_of() { # bytes for a target's inputs
  case $1 in
    sequence) echo 30000 ;;
    box | box_file) echo 90000 ;;
    *) echo 40000 ;;
  esac
}
targets=${*:-$(find $build/tests -maxdepth 1 -name 'pose_wall_*_fuzz' | sed -E 's/.*pose_wall_(.*)_fuzz/\1/' | sort)}
for target in $targets; do
  noted=tests/fuzz/corpus/$target
  small=$build/keep/$target
  rm -rf "$small" && mkdir -p "$small" "$noted"
  "$build/tests/pose_wall_${target}_fuzz" -merge=1 -max_len=15000 "$small" "$noted" "$build/corpus/$target" \
    > "$build/logs/$target.keep.log" 2>&1
  # libFuzzer names inputs by their SHA-1; a finding's name says what it was.
  find "$noted" -type f -regextype posix-extended -regex '.*/[0-9a-f]{40}' -delete
  left=$(room_of "$target")
  # Small ones first: they reach the most per byte.
  while read -r bytes file; do
    [ "$bytes" -le "$left" ] || break
    cp "$file" "$noted/"
    left=$((left - bytes))
  done < <(find "$small" -type f -size -16000c -printf '%s %p\n' | sort -n)
  echo "$target: $(find "$noted" -type f | wc -l) inputs, $(du -sb "$noted" | cut -f1) bytes"
done
du -sb tests/fuzz/corpus | cut -f1
