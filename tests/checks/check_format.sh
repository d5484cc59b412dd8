#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Every C and C++ file is as clang-format 14 writes it (other versions break lines elsewhere, so they are not asked).
# usage: check_format.sh ROOT
set -eu
cd "$1"
formatter=$(command -v clang-format-14 || command -v clang-format) || { echo "clang-format is missing"; exit 1; }
version=$("$formatter" --version)
echo "$version" | grep -q 'version 14\.' || { echo "need clang-format 14, found $version"; exit 1; }
list=$(find include src tools tests bench -name '*.c' -o -name '*.h' -o -name '*.cpp' -o -name '*.hpp' | sort)
[ -n "$list" ] || { echo "no sources found: nothing was checked"; exit 1; }
# shellcheck disable=SC2086  # our file names hold no spaces
"$formatter" --dry-run --Werror $list
echo "$(echo "$list" | wc -l) files formatted as .clang-format says"
