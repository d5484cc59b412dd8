# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Runs function blocks that structured_text.py has read, cycle by cycle, with a clock of its own. A number that its
type does not hold is a fault."""

import copy

import structured_text

WORD = 0xFFFFFFFF
LIMITS = {"DINT": (-2**31, 2**31 - 1), "UDINT": (0, WORD), "WORD": (0, 0xFFFF), "DWORD": (0, WORD),
          "TIME": (-2**31, 2**31 - 1)}


class Controller:
    def __init__(self, program):
        self.program, self.now_ms, self.bodies = program, 0, {}
        for name, unit in program.units.items():
            scope = {}
            exec("def body(run, v):\n" + "\n".join(unit.lines), scope)  # pylint: disable=exec-used
            self.bodies[name] = scope["body"]

    def make(self, kind, initial=None):
        """A variable of this type as a controller starts it."""
        if initial is not None:
            return copy.deepcopy(initial)
        if kind == "TON":
            return {"TON": True, "Q": False, "ET": 0, "since_ms": None}
        if kind in structured_text.ELEMENTARY:
            return structured_text.ELEMENTARY[kind]
        if kind in self.program.units:
            return {"UNIT": kind} | self.make_variables(self.program.units[kind])
        declared = self.program.types[kind]
        if declared[0] == "STRUCT":
            return {name: self.make(*row) for name, row in declared[1].items()}
        return [self.make(declared[3]) for _ in range(declared[1], declared[2] + 1)]

    def make_variables(self, unit):
        return {name: self.make(row[1], row[2]) for name, row in unit.variables.items()}

    def call(self, block, **arguments):
        """One scan of a function block instance."""
        if "TON" in block:
            return self.timer(block, **arguments)
        unit = self.program.units[block["UNIT"]]
        for name, value in arguments.items():
            self.pass_in(unit, block, name, value)
        self.bodies[unit.name](self, block)
        return block

    def function(self, name, **arguments):
        unit = self.program.units[name]
        variables = self.make_variables(unit)
        for argument, value in arguments.items():
            self.pass_in(unit, variables, argument, value)
        self.bodies[name](self, variables)
        return variables[name]

    def pass_in(self, unit, variables, name, value):
        section, kind, _ = unit.variables[name]
        if section not in ("VAR_INPUT", "VAR_IN_OUT"):
            raise structured_text.Fault(f"{unit.name}: {name} is no input")
        self.in_range(kind, value)
        variables[name] = value if section == "VAR_IN_OUT" or isinstance(value, int) else copy.deepcopy(value)

    def assign(self, owner, key, value, kind):
        self.in_range(kind, value)
        owner[key] = value if isinstance(value, int) else copy.deepcopy(value)

    @staticmethod
    def in_range(kind, value):
        if kind in LIMITS and not LIMITS[kind][0] <= value <= LIMITS[kind][1]:
            raise structured_text.Fault(f"{value} is no {kind}")

    def timer(self, ton, IN, PT):  # pylint: disable=invalid-name
        if not IN:
            ton["since_ms"] = None
        elif ton["since_ms"] is None:
            ton["since_ms"] = self.now_ms
        ton["ET"] = min(self.now_ms - ton["since_ms"], PT) if IN else 0
        ton["Q"] = IN and ton["ET"] >= PT
        return ton

    @staticmethod
    def invert(value):
        return not value if isinstance(value, bool) else ~value & WORD

    @staticmethod
    def divide(one, other):
        """Towards zero."""
        return abs(one) // abs(other) * (1 if (one < 0) == (other < 0) else -1)

    @staticmethod
    def rest(one, other):
        return one - other * Controller.divide(one, other)

    # pylint: disable=invalid-name
    @staticmethod
    def SHR(value, places):
        return value >> places

    @staticmethod
    def SHL(value, places):
        return value << places & WORD

    @staticmethod
    def DWORD_TO_DINT(value):
        return value - 2**32 if value > 2**31 - 1 else value

    @staticmethod
    def DWORD_TO_UDINT(value):
        return value

    @staticmethod
    def UDINT_TO_DINT(value):
        return value

    @staticmethod
    def UDINT_TO_DWORD(value):
        return value

    @staticmethod
    def WORD_TO_DWORD(value):
        return value
