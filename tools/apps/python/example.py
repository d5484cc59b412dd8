#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Runs PCD files through pose_wall, prints a table, and plots the run.

usage: example.py [--config pose_wall.yaml] [--set KEY=VALUE]... [--plot run.png] [FILE_OR_FOLDER...]

Without files it has the command `pose_wall`, where that is on PATH, simulate a road."""

import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

import numpy as np

import pose_wall

DEGREES = ("roll", "pitch", "yaw")


def simulated_road(folder):
    """Gives the frames and the settings that fit them."""
    command = shutil.which("pose_wall")
    if command is None:
        sys.exit("Nothing to run: name PCD files, or put the command `pose_wall` onto PATH (package pose-wall), which "
                 "then simulates a road.")
    subprocess.run([command, "sim", "--quiet", "--scene", "nominal", "--frames", "40", "--set", "speed_mps=0.3",
                    "--output", folder], check=True)
    return [folder / "frames"], folder / "pose_wall.yaml"


def run(inputs, config):
    """One result per frame, and the points of the last."""
    engine = pose_wall.Engine(config)
    results = []
    for frame in pose_wall.read_frames(inputs):
        results.append(engine.process(frame.points, stamp_ns=frame.stamp_ns))
    return results, engine.last_points()


def series(results, name, member):
    """One number per frame, in degrees or metres."""
    numbers = np.array([getattr(result[name], member) for result in results])
    return np.degrees(numbers) if name in DEGREES else numbers


def print_table(results):
    print(f"{len(results)} frames, {np.median([result.engine_ns for result in results]) / 1e6:.1f} ms each (median)\n")
    print(f"{'':6} {'last':>9} {'+- level':>9}  {'valid':>6}  state and reasons of the last")
    for name in pose_wall.QUANTITIES:
        unit = "deg" if name in DEGREES else "m"
        last = results[-1][name]
        valid = np.mean([result[name].is_valid for result in results])
        words = ", ".join([last.state.name.lower(), *pose_wall.reason_names(last.reasons)])
        print(f"{name:6} {series(results, name, 'value')[-1]:9.3f} "
              f"{series(results, name, 'protection_level')[-1]:9.3f}  {valid:6.0%}  {words}  [{unit}]")


def plot(results, points, file):
    """The seven values with their levels, and the last frame from above."""
    try:
        import matplotlib
    except ImportError:
        print("\nNo plot: matplotlib is missing. apt install python3-matplotlib (or pip install matplotlib)")
        return
    matplotlib.use("Agg")
    from matplotlib import pyplot
    seconds = np.array([result.stamp_ns - results[0].stamp_ns for result in results]) * 1e-9
    figure, axes = pyplot.subplots(3, 1, figsize=(10, 11), layout="constrained")
    for axis, names, unit in ((axes[0], DEGREES, "deg"), (axes[1], pose_wall.QUANTITIES[3:], "m")):
        for name in names:
            value, level = series(results, name, "value"), series(results, name, "protection_level")
            line, = axis.plot(seconds, value, ".-", label=name)
            axis.fill_between(seconds, value - level, value + level, color=line.get_color(), alpha=0.15, linewidth=0)
        axis.set(xlabel="s", ylabel=f"{unit}; band: protection level")
        axis.legend(loc="upper right", ncols=4)
    for label in pose_wall.Label:
        x, y, _ = points.xyz_base_m[points.label == label].T
        axes[2].plot(x, y, ".", markersize=1, label=label.name.lower())
    axes[2].set(xlabel="x of base, m", ylabel="y of base, m", aspect="equal", title="the last frame from above")
    axes[2].legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), markerscale=8)
    figure.savefig(file, dpi=110)
    print(f"\nplotted to {file}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("inputs", nargs="*", type=pathlib.Path, metavar="FILE_OR_FOLDER")
    parser.add_argument("--config", type=pathlib.Path, help="a pose_wall.yaml")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE",
                        help="after the file; may be repeated")
    parser.add_argument("--plot", type=pathlib.Path, default=pathlib.Path("run.png"), help="default: run.png")
    given = parser.parse_args()
    settings = dict(setting.partition("=")[::2] for setting in given.set)
    with tempfile.TemporaryDirectory() as folder:
        inputs, config = given.inputs, given.config
        if not inputs:
            inputs, simulated = simulated_road(pathlib.Path(folder))
            config = config or simulated
        try:
            results, points = run(inputs, pose_wall.Config.load(config, set=settings))
        except (OSError, ValueError, pose_wall.Error) as error:
            sys.exit(f"example.py: {error}")
    print_table(results)
    plot(results, points, given.plot)


if __name__ == "__main__":
    main()
