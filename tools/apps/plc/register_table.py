# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The tables of tools/apps/live/modbus/README.md: registers, from image.def and the daemon's first ones; bits of
reasons."""

import re

import image_description as description

BEGIN = "<!-- From here on written by tools/apps/plc/generate.py from tools/apps/plc/image.def. -->\n"
END = "<!-- Up to here. -->\n"
REGISTERS_PER_WORD = 2
FIRST_INPUT_REGISTER = 30001  # what controllers call the register of address 0: the 3 is for input registers
# The constants of modbus_registers.hpp, by version of the image
FIRST_NAME = {1: "kImageRegister", 2: "kImage2Register", 3: "kMotionImageRegister", 4: "kStopImageRegister"}


def first_register(registers_hpp, version):
    return int(re.search(rf"\b{FIRST_NAME[version]} = (\d+)", registers_hpp).group(1))


def rows(structs, name, prefix="", about=""):
    """(name, type, unit, what it holds) of each word. Of a nested struct the first row tells what the struct is."""
    for i, member in enumerate(structs[name].members):
        if member.type in structs:
            yield from rows(structs, member.type, f"{prefix}{member.name}.", member.comment)
        else:
            text = ": ".join(part for part in (about if i == 0 else "", member.comment) if part)
            yield prefix + member.name, description.TYPES[member.type][1], member.unit, text


def image_table(structs, registers_hpp, version, name):
    first = first_register(registers_hpp, version)
    size = description.size_of(structs, name)
    last = first + size // description.WORD * REGISTERS_PER_WORD - 1
    lines = [f"### Image {version}: registers {first} to {last}", "",
             "| registers | PLC's number | name | type | unit | holds |", "| ---: | ---: | --- | --- | --- | --- |"]
    for i, (path, kind, unit, text) in enumerate(rows(structs, name)):
        at = first + i * REGISTERS_PER_WORD
        lines.append(f"| {at}, {at + 1} | {FIRST_INPUT_REGISTER + at} | `{path}` | {kind} | {unit} | {text} |")
    return "\n".join(lines)


def reason_table(header_text, prefix, title):
    bits = re.findall(rf"\b{prefix}_R_(\w+) =\s*1 << (\d+)", header_text)
    return "\n".join([f"### {title}", "", "| bit | reason |", "| ---: | --- |"] +
                     [f"| {bit} | `{name.lower()}` |" for name, bit in bits])


def with_tables(structs, header_text, registers_hpp, text):
    """The page with its tables written anew; image 2 first, for new controllers take it."""
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    tables = [image_table(structs, registers_hpp, version, name)
              for version, name in sorted(description.images(structs).items(), reverse=True)]
    tables.append(reason_table(header_text, "POSE_WALL", "Bits of `reasons` and `frame_reasons`"))
    tables.append(reason_table(header_text, "POSE_WALL_PLANAR_STOP", "Bits of the stop's `reasons`"))
    return before + BEGIN + "\n" + "\n\n".join(tables) + "\n\n" + END + after
