#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The OPC UA server beside pose_walld, with a client of another maker (HBK's `opcua`). It has the information model
that its README tells, with types, units and values of the daemon. Good is told of nothing that may not steer: not when
the sensor is silent, when the daemon is killed, frozen or repeats itself, nor of an answer that is malformed. Nothing
can be written. Beyond loopback only who encrypts and is trusted comes in.

usage: opcua_peer.py ROOT POSE_WALL POSE_WALLD POSE_WALL_SENSOR NODE_MODULES GATEWAY_NODE_MODULES"""

import contextlib
import copy
import http.server
import json
import os
import pathlib
import queue
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import urllib.request

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT, POSE_WALL, POSE_WALLD, SENSOR, MODULES, GATEWAY_MODULES = (pathlib.Path(sys.argv.pop(1)) for _ in range(6))
sys.path[:0] = [str(ROOT / "tests/live")]

import live_peer  # noqa: E402  pylint: disable=wrong-import-position

live_peer.need("nodejs", programs=("node",))
for folder, package in ((MODULES, "opcua"), (GATEWAY_MODULES, "node-opcua-server")):
    if not (folder / package).is_dir():
        print(f"SKIPPED: there is no {package} of npm in {folder} (need_peers of tools/shell/packages.sh brings it)")
        sys.exit(live_peer.SKIPPED)

QUANTITIES = {
    "Roll": "roll",
    "Pitch": "pitch",
    "Yaw": "yaw",
    "LeftFront": "d_lf",
    "LeftBack": "d_lb",
    "RightFront": "d_rf",
    "RightBack": "d_rb",
}
OF_VALUE = ("Value", "ProtectionLevel", "Sigma")
# Of OPC 10000-6 A.2; the upper two bits are the severity.
GOOD, BAD, NO_COMMUNICATION, COMMUNICATION_ERROR = 0, 0x80000000, 0x80310000, 0x80050000
NOT_CONNECTED, SENSOR_FAILURE, OUT_OF_SERVICE, NOT_WRITABLE = 0x808A0000, 0x808C0000, 0x808D0000, 0x803B0000
LAST_USABLE, NOT_ACCURATE, ACCESS_DENIED = 0x40900000, 0x40930000, 0x801F0000
# Types of the standard's nodes (OPC 10000-5, 10000-8): AnalogUnitType, MultiStateDiscreteType, BaseDataVariableType.
ANALOG, MULTI_STATE, PLAIN = 17497, 2376, 63
UNECE = {"rad": "C81", "m": "MTR", "m/s": "MTS", "s": "SEC"}
NOTICED_S = 4.0  # a second of the gateway and what a busy machine takes; where time itself is tried, it says so


def is_good(status):
    return status >> 30 == 0


class Client:
    """The other maker's, as a program that is told what to do by lines."""

    def __init__(self, place, port):
        self.process = subprocess.Popen(
            ["node", place / "opcua_client.mjs", str(port)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        self.answers, self.told = queue.Queue(), []
        threading.Thread(target=self._read, daemon=True).start()
        self.first = self.answers.get(timeout=live_peer.PATIENCE_S)

    def _read(self):
        for line in self.process.stdout:
            read = json.loads(line) if line.startswith("{") else {"error": line}
            if "data" in read:
                self.told.append((time.monotonic(), read))
            else:
                self.answers.put(read)

    def ask(self, do, **more):
        self.process.stdin.write(json.dumps({"do": do, **more}) + "\n")
        self.process.stdin.flush()
        answer = self.answers.get(timeout=live_peer.PATIENCE_S)
        if "answer" not in answer:
            raise RuntimeError(answer)
        return answer["answer"]

    def read(self, *nodes, attribute=13):
        return self.ask("read", nodes=[f"PoseWall.{node}" for node in nodes], attribute=attribute)

    def statuses(self, *nodes):
        return [told["status"] for told in self.read(*nodes)]

    def close(self):
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()


class Pretender(http.server.ThreadingHTTPServer):
    """A daemon that says what a test wants: `state`, `planar` and `health` are (status, bytes), or a function."""

    daemon_threads = True

    def __init__(self, state, planar, health, port):
        super().__init__(("127.0.0.1", port), Answer)
        self.says = {"/state.json": state, "/planar.json": planar, "/health": health}
        self.count, self.moves, self.connections = 0, True, []
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def process_request(self, request, client_address):
        self.connections.append(request)
        super().process_request(request, client_address)

    def handle_error(self, request, client_address):  # who is cut off in a test is no news
        pass

    def close(self):
        self.shutdown()
        self.server_close()
        for connection in self.connections:  # or they go on being answered
            with contextlib.suppress(OSError):
                connection.shutdown(socket.SHUT_RDWR)


class Answer(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def do_GET(self):  # noqa: N802  pylint: disable=invalid-name
        says = self.server.says[self.path]
        self.server.count += self.server.moves
        status, body = says(self) if callable(says) else (200, says)
        if isinstance(body, dict):
            body = copy.deepcopy(body)
            if "publication" in body:
                body["publication"] = self.server.count
            if isinstance(body.get("stop"), dict):
                body["stop"]["heartbeat"] = self.server.count
            body = json.dumps(body).encode()
        if body is not None:
            self.send_response(status)
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            with contextlib.suppress(OSError):
                self.wfile.write(body)

    def log_message(self, *_words):  # pylint: disable=arguments-differ
        pass


def table_of_readme():
    """{node: (type, unit or words)} as tools/apps/opcua/README.md tells it."""
    text = (
        (ROOT / "tools/apps/opcua/README.md")
        .read_text(encoding="utf-8")
        .split("## Information model")[1]
        .split("\n## ")[0]
    )
    found = {}
    for names, kind, unit in re.findall(r"^\| (.*?`.*?) \| ([A-Z]\w+) \| ([^|]*?) ?\|", text, re.M):
        names = names.replace("each of the seven", ", ".join(f"`{name}`" for name in QUANTITIES))
        before, _, after = names.rpartition(":")
        for folder in re.findall(r"`(\w+)`", before) or [""]:
            for name in re.findall(r"`\.?(\w+)`", after):
                found[f"{folder}.{name}".lstrip(".")] = (kind, unit.strip())
    return found


def real_answers():
    """What a daemon that measures says of state, stop and health."""
    port = live_peer.free_port()
    with live_peer.running(
        *live_peer.replay_words(
            POSE_WALLD, live_peer.simulated_road(POSE_WALL), "--http", f"127.0.0.1:{port}", "--set", "planar=map"
        )
    ) as daemon:
        found = {}

        def is_there():
            with contextlib.suppress(OSError):
                for path in ("state.json", "planar.json", "health"):
                    with urllib.request.urlopen(f"http://127.0.0.1:{port}/{path}", timeout=5) as answer:
                        found[path] = json.load(answer)
                # A frame is still short when all are valid.
                return all(value["state"] == "valid" for value in found["state.json"]["values"].values())
            return False

        if not live_peer.becomes_true(is_there, 2 * live_peer.PATIENCE_S):
            raise RuntimeError(daemon.log())
    return found


class Opcua(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        cls.addClassCleanup(place.cleanup)
        cls.place = pathlib.Path(place.name)
        for name, modules, sources in (
            ("peer", MODULES, "tests/live/peer"),
            ("gateway", GATEWAY_MODULES, "tools/apps/opcua"),
        ):
            (cls.place / name).mkdir()
            os.symlink(modules.resolve(), cls.place / name / "node_modules")
            for source in list((ROOT / sources).glob("*.mjs")) + list((ROOT / sources).glob("package.json")):
                shutil.copy(source, cls.place / name)
        # One for most tests: it takes seconds to start. They change what stands behind it.
        cls.behind, cls.port = live_peer.free_port(), live_peer.free_port()
        cls.gateway = cls.start_gateway("--port", cls.port, "--daemon", f"http://127.0.0.1:{cls.behind}")
        cls.addClassCleanup(cls.gateway.kill)
        cls.real = real_answers()

    @classmethod
    def start_gateway(cls, *words):
        program = live_peer.Program(
            "node", cls.place / "gateway/pose_wall_opcua.mjs", "--folder", cls.place / "folder", *words
        )
        if not program.says("variables at", 2 * live_peer.PATIENCE_S):
            raise RuntimeError(program.log())
        return program

    def client(self, port=None):
        client = Client(self.place / "peer", port or self.port)
        self.addCleanup(client.close)
        return client

    def daemon(self, *more):
        program = live_peer.Program(
            *live_peer.replay_words(
                POSE_WALLD,
                live_peer.simulated_road(POSE_WALL),
                "--http",
                f"127.0.0.1:{self.behind}",
                "--set",
                "planar=map",
                *more,
            )
        )
        self.addCleanup(program.kill)
        return program

    def pretender(self, **says):
        server = Pretender(
            says.get("state", self.real["state.json"]),
            says.get("planar", self.real["planar.json"]),
            says.get("health", self.real["health"]),
            self.behind,
        )
        self.addCleanup(server.close)
        return server

    def becomes(self, client, status, node="Yaw.Value", patience_s=live_peer.PATIENCE_S):
        seen = []
        self.assertTrue(
            live_peer.becomes_true(lambda: seen.append(client.statuses(node)[0]) or seen[-1] == status, patience_s),
            f"{node}: {sorted(set(map(hex, seen)))} instead of {status:#x}\n{self.gateway.log()}",
        )

    # The model.

    def test_it_has_the_nodes_types_and_units_that_its_readme_tells(self):
        self.pretender()
        client, found = self.client(), {}
        self.becomes(client, GOOD)
        self.becomes(client, GOOD, "Stop.State")
        self.becomes(client, GOOD, "Health.Grade")
        for node in client.ask("browse", node="PoseWall"):
            children = client.ask("browse", node=node["node"]) if node["kind"] == 1 else [node]
            for child in children:
                found[child["node"][len("PoseWall.") :]] = child["type"]
        table = table_of_readme()
        self.assertEqual(sorted(table), sorted(found))
        self.assertEqual(len(found), 74)
        for name, (kind, unit) in table.items():
            with self.subTest(node=name):
                value = client.read(name)[0]
                self.assertEqual(value["type"], kind)
                if unit in UNECE:
                    self.assertEqual(found[name], ANALOG)
                    told = client.read(f"{name}.EngineeringUnits")[0]["value"]
                    code = struct.unpack(">i", UNECE[unit].encode().rjust(4, b"\0"))[0]
                    self.assertEqual(
                        (told["UnitId"], told["DisplayName"]["text"], told["NamespaceUri"]),
                        (code, unit, "http://www.opcfoundation.org/UA/units/un/cefact"),
                    )
                elif unit:
                    self.assertEqual(found[name], MULTI_STATE)
                    told = client.read(f"{name}.EnumStrings")[0]["value"]
                    self.assertEqual(", ".join(word["text"] for word in told), unit)
                else:
                    self.assertEqual(found[name], PLAIN)

    def test_nothing_can_be_written(self):
        self.pretender()
        client = self.client()
        self.becomes(client, GOOD)
        before = client.read("Yaw.Value")[0]["value"]
        for name in table_of_readme():
            self.assertEqual([client.read(name, attribute=which)[0]["value"] for which in (17, 18)], [1, 1], name)
            self.assertEqual(client.ask("write", node=f"PoseWall.{name}", value=1.0), [NOT_WRITABLE], name)
        self.assertEqual(client.ask("write", node="PoseWall.Yaw.Value.EngineeringUnits", value=1.0), [NOT_WRITABLE])
        self.assertEqual(client.read("Yaw.Value")[0]["value"], before)

    # A page that is shut.

    def test_a_page_with_https_and_a_login_is_read_by_who_may(self):
        folder = self.place / "shut"
        folder.mkdir()
        live_peer.self_signed_page(folder / "page.pem", folder / "cert.pem")
        hashed = subprocess.run(["openssl", "passwd", "-6", "tief"], check=True, capture_output=True, text=True).stdout
        (folder / "logins").write_text(f"plant:{hashed}", encoding="utf-8")
        (folder / "right").write_text("plant:tief\n", encoding="utf-8")
        (folder / "wrong").write_text("plant:flach\n", encoding="utf-8")
        self.daemon("--set", f"http_certificate={folder / 'page.pem'}", "--set", f"http_login={folder / 'logins'}")
        page = f"https://127.0.0.1:{self.behind}"
        for words, status in ((("--daemon-ca", folder / "cert.pem", "--daemon-login", folder / "right"), GOOD),
                              (("--daemon-ca", folder / "cert.pem", "--daemon-login", folder / "wrong"), ACCESS_DENIED),
                              (("--daemon-login", folder / "right"), NO_COMMUNICATION)):
            port = live_peer.free_port()
            gateway = self.start_gateway("--port", port, "--daemon", page, *words)
            self.addCleanup(gateway.kill)
            self.becomes(self.client(port), status, patience_s=2 * live_peer.PATIENCE_S)
            gateway.kill()

    # What a daemon measures.

    def test_values_are_those_of_the_daemon(self):
        said, done = {}, threading.Event()

        def listen():
            while not done.is_set():
                with contextlib.suppress(OSError):
                    with urllib.request.urlopen(f"http://127.0.0.1:{self.behind}/state.json", timeout=5) as answer:
                        state = json.load(answer)
                        said[state["publication"]] = state
                time.sleep(0.02)

        daemon, client = self.daemon(), self.client()
        listener = threading.Thread(target=listen)
        listener.start()
        compared, nodes = 0, [
            f"{name}.{what}" for name in QUANTITIES for what in (*OF_VALUE, "State", "MaySteer", "Age")
        ]
        try:
            self.becomes(client, GOOD, patience_s=2 * live_peer.PATIENCE_S)
            until = time.monotonic() + live_peer.PATIENCE_S
            while compared < 5 and time.monotonic() < until:
                first, *read, crc, stamp, last = client.read(
                    "Publication", *nodes, "ConfigCrc32", "StampNs", "Publication"
                )
                state = said.get(int(first["value"] or -1))
                if state is None or first["value"] != last["value"]:
                    continue
                compared += 1
                self.assert_same(state, dict(zip(nodes, read)))
                self.assertEqual((crc["value"], stamp["value"]), (state["config_crc32"], str(state["header_stamp_ns"])))
                self.assertEqual({told["source_ms"] for told in read}, {state["header_stamp_ns"] // 1000000})
        finally:
            done.set()
            listener.join()
        self.assertEqual(compared, 5, daemon.log() + self.gateway.log())
        self.assertEqual(client.read("SteerEn", "SteerZh")[1]["value"]["locale"], "zh-CN")
        self.assertIn("雷达" if "未测得" in (said_zh := client.read("SteerZh")[0]["value"]["text"]) else "可用于控制", said_zh)

    def assert_same(self, state, read):
        for name, quantity in QUANTITIES.items():
            value, steer = state["values"][quantity], state["steer"][list(state["values"]).index(quantity)]
            unit = "m" if quantity.startswith("d_") else "rad"
            for what, member in zip(OF_VALUE, ("value", "protection_level", "sigma")):
                told = read[f"{name}.{what}"]
                self.assertEqual(is_good(told["status"]), steer["may_steer"], (name, what))
                if told["status"] >> 31 == 0:
                    self.assertEqual(told["value"], value[f"{member}_{unit}"], (name, what))
            self.assertEqual(
                read[f"{name}.State"]["value"], ["invalid", "held", "degraded", "valid"].index(value["state"])
            )
            self.assertEqual(read[f"{name}.MaySteer"]["value"], steer["may_steer"])

    def test_a_sensor_that_is_silent_leaves_nothing_good(self):
        port, client = live_peer.free_port(socket.SOCK_DGRAM), self.client()
        config = self.place / "sensor.yaml"
        sensor = self.sensor(port, config)
        daemon = live_peer.Program(
            POSE_WALLD,
            "--config",
            config,
            "--set",
            f"udp_port={port}",
            "--http",
            f"127.0.0.1:{self.behind}",
            "--set",
            "planar=map",
        )
        self.addCleanup(daemon.kill)
        nodes = [f"{name}.{what}" for name in QUANTITIES for what in OF_VALUE]
        good = lambda: any(map(is_good, client.statuses(*nodes)))  # noqa: E731
        self.assertTrue(live_peer.becomes_true(good, 2 * live_peer.PATIENCE_S), daemon.log())
        client.ask("subscribe", nodes=["PoseWall.Roll.Value", "PoseWall.Stop.State"], ms=100)
        self.assertTrue(live_peer.becomes_true(lambda: len(client.told) > 4), "subscriptions bring values")
        sensor.kill()
        began = time.monotonic()
        self.assertTrue(live_peer.becomes_true(lambda: not good(), NOTICED_S), client.read(*nodes[:3]))
        self.assertTrue(
            live_peer.becomes_true(
                lambda: all(status in (LAST_USABLE, SENSOR_FAILURE) for status in client.statuses(*nodes)), NOTICED_S
            )
        )
        self.assertTrue(
            live_peer.becomes_true(lambda: set(client.statuses(*nodes)) == {SENSOR_FAILURE}), "held is not for ever"
        )
        self.assertEqual(
            [client.read(node)[0]["value"] for node in ("Roll.Value", "Stop.State", "Roll.State")], [None, 0, 0]
        )
        after = [
            told["status"]
            for at, told in client.told
            if at > began + NOTICED_S and told["data"] == "PoseWall.Roll.Value"
        ]
        self.assertEqual([status for status in after if is_good(status)], [], "nor is it told by a subscription")
        self.assertTrue(
            live_peer.becomes_true(
                lambda: [told["status"] for _, told in client.told if told["data"] == "PoseWall.Roll.Value"][-1]
                == SENSOR_FAILURE
            )
        )
        self.sensor(port, config)
        self.assertTrue(live_peer.becomes_true(good, 2 * live_peer.PATIENCE_S), daemon.log())

    def sensor(self, port, config):
        program = live_peer.Program(
            SENSOR, "--sensor", "vlp16", "--frames", "70", "--to", f"127.0.0.1:{port}", "--config-to", config
        )
        self.addCleanup(program.kill)
        self.assertTrue(live_peer.becomes_true(config.exists), program.log())
        return program

    def test_a_daemon_that_is_killed_or_frozen_leaves_everything_bad_until_it_is_back(self):
        everything, client, daemon = sorted(table_of_readme()), self.client(), self.daemon()
        self.becomes(client, GOOD, patience_s=2 * live_peer.PATIENCE_S)
        self.becomes(client, GOOD, "Stop.State")
        client.ask("subscribe", nodes=["PoseWall.Yaw.Value"], ms=100)
        self.assertTrue(live_peer.becomes_true(lambda: client.told), "the first value comes at once")
        os.kill(daemon.process.pid, signal.SIGSTOP)
        began = time.monotonic()
        self.becomes(client, NO_COMMUNICATION, "Stop.State", NOTICED_S)
        self.becomes(client, NO_COMMUNICATION, "Yaw.Value", NOTICED_S)
        self.becomes(client, NO_COMMUNICATION, "Health.Grade")
        self.assertLess(time.monotonic() - began, 3 * NOTICED_S)
        self.assertTrue(live_peer.becomes_true(lambda: client.told[-1][1]["status"] == NO_COMMUNICATION))
        os.kill(daemon.process.pid, signal.SIGCONT)
        self.becomes(client, GOOD)
        daemon.kill()
        self.becomes(client, NO_COMMUNICATION, "Yaw.Value", NOTICED_S)
        self.becomes(client, NO_COMMUNICATION, "Health.Grade")
        told = client.read(*everything)
        self.assertEqual({(one["status"], one["value"]) for one in told}, {(NO_COMMUNICATION, None)})
        self.daemon()
        self.becomes(client, GOOD, patience_s=2 * live_peer.PATIENCE_S)
        self.assertEqual(client.told[-1][1]["data"], "PoseWall.Yaw.Value", "the subscription lives on")

    def test_a_gateway_that_was_frozen_tells_nothing_old(self):
        server, client = self.pretender(), self.client()
        self.becomes(client, GOOD)
        os.kill(self.gateway.process.pid, signal.SIGSTOP)
        try:
            server.moves = False
            client.process.stdin.write(json.dumps({"do": "read", "nodes": ["PoseWall.Yaw.Value"]}) + "\n")
            client.process.stdin.flush()
            time.sleep(1.5)  # longer than a result counts; the question waits in the gateway's socket
        finally:
            os.kill(self.gateway.process.pid, signal.SIGCONT)
        self.assertEqual(client.answers.get(timeout=live_peer.PATIENCE_S)["answer"][0]["status"], NO_COMMUNICATION)

    # Each state, and what is malformed.

    def changed(self, **members):
        state = copy.deepcopy(self.real["state.json"])
        for path, value in members.items():
            at, *names = [state, *path.split("__")]
            for name in names[:-1]:
                at = at[int(name) if name.isdigit() else name]
            at[names[-1]] = value
        return state

    def of_yaw(self, state, told_by="frame"):
        empty = {
            "values__yaw__value_rad": None,
            "values__yaw__protection_level_rad": None,
            "values__yaw__sigma_rad": None,
        }
        return self.changed(
            values__yaw__state=state,
            steer__2__may_steer=False,
            told_by=told_by,
            **(empty if state == "invalid" else {}),
        )

    def test_each_state_has_its_status(self):
        server, client = self.pretender(), self.client()
        self.becomes(client, GOOD)
        for state, expected in (
            (self.of_yaw("degraded"), NOT_ACCURATE),
            (self.of_yaw("held"), LAST_USABLE),
            (self.of_yaw("held", "silence"), LAST_USABLE),
            (self.of_yaw("invalid"), BAD),
            (self.of_yaw("invalid", "silence"), SENSOR_FAILURE),
            # Valid, and still not allowed to steer: never Good.
            (self.changed(steer__2__may_steer=False), NOT_ACCURATE),
        ):
            server.says["/state.json"] = state
            self.becomes(client, expected)
            self.assertEqual(client.statuses(*(f"Yaw.{what}" for what in OF_VALUE)), [expected] * 3)
            self.assertEqual(client.statuses("Roll.Value", "Yaw.State", "Yaw.MaySteer"), [GOOD] * 3, "the others go on")
            self.assertEqual(client.read("Yaw.MaySteer")[0]["value"], False)
            value = client.read("Yaw.Value")[0]["value"]
            self.assertEqual(value is None, bool(expected >> 31), "Bad comes without a value")

    def test_what_is_malformed_is_never_told_good(self):
        server, client, whole = self.pretender(), self.client(), self.real["state.json"]
        text = json.dumps(whole).encode()
        wrong = [
            b"",
            b"null",
            b"[]",
            b"{}",
            b"17",
            text[:-1],
            text[: len(text) // 2],
            text + b"}",
            b"\xff\xfe" * 40,
            b"[" * 100000,
            text.replace(b'"value_rad": ', b'"value_rad": 1e999, "x": '),
            b"x" * (1 << 21),
            self.changed(schema=2),
            self.changed(schema="1"),
            self.changed(told_by="nobody"),
            self.changed(values={}),
            self.changed(values=None),
            self.changed(values__yaw=None),
            self.changed(steer=[]),
            self.changed(steer=whole["steer"][:6]),
            self.changed(steer=whole["steer"][::-1]),
            self.changed(steer_line={"en": "x"}),
            self.changed(header_stamp_ns="now"),
            self.changed(header_stamp_ns=None),
            self.changed(config_crc32=-1),
            self.changed(status="fine"),
            self.changed(values__yaw__state="good"),
            self.changed(values__yaw__state="held"),
            self.changed(values__yaw__state="invalid"),
            self.changed(values__yaw__value_rad=None),
            self.changed(values__yaw__value_rad="0.1"),
            self.changed(values__yaw__protection_level_rad=None),
            self.changed(values__yaw__protection_level_rad=-0.001),
            self.changed(values__yaw__protection_level_rad=0.02),
            self.changed(values__yaw__sigma_rad=None),
            self.changed(values__yaw__reasons="none"),
            self.changed(values__yaw__age_s="young"),
            self.changed(steer__2__may_steer=1),
            self.changed(steer__2__limit_rad=None),
        ]
        for body in wrong:
            with self.subTest(
                body=str(body)[:60] if isinstance(body, bytes) else [k for k in body if body[k] != whole[k]]
            ):
                server.says["/state.json"] = lambda _, said=body: (200, said)
                self.assertTrue(
                    live_peer.becomes_true(
                        lambda: not any(map(is_good, client.statuses("Yaw.Value", "Yaw.State", "SteerEn", "StampNs"))),
                        NOTICED_S,
                    ),
                    self.gateway.log(),
                )
                self.assertIn(client.statuses("Yaw.Value")[0], (COMMUNICATION_ERROR, NO_COMMUNICATION))
                server.says["/state.json"] = whole
                self.becomes(client, GOOD)
        self.assertIsNone(self.gateway.process.poll(), self.gateway.log())

    def test_who_repeats_itself_answers_slowly_or_has_nothing_is_no_source(self):
        server, client = self.pretender(), self.client()

        def slowly(answer):
            answer.send_response(200)
            answer.send_header("Content-Length", "5000")
            answer.end_headers()
            with contextlib.suppress(OSError):
                for _ in range(100):
                    answer.wfile.write(b" ")
                    time.sleep(0.05)
            return 200, None

        self.becomes(client, GOOD)
        for say, node, expected in (
            (lambda _: (503, b""), "Yaw.Value", OUT_OF_SERVICE),
            (slowly, "Yaw.Value", NO_COMMUNICATION),
        ):
            server.says["/state.json"] = say
            self.becomes(client, expected, node, NOTICED_S)
            server.says["/state.json"] = self.real["state.json"]
            self.becomes(client, GOOD)
        server.says["/planar.json"] = lambda _: (404, b"")
        self.becomes(client, NOT_CONNECTED, "Stop.State", NOTICED_S)
        for planar in (b"{}", {"stop": {**self.real["planar.json"]["stop"], "state": "run"}}, {"stop": None}):
            server.says["/planar.json"] = planar
            self.becomes(client, COMMUNICATION_ERROR, "Stop.State", NOTICED_S)
        server.says["/planar.json"] = self.real["planar.json"]
        server.says["/health"] = lambda _: (
            503,
            {
                "parts": [
                    {"part": "runtime", "grade": "ok", "summary": "measures", "facts": {}},
                    {"part": "can", "grade": "error", "summary": "bus off", "facts": {}},
                ]
            },
        )
        self.assertTrue(live_peer.becomes_true(lambda: client.read("Health.Summary")[0]["value"] == "can: bus off"))
        self.assertEqual(client.read("Health.Grade")[0]["value"], 2)
        self.becomes(client, GOOD, "Stop.State")
        server.moves = False
        self.becomes(client, NO_COMMUNICATION, "Stop.State", NOTICED_S)
        self.becomes(client, NO_COMMUNICATION, "Yaw.Value", NOTICED_S)

    # Who comes in.

    def test_beyond_loopback_only_who_encrypts_is_trusted_and_knows_the_password_comes_in(self):
        self.pretender()
        port, password = live_peer.free_port(), self.place / "password"
        password.write_text("seam 7\n", encoding="utf-8")
        gateway = self.start_gateway(
            "--port",
            port,
            "--host",
            "0.0.0.0",
            "--daemon",
            f"http://127.0.0.1:{self.behind}",
            "--user",
            "plant",
            "--password-file",
            password,
        )
        self.addCleanup(gateway.kill)
        self.assertIn("error", self.client(port).first, "without security")
        self.assertEqual(
            [(one["mode"], one["policy"]) for one in self.client().first["answer"]],
            [(1, "None"), (3, "Basic256Sha256"), (3, "Aes128_Sha256_RsaOaep"), (3, "Aes256_Sha256_RsaPss")],
            "on loopback",
        )

        def secured(*words):
            shutil.copy(
                ROOT / "tests/live/peer/opcua_secured.mjs", self.place / "gateway"
            )  # by the gateway's own maker
            done = subprocess.run(
                ["node", self.place / "gateway/opcua_secured.mjs", str(port), self.place / "pki", *words],
                capture_output=True,
                text=True,
                timeout=120,
                check=False,
            )
            return [line for line in done.stdout.splitlines() if line.startswith("{")][-1:] or [
                done.stdout + done.stderr
            ]

        self.assertIn("error", json.loads(secured("plant", "seam 7")[0]), "who is not known")
        known = list((self.place / "folder/rejected").glob("*"))
        self.assertEqual(len(known), 1, known)
        shutil.move(known[0], self.place / "folder/trusted/certs")
        self.assertIn("error", json.loads(secured("plant", "seam 8")[0]), "a wrong password")
        self.assertIn("error", json.loads(secured()[0]), "nobody")
        self.assertTrue(
            live_peer.becomes_true(lambda: json.loads(secured("plant", "seam 7")[0]).get("status") == GOOD, 60),
            gateway.log(),
        )
        self.assertTrue(gateway.stops_by_itself(), gateway.log())

    def test_options_that_are_wrong_are_named(self):
        for words, status, said in (
            (["--port", "x"], 2, "--port: x"),
            (["--host", "plant.example"], 2, "--host: plant.example"),
            (["--stale-ms", "5000"], 2, "--stale-ms: 5000"),
            (["--daemon", "ftp://x"], 2, "--daemon: ftp://x"),
            (["--user", "a"], 2, "--password-file go together"),
            (["--nonsense"], 2, "--nonsense"),
            (["--port", str(self.port)], 1, str(self.port)),
            (["--help"], 0, "Look at Objects/PoseWall"),
            (["--version"], 0, "0.2.0"),
        ):
            done = subprocess.run(
                ["node", self.place / "gateway/pose_wall_opcua.mjs", "--folder", self.place / "folder", *words],
                capture_output=True,
                text=True,
                timeout=120,
                check=False,
            )
            self.assertEqual(done.returncode, status, (words, done.stdout, done.stderr))
            self.assertIn(said, done.stdout + done.stderr, words)


if __name__ == "__main__":
    live_peer.main()
