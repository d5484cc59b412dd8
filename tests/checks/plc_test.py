#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""FB_PoseWall as plain text, read and run by structured_text.py (not by a vendor's compiler): it parses, its kinds fit,
its types are those of image.def, its sums are those of both polynomials, it decodes all images in any order of bytes,
and it obeys what is worse at once, ages what it holds, and releases nothing else. FB_PoseWallStop has plc_stop_test.py.

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
sys.path[:0] = [str(ROOT / "tools/apps/plc"), str(pathlib.Path(__file__).parent)]

import image_description as description  # noqa: E402  pylint: disable=wrong-import-position
import structured_text  # noqa: E402  pylint: disable=wrong-import-position
import structured_text_run  # noqa: E402  pylint: disable=wrong-import-position

TEXT = (ROOT / "tools/apps/plc/FB_PoseWall.st").read_text(encoding="utf-8")
HEADER = (ROOT / "include/pose_wall.h").read_text(encoding="utf-8")
STRUCTS = description.read_structs()
WORDS = {version: description.image_words(version, STRUCTS) for version in (1, 2)}
LONGEST = len(WORDS[2])
STATE = {"invalid": 0, "held": 1, "degraded": 2, "valid": 3}
FAULT = {"none": 0, "silent": 1, "version": 2, "crc": 3, "config": 4, "starting": 5, "frames": 6}
OUTPUTS = {"stRoll": "roll", "stPitch": "pitch", "stYaw": "yaw", "stLeftFront": "d_lf", "stLeftBack": "d_lb",
           "stRightFront": "d_rf", "stRightBack": "d_rb"}
CYCLE_MS = 20


def define(name):
    return description.read_define(HEADER, f"POSE_WALL_IMAGE_{name}")


NO_VALUE, NO_BOUND = define("NO_VALUE"), define("NO_BOUND")
PROGRAM = structured_text.Program(TEXT)


def unit_of(member):
    return "mm" if member.startswith("d_") else "mdeg"


def sum_of(words, version):
    raw = struct.pack(f"<{len(WORDS[version])}I", *words[:len(WORDS[version])])
    return description.crc_of(description.crc_bytes(raw, version), description.POLYNOMIAL[version])


def image_words(sequence=1, of=2, **changes):
    """The words of an image in which everything is valid, but for `changes` by path with "__" for the dot."""
    rows = WORDS[of]
    values = {word.path: 0 for word in rows}
    values |= {"struct_size": 4 * len(rows), "version": of, "sequence": sequence, "config_crc32": 0xC0FFEE,
               "verdict": 3}
    values |= {path: STATE["valid"] for path in values if path.endswith(".state")}
    values |= {"yaw.value_mdeg": -1500, "yaw.protection_mdeg": 300, "d_lf.value_mm": 2100, "d_lf.protection_mm": 40}
    values |= {"publication": sequence, "latency_ms": 0} if of == 2 else {}
    values |= {path.replace("__", "."): value for path, value in changes.items()}
    codes = "".join(description.TYPES[word.type][2] for word in rows)
    words = list(struct.unpack(f"<{len(rows)}I", struct.pack("<" + codes, *(values[word.path] for word in rows))))
    words[description.crc_word(rows)] = sum_of(words, of)
    return words + [0xDEAD] * (LONGEST - len(words))


