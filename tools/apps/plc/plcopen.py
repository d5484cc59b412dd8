# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The function blocks as PLCopen XML (TC6, version 2.01), which CODESYS and TwinCAT import."""

from xml.sax.saxutils import escape, quoteattr

NAMESPACE = "http://www.plcopen.org/xml/tc6_0201"
XHTML = "http://www.w3.org/1999/xhtml"
# Any other would change the file whenever it is written.
WRITTEN = "2026-01-01T00:00:00"
ELEMENTARY = ("BOOL", "DINT", "UDINT", "WORD", "DWORD", "TIME")
SECTION = {"VAR_INPUT": "inputVars", "VAR_OUTPUT": "outputVars", "VAR_IN_OUT": "inOutVars", "VAR": "localVars"}
POU = {"FUNCTION": "function", "FUNCTION_BLOCK": "functionBlock"}


def kind_of(kind):
    return f"<{kind}/>" if kind in ELEMENTARY else f'<derived name="{kind}"/>'


def initial(value):
    if value is None:
        return ""
    if value.startswith("["):
        values = "".join(f"<value><simpleValue value={quoteattr(item.strip())}/></value>"
                         for item in value[1:-1].split(","))
        return f"<initialValue><arrayValue>{values}</arrayValue></initialValue>"
    return f"<initialValue><simpleValue value={quoteattr(value)}/></initialValue>"


def documentation(comment):
    text = (comment or "").removeprefix("(*").removesuffix("*)").strip()
    return f'<documentation><xhtml xmlns="{XHTML}">{escape(text)}</xhtml></documentation>' if text else ""


def variable(row):
    return (f"          <variable name={quoteattr(row.name)}><type>{kind_of(row.type)}</type>{initial(row.initial)}"
            f"{documentation(row.comment)}</variable>\n")


def data_type(item):
    if item.members is None:
        base = f'<array><dimension lower="0" upper="{item.last}"/><baseType>{kind_of(item.type)}</baseType></array>'
    else:
        base = "<struct>\n" + "".join(map(variable, item.members)) + "        </struct>"
    return (f"      <dataType name={quoteattr(item.name)}>\n        <baseType>{base}</baseType>"
            f"{documentation(item.comment)}\n      </dataType>\n")


def section(name, rows, attribute=""):
    return f"        <{name}{attribute}>\n{''.join(map(variable, rows))}        </{name}>\n" if rows else ""


def pou(unit):
    result = f"        <returnType>{kind_of(unit.result)}</returnType>\n" if unit.result else ""
    sections = "".join(section(SECTION[name], rows) for name, rows in unit.variables.items())
    sections += section("localVars", unit.constants, ' constant="true"')
    return (f'      <pou name="{unit.name}" pouType="{POU[unit.kind]}">\n      <interface>\n{result}{sections}'
            f"{documentation(unit.comment)}\n      </interface>\n"
            f'      <body><ST><xhtml xmlns="{XHTML}">{escape(unit.body)}\n</xhtml></ST></body>\n      </pou>\n')


def scaling():
    return "".join(f'<{name}><scaling x="1" y="1"/></{name}>' for name in ("fbd", "ld", "sfc"))


def xml(read, note):
    return (f'<?xml version="1.0" encoding="utf-8"?>\n<!-- SPDX-License-Identifier: BSD-3-Clause -->\n'
            f'<!-- Copyright (c) 2026 the pose_wall authors -->\n<!-- {note} -->\n<project xmlns="{NAMESPACE}">\n'
            f'  <fileHeader companyName="pose_wall" productName="pose_wall" productVersion="1" '
            f'creationDateTime="{WRITTEN}"/>\n'
            f'  <contentHeader name="pose_wall"><coordinateInfo>{scaling()}</coordinateInfo></contentHeader>\n'
            f"  <types>\n    <dataTypes>\n{''.join(map(data_type, read.types.values()))}    </dataTypes>\n"
            f"    <pous>\n{''.join(map(pou, read.units.values()))}    </pous>\n  </types>\n"
            "  <instances><configurations/></instances>\n</project>\n")
