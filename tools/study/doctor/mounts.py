#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""What `pose_wall doctor` finds on simulated mounts, beside what is true: the table in README.md.

usage: mounts.py POSE_WALL [FRAMES]     prints rows of Markdown; exit status 1 where a mount is not usable"""

import json
import subprocess
import sys
import tempfile

# name, sensor, settings of the simulator
MOUNTS = (
    ("upright", "os1-64", "base_height_m=1.4"),
    ("leaning, backwards", "os1-64", "face_distance_m=9 forward_axis=-X mount_roll_deg=-3 mount_pitch_deg=6 "
     "base_height_m=1.2"),
    ("leftwards, aside, turned 4 deg", "os1-64", "face_distance_m=9 forward_axis=+Y turned_left_deg=4 lateral_m=0.6 "
     "base_height_m=1.7"),
    ("rightwards, leaning", "os0-128", "face_distance_m=9 forward_axis=-Y mount_roll_deg=8 base_height_m=1.5"),
    ("few rings, nose up", "vlp16", "face_distance_m=9 mount_pitch_deg=-4 base_height_m=1.5"),
    ("low", "vlp16", "base_height_m=0.6"),
    ("leaning by 20 deg", "os0-128", "mount_pitch_deg=20 base_height_m=1.4"),
    ("upside down, body", "os0-128", "mount_roll_deg=180 body=yes base_height_m=1.6"),
    ("upside down, leaning, body", "mid360", "mount_roll_deg=176 mount_pitch_deg=3 body=yes base_height_m=1.5"),
    ("upside down, no body", "os1-64", "mount_roll_deg=180 base_height_m=1.4"),
    ("body and boom", "os0-128", "body=yes boom=yes body_top_m=-0.5 base_height_m=1.6"),
    ("rough rock, body", "os1-64", "roughness_m=0.04 floor_roughness_m=0.015 body=yes mount_pitch_deg=3 "
     "base_height_m=1.5"),
    ("rough rock, face 6 m ahead", "vlp16", "roughness_m=0.04 floor_roughness_m=0.015 face_distance_m=6 "
     "forward_axis=+Y base_height_m=1.3"),
)


def look(program, folder, sensor, settings, frames):
    words = [program, "sim", "--quiet", "--sensor", sensor, "--frames", frames, "--output", folder]
    for setting in settings:
        words += ["--set", setting]
    subprocess.run(words, check=True)
    ran = subprocess.run([program, "doctor", "--quiet", "--json", folder + "/frames"], check=False, text=True,
                         stdout=subprocess.PIPE)
    return json.loads(ran.stdout)


def row(name, sensor, settings, found):
    truth = dict(setting.split("=") for setting in settings)
    floor, road, body = found["floor"], found.get("road", {}), found.get("body", {})
    angle = [float(truth.get(key, 0)) for key in ("mount_roll_deg", "mount_pitch_deg")]
    ahead = road.get("forward_axis", "-") + ("" if road.get("ahead_known") else "?")
    return " | ".join((
        f"| {name}", f"{found['sensor']['class']} / {sensor}",
        f"{floor.get('height_m', float('nan')):.3f} / {float(truth['base_height_m']):.1f}",
        f"{floor.get('roll_deg', float('nan')):.2f} / {angle[0]:.0f}",
        f"{floor.get('pitch_deg', float('nan')):.2f} / {angle[1]:.0f}",
        f"{ahead} / {truth.get('forward_axis', '+X')}",
        f"{1e3 * (found['range_noise']['m'] or float('nan')):.0f}" if "range_noise" in found else "-",
        f"{len(body.get('boxes_m', []))} / {'yes' if 'body' in truth else 'no'}",
        "yes" if floor.get("certain") else "no", found["grade"].replace("_", " "))) + " |"


def main():
    program, frames = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "24"
    head = ("mount", "class", "height (m)", "roll (deg)", "pitch (deg)", "ahead", "noise (mm)", "boxes / body",
            "floor certain", "verdict")
    print(f"| {' | '.join(head)} |\n|{' --- |' * len(head)}")
    usable = True
    for name, sensor, settings in MOUNTS:
        with tempfile.TemporaryDirectory() as folder:
            found = look(program, folder, sensor, settings.split(), frames)
        usable = usable and found["usable"]
        print(row(name, sensor, settings.split(), found), flush=True)
    sys.exit(0 if usable else 1)


if __name__ == "__main__":
    main()
