#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""MQTT telemetry of pose_walld with a broker and a subscriber that others wrote (mosquitto). The broker comes late, is
started anew, is frozen, never answers or answers garbage. Results come once a second and when a state changes. Who dies
is told offline. Whatever the broker does, frames are measured and the daemon stops cleanly.

usage: mqtt_peer.py ROOT POSE_WALL POSE_WALLD"""

import json
import os
import pathlib
import shutil
import signal
import socket
import sys
import tempfile
import threading
import time
import unittest

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT, POSE_WALL, POSE_WALLD = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(3))
sys.path[:0] = [str(ROOT / "tests/live")]

import live_peer  # noqa: E402  pylint: disable=wrong-import-position

live_peer.need("mosquitto mosquitto-clients", programs=("mosquitto", "mosquitto_sub"))
BROKER, SUBSCRIBER = live_peer.program("mosquitto"), live_peer.program("mosquitto_sub")


class Subscriber:
    """Takes everything under the topic."""

    def __init__(self, port):
        self.program = live_peer.Program(SUBSCRIBER, "-h", "127.0.0.1", "-p", port, "-t", "mine/#", "-q", "1", "-F",
                                         "%t %q %r %p")

    def messages(self, name):
        """(qos, retained, text) of each under mine/name."""
        found = []
        for line in list(self.program.lines):
            words = line.split(" ", 3)
            if len(words) == 4 and words[0] == f"mine/{name}":
                found.append((int(words[1]), int(words[2]), words[3]))
        return found

    def gets(self, name, count=1):
        return live_peer.becomes_true(lambda: len(self.messages(name)) >= count)

    def says(self, name, text):
        return live_peer.becomes_true(lambda: any(text == message[2] for message in self.messages(name)))

    def close(self):
        self.program.kill()


class Mqtt(unittest.TestCase):
    def setUp(self):
        self.port = live_peer.free_port()
        place = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        self.addCleanup(place.cleanup)
        self.settings = pathlib.Path(place.name) / "mosquitto.conf"
        self.settings.write_text(f"listener {self.port} 127.0.0.1\nallow_anonymous true\npersistence false\n",
                                 encoding="utf-8")

    def broker(self):
        program = live_peer.Program(BROKER, "-c", self.settings)
        self.addCleanup(program.kill)
        self.assertTrue(live_peer.becomes_true(self.broker_listens), program.log())
        return program

    def broker_listens(self):
        with socket.socket() as probe:
            return probe.connect_ex(("127.0.0.1", self.port)) == 0

    def subscriber(self):
        subscriber = Subscriber(self.port)
        self.addCleanup(subscriber.close)
        return subscriber

    def daemon(self, *more):
        road = live_peer.simulated_road(POSE_WALL)
        program = live_peer.Program(*live_peer.replay_words(
            POSE_WALLD, road, "--set", f"mqtt=127.0.0.1:{self.port}", "--set", "mqtt_topic=mine", "--set",
            "status_every_s=1", *more))
        self.addCleanup(program.kill)
        return program

    def measured(self, program):
        """The last count of frames in the log."""
        for line in reversed(list(program.lines)):
            if "frames measured" in line:
                return int(line.split("frames measured ")[1].split(";")[0])
        return 0

    def assert_goes_on_measuring(self, program):
        before = self.measured(program)
        self.assertTrue(live_peer.becomes_true(lambda: self.measured(program) > before + 5), program.log())

    def assert_stops_cleanly(self, program):
        program.stop()
        # A part that takes more than a second ends the process with 1.
        self.assertEqual(program.process.returncode, 0, program.log())

    def test_a_broker_that_comes_late_gets_results_health_and_status(self):
        daemon = self.daemon()
        self.assertTrue(daemon.says("no broker: "), daemon.log())
        self.assertTrue(daemon.says("runtime: measures"), daemon.log())
        self.broker()
        subscriber = self.subscriber()
        self.assertTrue(subscriber.says("status", "online"), daemon.log())
        begin = time.monotonic()
        self.assertTrue(subscriber.gets("result", 6), daemon.log())
        time.sleep(4)
        results = [json.loads(text) for _, _, text in subscriber.messages("result")]
        lasted_s = time.monotonic() - begin
        self.assertTrue(all(qos == 1 and retained == 0 for qos, retained, _ in subscriber.messages("result")))
        states = [(read["told_by"], [value["state"] for value in read["values"].values()]) for read in results]
        unchanged = sum(a == b for a, b in zip(states, states[1:]))
        self.assertLessEqual(unchanged, lasted_s + 2, "without a change, one a second")
        self.assertEqual(sorted(read["publication"] for read in results), [read["publication"] for read in results])
        self.assertTrue(subscriber.gets("health"))
        parts = {part["part"]: part for part in json.loads(subscriber.messages("health")[-1][2])["parts"]}
        self.assertIn("runtime", parts)
        self.assertEqual(parts[f"sink mqtt 127.0.0.1:{self.port}"]["summary"], "connected")

        # Who comes later hears at once whether the daemon is there, and no value that is old.
        late = self.subscriber()
        self.assertTrue(late.says("status", "online"))
        self.assertEqual(late.messages("status")[0][1], 1, "retained")
        self.assertTrue(late.gets("result"))
        self.assertEqual([retained for _, retained, _ in late.messages("result") + late.messages("health")
                          if retained], [])
        self.assert_stops_cleanly(daemon)
        self.assertTrue(subscriber.says("status", "offline"))

    def test_who_is_killed_is_told_offline_by_the_broker(self):
        self.broker()
        subscriber, daemon = self.subscriber(), self.daemon()
        self.assertTrue(subscriber.says("status", "online"), daemon.log())
        daemon.kill()
        self.assertTrue(subscriber.says("status", "offline"))
        again = self.daemon()
        self.assertTrue(live_peer.becomes_true(lambda: subscriber.messages("status")[-1][2] == "online"), again.log())

    def test_a_broker_that_is_started_anew_is_found_again(self):
        broker, daemon = self.broker(), self.daemon()
        self.assertTrue(daemon.says("connected"), daemon.log())
        for _ in range(2):
            seen = len(daemon.lines)
            broker.stop()
            self.assertTrue(live_peer.becomes_true(
                lambda now=seen: any("no broker: " in line for line in daemon.lines[now:])), daemon.log())
            self.assert_goes_on_measuring(daemon)
            broker = self.broker()
            subscriber = self.subscriber()
            self.assertTrue(subscriber.says("status", "online"), daemon.log())
            self.assertTrue(subscriber.gets("result", 2), daemon.log())
            self.assertTrue(subscriber.gets("health"), daemon.log())
            subscriber.close()
        self.assert_stops_cleanly(daemon)

    def test_a_broker_that_freezes_holds_up_nobody(self):
        broker, daemon = self.broker(), self.daemon()
        self.assertTrue(daemon.says("connected"), daemon.log())
        os.kill(broker.process.pid, signal.SIGSTOP)
        try:
            self.assert_goes_on_measuring(daemon)
            self.assertTrue(daemon.says("no broker: "), daemon.log())
            self.assert_goes_on_measuring(daemon)
        finally:
            os.kill(broker.process.pid, signal.SIGCONT)
        subscriber = self.subscriber()
        self.assertTrue(subscriber.gets("result", 2), daemon.log())
        os.kill(broker.process.pid, signal.SIGSTOP)
        try:
            self.assert_stops_cleanly(daemon)
        finally:
            os.kill(broker.process.pid, signal.SIGCONT)

    def answer_with(self, answer):
        """A broker that takes connections and says what it likes."""
        server = socket.create_server(("127.0.0.1", self.port))
        self.addCleanup(server.close)
        taken = []

        def serve():
            while True:
                try:
                    connection, _ = server.accept()
                except OSError:
                    return
                taken.append(connection)
                try:
                    connection.sendall(answer)
                except OSError:
                    pass
        threading.Thread(target=serve, daemon=True).start()
        self.addCleanup(lambda: [connection.close() for connection in taken])
        return taken

    def test_a_broker_that_is_none_holds_up_nobody(self):
        connack = b"\x20\x02\x00\x00"
        for answer in (b"", b"\x20\x02\x00\x05", b"HTTP/1.1 400 Bad Request\r\n\r\n" * 50, b"\xff" * 4096,
                       connack + b"\x30\xff\xff\xff\x7f" + b"x" * 100, connack + b"\x40\x02\x7f\x7f" * 500,
                       connack + bytes(range(256)) * 8):
            with self.subTest(answer=answer[:12]):
                self.port = live_peer.free_port()
                taken = self.answer_with(answer)
                daemon = self.daemon()
                self.assertTrue(live_peer.becomes_true(lambda came=taken: len(came) > 0), daemon.log())
                self.assert_goes_on_measuring(daemon)
                self.assertIsNone(daemon.process.poll(), daemon.log())
                self.assert_stops_cleanly(daemon)

    def test_a_topic_that_nobody_may_publish_under_is_named(self):
        for topic in ("a/#", "+/b", "$SYS/a", "", "a\tb"):
            daemon = self.daemon("--set", f"mqtt_topic={topic}")
            self.assertEqual(daemon.process.wait(live_peer.PATIENCE_S), 1, topic)
            self.assertTrue(daemon.says("mqtt_topic: "), daemon.log())


if __name__ == "__main__":
    live_peer.main()
