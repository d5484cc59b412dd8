#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Modbus TCP of pose_walld, read by a client that others wrote (pymodbus). Of 10,000 images under load none is torn.
The structured text of the project decodes what was read, and decides on the obstacle stop. Writes and wrong ranges get
exceptions; one controller writes commands. A client that sends garbage, half a request or nothing holds up nobody.

usage: modbus_peer.py ROOT POSE_WALL POSE_WALLD"""

import pathlib
import re
import socket
import struct
import subprocess
import sys
import time
import unittest
import zlib

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT, POSE_WALL, POSE_WALLD = pathlib.Path(sys.argv.pop(1)), sys.argv.pop(1), sys.argv.pop(1)
sys.path[:0] = [str(ROOT / "tests/live"), str(ROOT / "tests/checks"), str(ROOT / "tools/apps/plc")]

import live_peer  # noqa: E402  pylint: disable=wrong-import-position

live_peer.need("python3-pymodbus python3-serial-asyncio", modules=("pymodbus", "serial_asyncio"))

import image_description as description  # noqa: E402  pylint: disable=wrong-import-position
import structured_text  # noqa: E402  pylint: disable=wrong-import-position
import structured_text_run  # noqa: E402  pylint: disable=wrong-import-position
from pymodbus.client import ModbusTcpClient  # noqa: E402  pylint: disable=wrong-import-position

IMAGES = 10_000  # as many of each version
PLACE = {1: (0, 120), 2: (1000, 124), 3: (2000, 66), 4: (3000, 26)}  # version: first register, registers
STRUCTS = description.read_structs()
WORDS = {version: description.image_words(version, STRUCTS) for version in PLACE}


def bytes_of(registers):
    return struct.pack(f"<{len(registers)}H", *registers)


def is_torn(raw, version):
    """By a sum of our own: zlib's for image 1, the described polynomial for image 2."""
    at = 4 * description.crc_word(WORDS[version])
    told = struct.unpack_from("<I", raw, at)[0]
    rest = raw[:at] + raw[at + 4:]
    if version == 1:
        return told != zlib.crc32(rest)
    return told != description.crc_of(description.crc_bytes(raw, version), description.POLYNOMIAL[version])


