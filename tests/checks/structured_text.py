# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Reads the part of IEC 61131-3 structured text that tools/plc uses, and runs it: tokens, declarations, and statements
turned into Python. A name that is not declared, a type that is not known and a block that is not closed are errors.
It is no compiler: types of expressions are not checked, and a controller's scan is a call."""

import re

TOKEN = re.compile(r"""\(\*.*?\*\)|(?P<time>T\#\d+ms)|(?P<number>(?:DINT\#)?-?16\#[0-9A-F]+|DINT\#-?\d+|\d+\.\d+|\d+)
                   |(?P<name>[A-Za-z_]\w*)|(?P<sign>:=|<>|<=|>=|\.\.|[-+*/=<>:;,.()\[\]])|(?P<fault>\S)""", re.S | re.X)
KEYWORDS = set("""TYPE END_TYPE STRUCT END_STRUCT ARRAY OF VAR_GLOBAL CONSTANT END_VAR FUNCTION END_FUNCTION VAR_INPUT
    VAR_OUTPUT VAR_IN_OUT VAR FUNCTION_BLOCK END_FUNCTION_BLOCK IF THEN ELSIF ELSE END_IF FOR TO DO END_FOR CASE
    END_CASE AND OR XOR NOT TRUE FALSE""".split())
ELEMENTARY = {"BOOL": False, "DINT": 0, "UDINT": 0, "DWORD": 0, "REAL": 0.0, "TIME": 0}
OPERATORS = {"AND": "&", "OR": "|", "XOR": "^", "=": "==", "<>": "!="}
PRECEDENCE = [{"OR"}, {"XOR"}, {"AND"}, {"=", "<>"}, {"<", ">", "<=", ">="}, {"+", "-"}, {"*", "/"}]


class Fault(Exception):
    pass


class Tokens:
    def __init__(self, text):
        self.all, self.at = [], 0
        for match in TOKEN.finditer(text):
            if match.lastgroup == "fault":
                raise Fault(f"line {text.count(chr(10), 0, match.start()) + 1}: {match.group()!r} is no token")
            if match.lastgroup:
                self.all.append((match.lastgroup, match.group(), text.count("\n", 0, match.start()) + 1))
        self.all.append(("end", "end of file", -1))

    def peek(self):
        return self.all[self.at][1]

    def kind(self):
        return self.all[self.at][0]

    def next(self):
        self.at += 1
        return self.all[self.at - 1][1]

    def accept(self, *texts):
        return self.next() if self.peek() in texts else None

    def expect(self, *texts):
        if self.peek() not in texts:
            self.fault(f"expected {' or '.join(texts)}, found {self.peek()}")
        return self.next()

    def name(self):
        if self.kind() != "name" or self.peek() in KEYWORDS:
            self.fault(f"expected a name, found {self.peek()}")
        return self.next()

    def fault(self, why):
        raise Fault(f"line {self.all[self.at][2]}: {why}")


def number(text):
    text = text.removeprefix("DINT#")
    if "16#" in text:
        return int(text.replace("16#", ""), 16)
    return float(text) if "." in text else int(text)


class Unit:
    """A function or function block: its variables {name: (section, type, initial value)} and its body in Python."""

    def __init__(self, kind, name, result):
        self.kind, self.name, self.result, self.variables, self.lines = kind, name, result, {}, []


