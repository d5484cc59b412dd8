#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The most stack that any function of the C ABI can need, from the call graph: no recursion, no frame of unknown size,
and at most so many bytes.

    check_stack.py FOLDER LIMIT [--readme README.md ROW] [--of PREFIX]

FOLDER: of the objects, with the .ci files of gcc's -fcallgraph-info=su
README.md: what its table of archives says of this machine's stack has to be so.
PREFIX: looks at the functions that begin so; pose_wall_ where none is given.

What the engine asks of the C library (memcpy, memset, sqrt) is counted as LIBRARY bytes each; the caller's own clock is
not counted.
"""

import argparse
import pathlib
import re

NODE = re.compile(r'^node: \{ title: "([^"]+)" label: "([^"]*)"', re.MULTILINE)
EDGE = re.compile(r'^edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"', re.MULTILINE)
BYTES = re.compile(r"\\n(\d+) bytes \(([^)]*)\)")
LIBRARY = 256
CALLER_S = "__indirect_call"
TOLERANCE = 0.05  # of the figure in README.md, both ways


def read(folder):
    """Own bytes and callees by function; functions of static storage have their file's name in theirs."""
    sizes, calls, faults = {}, {}, []
    for file in sorted(pathlib.Path(folder).rglob("*.ci")):
        text = file.read_text(encoding="utf-8")
        for title, label in NODE.findall(text):
            size = BYTES.search(label)
            if size is None:
                continue
            if "static" not in size.group(2) and "bounded" not in size.group(2):
                faults.append(f"{title}: its frame is {size.group(2)}")
            # A function of a header may be compiled in several places: the largest counts.
            sizes[title] = max(sizes.get(title, 0), int(size.group(1)))
        for caller, callee in EDGE.findall(text):
            calls.setdefault(caller, set()).add(callee)
    return sizes, calls, faults


def deepest(function, sizes, calls, known, path):
    """Bytes of the deepest chain of calls from here, and the chain."""
    if function in path:
        raise SystemExit("recursion: " + " -> ".join(path[path.index(function):] + [function]))
    if function not in known:
        own = sizes.get(function, 0 if function == CALLER_S else LIBRARY)
        below = [deepest(callee, sizes, calls, known, path + [function]) for callee in calls.get(function, ())]
        depth, chain = max(below, key=lambda found: found[0], default=(0, []))
        known[function] = (own + depth, [(function, own)] + chain)
    return known[function]


def differs_from(readme, row_name, worst):
    """In words; README's row of a machine ends with the stack in KiB."""
    text = pathlib.Path(readme).read_text(encoding="utf-8")
    row = re.search(rf"^\| {re.escape(row_name)} \|.*\| ([0-9.]+) KiB \|$", text, re.MULTILINE)
    if row is None:
        return [f"{readme}: no row '| {row_name} | ... | N KiB |' to compare with"]
    noted, found = float(row[1]), worst / 1024
    if abs(found - noted) <= TOLERANCE * noted:
        return []
    return [f"README.md says {noted} KiB of stack; it is {found:.1f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("limit", type=int)
    parser.add_argument("--readme", nargs=2, metavar=("README", "ROW"))
    parser.add_argument("--of", default="pose_wall_", metavar="PREFIX")
    options = parser.parse_args()
    limit = options.limit
    sizes, calls, faults = read(options.folder)
    roots = sorted(name for name in sizes if name.startswith(options.of))
    if not roots:
        raise SystemExit(f"{options.folder}: no call graph of any {options.of}* function: nothing was checked")
    known = {}
    worst, chain = max(deepest(root, sizes, calls, known, []) for root in roots)
    for function, own in chain:
        print(f"{own:7d}  {function}")
    print(f"{worst:7d} bytes at most, of {limit}; {len(roots)} functions looked at")
    if worst > limit:
        faults.append(f"{worst} bytes of stack are more than {limit}")
    if options.readme:
        faults += differs_from(*options.readme, worst)
    for fault in faults:
        print(fault)
    raise SystemExit(1 if faults else 0)


if __name__ == "__main__":
    main()
