#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""case_table.py [--check] TESTS README: the table of the fault campaigns, from the cases that the program TESTS lists,
in README between its two marks. --check: fails where it is another."""

import re
import subprocess
import sys
import textwrap

BEGIN, END = "<!-- cases -->\n", "<!-- /cases -->\n"

# Each group's fault and its outcome. A group that is missing here, or has no cases, is an error.
GROUPS = {
    "Descriptions": ("a cloud's description is odd, or a lie that cannot be found", "read as described, nothing wrong"),
    "IntensityTypes": ("any bytes as intensity", "measured, right"),
    "PointFaults": ("points without number, range, shape or sense", "states of the table, nothing wrong, back at once"),
    "UndetectableFaults": ("axes mirrored, scaled", "measured; in a sequence degraded, the level reaches to both"),
    "Capacity": ("points_max voxels, and one more or less", "the leaf grows from one more on"),
    "Stamps": ("stamps that stand, go back, leap, or lie at the ends", "states of the table, flagged, nothing wrong"),
    "CallFaults": ("calls out of order or twice", "the outcome that the header gives"),
    "Keys": ("a text that is no value, for each key", "refused, nothing changed"),
    "Members": ("NaN written into a config past the functions", "found by the check"),
    "NumberKeys": ("numbers below and above a key's range, and at its ends", "refused; at its ends the contract holds"),
    "StageFailures": ("a step of the engine fails, once and for good", "told by others, degraded or held; never wrong"),
    "BitFlips": ("bits of the block flip between calls", "state: refused until opened again; scratch: same bits"),
    "SelfTestFaults": ("the same during the self test; a digest off by a bit", "the self test fails"),
    "PoisonedSequence": ("each frame is garbage, alone and with the next", "nothing wrong, back within 4 frames"),
    "PoisonedSequencePairs": ("two frames of two kinds, 1 to 4 good ones between", "the same"),
    "PoisonedSequenceItself": ("the same without garbage; another road each time", "all valid; nothing wrong, back"),
    "RefusedThreads": ("a thread is not made", "start fails, and works the next time"),
    "FaultyDisks": ("the header or the n-th write of the record fails", "counted, the rest can be read, frames go on"),
    "RefusedWishes": ("memory not locked, priority not granted", "reported; start fails only if it was required"),
    "RuntimeFaults": ("clock, callback, a step or the memory of its engine fails", "reported, nothing wrong, goes on"),
}


def cases_of(program):
    cases, suite = {}, None
    listed = subprocess.run([program, "--gtest_list_tests"], check=True, capture_output=True, text=True).stdout
    for line in listed.splitlines():
        name = line.split("#")[0].rstrip()
        if re.fullmatch(r"\S+\.", name):
            suite = name[:-1].split("/")[-1]
        elif line.startswith("  ") and suite:
            cases.setdefault(suite, []).append(name.strip())
    return cases


def short(names):
    """Cases of a suite with parameters by their parameter's name; how many tests look at each, behind it."""
    by_name = {}
    for name in names:
        by_name.setdefault(name.split("/")[-1], []).append(name)
    return [name + (f" ×{len(tests)}" if len(tests) > 1 else "") for name, tests in sorted(by_name.items())]


def table(cases):
    unknown, missing = set(cases) - set(GROUPS), set(GROUPS) - set(cases)
    if unknown or missing:
        sys.exit(f"case_table.py: groups without a line here: {sorted(unknown)}; without cases: {sorted(missing)}")
    out = ["| group | cases | fault | outcome |", "| --- | --- | --- | --- |"]
    for group, (fault, outcome) in GROUPS.items():
        out.append(f"| `{group}` | {len(cases[group])} | {fault} | {outcome} |")
    out.append(f"| all | {sum(len(names) for names in cases.values())} | | |")
    out += ["", "```"]
    for group in GROUPS:
        text = f"{group}: " + ", ".join(short(cases[group]))
        out += textwrap.wrap(text, 120, subsequent_indent="  ", break_on_hyphens=False)
    out.append("```")
    return "\n".join(out) + "\n"


def main(arguments):
    check = arguments[:1] == ["--check"]
    program, readme = arguments[1:] if check else arguments
    with open(readme, encoding="utf-8") as file:
        text = file.read()
    begin, end = text.index(BEGIN) + len(BEGIN), text.index(END)
    wanted = text[:begin] + "\n" + table(cases_of(program)) + "\n" + text[end:]
    if check and wanted != text:
        sys.exit(f"{readme} does not list the cases there are: run tests/faults/case_table.py {program} {readme}")
    if not check:
        with open(readme, "w", encoding="utf-8") as file:
            file.write(wanted)


main(sys.argv[1:])
