# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Reads can/can.def, and writes what follows from it: can_images.h, can_images.c and both DBC files."""

import collections
import pathlib
import re

import image_description as description

DEFINITION = pathlib.Path(__file__).with_name("can") / "can.def"
HOW = ("bits", "limit", "signed", "level")
FIRST_BIT, LAST_BIT = 16, 64  # behind CRC and counter; classic CAN has 8 bytes
NUMBERS = 64  # POSE_WALL_CAN_NUMBERS
CYCLE_MS = 100  # of silence: the daemon publishes ten times a second

Image = collections.namedtuple("Image", "struct function check counter frames")
Frame = collections.namedtuple("Frame", "name number priority comment signals")
Signal = collections.namedtuple("Signal", "path how bits start word member")
# Of a DBC: name, extended, identifier of a frame, attributes
Bus = collections.namedtuple("Bus", "file is_long id_of format_number")

PGN, ADDRESS, ID = 0xFF00, 128, 0x680  # as can_frames.h has them
# What the daemon reads (can_frames.h): the identifier is the user's, and this is one that is free.
COMMAND_NUMBER, COMMAND_PRIORITY, ANY_ADDRESS = 7, 3, 254
COMMAND = """BO_ {id} PoseWallCommand: 8 Vector__XXX
 SG_ crc8 : 0|8@1+ (1,0) [0|255] "" pose_wall
 SG_ counter : 8|8@1+ (1,0) [0|255] "" pose_wall
 SG_ command_speed : 16|16@1- (0.001,0) [-32.768|32.767] "m/s" pose_wall
 SG_ command_turn : 32|16@1- (0.001,0) [-32.768|32.767] "rad/s" pose_wall
 SG_ kept : 48|16@1+ (1,0) [0|0] "" pose_wall
"""
COMMAND_COMMENT = ('CM_ BO_ {id} "What the drive is told, read by key planar_command_can. The identifier is yours to '
                   'choose. Number 7.";')
BUSES = [Bus("pose_wall_11bit.dbc", False, lambda frame: ID + frame.number, 0),
         Bus("pose_wall_j1939.dbc", True,
             lambda frame: frame.priority << 26 | (PGN + frame.number) << 8 | ADDRESS, 3)]
TOLD_BY = {0: "not_known", 1: "frame", 2: "silence"}  # of no enum: as the image's comment has it


def members_of(structs, name, prefix=""):
    """(path, member) of each word."""
    for member in structs[name].members:
        if member.type in structs:
            yield from members_of(structs, member.type, prefix + member.name + ".")
        else:
            yield prefix + member.name, member


def signal_of(words, members, path, how, bits, start):
    if how not in HOW or path not in words or start + bits > LAST_BIT or not 1 <= bits <= 32:
        raise ValueError(f"can.def: {path} {how} {bits}: no such member or rule, or no room for it")
    return Signal(path, how, bits, start, words.index(path), members[path])


def read_images(structs, path=DEFINITION):
    """In the order of the file."""
    images, used = [], set()
    for line in path.read_text(encoding="utf-8").splitlines():
        line = line.split("//")[0].strip()
        if not line:
            continue
        head, *rest = [part.strip() for part in line.split("|")]
        first, *more = head.split()
        if first == "IMAGE":
            images.append(Image(*more, frames=[]))
            members = dict(members_of(structs, images[-1].struct))
            words = list(members)
        elif first == "FRAME":
            name, number, priority = more[0], int(more[1]), int(more[2])
            if number in used or not 0 <= number < NUMBERS or not 0 <= priority <= 7:
                raise ValueError(f"can.def: {name}: number taken or too large, or no such priority")
            used.add(number)
            images[-1].frames.append(Frame(name, number, priority, rest[0], []))
        else:
            signals = images[-1].frames[-1].signals
            start = signals[-1].start + signals[-1].bits if signals else FIRST_BIT
            signals.append(signal_of(words, members, first, more[0], int(more[1]), start))
    return images


