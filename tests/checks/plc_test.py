#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The structured text of tools/plc, read and run by structured_text.py (not by a vendor's compiler): it parses, its
types are those of image.def, its CRC is zlib's, it decodes images to the very numbers, and FB_PoseWall watches, holds,
substitutes and asks for the safe state.

usage: plc_test.py ROOT"""

import pathlib
import random
import re
import struct
import sys
import unittest
import zlib

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT = pathlib.Path(sys.argv.pop(1))
sys.path[:0] = [str(ROOT / "tools/plc"), str(pathlib.Path(__file__).parent)]

import image_description as description  # noqa: E402  pylint: disable=wrong-import-position
import structured_text  # noqa: E402  pylint: disable=wrong-import-position
import structured_text_run  # noqa: E402  pylint: disable=wrong-import-position

TYPES_TEXT = (ROOT / "tools/plc/PoseWallImage.st").read_text(encoding="utf-8")
BLOCK_TEXT = (ROOT / "tools/plc/FB_PoseWall.st").read_text(encoding="utf-8")
HEADER = (ROOT / "include/pose_wall.h").read_text(encoding="utf-8")
STRUCTS = description.read_structs()
WORDS = description.image_words(1, STRUCTS)
WORD_OF = {word.path: i for i, word in enumerate(WORDS)}
STATE = {"invalid": 0, "held": 1, "degraded": 2, "valid": 3}
FAULT = {"none": 0, "silent": 1, "version": 2, "crc": 3, "config": 4}
CHANNELS = {"fbRoll": "roll", "fbPitch": "pitch", "fbYaw": "yaw", "fbLeftFront": "d_lf", "fbLeftBack": "d_lb",
            "fbRightFront": "d_rf", "fbRightBack": "d_rb"}
LIMIT = {"mdeg": 1000, "mm": 100}  # FB_PoseWall's own defaults
CYCLE_MS = 20


def program():
    return structured_text.Program(TYPES_TEXT, BLOCK_TEXT)


def define(name):
    return description.read_define(HEADER, f"POSE_WALL_IMAGE_{name}")


def crc_of(words):
    return zlib.crc32(description.crc_bytes(struct.pack(f"<{len(words)}I", *words), 1))


def image_words(sequence=1, **changes):
    """The words of an image in which everything is valid, but for `changes` by path with "__" for the dot."""
    values = {word.path: 0 for word in WORDS}
    values |= {"struct_size": 4 * len(WORDS), "version": define("VERSION"), "sequence": sequence,
               "config_crc32": 0xC0FFEE, "verdict": 3}
    values |= {path: STATE["valid"] for path in values if path.endswith(".state")}
    values |= {"yaw.value_mdeg": -1500, "yaw.protection_mdeg": 300, "d_lf.value_mm": 2100, "d_lf.protection_mm": 40}
    values |= {path.replace("__", "."): value for path, value in changes.items()}
    codes = "".join(description.TYPES[word.type][2] for word in WORDS)
    words = list(struct.unpack(f"<{len(WORDS)}I", struct.pack("<" + codes, *(values[word.path] for word in WORDS))))
    words[description.crc_word(WORDS)] = crc_of(words)
    return words


class Text(unittest.TestCase):
    def test_structs_are_those_of_the_description(self):
        types = program().types
        for item in [item for name, item in STRUCTS.items() if "image2" not in name]:
            expected = {m.name: description.TYPES[m.type][1] if m.type in description.TYPES else STRUCTS[m.type].st_name
                        for m in item.members}
            self.assertEqual(list(types[item.st_name][1].items()), list(expected.items()))
        self.assertEqual(types["T_PoseWallWords"], ("ARRAY", 0, len(WORDS) - 1, "DWORD"))

    def test_states_and_reasons_are_those_of_the_header(self):
        read = program()
        self.assertEqual(read.types["E_PoseWallState"][1], description.read_enum(HEADER, "pose_wall_state"))
        reasons = {name: bit for name, bit in read.constants.items() if name.startswith("POSE_WALL_R_")}
        self.assertEqual(reasons, description.read_enum(HEADER, "pose_wall_reason"))
        self.assertEqual(len(reasons), description.read_define(HEADER, "POSE_WALL_REASON_COUNT"))

    def test_readme_is_right_where_it_is_installed(self):
        readme = (ROOT / "tools/plc/README.md").read_text(encoding="utf-8")
        for link in re.findall(r"\]\(([^)]*)\)", readme):
            self.assertTrue(link.endswith((".st", "controller.c")), f"{link} is not installed beside README.md")

    def test_every_block_has_its_end(self):
        for word in ("END_IF;", "END_FOR;", "END_VAR", "END_FUNCTION\n", "END_FUNCTION_BLOCK", "END_TYPE"):
            with self.assertRaises(structured_text.Fault, msg=word):
                structured_text.Program(TYPES_TEXT, BLOCK_TEXT.replace(word, "", 1))

    def test_faults_are_found(self):
        for good, bad, why in (("xAlive := xEver AND", "xAlive := xNever AND", "xNever is not declared"),
                               ("stImage.roll.state", "stImage.roll.status", "has no status"),
                               ("tonHold : TON", "tonHold : TUN", "type TUN is not known"),
                               ("diOut := diValue;", "diOut = diValue;", "expected :="),
                               ("VAR_IN_OUT\n  adwImage : T_PoseWallWords;\nEND_VAR\nVAR_INPUT",
                                "VAR_INPUT\n  adwImage : T_PoseWallWords;", "adwImage is an input"),
                               ("xNew : BOOL;", "xNew : BOOL; xNew : BOOL;", "declared twice")):
            self.assertIn(good, BLOCK_TEXT)
            with self.assertRaisesRegex(structured_text.Fault, why):
                structured_text.Program(TYPES_TEXT, BLOCK_TEXT.replace(good, bad, 1))


class Functions(unittest.TestCase):
    def setUp(self):
        self.run_st = structured_text_run.Controller(program())
        self.random = random.Random(7)

    def test_crc_is_the_one_of_ieee_802_3(self):
        self.assertEqual(zlib.crc32(b"123456789"), 0xCBF43926)
        for _ in range(5):
            words = [self.random.getrandbits(32) for _ in WORDS]
            self.assertEqual(self.run_st.function("F_PoseWallCrc", adwImage=words), crc_of(words))

    def test_decodes_every_member(self):
        words = [self.random.getrandbits(32) for _ in WORDS]
        for i, word in enumerate(WORDS):
            if word.type == "float":
                words[i] = struct.unpack("<I", struct.pack("<f", self.random.uniform(-9, 9)))[0]
        image = self.run_st.make("ST_PoseWallImage")
        self.run_st.function("F_PoseWallDecode", adwImage=words, stImage=image)
        for path, value in description.unpack_image(struct.pack(f"<{len(WORDS)}I", *words), 1).items():
            member = image
            for part in path.split("."):
                member = member[part]
            self.assertEqual(member, value, path)

    def test_reals(self):
        for value in (0.0, 1.0, -2.5, 1e-30, 3.4e38, 2147483648.0, -2147483648.0):
            bits, = struct.unpack("<I", struct.pack("<f", value))
            expected, = struct.unpack("<f", struct.pack("<f", value))
            self.assertEqual(self.run_st.function("F_PoseWallReal", dwBits=bits), expected)
        self.assertEqual(self.run_st.function("F_PoseWallReal", dwBits=0x7FC00000), 0.0)

    def test_unknown_states_are_invalid(self):
        for state, expected in ((3, 3), (2, 2), (4, 0), (0xFFFFFFFF, 0)):
            self.assertEqual(self.run_st.function("F_PoseWallState", udiState=state), expected)


class FunctionBlock(unittest.TestCase):
    def setUp(self):
        self.run_st = structured_text_run.Controller(program())
        self.block = self.run_st.make("FB_PoseWall")
        self.sequence = 0

    def cycles(self, for_ms, words, **inputs):
        """Scans for so long with the same image at the input."""
        for _ in range(for_ms // CYCLE_MS):
            self.run_st.now_ms += CYCLE_MS
            self.run_st.call(self.block, adwImage=words, **inputs)

    def frames(self, count=3, inputs=None, **changes):
        for _ in range(count):
            self.sequence += 1
            self.cycles(100, image_words(self.sequence, **changes), **(inputs or {}))

    def expect(self, fault, safe_state, yaw):
        self.assertEqual((self.block["eFault"], self.block["xSafeState"], self.block["fbYaw"]["diOut"]),
                         (FAULT[fault], safe_state, yaw))

    def test_before_anything_has_come(self):
        self.cycles(20, [0] * len(WORDS))
        self.expect("version", True, 0)

    def test_silence_before_the_first_frame(self):
        self.cycles(200, image_words(0))
        self.expect("silent", True, 0)
        self.frames(1)  # and the first frame counts at once
        self.expect("none", False, -1500)

    def test_good_images(self):
        self.frames()
        self.expect("none", False, -1500)
        self.assertEqual(self.block["fbLeftFront"]["diOut"], 2100)
        self.assertEqual(self.block["eVerdict"], STATE["valid"])

    def test_a_sequence_that_stands_still(self):
        self.frames()
        words = image_words(self.sequence)
        self.cycles(200, words)  # 280 ms since it was new
        self.expect("none", False, -1500)
        self.assertTrue(self.block["xAlive"])
        self.cycles(40, words)  # the watchdog is at 300 ms, now the value is held
        self.expect("silent", False, -1500)
        self.assertFalse(self.block["fbYaw"]["xFresh"])
        self.cycles(460, words)
        self.expect("silent", False, -1500)
        self.cycles(60, words)  # and 500 ms later no more
        self.expect("silent", True, 0)
        self.assertEqual(self.block["eVerdict"], STATE["invalid"])
        self.frames(1)
        self.expect("none", False, -1500)

    def test_damage(self):
        self.frames()
        for word in (WORD_OF["sequence"], WORD_OF["roll.value_rad"], len(WORDS) - 1):
            words = image_words(self.sequence + 1)
            words[word] ^= 1 << 9
            self.cycles(20, words)
            self.expect("crc", False, -1500)
        self.cycles(900, words)
        self.expect("crc", True, 0)

    def test_other_settings(self):
        self.frames(inputs={"dwConfigCrc": 0xC0FFEE})
        self.expect("none", False, -1500)
        self.frames(1, {"dwConfigCrc": 0xBAD, "tHold": 50})
        self.expect("config", True, 0)

    def test_damage_after_other_settings_brings_nothing_back(self):
        self.frames(inputs={"dwConfigCrc": 0xC0FFEE})
        other = image_words(self.sequence + 1, config_crc32=0xBAD)
        self.cycles(20, other)
        self.expect("config", False, -1500)
        self.assertFalse(self.block["xAlive"])
        other[WORD_OF["yaw.value_mdeg"]] ^= 1
        self.cycles(20, other)
        self.expect("crc", False, -1500)
        self.assertFalse(self.block["xAlive"])
        self.cycles(20, image_words(self.sequence))  # an old image of the approved settings
        self.assertFalse(self.block["xAlive"])
        self.sequence += 1
        self.frames(1)
        self.expect("none", False, -1500)
        self.assertTrue(self.block["xAlive"])

    def old_images(self, buffers, for_ms):
        for cycle in range(for_ms // CYCLE_MS):
            self.cycles(CYCLE_MS, image_words(self.sequence - buffers + 1 + cycle % buffers))

    def test_old_images_in_turn(self):
        for buffers in (2, 3):
            self.setUp()
            self.frames(9)
            self.old_images(buffers, 400)
            self.expect("silent", False, -1500)
            self.assertFalse(self.block["xAlive"])
            self.old_images(buffers, 1000)
            self.expect("silent", True, 0)

    def test_a_sequence_that_begins_anew(self):
        self.frames(9)
        self.sequence = 3  # the images of 1 to 3 were missed
        self.frames(3)
        self.assertFalse(self.block["xAlive"])
        self.frames(1, yaw__value_mdeg=-1600)
        self.expect("none", False, -1600)
        self.assertTrue(self.block["xAlive"])

    def test_a_sequence_with_gaps(self):
        self.frames()
        self.sequence += 1000
        self.frames(1, yaw__value_mdeg=-1600)
        self.expect("none", False, -1600)

    def test_other_version(self):
        self.frames(1, version=define("VERSION") + 1)
        self.expect("version", True, 0)

    def test_a_value_that_is_not_valid_is_held_and_then_replaced(self):
        for state in ("degraded", "held", "invalid"):
            self.setUp()
            self.frames()
            self.frames(4, yaw__state=STATE[state], yaw__value_mdeg=99)
            self.expect("none", False, -1500)
            self.frames(2, {"diAngleSubstitute_mdeg": 7}, yaw__state=STATE[state], yaw__value_mdeg=99)
            self.expect("none", True, 7)

    def test_every_channel_has_its_own_value_and_limit(self):
        unit = {block: "mm" if member.startswith("d_") else "mdeg" for block, member in CHANNELS.items()}
        values = {f"{member}__value_{unit[block]}": 10 + i for i, (block, member) in enumerate(CHANNELS.items())}
        for wrong, member in CHANNELS.items():
            limit = LIMIT[unit[wrong]]
            self.frames(1, {"tHold": 500}, **values, **{f"{member}__protection_{unit[wrong]}": limit})
            self.assertEqual([self.block[block]["diOut"] for block in CHANNELS], list(range(10, 17)))
            self.assertTrue(all(self.block[block]["xFresh"] for block in CHANNELS))
            self.frames(1, **values, **{f"{member}__protection_{unit[wrong]}": limit + 1})
            self.assertEqual([block for block in CHANNELS if not self.block[block]["xFresh"]], [wrong])
            self.assertFalse(self.block["xSafeState"])
            self.frames(1, {"tHold": 40}, **values, **{f"{member}__protection_{unit[wrong]}": limit + 1})
            self.assertTrue(self.block["xSafeState"])

    def test_degraded_within_the_limit_when_asked_for(self):
        self.frames(inputs={"xTakeDegraded": True}, yaw__state=STATE["degraded"])
        self.expect("none", False, -1500)
        self.frames(9, yaw__state=STATE["degraded"], yaw__protection_mdeg=1001)
        self.expect("none", True, 0)

    def test_no_value_and_no_bound(self):
        for change in ({"yaw__value_mdeg": define("NO_VALUE")}, {"yaw__protection_mdeg": define("NO_BOUND")},
                       {"yaw__protection_mdeg": -1}):
            self.setUp()
            self.frames(**change)
            self.expect("none", True, 0)


if __name__ == "__main__":
    unittest.main()
