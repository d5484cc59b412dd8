#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""What the archive holds: one object without state, without code that runs before main, without anything a linker would
merge with a user's, without tables to unwind; and of the size that the page of sizes says.

    check_archive.py READELF ARCHIVE [--text-max BYTES] [--of LIBRARY] [--sizes PAGE MACHINE [--note]]

--of: the page's columns begin with this word.
"""

import argparse
import re
import subprocess
import sys

sys.dont_write_bytecode = True  # the sources stay as they are

import sizes_page  # noqa: E402  pylint: disable=wrong-import-position

HEX = r"[0-9a-f]+"
SECTION = re.compile(rf"^\s*\[\s*[1-9]\d*\]\s+(\S+)\s+(\S+)\s+{HEX}\s+{HEX}\s+({HEX})\s+{HEX}\s+([A-Za-z]*)\s")
SYMBOL = re.compile(r"^\s*\d+: [0-9a-f]+\s+\S+\s+(\S+)\s+(GLOBAL|WEAK|UNIQUE)\s+\S+\s+(\S+)\s+(\S+)")
# Read-only once the loader has filled in where the library lies.
RELOCATED = ".data.rel.ro"
FORBIDDEN = re.compile(r"^\.(init|fini|preinit|ctors|dtors|eh_frame|gcc_except_table|tdata|tbss)")
TOLERANCE = 0.02  # of sizes on the page, both ways


def read(readelf, archive, option):
    return subprocess.run([readelf, option, archive], check=True, capture_output=True, text=True).stdout


def sizes_of(text):
    """Bytes by what is asked of them, and faults."""
    sizes, faults, seen = {"text": 0, "writable": 0, "relocated": 0}, [], 0
    for line in text.splitlines():
        match = SECTION.match(line)
        if match is None:
            continue
        name, bytes_, flags, seen = match[1], int(match[3], 16), match[4], seen + 1
        if FORBIDDEN.match(name) and bytes_ > 0 and "A" in flags:
            faults.append(f"section {name} of {bytes_} bytes: nothing may run before main, unwind or lie in a thread")
        if "A" not in flags:
            continue
        kind = "text" if "W" not in flags else ("relocated" if name.startswith(RELOCATED) else "writable")
        sizes[kind] += bytes_
        if kind == "writable" and bytes_ > 0:
            faults.append(f"section {name}: {bytes_} bytes that can be written to; the engine has no state of its own")
    return sizes, faults if seen else ["no sections at all: nothing was checked"]


def symbols_of(text):
    """How many functions are global, and faults."""
    functions, faults = 0, []
    for match in filter(None, map(SYMBOL.match, text.splitlines())):
        kind, binding, where, name = match.groups()
        if where == "UND":
            continue
        if binding != "GLOBAL" or where == "COM":
            faults.append(f"{name} is {binding.lower() if where != 'COM' else 'common'}: a linker would merge it")
        functions += kind == "FUNC"
    return functions, faults


def allowed(_, size):
    return TOLERANCE * size + 0.05


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("readelf")
    parser.add_argument("archive")
    parser.add_argument("--text-max", type=int)
    parser.add_argument("--of", default="")
    sizes_page.add_options(parser)
    options = parser.parse_args()
    sizes, faults = sizes_of(read(options.readelf, options.archive, "-SW"))
    functions, merged = symbols_of(read(options.readelf, options.archive, "-sW"))
    faults += merged
    if not read(options.readelf, options.archive, "-gW").count("There are no section groups"):
        faults.append("there are section groups: a linker would keep one of two")
    if options.text_max is not None and sizes["text"] > options.text_max:
        faults.append(f"{sizes['text']} bytes of text are more than {options.text_max}")
    of = options.of + " " if options.of else ""
    found = {f"{of}text, KiB": f"{sizes['text'] / 1024:.1f}", f"{of}functions": str(functions)}
    if not of:
        found.update({"data, KiB": f"{sizes['writable'] / 1024:.1f}",
                      "relocated, KiB": f"{sizes['relocated'] / 1024:.1f}"})
    faults += sizes_page.check_or_note(options, found, allowed)
    print("\n".join(faults) or f"text {sizes['text'] / 1024:.1f} KiB, no writable data, "
          f"{sizes['relocated'] / 1024:.1f} KiB of relocated constants, {functions} functions")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
