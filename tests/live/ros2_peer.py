#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""pose_walld as a node of ROS 2, seen by another make of DDS (ros2_peer/: Fast DDS) and by tshark. Clouds have 512 kB
and 4 MB, and results come under their stamps. Either side is first, gone and back. Some messages are no clouds, some
types are others, some qualities of service do not match. Transforms are late, missing, changed and old. Discovery says
of the node what it should.

usage: ros2_peer.py ROOT POSE_WALL POSE_WALLD PEER"""

import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT, POSE_WALL, POSE_WALLD, PEER = (pathlib.Path(sys.argv.pop(1)) for _ in range(4))
sys.path[:0] = [str(ROOT / "tests/live")]

import live_peer  # noqa: E402  pylint: disable=wrong-import-position

RESULTS = {"rt/pose_wall/attitude": "geometry_msgs::msg::dds_::Vector3Stamped_",
           "rt/pose_wall/distances": "std_msgs::msg::dds_::Float32MultiArray_",
           "rt/pose_wall/state": "pose_wall_msgs::msg::dds_::State_",
           "rt/pose_wall/points": "sensor_msgs::msg::dds_::PointCloud2_",
           "rt/diagnostics": "diagnostic_msgs::msg::dds_::DiagnosticArray_",
           "rt/tf": "tf2_msgs::msg::dds_::TFMessage_"}
POINTS_OF = {"512 kB": 32768, "4 MB": 262144}  # of 16 bytes


class Peer(live_peer.Program):
    def __init__(self, domain, *words):
        super().__init__(PEER, domain, *words, stdin=subprocess.PIPE)

    def command(self, text):
        self.process.stdin.write(text + "\n")
        self.process.stdin.flush()

    def seen(self, kind):
        told = [json.loads(line) for line in list(self.lines) if line.startswith("{")]
        return [one for one in told if one["saw"] == kind]

    def report(self):
        """The counts of now."""
        before = len(self.seen("report"))
        self.command("report")
        live_peer.becomes_true(lambda: len(self.seen("report")) > before)
        return self.seen("report")[-1]


class Ros2(unittest.TestCase):
    domains = iter(range(100 + os.getpid() % 100, 233))

    def setUp(self):
        self.domain = next(Ros2.domains)

    def daemon(self, *settings, **variables):
        words = [word for setting in settings for word in ("--set", setting)]
        clean = {name: value for name, value in os.environ.items() if not name.startswith(("ROS_", "CYCLONEDDS"))}
        environment = clean | {"ROS_DOMAIN_ID": str(self.domain), "ROS_LOCALHOST_ONLY": "1"} | variables
        program = live_peer.Program(POSE_WALLD, "--set", "source=ros2", "--set", "ros2=1", "--set", "status_every_s=1",
                                    *words, env=environment)
        self.addCleanup(program.kill)
        return program

    def peer(self, *words):
        program = Peer(self.domain, *words)
        self.addCleanup(program.kill)
        return program

    def comes_true(self, condition, *programs):
        self.assertTrue(live_peer.becomes_true(condition), "\n---\n".join(program.log() for program in programs))


class Clouds(Ros2):
    def run_of(self, size, rate, reliability, **variables):
        program = self.daemon(**variables)
        peer = self.peer(f"points={POINTS_OF[size]}", f"hz={rate}", "count=50", f"reliability={reliability}",
                         "results=1", "labelled=1")
        self.assertTrue(peer.says('"saw": "end"', 90), peer.log() + program.log())
        told = peer.seen("report")[-1]
        print(f"{size} at {rate} Hz, {reliability}: {told['attitudes']} of {told['sent']} answered, "
              f"median {told['median_ms']:.1f} ms, worst {told['worst_ms']:.1f} ms", flush=True)
        return program, told

    def test_are_answered_under_their_stamps(self):
        for size, rate, reliability in (("512 kB", 10, "best_effort"), ("512 kB", 20, "reliable"),
                                        ("4 MB", 10, "best_effort"), ("4 MB", 10, "reliable")):
            program, told = self.run_of(size, rate, reliability)
            self.assertEqual(told["sent"], 50)
            # How many hangs on what else the machine has to do; those that were not answered are accounted for below.
            self.assertGreater(told["attitudes"], 0, program.log())
            self.assertEqual(told["valid"], told["attitudes"], program.log())
            self.assertEqual((told["frame"], told["label"]), ("base_link", "d_lf d_lb d_rf d_rb"))
            self.assertLess(abs(told["roll_rad"]), 0.002)
            for topic in ("state", "points", "tf", "diagnostics"):
                self.assertGreater(told[topic], 0, topic)
            self.assertTrue(program.stops_by_itself(), program.log())
            self.assertEqual(live_peer.lost_frames(program), 0, program.log())

    def test_a_small_buffer_is_told_with_the_remedy(self):
        small = ("<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/>"
                 "</Interfaces></General><Internal><SocketReceiveBufferSize max=\"100 kB\"/></Internal>"
                 "</Domain></CycloneDDS>")
        program, told = self.run_of("4 MB", 10, "best_effort", CYCLONEDDS_URI=small)
        self.assertIn("net.core.rmem_max", program.log() + "\n".join(program.lines))
        self.assertIn("warning", next(line for line in program.lines if "net.core.rmem_max" in line))
        self.assertLess(told["attitudes"], 50, "the buffer was small")


    def test_a_cloud_beyond_what_is_allowed_is_told(self):
        program = self.daemon("frame_points_max=1000")
        self.peer(f"points={POINTS_OF['4 MB']}")
        self.assertTrue(program.says("Clouds above 1.1 MB are not taken (frame_points_max)"), program.log())


class Peers(Ros2):
    def test_either_comes_first_goes_and_comes_back(self):
        peer = self.peer("points=16384", "wait=0", "results=1")
        time.sleep(1)
        program = self.daemon()
        self.assertTrue(program.says("runtime: measures"), program.log())
        self.comes_true(lambda: peer.report()["valid"] > 5, peer, program)
        peer.kill()  # without a word: its lease ends
        self.assertTrue(program.says("no frame comes"), program.log())
        self.comes_true(lambda: any("nobody publishes" in line for line in program.lines[-10:]), program)
        count = len([line for line in program.lines if "runtime: measures" in line])
        second = self.peer("points=16384", "results=1")
        self.comes_true(lambda: second.report()["valid"] > 5, second, program)
        self.assertGreater(len([line for line in program.lines if "runtime: measures" in line]), count)
        program.stop()
        third = self.daemon()
        self.assertTrue(third.says("runtime: measures"), third.log())
        second.command("quit")
        self.assertTrue(third.says("nobody publishes /lidar/points"), third.log())

    def test_a_reader_that_hangs_holds_up_nobody(self):
        program = self.daemon()
        peer = self.peer("points=32768", "results=1")
        hanging = self.peer("results=1", "labelled=1")
        self.comes_true(lambda: hanging.report().get("points", 0) > 5, hanging, program)
        os.kill(hanging.process.pid, signal.SIGSTOP)
        try:
            before = peer.report()  # then, for as long as the other takes nothing, results come
            self.comes_true(lambda: peer.report()["valid"] >= before["valid"] + 50, peer, program)
            after = peer.report()
        finally:
            os.kill(hanging.process.pid, signal.SIGCONT)
        sent, valid = after["sent"] - before["sent"], after["valid"] - before["valid"]
        print(f"beside a reader that hangs: {valid} of {sent} answered, median {after['median_ms']:.1f} ms", flush=True)
        count = hanging.report()["points"]
        self.comes_true(lambda: hanging.report()["points"] > count + 5, hanging, program)

    def test_what_is_no_cloud_is_counted_and_named(self):
        peer = self.peer("points=16384", "reliability=reliable", "results=1")
        program = self.daemon()
        self.comes_true(lambda: peer.report()["valid"] > 5, peer, program)
        peer.command("junk")
        self.comes_true(lambda: any(re.search("messages refused [1-9]", line) for line in program.lines[-10:]), program)
        before = peer.report()["valid"]
        self.comes_true(lambda: peer.report()["valid"] > before + 5, peer, program)

    def test_another_type_on_the_topic_is_named(self):
        program = self.daemon()
        self.peer("points=64", "type=std_msgs::msg::dds_::String_", "wait=0")
        self.assertTrue(program.says("is of type std_msgs::msg::dds_::String_, this node's is "
                                     "sensor_msgs::msg::dds_::PointCloud2_"), program.log())
        peer = self.peer("points=16384", "results=1")  # one that is right is read all the same
        self.comes_true(lambda: peer.report()["valid"] > 5, peer, program)

    def test_clouds_of_livox_are_read_by_their_type(self):
        program = self.daemon()
        livox = self.peer("points=16384", "type=livox_ros_driver2::msg::dds_::CustomMsg_", "results=1")
        self.comes_true(lambda: livox.report()["valid"] > 5, livox, program)
        livox.command("quit")
        self.assertTrue(program.says("nobody publishes"), program.log())
        peer = self.peer("points=16384", "results=1")
        self.comes_true(lambda: peer.report()["valid"] > 5, peer, program)

    def test_qualities_of_service_that_do_not_match_are_named(self):
        program = self.daemon("extrinsic_from=tf")
        peer = self.peer("results=1", "durability=transient_local", "static_latched=0")
        self.assertTrue(program.says("/pose_wall/attitude: the reader"), program.log())
        self.assertTrue(program.says("durability: the writer offers volatile, the reader asks for transient local"),
                        program.log())
        self.assertTrue(program.says("/tf_static: the writer"), program.log())
        self.comes_true(lambda: peer.seen("incompatible"), peer)
        peer.command("quit")
        self.comes_true(lambda: any("sink ros2: publishes" in line for line in program.lines[-20:]), program)

    def test_settings_that_are_none_end_the_start(self):
        for name, value in (("ROS_DOMAIN_ID", "300"), ("ROS_LOCALHOST_ONLY", "perhaps")):
            program = self.daemon(**{name: value})
            program.process.wait(live_peer.PATIENCE_S)
            self.assertNotEqual(program.process.returncode, 0)
            self.assertTrue(program.says(f"{name} is '{value}'"), program.log())


class Planar(Ros2):
    def test_scan_map_place_and_stop(self):
        self.peer("points=65536", "reliability=reliable")
        program = self.daemon("planar=map", "planar_map_every_s=3600")
        self.assertTrue(program.says("planar roadway: maps"), program.log())
        late = self.peer("results=1", "planar=1")  # it gets the only map because that is latched
        self.comes_true(lambda: late.seen("map"), late, program)
        told = late.seen("map")[0]
        self.assertEqual((told["frame"], told["w"]), ("map", 1))
        self.assertEqual(told["cells"], told["width"] * told["height"])
        self.assertAlmostEqual(told["resolution_m"], 0.05, places=5)
        self.assertGreater(told["things"], 100)
        topics = ("scan", "pose", "pose_wall/stop", "pose_wall/stop_state")
        self.comes_true(lambda: all(late.report().get(topic, 0) > 3 for topic in topics), late, program)
        writers = {one["topic"]: one["type"] for one in late.seen("writer")}
        self.assertEqual(writers["rt/map"], "nav_msgs::msg::dds_::OccupancyGrid_")


class Commands(Ros2):
    """What the drive is told, as Twist and as TwistStamped."""

    def test_both_kinds_are_read_and_what_is_none_is_named(self):
        program = self.daemon("planar=map", "planar_motion=commanded", "planar_command_ros=cmd_vel",
                              "planar_command_age=1")
        self.assertTrue(program.says("nobody publishes cmd_vel"), program.log())
        for stamped, speed in ((0, "0.250"), (1, "-0.125")):
            peer = self.peer("twist=rt/cmd_vel", f"stamped={stamped}")

            def is_told(peer=peer, speed=speed):
                peer.command(f"drive {speed}")
                return any(f"command m/s {speed}; command rad/s -0.100" in line for line in program.lines[-20:])

            self.comes_true(is_told, program)
            if stamped:
                peer.command("aside 0.5")
                self.assertTrue(program.says("the newest command was refused"), program.log())
                self.assertTrue(program.says("last refusal linear.y is 0.5; 0 is allowed"), program.log())
            peer.command("quit")


class Transforms(Ros2):
    def left_is(self, peer, wanted_m):
        left_m = peer.report()["left_m"]
        return left_m is None if wanted_m is None else left_m is not None and abs(left_m - wanted_m) < 0.05

    def test_late_changed_and_old(self):
        peer = self.peer("points=16384", "results=1")
        program = self.daemon("extrinsic_from=tf")
        self.assertTrue(program.says("no transform from 'lidar' to 'base_link': nothing is measured"), program.log())
        time.sleep(1)
        self.assertEqual(peer.report()["valid"], 0, "never the identity by default")
        peer.command("static 0.5")
        self.comes_true(lambda: self.left_is(peer, 2.0) or self.left_is(peer, 3.0), peer, program)
        first_m = peer.report()["left_m"]
        peer.command("static -0.5")
        self.comes_true(lambda: self.left_is(peer, 5.0 - first_m), peer, program)
        peer.command("moving 0.2")  # from now on by /tf, which grows old
        self.comes_true(lambda: self.left_is(peer, 2.5 + (0.2 if first_m > 2.5 else -0.2)), peer, program)
        self.assertTrue(program.says("tf: the transform is gone; nothing is measured"), program.log())

    def test_a_static_one_that_was_there_before(self):
        peer = self.peer("points=16384", "results=1")
        peer.command("static 0.5")
        program = self.daemon("extrinsic_from=tf")
        self.comes_true(lambda: peer.report()["valid"] > 5, peer, program)


class Discovery(Ros2):
    def discovered(self, distro):
        """Either distro's way of keeping to this machine; the later one is all unicast to localhost."""
        is_humble = distro == "humble"
        variables = {} if is_humble else {"ROS_LOCALHOST_ONLY": "", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
        program = self.daemon(f"ros_distro={distro}", **variables)
        peer = self.peer("results=1", "range=loopback" if is_humble else "range=localhost")
        self.comes_true(lambda: {one["topic"] for one in peer.seen("writer")} >= set(RESULTS), peer, program)
        self.comes_true(lambda: {one["topic"] for one in peer.seen("reader")} >= {"rt/lidar/points"}, peer, program)
        self.comes_true(lambda: peer.seen("graph") and self.entities(peer) >= 1 + len(RESULTS), peer, program)
        return peer

    def entities(self, peer):
        """How many of the newest graph are the participant's that sent it."""
        graph = bytes.fromhex(peer.seen("graph")[-1]["hex"])[4:]
        return graph[16:].count(graph[:12])

    def of_the_daemon(self, peer):
        """Topics, types and words of what the peer does not have itself."""
        writers = {one["topic"]: one for one in peer.seen("writer") if one["topic"] in set(RESULTS) - {"rt/tf"}}
        readers = {one["topic"]: one for one in peer.seen("reader") if one["topic"] == "rt/lidar/points"}
        return writers | readers

    def check_graph(self, peer, gid_bytes):
        graph = bytes.fromhex(peer.seen("graph")[-1]["hex"])[4:]
        gid, rest = graph[:16], graph[gid_bytes:]
        self.assertEqual(graph[16:gid_bytes], bytes(gid_bytes - 16))
        self.assertEqual(rest[:8], (1).to_bytes(4, "little") + (2).to_bytes(4, "little"))
        self.assertIn(b"pose_walld\0", rest)
        self.assertEqual(rest.count(gid[:12]), 1 + len(RESULTS), "a reader of clouds, and the writers")

    def test_of_humble(self):
        peer = self.discovered("humble")
        self.assertEqual(peer.seen("participant")[0]["user_data"], "enclave=/;")
        seen = self.of_the_daemon(peer)
        self.assertEqual({topic: one["type"] for topic, one in seen.items() if topic != "rt/lidar/points"},
                         {topic: kind for topic, kind in RESULTS.items() if topic != "rt/tf"})
        self.assertEqual({one["user_data"] for one in seen.values()}, {""})
        self.check_graph(peer, 24)

    def test_of_iron_and_later(self):
        peer = self.discovered("iron")
        self.assertEqual(peer.seen("participant")[0]["user_data"], "enclave=/;")
        seen = self.of_the_daemon(peer)
        for one in seen.values():
            self.assertRegex(one["user_data"], "^typehash=RIHS01_[0-9a-f]{64};$")
        self.assertIn("RIHS01_9198cabf", seen["rt/lidar/points"]["user_data"])
        self.assertIn("RIHS01_d4829622", seen["rt/pose_wall/attitude"]["user_data"])
        self.check_graph(peer, 16)

    def takes_a_datagram(self, capture):
        """Sends one to nobody, and looks whether anything was captured yet."""
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as nobody:
            nobody.sendto(b"is this seen?", ("127.0.0.1", 9))
        return capture.exists() and b"is this seen?" in capture.read_bytes()

    def of_cyclone(self, capture):
        """Its messages, in tshark's words, as far as they are written."""
        words = ["tshark", "-r", str(capture), "-Y", "rtps", "-O", "rtps"]
        read = subprocess.run(words, capture_output=True, text=True, timeout=120, check=False).stdout
        parts = (part for part in re.split(r"\nFrame \d+", read) if "Eclipse" in part or "Cyclone" in part)
        return "\n".join(parts).replace("topicName", "topic").replace("topic name", "topic")

    def test_on_the_wire_by_tshark(self):
        if os.geteuid() != 0 or not shutil.which("tshark"):
            self.skipTest("SKIPPED: a capture takes root and tshark")
        with tempfile.TemporaryDirectory() as folder:
            os.chmod(folder, 0o777)
            capture = pathlib.Path(folder) / "discovery.pcapng"
            tshark = live_peer.Program("tshark", "-i", "lo", "-f", "udp", "-w", capture)
            self.addCleanup(tshark.kill)
            if not live_peer.becomes_true(lambda: self.takes_a_datagram(capture)):
                self.skipTest(f"SKIPPED: tshark cannot capture here: {tshark.log()}")
            self.discovered("iron")
            # What was sent is written some time later.
            live_peer.becomes_true(lambda: all(f"topic: {topic}" in self.of_cyclone(capture) for topic in RESULTS))
            text = self.of_cyclone(capture)
            self.assertTrue(text, f"no messages of Cyclone among {capture.stat().st_size} bytes: {tshark.log()}")
            tshark.stop()
        for topic, kind in RESULTS.items():
            self.assertIn(f"topic: {topic}", text)
            self.assertIn(kind, text)
        self.assertIn(b"enclave=/;".hex(), text.replace(":", "").lower() + text.lower())


if __name__ == "__main__":
    live_peer.main()