def counter_word(structs, image):
    return [path for path, _ in members_of(structs, image.struct)].index(image.counter)


LICENCE = ("/* SPDX-License-Identifier: BSD-3-Clause\n * Copyright (c) 2026 the pose_wall authors\n *\n"
           " * Written by tools/apps/plc/generate.py from can.def")


def c_count(image):
    return f"POSE_WALL_CAN_{image.function.upper()}_FRAMES"


def c_prototype(image):
    head = f"uint32_t pose_wall_can_of_{image.function}("
    indent = " " * len(head)
    return (f"{head}const {image.struct}* image, const pose_wall_can_bus* bus,\n"
            f"{indent}pose_wall_can_frame frames[{c_count(image)}])")


def headers_of(images):
    """Of the public headers those that declare an image's struct: the one whose name its own begins with."""
    names = sorted(path.stem for path in (DEFINITION.parents[4] / "include").glob("pose_wall*.h"))
    return [max((name for name in names if image.struct.startswith(name)), key=len) + ".h" for image in images]


def c_header(images):
    parts = [LICENCE + """.
 *
 * Frames of each process image. Each function checks the image's CRC first: a damaged image gives no frame. Returns how
 * many frames it wrote, or 0: a NULL, an image of another version or with a wrong CRC, a bus without room. */
#ifndef POSE_WALL_CAN_IMAGES_H
#define POSE_WALL_CAN_IMAGES_H

#include "can_frames.h"
""" + "".join(f'#include "{name}"\n' for name in sorted(set(headers_of(images)))) + """
#ifdef __cplusplus
extern "C" {
#endif
"""]
    parts += [f"#define {c_count(image)} {len(image.frames)}\n{c_prototype(image)};\n" for image in images]
    parts.append("#ifdef __cplusplus\n}\n#endif\n\n#endif\n")
    return "\n".join(parts)


def c_source(structs, images):
    parts = [LICENCE + ". */\n\n#include \"can_images.h\"\n"]
    for image in images:
        rows = [f"    {{{frame.number}, {frame.priority}, {signal.word}, POSE_WALL_CAN_{signal.how.upper()}, "
                f"{signal.start}, {signal.bits}}}, /* {frame.name}: {signal.path} */"
                for frame in image.frames for signal in frame.signals]
        table = f"{image.function}_signals"
        parts.append("/* clang-format off */\n"
                     f"static const pose_wall_can_signal {table}[] = {{\n" + "\n".join(rows) +
                     "\n};\n/* clang-format on */\n")
        parts.append(f"""{c_prototype(image)} {{
  const uint32_t count = sizeof({table}) / sizeof({table}[0]);
  if (!image || !bus || !frames || !pose_wall_can_bus_is_sound(bus)) return 0;
  if ({image.check}(image) != POSE_WALL_OK) return 0;
  return pose_wall_can_pack(image, {counter_word(structs, image)}, {table}, count, bus, frames);
}}
""")
    return "\n".join(parts)


def scale_of(unit):
    """Factor and unit of the physical value."""
    if unit.startswith("0.001 "):
        return 0.001, unit[len("0.001 "):]
    return {"mm": (0.001, "m"), "mm/s": (0.001, "m/s")}.get(unit, (1, unit))


def dbc_name(path):
    """roll.value_mdeg, in deg as DBC has it: roll_value."""
    return re.sub(r"_(mdeg|mm|ms)(_s)?$", "", path.replace(".", "_"))


def numbers_of(signal, headers):
    """{number: name} of an enum that the comment names, and of what is none."""
    names = {}
    enum = re.search(r"\bpose_wall_\w+", signal.member.comment)
    if signal.path == "told_by":
        names = dict(TOLD_BY)
    elif enum and signal.member.type != "bits" and f"enum {enum.group(0)} {{" in headers:
        names = {number: re.sub("^pose_wall_(part_|sense_|along_|planar_stop_)?", "", key.lower())
                 for key, number in description.read_enum(headers, enum.group(0)).items()}
        names.update({number: "no_level" for number, name in names.items() if name == "parts"})
    if signal.how == "signed":
        names[-(1 << (signal.bits - 1))] = "no_value"
    if signal.how == "level":
        names[(1 << signal.bits) - 1] = "no_bound"
    if signal.how == "limit":
        names[(1 << signal.bits) - 1] = "more_or_not_known"
    return names


