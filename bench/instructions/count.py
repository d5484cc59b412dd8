#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""AArch64 instructions of a frame, stage by stage, counted under qemu-user.

    cmake --preset arm64 -DPOSE_WALL_BUILD_BENCH=ON && cmake --build --preset arm64
    bench/instructions/count.py build/arm64            # count, show, compare with figures.csv
    bench/instructions/count.py build/arm64 --note     # and write figures.csv anew, on purpose
    bench/instructions/count.py build/arm64 --dear     # clouds that cost most, beside a road of as many points
    bench/instructions/count.py build/arm64 --growth   # how they grow with the points of a frame, and the worst frame
    bench/instructions/count.py build/arm64 --motion   # frames of the motion library, against motion_figures.csv
    bench/instructions/count.py build/arm64 --planar   # scan, match, map and stop, against planar_figures.csv
    bench/instructions/count.py build/arm64 --functions --sensors os1-64   # which functions a frame's are spent in

Fails where a stage costs more than 5 % above the noted figure, or a frame of motion more than twice the typical one.
Needs qemu-aarch64 (package qemu-user) and a C compiler.
"""

import argparse
import collections
import csv
import pathlib
import subprocess
import sys
import tempfile

SENSORS = ["vlp16", "mid360", "os1-64", "os0-128"]
FRAMES = 3
GROWTH_OF = "os0-128"
GROWTH = [5000, 16000, 32000, 65000, 131000, 260000]
STAGES = ["least", "voxels", "outliers", "floor", "band", "walls", "output"]
TOLERANCE = 0.05
# A stage below this share of its frame may grow by this share: a few instructions are no regression.
SMALL_SHARE = 0.005
# See tests/support/dear_clouds.hpp; the first is what the others are compared with.
DEAR = ["road", "equal", "sphere", "ball03", "spread", "dense", "sheets", "rough", "apart", "hash", "par27", "par304",
        "par4", "par15", "par1028", "climbed0", "climbed1"]
DEAR_POINTS = [28800, 65536, 131072]
DEAR_ROADS = 2.5
MOTION_SCENES = ["rough", "nominal"]
MOTION_FRAMES = 12
MOTION_WORST = 2.0  # typical frames
PLANAR_SCENE = "rough"
PLANAR_FRAMES = 12
PLANAR_PARTS = ["engine", "scan", "match", "map", "stop"]
STEP_LEAST, STEP_MOST = 5, 20  # instructions
HERE = pathlib.Path(__file__).resolve().parent
FIGURES = HERE / "figures.csv"
MOTION_FIGURES = HERE / "motion_figures.csv"
PLANAR_FIGURES = HERE / "planar_figures.csv"


def build_plugin(folder):
    plugin = pathlib.Path(folder) / "count_plugin.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-O2", "-o", plugin, HERE / "count_plugin.c"], check=True)
    return plugin


def run(plugin, program, words, folder, arguments=""):
    """What the program prints of each frame, and the lines the plugin writes."""
    log = pathlib.Path(folder) / "marks"
    command = ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu", "-E", "LD_LIBRARY_PATH=/usr/aarch64-linux-gnu/lib"]
    command += ["-plugin", f"{plugin}{arguments}", "-d", "plugin"]
    command += ["-D", log, program] + [str(word) for word in words]
    out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return [[int(x) for x in line.split()] for line in out.splitlines()], log.read_text().splitlines()


def count(plugin, program, sensor, folder, points=0):
    """Of one sensor: points, voxels, values measured, and instructions by stage, means over the frames."""
    frames, lines = run(plugin, program, [sensor, FRAMES, points], folder)
    marks = [int(line) for line in lines]
    per_frame = len(STAGES) + 1
    if len(frames) != FRAMES or len(marks) != FRAMES * per_frame:
        sys.exit(f"{sensor}: {len(frames)} frames, {len(marks)} marks; expected {FRAMES} and {FRAMES * per_frame}")
    row = {"sensor": sensor}
    for k, name in enumerate(["points", "least_cells", "voxel_count", "measured", "work"]):
        row[name] = round(sum(f[k] for f in frames) / FRAMES)
    for k, stage in enumerate(STAGES):
        steps = [marks[f * per_frame + k + 1] - marks[f * per_frame + k] for f in range(FRAMES)]
        row[stage] = round(sum(steps) / FRAMES)
    row["frame"] = sum(row[s] for s in STAGES if s != "least")
    return row


def print_head(columns):
    print_row(columns)
    print("| --- " * len(columns) + "|")


def print_row(cells):
    print("| " + " | ".join(str(cell) for cell in cells) + " |", flush=True)


def millions(instructions):
    return f"{instructions / 1e6:.2f} M"


def ratios(row):
    """Instructions per point, and in least passes."""
    return [f"{row['frame'] / row['points']:.0f}", f"{row['frame'] / row['least']:.1f}"]


def show(rows):
    counted = STAGES + ["frame"]
    print_head(["sensor", "points", "voxel_count", "measured"] + counted + ["per point", "x least"])
    for r in rows:
        numbers = [r["points"], r["voxel_count"], r["measured"]] + [millions(r[c]) for c in counted]
        print_row([r["sensor"]] + numbers + ratios(r))


def show_growth(plugin, program, folder):
    print_head(["frame", "points", "voxel_count", "measured", "least", "frame", "per point", "x least"])
    for name in (GROWTH_OF, "spread"):
        for points in GROWTH:
            r = count(plugin, program, name, folder, points)
            numbers = [r["points"], r["voxel_count"], r["measured"], millions(r["least"]), millions(r["frame"])]
            print_row([name] + numbers + ratios(r))


def show_dear(plugin, program, folder):
    """Instructions of clouds that cost most, in roads of as many points, and how many stand for one step of the
    engine's own count. Fails where one costs more than DEAR_ROADS roads, or steps tell too little of instructions."""
    print_head(["cloud", "points", "voxel_count", "measured", "frame", "roads", "instructions per step"])
    bad = []
    for points in DEAR_POINTS:
        road = None
        for kind in DEAR:
            r = count(plugin, program, f"dear:{kind}", folder, points)
            road = road or r["frame"]
            roads, per_step = r["frame"] / road, r["frame"] / r["work"]
            numbers = [r["points"], r["voxel_count"], r["measured"], millions(r["frame"])]
            print_row([kind] + numbers + [f"{roads:.2f}", f"{per_step:.1f}"])
            if not roads <= DEAR_ROADS:
                bad.append(f"{kind}, {points} points: {roads:.2f} roads")
            if not STEP_LEAST <= per_step <= STEP_MOST:
                bad.append(f"{kind}, {points} points: {per_step:.1f} instructions per step")
    if bad:
        sys.exit("\n".join(bad))


