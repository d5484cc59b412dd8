#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""FB_PoseWallStop as plain text, run by structured_text_run.py. It permits driving only under a heartbeat that goes on
by small steps. Nothing else does: no flipped bit, no old image alone or in rings, no fall, no gap, no queue, no frozen
heartbeat, no other settings, no old frame. What is worse is obeyed at once. And registers become words.

usage: plc_stop_test.py ROOT"""

import copy
import pathlib
import random
import struct
import sys
import unittest

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT = pathlib.Path(sys.argv.pop(1))
sys.path[:0] = [str(ROOT / "tools/apps/plc"), str(pathlib.Path(__file__).parent)]

import image_description as description  # noqa: E402  pylint: disable=wrong-import-position
import structured_text  # noqa: E402  pylint: disable=wrong-import-position
import structured_text_run  # noqa: E402  pylint: disable=wrong-import-position

PROGRAM = structured_text.Program((ROOT / "tools/apps/plc/FB_PoseWall.st").read_text(encoding="utf-8"))
HEADER = (ROOT / "include/pose_wall_planar_stop.h").read_text(encoding="utf-8")
VERSION = 4
ROWS = description.image_words(VERSION)
LONGEST = len(description.image_words(2))
FAULT = {"none": 0, "silent": 1, "version": 2, "crc": 3, "config": 4, "starting": 5, "frames": 6, "old": 7}
STATES = ("xStop", "xSlow", "xGo")
STOP, SLOW, GO = 0, 1, 2
CYCLE_MS = 20
SETTINGS = 0xC0FFEE
RISES = 64  # the block's default
RINGS = (2, 3, 5, 16, 63, 64)  # stop_campaign.c has all of them
UNKNOWN_AGE = 0xFFFFFFFF


def stop_words(heartbeat, state=GO, **changes):
    """The words of an image as the library fills it, by a stop that answers once a cycle; and what lies behind them."""
    values = {word.path: 0 for word in ROWS}
    values |= {"struct_size": 4 * len(ROWS), "version": VERSION, "heartbeat": heartbeat % 2**32, "state": state,
               "answered_ms": heartbeat * CYCLE_MS % 2**32, "settings_crc32": SETTINGS,
               "allowed_speed_mm_s": (0, 300, 1000, 1000)[min(state, 3)], "age_ms": 80}
    values |= changes
    codes = "".join(description.TYPES[word.type][2] for word in ROWS)
    raw = struct.pack("<" + codes, *(values[word.path] for word in ROWS))
    words = list(struct.unpack(f"<{len(ROWS)}I", raw))
    words[description.crc_word(ROWS)] = description.crc_of(description.crc_bytes(raw, VERSION),
                                                           description.POLYNOMIAL[VERSION])
    return words + [0xDEAD] * (LONGEST - len(words))


class Bus(unittest.TestCase):
    """An instance, and a bus that shows it images of a stop."""

    def setUp(self):
        self.run_st = structured_text_run.Controller(PROGRAM)
        self.block = self.run_st.make("FB_PoseWallStop")
        self.beat = 2**32 - 70  # runs over soon

    def cycle(self, words, **inputs):
        self.run_st.now_ms += CYCLE_MS
        self.run_st.call(self.block, adwImage=list(words), **({"dwSettingsCrc": SETTINGS} | inputs))

    def show(self, heartbeat, state=GO, inputs=None, **changes):
        self.cycle(stop_words(heartbeat, state, **changes), **(inputs or {}))

    def beats(self, count, state=GO, step=1, inputs=None, **changes):
        """So many cycles, each with a new heartbeat."""
        for _ in range(count):
            self.beat += step
            self.show(self.beat, state, inputs, **changes)

    started = {}

    def start(self, state=GO):
        """A block that this state has just been taken by. Only the first one of each state goes the long way."""
        self.setUp()
        if state not in self.started:
            self.beats(RISES + 1, state)
            self.started[state] = copy.deepcopy((self.block, self.run_st.now_ms, self.beat))
        self.block, self.run_st.now_ms, self.beat = copy.deepcopy(self.started[state])
        self.expect(state)

    def expect(self, state, fault="none"):
        found = [name for name in STATES if self.block[name]]
        self.assertEqual(found, [STATES[state]])
        self.assertEqual([name for name, number in FAULT.items() if number == self.block["udiFault"]], [fault])
        self.assertEqual(self.block["diAllowed_mm_s"] > 0, state != STOP)

    def permits(self):
        return self.block["xGo"] or self.block["xSlow"] or not self.block["xStop"] or self.block["diAllowed_mm_s"] > 0


class Text(unittest.TestCase):
    def test_states_are_those_of_the_header(self):
        states = description.read_enum(HEADER, "pose_wall_planar_stop_state")
        self.assertEqual(list(states.values()), [STOP, SLOW, GO])
        self.assertEqual([name.rsplit("_", 1)[1] for name in states], ["STOP", "SLOW", "GO"])

    def test_the_page_names_every_word_and_every_bit(self):
        page = (ROOT / "tools/apps/plc/README.md").read_text(encoding="utf-8")
        for at, word in enumerate(ROWS):
            self.assertIn(f"| {at} | {4 * at} | `{word.path}` |", page)
        reasons = description.read_enum(HEADER, "pose_wall_planar_stop_reason")
        self.assertEqual(len(reasons), description.read_define(HEADER, "POSE_WALL_PLANAR_STOP_REASON_COUNT"))
        for name, mask in reasons.items():
            short = name.removeprefix("POSE_WALL_PLANAR_STOP_R_").lower()
            self.assertIn(f"| {mask.bit_length() - 1} | 16#{mask:08X} | `{short}` |", page)


class Functions(unittest.TestCase):
    def setUp(self):
        self.run_st = structured_text_run.Controller(PROGRAM)
        self.random = random.Random(11)

    def test_registers_become_words_the_low_one_first(self):
        registers = [self.random.getrandbits(16) for _ in range(2 * LONGEST)]
        words = [0] * LONGEST
        self.run_st.function("F_PoseWallFromRegisters", awRegister=registers, adwImage=words)
        self.assertEqual(struct.pack(f"<{LONGEST}I", *words), struct.pack(f"<{2 * LONGEST}H", *registers))

    def test_steps_of_a_heartbeat(self):
        def step(before, after):
            return self.run_st.function("F_PoseWallStep", udiFrom=before % 2**32, udiTo=after % 2**32)
        edges = [0, 1, 2, 65534, 65535, 65536, 65537, 2**31 - 1, 2**31, 2**31 + 1, 2**32 - 1]
        for before in [*edges, *(self.random.getrandbits(32) for _ in range(200))]:
            for ahead in (0, 1, 32, 65535):
                self.assertEqual(step(before, before + ahead), ahead)
            for ahead in (65536, 65537, 131072, 2**31 - 1):
                self.assertEqual(step(before, before + ahead), 65536)
            for behind in (1, 2, 65535, 65536, 2**31):
                self.assertEqual(step(before, before - behind), -1, (before, behind))

    def test_decodes_every_member(self):
        words = [self.random.getrandbits(32) for _ in range(LONGEST)]
        image = self.run_st.make("ST_PoseWallStopImage")
        self.run_st.function("F_PoseWallDecodeStop", adwImage=words, stImage=image)
        raw = struct.pack(f"<{len(ROWS)}I", *words[:len(ROWS)])
        self.assertEqual({word.path: image[word.path] for word in ROWS}, description.unpack_image(raw, VERSION))


class Permission(Bus):
    def test_stops_before_its_first_call(self):
        self.expect(STOP, "silent")

    def test_permission_needs_a_heartbeat_that_goes_on(self):
        self.beats(RISES)
        self.expect(STOP, "starting")
        self.beats(1)
        self.expect(GO)
        self.assertEqual((self.block["diAllowed_mm_s"], self.block["diAge_ms"]), (1000, 80))
        self.beats(200, SLOW, step=5)  # over 2^32
        self.expect(SLOW)
        self.assertEqual(self.block["diAllowed_mm_s"], 300)
        self.beats(1, STOP)
        self.expect(STOP)
        self.beats(1)
        self.expect(GO)

    def test_every_order_of_bytes_and_registers(self):
        for order in (1, 2, 3, 4):
            self.setUp()
            for _ in range(RISES + 1):
                self.beat += 1
                self.cycle([self.run_st.function("F_PoseWallSwap", dwWord=word, diOrder=order)
                            for word in stop_words(self.beat)])
            self.assertEqual(self.block["diByteOrder"], order)
            self.expect(GO)
        raw = struct.pack(f"<{LONGEST}I", *stop_words(self.beat + 1))
        words = [0] * LONGEST
        self.run_st.function("F_PoseWallFromRegisters", awRegister=list(struct.unpack(f"<{2 * LONGEST}H", raw)),
                             adwImage=words)
        self.cycle(words)
        self.expect(GO)

    def test_under_an_old_heartbeat_it_only_becomes_worse(self):
        self.start()
        self.show(self.beat, GO, allowed_speed_mm_s=400)
        self.assertEqual(self.block["diAllowed_mm_s"], 400)
        self.show(self.beat, GO)
        self.assertEqual((self.block["xGo"], self.block["diAllowed_mm_s"]), (True, 400))
        self.show(self.beat, SLOW)
        self.expect(SLOW)
        self.show(self.beat, GO)
        self.expect(SLOW)
        self.assertEqual(self.block["diAllowed_mm_s"], 300)
        self.show(self.beat, STOP)
        self.expect(STOP)
        for state in (SLOW, GO):
            self.show(self.beat, state)
            self.expect(STOP)
        self.beats(1)
        self.expect(GO)

    def test_states_and_speeds_that_permit_nothing(self):
        for changes in ({"state": 3}, {"state": UNKNOWN_AGE}, {"allowed_speed_mm_s": 0}, {"allowed_speed_mm_s": -1},
                        {"state": SLOW, "allowed_speed_mm_s": 0}, {"state": STOP, "allowed_speed_mm_s": 500}):
            self.start()
            self.beat += 1
            self.cycle(stop_words(self.beat, **changes))
            self.expect(STOP)


class Stale(Bus):
    """Every one of these permitted driving while the stop was a single register."""

    def test_every_single_bit_that_flips(self):
        for told, further in ((STOP, 0), (STOP, 1), (SLOW, 1)):  # under the heartbeat of before, and the next one
            for bit in range(32 * len(ROWS)):
                self.start(told)
                words = stop_words(self.beat + further, told)
                words[bit // 32] ^= 1 << bit % 32
                self.cycle(words)
                self.assertFalse(self.permits(), bit)
                self.cycle(stop_words(self.beat + further, told))
                self.assertFalse(self.block["xGo"], bit)

    def test_torn_images(self):
        self.start(STOP)
        old, new = stop_words(self.beat - 3, GO), stop_words(self.beat + 1, STOP)
        for first, second in ((old, new), (new, old)):
            for at in range(1, len(ROWS)):
                self.cycle(first[:at] + second[at:])
                self.assertFalse(self.permits(), at)

    def test_old_images_in_turn_from_the_start(self):
        for size in RINGS:
            self.setUp()
            for turn in range(2 * RISES + 3 * size):
                self.show(1000 + turn % size)
                self.assertFalse(self.permits(), (size, turn))

    def test_old_images_in_turn_after_good_ones(self):
        for size in RINGS:
            self.start()
            for turn in range(2 * RISES + 3 * size):
                self.show(self.beat - size + 1 + turn % size)
                if turn % size == 0:
                    self.assertFalse(self.permits(), (size, turn))
                self.assertFalse(turn >= size and self.permits(), (size, turn))

    def test_old_images_that_nobody_read_in_turn_after_a_gap(self):
        for size in RINGS:
            self.start()
            for turn in range(2 * RISES + 3 * size):
                self.show(self.beat + 1000 + turn % size)
                self.assertFalse(self.permits(), (size, turn))

    def test_the_old_words_of_the_register(self):
        for beats in ((7, 8, 9, 10), (7, 8, 9, 10, 11), (1, 40, 80, 120), (0, 60, 120, 180),
                      (0, 50, 100, 150, 200, 250)):
            self.setUp()
            for _ in range(200):
                for beat in beats:
                    self.show(beat)
                    self.assertFalse(self.permits(), beats)

    def test_old_images_in_any_order(self):
        rng = random.Random(5)
        for size in (2, 3, 5, 17, RISES):
            for is_started in (False, True):
                self.setUp()
                if is_started:
                    self.start(STOP)
                kept = [self.beat - 4 * i for i in range(size)]
                for _ in range(1000):
                    self.show(rng.choice(kept))
                    self.assertFalse(self.permits(), size)

    def test_a_heartbeat_that_jumps_back(self):
        for back in (1, 2, 31, 32, 33, 1000, 2**16, 2**31 - 1, 2**31):
            self.start()
            newest = self.beat
            self.show(newest - back)
            self.expect(STOP, "old")
            for i in range(3 * RISES):  # whatever follows from there
                if i + 1 < back:
                    self.show(newest - back + 1 + i)
                    self.assertFalse(self.permits(), back)
            self.beats(RISES - 1)
            self.assertFalse(self.permits(), "after a fall as many are needed as at the start")

    def test_a_person_confirms_a_restart(self):
        self.start()
        self.beat -= 10 * RISES
        self.beats(3 * RISES)
        self.expect(STOP, "old")
        self.beats(1, inputs={"xRestart": True})
        self.expect(STOP, "starting")
        self.beats(RISES - 1, inputs={"xRestart": True})
        self.expect(STOP, "starting")
        self.beats(1, inputs={"xRestart": True})
        self.expect(GO)
        self.beat -= 10 * RISES
        self.beats(3 * RISES, inputs={"xRestart": True})
        self.expect(STOP, "old")  # a button that is stuck confirms once

    def test_a_heartbeat_that_stands_stops(self):
        self.start()
        for _ in range(200 // CYCLE_MS - 1):
            self.show(self.beat)
            self.expect(GO)
        self.show(self.beat)
        self.expect(STOP, "silent")
        self.beat += 200 // CYCLE_MS  # the answers went on meanwhile
        self.beats(RISES)
        self.expect(STOP, "starting")
        self.beats(1)
        self.expect(GO)

    def test_one_image_for_ever_permits_nothing(self):
        for _ in range(500):
            self.show(77)
            self.assertFalse(self.permits())

    def test_images_that_wait_in_a_queue(self):
        for behind_ms, state in ((160, GO), (240, STOP), (5000, STOP)):
            self.start()
            self.run_st.now_ms += behind_ms - 160
            for _ in range(160 // CYCLE_MS):
                self.show(self.beat)
            self.beats(3 * RISES)  # one by one, as they were given
            self.expect(state, "none" if state == GO else "old")
        self.start()
        for late_ms in range(0, 1000, CYCLE_MS):  # a bus that shows them slower than they are given
            self.show(self.beat)
            self.beats(1)
            self.assertEqual(self.block["xGo"], late_ms + CYCLE_MS < 200, late_ms)
        self.beat += 1000 // CYCLE_MS
        self.beats(1)
        self.expect(STOP, "starting")  # in time again
        self.beats(RISES)
        self.expect(GO)

    def test_clocks_that_drift_apart(self):
        self.start()
        for ppm in (-1000, 1000):
            for second in range(30):
                self.run_st.now_ms += ppm // 1000
                self.beats(1000 // CYCLE_MS)
                self.expect(GO)
            self.assertLess(self.block["diAge_ms"], 100, second)

    def test_a_clock_that_is_set_back_begins_anew(self):
        self.start()
        self.beats(1, answered_ms=(self.beat * CYCLE_MS - 3600_000) % 2**32)
        self.expect(STOP, "starting")

    def test_gaps(self):
        self.start()
        self.beats(10, step=32)
        self.expect(GO)
        for step in (33, 34, 1000, 65535, 65536, 2**31 - 1):
            self.start()
            self.beats(1, step=step)
            self.expect(STOP, "starting")
            self.beats(RISES - 1)
            self.expect(STOP, "starting")
            self.beats(1)
            self.expect(GO)
        for most in (0, -1, -2**31, 65536, 2**31 - 1):  # what makes no sense is no wider
            self.setUp()
            self.beats(3 * RISES, step=65536 if most > 0 else 1, inputs={"diStepMost": most})
            self.assertFalse(self.permits(), most)

    def test_other_settings(self):
        self.start()
        self.beats(1, settings_crc32=SETTINGS + 1)
        self.expect(STOP, "config")
        self.beats(RISES - 1)
        self.expect(STOP, "starting")
        self.beats(1)
        self.expect(GO)
        self.start()
        self.beats(1, settings_crc32=1, inputs={"dwSettingsCrc": 0})
        self.expect(GO)

    def test_a_frame_that_is_old(self):
        for age, state, fault in ((480, GO, "none"), (499, GO, "none"), (500, STOP, "frames"), (60000, STOP, "frames"),
                                  (UNKNOWN_AGE, STOP, "frames")):
            self.start()
            self.beats(1, age_ms=age)
            self.expect(state, fault)
        self.start()
        self.beats(1, age_ms=450)
        self.show(self.beat, age_ms=450)
        self.show(self.beat, age_ms=450)
        self.expect(GO)
        self.show(self.beat, age_ms=450)  # 60 ms here
        self.expect(STOP, "frames")
        self.beats(1)
        self.expect(GO)
        self.show(self.beat, age_ms=600)  # told older under the same heartbeat
        self.expect(STOP, "frames")

    def test_times_that_make_no_sense(self):
        for name in ("tWatchdog", "tAgeMost"):
            for time in (0, -1, -2**31):
                self.setUp()
                self.beats(2 * RISES, inputs={name: time})
                self.assertFalse(self.permits(), (name, time))
        self.setUp()
        self.beats(RISES + 1)
        for _ in range(70000 // CYCLE_MS):
            self.show(self.beat, inputs={"tWatchdog": 2**31 - 1, "tAgeMost": 2**31 - 1})
        self.assertFalse(self.permits(), "60 s at most")

    def test_few_rises_at_least(self):
        for rises in (-5, 0, 3):
            self.setUp()
            self.beats(3, inputs={"diRises": rises})
            self.expect(STOP, "starting")
            self.beats(1, inputs={"diRises": rises})
            self.expect(GO)

    def test_of_a_daemon_without_a_stop_nothing_is_permitted(self):
        for words in ([0] * LONGEST, [0xFFFFFFFF] * LONGEST):
            for _ in range(100):
                self.cycle(words)
                self.expect(STOP, "version")


if __name__ == "__main__":
    unittest.main()
