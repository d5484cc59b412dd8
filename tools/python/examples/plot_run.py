#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Measures a folder of PCD frames and plots how the machine stood: values, protection levels, states.

usage: plot_run.py FRAMES [--config pose_wall.yaml] [--plot run.png]
       pose_wall sim --scene nominal --frames 60 --output road; plot_run.py road/frames --config road/pose_wall.yaml"""

import argparse
import math
import pathlib

import pose_wall

COLOURS = {"VALID": "tab:green", "DEGRADED": "tab:orange", "HELD": "tab:blue", "INVALID": "tab:red"}


def measure(folder, config):
    engine = pose_wall.Engine(config)
    for i, path in enumerate(sorted(pathlib.Path(folder).glob("*.pcd"))):
        yield engine.process(pose_wall.read_pcd(path), stamp_ns=i * 100_000_000)


def print_table(results):
    print(f"{'':6}{'valid':>8}{'median':>12}{'level':>12}")
    for name in pose_wall.NAMES:
        usable = [result[name] for result in results if result[name].is_usable]
        valid = sum(value.state == pose_wall.State.VALID for value in usable) / len(results)
        scale, unit = (1.0, " m") if name.startswith("d_") else (180 / math.pi, "°")
        middle = sorted(usable, key=lambda value: value.value)[len(usable) // 2] if usable else None
        numbers = [middle.value * scale, middle.protection_level * scale] if middle else []
        print(f"{name:6}{valid:8.0%}" + "".join(f"{number:10.3f}{unit:2}" for number in numbers))


def plot(results, path):
    try:
        import matplotlib  # pylint: disable=import-outside-toplevel
    except ImportError:
        raise SystemExit("a plot takes matplotlib: apt install python3-matplotlib") from None
    matplotlib.use("Agg")
    from matplotlib import pyplot  # pylint: disable=import-outside-toplevel
    figure, axes = pyplot.subplots(len(pose_wall.NAMES), 1, sharex=True, figsize=(10, 12), constrained_layout=True)
    for axis, name in zip(axes, pose_wall.NAMES):
        scale, unit = (1.0, "m") if name.startswith("d_") else (180 / math.pi, "°")
        values = [result[name] for result in results]
        middle = [value.value * scale for value in values]
        level = [value.protection_level * scale for value in values]
        axis.fill_between(range(len(values)), [m - l for m, l in zip(middle, level)],
                          [m + l for m, l in zip(middle, level)], alpha=0.2)
        axis.plot(middle, lw=1)
        axis.scatter(range(len(values)), middle, 8, [COLOURS[value.state.name] for value in values], zorder=3)
        axis.set_ylabel(f"{name} [{unit}]")
    axes[-1].set_xlabel("frame; green valid, orange degraded, blue held, red invalid; band: protection level")
    figure.savefig(path, dpi=110)
    print(f"plotted to {path}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("frames")
    parser.add_argument("--config")
    parser.add_argument("--plot")
    words = parser.parse_args()
    results = list(measure(words.frames, pose_wall.Config.load(words.config) if words.config else pose_wall.Config()))
    if not results:
        raise SystemExit(f"{words.frames}: no .pcd files there")
    print_table(results)
    if words.plot:
        plot(results, words.plot)


if __name__ == "__main__":
    main()
