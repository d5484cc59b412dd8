#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The edge of pose_walld for Foxglove and Lichtblick, by Foxglove's own client (@foxglove/ws-protocol). Under both
names of the protocol each channel comes, and each message is read by its schema with readers of others. Viewers that
take nothing, that break the protocol or that come from foreign pages hold up nobody. A stop takes less than a
second, and after a restart a viewer finds another session.

usage: foxglove_peer.py ROOT POSE_WALL POSE_WALLD NODE_MODULES"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT, POSE_WALL, POSE_WALLD, MODULES = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(4))
sys.path[:0] = [str(ROOT / "tests/live")]

import live_peer  # noqa: E402  pylint: disable=wrong-import-position
from viewer_socket import frame, handshake  # noqa: E402  pylint: disable=wrong-import-position

NAMES = ("foxglove.websocket.v1", "foxglove.sdk.v1")
# So many messages of each channel; the place comes where the machine is in a map.
WANTED = {"/pose_wall/result": 20, "/pose_wall/health": 2, "/pose_wall/pose": 10, "/pose_wall/transforms": 20,
          "/pose_wall/scene": 20, "/pose_wall/log": 2, "/pose_wall/points": 10, "/pose_wall/stop_state": 20, "/map": 1,
          "/pose_wall/stop_scene": 20, "/pose_wall/place_transform": 1}


def words(port, *more):
    return live_peer.replay_words(POSE_WALLD, live_peer.simulated_road(POSE_WALL), "--set",
                                  f"foxglove=127.0.0.1:{port}", "--set", "status_every_s=1", "--set", "planar=map",
                                  *more)


