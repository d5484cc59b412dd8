#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""On the same simulated frames the controller's example prints, digit by digit, what `pose_wall run` writes, and its
images hold these numbers, rounded; options that it does not know it refuses. The controller may be of another machine,
run by an emulator.

usage: check_controller.py ROOT POSE_WALL CONTROLLER [EMULATOR...]"""

import csv
import pathlib
import subprocess
import sys
import tempfile
import zlib

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(ROOT / "tools/apps/plc"))

import image_description as description  # noqa: E402  pylint: disable=wrong-import-position

NAMES = ["roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb"]
STATES = ["invalid", "held", "degraded", "valid"]
DEGREES_PER_RADIAN = 57.29577951308232
FRAMES = 4
HEADER = (ROOT / "include/pose_wall.h").read_text(encoding="utf-8")
NONE = tuple(description.read_define(HEADER, f"POSE_WALL_IMAGE_NO_{what}") for what in ("VALUE", "BOUND"))


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{command[0]} ended with status {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def expected_line(number, row):
    words = [str(number), min((row[f"{name}_state"] for name in NAMES), key=STATES.index)]
    for name in NAMES:
        words += [f"{name}={row[name] or '-'}", f"pl={row[f'{name}_pl'] or '-'}", row[f"{name}_state"]]
    return " ".join(words)


def image_faults(raw, row):
    image = description.unpack_image(raw, 1)
    if image["crc32"] != zlib.crc32(description.crc_bytes(raw, 1)):
        yield "its CRC is not zlib's"
    if image["stamp_low"] + (image["stamp_high"] << 32) != int(row["stamp_ns"]):
        yield "stamp"
    for name in NAMES:
        unit, scale = ("mm", 1e3) if name.startswith("d_") else ("mdeg", 1e3 * DEGREES_PER_RADIAN)
        value, protection = image[f"{name}.value_{unit}"], image[f"{name}.protection_{unit}"]
        if STATES[image[f"{name}.state"]] != row[f"{name}_state"]:
            yield f"state of {name}"
        if not row[name]:
            if (value, protection) != NONE:
                yield f"{name} is a number and should be none"
        elif not abs(value - float(row[name]) * scale) <= 0.5001:
            yield f"{name} is {value} {unit}"
        elif not 0 <= protection - float(row[f"{name}_pl"]) * scale <= 1.5001:
            yield f"protection level of {name} is {protection} {unit}"


def compare(lines, images, rows):
    size = 4 * len(description.image_words(1))
    if len(lines) != FRAMES or len(rows) != FRAMES or len(images) != FRAMES * size:
        yield f"{len(lines)} lines, {len(images) / size} images, {len(rows)} rows of {FRAMES} frames"
        return
    for i, row in enumerate(rows):
        if lines[i].split(" crc=")[0] != expected_line(i + 1, row):
            yield f"frame {i}: printed\n  {lines[i]}\nexpected\n  {expected_line(i + 1, row)}"
        yield from (f"image {i}: {fault}" for fault in image_faults(images[i * size:(i + 1) * size], row))


def option_faults(frame, *controller):
    """What the controller does not know it must not pass over."""
    for words in (["-q", "x", frame], ["-q"], ["-o"]):
        done = subprocess.run([*controller, *words], capture_output=True, text=True, check=False)
        if done.returncode != 2 or f"{words[0]}: is no option" not in done.stderr:
            yield f"{words}: status {done.returncode}, {done.stdout}{done.stderr}"


def without_stamps(frames):
    """The controller has a clock of its own: ten frames a second, as run has for frames that carry no stamps."""
    for frame in frames:
        lines = frame.read_bytes().split(b"\n", 2)
        if not lines[1].startswith(b"# stamp_ns "):
            sys.exit(f"{frame}: no stamp in its second line")
        frame.write_bytes(lines[0] + b"\n" + lines[2])


def second_as_kitti(frames):
    """The same points once more as a KITTI .bin: the simulator's .pcd have x y z intensity in float32, too."""
    raw = frames[1].read_bytes()
    frames[1] = frames[1].with_suffix(".bin")
    frames[1].write_bytes(raw.split(b"DATA binary\n", 1)[1])


def main():
    pose_wall, controller, *emulator = sys.argv[2:]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        run(pose_wall, "sim", "--scene", "nominal", "--frames", FRAMES, "--output", folder)
        config, frames = folder / "pose_wall.yaml", sorted((folder / "frames").iterdir())
        without_stamps(frames)
        second_as_kitti(frames)
        # The controller has the engine alone.
        run(pose_wall, "run", "--config", config, "--set", "motion=off", "--output", folder / "run.csv", *frames)
        lines = run(*emulator, controller, "-c", config, "-o", folder / "images.bin", *frames).splitlines()
        with open(folder / "run.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        faults = list(compare(lines, (folder / "images.bin").read_bytes(), rows))
        faults += option_faults(frames[1], *emulator, controller)
    if not any(row["yaw_state"] in ("valid", "degraded") for row in rows):
        faults.append("nothing was measured: nothing was compared")
    print("\n".join(faults) or f"{FRAMES} frames: the same numbers, and images that hold them")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
