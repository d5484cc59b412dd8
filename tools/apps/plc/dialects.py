# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The function blocks as plain text of IEC 61131-3, and as an SCL source for TIA Portal. What differs in SCL: names of
types and blocks in quotes, a # before local ones, DWORD shifts with named operands, no named arrays, TON_TIME."""

import re

NOTE = ("Written by tools/apps/plc/generate.py from tools/apps/plc/image.def, blocks.def and include/pose_wall.h: "
        "do not edit.")
HEAD = f"(* SPDX-License-Identifier: BSD-3-Clause *)\n(* Copyright (c) 2026 the pose_wall authors *)\n(* {NOTE} *)\n"
WORD = re.compile(r"\(\*.*?\*\)|(?:T|DINT|16)#[\w-]+|[A-Za-z_]\w*|:=|\S|\s+", re.S)
SCL_TYPE = {"BOOL": "Bool", "DINT": "DInt", "UDINT": "UDInt", "WORD": "Word", "DWORD": "DWord", "TIME": "Time",
            "TON": "TON_TIME"}
SCL_WORDS = set("""IF THEN ELSIF ELSE END_IF FOR TO DO END_FOR CASE OF END_CASE AND OR XOR NOT MOD TRUE FALSE
    DWORD_TO_DINT DWORD_TO_UDINT UDINT_TO_DINT UDINT_TO_DWORD WORD_TO_DWORD""".split())


def rows(variables, kind_of, indent="  "):
    lines = []
    for row in variables:
        initial = f" := {row.initial}" if row.initial is not None else ""
        comment = f" (* {row.comment} *)" if row.comment else ""
        lines.append(f"{indent}{row.name} : {kind_of(row.type)}{initial};{comment}\n")
    return "".join(lines)


def commented(comment):
    return f"\n{comment}\n" if comment else "\n"


# Plain text


def plain_type(item):
    body = (f"  ARRAY [0..{item.last}] OF {item.type};" if item.members is None else
            f"STRUCT\n{rows(item.members, str)}END_STRUCT;")
    return f"{commented(item.comment)}TYPE {item.name} :\n{body}\nEND_TYPE\n"


def plain_unit(unit):
    result = f" : {unit.result}" if unit.result else ""
    sections = "".join(f"{section}\n{rows(variables, str)}END_VAR\n" for section, variables in unit.variables.items())
    constants = f"VAR CONSTANT\n{rows(unit.constants, str)}END_VAR\n" if unit.constants else ""
    return (f"{commented(unit.comment)}{unit.kind} {unit.name}{result}\n{sections}{constants}{unit.body}\n"
            f"END_{unit.kind}\n")


def plain(read):
    return HEAD + "".join([*map(plain_type, read.types.values()), *map(plain_unit, read.units.values())])


# SCL


def scl_kind(read):
    def kind_of(kind):
        if kind in SCL_TYPE:
            return SCL_TYPE[kind]
        item = read.types.get(kind)
        if item and item.members is None:
            return f"Array[0..{item.last}] of {SCL_TYPE[item.type]}"
        return f'"{kind}"'
    return kind_of


def scl_body(read, unit):
    """Member names after a dot and parameter names before := in a call stay as they are."""
    words, out, depth = WORD.findall(unit.body), [], []
    for at, word in enumerate(words):
        before = "".join(out).rstrip()[-1:]
        if word == "(":
            depth.append(out[-1] if out and re.fullmatch(r'[#"]?\w+"?', out[-1]) and out[-1] not in SCL_WORDS else "")
        shift = depth[-1] if depth and depth[-1] in ("SHL", "SHR") else ""
        if word == ")":
            depth.pop()
        after = next((other for other in words[at + 1:] if other.strip()), "")
        is_parameter = depth and depth[-1] and after == ":=" and before in "(,"
        is_name = re.fullmatch(r"[A-Za-z_]\w*", word) and word not in SCL_WORDS and word not in ("SHL", "SHR")
        if is_name and word in read.units:
            word = f"#{word}" if word == unit.name else f'"{word}"'
        elif is_name and not is_parameter and before != ".":
            word = f"#{word}"
        if word == "," and shift:
            word = ", N :="
        out.append(word + "IN := " if word == "(" and depth[-1] in ("SHL", "SHR") else word)
    return "".join("  " + line + "\n" if line else "\n" for line in "".join(out).splitlines())


def scl_type(read, item):
    members = rows(item.members, scl_kind(read), "    ")
    return f'{commented(item.comment)}TYPE "{item.name}"\nVERSION : 0.1\n  STRUCT\n{members}  END_STRUCT;\nEND_TYPE\n'


def scl_unit(read, unit):
    kind_of = scl_kind(read)
    result = f" : {kind_of(unit.result)}" if unit.result else ""
    names = {"VAR": "VAR_TEMP"} if unit.kind == "FUNCTION" else {}
    sections = "".join(f"{names.get(section, section)}\n{rows(unit.variables[section], kind_of)}END_VAR\n"
                       for section in ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR") if section in unit.variables)
    constants = f"VAR CONSTANT\n{rows(unit.constants, kind_of)}END_VAR\n" if unit.constants else ""
    return (f'{commented(unit.comment)}{unit.kind} "{unit.name}"{result}\n'
            "{ S7_Optimized_Access := 'TRUE' }\nVERSION : 0.1\n"
            f"{sections}{constants}BEGIN\n{scl_body(read, unit)}END_{unit.kind}\n")


def scl(read):
    structs = [item for item in read.types.values() if item.members is not None]
    return HEAD + "".join([*(scl_type(read, item) for item in structs),
                           *(scl_unit(read, unit) for unit in read.units.values())])
