#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Python's package: its structs are those of the compiler, its results the bits of `pose_wall run`; arrays of any
layout give the same; what is wrong is named; callbacks that raise, objects that go in odd orders and threads harm
nobody; pip installs it, and the example runs.

usage: python_test.py ROOT POSE_WALL ABI_LAYOUT"""

import ctypes
import gc
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT, POSE_WALL, LAYOUT = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(3))
sys.path.insert(0, str(ROOT / "tools/python"))
sys.path.insert(0, str(ROOT / "tests/live"))

try:
    import numpy
except ImportError:
    print("SKIPPED: there is no numpy (package python3-numpy)")
    sys.exit(0)
import live_peer  # noqa: E402  pylint: disable=wrong-import-position
import pose_wall  # noqa: E402  pylint: disable=wrong-import-position
from pose_wall import _headers  # noqa: E402  pylint: disable=wrong-import-position

ROAD = live_peer.simulated_road(POSE_WALL)
FRAMES = sorted((ROAD / "frames").glob("*.pcd"))
MEMBERS = ("value", "raw", "sigma", "protection_level", "raw_protection_level")


def config(**more):
    return pose_wall.Config.load(ROAD / "pose_wall.yaml", more)


class Layout(unittest.TestCase):
    def test_structs_are_those_of_the_compiler(self):
        members, looked_at = {}, 0
        for line in subprocess.run([str(LAYOUT)], capture_output=True, text=True, check=True).stdout.splitlines():
            member = re.fullmatch(r"  (\w+) +(\d+) +(\d+)", line)
            if member:
                members[member[1]] = (int(member[2]), int(member[3]))
                continue
            name, size = line.split()[:2]
            if name in _headers.STRUCTS:
                made = _headers.STRUCTS[name]
                self.assertEqual(ctypes.sizeof(made), int(size), name)
                found = {field[0]: (getattr(made, field[0]).offset, getattr(made, field[0]).size)
                         for field in made._fields_}
                self.assertEqual(found, members, name)
                looked_at += 1
            members = {}
        self.assertGreater(looked_at, 10)

    def test_keys_of_the_daemon_are_those_of_the_command(self):
        text = subprocess.run([str(POSE_WALL), "check-config", "--keys"], capture_output=True, text=True,
                              check=True).stdout
        names = set(re.findall(r"^  (\w+)$", text, re.M))
        self.assertEqual(names - set(pose_wall.KEYS), pose_wall.config.DAEMON_KEYS)


class Engine(unittest.TestCase):
    def test_gives_the_bits_of_the_command(self):
        done = subprocess.run([str(POSE_WALL), "run", "--config", str(ROAD / "pose_wall.yaml"), "--format", "json",
                               *map(str, FRAMES)], capture_output=True, text=True, check=True)
        rows = [json.loads(line) for line in done.stdout.splitlines()]
        engine = pose_wall.Engine(config())
        self.assertEqual(len(rows), len(FRAMES))
        for row, path in zip(rows, FRAMES):
            result = engine.process(pose_wall.read_pcd(path), row["stamp_ns"])
            self.assertEqual(result.work, row["work"])
            for name, told in row["values"].items():
                value, unit = result[name], "_m" if name.startswith("d_") else "_rad"
                self.assertEqual(value.state.name.lower(), told["state"])
                for member in MEMBERS:
                    number = getattr(value, member)
                    self.assertEqual(None if number != number else number, told[member + unit], (name, member))

    def test_any_layout_gives_the_same(self):
        points = pose_wall.read_pcd(FRAMES[0])
        xyz = numpy.stack([points["x"], points["y"], points["z"]], axis=1)
        expected = pose_wall.Engine(config()).process(points).raw_bytes
        wide = numpy.zeros((len(xyz), 7), "f4")
        wide[:, :3] = xyz
        mixed = numpy.zeros(len(xyz), [("time", "u4"), ("z", "f8"), ("x", "f4"), ("ring", "u2"), ("y", "f4")])
        for axis in "xyz":
            mixed[axis] = points[axis]
        layouts = {"(N, 3) float32": xyz, "(N, 3) float64": xyz.astype("f8"),
                   "columns first": numpy.asfortranarray(xyz),
                   "every second row": numpy.repeat(xyz, 2, axis=0)[::2], "backwards twice": xyz[::-1].copy()[::-1],
                   "part of a row": wide[:, :3], "big-endian": points.astype(points.dtype.newbyteorder(">")),
                   "fields in any order": mixed, "a list": xyz.astype("f8").tolist()}
        for name, layout in layouts.items():
            with self.subTest(name):
                self.assertEqual(pose_wall.Engine(config()).process(layout).raw_bytes, expected)

    def test_what_is_wrong_is_named(self):
        engine = pose_wall.Engine(config())
        for points, why in ((numpy.zeros((5, 2)), "shape"), (numpy.zeros((5, 3), "i4"), "float32"),
                            (numpy.zeros(7), "shape"),
                            (numpy.zeros(4, [("x", "f4"), ("y", "f4")]), "lack z"),
                            (numpy.zeros(4, [("x", "f4"), ("y", ">f4"), ("z", "f4")]), "order of bytes")):
            with self.assertRaisesRegex(ValueError, why):
                engine.process(points)
        with self.assertRaisesRegex(pose_wall.Error, "."):
            engine.process(numpy.zeros(4, [("x", "i4"), ("y", "f4"), ("z", "f4")]))
        with self.assertRaisesRegex(KeyError, "did you mean 'yaw_max_deg'"):
            config()["yaw_max"] = 3
        with self.assertRaisesRegex(ValueError, "allowed: 5 to 50 deg"):
            config()["yaw_max_deg"] = 300
        with self.assertRaisesRegex(ValueError, "range_min"):
            pose_wall.Engine(pose_wall.Config({"range_min": 9, "range_max": 2}))
        with self.assertRaisesRegex(pose_wall.Error, "."):
            engine.load(b"no memento")
        with self.assertRaises(KeyError):
            engine.process(numpy.zeros((0, 3)))["jaw"]

    def test_remembers_ages_and_is_inspected(self):
        first, second = pose_wall.Engine(config()), pose_wall.Engine(config())
        points = [pose_wall.read_pcd(path) for path in FRAMES[:3]]
        for i, cloud in enumerate(points[:2]):
            last = first.process(cloud, i * 100_000_000)
        second.load(first.save())
        of_first, of_second = (engine.process(points[2], 200_000_000) for engine in (first, second))
        # Without a moment nobody knows how old the memento is: it holds no values, but the seed of the next draw.
        self.assertEqual(of_first.yaw.raw, of_second.yaw.raw)
        self.assertEqual(first.age(300_000_000).yaw.state, pose_wall.State.HELD)
        self.assertEqual(last.floor.found, True)
        xyz, labels = second.last_points()
        self.assertEqual(len(xyz), len(labels))
        self.assertEqual(set(numpy.unique(labels)) - {0, 1, 2, 3}, set())
        self.assertEqual(len(pose_wall.image_bytes(last)), 248)
        self.assertEqual(len(pose_wall.image_bytes(last, 1)), 240)
        known = pose_wall.inputs(speed_m_s=(0.1, 0.01), turn_rate_rad_s=(0, 0.01))
        moving = first.process(points[2], 400_000_000, known)
        self.assertTrue(moving.yaw.is_usable)
        with self.assertRaises(ValueError):
            pose_wall.inputs(boxes=[(0, 1, 0, 1, 0, 1)] * 5)


class Runtime(unittest.TestCase):
    def test_measures_in_its_own_thread(self):
        seen, points = [], [pose_wall.read_pcd(path) for path in FRAMES]
        with pose_wall.Runtime(config(), seen.append, watchdog_ns=0) as runtime:
            self.assertIsNone(runtime.latest())
            for i, cloud in enumerate(points):
                runtime.push(cloud, i * 100_000_000)
                runtime.wait_idle()
            newest, counts = runtime.latest(), runtime.statistics()
        self.assertEqual([p.frame for p in seen], list(range(len(points))))
        self.assertEqual(newest.frame, len(points) - 1)
        self.assertEqual((counts["pushed"], counts["processed"]), (len(points), len(points)))

    def test_a_callback_that_raises_harms_nobody(self):
        calls = []

        def raises(publication):
            calls.append(publication.frame)
            raise RuntimeError("on purpose")

        points, error = pose_wall.read_pcd(FRAMES[0]), sys.stderr
        with open(os.devnull, "w", encoding="utf-8") as sys.stderr:
            with pose_wall.Runtime(config(), raises, watchdog_ns=0) as runtime:
                for i in range(3):
                    runtime.push(points[i:], i * 100_000_000)
                    runtime.wait_idle()
        sys.stderr = error
        self.assertEqual(calls, [0, 1, 2])

    def test_several_threads_look_while_one_pushes(self):
        points, wrong, ending = pose_wall.read_pcd(FRAMES[0]), [], threading.Event()
        with pose_wall.Runtime(config(), watchdog_ns=0) as runtime:
            def look():
                while not ending.is_set():
                    newest = runtime.latest()
                    if newest is not None and newest.result.frame_index > 100:
                        wrong.append(newest)
            threads = [threading.Thread(target=look) for _ in range(3)]
            for thread in threads:
                thread.start()
            for i in range(10):
                runtime.push(points[i:], i * 100_000_000)
            runtime.wait_idle()
            ending.set()
            for thread in threads:
                thread.join()
            counts = runtime.statistics()
        self.assertEqual(wrong, [])
        self.assertEqual(counts["processed"] + counts["dropped_overtaken"], 10)

    def test_objects_that_go_in_odd_orders(self):
        for _ in range(3):
            runtime = pose_wall.Runtime(config(), lambda publication: None)
            runtime.__enter__()
            runtime.push(pose_wall.read_pcd(FRAMES[0]), 0)
            del runtime
            gc.collect()
        runtime = pose_wall.Runtime(config())
        runtime.close()
        runtime.close()
        with self.assertRaises(pose_wall.Error):
            runtime.push(numpy.zeros((3, 3), "f4"))
        with self.assertRaisesRegex(TypeError, "no option 'watchdog'"):
            pose_wall.Runtime(config(), watchdog=3)
        with self.assertRaisesRegex(pose_wall.Error, "queue_frames"):
            pose_wall.Runtime(config(), queue_frames=1000)


class Pcd(unittest.TestCase):
    def test_kinds_of_data(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.pcd"
            head = ("VERSION .7\nFIELDS x y z _ ring\nSIZE 4 4 4 1 2\nTYPE F F F U U\nCOUNT 1 1 1 2 1\nWIDTH 2\n"
                    "HEIGHT 1\nPOINTS 2\nDATA ")
            plain = numpy.zeros(2, [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("_", "u1", 2), ("ring", "<u2")])
            plain["x"], plain["ring"] = [1, 4], [7, 8]
            by_field = b"".join(plain[name].tobytes() for name in plain.dtype.names)
            # LZF without any repetition: runs of at most 32 bytes behind their length.
            packed = b"".join(bytes([len(by_field[i:i + 32]) - 1]) + by_field[i:i + 32]
                              for i in range(0, len(by_field), 32))
            for kind, body in (("ascii", b"1 0 0 0 0 7\n4 0 0 0 0 8\n"), ("binary", plain.tobytes()),
                               ("binary_compressed",
                                numpy.array([len(packed), len(by_field)], "<u4").tobytes() + packed)):
                path.write_bytes((head + kind + "\n").encode() + body)
                points = pose_wall.read_pcd(path)
                self.assertEqual((points["x"].tolist(), points["ring"].tolist()), ([1, 4], [7, 8]), kind)
            path.write_bytes((head + "binary\n").encode() + b"short")
            with self.assertRaisesRegex(ValueError, "2 points take 32 bytes, 5 are there"):
                pose_wall.read_pcd(path)


class Installed(unittest.TestCase):
    def test_pip_installs_it_and_the_example_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            tree = place / "tree"
            tree.mkdir()
            for name in ("include", "src", "tools"):
                shutil.copytree(ROOT / name, tree / name)
            for name in ("CMakeLists.txt", "LICENSE", "README.md"):
                shutil.copy(ROOT / name, tree)
            made = subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", str(place / "venv")],
                                  capture_output=True, text=True, check=False)
            if made.returncode != 0:
                self.skipTest("no venv here (package python3-venv)")
            python = place / "venv/bin/python"
            clean = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "POSE_WALL_LIBRARY")}
            done = subprocess.run([str(python), "-m", "pip", "install", "--no-build-isolation", "--no-index",
                                   "--no-deps", str(tree / "tools/python")], capture_output=True, text=True,
                                  check=False)
            if "No module named" in done.stderr and "setuptools" in done.stderr:
                self.skipTest("no setuptools here (packages python3-setuptools python3-wheel)")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            plot = place / "run.png"
            example = ROOT / "tools/python/examples/plot_run.py"
            ran = subprocess.run([str(python), str(example), str(ROAD / "frames"), "--config",
                                  str(ROAD / "pose_wall.yaml"), "--plot", str(plot)], capture_output=True, text=True,
                                 env=clean, cwd=place, check=False)
            if "a plot takes matplotlib" not in ran.stderr:
                self.assertEqual(ran.returncode, 0, ran.stderr)
                self.assertGreater(plot.stat().st_size, 10_000)
            self.assertIn("yaw", ran.stdout)


if __name__ == "__main__":
    unittest.main()
