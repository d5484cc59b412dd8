# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The tables of tools/apps/plc/README.md: every word of the stop's image, and every bit of its reasons in English and
Chinese. The package holds that page, and not the one with all registers."""

import re

import image_description as description

BEGIN = "<!-- From here on written by tools/apps/plc/generate.py from tools/apps/plc/image.def. -->\n"
END = "<!-- Up to here. -->\n"
NAME = "pose_wall_planar_stop_image"


def word_table(structs):
    lines = ["| word | byte | name | type | unit | holds |", "| ---: | ---: | --- | --- | --- | --- |"]
    for member, at, _ in description.offsets(structs, NAME):
        kind = description.TYPES[member.type][1]
        lines.append(f"| {at // description.WORD} | {at} | `{member.name}` | {kind} | {member.unit} "
                     f"| {member.comment} |")
    return "\n".join(lines)


def texts_of(root):
    """What people read of each bit, in the order of the bits: the English text and the Chinese one."""
    source = (root / "tools/study/planar/stop_reasons.cpp").read_text(encoding="utf-8")
    english = re.findall(r'translatable\("(.*?)"\)', source)
    entries = {}
    for path in sorted((root / "tools/io/language/zh").glob("*.po")):
        entries |= dict(re.findall(r'^msgid "(.*)"\nmsgstr "(.*)"$', path.read_text(encoding="utf-8"), re.M))
    return [(text, entries[text]) for text in english]


def reason_table(header_text, root):
    bits = re.findall(r"\bPOSE_WALL_PLANAR_STOP_R_(\w+) =\s*1 << (\d+),?\s*/\* (.*?) \*/", header_text)
    lines = ["| bit | mask | name | the stop tells it when | text for people | 中文 |",
             "| ---: | --- | --- | --- | --- | --- |"]
    for (name, bit, why), (english, chinese) in zip(bits, texts_of(root), strict=True):
        lines.append(f"| {bit} | 16#{1 << int(bit):08X} | `{name.lower()}` | {why} | {english} | {chinese} |")
    return "\n".join(lines)


def with_tables(structs, header_text, root, text):
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    return (before + BEGIN + "\n" + word_table(structs) + "\n\n" + reason_table(header_text, root) + "\n\n" + END
            + after)
