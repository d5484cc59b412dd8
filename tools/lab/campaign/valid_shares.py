#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Prints valid_shares.def from the frames of campaigns, the runs of all folders together.

Share: valid values of the values that have a truth, rounded down. Spread: standard deviation of the runs' shares, as if
one run more had been off by a half, rounded up. A run counts once because its frames share their rock. First frames of
runs are left out, as on the card.

usage: valid_shares.py DIR... > valid_shares.def"""

import collections
import csv
import json
import math
import pathlib
import sys

GROUPS = {"roll": ["roll"], "pitch": ["pitch"], "yaw": ["yaw"], "distances": ["d_lf", "d_lb", "d_rf", "d_rb"]}
OFF_BY = 0.5


def share_and_spread(runs):
    """Of one class and quantity; runs: values with a truth and valid values of each."""
    runs = [run for run in runs if run[0] > 0]
    if not runs:
        return 0.0, 1.0
    share = sum(valid for _, valid in runs) / sum(values for values, _ in runs)
    squares = sum((valid / values - share) ** 2 for values, valid in runs)
    return share, math.sqrt((squares + OFF_BY**2) / len(runs))


def classes_of(folders):
    """By scene and sensor, quantity and run: the number of values with a truth, and of valid ones among them."""
    classes = collections.defaultdict(lambda: {name: collections.defaultdict(lambda: [0, 0]) for name in GROUPS})
    for folder in folders:
        with open(folder / "frames.csv", encoding="ascii") as file:
            for row in csv.DictReader(file):
                if row["phase"] == "first":
                    continue
                one = classes[row["scene"], row["sensor"]]
                for group, names in GROUPS.items():
                    for name in names:
                        if row[name + "_truth"]:
                            run = one[group][folder, row["draw"]]
                            run[0] += 1
                            run[1] += row[name + "_state"] == "valid"
    return classes


def main(folders):
    campaigns = [json.loads((folder / "campaign.json").read_text()) for folder in folders]
    for folder, one in zip(folders, campaigns):
        if one["request"].get("drive_in_m", 0.0) > 0.0:
            sys.exit(f"{folder}: measured with --drive-in; floors are of engines that begin with the scene")
        if one["request"].get("scans") != "turning" or one["engine"].get("motion") != "on":
            sys.exit(f"{folder}: measured without scans that take time or without motion; floors are of both")
    classes = classes_of(folders)
    kinds = {(one["scene"], one["sensor"]): one["kind"]
             for folder in folders for one in json.loads((folder / "card.json").read_text())["classes"]}
    print("// SPDX-License-Identifier: BSD-3-Clause\n// Copyright (c) 2026 the pose_wall authors\n")
    print("// Valid share and its spread between runs, in percent: roll, pitch, yaw, distances. The floors of the\n"
          "// gate follow from them (valid_floors.hpp). Made by valid_shares.py; measured by:")
    for one in campaigns:
        identity = one["identity"]
        print(f'//   {one["command"]}, version {identity["version"]}, program {identity["program"]}')
    print()
    for (scene, sensor), one in classes.items():
        if kinds[scene, sensor] == "unobservable":
            continue
        cells = []
        for group in GROUPS:
            share, spread = share_and_spread(list(one[group].values()))
            cells.append(f"{math.floor(100 * share + 1e-9)}, {math.ceil(100 * spread - 1e-9)}")
        print(f'VALID_SHARES("{scene}", "{sensor}", {",  ".join(cells)})')


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__.splitlines()[-1])
    main([pathlib.Path(name) for name in sys.argv[1:]])
