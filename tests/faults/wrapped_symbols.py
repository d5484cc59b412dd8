#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""wrapped_symbols.py NM ROWS FOLDER OBJECT...: finds the symbol of each function of ROWS (wrapped_symbols.txt) in the
objects, and writes FOLDER/wrapped_symbols.h (their names for stage_wraps.hpp) and FOLDER/wrapped_symbols.rsp (options
for the linker). Fails where a row names no function of the objects, or more than one."""

import pathlib
import subprocess
import sys


def functions(nm, objects):
    """Symbol and readable name of each function that the objects define."""

    def listed(*options):
        command = [nm, "--defined-only", "--extern-only", "--no-sort", *options, *objects]
        lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
        return [line.split(" ", 2)[2] for line in lines if line.split(" ")[1:2] in (["T"], ["W"])]

    return dict(zip(listed(), listed("--demangle")))


def symbol_of(name, known):
    if "::" not in name:  # of C: any symbol, also of a library
        return name
    begin = name if "(" in name else name + "("
    found = [symbol for symbol, readable in known.items() if readable.startswith(begin)]
    if len(found) != 1:
        alike = [known[symbol] for symbol in found] or [n for n in known.values() if name.split("::")[-1] in n]
        sys.exit(f"wrapped_symbols.py: {len(found)} functions are {name}" + "".join(f"\n  {n}" for n in alike))
    return found[0]


def write(path, text):
    """Leaves an equal file alone, so that nothing is compiled again for it."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def main(nm, rows, folder, *objects):
    known = functions(nm, objects)
    header, options = "#pragma once\n", ""
    for row in pathlib.Path(rows).read_text(encoding="utf-8").splitlines():
        if row and not row.startswith("#"):
            name, function = row.split(" ", 1)
            symbol = symbol_of(function, known)
            header += f'#define POSE_WALL_WRAPPED_{name} "{symbol}"\n'
            options += f"-Wl,--wrap={symbol}\n"
    write(pathlib.Path(folder) / "wrapped_symbols.h", header)
    write(pathlib.Path(folder) / "wrapped_symbols.rsp", options)


main(*sys.argv[1:])
