#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Rules for every source file: two licence lines first, lines up to 120 characters (but for *.def, whose rows are one
line each), no unfinished work, no paths of one machine; and no heaps: half of all files are shorter than 150 lines.

usage: check_house.py ROOT         exit status 1 and one line per broken rule"""

import pathlib
import re
import statistics
import sys

FOLDERS = ("include", "src", "tools", "tests", "bench", "toolchains")
SUFFIXES = {".c", ".h", ".cpp", ".hpp", ".def", ".py", ".sh", ".cmake"}
LICENCE = ("SPDX-License-Identifier: BSD-3-Clause", "Copyright (c) 2026 the pose_wall authors")
UNFINISHED = re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X)\b")
MACHINE_PATH = re.compile(r"/(ho" r"me|ro" r"ot|wo" r"rk|Us" r"ers)/\w")
LONGEST_LINE = 120
MEDIAN_LINES = 150


def files(root):
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in SUFFIXES or path.name == "CMakeLists.txt":
                yield path


def faults(path, lines):
    first = [line for line in lines[:4] if not line.startswith("#!")][:2]
    if len(first) < 2 or not all(text in line for text, line in zip(LICENCE, first)):
        yield 1, "does not begin with the two licence lines"
    for number, line in enumerate(lines, 1):
        if len(line) > LONGEST_LINE and path.suffix != ".def":
            yield number, f"{len(line)} characters; {LONGEST_LINE} are allowed"
        if UNFINISHED.search(line):
            yield number, "unfinished work"
        if MACHINE_PATH.search(line):
            yield number, "a path of one machine"


def main():
    root = pathlib.Path(sys.argv[1])
    found, lengths = [], []
    for path in files(root):
        lines = path.read_text(encoding="utf-8").splitlines()
        lengths.append(len(lines))
        found += [f"{path.relative_to(root)}:{number}: {fault}" for number, fault in faults(path, lines)]
    if not lengths:
        sys.exit(f"{root} holds no sources: nothing was checked")
    median = statistics.median(lengths)
    if median >= MEDIAN_LINES:
        found.append(f"the median file has {median:.0f} lines; fewer than {MEDIAN_LINES} are asked")
    print("\n".join(found) or f"{len(lengths)} files, median {median:.0f} lines")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
