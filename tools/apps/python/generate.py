#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Writes src/pose_wall/_abi.py, the C ABI as ctypes sees it, from the headers of engine, motion and runtime:
numbers, enums, structs and functions. Nobody writes a struct down a second time.

usage: generate.py [--check] ROOT      --check: writes nothing; exit status 1 if the file would change"""

import pathlib
import re
import sys

HEADERS = ("include/pose_wall.h", "include/pose_wall_motion.h", "include/pose_wall_runtime.h")
OUTPUT = "tools/apps/python/src/pose_wall/_abi.py"

# C enum -> class, base, what each name begins with. Enums of one class are one enum in Python.
ENUMS = {
    "pose_wall_status": ("Status", "IntEnum", "POSE_WALL_(?:E_)?"),
    "pose_wall_runtime_status": ("Status", "IntEnum", "POSE_WALL_(?=RUNTIME_)"),
    "pose_wall_key_type": ("KeyType", "IntEnum", "POSE_WALL_KEY_"),
    "pose_wall_field_type": ("FieldType", "IntEnum", "POSE_WALL_FIELD_"),
    "pose_wall_input": ("Input", "IntFlag", "POSE_WALL_INPUT_"),
    "pose_wall_quantity": ("Quantity", "IntEnum", "POSE_WALL_"),
    "pose_wall_state": ("State", "IntEnum", "POSE_WALL_"),
    "pose_wall_reason": ("Reason", "IntFlag", "POSE_WALL_R_"),
    "pose_wall_part": ("Part", "IntEnum", "POSE_WALL_PART_"),
    "pose_wall_stage": ("Stage", "IntEnum", "POSE_WALL_STAGE_"),
    "pose_wall_sense": ("Sense", "IntEnum", "POSE_WALL_SENSE_"),
    "pose_wall_moment_known": ("MomentKnown", "IntFlag", "POSE_WALL_MOMENT_"),
    "pose_wall_label": ("Label", "IntEnum", "POSE_WALL_LABEL_"),
    "pose_wall_along_state": ("AlongState", "IntEnum", "POSE_WALL_ALONG_"),
    "pose_wall_motion_reason": ("MotionReason", "IntFlag", "POSE_WALL_MOTION_R_"),
    "pose_wall_motion_direction": ("MotionDirection", "IntEnum", "POSE_WALL_MOTION_"),
    "pose_wall_runtime_cause": ("Cause", "IntEnum", "POSE_WALL_RUNTIME_"),
    "pose_wall_runtime_activity": ("Activity", "IntEnum", "POSE_WALL_RUNTIME_AT_"),
    "pose_wall_runtime_wish": ("Wish", "IntFlag", "POSE_WALL_RUNTIME_"),
    "pose_wall_runtime_state": ("RuntimeState", "IntEnum", "POSE_WALL_RUNTIME_"),
    "pose_wall_runtime_drop": ("Drop", "IntEnum", "POSE_WALL_RUNTIME_DROP_"),
}
# They close an enum and count its members.
COUNTS = ("POSE_WALL_QUANTITIES", "POSE_WALL_PARTS", "POSE_WALL_STAGES", "POSE_WALL_MOTION_DIRECTIONS",
          "POSE_WALL_RUNTIME_ACTIVITIES",
          "POSE_WALL_RUNTIME_DROPS")
SCALARS = {"int32_t": "c_int32", "uint32_t": "c_uint32", "int64_t": "c_int64", "uint64_t": "c_uint64",
           "uint8_t": "c_uint8", "double": "c_double", "float": "c_float", "char": "c_char"}
SCALAR_POINTERS = {"void": "c_void_p", "char": "c_char_p"}


class HeaderError(Exception):
    """What the header holds and this program does not understand."""


def without_comments(text):
    return re.sub(r"/\*.*?\*/", " ", text, flags=re.S)


def header_text(path):
    """A header, with the rows of its tables of settings as the members that they are."""
    def members(table):
        rows = (path.parent / table[1]).read_text(encoding="utf-8")
        found = re.findall(r"^POSE_WALL_SETTING\((\w+), +(\w+),", rows, re.M)
        return "\n".join(f"{kind} {name};" for kind, name in found)

    return re.sub(r'^#define POSE_WALL_SETTING\(.*\n#include "(\w+\.def)"$', members, path.read_text(encoding="utf-8"),
                  flags=re.M)


def value_of(expression, known):
    try:
        return int(eval(expression, {"__builtins__": {}}, known))  # pylint: disable=eval-used  # our own header
    except Exception as error:
        raise HeaderError(f"'{expression}' is not understood as a number: {error}") from error


def read_defines(text, numbers):
    for name, rest in re.findall(r"^#define (POSE_WALL_[A-Z0-9_]+) +([-(0-9].*?)\s*$", text, re.M):
        numbers[name] = value_of(rest, numbers)
    return {asked: real for asked, real in re.findall(r"^#define (pose_wall_\w+) (pose_wall_\w+)$", text, re.M)}


def read_enums(text, numbers, classes):
    for name, body in re.findall(r"\benum (pose_wall_\w+) \{(.*?)\}", text, re.S):
        if name not in ENUMS:
            raise HeaderError(f"enum {name} has no class: add it to ENUMS")
        title, base, prefix = ENUMS[name]
        members = classes.setdefault(title, (base, []))[1]
        for entry in filter(None, (word.strip() for word in body.split(","))):
            constant, equals, expression = (word.strip() for word in entry.partition("="))
            if not equals:
                expression = str(numbers[members[-1][2]] + 1) if members else "0"
            numbers[constant] = value_of(expression, numbers)
            if constant not in COUNTS:
                short = re.sub(f"^{prefix}", "", constant)
                members.append((re.sub("^RUNTIME_E_", "RUNTIME_", short), numbers[constant], constant))


def type_of(words, pointers, structs, opaque):
    kind = " ".join(word for word in words.split() if word not in ("const", "struct"))
    if kind in opaque:
        if pointers == 0:
            raise HeaderError(f"{kind} is opaque; only pointers to it can be passed")
        kind, pointers = "c_void_p", pointers - 1
    elif pointers and kind in SCALAR_POINTERS:
        kind, pointers = SCALAR_POINTERS[kind], pointers - 1
    elif kind in SCALARS:
        kind = SCALARS[kind]
    elif kind not in structs:
        raise HeaderError(f"type '{kind}' is not known")
    for _ in range(pointers):
        kind = f"POINTER({kind})"
    return kind


def split_declaration(text):
    """'const double value[6]' as type, stars, name and the sizes of an array."""
    match = re.fullmatch(r"\s*([\w\s]+?)\s*(\**)\s*(\w+)\s*((?:\[\w+\])*)\s*", text, re.S)
    if not match:
        raise HeaderError(f"declaration '{' '.join(text.split())}' is not understood")
    words, stars, name, sizes = match.groups()
    return words, len(stars), name, re.findall(r"\[(\w+)\]", sizes)


def each_of(text):
    """'double a[3], b[3]' as 'double a[3]' and 'double b[3]'."""
    first, *others = text.split(",")
    kind = split_declaration(first)[0]
    return [first, *(f"{kind} {other}" for other in others)]


def struct_fields(body, numbers, structs, opaque):
    for declaration in (one for many in filter(str.strip, body.split(";")) for one in each_of(many)):
        words, pointers, name, sizes = split_declaration(declaration)
        kind = type_of(words, pointers, structs, opaque)
        for size in reversed(sizes):
            kind = f"{kind} * {value_of(size, numbers)}" if " * " not in kind else \
                f"({kind}) * {value_of(size, numbers)}"
        yield name, kind


def argument_types(text, structs, opaque):
    if text.strip() in ("", "void"):
        return []
    types = []
    for argument in text.split(","):
        words, pointers, _, sizes = split_declaration(argument)
        types.append(type_of(words, pointers + len(sizes), structs, opaque))
    return types


class Abi:
    """What the headers say."""

    def __init__(self, texts):
        self.numbers, self.classes, self.renamed = {}, {}, {}
        texts = [without_comments(text) for text in texts]
        for text in texts:
            self.renamed.update(read_defines(text, self.numbers))
            read_enums(text, self.numbers, self.classes)
        whole = "\n".join(texts)
        bodies = dict(re.findall(r"typedef struct (pose_wall_\w+) \{(.*?)\} \1;", whole, re.S))
        opaque = [name for name, other in re.findall(r"typedef struct (\w+) (\w+);", whole) if name == other]
        tables = [name for name, body in bodies.items() if "(*" in body]  # of functions: handed on as they are
        opaque += tables
        bodies = {name: body for name, body in bodies.items() if name not in tables}
        callbacks = re.findall(r"typedef ([\w ]+?) \(\*(\w+)\)\(([^)]*)\);", whole)
        names = [*bodies, *(name for _, name, _ in callbacks)]
        self.callbacks = {
            name: [("None" if given == "void" else type_of(given, 0, names, opaque)),
                   *argument_types(arguments, names, opaque)] for given, name, arguments in callbacks}
        self.structs = {name: list(struct_fields(body, self.numbers, names, opaque)) for name, body in bodies.items()}
        code = "\n".join(line for line in whole.splitlines() if not line.startswith("#"))
        declared = re.findall(r"(?:^|\n)(?:POSE_WALL_CHECKED )?((?:const )?\w+)(\**) (pose_wall_\w+)\(([^)]*)\);", code)
        self.functions = {name: (type_of(given, len(stars), names, opaque), argument_types(arguments, names, opaque))
                          for given, stars, name, arguments in declared}
        missing = [real for real in self.renamed.values() if real not in self.functions]
        if missing or len(self.functions) < 30:
            raise HeaderError(f"functions are missing: {missing}, {len(self.functions)} found")


def wrapped(head, words, tail):
    """A call over as many lines of 120 characters as it takes."""
    if not words:
        return [head + tail]
    lines = [head]
    for number, word in enumerate(words):
        word += ", " if number + 1 < len(words) else tail
        if len(lines[-1]) + len(word.rstrip()) > 116:
            lines[-1] = lines[-1].rstrip()
            lines.append(" " * 8)
        lines[-1] += word
    return lines


def python_of(abi):
    lines = ["# SPDX-License-Identifier: BSD-3-Clause", "# Copyright (c) 2026 the pose_wall authors",
             '"""The C ABI as ctypes sees it. Written by tools/apps/python/generate.py from the headers; edit those.'
             '"""',
             "",
             "from ctypes import (CFUNCTYPE, POINTER, Structure, c_char, c_char_p, c_double, c_float, c_int32,",
             "                    c_int64, c_uint8, c_uint32, c_uint64, c_void_p)",
             "from enum import IntEnum, IntFlag", ""]
    in_enums = {constant for _, members in abi.classes.values() for _, _, constant in members}
    lines += [f"{name} = {number}" for name, number in abi.numbers.items() if name not in in_enums]
    for title, (base, members) in abi.classes.items():
        lines += ["", "", f"class {title}({base}):"]
        lines += [f"    {short} = {number}" for short, number, _ in members]
    for name in abi.structs:
        lines += ["", "", f"class {name}(Structure):", "    pass"]
    lines += ["", ""]
    for name, types in abi.callbacks.items():
        lines.append(f"{name} = CFUNCTYPE({', '.join(types)})")
    placed = set()
    order = []

    def place(name):  # a struct that lies within another has to be known before
        if name not in placed:
            placed.add(name)
            for _, kind in abi.structs[name]:
                inner = kind.split(" * ")[0].strip("()")
                if inner in abi.structs:
                    place(inner)
            order.append(name)

    for name in abi.structs:
        place(name)
    for name in order:
        lines += [""] + [f"{name}._fields_ = ["] + [f'    ("{member}", {kind}),' for member, kind in abi.structs[name]]
        lines += ["]"]
    lines += ["", "# Structs by their names in C, and functions: what each gives and takes.", "STRUCTS = {"]
    lines += [f'    "{name}": {name},' for name in abi.structs] + ["}", "FUNCTIONS = {"]
    for name, (given, taken) in abi.functions.items():
        types = [*taken[:-1], taken[-1] + "," if len(taken) == 1 else taken[-1]] if taken else []
        lines += wrapped(f'    "{name}": ({given}, (', types, ")),")
    lines += ["}", "# What a name of the header stands for.", "RENAMED = {"]
    lines += [f'    "{asked}": "{real}",' for asked, real in abi.renamed.items()] + ["}"]
    return "\n".join(lines) + "\n"


def main():
    check = sys.argv[1] == "--check"
    root = pathlib.Path(sys.argv[-1])
    try:
        text = python_of(Abi([header_text(root / header) for header in HEADERS]))
    except HeaderError as error:
        sys.exit(f"{', '.join(HEADERS)}: {error}")
    output = root / OUTPUT
    if not check:
        output.write_text(text, encoding="utf-8")
    elif not output.exists() or output.read_text(encoding="utf-8") != text:
        sys.exit(f"{OUTPUT} is not what the headers say: run tools/apps/python/generate.py {root}")


if __name__ == "__main__":
    main()
