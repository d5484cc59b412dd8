#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The most stack that any function of the C ABI can need, from the call graph: no recursion, no frame of unknown size,
and at most so many bytes.

    check_stack.py FOLDER LIMIT [--sizes PAGE MACHINE [--note]] [--of PREFIX]

FOLDER: of the objects, with the .ci files of gcc's -fcallgraph-info=su
PAGE: its figure of this machine's stack has to be so, within 5 %.
PREFIX: looks at the functions that begin so; pose_wall_ where none is given.

What the engine asks of the C library (memcpy, memset, sqrt) is counted as LIBRARY bytes each; the caller's own clock is
not counted.
"""

import argparse
import pathlib
import re
import sys

sys.dont_write_bytecode = True  # the sources stay as they are

import sizes_page  # noqa: E402  pylint: disable=wrong-import-position

NODE = re.compile(r'^node: \{ title: "([^"]+)" label: "([^"]*)"', re.MULTILINE)
EDGE = re.compile(r'^edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"', re.MULTILINE)
BYTES = re.compile(r"\\n(\d+) bytes \(([^)]*)\)")
LIBRARY = 256
CALLER_S = "__indirect_call"
TOLERANCE = 0.05  # of the figure on the page, both ways


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


def allowed(_, size):
    return TOLERANCE * size


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("limit", type=int)
    sizes_page.add_options(parser)
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
    faults += sizes_page.check_or_note(options, {"stack, KiB": f"{worst / 1024:.1f}"}, allowed)
    for fault in faults:
        print(fault)
    raise SystemExit(1 if faults else 0)


if __name__ == "__main__":
    main()