class Text(unittest.TestCase):
    def test_structs_are_those_of_the_description(self):
        for item in STRUCTS.values():
            if item.st_name == "-":
                continue
            expected = {m.name: description.TYPES[m.type][1] if m.type in description.TYPES else STRUCTS[m.type].st_name
                        for m in item.members}
            found = {name: row[0] for name, row in PROGRAM.types[item.st_name][1].items()}
            self.assertEqual(list(found.items()), list(expected.items()))
        self.assertEqual(PROGRAM.types["T_PoseWallWords"], ("ARRAY", 0, LONGEST - 1, "DWORD"))

    def test_states_are_those_of_the_header(self):
        constants = PROGRAM.units["FB_PoseWallChannel"].constants | PROGRAM.units["FB_PoseWall"].constants
        for name, number in description.read_enum(HEADER, "pose_wall_state").items():
            self.assertEqual(constants[name].python, str(number))

    def test_readme_is_right_where_it_is_installed(self):
        readme = (ROOT / "tools/apps/plc/README.md").read_text(encoding="utf-8")
        for link in re.findall(r"\]\(([^)]*)\)", readme):
            installed = link.startswith(("FB_PoseWall.", "#")) or link in ("controller.c", "can/README.md")
            self.assertTrue(installed, f"{link} is not installed")

    def test_every_block_has_its_end(self):
        for word in ("END_IF;", "END_FOR;", "END_VAR", "END_FUNCTION\n", "END_FUNCTION_BLOCK", "END_TYPE"):
            with self.assertRaises(structured_text.Fault, msg=word):
                structured_text.Program(TEXT.replace(word, "", 1))

    def test_faults_are_found(self):
        for good, bad, why in (("xAlive := xFrame AND", "xAlive := xNever AND", "xNever is not declared"),
                               ("stImage.roll.state", "stImage.roll.status", "has no status"),
                               ("tonAge : TON", "tonAge : TUN", "type TUN is not known"),
                               ("diTaken := diValue;", "diTaken = diValue;", "expected :="),
                               ("diTaken := diValue;", "diTaken := udiState;", "UDINT and DINT are mixed"),
                               ("diRate < 0 OR", "diRate OR", "BOOL and DINT are mixed"),
                               ("VAR\n  adwNative : T_PoseWallWords;\n",
                                "VAR_INPUT\n  adwNative : T_PoseWallWords;\nEND_VAR\nVAR\n", "adwNative is an input"),
                               ("xNew : BOOL;", "xNew : BOOL; xNew : BOOL;", "declared twice")):
            self.assertIn(good, TEXT)
            with self.assertRaisesRegex(structured_text.Fault, why):
                structured_text.Program(TEXT.replace(good, bad, 1))


class Functions(unittest.TestCase):
    def setUp(self):
        self.run_st = structured_text_run.Controller(PROGRAM)
        self.random = random.Random(7)

    def test_sums(self):
        self.assertEqual(description.crc_of(b"123456789", description.POLYNOMIAL[1]), zlib.crc32(b"123456789"))
        self.assertEqual(description.crc_of(b"123456789", description.POLYNOMIAL[2]), 0xE3069283)
        block = self.run_st.make("FB_PoseWallSum")
        for version in (1, 2, 1):
            words = [self.random.getrandbits(32) for _ in range(LONGEST)]
            self.run_st.call(block, adwImage=words, xImage2=version == 2)
            self.assertEqual(block["dwSum"], sum_of(words, version))

    def test_decodes_every_member(self):
        for version in (1, 2):
            words = [self.random.getrandbits(32) for _ in range(LONGEST)]
            words[1] = version
            image = self.run_st.make("ST_PoseWallImage")
            self.run_st.function("F_PoseWallDecode", adwImage=words, stImage=image)
            raw = struct.pack(f"<{len(WORDS[version])}I", *words[:len(WORDS[version])])
            known = description.unpack_image(raw, version)
            known["crc32c"] = known.pop("crc32", None) or known["crc32c"]
            for word in WORDS[2]:
                member = image
                for part in word.path.split("."):
                    member = member[part]
                missing = {"publication": known["sequence"], "latency_ms": 0xFFFFFFFF}.get(
                    word.path, 7 if word.path.endswith("cause") else 0)
                self.assertEqual(member, known.get(word.path, missing), f"{word.path} of image {version}")

    def test_orders_of_bytes(self):
        for version in (1, 2):
            good = image_words(5, version)
            raw = struct.pack(f"<{LONGEST}I", *good)
            halves = [word << 16 & 0xFFFF0000 | word >> 16 for word in good]
            orders = {1: good, 2: struct.unpack(f">{LONGEST}I", raw), 3: halves,
                      4: struct.unpack(f">{LONGEST}I", struct.pack(f"<{LONGEST}I", *halves))}
            for order, words in orders.items():
                found = self.run_st.function("F_PoseWallOrder", dwSize=words[0], dwVersion=words[1])
                self.assertEqual(found, order)
                native = [self.run_st.function("F_PoseWallSwap", dwWord=word, diOrder=order) for word in words]
                self.assertEqual(native, good)
        for size, version in ((0, 0), (240, 2), (248, 1), (248, 3), (0xFFFFFFFF, 2)):
            self.assertEqual(self.run_st.function("F_PoseWallOrder", dwSize=size, dwVersion=version), 0)

    def test_milliseconds(self):
        for time, expected in ((0, 0), (1, 1), (300, 300), (65535, 65535), (65536, 65536), (2**31 - 1, 65536),
                               (-1, 0), (-2**31, 0)):
            self.assertEqual(self.run_st.function("F_PoseWallMilliseconds", tTime=time), expected)


