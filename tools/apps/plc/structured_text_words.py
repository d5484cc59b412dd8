# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""What image.def and pose_wall.h say, in IEC 61131-3 structured text: types, constants, the way from an image's words
to its members, and the seven calls of FB_PoseWall. It stands before and in what blocks.def says."""

import image_description as description

# Function block and output, member of the image, kind of the limits
CHANNELS = [("Roll", "roll", "Angle"), ("Pitch", "pitch", "Angle"), ("Yaw", "yaw", "Angle"),
            ("LeftFront", "d_lf", "Distance"), ("LeftBack", "d_lb", "Distance"),
            ("RightFront", "d_rf", "Distance"), ("RightBack", "d_rb", "Distance")]
CALL = """fb{name}(xGood := xGood, udiState := stImage.{member}.state, diValue := stImage.{member}.value_{unit},
  diLevel := stImage.{member}.protection_{unit}, diLatency_ms := diArrivedLatency_ms, xNew := xNew, xAlive := xAlive,
  diLimit := di{kind}Limit_{unit}, diRate := di{kind}Rate_{unit}_s, xTakeDegraded := xTakeDegraded, tHold := tHold,
  xSubstitute := xSubstitute, diSubstitute := di{kind}Substitute_{unit});
st{name} := fb{name}.stValue;
IF st{name}.xUsable THEN
  dwUsable := dwUsable OR 16#{bit:08X};
END_IF;
"""
CONVERSION = {"uint32": "DWORD_TO_UDINT({})", "int32": "DWORD_TO_DINT({})", "bits": "{}"}
# What image 1 does not tell; 0 where nothing stands here
MISSING = {"publication": "stImage.sequence", "latency_ms": "POSE_WALL_NOT_KNOWN", "cause": "7"}


def channels():
    calls = [CALL.format(name=name, member=member, kind=kind, unit="mdeg" if kind == "Angle" else "mm", bit=1 << q)
             for q, (name, member, kind) in enumerate(CHANNELS)]
    return "dwUsable := 16#00000000;\n" + "".join(calls)


def nibbles(polynomial):
    """Of each four bits: what they leave in the sum."""
    table = []
    for value in range(16):
        for _ in range(4):
            value = value >> 1 ^ (polynomial if value & 1 else 0)
        table.append(f"16#{value:08X}")
    return f"[{', '.join(table)}]"


def struct_type(structs, struct):
    rows = []
    for member, at, _ in description.offsets(structs, struct.name):
        kind = description.TYPES[member.type][1] if member.type in description.TYPES else structs[member.type].st_name
        comment = "; ".join(text for text in (f"byte {at}", member.unit, member.comment) if text)
        rows.append(f"  {member.name} : {kind}; (* {comment} *)")
    rows = "\n".join(rows)
    return f"(* {struct.comment} *)\nTYPE {struct.st_name} :\nSTRUCT\n{rows}\nEND_STRUCT;\nEND_TYPE\n\n"


def constants(header_text, structs):
    rows = []
    for version in description.images(structs):
        words = description.image_words(version, structs)
        rows += [(f"POSE_WALL_IMAGE{version}_BYTES", "DWORD", f"16#{description.WORD * len(words):08X}"),
                 (f"POSE_WALL_IMAGE{version}_LAST_WORD", "DINT", len(words) - 1),
                 (f"POSE_WALL_NIBBLES_{version}", "T_PoseWallNibbles", nibbles(description.POLYNOMIAL[version]))]
    rows += [("POSE_WALL_IMAGE_CRC_WORD", "DINT", description.crc_word(words))]
    rows += [(name, "DINT", f"DINT#{description.read_define(header_text, name)}")
             for name in ("POSE_WALL_IMAGE_NO_VALUE", "POSE_WALL_IMAGE_NO_BOUND")]
    rows += [(name, "UDINT", number) for name, number in description.read_enum(header_text, "pose_wall_state").items()]
    lines = "\n".join(f"  {name} : {kind} := {value};" for name, kind, value in rows)
    return f"VAR_GLOBAL CONSTANT\n{lines}\nEND_VAR\n\n"


def decode_rows(structs, version, into=2):
    """stImage is of version `into`, the words are of `version`."""
    own = {word.path: i for i, word in enumerate(description.image_words(version, structs))}
    for word in description.image_words(into, structs):
        at = own.get(word.path, own["crc32"] if word.path == "crc32c" and "crc32" in own else None)
        value = MISSING.get(word.path.rsplit(".", maxsplit=1)[-1], "0")
        if at is not None:
            value = CONVERSION[word.type].format(f"adwImage[{at}]")
        yield f"  stImage.{word.path} := {value};"


def decode_function(structs):
    new, old = ("\n".join(decode_rows(structs, version)) for version in (2, 1))
    return ("(* The members of an image from its words. *)\nFUNCTION F_PoseWallDecode : BOOL\nVAR_IN_OUT\n"
            "  adwImage : T_PoseWallWords;\n  stImage : ST_PoseWallImage;\nEND_VAR\n"
            f"IF adwImage[1] = 16#00000002 THEN\n{new}\nELSE\n{old}\nEND_IF;\n"
            "F_PoseWallDecode := TRUE;\nEND_FUNCTION\n\n")


def decode_one(structs, version, function, what):
    """Of an image that has one version only."""
    rows = "\n".join(row.strip() for row in decode_rows(structs, version, version))
    st_name = structs[description.images(structs)[version]].st_name
    return (f"(* The members of {what} from its words. *)\nFUNCTION {function} : BOOL\nVAR_IN_OUT\n"
            f"  adwImage : T_PoseWallWords;\n  stImage : {st_name};\nEND_VAR\n"
            f"{rows}\n{function} := TRUE;\nEND_FUNCTION\n\n")


def description_text(header_text, blocks_text):
    """The one text from which all that controllers import is made."""
    structs = description.read_structs()
    last = len(description.image_words(2, structs)) - 1
    types = [struct_type(structs, item) for item in structs.values() if item.st_name != "-"]
    words = ("(* An image as it arrives. *)\nTYPE T_PoseWallWords :\n"
             f"  ARRAY [0..{last}] OF DWORD;\nEND_TYPE\n\n"
             "(* The same as Modbus delivers it. *)\nTYPE T_PoseWallRegisters :\n"
             f"  ARRAY [0..{2 * last + 1}] OF WORD;\nEND_TYPE\n\n")
    return "".join([constants(header_text, structs), *types, words, decode_function(structs),
                    decode_one(structs, 3, "F_PoseWallDecodeMotion", "a motion image"),
                    decode_one(structs, 4, "F_PoseWallDecodeStop", "a stop image"),
                    blocks_text.replace("@CHANNELS@\n", channels())])
