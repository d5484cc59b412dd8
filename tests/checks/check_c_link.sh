#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# The C example compiles as strict C99, links with the C compiler and the archive alone, needs no C++ library at run
# time, and runs.
# usage: check_c_link.sh CC READELF INCLUDE_DIR "ARCHIVE..." EXAMPLE.c [EMULATOR...]
set -eu
cc=$1 readelf=$2 include=$3 archive=$4 example=$5
shift 5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# shellcheck disable=SC2086  # a list of archives
"$cc" -std=c99 -pedantic-errors -Wall -Wextra -Werror -O2 -I"$include" "$example" $archive -lm -o "$work/example"
"$readelf" -d "$work/example" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' > "$work/needed"
if grep -vE '^(libc|libm|ld-linux[a-z0-9-]*)\.so' "$work/needed"; then
  echo "the example needs the libraries above; the C library is all it may need"
  exit 1
fi
"$@" "$work/example" > "$work/output" || { cat "$work/output"; echo "the example failed"; exit 1; }
echo "links with $cc alone, needs: $(tr '\n' ' ' < "$work/needed")"
