#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""pose_walld as the service manager and people at the terminal meet it. It starts before its sensor, and survives its
loss and a restart of either side. It stops within a second. It tells what is wrong with words or settings. What is
recorded is readable after a kill at any moment.

usage: daemon_peer.py ROOT POSE_WALL POSE_WALLD POSE_WALL_SENSOR"""

import os
import pathlib
import random
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT, POSE_WALL, POSE_WALLD, SENSOR = (pathlib.Path(sys.argv.pop(1)) for _ in range(4))
sys.path[:0] = [str(ROOT / "tests/live")]

import live_peer  # noqa: E402  pylint: disable=wrong-import-position


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def start(self, *words, **options):
        program = live_peer.Program(*words, **options)
        self.addCleanup(program.kill)
        return program


class Sensor(Folder):
    def sensor(self, port, *more):
        return self.start(SENSOR, "--sensor", "vlp16", "--frames", "70", "--to", f"127.0.0.1:{port}", "--config-to",
                          self.folder / "sensor.yaml", *more)

    def test_starts_before_the_sensor_and_survives_restarts_of_either_side(self):
        port = live_peer.free_port(socket.SOCK_DGRAM)
        daemon_words = [POSE_WALLD, "--config", ROOT / "config/vlp16.yaml", "--set", f"udp_port={port}", "--set",
                        "status_every_s=1"]
        daemon = self.start(*daemon_words)
        self.assertTrue(daemon.says("waits for the sensor: no packet yet"), daemon.log())
        first = self.sensor(port)
        self.assertTrue(daemon.says("runtime: measures"), daemon.log())
        first.kill()
        self.assertTrue(daemon.says("the sensor is silent"), daemon.log())
        second = self.sensor(port)
        self.assertTrue(live_peer.becomes_true(lambda: live_peer.fact(daemon, "source udp", "silences") == 1),
                        daemon.log())
        newest = lambda: [line for line in daemon.lines if " source udp" in line][-1]
        self.assertTrue(live_peer.becomes_true(lambda: "receives" in newest()))
        daemon.kill()
        again = self.start(*daemon_words)
        self.assertTrue(again.says("runtime: measures"), again.log())
        self.assertTrue(again.stops_by_itself(), again.log())
        self.assertEqual(again.process.returncode, 0)
        self.assertIsNone(second.process.poll(), "the sensor cares for nobody")

    def test_an_address_that_comes_later_is_waited_for(self):
        inside = ["unshare", "--user", "--map-root-user", "--net", "--pid", "--fork", "--kill-child"]
        if subprocess.run([*inside, "ip", "link", "set", "lo", "up"], capture_output=True, check=False).returncode != 0:
            self.skipTest("no network of its own can be had here (unshare --net, ip)")
        words = [POSE_WALLD, "--config", ROOT / "config/vlp16.yaml", "--set", "udp_address=192.0.2.1", "--set",
                 "udp_port=2368"]
        sensor = [SENSOR, "--sensor", "vlp16", "--frames", "70", "--to", "192.0.2.1:2368", "--config-to",
                  self.folder / "sensor.yaml"]
        script = (f"ip link set lo up; {shlex.join(map(str, words))} & daemon=$!; read go; "
                  f"ip address add 192.0.2.1/32 dev lo; {shlex.join(map(str, sensor))} & "
                  "read go; kill $daemon $!; wait")
        both = self.start(*inside, "sh", "-c", script, stdin=subprocess.PIPE)
        missed = "no interface of this machine has udp_address 192.0.2.1"
        self.assertTrue(both.says(missed), both.log())
        time.sleep(0.5)
        both.process.stdin.write("go\n")
        both.process.stdin.flush()
        self.assertTrue(both.says("runtime: measures"), both.log())
        self.assertEqual(sum(missed in line for line in both.lines), 1, "told once")
        both.process.stdin.close()
        both.process.wait(live_peer.PATIENCE_S)

    def test_nothing_is_lost_unaccounted_for(self):
        port = live_peer.free_port(socket.SOCK_DGRAM)
        daemon = self.start(POSE_WALLD, "--config", ROOT / "config/vlp16.yaml", "--set", f"udp_port={port}", "--set",
                            "status_every_s=1")
        self.assertTrue(daemon.says("listens"))
        sensor = self.sensor(port, "--seconds", "5")
        self.assertEqual(sensor.process.wait(60), 0)
        self.assertTrue(daemon.says("the sensor is silent"))
        daemon.stop()
        frames = live_peer.fact(daemon, "source udp", "frames")
        pushed = live_peer.fact(daemon, "runtime", "frames pushed")
        self.assertEqual(frames, 49, "of fifty turns the last has no end")
        self.assertEqual(pushed, frames)
        self.assertEqual(live_peer.fact(daemon, "source udp", "packets"), 50 * 75)


class Words(Folder):
    def refused(self, words, status, *needles):
        done = subprocess.run([str(POSE_WALLD), *map(str, words)], capture_output=True, text=True, timeout=30,
                              check=False)
        self.assertEqual(done.returncode, status, done.stderr)
        for needle in needles:
            self.assertIn(needle, done.stderr)

    def test_what_is_wrong_is_named(self):
        self.refused(["--set", "modbsu=127.0.0.1:502"], 2, "unknown key 'modbsu'; did you mean 'modbus'?")
        self.refused(["--http", "8080"], 2, "http: '8080' is refused; allowed: HOST:PORT")
        self.refused(["--config", self.folder / "none.yaml"], 2, "none.yaml: no such file")
        self.refused(["--replay", self.folder / "none.pcd"], 1, "none.pcd: is not there")
        empty = self.folder / "empty"
        empty.mkdir()
        (empty / "broken.pcd").write_text("no cloud")
        self.refused(["--replay", empty], 1, "the inputs hold no cloud that can be read (1 are unreadable)", str(empty))
        self.refused(["--speed", "2"], 2, "--replay")
        self.refused(["--sped", "2"], 2, "--sped")
        self.refused(["--set", "udp_address=sensor"], 2, "udp_address: 'sensor' is refused; allowed: an IPv4 address")
        self.refused(["--set", "sensor=vlp61"], 2, "sensor: 'vlp61' is refused; allowed: ", "did you mean 'vlp16'?")
        self.refused(["--set", "planar=on"], 2, "planar: 'on' is refused; allowed: one of off, map, localise")
        self.refused(["--set", "planar_stale=2"], 2, "planar_stale: '2' is refused; allowed: a number from 0.02 to 1 s")
        self.refused(["--set", "planar=localise"], 2, "planar: localise needs planar_map")
        port = f"udp_port={live_peer.free_port(socket.SOCK_DGRAM)}"
        self.refused(["--set", port, "--set", "planar=localise", "--set", "planar_map=/nowhere/trail.pwt"], 1,
                     "planar_map: /nowhere/trail.pwt: cannot be read: No such file or directory")
        blocked = self.folder / "file"
        blocked.write_text("")
        self.refused(["--set", port, "--set", "planar=map", "--set", f"planar_map={self.folder}/none/trail.pwt"], 1,
                     f"planar_map: {self.folder}/none/trail.pwt: there is no folder {self.folder}/none")
        self.refused(["--set", "mqtt=127.0.0.1:1883", "--set", "mqtt_user=a", "--set", "mqtt_password_file=/nowhere"],
                     1, "mqtt_password_file: /nowhere: cannot be read: No such file or directory")
        self.refused(["--set", f"recording={blocked}/x"], 1, f"{blocked}/x: ")
        self.refused(["--set", f"black_box={blocked}/x"], 1, f"{blocked}/x: ")

    def test_help_and_version(self):
        for words in (["--help"], ["--version"]):
            done = subprocess.run([str(POSE_WALLD), *words], capture_output=True, text=True, check=True)
            self.assertIn("pose_walld", done.stdout)

    def test_chinese(self):
        done = subprocess.run([str(POSE_WALLD), "--help", "--language", "zh"], capture_output=True, text=True,
                              check=True)
        for part in ("用法:", "选项:", "上电即持续测量", "显示本帮助后退出", "退出码："):
            self.assertIn(part, done.stdout)
        for word in ("Usage", "Options", "Needs", "Print", "Exit"):
            self.assertNotIn(word, done.stdout)
        self.refused(["--language", "zh", "--sped", "2"], 2, "未知选项 --sped；是否指“--speed”？", "参见 pose_walld --help。")
        self.refused(["--language", "zh", "--speed", "2"], 2, "使用 --speed 时需同时给出 --replay")

    def test_the_log_is_chinese(self):
        road = live_peer.simulated_road(POSE_WALL)
        daemon = live_peer.Program(*live_peer.replay_words(POSE_WALLD, road, "--language", "zh", "--set",
                                                           f"modbus=127.0.0.1:{live_peer.free_port()}"))
        self.addCleanup(daemon.kill)
        self.assertTrue(daemon.says("测量: 正在测量"), daemon.log())
        for part in ("参数: 参数 CRC：16#", "输出 modbus 127.0.0.1:", "能访问此地址者均可读取过程映像，任何人都不能写入", "输入 回放: 正在回放"):
            self.assertTrue(daemon.says(part), daemon.log())
        daemon.stop()
        self.assertTrue(daemon.says("pose_walld: 按要求停止"), daemon.log())
        # Names, numbers and settings stay; sentences do not.
        for line in daemon.lines:
            self.assertNotRegex(line, r"\b(the|is|are|comes|serves|plays|measures)\b", line)


class Settings(Folder):
    """SIGHUP reads the settings again."""

    def setUp(self):
        super().setUp()
        self.file = self.folder / "pose_wall.yaml"
        self.port = live_peer.free_port(socket.SOCK_DGRAM)

    def write(self, *lines):
        self.file.write_text("\n".join([f"udp_port: {self.port}", *lines, ""]), encoding="utf-8")

    def daemon(self, *lines):
        self.write(*lines)
        daemon = self.start(POSE_WALLD, "--config", self.file, stdin=subprocess.DEVNULL)
        self.assertTrue(daemon.says("listens"), daemon.log())
        return daemon

    def reload(self, daemon, *lines):
        self.write(*lines)
        daemon.process.send_signal(signal.SIGHUP)

    def test_what_can_change_changes_and_the_rest_is_named(self):
        daemon = self.daemon("status_every_s: 3600", "hold_max: 1.0")
        self.reload(daemon, "status_every_s: 1", "hold_max: 2.0", "planar: map", f"recording: {self.folder}/kept")
        self.assertTrue(daemon.says("settings: read again: 1 changed, 3 wait for a restart"), daemon.log())
        for line in ("settings: status_every_s: 1 instead of 3600",
                     f"settings: recording: {self.folder}/kept instead of '': waits for a restart",
                     "settings: hold_max: 2 instead of 1: waits for a restart",
                     "settings: planar: map instead of off: waits for a restart"):
            self.assertTrue(any(line in said for said in daemon.lines), line + "\n" + daemon.log())
        self.assertTrue(daemon.says("frames measured 0"), "a status line comes each second")
        self.reload(daemon, "status_every_s: 1", "hold_max: 1.0")
        self.assertTrue(daemon.says("settings: read again: 0 changed, 0 wait for a restart"), daemon.log())
        self.assertFalse((self.folder / "kept").exists(), "nothing is recorded before a restart")
        self.assertIsNone(daemon.process.poll())
        self.assertTrue(daemon.stops_by_itself(), daemon.log())

    def test_a_faulty_file_changes_nothing(self):
        daemon = self.daemon("status_every_s: 3600")
        self.reload(daemon, "status_every_s: 1", "hold_mx: 2.0")
        self.assertTrue(daemon.says("settings: read again and refused: nothing is changed"), daemon.log())
        self.assertTrue(daemon.says("unknown key 'hold_mx'; did you mean 'hold_max'?"), daemon.log())
        self.file.unlink()
        daemon.process.send_signal(signal.SIGHUP)
        self.assertTrue(daemon.says("no such file"), daemon.log())
        time.sleep(1.5)
        self.assertFalse(any("frames measured" in line for line in daemon.lines), "no status line came")
        self.assertTrue(daemon.stops_by_itself(), daemon.log())

    def test_the_log_is_as_grave_as_asked(self):
        daemon = self.daemon("log_level: error", "status_every_s: 1")
        self.assertTrue(daemon.says("runtime: no frame yet"), daemon.log())
        self.assertTrue(any("config: log_level: error" in line for line in daemon.lines), "the start is always told")
        self.assertTrue(daemon.stops_by_itself(), daemon.log())
        self.assertFalse(any("stops, as asked" in line for line in daemon.lines), daemon.log())
        daemon = self.daemon("log_level: error", "status_every_s: 1")
        self.reload(daemon, "log_level: info", "status_every_s: 1")
        self.assertTrue(daemon.says("settings: log_level: info instead of error"), daemon.log())
        self.assertTrue(daemon.stops_by_itself(), daemon.log())
        self.assertTrue(daemon.says("stops, as asked"), daemon.log())

    def test_at_a_terminal_it_ends_with_it(self):
        mine, its = os.openpty()
        self.addCleanup(os.close, mine)
        self.write()
        daemon = self.start(POSE_WALLD, "--config", self.file, stdin=its)
        os.close(its)
        self.assertTrue(daemon.says("listens"), daemon.log())
        daemon.process.send_signal(signal.SIGHUP)
        self.assertEqual(daemon.process.wait(live_peer.PATIENCE_S), 0, daemon.log())


class Service(Folder):
    def test_tells_the_service_manager(self):
        place = str(self.folder / "notify")
        manager = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.addCleanup(manager.close)
        manager.bind(place)
        manager.settimeout(live_peer.PATIENCE_S)
        daemon = self.start(POSE_WALLD, "--set", f"udp_port={live_peer.free_port(socket.SOCK_DGRAM)}",
                            env=os.environ | {"NOTIFY_SOCKET": place, "WATCHDOG_USEC": "200000"})
        told = [manager.recv(1000) for _ in range(4)]
        self.assertIn(b"READY=1", told)
        self.assertGreaterEqual(told.count(b"WATCHDOG=1"), 2)
        for stop in (signal.SIGTERM,):
            daemon.process.send_signal(stop)
        self.assertEqual(daemon.process.wait(live_peer.PATIENCE_S), 0)
        manager.setblocking(False)
        rest = []
        try:
            while True:
                rest.append(manager.recv(1000))
        except BlockingIOError:
            pass
        self.assertIn(b"STOPPING=1", rest)

    def test_stops_by_every_usual_signal(self):
        for stop in (signal.SIGINT, signal.SIGTERM):
            daemon = self.start(POSE_WALLD, "--set", f"udp_port={live_peer.free_port(socket.SOCK_DGRAM)}")
            self.assertTrue(daemon.says("listens"))
            daemon.process.send_signal(stop)
            self.assertEqual(daemon.process.wait(live_peer.PATIENCE_S), 0, stop)

    def test_somebody_who_has_looked_is_heard(self):
        for planar, answer in (("map", "somebody has looked: nothing is close around the machine"),
                               ("off", "somebody has looked, but the key `planar` is off")):
            daemon = self.start(POSE_WALLD, "--set", f"udp_port={live_peer.free_port(socket.SOCK_DGRAM)}", "--set",
                                f"planar={planar}")
            self.assertTrue(daemon.says("listens"))
            daemon.process.send_signal(signal.SIGUSR1)
            self.assertTrue(daemon.says(answer), daemon.log())
            self.assertEqual(any("planar stop: stops" in line for line in daemon.lines), planar == "map")
            self.assertTrue(daemon.stops_by_itself(), daemon.log())
            self.assertEqual(daemon.process.returncode, 0)

    def test_the_unit_file_is_sound(self):
        if not shutil.which("systemd-analyze"):
            self.skipTest("no systemd-analyze here (package systemd)")
        unit = self.folder / "pose_walld.service"
        text = (ROOT / "tools/apps/live/pose_walld.service").read_text(encoding="utf-8")
        unit.write_text(text.replace("/usr/bin/pose_walld", str(POSE_WALLD)), encoding="utf-8")
        done = subprocess.run(["systemd-analyze", "verify", str(unit)], capture_output=True, text=True, check=False)
        self.assertNotIn("Unknown", done.stderr)
        self.assertNotIn("Failed to parse", done.stderr)


class Recordings(Folder):
    def test_are_readable_after_a_kill_at_any_moment(self):
        road = live_peer.simulated_road(POSE_WALL)
        random_s = random.Random(11)
        for turn in range(4):
            recording, box = self.folder / f"rec{turn}", self.folder / f"box{turn}"
            daemon = self.start(*live_peer.replay_words(
                POSE_WALLD, road, "--set", f"recording={recording}", "--set", "recording_clouds=1", "--set",
                "recording_mb=100", "--set", f"black_box={box}", "--set", "black_box_mb=200", "--set",
                "status_every_s=1"))
            # What the disk has by then is not lost. Some of it tells of silence, before the first frame.
            self.assertTrue(live_peer.becomes_true(
                lambda told=daemon: live_peer.fact(told, "sink recorder", "results recorded") >= 20 and
                live_peer.fact(told, "runtime", "black box written") >= 20), daemon.log())
            time.sleep(random_s.random())  # at any moment
            daemon.process.kill()
            daemon.process.wait()
            measured = 0
            for file in sorted(recording.glob("*.mcap")):
                subprocess.run([str(POSE_WALL), "run", "--config", str(road / "pose_wall.yaml"), str(file), "--output",
                                str(self.folder / "out.csv")], capture_output=True, text=True, check=False)
                rows = (self.folder / "out.csv").read_text(encoding="utf-8").splitlines()[1:]
                measured += sum(",unreadable," not in row for row in rows)
            self.assertGreater(measured, 8, "all but the chunk that was being gathered")
            for file in box.glob("*.box"):
                done = subprocess.run([str(POSE_WALL), "replay-box", str(file)], capture_output=True, text=True,
                                      check=False)
                self.assertIn(" 0 otherwise", done.stdout, done.stderr)
                self.assertGreater(int(done.stdout.split(" bit for bit")[0].split()[-1]), 8, done.stdout)

    def test_take_no_more_than_their_room(self):
        road = live_peer.simulated_road(POSE_WALL)
        recording = self.folder / "rec"
        words = live_peer.replay_words(POSE_WALLD, road, "--speed", "4", "--set", f"recording={recording}", "--set",
                                       "recording_clouds=1", "--set", "recording_mb=40")
        daemon = self.start(*words)
        self.assertTrue(live_peer.becomes_true(lambda: len(list(recording.glob("*.mcap"))) > 3))
        self.assertTrue(live_peer.becomes_true(lambda: not list(recording.glob("000001_*"))), "the oldest goes first")
        self.assertLess(sum(file.stat().st_size for file in recording.glob("*.mcap")), 48e6)
        self.assertTrue(daemon.stops_by_itself(), daemon.log())
        last = sorted(recording.glob("*.mcap"))[-1]
        done = subprocess.run([str(POSE_WALL), "info", str(last)], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""), "what was stopped cleanly has its footer")


if __name__ == "__main__":
    live_peer.main()
