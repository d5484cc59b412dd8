# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Reads the part of IEC 61131-3 structured text that tools/apps/plc uses: tokens, declarations, and statements turned
into Python and into C. A name that is not declared, a type that is not known, a block that is not closed and kinds that
are mixed (BOOL, DINT, UDINT, WORD, DWORD, TIME: nothing is converted unasked) are errors. A controller's scan is a
call."""

import collections
import re

TOKEN = re.compile(r"""\(\*.*?\*\)|(?P<time>T\#\d+m?s)|(?P<number>(?:DINT\#)?-?16\#[0-9A-F]+|DINT\#-?\d+|\d+)
                   |(?P<name>[A-Za-z_]\w*)|(?P<sign>:=|<>|<=|>=|\.\.|[-+*/=<>:;,.()\[\]])|(?P<fault>\S)""", re.S | re.X)
KEYWORDS = set("""TYPE END_TYPE STRUCT END_STRUCT ARRAY OF CONSTANT END_VAR FUNCTION END_FUNCTION VAR_INPUT
    VAR_OUTPUT VAR_IN_OUT VAR FUNCTION_BLOCK END_FUNCTION_BLOCK IF THEN ELSIF ELSE END_IF FOR TO DO END_FOR CASE
    END_CASE AND OR XOR NOT MOD TRUE FALSE""".split())
ELEMENTARY = {"BOOL": False, "DINT": 0, "UDINT": 0, "WORD": 0, "DWORD": 0, "TIME": 0}
PRECEDENCE = [{"OR"}, {"XOR"}, {"AND"}, {"=", "<>"}, {"<", ">", "<=", ">="}, {"+", "-"}, {"*", "/", "MOD"}]
PYTHON = {"AND": "&", "OR": "|", "XOR": "^", "=": "==", "<>": "!="}
C = {"AND": "&", "OR": "|", "XOR": "^", "=": "==", "<>": "!=", "MOD": "%"}
# Of an operator: the kinds that it takes
TAKES = {**dict.fromkeys(("AND", "OR", "XOR"), {"BOOL", "DWORD"}), **dict.fromkeys(("*", "/", "MOD"), {"DINT"}),
         **dict.fromkeys(("+", "-"), {"DINT", "TIME"}), **dict.fromkeys(("=", "<>"), set(ELEMENTARY)),
         **dict.fromkeys(("<", ">", "<=", ">="), {"DINT", "UDINT", "TIME"})}
COMPARES = ("=", "<>", "<", ">", "<=", ">=")
# Name: kinds of the operands, of the result, and C
STANDARD = {"SHR": (("DWORD", "DINT"), "DWORD", "({} >> {})"), "SHL": (("DWORD", "DINT"), "DWORD", "({} << {})"),
            "DWORD_TO_DINT": (("DWORD",), "DINT", "(int32_t)({})"), "DWORD_TO_UDINT": (("DWORD",), "UDINT", "({})"),
            "UDINT_TO_DINT": (("UDINT",), "DINT", "(int32_t)({})"), "UDINT_TO_DWORD": (("UDINT",), "DWORD", "({})"),
            "WORD_TO_DWORD": (("WORD",), "DWORD", "(uint32_t)({})")}

# Of a body: its kind, and what it is in either language. A decimal number is of kind INT until it meets others.
Text = collections.namedtuple("Text", "kind python c")


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
    if text.startswith("T#"):
        return int(text[2:-2]) if text.endswith("ms") else 1000 * int(text[2:-1])
    text = text.removeprefix("DINT#")
    return int(text.replace("16#", ""), 16) if "16#" in text else int(text)


def literal(text):
    kinds = (("T#", "TIME"), ("DINT#", "DINT"), ("16#", "DWORD"))
    return constant(next((kind for start, kind in kinds if text.startswith(start)), "INT"), number(text))


def constant(kind, value):
    suffix = "u" if kind in ("DWORD", "UDINT") else ""
    return Text(kind, str(value), f"INT32_MIN{suffix}" if value == -2**31 else f"{value}{suffix}")


class Unit:
    """A function or function block: its variables {name: (section, type, initial value)}, its constants {name: Text}
    and its body in Python and in C."""

    def __init__(self, kind, name, result):
        self.kind, self.name, self.result, self.variables, self.constants = kind, name, result, {}, {}
        self.lines, self.c_lines = [], []


class Program:
    """All types and units of the files given, in this order."""

    def __init__(self, *texts):
        self.types, self.units = {}, {}
        for text in texts:
            self.tokens = Tokens(text)
            while self.tokens.kind() != "end":
                self.declaration()

    def declaration(self):
        word = self.tokens.expect("TYPE", "FUNCTION", "FUNCTION_BLOCK")
        if word == "TYPE":
            self.type_declaration()
        else:
            self.unit(word)

    def type_declaration(self):
        name = self.tokens.name()
        self.tokens.expect(":")
        if self.tokens.accept("STRUCT"):
            self.types[name] = ("STRUCT", self.variables("END_STRUCT"))
        else:
            self.types[name] = self.array_type()
        self.tokens.expect(";")
        self.tokens.expect("END_TYPE")

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
        """{name: (type, initial value or None)}"""
        found = {}
        while not self.tokens.accept(end):
            name = self.tokens.name()
            if name in found:
                self.tokens.fault(f"{name} is declared twice")
            self.tokens.expect(":")
            kind, initial = self.type_name(), None
            if self.tokens.accept(":="):
                initial = self.initial(kind)
            self.tokens.expect(";")
            found[name] = (kind, initial)
        return found

    def initial(self, kind):
        if self.tokens.accept("["):
            values = []
            while True:
                values.append(self.initial(self.types[kind][3]))
                if self.tokens.expect(",", "]") == "]":
                    return values
        text = self.tokens.next()
        if kind == "BOOL":
            return {"TRUE": True, "FALSE": False}[text]
        self.same(literal(text).kind, kind)
        return number(text)

    def unit(self, kind):
        unit = Unit(kind, self.tokens.name(), None)
        if kind == "FUNCTION":
            self.tokens.expect(":")
            unit.result = self.type_name()
            unit.variables[unit.name] = ("RESULT", unit.result, None)
        while self.tokens.peek() in ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR"):
            section = self.tokens.next()
            if self.tokens.accept("CONSTANT"):
                unit.constants |= {name: constant(*row) for name, row in self.variables().items()}
                continue
            for name, (type_name, initial) in self.variables().items():
                unit.variables[name] = (section, type_name, initial)
        self.current = unit
        self.block({f"END_{kind}"}, 1)
        self.tokens.next()
        self.units[unit.name] = unit

    # Statements

    def emit(self, depth, python, c):
        self.current.lines.append("    " * depth + python)
        self.current.c_lines.append("  " * depth + c)

    def close(self, depth):
        self.current.c_lines.append("  " * depth + "}")

    def block(self, ends, depth):
        begun = len(self.current.lines)
        while self.tokens.peek() not in ends:
            self.statement(depth)
        if len(self.current.lines) == begun:
            self.emit(depth, "pass", ";")

    def statement(self, depth):
        start = {"IF": self.if_statement, "FOR": self.for_statement, "CASE": self.case_statement}
        if self.tokens.peek() in start:
            return start[self.tokens.next()](depth)
        if self.tokens.peek() in KEYWORDS:
            self.tokens.fault(f"{self.tokens.peek()} begins no statement")
        target = self.variable()
        if self.tokens.accept("("):
            self.block_call(depth, target)
        else:
            self.tokens.expect(":=")
            value = self.expression()
            self.same(value.kind, target.kind)
            self.emit(depth, f"run.assign({self.place(target)}, {value.python}, '{target.kind}')",
                      f"{target.c} = {value.c};")
        self.tokens.expect(";")
        return None

    def block_call(self, depth, target):
        if target.kind == "TON":
            inputs = {"IN": ("VAR_INPUT", "BOOL", None), "PT": ("VAR_INPUT", "TIME", None)}
            given = self.arguments(inputs, "TON")
            c = f"TON_body(&{target.c}, {given['IN'].c}, {given['PT'].c});"
        else:
            inputs = self.units[target.kind].variables
            given = self.arguments(inputs, target.kind)
            c = "".join(f"{target.c}.{name} = {'&' if inputs[name][0] == 'VAR_IN_OUT' else ''}{value.c}; "
                        for name, value in given.items()) + f"{target.kind}_body(&{target.c});"
        python = ", ".join(f"{name}={value.python}" for name, value in given.items())
        self.emit(depth, f"run.call({target.python}, {python})", c)

    def place(self, target):
        """owner, key of "v['a'].b[3]"."""
        head, key = re.fullmatch(r"(.*)\[([^\[\]]*|'[^']*'|v\['\w+'\])\]", target.python).groups()
        return f"{head}, {key}"

    def condition(self):
        text = self.expression()
        self.same(text.kind, "BOOL")
        return text

    def if_statement(self, depth):
        word = ("if", "if")
        while True:
            text = self.condition()
            self.emit(depth, f"{word[0]} {text.python}:", f"{word[1]} ({text.c}) {{")
            self.tokens.expect("THEN")
            self.block({"ELSIF", "ELSE", "END_IF"}, depth + 1)
            self.close(depth)
            if not self.tokens.accept("ELSIF"):
                break
            word = ("elif", "else if")
        self.else_block(depth, "END_IF")

    def else_block(self, depth, end):
        if self.tokens.accept("ELSE"):
            self.emit(depth, "else:", "else {")
            self.block({end}, depth + 1)
            self.close(depth)
        self.tokens.expect(end)
        self.tokens.expect(";")

    def for_statement(self, depth):
        counter = self.variable()
        self.tokens.expect(":=")
        first = self.expression()
        self.tokens.expect("TO")
        last = self.expression()
        for text in (counter, first, last):
            self.same(text.kind, "DINT")
        self.emit(depth, f"for {counter.python} in range({first.python}, {last.python} + 1):",
                  f"for ({counter.c} = {first.c}; {counter.c} <= {last.c}; ++{counter.c}) {{")
        self.tokens.expect("DO")
        self.block({"END_FOR"}, depth + 1)
        self.close(depth)
        self.tokens.expect("END_FOR")
        self.tokens.expect(";")

    def case_statement(self, depth):
        selector, word = self.expression(), ("if", "if")
        self.tokens.expect("OF")
        while self.tokens.kind() == "number":
            value = literal(self.tokens.next())
            self.same(value.kind, selector.kind)
            self.emit(depth, f"{word[0]} {selector.python} == {value.python}:",
                      f"{word[1]} ({selector.c} == {value.c}) {{")
            self.tokens.expect(":")
            self.statement(depth + 1)
            self.close(depth)
            word = ("elif", "else if")
        self.else_block(depth, "END_CASE")

    # Expressions

    def same(self, one, other):
        """The kind of both, or a fault."""
        if one == other:
            return one
        for literal_kind, kind in ((one, other), (other, one)):
            if literal_kind == "INT" and kind in ("DINT", "UDINT"):
                return kind
        return self.tokens.fault(f"{one} and {other} are mixed")

    def expression(self, level=0):
        if level == len(PRECEDENCE):
            return self.operand()
        text = self.expression(level + 1)
        while self.tokens.peek() in PRECEDENCE[level]:
            text = self.binary(text, self.tokens.next(), self.expression(level + 1))
        return text

    def binary(self, left, operator, right):
        kind = self.same(left.kind, right.kind)
        if kind == "INT":
            kind = "DINT"
        if kind not in TAKES[operator]:
            self.tokens.fault(f"{operator} takes no {kind}")
        python = f"({left.python} {PYTHON.get(operator, operator)} {right.python})"
        if operator in ("/", "MOD"):
            python = f"run.{'divide' if operator == '/' else 'rest'}({left.python}, {right.python})"
        c = f"({left.c} {C.get(operator, operator)} {right.c})"
        return Text("BOOL" if operator in COMPARES else kind, python, c)

    def operand(self):
        if self.tokens.accept("NOT"):
            text = self.operand()
            if text.kind not in ("BOOL", "DWORD"):
                self.tokens.fault(f"NOT takes no {text.kind}")
            return Text(text.kind, f"run.invert({text.python})", f"({'!' if text.kind == 'BOOL' else '~'}{text.c})")
        if self.tokens.accept("("):
            text = self.expression()
            self.tokens.expect(")")
            return text
        if self.tokens.kind() in ("number", "time"):
            return literal(self.tokens.next())
        if self.tokens.peek() in ("TRUE", "FALSE"):
            word = self.tokens.next()
            return Text("BOOL", word.capitalize(), str(int(word == "TRUE")))
        name = self.tokens.peek()
        if name in self.units and self.units[name].kind == "FUNCTION" and name != self.current.name:
            return self.function_call(self.units[self.tokens.next()])
        if name in STANDARD:
            return self.standard_call(self.tokens.next())
        return self.variable()

    def standard_call(self, name):
        kinds, result, c = STANDARD[name]
        self.tokens.expect("(")
        given = []
        for kind in kinds:
            given.append(self.expression())
            self.same(given[-1].kind, kind)
            self.tokens.expect(")" if len(given) == len(kinds) else ",")
        return Text(result, f"run.{name}({', '.join(text.python for text in given)})",
                    c.format(*(text.c for text in given)))

    def function_call(self, called):
        self.tokens.expect("(")
        given = self.arguments(called.variables, called.name)
        rows = {name: row for name, row in called.variables.items() if row[0] in ("VAR_INPUT", "VAR_IN_OUT")}
        if set(rows) != set(given):
            self.tokens.fault(f"{called.name} takes {', '.join(rows)}")
        python = ", ".join(f"{name}={value.python}" for name, value in given.items())
        c = ", ".join(("&" if row[0] == "VAR_IN_OUT" else "") + given[name].c for name, row in rows.items())
        return Text(called.result, f"run.function('{called.name}', {python})", f"{called.name}_call({c})")

    def arguments(self, inputs, called):
        given = {}
        while True:
            name = self.tokens.name()
            if inputs.get(name, ("",))[0] not in ("VAR_INPUT", "VAR_IN_OUT"):
                self.tokens.fault(f"{called}: {name} is no input")
            self.tokens.expect(":=")
            section = self.current.variables.get(self.tokens.peek(), ("",))[0]
            if inputs[name][0] == "VAR_IN_OUT" and section == "VAR_INPUT":
                self.tokens.fault(f"{self.tokens.peek()} is an input, {called} may write to it")
            given[name] = self.expression()
            self.same(given[name].kind, inputs[name][1])
            if self.tokens.expect(",", ")") == ")":
                return given

    def variable(self):
        name = self.tokens.name()
        if name in self.current.constants:
            return self.current.constants[name]
        if name not in self.current.variables:
            self.tokens.fault(f"{name} is not declared")
        section, kind, _ = self.current.variables[name]
        python, c = f"v['{name}']", f"(*v->{name})" if section == "VAR_IN_OUT" else f"v->{name}"
        while self.tokens.peek() in (".", "["):
            if self.tokens.next() == ".":
                member = self.tokens.name()
                kind = self.member_type(kind, member)
                python, c = f"{python}['{member}']", f"{c}.{member}"
            else:
                if self.types.get(kind, "?")[0] != "ARRAY":
                    self.tokens.fault(f"{kind} is no array")
                index = self.expression()
                self.same(index.kind, "DINT")
                python, c = f"{python}[{index.python}]", f"{c}.at[{index.c}]"
                self.tokens.expect("]")
                kind = self.types[kind][3]
        return Text(kind, python, c)

    def member_type(self, kind, member):
        members = {"Q": "BOOL", "ET": "TIME"} if kind == "TON" else {}
        if kind in self.types and self.types[kind][0] == "STRUCT":
            members = {key: row[0] for key, row in self.types[kind][1].items()}
        elif kind in self.units:
            members = {key: row[1] for key, row in self.units[kind].variables.items() if row[0] != "VAR"}
        if member not in members:
            self.tokens.fault(f"{kind} has no {member}")
        return members[member]
