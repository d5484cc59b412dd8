#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Frames of CAN, decoded by the project's DBC files and a reader of DBC that others wrote (candied). Each signal says
what the image says, in physical units. Each frame has its counter and CRC. What does not fit is no value, no bound or
not known. A damaged image gives no frames. A command of a drive reads as a controller wrote it.

usage: can_peer.py ROOT POSE_WALL POSE_WALLD CAN_FRAMES NODE_MODULES"""

import collections
import json
import os
import pathlib
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT, _, _, CAN_FRAMES, MODULES = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(5))
sys.path[:0] = [str(ROOT / "tests/live"), str(ROOT / "tools/apps/plc")]

import can_description  # noqa: E402  pylint: disable=wrong-import-position
import image_description as description  # noqa: E402  pylint: disable=wrong-import-position
import live_peer  # noqa: E402  pylint: disable=wrong-import-position

live_peer.need("nodejs", programs=("node",))
if not (MODULES / "candied").exists():
    print("SKIPPED: there is no candied in build/node_modules (npm ci, as tools/test.sh does)")
    sys.exit(live_peer.SKIPPED)

STRUCTS = description.read_structs()
IMAGES = can_description.read_images(STRUCTS)
ROUNDS = 200  # images of each kind
# Where a rule begins to bite: zero, the largest fields of 7 to 24 bits, no bound and no value.
EDGES = [0, 1, 127, 128, 255, 65534, 65535, 65536, 524287, 524288, 8388607, 8388608, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF]

Case = collections.namedtuple("Case", "image words frames")  # frames: of 11 bits, then of J1939


def version_of(image):
    return next(version for version, name in description.images(STRUCTS).items() if name == image.struct)


def image_bytes(image, chance):
    """An image of any numbers, with a true CRC."""
    version = version_of(image)
    paths = [word.path for word in description.image_words(version, STRUCTS)]
    words = {path: chance.choice([chance.getrandbits(32), chance.choice(EDGES), -chance.choice(EDGES) & 0xFFFFFFFF])
             for path in paths}
    words.update(struct_size=4 * len(paths), version=image_version(image), crc32c=0)
    raw = struct.pack(f"<{len(paths)}I", *words.values())
    words["crc32c"] = description.crc_of(description.crc_bytes(raw, version), description.POLYNOMIAL[version])
    return words, struct.pack(f"<{len(paths)}I", *words.values())


def image_version(image):
    text = "".join(path.read_text(encoding="utf-8") for path in sorted((ROOT / "include").glob("pose_wall*.h")))
    return int(re.search(rf"#define {image.struct.upper()}_VERSION (\d+)", text).group(1))


def frames_of(lines):
    """Of each line "KIND HEX" the frames that the program prints."""
    done = subprocess.run([CAN_FRAMES], input="\n".join(lines), capture_output=True, text=True, check=True)
    return [line.split() for line in done.stdout.splitlines()]


def decoded(dbc, frames):
    """What others read in frames."""
    with tempfile.TemporaryDirectory() as place:
        os.symlink(MODULES, pathlib.Path(place) / "node_modules")
        script = pathlib.Path(place) / "dbc_reader.mjs"
        shutil.copy(ROOT / "tests/live/peer/dbc_reader.mjs", script)
        done = subprocess.run(["node", script, ROOT / "tools/apps/plc/can" / dbc], input="\n".join(frames),
                              capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def expected(signal, word):
    """By the rules of can.def, told anew: the number, before its scale."""
    number = word - (1 << 32) if word >> 31 else word
    if signal.how == "bits":
        return word % (1 << signal.bits)
    if signal.how == "limit":
        return min(word, (1 << signal.bits) - 1)
    if signal.how == "signed":
        return number if abs(number) < 1 << (signal.bits - 1) else -(1 << (signal.bits - 1))
    return number if 0 <= number < (1 << signal.bits) - 1 else (1 << signal.bits) - 1


def crc8(data):
    """CRC8H2F by a table of nothing: bit by bit."""
    crc = 0xFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ (0x2F if crc & 0x80 else 0)) & 0xFF
    return crc ^ 0xFF


class Can(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        chance = random.Random(1939)
        made = [(image, *image_bytes(image, chance)) for image in IMAGES for _ in range(ROUNDS)]
        printed = frames_of([f"{image.function} {raw.hex()}" for image, _, raw in made])
        cls.cases = [Case(image, words, frames) for (image, words, _), frames in zip(made, printed)]
        cls.raw = {image.function: raw for image, _, raw in made}

    def check_bus(self, dbc, half):
        """half: 0, the frames of 11 bits; 1, those of J1939."""
        parts = [case.frames[half * len(case.image.frames):(half + 1) * len(case.image.frames)] for case in self.cases]
        read = iter(decoded(dbc, [frame for part in parts for frame in part]))
        signals = 0
        for case in self.cases:
            for frame in case.image.frames:
                told = next(read)
                self.assertEqual(told["message"], f"PoseWall{frame.name}")
                self.assertEqual(told["signals"]["counter"][0], case.words[case.image.counter] & 0xFF)
                for signal in frame.signals:
                    raw, value, _ = told["signals"][can_description.dbc_name(signal.path)]
                    number = expected(signal, case.words[signal.path])
                    factor, _ = can_description.scale_of(signal.member.unit)
                    self.assertEqual(raw, number, (signal, case.words[signal.path]))
                    self.assertAlmostEqual(value, number * factor, delta=1e-9 * max(1, abs(number)), msg=signal)
                    signals += 1
        print(f"{dbc}: {signals} signals of {len(self.cases)} images as the images say")

    def test_frames_of_11_bits(self):
        self.check_bus("pose_wall_11bit.dbc", 0)

    def test_frames_of_j1939(self):
        self.check_bus("pose_wall_j1939.dbc", 1)

    def test_identifiers_and_crc(self):
        for case in self.cases:
            plain, long = case.frames[:len(case.image.frames)], case.frames[len(case.image.frames):]
            for frame, short, wide in zip(case.image.frames, plain, long):
                self.assertEqual(int(short.split("#")[0], 16), 0x680 + frame.number)
                at = int(wide.split("#")[0], 16)
                self.assertEqual((at >> 26, at >> 8 & 0x3FFFF, at & 0xFF), (frame.priority, 0xFF00 + frame.number, 128))
                self.assertEqual(short.split("#")[1], wide.split("#")[1])
                data = bytes.fromhex(short.split("#")[1])
                self.assertEqual(data[0], crc8(bytes([frame.number]) + data[1:]))
        self.assertEqual(crc8(b"123456789"), 0xDF)  # as AUTOSAR_SWS_CRCLibrary has it

    def test_a_command_is_what_a_controller_wrote(self):
        chance = random.Random(7)
        commands = [(chance.getrandbits(8), chance.randrange(-2**15, 2**15), chance.randrange(-2**15, 2**15))
                    for _ in range(ROUNDS)]
        printed = frames_of([f"command {struct.pack('<Iii', *command).hex()}" for command in commands])
        for half, dbc in enumerate(("pose_wall_11bit.dbc", "pose_wall_j1939.dbc")):
            told = decoded(dbc, [frames[half] for frames in printed])
            for (counter, speed, turn), one, frames in zip(commands, told, printed):
                self.assertEqual(one["message"], "PoseWallCommand")
                self.assertEqual(one["signals"]["counter"][0], counter)
                self.assertAlmostEqual(one["signals"]["command_speed"][1], speed / 1000, delta=1e-9)
                self.assertAlmostEqual(one["signals"]["command_turn"][1], turn / 1000, delta=1e-9)
                data = bytes.fromhex(frames[half].split("#")[1])
                self.assertEqual(data[0], crc8(bytes([7]) + data[1:]))

    def test_crc_finds_three_flipped_bits(self):
        """Of any frame: by the syndromes of single bits, no two of them and no three add up to nothing."""
        good = crc8(bytes(8))
        syndromes = [good ^ crc8((1 << bit).to_bytes(8, "big")) for bit in range(64)] + [1 << bit for bit in range(8)]
        singles = set(syndromes)
        self.assertEqual(len(singles), 72)
        pairs = {a ^ b for i, a in enumerate(syndromes) for b in syndromes[:i]}
        self.assertFalse(singles & pairs)

    def test_a_damaged_image_gives_no_frame(self):
        lines = []
        for kind, raw in self.raw.items():
            for at in range(len(raw)):
                lines.append(f"{kind} {(raw[:at] + bytes([raw[at] ^ 0x10]) + raw[at + 1:]).hex()}")
        self.assertEqual([frames for frames in frames_of(lines) if frames], [])

    def test_words_of_states(self):
        """A controller's tool shows names, not numbers."""
        frame = next(case.frames[3] for case in self.cases if case.frames and case.image.function == "image2")
        state = decoded("pose_wall_11bit.dbc", [frame])[0]["signals"]["roll_state"]
        self.assertEqual(state[2], ("invalid", "held", "degraded", "valid")[state[0]])


if __name__ == "__main__":
    live_peer.main()
