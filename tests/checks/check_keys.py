#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""config/README.md and config/pose_wall.yaml hold every key of the engine's table, with its meaning word for word.

usage: check_keys.py ROOT POSE_WALL
"""

import pathlib
import re
import subprocess
import sys


def keys_of_the_table(command):
    """Name to meaning, as `check-config --keys` prints them."""
    text = subprocess.run([command, "check-config", "--keys"], capture_output=True, text=True, check=True).stdout
    keys, name = {}, None
    for line in text.splitlines():
        key = re.fullmatch(r"  (\w+)", line)
        if key:
            name = key.group(1)
            keys[name] = []
        elif name and re.match(r"    (?!default )\S", line):  # further lines of the allowed values stand further in
            keys[name].append(line.strip())
    return {name: " ".join(lines) for name, lines in keys.items()}


def keys_of_the_page(path):
    rows = re.findall(r"^\| `(\w+)` \| [^|]* \| [^|]* \| (.*) \|$", path.read_text(encoding="utf-8"), re.M)
    return {name: meaning.replace("\\|", "|") for name, meaning in rows}


def keys_of_the_file(path):
    keys, comment = {}, []
    for line in path.read_text(encoding="utf-8").splitlines():
        key = re.match(r"(?:# (?=\w+: \[))?(\w+):", line)  # a box has no default: its line is a comment
        if line.startswith("# ") and not key:
            comment.append(line[2:])
        elif key:
            keys[key.group(1)] = re.sub(r" \[[^]]*\]$", "", " ".join(comment))
            comment = []
        else:
            comment = []
    return keys


def main():
    root, command = pathlib.Path(sys.argv[1]), sys.argv[2]
    table = keys_of_the_table(command)
    faults = [] if len(table) > 50 else [f"only {len(table)} keys were printed"]
    for path, found in ((root / "config/README.md", keys_of_the_page(root / "config/README.md")),
                        (root / "config/pose_wall.yaml", keys_of_the_file(root / "config/pose_wall.yaml"))):
        for name, meaning in table.items():
            if meaning not in found.get(name, ""):
                faults.append(f"{path.name}: {name}: {found.get(name, 'is missing')!r}; the table says {meaning!r}")
        faults += [f"{path.name}: {name} is no key" for name in found if name not in table]
    print("\n".join(faults) if faults else f"{len(table)} keys, each as the engine's table has it")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
