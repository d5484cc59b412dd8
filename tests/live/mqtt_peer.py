#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""MQTT telemetry of pose_walld with a broker and a subscriber that others wrote (mosquitto). The broker comes late, is
started anew, is frozen, never answers or answers garbage. Results come once a second and when a state changes. Who dies
is told offline, and the last value that the broker keeps never looks current then. With TLS and a login the daemon
speaks to that broker alone, and tells why it does not. Whatever the broker does, frames are measured and the daemon
stops cleanly.

usage: mqtt_peer.py ROOT POSE_WALL POSE_WALLD"""

import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
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

    def __init__(self, port, *login):
        self.program = live_peer.Program(SUBSCRIBER, "-h", "127.0.0.1", "-p", port, "-t", "mine/#", "-q", "1", "-F",
                                         "%t %q %r %p", *login)

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


class Brokered(unittest.TestCase):
    """What the tests need of broker, subscriber and daemon."""

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

    def subscriber(self, *login):
        subscriber = Subscriber(self.port, *login)
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


class Mqtt(Brokered):
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

    def last(self, subscriber):
        """What the newest last value says."""
        return json.loads(subscriber.messages("last")[-1][2])

    def live(self, subscriber):
        """The last values that said they are current."""
        told = [json.loads(text) for _, _, text in subscriber.messages("last")]
        return [last for last in told if last["state"] == "live"]

    def test_the_last_value_never_looks_current_when_it_is_not(self):
        self.broker()
        early, daemon = self.subscriber(), self.daemon()
        self.assertTrue(live_peer.becomes_true(
            lambda: early.messages("last") and len(self.last(early)["may_steer"]) == 7), daemon.log())
        late = self.subscriber()
        self.assertTrue(late.gets("last"), daemon.log())
        self.assertEqual(late.messages("last")[0][1], 1, "the first is what the broker keeps")
        # On a machine under load a scan may be late, and the value is rightly stale then: one that is live comes.
        self.assertTrue(live_peer.becomes_true(lambda: self.live(late)), daemon.log())
        last, now_ns = self.live(late)[-1], time.time_ns()
        self.assertLess(abs(last["told_at_ns"] - now_ns), 5e9)
        self.assertEqual(last["valid_until_ns"] - last["told_at_ns"], 3_000_000_000)
        self.assertLess(last["age_s"], 5)
        result = json.loads(early.messages("result")[-1][2])
        self.assertLess(abs(result["valid_until_ns"] - now_ns), 10e9)
        seen = len(late.messages("last"))
        self.assertTrue(late.gets("last", seen + 3), "it is told anew each second")
        daemon.kill()
        for subscriber in (late, self.subscriber()):  # who listens, and who comes later
            self.assertTrue(live_peer.becomes_true(
                lambda who=subscriber: who.messages("last") and self.last(who)["state"] == "gone"))
            self.assertEqual(self.last(subscriber)["may_steer"], [])
        again = self.daemon()
        self.assertTrue(live_peer.becomes_true(lambda: self.last(late)["state"] == "live"), again.log())
        self.assert_stops_cleanly(again)
        self.assertTrue(live_peer.becomes_true(lambda: self.last(late)["state"] == "gone"))

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


@unittest.skipUnless(live_peer.program("openssl") and live_peer.program("mosquitto_passwd"),
                     "SKIPPED: no openssl, no mosquitto_passwd (packages openssl, mosquitto)")
class Secured(Brokered):
    """A broker with TLS and passwords."""

    def setUp(self):
        super().setUp()
        self.folder = self.settings.parent
        self.make_ca("ca")
        self.make_ca("other")
        self.make_certificate("broker", "ca", "IP:127.0.0.1")
        self.make_certificate("stranger", "ca", "DNS:broker.example")
        self.make_certificate("daemon", "ca", "DNS:daemon.example")
        self.password = self.folder / "password"
        self.password.write_text("deep in the mine\nnot this line\n", encoding="utf-8")
        self.run_tool("mosquitto_passwd", "-c", "-b", self.folder / "users", "north", "deep in the mine")
        os.chmod(self.folder, 0o755)
        self.set_broker()

    def run_tool(self, name, *words):
        subprocess.run([live_peer.program(name), *map(str, words)], check=True, capture_output=True)

    def make_ca(self, name):
        self.run_tool("openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", f"/CN={name}",
                      "-keyout", self.folder / f"{name}.key", "-out", self.folder / f"{name}.pem")

    def make_certificate(self, name, ca, place):
        request, extra = self.folder / f"{name}.csr", self.folder / f"{name}.ext"
        extra.write_text(f"subjectAltName={place}\n", encoding="utf-8")
        self.run_tool("openssl", "req", "-newkey", "rsa:2048", "-nodes", "-subj", f"/CN={name}", "-keyout",
                      self.folder / f"{name}.key", "-out", request)
        self.run_tool("openssl", "x509", "-req", "-in", request, "-CA", self.folder / f"{ca}.pem", "-CAkey",
                      self.folder / f"{ca}.key", "-CAcreateserial", "-days", "2", "-extfile", extra, "-out",
                      self.folder / f"{name}.pem")

    def set_broker(self, name="broker", *more):
        # mosquitto gives up root, and could then not read the keys: it stays who it is.
        self.settings.write_text("\n".join([
            "user root", f"listener {self.port} 127.0.0.1", "allow_anonymous false", "persistence false",
            f"cafile {self.folder}/ca.pem", f"certfile {self.folder}/{name}.pem", f"keyfile {self.folder}/{name}.key",
            f"password_file {self.folder}/users", *more, ""]), encoding="utf-8")

    def login(self, *more):
        return [word for setting in ("mqtt_user=north", f"mqtt_password_file={self.password}", "mqtt_tls=1",
                                     f"mqtt_ca_file={self.folder}/ca.pem", *more) for word in ("--set", setting)]

    def listens(self):
        return self.subscriber("-u", "north", "-P", "deep in the mine", "--cafile", self.folder / "ca.pem")

    def test_with_user_password_and_tls_it_is_served(self):
        self.broker()
        subscriber, daemon = self.listens(), self.daemon(*self.login())
        self.assertTrue(subscriber.says("status", "online"), daemon.log())
        self.assertTrue(subscriber.gets("result", 2), daemon.log())
        self.assertTrue(subscriber.gets("last", 2), daemon.log())
        self.assertTrue(daemon.says("telemetry, encrypted and with a login"), daemon.log())
        self.assertFalse(any("deep in the mine" in line for line in daemon.lines), "no password in the log")
        self.assert_stops_cleanly(daemon)
        self.assertTrue(subscriber.says("status", "offline"))

    def test_a_wrong_password_is_named_and_mended_without_a_restart(self):
        self.broker()
        self.password.write_text("deep in another\n", encoding="utf-8")
        daemon = self.daemon(*self.login())
        self.assertTrue(daemon.says("no broker: the broker refuses this user"), daemon.log())
        self.assert_goes_on_measuring(daemon)
        self.password.write_text("deep in the mine\r\n", encoding="utf-8")
        self.assertTrue(daemon.says("connected"), daemon.log())
        self.assert_stops_cleanly(daemon)

    def test_a_broker_of_another_maker_of_certificates_is_refused(self):
        self.broker()
        daemon = self.daemon(*self.login(f"mqtt_ca_file={self.folder}/other.pem"))
        self.assertTrue(daemon.says("no broker: TLS: certificate verify failed"), daemon.log())
        self.assert_goes_on_measuring(daemon)
        self.assert_stops_cleanly(daemon)

    def test_a_broker_of_another_name_is_refused(self):
        self.set_broker("stranger")
        self.broker()
        daemon = self.daemon(*self.login())
        self.assertTrue(daemon.says("no broker: "), daemon.log())
        self.assert_goes_on_measuring(daemon)
        self.assertFalse(any("connected" in line for line in daemon.lines), daemon.log())
        self.assert_stops_cleanly(daemon)

    def test_a_broker_that_wants_a_certificate_gets_one(self):
        self.set_broker("broker", "require_certificate true")
        self.broker()
        without = self.daemon(*self.login())
        self.assertTrue(without.says("no broker: "), without.log())
        self.assert_stops_cleanly(without)
        daemon = self.daemon(*self.login(f"mqtt_cert_file={self.folder}/daemon.pem",
                                         f"mqtt_key_file={self.folder}/daemon.key"))
        self.assertTrue(daemon.says("connected"), daemon.log())
        self.assert_stops_cleanly(daemon)

    def test_a_broker_without_tls_gets_no_password(self):
        taken = self.answer_with(b"")
        daemon = self.daemon(*self.login())
        self.assertTrue(live_peer.becomes_true(lambda: len(taken) > 0), daemon.log())
        taken[0].settimeout(live_peer.PATIENCE_S)
        self.assertEqual(taken[0].recv(1), b"\x16", "it begins with a hello of TLS")
        self.assert_stops_cleanly(daemon)


if __name__ == "__main__":
    live_peer.main()
