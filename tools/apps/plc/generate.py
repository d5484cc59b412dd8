#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Writes what follows from image.def and blocks.def: the images' structs in the public headers, the tables of registers
in tools/apps/live/modbus/README.md, those of the stop's image in README.md, what goes over CAN (can/can.def), and
FB_PoseWall as plain text, PLCopen XML and SCL. States and numbers are those of the headers.

usage: generate.py [--check] ROOT      --check: writes nothing; exit status 1 if a file would change, or if
                                       tests/checks/abi_layout.txt pins other offsets than image.def gives"""

import itertools
import pathlib
import re
import sys

sys.dont_write_bytecode = True  # the sources stay as they are

import blocks_reader  # noqa: E402  pylint: disable=wrong-import-position
import can_description  # noqa: E402  pylint: disable=wrong-import-position
import dialects  # noqa: E402  pylint: disable=wrong-import-position
import image_description as description  # noqa: E402  pylint: disable=wrong-import-position
import plcopen  # noqa: E402  pylint: disable=wrong-import-position
import register_table  # noqa: E402  pylint: disable=wrong-import-position
import stop_tables  # noqa: E402  pylint: disable=wrong-import-position
import structured_text_words as words  # noqa: E402  pylint: disable=wrong-import-position

BEGIN = "/* From here on written by tools/apps/plc/generate.py from tools/apps/plc/image.def. */\n"
END = "/* Up to here. */\n"


def c_struct(structs, struct):
    rows = []
    for member in struct.members:
        kind = description.TYPES[member.type][0] if member.type in description.TYPES else member.type
        comment = ": ".join(text for text in (member.unit, member.comment) if text)
        rows.append((f"  {kind} {member.name};", f"/* {comment} */" if comment else ""))
    lines = []
    for commented, run in itertools.groupby(rows, key=lambda row: bool(row[1])):  # as clang-format aligns them
        run = list(run)
        width = max(len(code) for code, _ in run)
        lines += [f"{code:<{width}} {comment}" if commented else code for code, comment in run]
    size = description.size_of(structs, struct.name)
    return "\n".join([f"/* {struct.comment} {size} bytes. */", f"typedef struct {struct.name} {{", *lines,
                      f"}} {struct.name};"])


# Header: how the names of its structs begin; all others are the first one's.
HEADERS = {"include/pose_wall.h": "", "include/pose_wall_motion.h": "pose_wall_motion_",
           "include/pose_wall_planar_stop.h": "pose_wall_planar_stop_"}


def header_of(name):
    return max(HEADERS, key=lambda path: len(HEADERS[path]) if name.startswith(HEADERS[path]) else -1)


def header(structs, path, text):
    structs = {name: struct for name, struct in structs.items() if header_of(name) == path}
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    sizes = [f"#define {name.upper()}_BYTES {description.size_of(structs, name)}"
             for name in description.images(structs).values()]
    parts = ["\n".join(sizes), *(c_struct(structs, struct) for struct in structs.values())]
    return before + BEGIN + "\n" + "\n\n".join(parts) + "\n\n" + END + after


def layout_faults(structs, pinned_text):
    """Where the pinned layout differs from the description."""
    for struct in structs.values():
        lines = [f"  {m.name:<30} {at:5} {size:5}\n" for m, at, size in description.offsets(structs, struct.name)]
        expected = "".join(lines) + f"{struct.name} {description.size_of(structs, struct.name)}\n"
        if not re.search(r"^" + re.escape(expected), pinned_text, re.M):
            yield f"abi_layout.txt does not hold what image.def says of {struct.name}:\n{expected}"


def outputs(root):
    structs = description.read_structs()
    header_texts = {path: (root / path).read_text(encoding="utf-8") for path in HEADERS}
    header_text = "\n".join(header_texts.values())
    plc, modbus = root / "tools/apps/plc", root / "tools/apps/live/modbus"
    registers_hpp = (modbus / "modbus_registers.hpp").read_text(encoding="utf-8")
    page = (modbus / "README.md").read_text(encoding="utf-8")
    plc_page = (plc / "README.md").read_text(encoding="utf-8")
    read = blocks_reader.Reader(words.description_text(header_text, (plc / "blocks.def").read_text(encoding="utf-8")))
    return {
        **{root / path: header(structs, path, text) for path, text in header_texts.items()},
        plc / "FB_PoseWall.st": dialects.plain(read),
        plc / "FB_PoseWall.scl": dialects.scl(read),
        plc / "FB_PoseWall.xml": plcopen.xml(read, dialects.NOTE),
        **can_description.outputs(root, structs, header_text),
        modbus / "README.md": register_table.with_tables(structs, header_text, registers_hpp, page),
        plc / "README.md": stop_tables.with_tables(structs, header_text, root, plc_page),
    }


def check(root):
    faults = [f"{path.relative_to(root)} is not what tools/apps/plc/generate.py writes from image.def"
              for path, text in outputs(root).items()
              if not path.exists() or path.read_text(encoding="utf-8") != text]
    pinned_text = (root / "tests/checks/abi_layout.txt").read_text(encoding="utf-8")
    return faults + list(layout_faults(description.read_structs(), pinned_text))


def main():
    root = pathlib.Path(sys.argv[-1])
    if "--check" in sys.argv:
        faults = check(root)
        print("\n".join(faults) or f"{len(outputs(root))} files are as image.def says")
        sys.exit(1 if faults else 0)
    for path, text in outputs(root).items():
        if not path.exists() or path.read_text(encoding="utf-8") != text:  # else all that includes it is compiled again
            path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
