#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""What monitors read of pose_walld, with the parser of Prometheus' makers: metrics, liveness and readiness. A sensor
that falls silent makes it not ready, but it lives; then nothing may steer by its metrics. Who hangs as a whole answers
nobody, which monitors take for dead. All answers and events are as the daemon's own OpenAPI document describes them.

usage: monitor_peer.py ROOT POSE_WALL POSE_WALLD POSE_WALL_SENSOR"""

import contextlib
import ctypes
import http.client
import json
import os
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT, POSE_WALL, POSE_WALLD, SENSOR = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(4))
sys.path[:0] = [str(ROOT / "tests/live")]

import live_peer  # noqa: E402  pylint: disable=wrong-import-position

live_peer.need("python3-prometheus-client python3-jsonschema", modules=("prometheus_client", "jsonschema"))
import jsonschema  # noqa: E402  pylint: disable=wrong-import-position
from prometheus_client import parser as older_parser  # noqa: E402  pylint: disable=wrong-import-position
from prometheus_client.openmetrics import parser  # noqa: E402  pylint: disable=wrong-import-position

VALUES = ["roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb"]


class Watched(unittest.TestCase):
    """A daemon, and what it answers."""

    def start(self, *words, **options):
        program = live_peer.Program(*words, **options)
        self.addCleanup(program.kill)
        return program

    def daemon(self, *words, **options):
        self.port = live_peer.free_port()
        return self.start(POSE_WALLD, "--http", f"127.0.0.1:{self.port}", *words, **options)

    def file(self, name, text):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = pathlib.Path(folder.name) / name
        path.write_text(text, encoding="utf-8")
        return path

    def ask(self, path, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=10)
        try:
            connection.request("GET", path, headers=headers)
            answer = connection.getresponse()
            return answer.status, answer.headers["Content-Type"], answer.read().decode("utf-8")
        finally:
            connection.close()

    def says(self, path, status):
        return live_peer.becomes_true(lambda: self.ask(path)[0] == status)

    def metrics(self):
        """{family: {sample and labels: value}}, as the parser sees them; it refuses what is malformed."""
        status, kind, text = self.ask("/metrics")
        self.assertEqual((status, kind), (200, "application/openmetrics-text; version=1.0.0; charset=utf-8"))
        return {family.name: {(sample.name, tuple(sorted(sample.labels.items()))): sample.value
                              for sample in family.samples}
                for family in parser.text_string_to_metric_families(text)}

    def may_steer(self, metrics):
        return [name for name in VALUES
                if metrics["pose_wall_may_steer"][("pose_wall_may_steer", (("value", name),))] == 1]

    def replay(self, *more):
        return self.daemon(*live_peer.replay_words(POSE_WALLD, live_peer.simulated_road(POSE_WALL))[1:], *more)


class Monitor(Watched):
    def test_a_daemon_that_measures_is_ready_and_tells_its_numbers(self):
        daemon = self.replay("--set", "planar=map")
        self.assertTrue(daemon.says("runtime: measures"), daemon.log())
        self.assertTrue(self.says("/ready", 200), daemon.log())
        self.assertEqual(json.loads(self.ask("/ready")[2]), {"schema": 1, "ready": True, "why": []})
        self.assertEqual(json.loads(self.ask("/live")[2]), {"schema": 1, "live": True, "why": []})
        self.assertTrue(live_peer.becomes_true(lambda: len(self.may_steer(self.metrics())) == 7), daemon.log())
        metrics, state = self.metrics(), json.loads(self.ask("/state.json")[2])
        for name, family in (("roll", "pose_wall_angle_radians"), ("d_rb", "pose_wall_distance_meters")):
            told = metrics[family][(family, (("value", name),))]
            unit = "value_rad" if family.endswith("radians") else "value_m"
            self.assertAlmostEqual(told, state["values"][name][unit], delta=0.05)
        self.assertGreater(metrics["pose_wall_frames_measured"][("pose_wall_frames_measured_total", ())], 0)
        dropped = metrics["pose_wall_frames_dropped"]
        self.assertEqual(len(dropped), 7, dropped)
        latency = metrics["pose_wall_latency_seconds"]
        quantiles = [latency[("pose_wall_latency_seconds", (("quantile", q),))] for q in ("0.5", "0.99", "1.0")]
        self.assertEqual(quantiles, sorted(quantiles))
        self.assertLess(0, quantiles[0])
        self.assertLess(metrics["pose_wall_frame_age_seconds"][("pose_wall_frame_age_seconds", ())], 5)
        self.assertEqual(sum(metrics["pose_wall_stop_state"].values()), 1, "one state of the stop holds")
        facts = metrics["pose_wall_part_fact"]
        self.assertGreater(facts[("pose_wall_part_fact", (("fact", "frames pushed"), ("part", "runtime")))], 0)
        self.assertIn(("pose_wall_part_fact", (("fact", "viewers"), ("part", "sink page"),
                                               ("place", f"127.0.0.1:{self.port}"))), facts)
        buckets = {labels[0][1]: value for (name, labels), value in
                   metrics["pose_wall_result_latency_seconds"].items() if name.endswith("_bucket")}
        self.assertGreater(buckets["+Inf"], 0)
        self.assertIn(("pose_wall_results_lost_total", (("sink", "page"),)), metrics["pose_wall_results_lost"])
        self.assertGreater(metrics["process_start_time_seconds"][("process_start_time_seconds", ())],
                           time.time() - 600)
        before = metrics["pose_wall_frames_pushed"][("pose_wall_frames_pushed_total", ())]
        self.assertTrue(live_peer.becomes_true(
            lambda: self.metrics()["pose_wall_frames_pushed"][("pose_wall_frames_pushed_total", ())] > before))

    def test_a_silent_sensor_is_not_ready_but_lives(self):
        udp = live_peer.free_port(socket.SOCK_DGRAM)
        daemon = self.daemon("--config", ROOT / "config/vlp16.yaml", "--set", f"udp_port={udp}")
        self.assertTrue(daemon.says("listens"), daemon.log())
        status, _, body = self.ask("/ready")
        self.assertEqual(status, 503)
        self.assertTrue(any("waits for the sensor" in why for why in json.loads(body)["why"]), body)
        self.assertEqual(self.ask("/live")[0], 200)
        sensor = self.start(SENSOR, "--sensor", "vlp16", "--frames", "70", "--to", f"127.0.0.1:{udp}")
        self.assertTrue(self.says("/ready", 200), daemon.log())
        sensor.kill()
        self.assertTrue(self.says("/ready", 503), daemon.log())
        self.assertEqual(self.ask("/live")[0], 200)
        metrics = self.metrics()
        self.assertEqual(self.may_steer(metrics), [])
        grades = metrics["pose_wall_part_grade"]
        self.assertEqual(grades[("pose_wall_part_grade", (("part", "runtime"), ("pose_wall_part_grade", "error")))], 1)

    def test_a_sensor_that_froze_is_told_as_the_reason_and_its_settings_name_its_port(self):
        udp, config = live_peer.free_port(socket.SOCK_DGRAM), self.file("sensor.yaml", "")
        sensor = self.start(SENSOR, "--sensor", "vlp16", "--frames", "1", "--frozen", "--to", f"127.0.0.1:{udp}",
                            "--config-to", config)
        self.assertTrue(sensor.says("sends to"), sensor.log())
        daemon = self.daemon("--config", config)
        self.assertTrue(daemon.says("shows the page"), daemon.log())
        frozen = ("pose_wall_value_reason", (("reason", "frozen"), ("value", "yaw")))
        is_told = live_peer.becomes_true(lambda: frozen in self.metrics()["pose_wall_value_reason"])
        self.assertTrue(is_told, daemon.log())
        self.assertEqual(self.may_steer(self.metrics()), [])
        received = ("pose_wall_packets_received_total", ())
        self.assertGreater(self.metrics()["pose_wall_packets_received"][received], 0)

    def test_crcs_are_known_from_the_start_and_the_older_text_is_given_to_who_asks_for_it(self):
        udp = live_peer.free_port(socket.SOCK_DGRAM)
        daemon = self.daemon("--config", ROOT / "config/vlp16.yaml", "--set", f"udp_port={udp}", "--set", "planar=map")
        self.assertTrue(daemon.says("shows the page"), daemon.log())
        (_, labels), = self.metrics()["pose_wall_build"]
        for part, label in (("config", "config_crc32"), ("planar stop", "planar_stop_crc32")):
            self.assertTrue(daemon.says(f"{part}: settings' CRC: {dict(labels)[label]} "), daemon.log())
        status, kind, text = self.ask("/metrics", Accept="text/plain")
        self.assertEqual((status, kind), (200, "text/plain; version=0.0.4; charset=utf-8"))
        families = {family.name: family.type for family in older_parser.text_string_to_metric_families(text)}
        self.assertEqual(families["pose_wall_frames_pushed"], "counter")
        self.assertEqual(families["pose_wall_value_state"], "gauge")
        self.assertNotIn("# EOF", text)

    def test_a_signal_to_read_the_settings_again_leaves_a_trace(self):
        config = self.file("pose_wall.yaml", "log_level: info\n")
        daemon = self.daemon("--config", config, "--replay", live_peer.simulated_road(POSE_WALL) / "frames", "--repeat",
                             stdin=subprocess.DEVNULL)
        self.assertTrue(daemon.says("shows the page"), daemon.log())
        def told():
            part = next(part for part in json.loads(self.ask("/health")[2])["parts"] if part["part"] == "settings")
            metrics = self.metrics()
            return (part["grade"], part["summary"].split(": ", 1)[-1],
                    *(next(iter(metrics[f"pose_wall_settings_{name}"].values())) for name in ("waiting", "refused")))
        self.assertEqual(told(), ("ok", "read at the start", 0, 0))
        def read_again(text, expected):
            config.write_text(text, encoding="utf-8")
            daemon.process.send_signal(signal.SIGHUP)
            self.assertTrue(live_peer.becomes_true(lambda: told() == expected), (told(), expected))
        read_again("range_max: 40\nyaw_max_deg: 30\n", ("ok", "2 wait for a restart", 2, 0))
        config.write_text("range_max: far\n", encoding="utf-8")
        daemon.process.send_signal(signal.SIGHUP)
        self.assertTrue(live_peer.becomes_true(lambda: told()[3] == 1))
        self.assertEqual(told()[0], "warning")
        self.assertIn("range_max", told()[1])
        read_again("", ("ok", "nothing waits for a restart", 0, 0))

    @staticmethod
    def is_stopped(pid):
        """Every thread of it, as the kernel has it: a signal takes its time."""
        tasks = pathlib.Path(f"/proc/{pid}/task").glob("*/stat")
        return all(task.read_text(encoding="ascii").rsplit(")", 1)[1].split()[0] == "T" for task in tasks)

    def test_who_hangs_as_a_whole_answers_nobody(self):
        daemon = self.replay()
        self.assertTrue(daemon.says("runtime: measures"), daemon.log())
        self.assertTrue(self.says("/ready", 200), daemon.log())
        os.kill(daemon.process.pid, signal.SIGSTOP)
        try:
            self.assertTrue(live_peer.becomes_true(lambda: self.is_stopped(daemon.process.pid)))
            with socket.create_connection(("127.0.0.1", self.port), 10) as connection:
                connection.sendall(b"GET /live HTTP/1.1\r\nHost: localhost\r\n\r\n")
                connection.settimeout(1)
                with self.assertRaises(socket.timeout):
                    connection.recv(1)
        finally:
            os.kill(daemon.process.pid, signal.SIGCONT)
        self.assertTrue(self.says("/live", 200))
        self.assertTrue(self.says("/ready", 200), "it comes back")


@contextlib.contextmanager
def held_up(program, thread):
    """One thread of it, by its name, as a debugger does (ptrace(2))."""
    seize, interrupt, detach, every_kind = 0x4206, 0x4207, 17, 0x40000000
    libc = ctypes.CDLL(None, use_errno=True)
    libc.ptrace.argtypes = [ctypes.c_long, ctypes.c_long, ctypes.c_void_p, ctypes.c_void_p]
    tasks = pathlib.Path(f"/proc/{program.process.pid}/task").glob("*/comm")
    task, = [int(task.parent.name) for task in tasks if task.read_text(encoding="ascii").strip() == thread]
    for request in (seize, interrupt):
        if libc.ptrace(request, task, None, None) != 0:
            raise unittest.SkipTest(f"SKIPPED: ptrace: {os.strerror(ctypes.get_errno())}")
    os.waitpid(task, every_kind)
    try:
        yield
    finally:
        libc.ptrace(detach, task, None, None)


class HeldUp(Watched):
    """A thread that does not get on: what it told last must not seem to hold."""

    def setUp(self):
        super().setUp()
        self.running = self.replay("--set", "planar=map")
        self.assertTrue(self.running.says("runtime: measures"), self.running.log())
        self.assertTrue(live_peer.becomes_true(lambda: len(self.may_steer(self.metrics())) == 7), self.running.log())

    def test_without_the_worker_nothing_steers_anywhere(self):
        with held_up(self.running, "worker"):
            time.sleep(0.4)
            metrics = self.metrics()
            self.assertEqual(self.may_steer(metrics), [])
            self.assertEqual(metrics["pose_wall_angle_radians"], {})
            self.assertEqual(metrics["pose_wall_value_reason"][
                ("pose_wall_value_reason", (("reason", "no_frame"), ("value", "yaw")))], 1)
            self.assertEqual(self.ask("/state.json")[0], 503)
            status, _, why = self.ask("/ready")
            self.assertEqual((status, json.loads(why)["why"][0]), (503, "the newest result is stale"))
            self.assertEqual(self.ask("/live")[0], 200, "a new start would take longer than this")
            counter = ("pose_wall_value_not_steering_seconds_total", (("value", "yaw"),))
            before = metrics["pose_wall_value_not_steering_seconds"][counter]
            time.sleep(0.2)
            self.assertGreaterEqual(self.metrics()["pose_wall_value_not_steering_seconds"][counter], before + 0.19)
        self.assertTrue(live_peer.becomes_true(lambda: len(self.may_steer(self.metrics())) == 7), self.running.log())

    def test_without_the_stops_thread_the_machine_stops_and_the_daemon_lives(self):
        with held_up(self.running, "planar-stop"):
            time.sleep(1.0)
            metrics = self.metrics()
            states = metrics["pose_wall_stop_state"]
            self.assertEqual(states[("pose_wall_stop_state", (("pose_wall_stop_state", "stop"),))], 1)
            self.assertEqual(metrics["pose_wall_stop_reason"][("pose_wall_stop_reason", (("reason", "stale"),))], 1)
            status, _, body = self.ask("/live")
            self.assertEqual(status, 200, body)


def without_more(schema):
    """The same schema, but what it does not describe is refused: the page must name each member."""
    if isinstance(schema, list):
        return [without_more(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    closed = {name: without_more(part) for name, part in schema.items()}
    if schema.get("type") == "object" and "additionalProperties" not in schema:
        closed["additionalProperties"] = False
    return closed


class Described(Watched):
    """Live answers are as the daemon's own OpenAPI document says, word for word."""

    def setUp(self):
        super().setUp()
        self.running = self.replay("--set", "planar=map", "--set", "motion=on")
        self.assertTrue(self.running.says("runtime: measures"), self.running.log())
        status, kind, text = self.ask("/openapi.json")
        self.assertEqual((status, kind), (200, "application/json"))
        self.document = json.loads(text)

    def check(self, reference, instance):
        name = reference["$ref"].split("/")[-1]
        root = without_more(self.document)
        resolver = jsonschema.RefResolver("", root)
        jsonschema.Draft202012Validator(root["components"]["schemas"][name], resolver=resolver).validate(instance)

    def test_the_schemas_are_schemas_and_all_are_used(self):
        text = json.dumps(self.document)
        self.assertEqual(self.document["openapi"], "3.1.0")
        for name, schema in self.document["components"]["schemas"].items():
            jsonschema.Draft202012Validator.check_schema(schema)
            self.assertIn(f'"#/components/schemas/{name}"', text, "used")

    def test_each_answer_is_as_described(self):
        self.assertTrue(self.says("/ready", 200))
        self.assertTrue(live_peer.becomes_true(lambda: json.loads(self.ask("/planar.json")[2])["roadway"]))
        for path, operations in self.document["paths"].items():
            if path == "/events" or "get" not in operations:
                continue
            with self.subTest(path=path):
                if path == "/map.png":
                    self.assertTrue(self.is_picture(path))
                    continue
                status, kind, text = self.ask(path)
                content = operations["get"]["responses"][str(status)]["content"]  # a busy machine may be late
                self.assertIn(kind.split(";")[0], content)
                schema = content[kind.split(";")[0]]["schema"]
                if "$ref" in schema:
                    self.check(schema, json.loads(text))

    def is_picture(self, path):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=10)
        self.addCleanup(connection.close)
        def is_one():
            connection.request("GET", path)
            return connection.getresponse().read()[:4] == b"\x89PNG"
        return live_peer.becomes_true(is_one)

    def test_each_event_is_as_described(self):
        kinds = self.document["paths"]["/events"]["get"]["x-events"]
        seen = {}
        with socket.create_connection(("127.0.0.1", self.port), 10) as viewer:
            viewer.sendall(b"GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n")
            lines, name = viewer.makefile("r", encoding="utf-8"), None
            for line in lines:
                if line.startswith("event: "):
                    name = line[7:].strip()
                elif line.startswith("data: "):
                    seen.setdefault(name, json.loads(line[6:]))
                if set(seen) == set(kinds):
                    break
        for name, data in seen.items():
            with self.subTest(event=name):
                self.check(kinds[name], data)

    def test_what_is_refused_is_as_described(self):
        self.running.kill()
        udp = live_peer.free_port(socket.SOCK_DGRAM)
        daemon = self.daemon("--config", ROOT / "config/vlp16.yaml", "--set", f"udp_port={udp}")
        self.assertTrue(daemon.says("listens"), daemon.log())
        for path, status in (("/ready", 503), ("/health", 503), ("/planar.json", 404)):
            self.assertEqual(self.ask(path)[0], status)
            answer = self.document["paths"][path]["get"]["responses"][str(status)]
            self.check(answer["content"]["application/json"]["schema"], json.loads(self.ask(path)[2]))
        self.assertTrue(self.says("/state.json", 200), daemon.log())
        self.check({"$ref": "State"}, json.loads(self.ask("/state.json")[2]))  # of silence


if __name__ == "__main__":
    live_peer.main()
