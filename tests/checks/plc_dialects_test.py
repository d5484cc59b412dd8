#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""FB_PoseWall.xml and FB_PoseWall.scl against the plain text, which is the one that runs in the checks: the same units,
variables, start values and statements. Of the XML also the order of elements and the attributes that the PLCopen schema
(TC6, version 2.01) asks for, as far as this file uses them; the schema itself may not be copied here.

usage: plc_dialects_test.py ROOT"""

import pathlib
import re
import sys
import unittest
import xml.etree.ElementTree as tree

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT = pathlib.Path(sys.argv.pop(1))
sys.path.insert(0, str(pathlib.Path(__file__).parent))

import structured_text  # noqa: E402  pylint: disable=wrong-import-position

PLAIN, XML, SCL = (ROOT / f"tools/apps/plc/FB_PoseWall.{ending}" for ending in ("st", "xml", "scl"))
PROGRAM = structured_text.Program(PLAIN.read_text(encoding="utf-8"))
TC6 = "{http://www.plcopen.org/xml/tc6_0201}"
XHTML = "{http://www.w3.org/1999/xhtml}xhtml"
# Element: what may stand in it, in this order
ORDER = {
    "project": "fileHeader contentHeader types instances", "contentHeader": "coordinateInfo",
    "coordinateInfo": "fbd ld sfc", "fbd": "scaling", "ld": "scaling", "sfc": "scaling",
    "types": "dataTypes pous", "dataTypes": "dataType*", "dataType": "baseType initialValue documentation",
    "pous": "pou*", "pou": "interface body", "body": "ST", "instances": "configurations",
    "interface": "returnType inputVars|outputVars|inOutVars|localVars* documentation", "struct": "variable*",
    "array": "dimension baseType", "variable": "type initialValue documentation",
    "inputVars": "variable*", "outputVars": "variable*", "inOutVars": "variable*", "localVars": "variable*",
    "initialValue": "simpleValue arrayValue", "arrayValue": "value*", "value": "simpleValue",
}
NEEDED = {"fileHeader": {"companyName", "productName", "productVersion", "creationDateTime"}, "contentHeader": {"name"},
          "dataType": {"name"}, "pou": {"name", "pouType"}, "variable": {"name"}, "derived": {"name"},
          "dimension": {"lower", "upper"}, "scaling": {"x", "y"}, "simpleValue": {"value"}}
KINDS = ("type", "baseType", "returnType")
SECTIONS = {"inputVars": "VAR_INPUT", "outputVars": "VAR_OUTPUT", "inOutVars": "VAR_IN_OUT", "localVars": "VAR"}


def tag(element):
    return element.tag.removeprefix(TC6)


def words(text):
    """The tokens without comments."""
    return [row[1] for row in structured_text.Tokens(text).all]


def kind_of(element):
    return element[0].get("name") or tag(element[0])


def plain_bodies():
    """{name: text between the last END_VAR and the end}"""
    units = re.findall(r"^(FUNCTION|FUNCTION_BLOCK) (\w+).*?\n(.*?)^END_\1$", PLAIN.read_text(encoding="utf-8"),
                       re.S | re.M)
    return {name: text.rsplit("\nEND_VAR\n", 1)[1] for _, name, text in units}


class Xml(unittest.TestCase):
    def setUp(self):
        self.root = tree.parse(XML).getroot()

    def test_order_of_elements(self):
        self.assertEqual(self.root.tag, TC6 + "project")
        for element in self.root.iter():
            name = tag(element)
            self.assertLessEqual(NEEDED.get(name, set()), set(element.keys()), name)
            found = " ".join(tag(child) for child in element) + " "
            if name in ("ST", "documentation"):
                self.assertEqual(found, XHTML + " ")
            elif name in KINDS:
                self.assertEqual(len(element), 1)
            elif name in ORDER:
                pattern = "".join(f"(({word[:-1]}) )*" if word.endswith("*") else f"({word} )?"
                                  for word in ORDER[name].split())
                self.assertRegex(found if found != " " else "", f"^{pattern}$", name)
            else:
                self.assertEqual(found, " ", f"{name} holds nothing")

    def value(self, element, kind):
        """As structured_text reads it; None where there is none."""
        given = element.find(f"{TC6}initialValue")
        if given is None:
            return None
        texts = [value.get("value") for value in given.iter(f"{TC6}simpleValue")]
        if kind == "BOOL":
            return texts[0] == "TRUE"
        numbers = [structured_text.number(text) for text in texts]
        return numbers if given[0].tag == f"{TC6}arrayValue" else numbers[0]

    def rows(self, element):
        return {row.get("name"): (kind_of(row[0]), self.value(row, kind_of(row[0]))) for row in element}

    def test_types(self):
        found = {}
        for item in self.root.iter(f"{TC6}dataType"):
            base = item.find(f"{TC6}baseType")[0]
            if tag(base) == "struct":
                found[item.get("name")] = ("STRUCT", self.rows(base))
            else:
                bounds = [int(base[0].get(name)) for name in ("lower", "upper")]
                found[item.get("name")] = ("ARRAY", *bounds, kind_of(base[1]))
        self.assertEqual(found, PROGRAM.types)

    def test_units(self):
        bodies = plain_bodies()
        pous = {pou.get("name"): pou for pou in self.root.iter(f"{TC6}pou")}
        self.assertEqual(set(pous), set(PROGRAM.units))
        for name, unit in PROGRAM.units.items():
            found, constants = {}, {}
            for section in pous[name].find(f"{TC6}interface"):
                if tag(section) == "returnType":
                    found[name] = ("RESULT", kind_of(section), None)
                elif section.get("constant") == "true":
                    constants = self.rows(section)
                elif tag(section) in SECTIONS:
                    found |= {key: (SECTIONS[tag(section)], *row) for key, row in self.rows(section).items()}
            self.assertEqual(found, unit.variables)
            self.assertEqual({key: structured_text.constant(*row) for key, row in constants.items()}, unit.constants)
            self.assertEqual(words(pous[name].find(f".//{TC6}ST/{XHTML}").text), words(bodies[name]), name)
            self.assertEqual(pous[name].get("pouType"), "function" if unit.kind == "FUNCTION" else "functionBlock")


class Scl(unittest.TestCase):
    def setUp(self):
        self.text = SCL.read_text(encoding="utf-8")

    def units(self):
        rows = re.findall(r'^(FUNCTION|FUNCTION_BLOCK) "(\w+)"(.*?)^END_\1$', self.text, re.S | re.M)
        return {name: text.split("\nBEGIN\n") for _, name, text in rows}

    def test_statements(self):
        units = self.units()
        for name, body in plain_bodies().items():
            back = re.sub(r'"(\w+)"', r"\1", units[name][1].replace("#", "@"))
            back = re.sub(r"(16|T|DINT)@", r"\1#", back).replace("@", "")
            back = re.sub(r"(SH[LR])\(IN := (.*?), N := ", r"\1(\2, ", back)
            self.assertEqual(words(back), words(body), name)

    def test_every_local_name_has_its_sign_and_no_other(self):
        for name, (_, body) in self.units().items():
            unit = PROGRAM.units[name]
            body = re.sub(r"\(\*.*?\*\)", "", body, flags=re.S)
            for local in [*unit.variables, *unit.constants]:
                for match in re.finditer(rf'(.)\b{local}\b(\s*:=)?', body):
                    parameter = match.group(2) and match.group(1) in "( "
                    self.assertTrue(match.group(1) in "#." or parameter, f"{name}: {match.group()}")
            for sign in re.findall(r"(?<!16)(?<!T)#(\w+)", body):
                self.assertIn(sign, [*unit.variables, *unit.constants], name)
            for block in re.findall(r'"(\w+)"', body):
                self.assertEqual(PROGRAM.units[block].kind, "FUNCTION")

    def test_declarations(self):
        for name, (head, _) in self.units().items():
            unit = PROGRAM.units[name]
            order = re.findall(r"^VAR\w*(?: CONSTANT)?$", head, re.M)
            self.assertEqual(order, [section for section in ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR", "VAR_TEMP",
                                                             "VAR CONSTANT") if section in order])
            self.assertNotIn("VAR_TEMP" if unit.kind == "FUNCTION_BLOCK" else "VAR", order)
            declared = re.findall(r"^  (\w+) : ", head, re.M)
            self.assertEqual(sorted(declared), sorted(set([*unit.variables, *unit.constants]) - {
                name if unit.kind == "FUNCTION" else ""}))


if __name__ == "__main__":
    unittest.main()
