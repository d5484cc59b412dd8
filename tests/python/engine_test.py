# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The engine in Python gives what `pose_wall run` gives, to the last bit. Mementos, copies and threads do what the
header says. What the engine measures is proven elsewhere."""

import copy
import dataclasses
import gc
import math
import multiprocessing
import os
import pathlib
import pickle
import struct
import threading
import unittest

from support import ROOT, json_rows, needs_command, np, pose_wall, road, simulated, untimed

ROOT_CONFIG = ROOT / "config/pose_wall.yaml"
ALONE = {"motion": "off"}  # the package has the engine without motion
Status, State = pose_wall.Status, pose_wall.State


def bits(number):
    """Of a double; the command writes null where there is none."""
    return None if number is None or math.isnan(number) else struct.pack("<d", number)


class AsTheCommand(unittest.TestCase):
    def same_value(self, value, line, unit):
        """An invalid value is not to be used, and the command writes null; what was measured stands in raw."""
        if value.state == State.INVALID:
            value = dataclasses.replace(value, value=math.nan, sigma=math.nan, protection_level=math.nan, cause=None,
                                        parts=dict.fromkeys(value.parts, math.nan))
        for member, name in (("value", "value"), ("raw", "raw"), ("sigma", "sigma"),
                             ("protection_level", "protection_level"),
                             ("raw_protection_level", "raw_protection_level")):
            self.assertEqual(bits(getattr(value, member)), bits(line[name + unit]), name)
        self.assertEqual(bits(value.age_s), bits(line["age_s"]))
        self.assertEqual(bits(value.confidence), bits(line["confidence"]))
        parts = line["protection_level_parts" + unit]
        self.assertEqual({part.name.lower(): bits(found) for part, found in value.parts.items()},
                         {name: bits(found) for name, found in parts.items()})
        self.assertEqual(value.state.name.lower(), line["state"])
        self.assertEqual(value.raw_state.name.lower(), line["raw_state"])
        self.assertEqual(pose_wall.reason_names(value.reasons), line["reasons"])
        self.assertEqual(None if value.cause is None else value.cause.name.lower(), line["cause"])

    def same_plane(self, plane, line):
        self.assertEqual(plane.found, line["found"])
        self.assertEqual(pose_wall.reason_names(plane.reasons), line["reasons"])
        for member in ("rms_m", "extent_min_m", "extent_max_m", "lean_rad"):
            self.assertEqual(bits(getattr(plane, member)) if plane.found else None, bits(line[member]), member)
        self.assertEqual(bits(plane.d_m) if plane.found else None, bits(line["distance_m"]))
        if plane.found:
            self.assertEqual((plane.inliers, plane.iterations), (line["inliers"], line["iterations"]))

    def same_frame(self, result, line):
        self.assertEqual(result.stamp_ns, line["stamp_ns"])
        self.assertEqual(result.frame_index, line["frame"])
        self.assertEqual(result.worst_state.name.lower(), line["status"])
        self.assertEqual(pose_wall.reason_names(result.reasons), line["reasons"])
        self.assertEqual(pose_wall.reason_names(result.frame_reasons), line["frame_reasons"])
        for name, value in result.quantities.items():
            self.same_value(value, line["values"][name], "_m" if name.startswith("d_") else "_rad")
        for member, name in (("floor", "floor"), ("left", "left_wall"), ("right", "right_wall")):
            self.same_plane(getattr(result, member), line["planes"][name])
        self.assertEqual(bits(result.left_right_yaw_difference_rad), bits(line["left_right_yaw_difference_rad"]))
        self.assertEqual(bits(result.confidence), bits(line["confidence"]))
        counts = dataclasses.asdict(result.counts)
        counts["in"] = counts.pop("points_in")
        self.assertEqual(counts, line["points"])
        for member in ("voxel_leaf_m", "work", "publication", "source_id", "config_crc32"):
            self.assertEqual(getattr(result, member), line[member], member)

    def same_run(self, folder, **settings):
        config = folder / "pose_wall.yaml"
        settings |= ALONE
        words = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
        lines = json_rows(config, folder / "frames", *words)
        engine = pose_wall.Engine(pose_wall.Config.load(config, set=settings))
        results = [engine.process(frame.points, stamp_ns=frame.stamp_ns)
                   for frame in pose_wall.read_frames(folder / "frames")]
        self.assertEqual(len(results), len(lines))
        for result, line in zip(results, lines):
            self.same_frame(result, line)
        return results

    @needs_command
    def test_a_road_that_is_measured(self):
        results = self.same_run(simulated("nominal", 12, "speed_mps=0.3"))
        self.assertTrue(all(result.yaw.is_valid for result in results))
        self.assertTrue(all(result.engine_ns > 0 for result in results))

    @needs_command
    def test_frames_that_are_refused_held_and_expire(self):
        for scene, state in (("no_floor", State.INVALID), ("frozen", State.HELD)):
            results = self.same_run(simulated(scene, 16))
            self.assertIn(state, {result.roll.state for result in results}, scene)

    @needs_command
    def test_settings(self):
        results = self.same_run(simulated("nominal", 3), forward_axis="-X", intensity_weight=0.5, source_id=7,
                                body_box_1="-1 1 -0.5 0.5 -1 0.2")
        self.assertEqual({result.source_id for result in results}, {7})

    @needs_command
    @unittest.skipUnless(os.environ.get("POSE_WALL_DATA"), "POSE_WALL_DATA names no folder of recorded frames")
    def test_recorded_frames(self):
        files = sorted(pathlib.Path(os.environ["POSE_WALL_DATA"]).glob("*/*.pcd"))[::5][:12]
        self.assertTrue(files)
        for file in files:
            line, = json_rows(ROOT_CONFIG, file, "--set", "motion=off")
            frame, = pose_wall.read_frames(file)
            result = pose_wall.Engine(pose_wall.Config.load(ROOT_CONFIG, set=ALONE)).process(
                frame.points, stamp_ns=frame.stamp_ns)
            self.same_frame(result, line)


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result = pose_wall.Engine().process(road(), stamp_ns=5)

    def test_the_road_made_by_hand(self):
        """Walls at 2.5 m, floor at 1.5 m, straight ahead: each error within its level."""
        for name, truth in (("roll", 0.0), ("pitch", 0.0), ("yaw", 0.0), ("d_lf", 2.5), ("d_lb", 2.5), ("d_rf", 2.5),
                            ("d_rb", 2.5)):
            value = self.result[name]
            self.assertIs(value.state, State.VALID, name)
            self.assertLessEqual(abs(value.value - truth), value.protection_level, name)
            self.assertAlmostEqual(math.fsum(value.parts.values()), value.protection_level, places=12)
        self.assertAlmostEqual(self.result.floor.d_m, 1.5, delta=0.01)
        self.assertAlmostEqual(self.result.left.normal[1], -1.0, delta=0.001)

    def test_nothing_can_be_changed(self):
        for target, name in ((self.result, "yaw"), (self.result.yaw, "value"), (self.result.floor, "d_m"),
                             (self.result.counts, "voxels")):
            with self.assertRaises(dataclasses.FrozenInstanceError):
                setattr(target, name, 0)
        with self.assertRaises(ValueError):
            self.result.R_level_base[0, 0] = 2.0

    def test_by_name_and_number(self):
        self.assertIs(self.result["d_lf"], self.result[pose_wall.Quantity.D_LF])
        self.assertIs(self.result[6], self.result.d_rb)
        for name in ("d_front", 7, -1, "__class__", None):
            with self.assertRaises(KeyError) as caught:
                self.result[name]  # pylint: disable=pointless-statement
            self.assertIn("roll, pitch, yaw", str(caught.exception))

    def test_copies_are_equal(self):
        for other in (pickle.loads(pickle.dumps(self.result)), copy.deepcopy(self.result),
                      pose_wall.Result.from_c(self.result.to_c())):
            self.assertEqual(other, self.result)
            self.assertEqual(hash(other), hash(self.result))
            self.assertEqual(other.yaw, self.result.yaw)
            np.testing.assert_array_equal(other.R_level_base, self.result.R_level_base)
        self.assertNotEqual(self.result, pose_wall.Engine().process(road(), stamp_ns=6))

    def test_words_of_reasons(self):
        both = pose_wall.Reason.WALL_SHORT | pose_wall.Reason.NO_FRAME
        self.assertEqual(pose_wall.reason_names(both), ["wall_short", "no_frame"])
        self.assertEqual(len(pose_wall.reason_texts(both)), 2)
        self.assertEqual(pose_wall.reason_names(pose_wall.Reason(0)), [])

    def test_images(self):
        image = pose_wall.read_image(pose_wall.image_bytes(self.result))
        self.assertAlmostEqual(image.d_lf.value_mm, self.result.d_lf.value * 1e3, delta=0.51)
        second = pose_wall.image2_bytes(self.result, cause=pose_wall.Cause.FRAME, latency_ns=2_500_000)
        image2 = pose_wall.read_image(second)
        self.assertEqual((image2.told_by, image2.latency_ms, image2.thinning, image2.publication), (1, 3, 1, 1))
        self.assertEqual(image2.valid, 0b1111111)
        unknown = pose_wall.read_image(pose_wall.image2_bytes(self.result))
        self.assertEqual((unknown.told_by, unknown.latency_ms), (0, 4294967295))
        for at in range(0, len(second), 31):
            damaged = bytearray(second)
            damaged[at] ^= 4
            with self.assertRaises(pose_wall.Error) as caught:
                pose_wall.read_image(bytes(damaged))
            self.assertIn(caught.exception.status, (Status.IMAGE_CRC, Status.IMAGE_VERSION))
        for wrong in (b"", second[:-1], second + b"\0"):
            with self.assertRaises(ValueError):
                pose_wall.read_image(wrong)


class Life(unittest.TestCase):
    def test_the_same_again_after_reset_and_in_another_engine(self):
        engine = pose_wall.Engine(timing=False)
        first = [engine.process(road(), stamp_ns=n * 10**8) for n in range(3)]
        engine.reset()
        self.assertEqual([engine.process(road(), stamp_ns=n * 10**8) for n in range(3)], first)
        self.assertEqual(first[0].engine_ns, 0)
        timed = pose_wall.Engine()
        again = [timed.process(road(), stamp_ns=n * 10**8) for n in range(3)]
        self.assertEqual([untimed(result) for result in again], [untimed(result) for result in first])
        self.assertGreater(min(result.engine_ns for result in again), 0)

    def test_memento(self):
        engine = pose_wall.Engine(timing=False)
        engine.process(road(), stamp_ns=0)
        memento = engine.save(pose_wall.Moment(10**8, wall_ns=10**18))
        expected = engine.process(road(), stamp_ns=10**8)
        other = pose_wall.Engine(timing=False)
        other.load(memento, pose_wall.Moment(10**8, same_clock=True))
        self.assertEqual(other.process(road(), stamp_ns=10**8), expected)
        for wrong in (b"", memento[:-1], bytes(len(memento)), memento[:50] + b"x" + memento[51:]):
            with self.assertRaises(pose_wall.Error) as caught:
                other.load(wrong)
            self.assertEqual(caught.exception.status, Status.MEMENTO)
        with self.assertRaises(pose_wall.Error) as caught:
            pose_wall.Engine(pose_wall.Config(yaw_max_deg=40)).load(memento)
        self.assertEqual(caught.exception.status, Status.MEMENTO)
        with self.assertRaisesRegex(ValueError, "boot_id: 3 bytes; 16"):
            engine.save(pose_wall.Moment(0, boot_id=b"abc"))
        with self.assertRaises(pose_wall.Error) as caught:
            engine.save(pose_wall.Moment(0, boot_id=bytes(16)))
        self.assertEqual(caught.exception.status, Status.INPUT)

    def test_silence(self):
        engine = pose_wall.Engine()
        self.assertIsNone(engine.age(0).frame_index)
        engine.process(road(), stamp_ns=10**9)
        held, later = engine.age(10**9 + 10**8), engine.age(10**9 + 10**10)
        self.assertIs(held.yaw.state, State.HELD)
        self.assertAlmostEqual(held.yaw.age_s, 0.1)
        self.assertIn(pose_wall.Reason.NO_FRAME, held.frame_reasons)
        self.assertIs(later.yaw.state, State.INVALID)
        self.assertEqual(later.frame_index, 0)

    def test_points_outlive_their_engine(self):
        engine = pose_wall.Engine()
        self.assertEqual(engine.last_points().xyz_base_m.shape, (0, 3))
        result = engine.process(road(), stamp_ns=0)
        points = engine.last_points()
        self.assertEqual(points.xyz_base_m.shape, (result.counts.voxels - result.counts.outliers, 3))
        kept = points.xyz_base_m.copy()
        engine.process(road()[::3].copy(), stamp_ns=10**8)
        del engine
        gc.collect()
        np.testing.assert_array_equal(points.xyz_base_m, kept)
        floor = points.xyz_base_m[points.label == pose_wall.Label.FLOOR]
        self.assertGreater(len(floor), 500)
        self.assertLess(np.abs(floor[:, 2] + 1.5).max(), 0.2)

    def test_settings_are_the_engines_own(self):
        config = pose_wall.Config()
        engine = pose_wall.Engine(config)
        config["yaw_max_deg"] = 5
        self.assertEqual(engine.config["yaw_max_deg"], 45)
        engine.config["yaw_max_deg"] = 5
        self.assertEqual(engine.process(road(), stamp_ns=0).config_crc32, pose_wall.Config().crc32)

    def test_the_library_computes_what_was_tested(self):
        report = pose_wall.self_test()
        self.assertEqual(report.frames, 4)
        self.assertGreater(report.code_bytes, 100_000)
        self.assertEqual(report.code_crc32, pose_wall.self_test().code_crc32)


class Threads(unittest.TestCase):
    def test_engines_of_their_own(self):
        expected = [untimed(result) for result in self.run_of(pose_wall.Engine())]
        found = [None] * 4

        def work(place):
            found[place] = [untimed(result) for result in self.run_of(pose_wall.Engine())]

        threads = [threading.Thread(target=work, args=(place,)) for place in range(len(found))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, [expected] * 4)

    @staticmethod
    def run_of(engine):
        return [engine.process(road(), stamp_ns=n * 10**8) for n in range(5)]

    def test_one_engine_for_several_is_refused_and_stays_whole(self):
        """Every call is either refused as busy, or measured as ever; and all that were measured count up."""
        engine = pose_wall.Engine()
        done, refused, others = [], [], []

        def work():
            for _ in range(15):
                try:
                    done.append(engine.process(road(), stamp_ns=0).frame_index)
                    engine.last_points()
                except pose_wall.Error as error:
                    (refused if error.status == Status.BUSY else others).append(error)

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(others, [])
        self.assertEqual(sorted(done), list(range(len(done))))
        self.assertEqual(engine.process(road(), stamp_ns=0).frame_index, len(done))

    def test_busy_is_told(self):
        engine = pose_wall.Engine()
        with engine._alone():
            for call in (lambda: engine.process(road(), stamp_ns=0), engine.reset, engine.save, engine.last_points,
                         lambda: engine.age(0), lambda: engine.load(b"")):
                with self.assertRaises(pose_wall.Error) as caught:
                    call()
                self.assertEqual(caught.exception.status, Status.BUSY)
        self.assertEqual(engine.process(road(), stamp_ns=0).frame_index, 0)


def _measured_by_child(job):
    config, points = job
    return pose_wall.Engine(config, timing=False).process(points, stamp_ns=0)


class Processes(unittest.TestCase):
    def test_a_sweep_over_processes(self):
        """How one tunes: settings go there, results come back, by fork and by spawn."""
        configs = [pose_wall.Config(voxel_leaf=leaf) for leaf in (0.05, 0.1, 0.2)]
        expected = [_measured_by_child((config, road())) for config in configs]
        self.assertEqual(len(set(expected)), 3)
        for method in ("fork", "spawn"):
            with multiprocessing.get_context(method).Pool(2) as pool:
                found = pool.map(_measured_by_child, [(config, road()) for config in configs])
            self.assertEqual(found, expected, method)

    def test_a_forked_child_has_a_copy(self):
        engine = pose_wall.Engine(timing=False)
        engine.process(road(), stamp_ns=0)
        reader, writer = os.pipe()
        child = os.fork()
        if child == 0:
            os.write(writer, pickle.dumps(engine.process(road(), stamp_ns=10**8).yaw))
            os._exit(0)
        os.close(writer)
        with os.fdopen(reader, "rb") as stream:
            told = pickle.loads(stream.read())
        self.assertEqual(os.waitpid(child, 0)[1], 0)
        self.assertEqual(told, engine.process(road(), stamp_ns=10**8).yaw)


if __name__ == "__main__":
    unittest.main()
