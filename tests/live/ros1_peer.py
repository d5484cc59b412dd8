#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""pose_walld as a node of ROS 1, with peers that others wrote. A JavaScript client publishes clouds of 512 kB and 4 MB
at 10 and 20 Hz. It reads the results under the clouds' stamps, and so do rostopic and rosbag. The master comes late and
is started anew. The transform comes late, is missing and changes. The process of roscpp is killed and stopped at random
moments, and everything else goes on.

usage: ros1_peer.py ROOT POSE_WALL POSE_WALLD NODE_MODULES"""

import array
import contextlib
import json
import math
import os
import pathlib
import random
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import urllib.error
import urllib.request

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT, POSE_WALL, POSE_WALLD, MODULES = (pathlib.Path(sys.argv.pop(1)) for _ in range(4))
sys.path[:0] = [str(ROOT / "tests/live")]

import live_peer  # noqa: E402  pylint: disable=wrong-import-position

# rostopic reads by the packages of the messages, diagnostic_msgs among them.
live_peer.need("python3-rospy python3-rosbag python3-rosmaster python3-rostopic python3-std-msgs python3-geometry-msgs "
               "python3-sensor-msgs python3-tf2-msgs python3-diagnostic-msgs",
               programs=("rosmaster", "rostopic", "rosbag"),
               modules=("genpy", "rosbag", "rospy", "std_msgs", "geometry_msgs", "sensor_msgs", "tf2_msgs",
                        "diagnostic_msgs"))

# pylint: disable=wrong-import-position
import genpy.dynamic  # noqa: E402
import rosbag  # noqa: E402
import rospy  # noqa: E402
from geometry_msgs.msg import TransformStamped, Twist, TwistStamped, Vector3Stamped  # noqa: E402
from sensor_msgs.msg import LaserScan, PointCloud2, PointField  # noqa: E402
from std_msgs.msg import Float32MultiArray  # noqa: E402
from tf2_msgs.msg import TFMessage  # noqa: E402

# pylint: enable=wrong-import-position

if sys.argv[1:] == ["drive"]:  # called by the test, with its environment
    URI = os.environ["ROS_MASTER_URI"]
else:
    PORT = live_peer.free_port()
    URI = f"http://127.0.0.1:{PORT}"
    os.environ |= {"ROS_MASTER_URI": URI, "ROS_IP": "127.0.0.1"}
TOPIC = "/lidar/points"
KILLS = 10


def master():
    return live_peer.Program("rosmaster", "--core", "-p", PORT)


def master_answers():
    import xmlrpc.client  # pylint: disable=import-outside-toplevel
    try:
        return xmlrpc.client.ServerProxy(URI).getPid("/test")[0] == 1
    except OSError:
        return False


def known_topics():
    """What the master knows that pose_walld publishes, and what it subscribes to."""
    import xmlrpc.client  # pylint: disable=import-outside-toplevel
    published, subscribed, _ = xmlrpc.client.ServerProxy(URI).getSystemState("/test")[2]
    return tuple({topic for topic, nodes in of if "/pose_walld" in nodes} for of in (published, subscribed))


def daemon(*more):
    return live_peer.Program(POSE_WALLD, "--set", "source=ros1", "--set", "ros1=1", "--set", "status_every_s=5", *more)


def node_process(program):
    """The process that roscpp runs in; 0 while there is none."""
    for place in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            name, rest = (place / "stat").read_text(encoding="utf-8").rsplit(")", 1)
        except OSError:  # it has ended
            continue
        if name.endswith("(pose_walld_ros1") and rest.split()[0] != "Z" and int(rest.split()[1]) == program.process.pid:
            return int(place.name)
    return 0


def next_node_process(program, last):
    """After that one has ended."""
    found = []

    def is_there():
        found.append(node_process(program))
        return found[-1] not in (0, last)

    assert live_peer.becomes_true(is_there), program.log()
    return found[-1]


def is_gone(process):
    """Also where it is a child of init by now."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0] == "Z"
    except OSError:
        return True


