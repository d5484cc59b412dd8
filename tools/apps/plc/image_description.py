# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Reads image.def, and the enums of pose_wall.h that the image's numbers are from."""

import collections
import pathlib
import re
import struct

DEFINITION = pathlib.Path(__file__).with_name("image.def")
WORD = 4
# C type, structured text type, code of Python's struct module
TYPES = {"uint32": ("uint32_t", "UDINT", "I"), "int32": ("int32_t", "DINT", "i"), "bits": ("uint32_t", "DWORD", "I"),
         "float": ("float", "REAL", "f")}

# Of the reflected CRCs, by version of the image
POLYNOMIAL = {1: 0xEDB88320, 2: 0x82F63B78, 3: 0x82F63B78, 4: 0x82F63B78}

Member = collections.namedtuple("Member", "name type unit comment")
Struct = collections.namedtuple("Struct", "name st_name comment members")
# One 4-byte word of the image: "roll.value_mdeg", "int32"
Word = collections.namedtuple("Word", "path type")


def read_structs(path=DEFINITION):
    """{C name: Struct} in the order of the file."""
    structs = {}
    for line in path.read_text(encoding="utf-8").splitlines():
        line = line.split("//")[0].strip()
        if not line:
            continue
        head, *rest = [part.strip() for part in line.split("|")]
        words = head.split()
        if words[0] == "STRUCT":
            current = structs[words[1]] = Struct(words[1], words[2], rest[0], [])
            continue
        name, kind = words
        if kind not in TYPES and kind not in structs:
            raise ValueError(f"{path}: {name} is of unknown type {kind}")
        unit, comment = (rest + ["", ""])[:2]
        current.members.append(Member(name, kind, "" if unit == "-" else unit, comment))
    return structs


def words_of(structs, name, prefix=""):
    for member in structs[name].members:
        if member.type in structs:
            yield from words_of(structs, member.type, prefix + member.name + ".")
        else:
            yield Word(prefix + member.name, member.type)


def images(structs):
    """{version: C name}: what begins with struct_size is an image."""
    names = [name for name, item in structs.items() if item.members[0].name == "struct_size"]
    return dict(enumerate(names, 1))


def image_words(version, structs=None):
    structs = structs or read_structs()
    return list(words_of(structs, images(structs)[version]))


def crc_word(words):
    return next(i for i, word in enumerate(words) if word.path in ("crc32", "crc32c"))


def crc_bytes(raw, version):
    """Of an image's bytes those that its CRC is over."""
    at = WORD * crc_word(image_words(version))
    return raw[:at] + raw[at + WORD:]


def crc_of(data, polynomial):
    """By bits, as src/base/math/crc32.hpp: begun and ended with all ones."""
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (polynomial if crc & 1 else 0)
    return crc ^ 0xFFFFFFFF


def size_of(structs, kind):
    return WORD if kind in TYPES else sum(size_of(structs, m.type) for m in structs[kind].members)


def offsets(structs, name):
    at = 0
    for member in structs[name].members:
        size = size_of(structs, member.type)
        yield member, at, size
        at += size


def unpack_image(raw, version, byte_order="<"):
    """{"roll.value_mdeg": -1200, ...} from the image's bytes."""
    words = image_words(version)
    values = struct.unpack(byte_order + "".join(TYPES[word.type][2] for word in words), raw)
    return {word.path: value for word, value in zip(words, values)}


def read_enum(header_text, name):
    """{"POSE_WALL_INVALID": 0, ...} of an enum of pose_wall.h, where each number stands beside its name."""
    body = re.search(rf"enum {name} \{{(.*?)\}};", header_text, re.S).group(1)
    body = re.sub(r"/\*.*?\*/", "", body, flags=re.S)
    rows = re.findall(r"(\w+)\s*=\s*(?:1 << )?(-?\d+)", body)
    return {key: 1 << int(number) if "<<" in body else int(number) for key, number in rows}


def read_define(header_text, name):
    """A whole number, or a sum of some: (-2147483647 - 1)."""
    text = re.search(rf"#define {name} +([-+() 0-9]+)", header_text).group(1)
    return sum(int(part) for part in re.findall(r"[-+]?\d+", text.replace(" ", "")))
