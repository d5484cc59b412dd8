# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The structs, enums and constants of the C headers, read from the headers themselves: nothing is written twice."""

import ctypes
import pathlib
import re

NAMES = ("pose_wall.h", "pose_wall_runtime.h")
ELEMENTARY = {"uint8_t": ctypes.c_uint8, "int8_t": ctypes.c_int8, "uint16_t": ctypes.c_uint16,
              "int32_t": ctypes.c_int32,
              "uint32_t": ctypes.c_uint32, "int64_t": ctypes.c_int64, "uint64_t": ctypes.c_uint64,
              "float": ctypes.c_float, "double": ctypes.c_double}
# Pointers to functions have a name of their own in the headers.
CALLBACKS = {"pose_wall_clock": ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_void_p),
             "pose_wall_runtime_callback": ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p),
             "pose_wall_runtime_sink": ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.c_uint64,
                                                        ctypes.c_void_p, ctypes.c_uint64)}


def folder():
    """Beside this file in an installed package, in the source tree else."""
    here = pathlib.Path(__file__).parent
    return here if (here / NAMES[0]).exists() else here.parents[2] / "include"


def without_comments(text):
    return re.sub(r"/\*.*?\*/", " ", text, flags=re.S)


class Headers:
    def __init__(self):
        self.constants, self.enums, self.structs = {}, {}, {}
        for name in NAMES:
            self._read(without_comments((folder() / name).read_text(encoding="utf-8")))

    def _read(self, text):
        for name, value in re.findall(r"^#define (POSE_WALL_\w+) +([-(\dx][^\n]*)$", text, re.M):
            self.constants[name] = self._number(value.strip().rstrip("uUlL"))
        # In the order of the text: later ones use earlier ones.
        pattern = re.compile(r"enum (\w+) \{(.*?)\};|typedef struct (\w+) \{(.*?)\} \w+;", re.S)
        for match in pattern.finditer(text):
            if match[1]:
                self._add_enum(match[1], match[2])
            else:
                self._add_struct(match[3], match[4])

    def _number(self, text):
        words = re.sub(r"\b(POSE_WALL_\w+)\b", lambda m: str(self.constants[m[1]]), text)
        words = re.sub(r"\b(0x[0-9A-Fa-f]+|\d+)[uUlL]+\b", r"\1", words)
        if not re.fullmatch(r"[-+*/() 0-9A-Fa-fx<|]*", words):
            raise ValueError(f"the header's '{text}' is no number")
        return eval(words)  # pylint: disable=eval-used  # digits and operators alone, as looked at above

    def _add_enum(self, name, body):
        members, following = {}, 0
        for member in filter(None, (part.strip() for part in body.split(","))):
            key, _, value = member.partition("=")
            following = self._number(value.strip()) if value else following
            members[key.strip()] = self.constants[key.strip()] = following
            following += 1
        self.enums[name] = members

    def _add_struct(self, name, body):
        fields = []
        for row in filter(None, (part.strip() for part in body.split(";"))):
            kind, declared = re.fullmatch(r"(?:const )?(?:struct )?(\w+)\b\s*(.*)", row, re.S).groups()
            for one in declared.split(","):
                pattern = r"\s*(?:const)?\s*(\**)\s*(\w+)\s*((?:\[[^\]]*\])*)\s*"
                stars, member, sizes = re.fullmatch(pattern, one).groups()
                fields.append((member, self._array(self._type(kind, stars), sizes)))
        self.structs[name] = type(name, (ctypes.Structure,), {"_fields_": fields})

    def _type(self, kind, stars):
        if kind in CALLBACKS and not stars:
            return CALLBACKS[kind]
        if stars:
            return ctypes.c_char_p if kind == "char" else ctypes.c_void_p
        return ELEMENTARY.get(kind) or (ctypes.c_char if kind == "char" else self.structs[kind])

    def _array(self, kind, sizes):
        for size in reversed(re.findall(r"\[([^\]]*)\]", sizes)):
            kind = kind * self._number(size.strip())
        return kind


HEADERS = Headers()
STRUCTS, ENUMS, CONSTANTS = HEADERS.structs, HEADERS.enums, HEADERS.constants


def struct(name, **members):
    """A struct with its struct_size set."""
    made = STRUCTS[name](**members)
    if hasattr(made, "struct_size"):
        made.struct_size = ctypes.sizeof(made)
    return made