class Program:
    """All types, constants and units of the files given, in this order."""

    def __init__(self, *texts):
        self.types, self.constants, self.units = {}, {}, {}
        for text in texts:
            self.tokens = Tokens(text)
            while self.tokens.kind() != "end":
                self.declaration()

    def declaration(self):
        word = self.tokens.expect("TYPE", "VAR_GLOBAL", "FUNCTION", "FUNCTION_BLOCK")
        if word == "TYPE":
            self.type_declaration()
        elif word == "VAR_GLOBAL":
            self.tokens.expect("CONSTANT")
            for name, (_, initial) in self.variables().items():
                self.constants[name] = initial
        else:
            self.unit(word)

    def type_declaration(self):
        name = self.tokens.name()
        self.tokens.expect(":")
        if self.tokens.accept("STRUCT"):
            self.types[name] = ("STRUCT", {key: kind for key, (kind, _) in self.variables("END_STRUCT").items()})
        elif self.tokens.accept("("):
            self.types[name] = ("ENUM", self.enumeration())
        else:
            self.types[name] = self.array_type()
        self.tokens.expect(";")
        self.tokens.expect("END_TYPE")

    def enumeration(self):
        names = {}
        while True:
            key = self.tokens.name()
            self.tokens.expect(":=")
            names[key] = self.constants[key] = number(self.tokens.next())
            if self.tokens.expect(",", ")") == ")":
                return names

    def array_type(self):
        self.tokens.expect("ARRAY")
        self.tokens.expect("[")
        first = number(self.tokens.next())
        self.tokens.expect("..")
        last = number(self.tokens.next())
        self.tokens.expect("]")
        self.tokens.expect("OF")
        return "ARRAY", first, last, self.type_name()

    def type_name(self):
        name = self.tokens.name()
        blocks = {unit for unit in self.units if self.units[unit].kind == "FUNCTION_BLOCK"}
        if name not in ELEMENTARY and name not in self.types and name not in blocks and name != "TON":
            self.tokens.fault(f"type {name} is not known")
        return name

    def variables(self, end="END_VAR"):
        found = {}
        while not self.tokens.accept(end):
            name = self.tokens.name()
            if name in found:
                self.tokens.fault(f"{name} is declared twice")
            self.tokens.expect(":")
            kind, initial = self.type_name(), None
            if self.tokens.accept(":="):
                text = self.tokens.next()
                initial = int(text[2:-2]) if text.startswith("T#") else number(text)
            self.tokens.expect(";")
            found[name] = (kind, initial)
        return found

    def unit(self, kind):
        unit = Unit(kind, self.tokens.name(), None)
        if kind == "FUNCTION":
            self.tokens.expect(":")
            unit.result = self.type_name()
            unit.variables[unit.name] = ("RESULT", unit.result, None)
        while self.tokens.peek() in ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR"):
            section = self.tokens.next()
            for name, (type_name, initial) in self.variables().items():
                unit.variables[name] = (section, type_name, initial)
        self.current = unit
        self.block({f"END_{kind}"}, 1)
        self.tokens.next()
        self.units[unit.name] = unit

    # Statements

    def emit(self, depth, text):
        self.current.lines.append("    " * depth + text)

    def block(self, ends, depth):
        begun = len(self.current.lines)
        while self.tokens.peek() not in ends:
            self.statement(depth)
        if len(self.current.lines) == begun:
            self.emit(depth, "pass")

    def statement(self, depth):
        start = {"IF": self.if_statement, "FOR": self.for_statement, "CASE": self.case_statement}
        if self.tokens.peek() in start:
            return start[self.tokens.next()](depth)
        if self.tokens.peek() in KEYWORDS:
            self.tokens.fault(f"{self.tokens.peek()} begins no statement")
        target = self.variable()
        if self.tokens.accept("("):
            self.emit(depth, f"run.call({target}, {self.arguments()})")
        else:
            self.tokens.expect(":=")
            self.emit(depth, f"run.assign({self.place(target)}, {self.expression()})")
        self.tokens.expect(";")
        return None

    def place(self, target):
        """owner, key of "v['a'].b[3]"."""
        head, key = re.fullmatch(r"(.*)\[([^\[\]]*|'[^']*')\]", target).groups()
        return f"{head}, {key}"

    def if_statement(self, depth):
        word = "if"
        while True:
            self.emit(depth, f"{word} {self.expression()}:")
            self.tokens.expect("THEN")
            self.block({"ELSIF", "ELSE", "END_IF"}, depth + 1)
            if not self.tokens.accept("ELSIF"):
                break
            word = "elif"
        if self.tokens.accept("ELSE"):
            self.emit(depth, "else:")
            self.block({"END_IF"}, depth + 1)
        self.tokens.expect("END_IF")
        self.tokens.expect(";")

    def for_statement(self, depth):
        counter = self.variable()
        self.tokens.expect(":=")
        first = self.expression()
        self.tokens.expect("TO")
        self.emit(depth, f"for {counter} in range({first}, {self.expression()} + 1):")
        self.tokens.expect("DO")
        self.block({"END_FOR"}, depth + 1)
        self.tokens.expect("END_FOR")
        self.tokens.expect(";")

    def case_statement(self, depth):
        selector, word = self.expression(), "if"
        self.tokens.expect("OF")
        while self.tokens.kind() == "number":
            self.emit(depth, f"{word} {selector} == {number(self.tokens.next())}:")
            self.tokens.expect(":")
            self.statement(depth + 1)
            word = "elif"
        if self.tokens.accept("ELSE"):
            self.emit(depth, "else:")
            self.block({"END_CASE"}, depth + 1)
        self.tokens.expect("END_CASE")
        self.tokens.expect(";")

    # Expressions

    def expression(self, level=0):
        if level == len(PRECEDENCE):
            return self.operand()
        text = self.expression(level + 1)
        while self.tokens.peek() in PRECEDENCE[level]:
            operator = self.tokens.next()
            text = f"({text} {OPERATORS.get(operator, operator)} {self.expression(level + 1)})"
        return text

    def operand(self):
        if self.tokens.accept("NOT"):
            return f"run.invert({self.operand()})"
        if self.tokens.accept("-"):
            return f"(-{self.operand()})"
        if self.tokens.accept("("):
            text = self.expression()
            self.tokens.expect(")")
            return text
        if self.tokens.kind() == "number":
            return str(number(self.tokens.next()))
        if self.tokens.peek() in ("TRUE", "FALSE"):
            return self.tokens.next().capitalize()
        name = self.tokens.peek()
        if name in self.units and self.units[name].kind == "FUNCTION" and name != self.current.name:
            self.tokens.next()
            self.tokens.expect("(")
            return f"run.function('{name}', {self.arguments(self.units[name])})"
        if name in STANDARD:
            self.tokens.next()
            self.tokens.expect("(")
            arguments = [self.expression()]
            while self.tokens.expect(",", ")") == ",":
                arguments.append(self.expression())
            return f"run.{name}({', '.join(arguments)})"
        return self.variable()

    def arguments(self, called=None):
        texts = []
        while True:
            name = self.tokens.name()
            self.tokens.expect(":=")
            given = self.current.variables.get(self.tokens.peek(), ("",))[0]
            if called and called.variables.get(name, ("",))[0] == "VAR_IN_OUT" and given == "VAR_INPUT":
                self.tokens.fault(f"{self.tokens.peek()} is an input, {called.name} may write to it")
            texts.append(f"{name}={self.expression()}")
            if self.tokens.expect(",", ")") == ")":
                return ", ".join(texts)

    def variable(self):
        name = self.tokens.name()
        if name in self.constants:
            return str(self.constants[name])
        if name not in self.current.variables:
            self.tokens.fault(f"{name} is not declared")
        text, kind = f"v['{name}']", self.current.variables[name][1]
        while self.tokens.peek() in (".", "["):
            if self.tokens.next() == ".":
                member = self.tokens.name()
                kind = self.member_type(kind, member)
                text += f"['{member}']"
            else:
                if self.types.get(kind, "?")[0] != "ARRAY":
                    self.tokens.fault(f"{kind} is no array")
                text += f"[{self.expression()}]"
                self.tokens.expect("]")
                kind = self.types[kind][3]
        return text

    def member_type(self, kind, member):
        members = {"Q": "BOOL"} if kind == "TON" else {}
        if kind in self.types and self.types[kind][0] == "STRUCT":
            members = self.types[kind][1]
        elif kind in self.units:
            members = {key: row[1] for key, row in self.units[kind].variables.items() if row[0] != "VAR"}
        if member not in members:
            self.tokens.fault(f"{kind} has no {member}")
        return members[member]


STANDARD = {"SHR", "EXPT", "DWORD_TO_DINT", "DWORD_TO_UDINT", "DINT_TO_REAL"}
