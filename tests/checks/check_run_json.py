#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Lines of `pose_wall run --format json` are JSON by the strict rules (no NaN), each with the same members, and say
what the CSV of the same frames says.

usage: check_run_json.py POSE_WALL"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile


def refuse(word):
    raise ValueError(f"{word} is no JSON")


def cell(value):
    return "" if value is None else f"{value:.9g}" if isinstance(value, float) else str(value)


def members(value, path=""):
    """Paths of all members; what is null below a member is not looked into."""
    if not isinstance(value, dict):
        return {path}
    return {inner for name in value for inner in members(value[name], f"{path}/{name}")}


def main():
    command = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        subprocess.run([command, "sim", "--scene", "props", "--sensor", "vlp16", "-n", "3", "-q", "-o", folder],
                       check=True)
        (folder / "frames" / "000001b.pcd").write_text("no cloud")
        rows = {}
        for kind in ("csv", "json"):
            ran = subprocess.run([command, "run", "-q", "--parts", "-c", folder / "pose_wall.yaml", "--format", kind,
                                  folder / "frames"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            if ran.returncode != 1 or "000001b.pcd" not in ran.stderr:
                sys.exit(f"{kind}: exit status {ran.returncode}, said: {ran.stderr}")
            rows[kind] = ran.stdout.splitlines()
    lines = [json.loads(line, parse_constant=refuse) for line in rows["json"]]
    table = list(csv.DictReader(rows["csv"]))
    if len(lines) != 4 or len(table) != 4:
        sys.exit(f"{len(lines)} lines and {len(table)} rows of 4 frames")
    faults = []
    for line, row in zip(lines, table):
        said = [("schema", line["schema"], "1"), ("status", line["status"], row["status"]),
                ("stamp_ns", line["stamp_ns"], row["stamp_ns"]), ("source", line["source"], row["source"]),
                ("reasons", "|".join(line["reasons"]), row["reason"]),
                ("error", line["error"], row["error"])]
        for name, value in (line["values"] or {}).items():
            unit = "_m" if name.startswith("d_") else "_rad"
            said += [(name, value["value" + unit], row[name]), (name, value["raw" + unit], row[name + "_raw"]),
                     (name, value["protection_level" + unit], row[name + "_pl"]),
                     (name, value["raw_protection_level" + unit], row[name + "_raw_pl"]),
                     (name, value["raw_state"], row[name + "_raw_state"]), (name, value["cause"], row[name + "_cause"]),
                     (name, value["state"], row[name + "_state"])]
            parts = value["protection_level_parts" + unit]
            said += [(f"{name} {part}", amount, row[f"{name}_pl_{part}"]) for part, amount in parts.items()]
        faults += [f"frame {line['frame']}: {name} is {value!r}, in the CSV {text!r}" for name, value, text in said
                   if cell(value) != text]
    shapes = {frozenset(members(line)) for line in lines if line["values"]}
    if len(shapes) != 1 or len({tuple(line) for line in lines}) != 1:
        faults.append("lines have different members")
    print("\n".join(faults) or "4 lines say what 4 rows say")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