def end(process):
    with contextlib.suppress(ProcessLookupError):
        os.kill(process, signal.SIGKILL)


def maps_recorded(folder):
    """How many messages of /map somebody gets who comes now."""
    bag = folder / "map.bag"
    subprocess.run(["rosbag", "record", "--duration=4", "-O", str(bag), "/map"], capture_output=True, timeout=60,
                   check=True)
    with rosbag.Bag(str(bag)) as read:
        return read.get_message_count("/map")


class WithMaster(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.master = master()
        assert live_peer.becomes_true(master_answers), cls.master.log()

    @classmethod
    def tearDownClass(cls):
        cls.master.kill()


@unittest.skipUnless(shutil.which("node") and (MODULES / "@foxglove/ros1").exists(),
                     f"SKIPPED: there is no node or {MODULES} has no @foxglove/ros1 (npm ci in tests/live/peer)")
class JavaScript(WithMaster):
    def test_clouds_and_results(self):
        program = daemon()
        self.addCleanup(program.kill)
        with tempfile.TemporaryDirectory() as folder:
            client = pathlib.Path(folder) / "ros1_client.mjs"  # beside its modules
            shutil.copy(ROOT / "tests/live/peer/ros1_client.mjs", client)
            os.symlink(MODULES, pathlib.Path(folder) / "node_modules")
            for columns, rate in ((256, 10), (256, 20), (2048, 10), (2048, 20)):
                done = subprocess.run(["node", client, URI, TOPIC, str(columns), str(rate), "50"], capture_output=True,
                                      text=True, timeout=120, check=False)
                self.assertEqual(done.returncode, 0, done.stderr + program.log())
                told = json.loads(done.stdout.strip().splitlines()[-1])
                print(f"{told['bytes'] / 1e3:.0f} kB at {rate} Hz: {told['received']} of {told['sent']} answered, "
                      f"median {told['median_ms']:.1f} ms, worst {told['worst_ms']:.1f} ms", flush=True)
                self.assertTrue(told["connected"])
                self.assertGreater(told["received"], 0, "how many hangs on what else the machine has to do")
                self.assertEqual(told["names"], ["roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb"])
                self.assertEqual(told["label"], "d_lf d_lb d_rf d_rb")
                self.assertAlmostEqual(sum(told["distances"][::2]), 5.0, delta=0.1)
        self.assertTrue(program.stops_by_itself(), program.log())
        self.assertEqual(live_peer.lost_frames(program), 0, program.log())


class Tools(WithMaster):
    def test_rostopic_and_rosbag_read_the_results(self):
        program = live_peer.Program(*live_peer.replay_words(POSE_WALLD, live_peer.simulated_road(POSE_WALL), "--set",
                                                            "ros1=1"))
        self.addCleanup(program.kill)
        self.assertTrue(program.says("runtime: measures"), program.log())
        for topic, needle in (("/pose_wall/attitude", "vector:"), ("/pose_wall/distances", "d_lf d_lb d_rf d_rb"),
                              ("/diagnostics", "pose_walld: runtime"), ("/tf", "base_link_level"),
                              ("/pose_wall/points", "name: \"label\"")):
            done = subprocess.run(["rostopic", "echo", "-n", "1", topic], capture_output=True, text=True, timeout=60,
                                  check=False)
            self.assertIn(needle, done.stdout, f"{topic}: {done.stderr}")
        with tempfile.TemporaryDirectory() as folder:
            bag = pathlib.Path(folder) / "results.bag"
            subprocess.run(["rosbag", "record", "--duration=3", "-O", str(bag), "/pose_wall/attitude",
                            "/pose_wall/state", "/pose_wall/points"], capture_output=True, timeout=60, check=True)
            about = subprocess.run(["rosbag", "info", str(bag)], capture_output=True, text=True, check=True).stdout
            for kind in ("geometry_msgs/Vector3Stamped", "pose_wall_msgs/State", "sensor_msgs/PointCloud2"):
                self.assertIn(kind, about)
            read = subprocess.run([str(POSE_WALL), "info", str(bag)], capture_output=True, text=True, check=False)
            self.assertIn("ROS 1 bag", read.stdout)


    def test_rosbag_reads_scan_map_place_and_stop(self):
        """By the definitions that come with them; the map only because it is latched."""
        road = live_peer.simulated_road(POSE_WALL)
        program = live_peer.Program(*live_peer.replay_words(
            POSE_WALLD, road, "--set", "ros1=1", "--set", "planar=map", "--set", "planar_map_every_s=3600", "--set",
            "planar_tf=base"))
        self.addCleanup(program.kill)
        self.assertTrue(program.says("planar roadway: maps"), program.log())
        topics = ("/scan", "/map", "/pose", "/pose_wall/stop", "/pose_wall/stop_state", "/tf")
        with tempfile.TemporaryDirectory() as folder:
            bag = pathlib.Path(folder) / "planar.bag"
            subprocess.run(["rosbag", "record", "--duration=3", "-O", str(bag), *topics], capture_output=True,
                           timeout=60, check=True)
            with rosbag.Bag(str(bag)) as read:
                told = {}
                for topic, message, _ in read.read_messages():
                    told.setdefault(topic, []).append(message)
        self.assertEqual(set(told), set(topics), program.log())
        self.assertEqual(len(told["/map"]), 1)
        grid = told["/map"][0]
        self.assertEqual(len(grid.data), grid.info.width * grid.info.height)
        self.assertAlmostEqual(grid.info.resolution, 0.05, places=6)
        self.assertEqual(grid.header.frame_id, "map")
        self.assertGreater(sum(cell >= 65 for cell in grid.data), 0)
        scan = told["/scan"][-1]
        self.assertEqual(scan.header.frame_id, "base_link_scan")
        self.assertEqual(len(scan.ranges), round((scan.angle_max - scan.angle_min) / scan.angle_increment) + 1)
        self.assertGreater(sum(far == far for far in scan.ranges), 500)
        place = told["/pose"][-1]
        self.assertEqual((place.header.frame_id, len(place.pose.covariance)), ("map", 36))
        self.assertLess(abs(place.pose.pose.position.x), 0.2, "the machine stands where the map began")
        links = {(link.header.frame_id, link.child_frame_id) for tree in told["/tf"] for link in tree.transforms}
        self.assertLessEqual({("map", "base_link"), ("base_link", "base_link_level"),
                              ("base_link_level", "base_link_scan")}, links)
        states = told["/pose_wall/stop_state"]
        beats = [state.heartbeat for state in states]
        self.assertEqual(beats, sorted(set(beats)))
        self.assertGreater(len(beats), 10)
        self.assertEqual({message.data for message in told["/pose_wall/stop"]}, {state.state == 0 for state in states})


# As livox_ros_driver2 describes it; rospy packs what it reads here.
LIVOX = """std_msgs/Header header
uint64 timebase
uint32 point_num
uint8 lidar_id
uint8[3] rsvd
livox_ros_driver2/CustomPoint[] points
================================================================================
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
================================================================================
MSG: livox_ros_driver2/CustomPoint
uint32 offset_time
float32 x
float32 y
float32 z
uint8 reflectivity
uint8 tag
uint8 line
"""


def road_points():
    """x, y, z of a road 5 m wide, seen from 1.2 m above its floor; what is too far is 0 0 0."""
    points = array.array("f")
    for ring in range(64):
        for column in range(256):
            e, a = math.radians(-45 + 90 * ring / 63), 2 * math.pi * column / 256
            x, y, z = math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)
            far = min(2.5 / abs(y) if y else 1e9, 2.0 / z if z > 0 else 1.2 / -z if z < 0 else 1e9)
            points.extend((far * x, far * y, far * z) if far < 25 else (0, 0, 0))
    return points