def show_functions(plugin, program, sensor, folder):
    """Functions by what they take of a frame, down to a hundredth."""
    _, lines = run(plugin, program, [sensor, FRAMES, 0], folder, ",functions=on")
    stages = collections.defaultdict(collections.Counter)
    of_mark = {}
    mark = 0
    for line in lines:
        if line.isdigit():
            stage = STAGES[(mark - 1) % (len(STAGES) + 1)] if mark % (len(STAGES) + 1) else None
            for name, spent in of_mark.items():
                if stage and stage != "least":
                    stages[name][stage] += spent / FRAMES
            of_mark = {}
            mark += 1
        else:
            name, spent = line.rsplit(" ", 1)
            of_mark[name] = of_mark.get(name, 0) + int(spent)
    frame = sum(counter.total() for counter in stages.values())
    ordered = sorted(stages.items(), key=lambda item: -item[1].total())
    names = subprocess.run(["c++filt"], input="\n".join(name for name, _ in ordered), check=True, capture_output=True,
                           text=True).stdout.splitlines()
    print_head([f"of {sensor}'s {millions(frame)}", "share", "function", "stages"])
    for name, (_, counter) in zip(names, ordered):
        if counter.total() < 0.01 * frame:
            break
        where = ", ".join(stage for stage, _ in counter.most_common())
        print_row([millions(counter.total()), f"{counter.total() / frame:.1%}", f"`{name}`", where])


