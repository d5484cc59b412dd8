#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""What a caller of one public header may expect of the next.

usage: check_headers.py ROOT     exit status 1 and one line per
  - function of a header that returns a status without POSE_WALL_CHECKED, and is not among those below
  - constant or macro of pose_wall_planar*.h whose name does not begin with POSE_WALL_PLANAR
  - page or folder that a packaged header names, and that tools/cmake/pose_wall_install.cmake does not install
  - header with a library of its own that include/README.md does not link"""

import pathlib
import re
import sys

STATUS = re.compile(r"^(POSE_WALL_CHECKED )?int32_t (pose_wall_\w+)\(", re.M)
# They fail for wrong arguments alone, which a program has or has not. ABI 2 gave them without the mark, and programs
# that compile without a warning shall go on to.
UNMARKED = re.compile(r"pose_wall_(motion_settings_init|runtime_options_init\w*|config_init\w*|config_(get|key|crc)\w*|"
                      r"cloud_xyz32\w*|set_clock|(?:motion_)?trace_\w+)$")
CONSTANT = re.compile(r"^(?:#define |  )(POSE_WALL_\w+)(?= =|,$| [^=]|$|\n)", re.M)
POINTER = re.compile(r"\b((?:src|tools|tests|bench|include)/[\w./]*|[\w/]+\.md)\b")
GENERATED = "written by tools/apps/plc/generate.py"  # a word to who changes the header
NOT_PACKAGED = {"pose_wall_trace.h", "pose_wall_motion_trace.h"}


def without_comments(text):
    return re.sub(r"/\*.*?\*/", "", text, flags=re.S)


def faults_of(header, packaged):
    text = header.read_text(encoding="utf-8")
    for marked, name in STATUS.findall(without_comments(text)):
        if not marked and not UNMARKED.match(name):
            yield f"{name} returns a status without POSE_WALL_CHECKED"
    if header.name.startswith("pose_wall_planar"):
        for name in CONSTANT.findall(without_comments(text)):
            if not name.startswith("POSE_WALL_PLANAR") and name != "POSE_WALL_CHECKED":
                yield f"{name} does not begin with POSE_WALL_PLANAR"
    if header.name in NOT_PACKAGED:
        return
    for line in text.splitlines():
        for name in POINTER.findall(line) if GENERATED not in line else ():
            if name not in packaged:
                yield f"it names {name}, which no package holds"


def main():
    root = pathlib.Path(sys.argv[1])
    rules = (root / "tools/cmake/pose_wall_install.cmake").read_text(encoding="utf-8")
    packaged = {path.rsplit("/", 1)[-1] for path in re.findall(r"\$\{PROJECT_SOURCE_DIR\}/(include/[\w.]+)", rules)}
    packaged |= set(re.findall(r"RENAME ([\w.]+)", rules))
    page = (root / "include/README.md").read_text(encoding="utf-8")
    headers = sorted((root / "include").glob("*.h"))
    faults = [f"{header.name}: {fault}" for header in headers for fault in faults_of(header, packaged)]
    for header in headers:
        if header.name not in NOT_PACKAGED and f"({header.name})" not in page:
            faults.append(f"{header.name}: include/README.md does not link it")
    print("\n".join(faults) if faults else f"{len(headers)} headers")
    return 1 if faults or not headers else 0


if __name__ == "__main__":
    sys.exit(main())
