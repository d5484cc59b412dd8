# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Reads the description of function blocks: constants, types and units, one declaration a line. A body stays text."""

import collections
import re

SECTIONS = ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR")
DECLARATION = re.compile(r"\s*(\w+) : (\w+)(?: := (.*?))?;(?: \(\* (.*) \*\))?$")
ARRAY = re.compile(r"\s*ARRAY \[0\.\.(\d+)\] OF (\w+);$")

Variable = collections.namedtuple("Variable", "name type initial comment")
# members: of a struct; last: of an array 0..last of `type`
Type = collections.namedtuple("Type", "name comment members last type")
# variables: {section: [Variable]}; constants: those that the body names
Unit = collections.namedtuple("Unit", "kind name result comment variables constants body")


class Fault(Exception):
    pass


class Reader:
    def __init__(self, text):
        self.lines, self.at = text.splitlines(), 0
        self.constants, self.types, self.units, self.comment = {}, {}, {}, ""
        while self.at < len(self.lines):
            self.declaration()
        self.types = {name: item._replace(members=self.resolved(item.members)) for name, item in self.types.items()}
        self.units = {name: self.with_constants(unit) for name, unit in self.units.items()}

    def next(self):
        if self.at == len(self.lines):
            raise Fault("the text ends inside a declaration")
        self.at += 1
        return self.lines[self.at - 1]

    def declaration(self):
        line = self.next()
        word = line.split(" ", maxsplit=1)[0]
        if line.startswith("(*"):
            while not line.endswith("*)"):
                line += "\n" + self.next()
            self.comment = line
        elif line == "VAR_GLOBAL CONSTANT":
            self.constants |= {row.name: row for row in self.variables("END_VAR")}
        elif word == "TYPE":
            self.type(line.split()[1])
        elif word in ("FUNCTION", "FUNCTION_BLOCK"):
            self.unit(word, line)
        elif line:
            raise Fault(f"line {self.at}: {line} begins nothing")

    def variables(self, end):
        found = []
        while (line := self.next()) != end:
            match = DECLARATION.match(line)
            if not match:
                raise Fault(f"line {self.at}: {line} declares nothing")
            if match.group(1) in [row.name for row in found]:
                raise Fault(f"line {self.at}: {match.group(1)} is declared twice")
            found.append(Variable(*match.groups()))
        return found

    def resolved(self, rows):
        """With numbers where constants stood."""
        return rows and [row._replace(initial=self.constants[row.initial].initial)
                         if row.initial in self.constants else row for row in rows]

    def with_constants(self, unit):
        named = [row for name, row in self.constants.items() if re.search(rf"\b{name}\b", unit.body)]
        variables = {section: self.resolved(rows) for section, rows in unit.variables.items()}
        return unit._replace(variables=variables, constants=named)

    def type(self, name):
        line = self.next()
        if line == "STRUCT":
            self.types[name] = Type(name, self.comment, self.variables("END_STRUCT;"), None, None)
        elif match := ARRAY.match(line):
            self.types[name] = Type(name, self.comment, None, int(match.group(1)), match.group(2))
        else:
            raise Fault(f"line {self.at}: {line} is no type")
        if self.next() != "END_TYPE":
            raise Fault(f"line {self.at}: END_TYPE is missing")
        self.comment = ""

    def unit(self, kind, line):
        head = re.fullmatch(rf"{kind} (\w+)(?: : (\w+))?", line)
        variables, body = {}, []
        while (line := self.next()) in SECTIONS:
            variables[line] = self.variables("END_VAR")
        while line != f"END_{kind}":
            body.append(line)
            line = self.next()
        self.units[head.group(1)] = Unit(kind, *head.groups(), self.comment, variables, [], "\n".join(body))
        self.comment = ""