class Peer:
    """A publisher and reader by rospy."""

    def __init__(self):
        if not rospy.core.is_initialized():
            rospy.init_node("tester", disable_signals=True, disable_rosout=True)
        self.clouds = rospy.Publisher(TOPIC, PointCloud2, queue_size=2)
        self.static = rospy.Publisher("/tf_static", TFMessage, queue_size=10, latch=True)
        self.moving = rospy.Publisher("/tf", TFMessage, queue_size=10)
        self.attitudes, self.distances = [], []
        rospy.Subscriber("/pose_wall/attitude", Vector3Stamped, self.attitudes.append)
        rospy.Subscriber("/pose_wall/distances", Float32MultiArray, self.distances.append)
        self.ending = threading.Event()
        self.thread = threading.Thread(target=self._publish, daemon=True)

    def _publish(self):
        points = road_points()
        fields = [PointField(name, 4 * i, PointField.FLOAT32, 1) for i, name in enumerate("xyz")]
        turn = 0
        while not self.ending.wait(0.1):
            turn += 1
            for i in range(1, len(points), 3):  # a cloud that was there before is a frozen sensor's
                points[i] += 1e-4 * (-1) ** (turn // 100) if points[i - 1] else 0
            data = points.tobytes()
            message = PointCloud2(height=1, width=len(data) // 12, fields=fields, point_step=12, row_step=len(data),
                                  data=data, is_dense=False)
            message.header.stamp = rospy.Time.from_sec(time.time())
            message.header.frame_id = "lidar"
            self.clouds.publish(message)

    def transform(self, y_m, publisher):
        stamped = TransformStamped()
        stamped.header.frame_id, stamped.child_frame_id = "base_link", "lidar"
        stamped.header.stamp = rospy.Time.from_sec(time.time())
        stamped.transform.translation.y, stamped.transform.rotation.w = y_m, 1.0
        publisher.publish(TFMessage([stamped]))

    def left_m(self):
        """The newest valid distance to the left."""
        values = [message.data[0] for message in self.distances[-3:] if message.data[0] == message.data[0]]
        return values[-1] if values else None


class PeersByRospy(WithMaster):
    """One master for all: rospy registers once."""

    def test_garbage_and_other_types_are_named_and_sound_clouds_go_on(self):
        peer = Peer()
        program = daemon()
        self.addCleanup(program.kill)
        self.assertTrue(live_peer.becomes_true(lambda: peer.clouds.get_num_connections() > 0), program.log())
        fields = [PointField(name, 4 * i, PointField.FLOAT32, 1) for i, name in enumerate("xyz")]
        for width, point_step, data, fields_told in (
                (2 ** 32 - 1, 2 ** 32 - 1, b"", fields), (100, 12, b"short", fields), (1, 0, b"x" * 12, fields),
                (1, 12, b"x" * 12, fields[:2]), (1, 12, b"x" * 12, fields + fields),
                (1, 12, b"x" * 12, [PointField("x", 2 ** 32 - 1, PointField.FLOAT32, 2 ** 32 - 1)] + fields[1:])):
            peer.clouds.publish(PointCloud2(height=1, width=width, fields=fields_told, point_step=point_step,
                                            row_step=0, data=data))
            time.sleep(0.05)
        peer.thread.start()
        self.addCleanup(peer.ending.set)
        self.assertTrue(live_peer.becomes_true(lambda: peer.left_m() is not None), program.log())
        self.assertTrue(any("bytes" in line for line in program.lines), "the refusal is named: " + program.log())

        scans = rospy.Publisher("/lidar/scan", LaserScan, queue_size=2, latch=True)
        scans.publish(LaserScan(ranges=[1.0] * 10))
        second = live_peer.Program(POSE_WALLD, "--set", "source=ros1", "--set", "pointcloud_topic=/lidar/scan")
        self.addCleanup(second.kill)
        self.assertTrue(second.says("sensor_msgs/LaserScan"), second.log())
        # By the rule of ROS the second node of a name ends the first; the rest of the daemon goes on.
        self.assertTrue(program.says("was ended by rosnode kill or by another node of its name"), program.log())
        self.assertIsNone(program.process.poll())
        self.assertEqual(program.stop() >= 0 and program.process.returncode, 0)

    def test_clouds_of_a_livox_driver_are_read(self):
        peer = Peer()
        kinds = genpy.dynamic.generate_dynamic("livox_ros_driver2/CustomMsg", LIVOX)
        kind, point = kinds["livox_ros_driver2/CustomMsg"], kinds["livox_ros_driver2/CustomPoint"]
        clouds = rospy.Publisher("/livox/lidar", kind, queue_size=2)
        program = daemon("--set", "pointcloud_topic=/livox/lidar")
        self.addCleanup(program.kill)
        self.assertTrue(live_peer.becomes_true(lambda: clouds.get_num_connections() > 0), program.log())
        road = road_points()
        for turn in range(10):
            points = [point(1000 * i, road[3 * i], road[3 * i + 1] + 1e-3 * turn, road[3 * i + 2], 50, 0, i % 4)
                      for i in range(len(road) // 3)]
            message = kind(timebase=0, point_num=len(points), lidar_id=1, rsvd=b"\0\0\0", points=points)
            message.header.stamp, message.header.frame_id = rospy.Time.from_sec(time.time()), "lidar"
            clouds.publish(message)
            time.sleep(0.1)
        self.assertTrue(live_peer.becomes_true(lambda: peer.left_m() is not None), program.log())
        self.assertAlmostEqual(peer.left_m(), 2.5, delta=0.03)

    def test_commands_of_the_drive_are_read_in_both_kinds(self):
        Peer()
        for kind, topic, speed in ((Twist, "/cmd_vel", "0.250"), (TwistStamped, "/cmd_vel_stamped", "-0.125")):
            program = daemon("--set", "planar=map", "--set", "planar_motion=commanded", "--set", "planar_command_age=1",
                             "--set", f"planar_command_ros={topic}", "--set", "status_every_s=1")
            self.addCleanup(program.kill)
            publisher = rospy.Publisher(topic, kind, queue_size=1)
            self.addCleanup(publisher.unregister)
            message = kind()
            twist = message.twist if kind is TwistStamped else message
            twist.linear.x, twist.angular.z = float(speed), -0.1
            told = f"command m/s {speed}; command rad/s -0.100"

            def is_told(publisher=publisher, message=message, told=told, program=program):
                publisher.publish(message)
                return any(told in line for line in program.lines[-20:])

            self.assertTrue(live_peer.becomes_true(is_told), program.log())
            self.assertTrue(program.stops_by_itself(), program.log())

    def test_clouds_come_again_with_the_next_process(self):
        peer = Peer()
        peer.thread.start()
        self.addCleanup(peer.ending.set)
        program = daemon()
        self.addCleanup(program.kill)
        process = 0
        for _ in range(3):
            peer.distances.clear()
            self.assertTrue(live_peer.becomes_true(lambda: peer.left_m() is not None), program.log())
            process = next_node_process(program, process)
            os.kill(process, signal.SIGSEGV)
            next_node_process(program, process)

    def test_late_then_changed_then_a_master_started_anew(self):
        peer = Peer()
        peer.thread.start()
        self.addCleanup(peer.ending.set)
        program = daemon("--set", "extrinsic_from=tf")
        self.addCleanup(program.kill)
        self.assertTrue(program.says("no transform from 'lidar' to 'base_link': nothing is measured"), program.log())
        time.sleep(1)
        self.assertIsNone(peer.left_m(), "never the identity by default")
        peer.transform(0.5, peer.static)
        is_left = lambda far_m: live_peer.becomes_true(lambda: peer.left_m() and abs(peer.left_m() - far_m) < 0.05)
        self.assertTrue(is_left(3.0), program.log())
        peer.transform(-0.5, peer.static)
        self.assertTrue(is_left(2.0), program.log())
        process = node_process(program)
        os.kill(process, signal.SIGSEGV)
        next_node_process(program, process)
        peer.distances.clear()
        self.assertTrue(is_left(2.0), "the next process asks for transforms, too: " + program.log())
        attitude = peer.attitudes[-1]
        self.assertEqual(attitude.header.frame_id, "base_link")
        self.assertLess(abs(time.time() - attitude.header.stamp.to_sec()), 60)


class Look(threading.Thread):
    """Asks the page for health and values, and Modbus for its second image, all the time: each must answer. On a busy
    machine frames themselves come too late. The runtime counts such silences, and values expire in them. So they are
    judged as long as there was none."""

    def __init__(self, http, modbus):
        super().__init__(daemon=True)
        self.http, self.modbus = http, modbus
        self.answers, self.frames, self.silences, self.wrong, self.ending = 0, 0, "", [], threading.Event()

    def run(self):
        request = bytes.fromhex("0001 0000 0006 01 04") + (1000).to_bytes(2, "big") + (124).to_bytes(2, "big")
        with socket.create_connection(("127.0.0.1", self.modbus), timeout=live_peer.PATIENCE_S) as link:
            stream = link.makefile("rb")
            while not self.ending.wait(0.05):
                try:
                    state, (runtime, *parts) = self._get("state.json"), self._get("health")["parts"]
                    self.wrong += [part for part in parts if part["grade"] in ("error", "stale")]
                    if runtime["grade"] == "ok" and self.silences in ("", runtime["facts"]["silences"]):
                        self.silences = runtime["facts"]["silences"]
                        self._values(state)
                    link.sendall(request)
                    if len(stream.read(9 + 2 * 124)) != 9 + 2 * 124:
                        self.wrong.append("Modbus")
                    self.answers += 1
                except OSError as fault:
                    self.wrong.append(repr(fault))

    def _values(self, state):
        self.frames += 1
        # The road's own level of roll is now and then wider than the limit.
        self.wrong += [(name, value["state"]) for name, value in state["values"].items()
                       if value["state"] not in ("valid", "degraded")]

    def _get(self, what):
        try:
            answer = urllib.request.urlopen(f"http://127.0.0.1:{self.http}/{what}", timeout=live_peer.PATIENCE_S)
        except urllib.error.HTTPError as unwell:  # 503 has the same content
            answer = unwell
        with answer:
            return json.load(answer)


class Process(WithMaster):
    """roscpp's process ends, hangs and outlives nobody."""

    def replay(self, *more, **options):
        program = live_peer.Program(*live_peer.replay_words(POSE_WALLD, live_peer.simulated_road(POSE_WALL), "--set",
                                                            "ros1=1", "--set", "status_every_s=1", *more), **options)
        self.addCleanup(program.kill)
        self.assertTrue(program.says("sink ros1: publishes"), program.log())
        return program

    def test_killed_at_random_moments_everything_else_goes_on(self):
        folder = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        self.addCleanup(folder.cleanup)
        http, modbus = live_peer.free_port(), live_peer.free_port()
        program = self.replay("--http", f"127.0.0.1:{http}", "--modbus", f"127.0.0.1:{modbus}", "--set",
                              f"recording={folder.name}")
        listener = live_peer.Program("rostopic", "echo", "-p", "/pose_wall/attitude")
        self.addCleanup(listener.kill)
        self.assertTrue(live_peer.becomes_true(lambda: len(listener.lines) > 5), program.log())
        self.assertTrue(program.says("roll valid"), program.log())
        look, chance, process, waits_s = Look(http, modbus), random.Random(37), node_process(program), []
        look.start()
        for turn in range(KILLS):
            time.sleep(1.5 * chance.random())
            os.kill(process, (signal.SIGABRT, signal.SIGSEGV)[turn % 2])
            begin = time.monotonic()
            process = next_node_process(program, process)
            told = len(listener.lines)  # what was on its way is there by now
            self.assertTrue(live_peer.becomes_true(lambda told=told: len(listener.lines) > told + 1), program.log())
            waits_s.append(time.monotonic() - begin)
        look.ending.set()
        look.join()
        print(f"{KILLS} kills: results after {sorted(waits_s)[KILLS // 2]:.2f} s, worst {max(waits_s):.2f} s; "
              f"{look.answers} answers of page and Modbus, {look.frames} with judged values", flush=True)
        self.assertEqual(look.wrong, [])
        self.assertGreater(look.answers, KILLS)
        self.assertTrue(live_peer.becomes_true(
            lambda: live_peer.fact(program, "sink ros1", "process started anew") == KILLS), program.log())
        for name in ("6 (Aborted)", "11 (Segmentation fault)"):
            self.assertTrue(program.says(f"its process ended by signal {name}; it is started anew"), program.log())
        self.assertTrue(program.stops_by_itself(), program.log())
        recorded = b"".join(file.read_bytes() for file in sorted(pathlib.Path(folder.name).glob("*.mcap")))
        numbers = [int(number) for number in re.findall(rb'"publication":(\d+)', recorded)]
        self.assertEqual(numbers, list(range(numbers[0], numbers[0] + len(numbers))), "no hole")
        self.assertGreater(len(numbers), 10 * KILLS)

    def test_one_that_hangs_is_told_and_replaced_and_none_outlives_the_daemon(self):
        program = self.replay()
        process = node_process(program)
        os.kill(process, signal.SIGTERM)  # the daemon's business
        os.kill(process, signal.SIGSTOP)
        self.assertTrue(program.says("its process has not answered for 2 s; after 5 s it is started anew"),
                        program.log())
        self.assertTrue(program.says("its process did not answer for 5 s; it is started anew"), program.log())
        self.assertTrue(is_gone(process))
        process = next_node_process(program, process)
        os.kill(process, signal.SIGSTOP)  # who hangs can be ended all the same
        self.assertTrue(program.stops_by_itself(), program.log())
        self.assertTrue(is_gone(process))
        for hangs in (False, True):
            program = self.replay()
            process = node_process(program)
            self.addCleanup(end, process)  # or the log of the daemon never ends
            if hangs:
                os.kill(process, signal.SIGSTOP)
            program.process.kill()
            self.assertTrue(live_peer.becomes_true(lambda process=process: is_gone(process)))

    def test_a_signal_to_the_whole_group_is_a_clean_end(self):
        """As a terminal, roslaunch and systemd send it: the node takes leave of the master."""
        for number in (signal.SIGINT, signal.SIGTERM):
            program = self.replay(start_new_session=True)
            self.assertTrue(live_peer.becomes_true(lambda: "/pose_wall/attitude" in known_topics()[0]), program.log())
            os.killpg(program.process.pid, number)
            program.process.wait(live_peer.PATIENCE_S)
            self.assertEqual(program.process.returncode, 0, program.log())
            self.assertEqual(known_topics(), (set(), set()))

    def test_a_latched_map_comes_again_with_the_next_process(self):
        program = self.replay("--set", "planar=map", "--set", "planar_map_every_s=3600")
        self.assertTrue(program.says("planar roadway: maps"), program.log())
        process = node_process(program)
        os.kill(process, signal.SIGABRT)
        next_node_process(program, process)
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(maps_recorded(pathlib.Path(folder)), 1, program.log())


class Driver(unittest.TestCase):
    """A driver that does not register again after the master was started anew, as those by roscpp and rospy."""

    def test_its_clouds_go_on_without_a_master_and_with_the_next_one(self):
        core = master()
        self.addCleanup(lambda: core.kill())  # pylint: disable=unnecessary-lambda
        self.assertTrue(live_peer.becomes_true(master_answers))
        driver = subprocess.Popen([sys.executable, "-W", "ignore", __file__, str(ROOT), str(POSE_WALL), str(POSE_WALLD),
                                   str(MODULES), "drive"])
        self.addCleanup(driver.wait)
        self.addCleanup(driver.kill)
        program = daemon("--set", "status_every_s=1")
        self.addCleanup(program.kill)
        self.assertTrue(program.says("runtime: measures"), program.log())
        core.kill()
        self.assertTrue(program.says("receives; waits for the master"), program.log())
        self.clouds_go_on(program)
        core = master()
        self.assertTrue(live_peer.becomes_true(master_answers))
        self.assertTrue(live_peer.becomes_true(lambda: known_topics() == (
            {"/diagnostics", "/tf"} | {f"/pose_wall/{topic}" for topic in ("attitude", "distances", "state", "points")},
            {TOPIC})), known_topics())
        self.clouds_go_on(program)
        core.process.send_signal(signal.SIGSTOP)  # it takes connections, and answers nothing
        lines = len(program.lines)
        self.assertTrue(live_peer.becomes_true(
            lambda: any("receives; waits for the master" in line for line in program.lines[lines:])), program.log())
        self.clouds_go_on(program)
        print(f"stop while the master hangs: {program.stop():.2f} s", flush=True)
        self.assertEqual(program.process.returncode, 0, "by itself, not by force: " + program.log())

    def clouds_go_on(self, program):
        def clouds():
            told = re.findall(r"source ros1.*?; clouds (\d+)", "\n".join(program.lines))
            return int(told[-1]) if told else 0
        before = clouds()
        self.assertTrue(live_peer.becomes_true(lambda: clouds() > before + 5), program.log())


class WithoutMaster(unittest.TestCase):
    def test_words_that_are_no_topic_and_no_master_are_refused(self):
        for words, environment, complaint in (
                (("--set", "pointcloud_topic=two words"), {}, "is no topic of ROS"),
                ((), {"ROS_MASTER_URI": "localhost:11311"},
                 "is no address of a master; allowed: http://localhost:11311")):
            done = subprocess.run([str(POSE_WALLD), "--set", "source=ros1", *words], env=os.environ | environment,
                                  capture_output=True, text=True, timeout=60, check=False)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn(complaint, done.stderr)

    def test_a_map_that_was_there_before_the_master_is_latched(self):
        program = live_peer.Program(*live_peer.replay_words(
            POSE_WALLD, live_peer.simulated_road(POSE_WALL), "--set", "ros1=1", "--set", "planar=map", "--set",
            "planar_map_every_s=3600"))
        self.addCleanup(program.kill)
        self.assertTrue(program.says("planar roadway: maps"), program.log())
        core = master()
        self.addCleanup(core.kill)
        self.assertTrue(live_peer.becomes_true(master_answers))
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(maps_recorded(pathlib.Path(folder)), 1, program.log())

    def test_waits_for_the_master_and_comes_back_after_it_was_started_anew(self):
        program = live_peer.Program(*live_peer.replay_words(POSE_WALLD, live_peer.simulated_road(POSE_WALL), "--set",
                                                            "ros1=1"))
        self.addCleanup(program.kill)
        self.assertTrue(program.says(f"waits for the master at {URI}"), program.log())
        self.assertTrue(program.says("runtime: measures"), "who has no master measures all the same")
        for _ in range(2):
            core = master()
            try:
                self.assertTrue(live_peer.becomes_true(master_answers))
                done = subprocess.run(["rostopic", "echo", "-n", "1", "/pose_wall/attitude"], capture_output=True,
                                      text=True, timeout=60, check=False)
                self.assertIn("vector:", done.stdout, done.stderr + program.log())
            finally:
                core.kill()
        self.assertTrue(program.stops_by_itself(), program.log())


if __name__ == "__main__":
    if sys.argv[1:] == ["drive"]:
        driver_of_the_test = Peer()
        driver_of_the_test.thread.start()
        driver_of_the_test.thread.join()
    live_peer.main()