class Modbus(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.port = live_peer.free_port()
        road = live_peer.simulated_road(POSE_WALL)
        cls.daemon = live_peer.Program(*live_peer.replay_words(POSE_WALLD, road, "--modbus", f"127.0.0.1:{cls.port}"))
        assert cls.daemon.says("runtime: measures"), cls.daemon.log()

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()

    def client(self):
        client = ModbusTcpClient("127.0.0.1", port=self.port)
        self.assertTrue(client.connect())
        self.addCleanup(client.close)
        return client

    def read(self, client, version):
        first, count = PLACE[version]
        answer = client.read_input_registers(first, count, slave=1)
        self.assertFalse(answer.isError(), answer)
        return bytes_of(answer.registers)

    def raw(self, request):
        connection = socket.create_connection(("127.0.0.1", self.port), 5)
        self.addCleanup(connection.close)
        connection.sendall(request)
        return connection

    def test_ten_thousand_images_none_torn(self):
        client, torn, sequences = self.client(), 0, set()
        begin = time.monotonic()
        for i in range(IMAGES):
            version = 1 + i % 3  # this daemon has no stop
            raw = self.read(client, version)
            torn += is_torn(raw, version)
            sequences.add(struct.unpack_from("<I", raw, 12)[0])
        took_s = time.monotonic() - begin
        print(f"{IMAGES} images in {took_s:.1f} s ({1e6 * took_s / IMAGES:.0f} us each), {torn} torn, "
              f"{len(sequences)} frames seen")
        self.assertEqual(torn, 0)
        self.assertGreater(len(sequences), 5)

    def test_the_structured_text_decodes_what_was_read(self):
        program = structured_text.Program((ROOT / "tools/apps/plc/FB_PoseWall.st").read_text(encoding="utf-8"))
        controller = structured_text_run.Controller(program)
        block = controller.make("FB_PoseWall")
        client = self.client()
        released, values = False, []
        for _ in range(100):
            raw = self.read(client, 2)
            words = list(struct.unpack(f"<{len(WORDS[2])}I", raw))
            controller.call(block, adwImage=words, dwNeeded=0x7F, xTakeDegraded=True, diAngleLimit_mdeg=5000,
                            diDistanceLimit_mm=500)
            controller.now_ms += 50
            if block["stYaw"]["xUsable"]:
                values.append(block["stYaw"]["diValue"])
                at = 4 * [word.path for word in WORDS[2]].index("yaw.value_mdeg")
                self.assertEqual(block["stYaw"]["diValue"], struct.unpack_from("<i", raw, at)[0])
                released = True
            time.sleep(0.05)
        self.assertTrue(released, "the block used no image")
        self.assertGreater(len(set(values)), 3, "frames come")

    def test_without_a_stop_its_registers_are_no_image(self):
        client = self.client()
        for _ in range(3):
            self.assertEqual(self.read(client, 4), bytes(52))

    def test_what_is_no_read_of_the_images_gets_an_exception(self):
        client = self.client()
        illegal_function, illegal_address, illegal_value = 1, 2, 3
        for answer in (client.write_register(0, 1, slave=1), client.write_coil(0, True, slave=1),
                       client.read_holding_registers(0, 10, slave=1), client.read_coils(0, 8, slave=1)):
            self.assertTrue(answer.isError())
            self.assertEqual(answer.exception_code, illegal_function)
        for first, count in ((1, 120), (120, 1), (119, 2), (999, 2), (1000, 125), (1124, 1), (65535, 1)):
            answer = client.read_input_registers(first, count, slave=1)
            self.assertTrue(answer.isError(), (first, count))
            self.assertEqual(answer.exception_code, illegal_address, (first, count))
        for count in (0, 126, 65535):
            connection = self.raw(struct.pack(">HHHBBHH", 7, 0, 6, 1, 4, 0, count))
            self.assertEqual(connection.recv(9)[-1], illegal_value, count)
        self.assertFalse(is_torn(self.read(client, 1), 1))

    def test_clients_that_misbehave_hold_up_nobody(self):
        half = self.raw(struct.pack(">HHHB", 1, 0, 6, 1))
        silent = self.raw(b"")
        garbage = self.raw(b"GET / HTTP/1.1\r\nHost: a\r\n\r\n")
        self.assertEqual(garbage.recv(100), b"", "it is closed")
        whole = self.raw(2 * struct.pack(">HHHBBHH", 9, 0, 6, 1, 4, 0, 2))
        answers = b""
        while len(answers) < 2 * 13:
            answers += whole.recv(100)
        self.assertEqual(len(answers), 2 * 13, "two requests in one packet get two answers")
        client = self.client()
        for _ in range(50):
            self.assertFalse(is_torn(self.read(client, 1), 1))
        half.sendall(struct.pack(">BHH", 4, 0, 120))
        self.assertEqual(half.recv(4)[:2], b"\x00\x01", "the other half came later")
        silent.close()

    def test_more_clients_than_places_close_the_one_that_is_silent_longest(self):
        first = self.raw(b"")
        others = [self.raw(b"") for _ in range(40)]
        self.assertEqual(first.recv(1), b"")
        client = self.client()
        self.assertFalse(is_torn(self.read(client, 2), 2))
        for other in others:
            other.close()

    def test_a_port_that_is_taken_is_named(self):
        road = live_peer.simulated_road(POSE_WALL)
        with live_peer.running(*live_peer.replay_words(POSE_WALLD, road, "--modbus", f"127.0.0.1:{self.port}")) as two:
            self.assertEqual(two.process.wait(live_peer.PATIENCE_S), 1)
            self.assertTrue(two.says(f"modbus: cannot listen at 127.0.0.1:{self.port}: Address already in use"))


class Commands(unittest.TestCase):
    """What the drive is told, as a controller writes it."""

    def test_the_stop_reckons_with_what_is_written(self):
        port, road = live_peer.free_port(), live_peer.simulated_road(POSE_WALL)
        daemon = live_peer.Program(*live_peer.replay_words(
            POSE_WALLD, road, "--set", "planar=map", "--set", "planar_motion=commanded",
            "--set", "planar_floor_z=-1.35", "--set", "planar_command_modbus=127.0.0.1", "--set", "status_every_s=1",
            "--modbus", f"127.0.0.1:{port}"))
        self.addCleanup(daemon.kill)
        self.assertTrue(daemon.says("127.0.0.1 alone can write commands of the drive"), daemon.log())
        client = ModbusTcpClient("127.0.0.1", port=port)
        self.assertTrue(client.connect())
        self.addCleanup(client.close)
        missing, counter = 1 << 4, 0

        def reasons():
            first, count = PLACE[4]
            return description.unpack_image(bytes_of(client.read_input_registers(first, count, slave=1).registers),
                                            4)["reasons"]

        def is_known():
            nonlocal counter
            counter += 1
            answer = client.write_registers(4000, [200, 2**16 - 50, counter], slave=1)
            self.assertFalse(answer.isError(), answer)
            return not reasons() & missing

        self.assertTrue(live_peer.becomes_true(lambda: reasons() & missing), daemon.log())
        self.assertTrue(live_peer.becomes_true(is_known), daemon.log())
        told = "command m/s 0.200; command rad/s -0.050"
        self.assertTrue(live_peer.becomes_true(lambda: is_known() and any(told in line for line in daemon.lines[-20:])))
        self.assertFalse(client.write_register(4000, 150, slave=1).isError())
        answer = client.write_registers(4000, [4000, 0, counter + 1], slave=1)
        self.assertEqual((answer.isError(), answer.exception_code), (True, 3))
        self.assertTrue(daemon.says("the newest command was refused"), daemon.log())
        self.assertTrue(live_peer.becomes_true(lambda: reasons() & missing), "from then on every motion is assumed")


class ObstacleStop(unittest.TestCase):
    """The stop as a controller reads it. The project's structured text decides on it."""

    def test_the_heartbeat_goes_on_and_ends_with_the_frames_and_with_the_daemon(self):
        port, road = live_peer.free_port(), live_peer.simulated_road(POSE_WALL)
        daemon = live_peer.Program(POSE_WALLD, "--config", road / "pose_wall.yaml", "--replay", road / "frames",
                                   "--step", "--set", "planar=map", "--modbus", f"127.0.0.1:{port}",
                                   stdin=subprocess.PIPE)
        self.addCleanup(daemon.kill)
        self.assertTrue(daemon.says("sink modbus"), daemon.log())
        client = ModbusTcpClient("127.0.0.1", port=port)
        self.assertTrue(client.connect())
        self.addCleanup(client.close)
        program = structured_text.Program((ROOT / "tools/apps/plc/FB_PoseWall.st").read_text(encoding="utf-8"))
        controller = structured_text_run.Controller(program)
        block = controller.make("FB_PoseWallStop")
        self.assertTrue(daemon.says("settings' CRC: 16#"), daemon.log())
        approved = int(re.findall(r"CRC: 16#([0-9A-F]{8}) \(dwSettingsCrc", daemon.log())[-1], 16)
        beats, stale, ages = set(), set(), []
        began = time.monotonic()
        daemon.process.stdin.write("\n")
        daemon.process.stdin.flush()
        first, count = PLACE[4]

        def is_all_told():
            return len(beats) > 200 and 1 in stale and max([0, *ages]) > 1000

        while not is_all_told() and time.monotonic() - began < live_peer.PATIENCE_S:
            answer = client.read_input_registers(first, count, slave=1)
            image = description.unpack_image(bytes_of(answer.registers), 4)
            self.assertFalse(is_torn(bytes_of(answer.registers), 4))
            words = [0] * 62
            controller.now_ms = int(1000 * (time.monotonic() - began))
            controller.function("F_PoseWallFromRegisters", awRegister=answer.registers + [0] * (124 - count),
                                adwImage=words)
            controller.call(block, adwImage=words, dwSettingsCrc=approved)
            beats.add(image["heartbeat"])
            stale.add(image["reasons"] & 1)
            if image["age_ms"] < 2**32 - 1:
                ages.append(image["age_ms"])
            self.assertEqual((image["state"], image["allowed_speed_mm_s"]), (0, 0), "one frame alone permits nothing")
            self.assertTrue(block["xStop"])
            time.sleep(0.01)
        self.assertGreater(len(beats), 200, "it goes on")
        self.assertLess(max(beats) - min(beats), 100 * (time.monotonic() - began), "by 100 a second at most")
        self.assertIn(1, stale, "the only frame is stale by now")
        self.assertGreater(max(ages), 1000)
        self.assertEqual(block["udiFault"], 6, "the daemon answers, without frames")
        self.assertEqual(block["stImage"]["settings_crc32"], approved)
        daemon.kill()
        controller.now_ms += 300
        controller.call(block, adwImage=words, dwSettingsCrc=approved)
        self.assertEqual((block["xStop"], block["udiFault"]), (True, 1), "silent")


if __name__ == "__main__":
    live_peer.main()
