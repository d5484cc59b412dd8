# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The process image in IEC 61131-3 structured text: types, constants, and the way from words to members."""

import image_description as description

HEAD = """(* SPDX-License-Identifier: BSD-3-Clause *)
(* Copyright (c) 2026 the pose_wall authors *)
(* Written by tools/plc/generate.py from tools/plc/image.def and include/pose_wall.h: do not edit. *)
"""
REAL = """
(* An IEEE 754 number from its bits, without a union or a pointer. What is no number is 0.0: the image holds none. *)
FUNCTION F_PoseWallReal : REAL
VAR_INPUT
  dwBits : DWORD;
END_VAR
VAR
  diExponent : DINT;
  rMantissa : REAL;
END_VAR
diExponent := DWORD_TO_DINT(SHR(dwBits, 23) AND 16#FF);
rMantissa := DINT_TO_REAL(DWORD_TO_DINT(dwBits AND 16#7FFFFF));
IF diExponent = 0 OR diExponent = 255 THEN
  F_PoseWallReal := 0.0;
ELSE
  F_PoseWallReal := (rMantissa + 8388608.0) * EXPT(2.0, DINT_TO_REAL(diExponent - 150));
  IF (dwBits AND 16#80000000) <> 0 THEN
    F_PoseWallReal := -F_PoseWallReal;
  END_IF;
END_IF;
END_FUNCTION
"""
CONVERSION = {"uint32": "DWORD_TO_UDINT({})", "int32": "DWORD_TO_DINT({})", "bits": "{}",
              "float": "F_PoseWallReal(dwBits := {})"}


def enumeration(states):
    values = ",\n".join(f"  {name} := {number}" for name, number in states.items())
    return f"\nTYPE E_PoseWallState :\n(\n{values}\n);\nEND_TYPE\n"


def struct_type(structs, struct):
    rows = []
    for member, at, _ in description.offsets(structs, struct.name):
        kind = description.TYPES[member.type][1] if member.type in description.TYPES else structs[member.type].st_name
        comment = "; ".join(text for text in (f"byte {at}", member.unit, member.comment) if text)
        rows.append(f"  {member.name} : {kind}; (* {comment} *)")
    rows = "\n".join(rows)
    return f"\n(* {struct.comment} *)\nTYPE {struct.st_name} :\nSTRUCT\n{rows}\nEND_STRUCT;\nEND_TYPE\n"


def literal(number):
    return f"DINT#{number}" if number < 0 else number


def constants(header_text, image_words):
    rows = [("POSE_WALL_IMAGE_BYTES", "UDINT", description.WORD * len(image_words)),
            ("POSE_WALL_IMAGE_LAST_WORD", "DINT", len(image_words) - 1),
            ("POSE_WALL_IMAGE_CRC_WORD", "DINT", description.crc_word(image_words))]
    rows += [(name, kind, literal(description.read_define(header_text, name)))
             for name, kind in (("POSE_WALL_IMAGE_VERSION", "UDINT"), ("POSE_WALL_IMAGE_NO_VALUE", "DINT"),
                                ("POSE_WALL_IMAGE_NO_BOUND", "DINT"))]
    rows += [(name, "DWORD", f"16#{bit:08X}") for name, bit in description.read_enum(header_text,
                                                                                     "pose_wall_reason").items()]
    lines = "\n".join(f"  {name} : {kind} := {value};" for name, kind, value in rows)
    return f"\nVAR_GLOBAL CONSTANT\n{lines}\nEND_VAR\n"


def state_function(states):
    rows = "\n".join(f"  {number}: F_PoseWallState := {name};" for name, number in states.items())
    return ("\n(* An unknown number is invalid. *)\nFUNCTION F_PoseWallState : E_PoseWallState\nVAR_INPUT\n"
            f"  udiState : UDINT;\nEND_VAR\nCASE udiState OF\n{rows}\nELSE\n"
            f"  F_PoseWallState := {min(states, key=states.get)};\nEND_CASE;\nEND_FUNCTION\n")


def decode_function(image_words):
    rows = "\n".join(f"stImage.{word.path} := {CONVERSION[word.type].format(f'adwImage[{i}]')};"
                     for i, word in enumerate(image_words))
    return ("\n(* The image's members from its words. *)\nFUNCTION F_PoseWallDecode : BOOL\nVAR_IN_OUT\n"
            "  adwImage : T_PoseWallWords;\n  stImage : ST_PoseWallImage;\nEND_VAR\n"
            f"{rows}\nF_PoseWallDecode := TRUE;\nEND_FUNCTION\n")


def structured_text(structs, header_text):
    states = description.read_enum(header_text, "pose_wall_state")
    structs = {name: item for name, item in structs.items() if "image2" not in name}
    image_words = description.image_words(1, structs)
    parts = [HEAD, enumeration(states), *(struct_type(structs, struct) for struct in structs.values()),
             "\n(* The image as it arrives: each word with its low byte first. *)\nTYPE T_PoseWallWords :\n"
             f"  ARRAY [0..{len(image_words) - 1}] OF DWORD;\nEND_TYPE\n",
             constants(header_text, image_words), REAL, state_function(states), decode_function(image_words)]
    return "".join(parts)
