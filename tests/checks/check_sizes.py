#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The memory that a caller provides is as the page of sizes says: blocks within 3 %, structs to the byte.

    check_sizes.py --sizes PAGE MACHINE [--note] [EMULATOR...] PROGRAM

PROGRAM prints a line `COLUMN: NUMBER` for each size (sizes.c)."""

import argparse
import subprocess
import sys

sys.dont_write_bytecode = True  # the sources stay as they are

import sizes_page  # noqa: E402  pylint: disable=wrong-import-position

TOLERANCE = 0.03  # of blocks: a member more is no news, a table more is


def allowed(column, size):
    return 0.0 if column.endswith("bytes") else TOLERANCE * size


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    sizes_page.add_options(parser)
    parser.add_argument("program", nargs="+")
    options = parser.parse_args()
    text = subprocess.run(options.program, check=True, capture_output=True, text=True).stdout
    found = dict(line.rsplit(": ", 1) for line in text.splitlines())
    if not found or not options.sizes:
        sys.exit("nothing was checked")
    faults = sizes_page.check_or_note(options, found, allowed)
    print("\n".join(faults) or text)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