class Scripts:
    """The clients in a folder from which they find their packages."""

    def __init__(self):
        self.place = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        for name in ("foxglove_client.mjs", "channel_reader.mjs"):
            shutil.copy(ROOT / "tests/live/peer" / name, self.place.name)
        os.symlink(MODULES, pathlib.Path(self.place.name) / "node_modules")

    def start(self, port, seconds=2 * live_peer.PATIENCE_S, protocol=NAMES[0], how="", wanted=None):
        return subprocess.Popen(  # pylint: disable=consider-using-with
            ["node", "foxglove_client.mjs", f"ws://127.0.0.1:{port}", protocol, str(seconds), how,
             json.dumps(wanted or {})], text=True, cwd=self.place.name, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    @staticmethod
    def told(process):
        out, err = process.communicate(timeout=4 * live_peer.PATIENCE_S)
        assert out, err
        return json.loads(out.splitlines()[-1])


class Viewers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.port = live_peer.free_port()
        cls.daemon = live_peer.Program(*words(cls.port))
        cls.scripts = Scripts()
        assert cls.daemon.says("runtime: measures"), cls.daemon.log()

    @classmethod
    def tearDownClass(cls):
        viewer = cls.scripts.start(cls.port)
        viewer.stderr.readline()  # subscribed
        took_s, stopped = cls.daemon.stop(), time.time()
        print(f"stopped in {took_s:.2f} s")
        assert cls.daemon.process.returncode == 0, cls.daemon.log()
        assert stopped - 5 < cls.scripts.told(viewer)["closed_s"] < stopped + 1, "viewers see the end"

    def fact(self, name):
        return live_peer.fact(self.daemon, "sink foxglove", name)

    def test_each_message_is_read_by_its_schema_under_both_names(self):
        for name in NAMES:
            told = self.scripts.told(self.scripts.start(self.port, protocol=name, wanted=WANTED))
            self.assertEqual((told["protocol"], told["error"], told["statuses"]), (name, "", []))
            self.assertRegex(told["server"]["name"], r"^pose_walld \d")
            self.assertEqual(told["server"]["capabilities"], [], "nothing can be changed")
            channels = told["channels"]
            for topic, channel in channels.items():
                self.assertEqual(channel["faults"], [], topic)
            for topic, count in WANTED.items():
                self.assertGreaterEqual(channels[topic]["messages"], count, topic)
            clouds = [c for topic, c in channels.items() if topic not in WANTED and c["schema"].endswith("PointCloud2")]
            self.assertEqual(len(clouds), 1)
            self.assertGreater(clouds[0]["messages"], 0)
            self.assertGreater(clouds[0]["newest"]["data"]["length"], 65536)
            self.assertEqual(told["orders"], 0, "each channel in the order of time")
            print(f"{name}: " + ", ".join(f"{topic} {c['messages']}" for topic, c in sorted(channels.items())))

    def test_the_picture_is_that_of_the_values(self):
        channels = self.scripts.told(self.scripts.start(self.port, wanted={"/pose_wall/pose": 10}))["channels"]
        result = channels["/pose_wall/result"]["newest"]
        pose = channels["/pose_wall/pose"]["newest"]
        self.assertEqual(pose["frame_id"], "base_link_road")
        # z of base over the floor, and y from the middle of the road.
        walls = result["planes"]["left_wall"]["distance_m"], result["planes"]["right_wall"]["distance_m"]
        self.assertAlmostEqual(pose["pose"]["position"]["z"], result["planes"]["floor"]["distance_m"], delta=0.2)
        self.assertAlmostEqual(pose["pose"]["position"]["y"], (walls[1] - walls[0]) / 2, delta=0.2)
        turned = {t["child_frame_id"]: t for t in channels["/pose_wall/transforms"]["newest"]["transforms"]}
        self.assertTrue({"base_link_road", "base_link_level"} <= set(turned) or list(turned) == ["base_link"], turned)

    def test_who_takes_nothing_and_who_is_rude_hold_up_nobody(self):
        stalled = self.scripts.start(self.port, how="stall")
        self.assertIn("subscribed", stalled.stderr.readline())
        rude = []
        for junk in (b"\x00" * 300, frame(b"{"), frame(b"[]"), frame(b"\xff\xff"), frame(b"x", 2),
                     frame(b"{}", 1, 1 << 40),
                     frame(b'{"op":"subscribe","subscriptions":[{"id":1,"channelId":999}]}'),
                     frame(b'{"op":"subscribe","subscriptions":[{"id":-1,"channelId":1e99}]}'),
                     frame(b'{"op":"setParameters","parameters":[]}'), frame(b"[" * 60000)):
            status, connection = handshake(self.port)
            self.assertEqual(status, 101)
            connection.sendall(junk)
            rude.append(connection)
        told = self.scripts.told(self.scripts.start(self.port, wanted=WANTED))
        for topic, count in WANTED.items():
            self.assertGreaterEqual(told["channels"][topic]["messages"], count, topic)
        self.assertEqual([t for t, c in told["channels"].items() if c["faults"]], [])
        for connection in rude:
            connection.close()
        self.assertTrue(live_peer.becomes_true(lambda: self.fact("requests refused") >= 4), self.daemon.log())
        self.assertTrue(live_peer.becomes_true(lambda: self.fact("viewers cut off") >= 1), self.daemon.log())
        stalled.kill()
        stalled.communicate()
        self.assertTrue(live_peer.becomes_true(lambda: self.fact("viewers") == 0), self.daemon.log())

    def test_requests_that_nobody_serves_are_refused_in_words(self):
        for request, why in ((b'{"op":"advertise","channels":[]}', "knows subscribe and unsubscribe alone"),
                             (b"{", "no JSON"), (b'{"op":"unsubscribe","subscriptionIds":[7]}', "no subscription 7")):
            _, connection = handshake(self.port)
            with connection:
                connection.sendall(frame(request))
                got, until = b"", time.monotonic() + live_peer.PATIENCE_S
                while why.encode() not in got and time.monotonic() < until:
                    got += connection.recv(65536)
                self.assertIn(b'"op":"status","level":2', got)

    def test_too_much_is_cut_off(self):
        for flood in (frame(b'{"op":"x"}') * 2000, frame(b" " * 70000)):
            _, connection = handshake(self.port)
            with connection:
                connection.settimeout(10)
                connection.sendall(flood)
                with self.assertRaises(ConnectionError):
                    while connection.recv(65536):
                        pass
                    raise ConnectionResetError

    def test_pages_of_other_origins_and_other_names_are_turned_away(self):
        before = self.fact("viewers turned away")
        for headers in ({"Origin": "https://evil.example"}, {"Origin": "null"},
                        {"Origin": "http://localhost.evil.example"}, {"Host": "evil.example"},
                        {"Sec_WebSocket_Protocol": ""}, {"Sec_WebSocket_Protocol": "mqtt"}):
            status, connection = handshake(self.port, **headers)
            connection.close()
            self.assertNotEqual(status, 101, headers)
        for headers in ({"Origin": "https://app.foxglove.dev"}, {"Origin": "file://"},
                        {"Origin": "http://localhost:8080"}, {"Origin": "http://[::1]:8080"},
                        {"Sec_WebSocket_Protocol": "x, foxglove.sdk.v1"}):
            status, connection = handshake(self.port, **headers)
            connection.close()
            self.assertEqual(status, 101, headers)
        self.assertTrue(live_peer.becomes_true(lambda: self.fact("viewers turned away") >= max(before, 0) + 4))

    def test_only_so_many_viewers(self):
        self.assertTrue(live_peer.becomes_true(lambda: self.fact("viewers") == 0), self.daemon.log())
        viewers = [handshake(self.port) for _ in range(16)]
        self.assertEqual({status for status, _ in viewers}, {101})
        status, one_more = handshake(self.port)
        self.assertNotEqual(status, 101)
        for _, connection in [*viewers, (0, one_more)]:
            connection.close()
        self.assertTrue(live_peer.becomes_true(lambda: self.fact("viewers") == 0), self.daemon.log())


class Restart(unittest.TestCase):
    def test_a_viewer_finds_another_session_and_a_taken_port_is_named(self):
        port, scripts, sessions = live_peer.free_port(), Scripts(), []
        for _ in range(2):
            with live_peer.running(*words(port)) as daemon:
                self.assertTrue(daemon.says("runtime: measures"), daemon.log())
                sessions.append(scripts.told(scripts.start(port, 1))["server"]["sessionId"])
                with live_peer.running(*words(port)) as second:
                    self.assertEqual(second.process.wait(live_peer.PATIENCE_S), 1)
                    self.assertTrue(second.says(f"foxglove: cannot listen at 127.0.0.1:{port}"), second.log())
                self.assertTrue(daemon.stops_by_itself(), daemon.log())
        self.assertNotEqual(*sessions)


if __name__ == "__main__":
    if not shutil.which("node") or not (MODULES / "@foxglove/ws-protocol").exists() or not (MODULES / "ajv").exists():
        print(f"SKIPPED: there is no node, or {MODULES} has no @foxglove/ws-protocol (npm ci in peer)")
        sys.exit(live_peer.SKIPPED)
    live_peer.main()