def number_text(value):
    return f"{value:.10g}"


def dbc_signal(signal):
    factor, unit = scale_of(signal.member.unit)
    least, most = 0, (1 << signal.bits) - 1
    if signal.how == "signed":
        least, most = -(1 << (signal.bits - 1)), (1 << (signal.bits - 1)) - 1
    sign = "-" if signal.how == "signed" else "+"
    return (f" SG_ {dbc_name(signal.path)} : {signal.start}|{signal.bits}@1{sign} ({number_text(factor)},0) "
            f"[{number_text(least * factor)}|{number_text(most * factor)}] \"{unit}\" Vector__XXX")


def dbc_comment(signal):
    """That of the image, with what all ones of 32 bits mean told for the signal's own width."""
    return signal.member.comment.replace(str((1 << 32) - 1), str((1 << signal.bits) - 1))


def dbc_ids(bus, frames):
    """As DBC writes them: bit 31 stands for 29 bits."""
    return {frame.number: bus.id_of(frame) | (1 << 31 if bus.is_long else 0) for frame in frames}


def dbc(images, bus, headers):
    frames = [frame for image in images for frame in image.frames]
    ids = dbc_ids(bus, frames)
    lines = ['VERSION ""', "", "NS_ :", "", "BS_:", "", "BU_: pose_wall", ""]
    for frame in frames:
        lines += [f"BO_ {ids[frame.number]} PoseWall{frame.name}: 8 pose_wall",
                  ' SG_ crc8 : 0|8@1+ (1,0) [0|255] "" Vector__XXX',
                  ' SG_ counter : 8|8@1+ (1,0) [0|255] "" Vector__XXX',
                  *(dbc_signal(signal) for signal in frame.signals), ""]
    command_id = (COMMAND_PRIORITY << 26 | (PGN + COMMAND_NUMBER) << 8 | ANY_ADDRESS | 1 << 31 if bus.is_long
                  else ID + COMMAND_NUMBER)
    lines += [COMMAND.format(id=command_id)]
    for frame in frames:
        at = ids[frame.number]
        lines.append(f'CM_ BO_ {at} "{frame.comment} Number {frame.number}.";')
        lines += [f'CM_ SG_ {at} {dbc_name(signal.path)} "{dbc_comment(signal)}";'
                  for signal in frame.signals if signal.member.comment]
    lines.append(COMMAND_COMMENT.format(id=command_id))
    lines += ['BA_DEF_ BO_ "GenMsgCycleTime" INT 0 65535;',
              'BA_DEF_ BO_ "VFrameFormat" ENUM "StandardCAN","ExtendedCAN","reserved","J1939PG";',
              f'BA_DEF_DEF_ "GenMsgCycleTime" {CYCLE_MS};', 'BA_DEF_DEF_ "VFrameFormat" "StandardCAN";']
    if bus.format_number:
        lines += [f'BA_ "VFrameFormat" BO_ {at} {bus.format_number};' for at in (*ids.values(), command_id)]
    for frame in frames:
        for signal in frame.signals:
            names = numbers_of(signal, headers)
            if names:
                texts = " ".join(f'{number} "{name}"' for number, name in sorted(names.items()))
                lines.append(f"VAL_ {ids[frame.number]} {dbc_name(signal.path)} {texts} ;")
    return "\n".join(lines) + "\n"


def outputs(root, structs, headers):
    """{path: text}. headers: of the enums."""
    images, can = read_images(structs), root / "tools/apps/plc/can"
    return {can / "can_images.h": c_header(images), can / "can_images.c": c_source(structs, images),
            **{can / bus.file: dbc(images, bus, headers) for bus in BUSES}}
