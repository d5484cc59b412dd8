#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Puts second_ before every global name that an object defines, and leaves what it asks for alone.
# usage: rename.sh NM OBJCOPY IN OUT
set -eu
nm=$1 objcopy=$2 in=$3 out=$4
"$nm" --defined-only --extern-only "$in" | awk 'NF == 3 {print $3, "second_" $3}' > "$out.names"
"$objcopy" --redefine-syms="$out.names" "$in" "$out"
