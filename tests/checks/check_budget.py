#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""check_budget.py PROGRAM [EMULATOR...]: pose_wall_budget, as somebody at a controller uses it. What it measures means
nothing here, where others share the processor, or it is emulated: only that it measures, and what it says."""

import re
import subprocess
import sys

VERDICT = r" +(fits|tight|too slow), (\d+) % of it"
ROW = re.compile(r"^(\S+) +(\d+) +(\d+) +([\d.]+) ms +([\d.]+) ms +([\d.]+) ms" + VERDICT + VERDICT)
SENSORS = ["vlp16", "mid360", "os1-64", "os0-128"]
REFUSED = [  # words, and what the complaint must hold
    (["--frames"], ["--frames", "from 1 to 100000", "''"]),
    (["--frames", "0"], ["from 1 to 100000", "'0'"]),
    (["--frames", "12x"], ["from 1 to 100000", "'12x'"]),
    (["--frmaes", "3"], ["'--frmaes'", "did you mean '--frames'"]),
    (["os1-46"], ["'os1-46'", "did you mean 'os1-64'", "vlp16"]),
    (["--frames", "1", "vlp16", "nothing"], ["'nothing'", "mid360"]),
]


def run(program, words):
    done = subprocess.run(program + words, capture_output=True, text=True, timeout=100)
    return done.returncode, done.stdout, done.stderr


def faults_of_help(program):
    status, out, _ = run(program, ["--help"])
    if status != 0:
        yield f"--help ends with {status}"
    for word in ["usage", "--frames", "Exit status"] + SENSORS:
        if word not in out:
            yield f"--help does not say '{word}'"


def faults_of_refusals(program):
    for words, expected in REFUSED:
        status, out, said = run(program, words)
        if status != 2 or out:
            yield f"{words}: status {status}, printed '{out}'; 2 and nothing were expected"
        for part in expected:
            if part not in said:
                yield f"{words}: the complaint is '{said.strip()}', without {part}"


def verdict_of(percent):
    return "fits" if percent <= 70.0 else "tight" if percent <= 100.0 else "too slow"


def faults_of_table(program):
    status, out, said = run(program, ["--frames", "2", "vlp16", "mid360"])
    rows = [m for m in map(ROW.match, out.splitlines()) if m]
    if [m[1] for m in rows] != ["vlp16", "mid360"]:
        yield f"no row for each sensor that was asked for:\n{out}{said}"
        return
    worst_ms = [float(m[6]) for m in rows]
    for m in rows:
        if not 0.0 < float(m[4]) <= float(m[5]) <= float(m[6]) or int(m[2]) < int(m[3]):
            yield f"what is said of {m[1]} cannot be: {m[0]}"
        for verdict, percent, period_ms in [(m[7], float(m[8]), 100.0), (m[9], float(m[10]), 50.0)]:
            if abs(percent - 100.0 * float(m[6]) / period_ms) > 0.7:  # both are rounded
                yield f"{m[1]}: {percent} % of {period_ms} ms are not {m[6]} ms"
            if abs(percent - 70.0) > 1.0 and abs(percent - 100.0) > 1.0 and verdict != verdict_of(percent):
                yield f"{m[1]}: {percent} % is said to be '{verdict}'"
    if status != (0 if max(worst_ms) <= 100.0 else 1):
        yield f"the worst frames take {worst_ms} ms, and the status is {status}"


def main():
    program = sys.argv[2:] + sys.argv[1:2]
    faults = [f for check in (faults_of_help, faults_of_refusals, faults_of_table) for f in check(program)]
    print("\n".join(faults) or f"{sys.argv[1]}: help, refusals and a table, as they should be")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