def count_motion(plugin, program, scene, folder):
    """Of one scene: instructions of the mean, the typical and the worst frame."""
    frames, lines = run(plugin, program, [scene, MOTION_FRAMES], folder)
    marks = [int(line) for line in lines]
    if len(frames) != MOTION_FRAMES or len(marks) != 2 * MOTION_FRAMES:
        sys.exit(f"{scene}: {len(frames)} frames, {len(marks)} marks")
    costs = sorted(after - before for before, after in zip(marks[::2], marks[1::2]))
    return {"scene": scene, "points": frames[0][0], "mean": sum(costs) // len(costs),
            "typical": costs[len(costs) // 2], "worst": costs[-1]}


def motion(plugin, program, folder, note):
    rows = [count_motion(plugin, program, scene, folder) for scene in MOTION_SCENES]
    print_head(["scene", "points", "mean", "typical", "worst"])
    for r in rows:
        print_row([r["scene"], r["points"]] + [millions(r[k]) for k in ("mean", "typical", "worst")])
    if note:
        write_figures(MOTION_FIGURES, rows)
    with MOTION_FIGURES.open(newline="") as file:
        noted = {r["scene"]: int(r["mean"]) for r in csv.DictReader(file)}
    worse = [f"{r['scene']}: {millions(r['mean'])} a frame, noted are {millions(noted[r['scene']])}"
             for r in rows if r["mean"] > noted[r["scene"]] * (1 + TOLERANCE)]
    worse += [f"{r['scene']}: the worst frame is {r['worst'] / r['typical']:.2f} typical ones"
              for r in rows if r["worst"] > MOTION_WORST * r["typical"]]
    if worse:
        sys.exit("\n".join(worse))


def planar(plugin, program, folder, note):
    """Instructions of each part of the planar library, mean and worst frame."""
    frames, lines = run(plugin, program, [PLANAR_SCENE, PLANAR_FRAMES], folder)
    marks = [int(line) for line in lines]
    per_frame = len(PLANAR_PARTS) + 1
    if len(frames) != PLANAR_FRAMES or len(marks) != PLANAR_FRAMES * per_frame:
        sys.exit(f"{len(frames)} frames, {len(marks)} marks; expected {PLANAR_FRAMES} and {PLANAR_FRAMES * per_frame}")
    rows = []
    for k, part in enumerate(PLANAR_PARTS):
        costs = [marks[f * per_frame + k + 1] - marks[f * per_frame + k] for f in range(PLANAR_FRAMES)]
        rows.append({"part": part, "mean": sum(costs) // len(costs), "worst": max(costs)})
    print_head(["part", "mean", "worst"])
    for r in rows:
        print_row([r["part"], millions(r["mean"]), millions(r["worst"])])
    if note:
        write_figures(PLANAR_FIGURES, rows)
    with PLANAR_FIGURES.open(newline="") as file:
        noted = {r["part"]: int(r["mean"]) for r in csv.DictReader(file)}
    worse = [f"{r['part']}: {millions(r['mean'])} a frame, noted are {millions(noted[r['part']])}"
             for r in rows if r["mean"] > noted[r["part"]] * (1 + TOLERANCE)]
    if worse:
        sys.exit("\n".join(worse))


def write_figures(path, rows):
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def compare(rows):
    with FIGURES.open(newline="") as file:
        noted = {r["sensor"]: r for r in csv.DictReader(file)}
    worse = []
    for r in rows:
        for stage in STAGES[1:] + ["frame"]:
            before, now = int(noted[r["sensor"]][stage]), r[stage]
            allowed = before * (1 + TOLERANCE) + SMALL_SHARE * int(noted[r["sensor"]]["frame"])
            if now > allowed:
                worse.append(f"{r['sensor']} {stage}: {now / 1e6:.2f} M instructions, noted are {before / 1e6:.2f} M")
    return worse


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="folder of the arm64 build")
    parser.add_argument("--note", action="store_true", help="write figures.csv anew")
    parser.add_argument("--growth", action="store_true", help="count frames of 5,000 to 260,000 points instead")
    parser.add_argument("--dear", action="store_true", help="count clouds that cost most instead")
    parser.add_argument("--motion", action="store_true", help="count frames of the motion library instead")
    parser.add_argument("--planar", action="store_true", help="count the parts of the planar library instead")
    parser.add_argument("--functions", action="store_true", help="count by function instead, down to a hundredth")
    parser.add_argument("--sensors", default=",".join(SENSORS), help="names, separated by commas")
    options = parser.parse_args()
    counted = "motion" if options.motion else "planar" if options.planar else "frames"
    program = options.build / f"pose_wall_marked_{counted}"
    if not program.exists():
        sys.exit(f"{program} is missing: configure with -DPOSE_WALL_BUILD_BENCH=ON")
    with tempfile.TemporaryDirectory() as folder:
        plugin = build_plugin(folder)
        if options.motion:
            motion(plugin, program, folder, options.note)
            return
        if options.planar:
            planar(plugin, program, folder, options.note)
            return
        if options.growth:
            show_growth(plugin, program, folder)
            return
        if options.dear:
            show_dear(plugin, program, folder)
            return
        if options.functions:
            for sensor in options.sensors.split(","):
                show_functions(plugin, program, sensor, folder)
            return
        rows = [count(plugin, program, sensor, folder) for sensor in options.sensors.split(",")]
    show(rows)
    if options.note:
        write_figures(FIGURES, rows)
        return
    worse = compare(rows)
    for line in worse:
        print(line, file=sys.stderr)
    if worse:
        sys.exit("more than 5 % above figures.csv; where it is worth it, note the new figures with --note")


if __name__ == "__main__":
    main()
