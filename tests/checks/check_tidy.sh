#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# usage: check_tidy.sh SOURCE_DIR [FILE...]      clang-tidy over files of src, all when none is named; any finding fails.
# A header is looked at through the file of its name.
set -euo pipefail

cd "$1"
shift
mkdir -p build/logs
# Clang reads no headers that gcc precompiled.
cmake --preset release -B build/tidy -DPOSE_WALL_BUILD_TESTS=OFF -DPOSE_WALL_QUICK_BUILD=OFF > build/logs/tidy_configure.log
# Most files are compiled twice: as delivered, and with the notes of a traced frame, which has all of the other.
python3 - build/tidy/compile_commands.json << 'END'
import json, sys
commands = {c["file"]: c for c in sorted(json.load(open(sys.argv[1])), key=lambda c: "pose_wall_traced_objects" in c["command"])}
json.dump(list(commands.values()), open(sys.argv[1], "w"))
END

files() {
  if [ $# -eq 0 ]; then
    find src -name '*.cpp'
  else
    printf '%s\n' "$@" | sed -E 's/\.hpp$/.cpp/' | sort -u | while read -r file; do
      case $file in *.cpp) [ ! -f "$file" ] || echo "$file" ;; esac
    done
  fi
}

files "$@" | tr '\n' '\0' | xargs -0 -r -P "$(nproc)" -n 1 clang-tidy -p build/tidy --quiet --warnings-as-errors='*'
