# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Layouts of NumPy: strides, order of bytes, types and fields. Whatever an array has of them, the engine gives the same
bits as of the plain one. Nothing is read outside of it. What an array cannot be is refused by name."""

import ctypes
import mmap
import unittest

from support import measured, np, pose_wall, road, scratch

FIELDS = [("t", "<f8"), ("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("intensity", "<u2"), ("ring", "u1")]


def structured(points, fields=tuple(FIELDS), **dtype):
    made = np.zeros(len(points), np.dtype(list(fields), **dtype))
    for column, name in enumerate("xyz"):
        made[name] = points[:, column]
    return made


def wider(points, columns=5, first=0):
    made = np.full((len(points), columns), np.nan, points.dtype)
    made[:, first:first + 3] = points
    return made


class SameBits(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.points = road()
        cls.expected = measured(cls.points)
        struct = pose_wall.Engine().process(cls.points, stamp_ns=0)
        assert struct.counts.voxels > 5000 and struct.floor.found and struct.left.found and struct.right.found

    def same(self, points, copied):
        view = pose_wall.CloudView(points, 0)
        self.assertEqual(view.copied, copied)
        self.assertEqual(measured(points), self.expected)

    def test_contiguous(self):
        self.same(self.points, copied=False)
        self.same(self.points.astype(np.float64), copied=False)

    def test_columns_of_a_wider_array(self):
        self.same(wider(self.points)[:, :3], copied=False)
        self.same(wider(self.points, 4)[:, :3], copied=False)

    def test_columns_up_to_the_end_of_their_memory(self):
        """Behind the last point a whole step is promised; there is none."""
        self.same(wider(self.points, 4, 1)[:, 1:], copied=True)

    def test_every_other_row(self):
        twice = np.repeat(self.points, 2, axis=0)
        self.same(twice[::2], copied=False)
        self.same(twice[1::2], copied=True)  # ends with the memory
        self.same(twice[:-1][::2], copied=False)

    def test_every_other_column(self):
        spread = np.full((len(self.points), 6), np.nan, np.float32)
        spread[:, ::2] = self.points
        self.same(spread[:, ::2], copied=False)

    def test_columns_backwards(self):
        """z, y, x in memory."""
        self.same(np.ascontiguousarray(self.points[:, ::-1])[:, ::-1], copied=True)

    def test_rows_backwards(self):
        self.same(np.ascontiguousarray(self.points[::-1])[::-1], copied=True)

    def test_fortran_order(self):
        self.same(np.asfortranarray(self.points), copied=True)
        self.same(np.ascontiguousarray(self.points.T).T, copied=True)

    def test_other_byte_order(self):
        self.same(self.points.astype(">f4"), copied=False)
        self.same(self.points.astype("<f4"), copied=False)
        self.same(structured(self.points, [(name, ">f8") for name in "zyx"]), copied=False)

    def test_structured(self):
        self.same(structured(self.points), copied=False)
        self.same(structured(self.points, align=True), copied=False)
        self.same(structured(self.points)[["z", "x", "y"]], copied=False)

    def test_structured_of_odd_offsets(self):
        made = np.zeros(len(self.points), np.dtype({"names": ["x", "y", "z"], "formats": ["<f8", "<f4", "<f8"],
                                                    "offsets": [1, 18, 23], "itemsize": 33}))
        for column, name in enumerate("xyz"):
            made[name] = self.points[:, column]
        self.same(made, copied=False)

    def test_organised(self):
        self.same(structured(self.points).reshape(64, 400), copied=False)

    def test_structured_in_steps(self):
        twice = np.repeat(structured(self.points), 2)
        self.same(twice[::2], copied=False)
        self.same(twice[::-2], copied=True)

    def test_record_arrays(self):
        self.same(structured(self.points).view(np.recarray), copied=False)

    def test_memory_of_others(self):
        self.same(np.frombuffer(self.points.tobytes(), np.float32).reshape(-1, 3), copied=False)
        self.same(np.frombuffer(bytearray(self.points.tobytes()), np.float32).reshape(-1, 3), copied=False)
        file = scratch() / "points.bin"
        file.write_bytes(self.points.tobytes())
        self.same(np.memmap(file, np.float32, "r").reshape(-1, 3), copied=False)

    def test_windows_over_themselves(self):
        """Points that share their numbers: a step smaller than a point."""
        line = np.arange(3000, dtype=np.float32) * 0.01
        windows = np.lib.stride_tricks.as_strided(line, (2998, 3), (4, 4), writeable=False)
        self.assertTrue(pose_wall.CloudView(windows, 0).copied)
        self.assertEqual(measured(windows), measured(windows.copy()))

    def test_the_same_point_over_and_over(self):
        many = np.broadcast_to(np.float32([1.0, 2.0, 3.0]), (500, 3))
        self.assertTrue(pose_wall.CloudView(many, 0).copied)
        self.assertEqual(measured(many), measured(many.copy()))

    def test_nothing_is_read_behind_the_last_point(self):
        """The points end where a page ends, and nobody may read the next one."""
        page, pages = mmap.PAGESIZE, 40
        region = mmap.mmap(-1, page * (pages + 1))
        memory = np.frombuffer(region, np.uint8, page * pages)  # all that an array may take for its own
        libc = ctypes.CDLL(None, use_errno=True)
        self.assertEqual(libc.mprotect(ctypes.c_void_p(memory.ctypes.data + page * pages), page, 0), 0)
        for columns in (3, 4, 7):
            step = columns * 4
            points = self.points[:page * pages // step]
            flat = memory[page * pages - len(points) * step:page * pages].view(np.float32).reshape(-1, columns)
            flat[:, -3:] = points
            self.assertEqual(measured(flat[:, -3:]), measured(points.copy()), columns)
            flat[:, :3] = points
            self.assertEqual(measured(flat[:, :3]), measured(points.copy()), columns)


class Intensity(unittest.TestCase):
    def test_of_four_columns_and_of_a_field(self):
        points = road()
        grey = (np.arange(len(points)) % 200).astype(np.float32)
        four = np.column_stack([points, grey])
        expected = measured(four, intensity_weight=1.0)
        self.assertNotEqual(expected, measured(points, intensity_weight=1.0))
        for name in ("intensity", "i", "reflectivity"):
            for kind in ("<f4", "<f8", "u1", "<i2", "<u2", ">i4", "<u4"):
                fields = [(name, kind), *((axis, ">f4" if kind[0] == ">" else "<f4") for axis in "xyz")]
                made = structured(points, fields)
                made[name] = grey
                self.assertEqual(measured(made, intensity_weight=1.0), expected, (name, kind))


class Empty(unittest.TestCase):
    def test_no_points(self):
        for points in (np.empty((0, 3), np.float32), np.empty((0, 4)), structured(np.empty((0, 3))),
                       np.empty((0, 3), np.float32, order="F"), road()[:0][::-1]):
            result = pose_wall.Engine().process(points, stamp_ns=0)
            self.assertEqual(result.counts.points_in, 0)
            self.assertIs(result.worst_state, pose_wall.State.INVALID)

    def test_one_point(self):
        for points in (road()[5:6], road()[5:6][::-1], np.asfortranarray(road()[5:6]), structured(road()[5:6])):
            result = pose_wall.Engine().process(points, stamp_ns=0)
            self.assertEqual((result.counts.points_in, result.counts.voxels), (1, 1))

    def test_points_that_are_none(self):
        points = np.concatenate([road(), np.zeros((7, 3), np.float32), np.full((9, 3), np.nan, np.float32)])
        result = pose_wall.Engine().process(points, stamp_ns=0)
        self.assertEqual((result.counts.dropped_zero, result.counts.dropped_not_finite), (7, 9))


class Refused(unittest.TestCase):
    def refused(self, kind, words, points, **more):
        engine = pose_wall.Engine()
        with self.assertRaises(kind) as caught:
            engine.process(points, **{"stamp_ns": 0, **more})
        for word in words:
            self.assertIn(word, str(caught.exception))
        self.assertEqual(engine.process(road(), stamp_ns=0).frame_index, 0)  # nothing was changed

    def test_what_is_no_array(self):
        for value in ([[1.0, 2.0, 3.0]], None, b"xyz", 3.0, memoryview(b"abc")):
            self.refused(TypeError, ["NumPy array", type(value).__name__, "(N, 3)"], value)

    def test_shapes(self):
        for shape in ((3,), (5, 2), (5, 5), (2, 5, 3), (), (0,), (3, 0)):
            self.refused(ValueError, [str(shape), "(N, 3)"], np.zeros(shape, np.float32))
        self.refused(ValueError, ["3 dimensions"], structured(road()).reshape(8, 8, -1))

    def test_types(self):
        for kind in (np.int32, np.float16, np.complex64, object, "U3", "M8[ns]", bool, np.longdouble):
            self.refused(TypeError, ["x is of type", "float32 or float64"], np.zeros((4, 3), kind))
        self.refused(TypeError, ["y is of type int32"], np.zeros(3, [("x", "f4"), ("y", "i4"), ("z", "f4")]))
        self.refused(TypeError, ["x is of type"], np.zeros(3, [("x", "f4", (2,)), ("y", "f4"), ("z", "f4")]))
        self.refused(TypeError, ["intensity is of type int64"], structured(road(), [
            ("intensity", "i8"), ("x", "f4"), ("y", "f4"), ("z", "f4")]))

    def test_fields(self):
        self.refused(ValueError, ["field 'z' is missing", "x, y, Z"], np.zeros(
            3, [("x", "f4"), ("y", "f4"), ("Z", "f4")]))
        self.refused(TypeError, ["both byte orders"], np.zeros(3, [("x", ">f4"), ("y", "<f4"), ("z", "<f4")]))

    def test_masked(self):
        masked = np.ma.masked_array(road().copy(), mask=np.zeros(road().shape, bool))
        self.refused(TypeError, ["masked", "filled(np.nan)"], masked)

    def test_stamps(self):
        for stamp in (1.5, "0", None, True, np.float64(3.0)):
            self.refused(TypeError, ["stamp_ns", "whole number"], road(), stamp_ns=stamp)
        for stamp in (2**63, -2**63 - 1, 10**30):
            self.refused(ValueError, ["stamp_ns", str(stamp)], road(), stamp_ns=stamp)
        for stamp in (np.int64(7), np.uint32(7), 7):
            self.assertEqual(pose_wall.Engine().process(road(), stamp_ns=stamp).stamp_ns, 7)

    def test_inputs(self):
        self.refused(TypeError, ["pose_wall.Inputs", "dict"], road(), inputs={"standing": True})
        self.refused(ValueError, ["speed_m_s and speed_sigma_m_s"], road(), inputs=pose_wall.Inputs(speed_m_s=1.0))
        self.refused(ValueError, ["boxes", "5 given", "4"], road(), inputs=pose_wall.Inputs(boxes=((0,) * 6,) * 5))
        self.refused(ValueError, ["boxes[1]", "5 numbers"], road(), inputs=pose_wall.Inputs(
            boxes=((0, 1, 0, 1, 0, 1), (0,) * 5)))
        self.refused(TypeError, [], road(), inputs=pose_wall.Inputs(speed_m_s="fast", speed_sigma_m_s=1.0))


class InputsOfTheMachine(unittest.TestCase):
    def test_boxes_drop_points(self):
        """Half a metre ahead of the left wall from 1 to 2 m: so many points lie there."""
        x, y = road()[:, 0], road()[:, 1]
        expected = int(((x > 1.0) & (x < 2.0) & (y > 2.0)).sum())
        box = (1.0, 2.0, 2.0, 3.0, -5.0, 5.0)
        result = pose_wall.Engine().process(road(), stamp_ns=0, inputs=pose_wall.Inputs(boxes=(box,)))
        self.assertGreater(expected, 50)
        self.assertAlmostEqual(result.counts.dropped_body, expected, delta=2)

    def test_motion_that_cannot_be_is_said_to_be_unused(self):
        result = pose_wall.Engine().process(road(), stamp_ns=0, inputs=pose_wall.Inputs(
            speed_m_s=1e6, speed_sigma_m_s=0.1))
        self.assertIn(pose_wall.Reason.PRIOR, result.frame_reasons)
        result = pose_wall.Engine().process(road(), stamp_ns=0, inputs=pose_wall.Inputs(
            standing=True, turn_rate_rad_s=0.0, turn_rate_sigma_rad_s=0.01))
        self.assertNotIn(pose_wall.Reason.PRIOR, result.frame_reasons)


if __name__ == "__main__":
    unittest.main()
