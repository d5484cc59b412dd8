# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""What the tests of the Python package share: skipping without NumPy, simulated roads, and a road made by hand."""

import atexit
import functools
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SKIPPED = 77  # as CMakeLists.txt has it

try:
    import numpy as np
except ImportError:
    print(f"skipped: {sys.executable} has no NumPy: apt install python3-numpy")
    sys.exit(SKIPPED)

import pose_wall  # noqa: E402  pylint: disable=wrong-import-position

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
COMMAND = os.environ.get("POSE_WALL", "")
needs_command = unittest.skipUnless(COMMAND and os.access(COMMAND, os.X_OK), "the command pose_wall was not built")


@functools.lru_cache(None)
def scratch():
    """A folder that is gone when the tests have ended."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="pose_wall_python_"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def run_command(*words):
    """What it prints; it has to end well."""
    done = subprocess.run([COMMAND, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          check=False)
    if done.returncode != 0:
        raise AssertionError(f"pose_wall {words}: status {done.returncode}\n{done.stderr}")
    return done.stdout


def json_rows(config, frames, *more):
    return [json.loads(line) for line in run_command(
        "run", "--quiet", "--format", "json", "--config", config, *more, frames).splitlines()]


@functools.lru_cache(None)
def simulated(scene, frames, *settings):
    """A folder with frames/, truth.csv and pose_wall.yaml."""
    folder = scratch() / "_".join([scene, str(frames), *settings]).replace("=", "-")
    run_command("sim", "--quiet", "--scene", scene, "--frames", frames, "--output", folder,
                *(word for setting in settings for word in ("--set", setting)))
    return folder


@functools.lru_cache(None)
def road(rows=64, columns=400):
    """A scan of a road with a flat floor, walls at 2.5 m and a roof, as (N, 3) float32: rays at even angles, each to
    the first surface. Not to be changed."""
    up = np.radians(np.linspace(-35.0, 35.0, rows))[:, None]
    around = np.radians(np.arange(columns) * 360.0 / columns)[None, :]
    rays = np.stack(np.broadcast_arrays(np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)), -1)
    rays = rays.reshape(-1, 3)
    with np.errstate(divide="ignore"):
        away = np.stack([25.0 / np.abs(rays[:, 0]), 2.5 / np.abs(rays[:, 1]),
                         np.where(rays[:, 2] < 0.0, 1.5, 2.0) / np.abs(rays[:, 2])])
    points = (rays * away.min(axis=0)[:, None]).astype(np.float32)
    points.flags.writeable = False
    return points


def untimed(result):
    """All bits of a result but the times of its stages."""
    struct = result.to_c()
    for stage in pose_wall.Stage:
        struct.stage_ns[stage] = 0
    return bytes(struct)


def measured(points, **settings):
    """The bits of a first frame."""
    return untimed(pose_wall.Engine(pose_wall.Config(settings)).process(points, stamp_ns=0))
