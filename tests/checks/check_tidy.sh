#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# usage: check_tidy.sh SOURCE_DIR [FILE...]
#
# clang-tidy over files of src, all when none is named; any finding fails.
# A header is looked at through the file of its name, or else through the first that includes it.
set -euo pipefail

cd "$1"
shift
mkdir -p build/logs
# Clang reads no headers that gcc precompiled.
cmake --preset release -B build/tidy -DPOSE_WALL_BUILD_TESTS=OFF -DPOSE_WALL_QUICK_BUILD=OFF \
  > build/logs/tidy_configure.log
# Most files are compiled twice: as delivered, and with the notes of a traced frame, which has all of the other.
python3 - build/tidy/compile_commands.json << 'END'
import json, sys
commands = sorted(json.load(open(sys.argv[1])), key=lambda c: "_traced_objects" in c["command"])
json.dump(list({c["file"]: c for c in commands}.values()), open(sys.argv[1], "w"))
END

files() {
  if [ $# -eq 0 ]; then
    find src -name '*.cpp'
  else
    for file in "$@"; do
      [ -f "$file" ] || continue
      case $file in
        *.cpp) echo "$file" ;;
        *.hpp)
          if [ -f "${file%.hpp}.cpp" ]; then
            echo "${file%.hpp}.cpp"
          else
            { grep -rl --include='*.cpp' "\"${file#src/}\"" src || true; } | sort | sed -n 1p
          fi
          ;;
      esac
    done | sort -u
  fi
}

list=$(files "$@")
[ -n "$list" ] || { echo "no file of src among those named: nothing was checked"; exit 1; }
echo "$list" | tr '\n' '\0' | xargs -0 -P "$(nproc)" -n 1 clang-tidy -p build/tidy --quiet --warnings-as-errors='*'
echo "$(echo "$list" | wc -l) files as .clang-tidy says"