class Block(unittest.TestCase):
    """An instance, and a bus that shows it images."""

    version = 2

    def setUp(self):
        self.run_st = structured_text_run.Controller(PROGRAM)
        self.block = self.run_st.make("FB_PoseWall")
        self.sequence, self.publication = 0, 0

    def words(self, sequence=None, **changes):
        if self.version == 1:
            changes = {name: value for name, value in changes.items() if name not in ("publication", "latency_ms")}
        return image_words(self.sequence if sequence is None else sequence, self.version, **changes)

    def cycles(self, for_ms, words, **inputs):
        """Scans for so long with the same image at the input."""
        for _ in range(for_ms // CYCLE_MS):
            self.run_st.now_ms += CYCLE_MS
            self.run_st.call(self.block, adwImage=list(words), **inputs)

    def frames(self, count, inputs=None, **changes):
        for _ in range(count):
            self.sequence += 1
            self.publication += 1
            self.cycles(100, self.words(publication=self.publication, **changes), **(inputs or {}))

    def start(self, **inputs):
        """Up to the first frame that counts, and 80 ms on."""
        self.frames(4, inputs)
        self.expect("none", -1500)

    def expect(self, fault, yaw):
        """yaw: what may be acted on, or None where nothing may."""
        found = self.block["stYaw"]
        self.assertEqual([name for name, number in FAULT.items() if number == self.block["udiFault"]], [fault])
        self.assertEqual((found["xUsable"], found["diValue"]), (yaw is not None, NO_VALUE if yaw is None else yaw))
        self.assertEqual(self.block["xSafeState"], not self.block["xRelease"])
        if yaw is None:
            self.assertFalse(self.block["xRelease"])

    def old_images(self, buffers, for_ms):
        for cycle in range(for_ms // CYCLE_MS):
            sequence = self.sequence - buffers + 1 + cycle % buffers
            self.cycles(CYCLE_MS, self.words(sequence, publication=sequence))


class FunctionBlock(Block):
    # What a controller maker found: each failed before.

    def test_is_safe_before_its_first_call(self):
        self.assertTrue(self.block["xSafeState"])
        self.assertFalse(self.block["xRelease"])
        for output in OUTPUTS:
            self.assertEqual(self.block[output]["diValue"], NO_VALUE)
            self.assertFalse(self.block[output]["xUsable"])

    def test_invalid_under_an_unchanged_sequence_is_obeyed_at_once(self):
        for worse in ({"yaw__state": STATE["invalid"]}, {"yaw__value_mdeg": NO_VALUE},
                      {"yaw__protection_mdeg": NO_BOUND}, {"yaw__protection_mdeg": 1001},
                      {"yaw__protection_mdeg": -1}, {"yaw__state": 4}):
            self.setUp()
            self.start()
            self.cycles(20, self.words(publication=self.publication + 1, **worse))
            self.expect("none", None)
            self.cycles(20, self.words(publication=self.publication + 1))  # and what is better is not believed
            self.expect("none", None)

    def test_a_new_invalid_is_not_used(self):
        self.start()
        self.sequence += 1
        self.cycles(20, self.words(publication=self.sequence, yaw__state=STATE["invalid"], yaw__value_mdeg=99))
        self.expect("none", None)
        self.frames(1)
        self.expect("none", -1500)

    def test_the_level_grows_while_nothing_comes(self):
        self.start(diAngleRate_mdeg_s=2865)
        self.assertEqual((self.block["stYaw"]["diLevel"], self.block["stYaw"]["diAge_ms"]), (300 + 230, 80))
        self.cycles(140, self.words())
        self.assertEqual((self.block["stYaw"]["diLevel"], self.block["stYaw"]["diAge_ms"]), (300 + 631, 220))
        self.cycles(20, self.words(), diAngleLimit_mdeg=300 + 687)  # 240 ms: 687.6 mdeg
        self.expect("none", None)

    def test_silence_is_not_used_past_the_watchdog(self):
        self.start(diAngleLimit_mdeg=100000)
        self.cycles(200, self.words())  # 280 ms
        self.expect("none", -1500)
        self.cycles(20, self.words())
        self.expect("silent", None)

    def test_no_value_looks_like_straight(self):
        self.start(xSubstitute=False, diAngleSubstitute_mdeg=0)
        self.frames(1, yaw__state=STATE["invalid"])
        self.expect("none", None)
        self.frames(1, {"xSubstitute": True, "diAngleSubstitute_mdeg": 7}, yaw__state=STATE["invalid"])
        self.assertEqual((self.block["stYaw"]["diValue"], self.block["stYaw"]["xUsable"]), (7, False))

    def test_limits_at_the_ends_of_their_type(self):
        for change, limit, usable in (({"yaw__protection_mdeg": NO_BOUND}, NO_BOUND, False),
                                      ({"yaw__protection_mdeg": NO_BOUND - 1}, NO_BOUND, True),
                                      ({"yaw__protection_mdeg": 300}, NO_BOUND, True),
                                      ({"yaw__protection_mdeg": 0}, -1, False),
                                      ({"yaw__protection_mdeg": 0}, -2**31, False)):
            self.setUp()
            self.frames(5, {"diAngleLimit_mdeg": limit, "diAngleRate_mdeg_s": 0}, **change)
            self.assertEqual(self.block["stYaw"]["xUsable"], usable, (change, limit))

    def test_rates_and_times_that_make_no_sense(self):
        for name, values in (("diAngleRate_mdeg_s", (-1, -2**31, 1000001, 2**31 - 1)), ("tWatchdog", (0, -1)),
                             ("diLatency_ms", ())):
            for value in values:
                self.setUp()
                self.frames(6, {name: value})
                self.assertFalse(self.block["stYaw"]["xUsable"], (name, value))

    def test_an_old_image_at_the_start_is_not_fresh(self):
        self.sequence, self.publication = 77, 77
        self.cycles(400, self.words())
        self.assertFalse(self.block["xAlive"])
        self.expect("silent", None)
        self.frames(3)
        self.expect("starting", None)
        self.frames(1)
        self.expect("none", -1500)

    def test_old_images_in_turn_from_the_start(self):
        self.sequence = 9
        self.old_images(3, 2000)
        self.expect("starting", None)
        self.assertFalse(self.block["xAlive"])

    # The rest of what it does

    def test_before_anything_has_come(self):
        self.cycles(20, [0] * LONGEST)
        self.expect("version", None)

    def test_good_images(self):
        self.start()
        self.assertTrue(self.block["xRelease"])
        self.assertEqual(self.block["dwUsable"], 0x7F)
        self.assertEqual(self.block["stLeftFront"]["diValue"], 2100)
        self.assertEqual(self.block["udiVerdict"], STATE["valid"])
        self.assertEqual(self.block["diByteOrder"], 1)

    def test_images_after_a_silence_may_have_waited(self):
        self.start()
        self.cycles(400, self.words())
        self.frames(3)
        self.expect("starting", None)
        self.frames(1)
        self.expect("none", -1500)

    def test_damage(self):
        self.start(diAngleLimit_mdeg=100000)
        for word in (3, 13, len(WORDS[self.version]) - 1):
            words = self.words(self.sequence + 1)
            words[word] ^= 1 << 9
            self.cycles(20, words)
            self.expect("crc", -1500)
        self.cycles(900, words)
        self.expect("crc", None)

    def test_other_settings(self):
        self.start(dwConfigCrc=0xC0FFEE)
        self.frames(1, config_crc32=0xBAD)
        self.expect("config", None)
        self.frames(3)
        self.expect("starting", None)
        self.frames(1)
        self.expect("none", -1500)

    def test_old_images_in_turn(self):
        for buffers in (2, 3):
            self.setUp()
            self.frames(9, {"diAngleLimit_mdeg": 100000})
            self.old_images(buffers, 400)
            self.assertFalse(self.block["xAlive"])
            self.assertFalse(self.block["xRelease"])

    def test_a_sequence_that_begins_anew(self):
        self.frames(9)
        self.sequence, self.publication = 3, 3  # the images of 1 to 3 were missed
        self.frames(3)
        self.assertFalse(self.block["xAlive"])
        self.frames(1, yaw__value_mdeg=-1600)
        self.expect("none", -1600)

    def test_a_sequence_with_gaps(self):
        self.start()
        self.sequence += 1000
        self.frames(1, yaw__value_mdeg=-1600)
        self.expect("none", -1600)

    def test_values_that_are_held_age_and_end(self):
        for state in ("degraded", "held"):
            self.setUp()
            self.start(diAngleLimit_mdeg=100000)
            self.frames(4, yaw__state=STATE[state], yaw__value_mdeg=99)
            self.expect("none", -1500)
            self.assertTrue(self.block["stYaw"]["xHeld"])
            self.assertEqual(self.block["stYaw"]["diAge_ms"], 480)
            self.frames(1, yaw__state=STATE[state], yaw__value_mdeg=99)
            self.expect("none", None)

    def test_without_hold_nothing_is_held(self):
        self.start(tHold=0)
        self.frames(1, yaw__state=STATE["held"])
        self.expect("none", None)

    def test_a_worse_level_is_taken_over(self):
        self.start(diAngleRate_mdeg_s=0)
        self.frames(1, yaw__state=STATE["held"], yaw__protection_mdeg=900)
        self.assertEqual(self.block["stYaw"]["diLevel"], 900)
        self.frames(1, yaw__state=STATE["held"], yaw__protection_mdeg=500)
        self.assertEqual(self.block["stYaw"]["diLevel"], 900)

    def test_every_channel_has_its_own_value_and_limit(self):
        values = {f"{member}__value_{unit_of(member)}": 10 + i for i, member in enumerate(OUTPUTS.values())}
        limits = {"mdeg": 1000, "mm": 100}
        self.frames(4, {"diAngleRate_mdeg_s": 0, "diDistanceRate_mm_s": 0}, **values)
        for q, (wrong, member) in enumerate(OUTPUTS.items()):
            level = f"{member}__protection_{unit_of(member)}"
            self.frames(1, **values, **{level: limits[unit_of(member)]})
            self.assertEqual([self.block[output]["diValue"] for output in OUTPUTS], list(range(10, 17)))
            self.assertTrue(self.block["xRelease"])
            self.frames(1, {"dwNeeded": 0x7F}, **values, **{level: limits[unit_of(member)] + 1})
            self.assertEqual([output for output in OUTPUTS if not self.block[output]["xUsable"]], [wrong])
            self.assertFalse(self.block["xRelease"])
            self.frames(1, {"dwNeeded": 0x7F & ~(1 << q)}, **values, **{level: limits[unit_of(member)] + 1})
            self.assertTrue(self.block["xRelease"])

    def test_what_nothing_needs_is_never_released(self):
        for needed in (0, 0x80, 0xFF):
            self.frames(5, {"dwNeeded": needed})
            self.assertFalse(self.block["xRelease"])

    def test_degraded_within_the_limit_when_asked_for(self):
        self.frames(4, {"xTakeDegraded": True}, yaw__state=STATE["degraded"])
        self.expect("none", -1500)
        self.frames(1, yaw__state=STATE["degraded"], yaw__protection_mdeg=1001)
        self.expect("none", None)

    def test_other_version(self):
        self.frames(4, version=3)
        self.expect("version", None)


class FunctionBlockOfImage1(FunctionBlock):
    version = 1


class Image2(Block):
    """What image 1 cannot tell."""

    def test_publications_without_frames(self):
        self.start()
        for _ in range(5):
            self.publication += 1
            self.cycles(100, self.words(publication=self.publication, yaw__state=STATE["held"]))
        self.expect("frames", None)

    def test_latency_counts(self):
        self.frames(4, latency_ms=100)
        self.assertEqual((self.block["stYaw"]["diLevel"], self.block["stYaw"]["diAge_ms"]), (300 + 516, 180))
        self.setUp()
        self.frames(6, latency_ms=300)
        self.assertFalse(self.block["xAlive"])
        for latency in (0xFFFFFFFF, 0xFFFFFFFE, 60000):
            self.setUp()
            self.frames(6, {"diLatency_ms": 40}, latency_ms=latency)
            self.assertEqual(self.block["xAlive"], latency == 0xFFFFFFFF)


MOTION_ROWS = description.image_words(3, STRUCTS)


def motion_words(sequence=1, **changes):
    """The words of a motion image with a measured pose, but for `changes`."""
    values = {word.path: 0 for word in MOTION_ROWS}
    values |= {"struct_size": 4 * len(MOTION_ROWS), "version": 3, "sequence": sequence, "publication": sequence,
               "config_crc32": 0xC0FFEE, "run": 0xA1, "told_by": 1, "along_state": 3, "travel_mm": 1234,
               "travel_protection_mm": 60, "speed_mm_s": -250, "speed_protection_mm_s": 90, "latency_ms": 20}
    values |= changes
    codes = "".join(description.TYPES[word.type][2] for word in MOTION_ROWS)
    raw = struct.pack("<" + codes, *(values[word.path] for word in MOTION_ROWS))
    words = list(struct.unpack(f"<{len(MOTION_ROWS)}I", raw))
    words[description.crc_word(MOTION_ROWS)] = description.crc_of(description.crc_bytes(raw, 3),
                                                                  description.POLYNOMIAL[3])
    return words + [0xDEAD] * (LONGEST - len(words))


class MotionBlock(unittest.TestCase):
    """FB_PoseWallMotion, and a bus that shows it motion images."""

    def setUp(self):
        self.run_st = structured_text_run.Controller(PROGRAM)
        self.block = self.run_st.make("FB_PoseWallMotion")
        self.sequence = 0

    def cycles(self, for_ms, words, **inputs):
        for _ in range(for_ms // CYCLE_MS):
            self.run_st.now_ms += CYCLE_MS
            self.run_st.call(self.block, adwImage=list(words), **inputs)

    def frames(self, count, inputs=None, **changes):
        for _ in range(count):
            self.sequence += 1
            self.cycles(100, motion_words(self.sequence, **changes), **(inputs or {}))

    def expect(self, fault, travel, speed=-250):
        """What may be acted on; None where nothing may."""
        speed = None if travel is None and speed == -250 else speed
        found = self.block
        self.assertEqual([name for name, number in FAULT.items() if number == found["udiFault"]], [fault])
        for usable, output, level, value in (("xTravelUsable", "diTravel_mm", "diTravelLevel_mm", travel),
                                             ("xSpeedUsable", "diSpeed_mm_s", "diSpeedLevel_mm_s", speed)):
            self.assertEqual((found[usable], found[output]), (value is not None, NO_VALUE if value is None else value))
            self.assertEqual(found[level] == NO_BOUND, value is None)

    def test_is_unusable_before_its_first_call(self):
        self.assertFalse(self.block["xTravelUsable"] or self.block["xSpeedUsable"])
        self.assertEqual((self.block["diTravel_mm"], self.block["diTravelLevel_mm"]), (NO_VALUE, NO_BOUND))

    def test_decodes_every_member(self):
        rng = random.Random(3)
        words = [rng.getrandbits(32) for _ in range(LONGEST)]
        image = self.run_st.make("ST_PoseWallMotionImage")
        self.run_st.function("F_PoseWallDecodeMotion", adwImage=words, stImage=image)
        raw = struct.pack(f"<{len(MOTION_ROWS)}I", *words[:len(MOTION_ROWS)])
        self.assertEqual({word.path: image[word.path] for word in MOTION_ROWS}, description.unpack_image(raw, 3))

    def test_frames_that_rise_are_used(self):
        self.frames(3)
        self.expect("starting", None)
        self.frames(1)
        self.expect("none", 1234)
        self.assertEqual((self.block["diTravelLevel_mm"], self.block["diSpeedLevel_mm_s"]), (60, 90))
        self.assertEqual(self.block["diAge_ms"], 80 + 20)
        self.assertEqual(self.block["stImage"]["run"], 0xA1)

    def test_every_order_of_bytes(self):
        for order in (1, 2, 3, 4):
            self.setUp()
            for sequence in range(1, 6):
                swapped = [self.run_st.function("F_PoseWallSwap", dwWord=word, diOrder=order)
                           for word in motion_words(sequence)]
                self.cycles(100, swapped)
            self.assertEqual(self.block["diByteOrder"], order)
            self.expect("none", 1234)

    def test_what_is_worse_is_obeyed_at_once(self):
        for change, travel, speed in (({"run": 0}, None, None), ({"along_state": 0}, None, None),
                                      ({"along_state": 4}, None, None), ({"told_by": 2}, None, None),
                                      ({"travel_mm": NO_VALUE}, None, -251),
                                      ({"travel_protection_mm": NO_BOUND}, None, -251),
                                      ({"travel_protection_mm": 1001}, None, -251),
                                      ({"travel_protection_mm": -1}, None, -251),
                                      ({"speed_mm_s": NO_VALUE}, 1234, None),
                                      ({"speed_protection_mm_s": 501}, 1234, None),
                                      ({"speed_protection_mm_s": NO_BOUND}, 1234, None)):
            self.setUp()
            self.frames(5)
            speed_too = {} if "speed_mm_s" in change else {"speed_mm_s": -251}
            self.cycles(20, motion_words(self.sequence, publication=self.sequence + 1, **speed_too, **change))
            self.expect("none", travel, speed)

    def test_other_images_damage_and_settings(self):
        self.frames(5, {"dwConfigCrc": 0xC0FFEE})
        self.expect("none", 1234)
        for words, fault in ((image_words(6), "version"), ([0] * LONGEST, "version")):
            self.cycles(20, words)
            self.assertEqual(self.block["udiFault"], FAULT[fault])
        torn = motion_words(6)
        torn[16] ^= 1
        self.cycles(20, torn)
        self.assertEqual(self.block["udiFault"], FAULT["crc"])
        self.assertEqual(self.block["diTravel_mm"], 1234, "of the last good one, still in its time")
        self.cycles(20, motion_words(7), dwConfigCrc=1)
        self.expect("config", None)
        self.sequence = 7
        self.frames(3, {"dwConfigCrc": 0xC0FFEE})
        self.expect("starting", None)

    def test_silence_on_the_bus(self):
        self.frames(5)
        self.cycles(180, motion_words(self.sequence))  # 260 ms and the latency
        self.expect("none", 1234)
        self.cycles(20, motion_words(self.sequence))
        self.expect("frames", None)
        self.cycles(40, motion_words(self.sequence))
        self.expect("silent", None)
        self.frames(3)
        self.expect("starting", None)
        self.frames(1)
        self.expect("none", 1234)

    def test_a_sequence_that_falls_begins_anew(self):
        self.frames(5)
        self.sequence = 1
        self.frames(1)
        self.expect("starting", None)
        self.frames(3)
        self.expect("none", 1234)

    def test_a_new_run_is_told_once(self):
        self.frames(3)
        self.assertFalse(self.block["xNewRun"])
        self.sequence += 1
        self.cycles(20, motion_words(self.sequence))
        self.assertTrue(self.block["xNewRun"], "the first is new")
        self.cycles(80, motion_words(self.sequence))
        self.assertFalse(self.block["xNewRun"])
        self.frames(2, run=0)
        self.assertFalse(self.block["xNewRun"])
        self.frames(1)
        self.assertFalse(self.block["xNewRun"], "the same as before")
        self.sequence += 1
        self.cycles(20, motion_words(self.sequence, run=0xB2))
        self.assertTrue(self.block["xNewRun"])
        self.cycles(20, motion_words(self.sequence, run=0xB2))
        self.assertFalse(self.block["xNewRun"])


if __name__ == "__main__":
    unittest.main()
