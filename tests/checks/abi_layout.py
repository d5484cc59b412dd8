#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Writes the list of all structs of the public headers and of their members, which abi_layout.c looks at.

usage: abi_layout.py FILE HEADER..."""

import pathlib
import re
import sys

sys.dont_write_bytecode = True  # the sources stay as they are
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/apps/python"))
from generate import each_of, header_text, split_declaration, without_comments  # noqa: E402


def members_of(body):
    """Each member's name, and whether a pointer lies in it: '' for no other struct, its name, or '*'."""
    for declaration in filter(str.strip, body.split(";")):
        function = re.search(r"\(\*(\w+)\)\(", declaration)
        if function:
            yield function[1], "*"
            continue
        for one in each_of(declaration):
            words, stars, name, _ = split_declaration(one)
            yield name, "*" if stars else words.split()[-1]


def lines_of(headers):
    with_pointers = {"*"}
    text = without_comments("\n".join(header_text(header) for header in headers))
    for struct, body in re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", text, re.S):
        members = list(members_of(body))
        yield from (f"MEMBER({struct}, {name})" for name, _ in members)
        if with_pointers & {kind for _, kind in members}:
            with_pointers.add(struct)
        yield f"STRUCT_END({struct}, {int(struct in with_pointers)})"


def main():
    lines = list(lines_of(map(pathlib.Path, sys.argv[2:])))
    pathlib.Path(sys.argv[1]).write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
