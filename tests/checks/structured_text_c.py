#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Structured text that structured_text.py has read, as C99: for each type and unit a struct, X_init() and, of units,
X_body(). TIME is milliseconds; the clock is the variable now_ms.

usage: structured_text_c.py FILE.st > FILE.h"""

import pathlib
import sys

sys.dont_write_bytecode = True  # the sources stay as they are
sys.path.insert(0, str(pathlib.Path(__file__).parent))

import structured_text  # noqa: E402  pylint: disable=wrong-import-position

KINDS = {"BOOL": "uint8_t", "DINT": "int32_t", "UDINT": "uint32_t", "WORD": "uint16_t", "DWORD": "uint32_t",
         "TIME": "int32_t"}
HEAD = """#include <stdint.h>
#include <string.h>

static int64_t now_ms;

typedef struct TON {
  uint8_t running, Q;
  int64_t since_ms;
  int32_t ET;
} TON;

static void TON_init(TON* v) { memset(v, 0, sizeof *v); }

static void TON_body(TON* v, uint8_t in, int32_t pt) {
  if (in && !v->running) v->since_ms = now_ms;
  v->running = in;
  v->ET = 0;
  if (in) v->ET = now_ms - v->since_ms < pt ? (int32_t)(now_ms - v->since_ms) : pt;
  v->Q = in && v->ET >= pt;
}
"""


def initialise(program, place, kind, initial):
    """Lines that start a variable as a controller does."""
    if isinstance(initial, list):
        element = program.types[kind][3]
        return [f"  {place}.at[{i}] = {structured_text.constant(element, value).c};" for i, value in enumerate(initial)]
    if initial is not None:
        return [f"  {place} = {structured_text.constant(kind, int(initial)).c};"]
    return [] if kind in KINDS else [f"  {kind}_init(&{place});"]


def rows_of(program, name, rows):
    lines = [f"\ntypedef struct {name} {{"]
    lines += [f"  {KINDS.get(kind, kind)}{'*' if section == 'VAR_IN_OUT' else ''} {key};"
              for key, (section, kind, _) in rows.items()]
    lines += [f"}} {name};", f"\nstatic void {name}_init({name}* v) {{", "  memset(v, 0, sizeof *v);"]
    for key, (section, kind, initial) in rows.items():
        if section != "VAR_IN_OUT":
            lines += initialise(program, f"v->{key}", kind, initial)
    return lines + ["}"]


def array(name, item):
    element = KINDS.get(item[3], item[3])
    return [f"\ntypedef struct {name} {{", f"  {element} at[{item[2] - item[1] + 1}];", f"}} {name};",
            f"\nstatic void {name}_init({name}* v) {{ memset(v, 0, sizeof *v); }}"]


def call_of(unit):
    inputs = {key: row for key, row in unit.variables.items() if row[0] in ("VAR_INPUT", "VAR_IN_OUT")}
    given = ", ".join(f"{KINDS.get(row[1], row[1])}{'*' if row[0] == 'VAR_IN_OUT' else ''} {key}"
                      for key, row in inputs.items())
    lines = [f"\nstatic {KINDS.get(unit.result, unit.result)} {unit.name}_call({given}) {{", f"  {unit.name} v;",
             f"  {unit.name}_init(&v);"]
    lines += [f"  v.{key} = {key};" for key in inputs]
    return lines + [f"  {unit.name}_body(&v);", f"  return v.{unit.name};", "}"]


def unit_lines(program, unit):
    lines = rows_of(program, unit.name, unit.variables)
    lines += [f"\nstatic void {unit.name}_body({unit.name}* v) {{", *unit.c_lines, "}"]
    return lines + (call_of(unit) if unit.kind == "FUNCTION" else [])


def translated(program):
    lines = []
    for name, item in program.types.items():
        if item[0] == "ARRAY":
            lines += array(name, item)
        else:
            lines += rows_of(program, name, {key: ("", *row) for key, row in item[1].items()})
    for unit in program.units.values():
        lines += unit_lines(program, unit)
    return HEAD + "\n".join(lines) + "\n"


if __name__ == "__main__":
    print(translated(structured_text.Program(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))), end="")
