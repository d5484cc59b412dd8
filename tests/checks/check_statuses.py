#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""One list of status codes for all libraries: no number means two things, and every text function says the same of it.

usage: check_statuses.py ROOT PROGRAM...     exit status 1 and one line per fault

The enums pose_wall_*status of the headers, the ranges of include/README.md and the rows STATUS of
src/engine/names.def must agree. PROGRAM is built from statuses.c."""

import pathlib
import re
import subprocess
import sys

ENUM = re.compile(r"\benum (pose_wall_(?:\w+_)?status) \{(.*?)\};", re.S)
MEMBER = re.compile(r"^\s*(POSE_WALL_\w+)\s*=\s*(-?\d+)", re.M)
ROW = re.compile(r'^STATUS\((\w+), (-?\d+), "(.*)"\)$', re.M)
RANGE = re.compile(r"^\| (-\d+) to (-\d+) \| \[(pose_wall\w*\.h)\]", re.M)
OK = "POSE_WALL_OK"  # the only one that every header shares
UNKNOWN = "unknown status"


def statuses_of(root):
    """[(header, name, number)] of all enums."""
    found = []
    for header in sorted((root / "include").glob("*.h")):
        for enum in ENUM.finditer(header.read_text(encoding="utf-8")):
            body = re.sub(r"/\*.*?\*/", "", enum[2], flags=re.S)
            found += [(header.name, name, int(number)) for name, number in MEMBER.findall(body)]
    return found


def faults_of_numbers(statuses, ranges):
    owners = {}
    for header, name, number in statuses:
        if number in owners:
            yield f"{number} is {owners[number]} and {name}: a number means one thing"
        owners[number] = name
        first, last = ranges.get(header, (0, 1))
        if name != OK and not last <= number <= first:
            yield f"{header}: {name} = {number} lies outside the range that include/README.md gives this header"


def faults_of_rows(statuses, rows):
    numbers = {name: number for _, name, number in statuses}
    listed = {name: int(number) for name, number, _ in rows}
    for name in sorted(numbers.keys() | listed.keys()):
        if numbers.get(name) != listed.get(name):
            yield f"{name} is {numbers.get(name)} in the headers and {listed.get(name)} in src/engine/names.def"
    texts = [text for _, _, text in rows]
    for text in sorted({text for text in texts if texts.count(text) > 1}):
        yield f"'{text}' is said of two statuses"


def faults_of_texts(rows, lines):
    expected = {int(number): text for _, number, text in rows}
    said = [line.split("\t") for line in lines]
    for number, library, text in said:
        if text != expected.get(int(number), UNKNOWN):
            yield f"{library} says '{text}' of {number}, and the list '{expected.get(int(number), UNKNOWN)}'"
    for number in sorted(expected.keys() - {int(number) for number, _, _ in said}):
        yield f"{number} was not asked for"


def main():
    root, program = pathlib.Path(sys.argv[1]), sys.argv[2:]
    statuses = statuses_of(root)
    page = (root / "include/README.md").read_text(encoding="utf-8")
    ranges = {header: (int(first), int(last)) for first, last, header in RANGE.findall(page)}
    rows = ROW.findall((root / "src/engine/names.def").read_text(encoding="utf-8"))
    faults = list(faults_of_numbers(statuses, ranges)) + list(faults_of_rows(statuses, rows))
    if not statuses or not ranges:
        faults.append("no statuses or no ranges: nothing was checked")
    done = subprocess.run(program, check=True, capture_output=True, text=True)
    faults += faults_of_texts(rows, done.stdout.splitlines())
    print("\n".join(faults) if faults else f"{len(statuses)} statuses of {len(ranges)} headers")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
