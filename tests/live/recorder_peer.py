#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Recordings and black boxes of pose_walld from outside. The daemon is killed at random moments, or its files are
copied while it writes. Then our reader, replay-box and a reader that others wrote (@mcap/core) read the files. The
clouds of a recording measure as those they came from. A disk that is full, also at the start, stops neither the
measuring nor, later, the recording.

usage: recorder_peer.py ROOT POSE_WALL POSE_WALLD NODE_MODULES"""

import contextlib
import csv
import io
import json
import os
import pathlib
import random
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

KILLS = 8  # each takes some three seconds
HAS_READER = bool(shutil.which("node")) and all((MODULES / name).exists() for name in ("@mcap/core", "ajv"))


def words(folder, *more):
    road = live_peer.simulated_road(POSE_WALL)
    return live_peer.replay_words(POSE_WALLD, road, "--set", f"recording={folder}/recordings", "--set",
                                  "recording_clouds=1", "--set", "status_every_s=1", *more)


def recordings(folder):
    return sorted(pathlib.Path(folder, "recordings").glob("*.mcap"))


def boxes(folder):
    return sorted(pathlib.Path(folder, "boxes").glob("*.box"))


def read_by_others(files):
    """What @mcap/core finds in each file."""
    with tempfile.TemporaryDirectory() as place:
        os.symlink(MODULES, pathlib.Path(place) / "node_modules")
        for name in ("mcap_reader.mjs", "channel_reader.mjs"):
            shutil.copy(ROOT / "tests/live/peer" / name, place)
        script = pathlib.Path(place) / "mcap_reader.mjs"
        done = subprocess.run(["node", script, *files], capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def measured(*inputs):
    """Rows of `pose_wall run`, and its exit status."""
    config = live_peer.simulated_road(POSE_WALL) / "pose_wall.yaml"
    done = subprocess.run([POSE_WALL, "run", "-q", "-c", config, *inputs], capture_output=True, text=True, check=False)
    return list(csv.DictReader(io.StringIO(done.stdout))), done.returncode


@contextlib.contextmanager
def small_disk(megabytes):
    """A disk of its own; without root there is none."""
    with tempfile.TemporaryDirectory() as place:
        made = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={megabytes}m", "tmpfs", place],
                              capture_output=True, check=False)
        if made.returncode != 0:
            raise unittest.SkipTest("a small disk needs root")
        try:
            yield pathlib.Path(place)
        finally:
            subprocess.run(["umount", "-l", place], check=True)


class Recorder(unittest.TestCase):
    def folder(self):
        place = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        self.addCleanup(place.cleanup)
        return pathlib.Path(place.name)

    def daemon(self, *all_words):
        program = live_peer.Program(*all_words)
        self.addCleanup(program.kill)
        return program

    def test_killed_at_random_moments_what_is_left_is_read(self):
        folder, chance = self.folder(), random.Random(35)
        for _ in range(KILLS):
            before = len(recordings(folder))
            program = self.daemon(*words(folder, "--speed", "4", "--set", f"black_box={folder}/boxes"))
            self.assertTrue(live_peer.becomes_true(lambda now=before: len(recordings(folder)) > now), program.log())
            # What the disk has by then is not lost. Some of it tells of silence, before the first frame.
            self.assertTrue(live_peer.becomes_true(
                lambda told=program: live_peer.fact(told, "sink recorder", "results recorded") >= 40), program.log())
            time.sleep(chance.random())  # at any moment
            program.kill()
        files = recordings(folder)
        self.assertEqual(len(files), KILLS, "each start has a file of its own")
        for file in files:
            rows, status = measured(file)
            self.assertGreater(len(rows), 3, file)
            self.assertEqual(status, 1, "a file that was cut is named, and what is in it is measured")
        self.assertTrue(boxes(folder))
        for box in boxes(folder):
            replay = subprocess.run([POSE_WALL, "replay-box", "-q", box], capture_output=True, text=True, check=False)
            self.assertIn(replay.returncode, (0, 1), replay.stdout + replay.stderr)
            self.assertNotIn("differs", replay.stdout)
        if not HAS_READER:
            self.skipTest(f"SKIPPED: the rest; there is no node or {MODULES} has no @mcap/core")
        told = read_by_others(files)
        for file, read in zip(files, told):
            self.assertEqual(read["fault"], "", file)
            self.assertFalse(read["whole"])
            self.assertGreater(read["chunks"], 0)
            self.assertGreater(read["results"], 3)
            self.assertEqual(read["topics"]["/pose_wall/result"], read["results"], "each is sound JSON")
        print(f"{KILLS} kills: {sum(read['results'] for read in told)} results in "
              f"{sum(read['chunks'] for read in told)} whole chunks read by @mcap/core, no fault")

    @unittest.skipUnless(HAS_READER, f"SKIPPED: there is no node or {MODULES} has no @mcap/core (npm ci in peer)")
    def test_a_copy_at_any_moment_and_a_cut_anywhere_are_read(self):
        folder, chance = self.folder(), random.Random(36)
        program = self.daemon(*words(folder, "--speed", "4"))
        self.assertTrue(live_peer.becomes_true(
            lambda: live_peer.fact(program, "sink recorder", "results recorded") > 0), program.log())
        copies = []
        for i in range(6):
            time.sleep(chance.random())
            copies.append(folder / f"copy{i}.mcap")
            shutil.copy(recordings(folder)[-1], copies[-1])
        program.stop()
        whole = recordings(folder)[-1].read_bytes()
        for i in range(30):
            copies.append(folder / f"cut{i}.mcap")
            copies[-1].write_bytes(whole[:chance.randrange(2000, len(whole))])
        for copy, read in zip(copies, read_by_others(copies)):
            self.assertEqual(read["fault"], "", copy)
            self.assertEqual(read["topics"].get("/pose_wall/result", 0), read["results"])

    def every_message_opens_in_viewers(self, read, frames):
        """By the schemas, which are those that viewers know, and read by readers of others."""
        for topic, told in read.items():
            self.assertEqual(told["faults"], [], topic)
        names = {topic: told["schema"] for topic, told in read.items()}
        self.assertEqual({topic: name for topic, name in names.items() if name.startswith("foxglove.")},
                         {"/pose_wall/pose": "foxglove.PoseInFrame", "/pose_wall/scene": "foxglove.SceneUpdate",
                          "/pose_wall/transforms": "foxglove.FrameTransforms", "/pose_wall/log": "foxglove.Log"})
        for topic in ("/pose_wall/result", "/pose_wall/scene", "/pose_wall/transforms"):
            self.assertGreaterEqual(read[topic]["messages"], frames, topic)
        clouds = [told for told in read.values()
                  if told["schema"] == "sensor_msgs/msg/PointCloud2" and told["messages"]]
        self.assertEqual([told["messages"] for told in clouds], [frames])
        for topic in ("/pose_wall/pose", "/pose_wall/log", "/pose_wall/health"):
            self.assertGreater(read[topic]["messages"], 0, topic)

    def test_a_recording_that_was_stopped_measures_as_its_frames(self):
        folder, road = self.folder(), live_peer.simulated_road(POSE_WALL)
        program = self.daemon(POSE_WALLD, "--config", road / "pose_wall.yaml", "--replay", road / "frames", "--speed",
                              "0", "--set", f"recording={folder}", "--set", "recording_clouds=1")
        self.assertEqual(program.process.wait(live_peer.PATIENCE_S), 0, program.log())
        file = sorted(folder.glob("*.mcap"))[0]
        (rows, status), (frames, _) = measured(file), measured(road / "frames")
        self.assertEqual(status, 0, "a whole file has no fault")
        numbers = {row["stamp_ns"]: [row[name] for name in row if name.endswith("_raw")] for row in rows}
        of_frames = {row["stamp_ns"]: [row[name] for name in row if name.endswith("_raw")] for row in frames}
        self.assertGreater(len(of_frames), 10)
        self.assertEqual(len(next(iter(numbers.values()))), 7)
        self.assertEqual(set(numbers), set(of_frames), "without a pace all is kept, however slow the disk is")
        self.assertEqual(numbers, of_frames)
        if HAS_READER:
            read = read_by_others([file])[0]
            self.assertTrue(read["whole"])
            self.assertEqual(read["index"]["statistics"], sum(read["topics"].values()))
            self.assertEqual(read["index"]["messages"], sum(read["topics"].values()), "by the indexes alone")
            self.every_message_opens_in_viewers(read["index"]["read"], len(rows))
            self.assertEqual(read["index"]["chunks"], read["chunks"])
            members = set(read["index"]["members"]["/pose_wall/result"])
            self.assertLess({"values", "publication", "age_ms", "steer"}, members)
            self.assertEqual(read["index"]["members"]["/pose_wall/health"], ["schema", "parts"])
            self.assertIn("sensor_msgs/msg/PointCloud2", read["schemas"].values())

    def test_a_disk_that_fills_and_empties_stops_neither_measuring_nor_later_recording(self):
        with small_disk(40) as disk:
            program = self.daemon(*words(disk, "--set", "recording_mb=1000"))
            self.assertTrue(program.says("pauses: "), program.log())
            self.assertTrue(any("No space left on device" in line for line in program.lines), program.log())
            self.assertIsNone(program.process.poll())
            time.sleep(12)
            self.assertLess(len(recordings(disk)), 6, "tries leave no files behind")
            descriptors = len(os.listdir(f"/proc/{program.process.pid}/fd"))
            self.assertLess(descriptors, 40, "nor descriptors")
            pushed = len([line for line in program.lines if "frames measured" in line])
            self.assertTrue(live_peer.becomes_true(
                lambda: len([line for line in program.lines if "frames measured" in line]) > pushed))
            first = recordings(disk)[0]
            first.unlink()
            seen = len(program.lines)
            self.assertTrue(live_peer.becomes_true(
                lambda: any("recorder" in line and "records" in line for line in program.lines[seen:])), program.log())
            self.assertEqual(program.process.poll(), None)
            program.kill()

    def test_a_disk_that_is_full_at_the_start_is_waited_for(self):
        with small_disk(4) as disk:
            (disk / "recordings").mkdir()
            with contextlib.suppress(OSError), open(disk / "ballast", "wb") as ballast:
                while True:
                    ballast.write(b"x" * 65536)
                    ballast.flush()
            program = self.daemon(*words(disk, "--set", "recording_mb=3", "--set", "recording_clouds=0"))
            self.assertTrue(program.says("runtime: measures"), program.log())
            self.assertTrue(program.says("pauses: "), program.log())
            (disk / "ballast").unlink()
            seen = len(program.lines)
            self.assertTrue(live_peer.becomes_true(
                lambda: any("recorder" in line and "records" in line for line in program.lines[seen:])), program.log())
            program.kill()

    def test_a_folder_that_cannot_be_written_is_named(self):
        folder = self.folder()
        (folder / "recordings").write_text("a file in its place", encoding="utf-8")
        program = self.daemon(*words(folder))
        self.assertEqual(program.process.wait(live_peer.PATIENCE_S), 1)
        self.assertTrue(program.says(f"{folder}/recordings"), program.log())


if __name__ == "__main__":
    live_peer.main()
