# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""PCD files. Every encoding gives the points that were written, and stamps are those of the command. A file that lies
or was damaged is refused by name. Reading it takes no more memory than the file is large."""

import random
import tracemalloc
import unittest

from support import json_rows, needs_command, np, pose_wall, road, scratch

from pose_wall._lzf import decompress  # pylint: disable=wrong-import-order
from pose_wall.pcd import read_frames, read_pcd  # pylint: disable=wrong-import-order

PLAIN = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
MIXED = "FIELDS t _ x y z ring tag\nSIZE 8 1 4 8 4 2 1\nTYPE U U F F F U I\nCOUNT 1 3 1 1 1 1 2\n"


def pcd(head, encoding, points, data, version="0.7"):
    return (f"# .PCD v{version}\nVERSION {version}\n{head}WIDTH {points}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
            f"POINTS {points}\nDATA {encoding}\n").encode() + data


def packed_literally(data):
    """LZF without a single reference."""
    return b"".join(bytes([len(data[at:at + 32]) - 1]) + data[at:at + 32] for at in range(0, len(data), 32))


def compressed(columns, packed=None, unpacked=None):
    body = packed_literally(columns) if packed is None else packed
    sizes = (len(body), len(columns) if unpacked is None else unpacked)
    return b"".join(size.to_bytes(4, "little") for size in sizes) + body


class Written(unittest.TestCase):
    def read(self, data, name="frame.pcd"):
        file = scratch() / name
        file.write_bytes(data)
        return read_pcd(file)

    def mixed(self):
        kind = np.dtype([("t", "<u8"), ("pad", "u1", 3), ("x", "<f4"), ("y", "<f8"), ("z", "<f4"), ("ring", "<u2"),
                         ("tag", "i1", 2)])
        points = np.zeros(5, kind)
        for number, name in enumerate(("t", "x", "y", "z", "ring")):
            points[name] = np.arange(5) * (number + 1) + number
        points["tag"] = [[-1, 2]] * 5
        return points

    def same_as_mixed(self, points):
        expected = self.mixed()
        self.assertEqual(points.dtype.names, ("t", "x", "y", "z", "ring", "tag"))
        for name in points.dtype.names:
            np.testing.assert_array_equal(points[name], expected[name])

    def test_binary(self):
        frame = self.read(pcd(PLAIN, "binary", len(road()), road().tobytes()))
        for column, name in enumerate("xyz"):
            np.testing.assert_array_equal(frame.points[name], road()[:, column])
        self.assertFalse(frame.points.flags.writeable)
        self.same_as_mixed(self.read(pcd(MIXED, "binary", 5, self.mixed().tobytes())).points)

    def test_compressed(self):
        columns = b"".join(self.mixed()[name].tobytes() for name in self.mixed().dtype.names)
        self.same_as_mixed(self.read(pcd(MIXED, "binary_compressed", 5, compressed(columns))).points)

    def test_ascii(self):
        frame = self.read(pcd(PLAIN, "ascii", 3,
                              b"1 2 3\n\n +4.5\t-5e-1 nan  \r\n7 8 inf\n9 9 9\n"))
        np.testing.assert_array_equal(frame.points["x"], np.float32([1, 4.5, 7]))
        np.testing.assert_array_equal(frame.points["z"], np.float32([3, np.nan, np.inf]))
        head = "FIELDS _ x t y tag z\nSIZE 1 4 4 8 1 4\nTYPE U F U F U F\nCOUNT 2 1 1 1 3 1\n"
        frame = self.read(pcd(head, "ascii", 1, b"99 99 1 4294967295 0.1 7 7 7 3\n"))
        self.assertEqual(frame.points.dtype.names, ("x", "t", "y", "z"))
        self.assertEqual(frame.points[0].tolist(), (1.0, 4294967295.0, 0.1, 3.0))

    def test_headers_of_all_kinds(self):
        body = np.float32([[1, 2, 3]]).tobytes()
        for head in ("COLUMNS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nDATA binary\n",
                     "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 9\nHEIGHT 9\nPOINTS 1\nDATA binary\n",
                     "FIELDS x y z\r\nSIZE 4 4 4\r\nTYPE F F F\r\nWIDTH 0\r\nHEIGHT 0\r\nPOINTS 0\r\nDATA binary\r\n",
                     "# a comment\nVERSION .5\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nDATA binary\n"):
            points = self.read(head.encode() + body).points
            self.assertEqual(points.tolist(), [(1.0, 2.0, 3.0)], head)

    def test_stamps(self):
        body = pcd(PLAIN, "binary", 0, b"")
        for comment, expected in (("# stamp_ns 1630577758569489920\n", 1630577758569489920), ("# stamp_ns -5\n", -5),
                                  ("# stamp_ns 9223372036854775808\n", None), ("# stamp_ns x\n", None), ("", None)):
            self.assertEqual(self.read(comment.encode() + body).stamp_ns, expected)
        by_name = self.read(b"# stamp_ns 7\n" + body, "1700000000123456789.pcd")
        self.assertEqual(by_name.stamp_ns, 1700000000123456789)
        self.assertEqual(self.read(body, "1700000000123456.pcd").stamp_ns, 1700000000123456000)
        for name in ("170000000012345", "0000000000000012", "20240131235959123", "17000000001234567890",
                     "9999999999999999999", "a1234567890123456"):
            self.assertIsNone(self.read(body, f"{name}.pcd").stamp_ns)

    def test_rows_of_frames(self):
        folder = scratch() / "row"
        folder.mkdir()
        body = pcd(PLAIN, "binary", 0, b"")
        (folder / "10.pcd").write_bytes(body)
        (folder / "9.pcd").write_bytes(body)
        (folder / "11.pcd").write_bytes(b"# stamp_ns 5000000000\n" + body)
        (folder / "note.txt").write_bytes(b"no frame")
        frames = list(read_frames(folder, 3.0))
        self.assertEqual([frame.path.name for frame in frames], ["10.pcd", "11.pcd", "9.pcd"])
        self.assertEqual([frame.stamp_ns for frame in frames], [0, 5_000_000_000, 5_333_333_333])
        twice = list(read_frames([folder / "9.pcd", str(folder / "9.pcd")]))
        self.assertEqual([frame.stamp_ns for frame in twice], [0, 10**8])
        for rate in (0.0, -1.0, float("nan"), float("inf")):
            with self.assertRaisesRegex(ValueError, "rate_hz"):
                list(read_frames(folder, rate))
        (scratch() / "bare").mkdir()
        with self.assertRaisesRegex(pose_wall.PcdError, "bare: holds no .pcd file"):
            list(read_frames(scratch() / "bare"))

    @needs_command
    def test_the_command_counts_the_same_points(self):
        points = np.concatenate([road()[:3000], np.float32([[0, 0, 0], [np.nan, 1, 1], [500, 0, 0], [0.1, 0, 0]])])
        text = "\n".join(" ".join(repr(float(number)) for number in point) for point in points).encode() + b"\n"
        for encoding, data in (("ascii", text), ("binary", points.tobytes()),
                               ("binary_compressed", compressed(points.T.tobytes()))):
            frame = self.read(pcd(PLAIN, encoding, len(points), data), f"{encoding}.pcd")
            engine = pose_wall.Engine()
            result = engine.process(frame.points, stamp_ns=0)
            line, = json_rows("/dev/null", frame.path)
            counts = result.counts
            self.assertEqual((counts.points_in, counts.dropped_zero, counts.dropped_not_finite, counts.dropped_far,
                              counts.dropped_near, counts.voxels),
                             tuple(line["points"][name] for name in ("in", "dropped_zero", "dropped_not_finite",
                                                                     "dropped_far", "dropped_near", "voxels")))
            self.assertEqual(result.work, line["work"], encoding)


class Lzf(unittest.TestCase):
    def test_by_hand(self):
        self.assertEqual(decompress(b"\x02abc", 3), b"abc")
        self.assertEqual(decompress(b"\x02abc\x20\x02", 6), b"abcabc")  # three bytes, from three back
        self.assertEqual(decompress(b"\x00a\x20\x00", 4), b"aaaa")  # it runs into what it writes
        self.assertEqual(decompress(b"\x01ab\xe0\x05\x01", 16), b"ab" * 8)  # long: 7 + 5 + 2 bytes
        self.assertEqual(decompress(b"", 0), b"")
        far = bytes(range(256)) * 20
        self.assertEqual(decompress(packed_literally(far) + b"\x32\x03", len(far) + 3),
                         far + far[-0x1204:-0x1204 + 3])  # 0x1203 + 1 bytes back

    def test_damaged(self):
        for packed, size in ((b"\x02ab", 3), (b"\x02abc", 4), (b"\x02abc", 2), (b"\x20\x00", 3), (b"\x02abc\x20", 6),
                             (b"\x02abc\xe0\x05", 12), (b"\x02abc\x20\x03", 6), (b"\x00a\xe0", 5), (b"", 1),
                             (b"\x00a", 89)):
            with self.assertRaises(ValueError, msg=packed):
                decompress(packed, size)


class Refused(unittest.TestCase):
    def refused(self, data, *words):
        file = scratch() / "refused.pcd"
        file.write_bytes(data)
        with self.assertRaises(pose_wall.PcdError) as caught:
            read_pcd(file)
        for word in ("refused.pcd", *words):
            self.assertIn(word, str(caught.exception))

    def test_headers(self):
        good = pcd(PLAIN, "binary", 1, bytes(12)).decode()
        for old, new, word in (
                ("FIELDS x y z", "FIELDS x y", "SIZE has 3 values for 2 FIELDS"),
                ("FIELDS x y z", "FIELDS x y Z", "'z'"),
                ("FIELDS x y z", "FIELDS x x z", "twice"), ("FIELDS x y z\n", "", "FIELDS is missing"),
                ("TYPE F F F", "TYPE F F I", "'z' must be a float"), ("TYPE F F F", "TYPE F F Q", "TYPE 'Q'"),
                ("SIZE 4 4 4", "SIZE 4 4 9", "SIZE is '9'"), ("SIZE 4 4 4", "SIZE 4 4 2", "SIZE 2"),
                ("COUNT 1 1 1", "COUNT 1 1 0", "COUNT is '0'"), ("COUNT 1 1 1", "COUNT 1 1 2", "'z' must be"),
                ("COUNT 1 1 1", "COUNT 1 1 99999999", "COUNT is"), ("POINTS 1", "POINTS -1", "POINTS is '-1'"),
                ("POINTS 1", "POINTS", "POINTS is ''"), ("POINTS 1", "POINTS ٣", "POINTS is"),
                ("POINTS 1", "POINTS 4294967296", "POINTS is"), ("POINTS 1", "POINTS 2", "hold 1"),
                ("VERSION 0.7", "VERSION 0.8", "'0.8'"), ("DATA binary", "DATA zip", "'zip'"),
                ("DATA binary", "DATA", "''"),
                ("DATA binary", "", "no DATA line"), ("TYPE F F F", "TYPE F F F\nTYPE F F F", "TYPE appears twice")):
            self.assertTrue(old in good)
            self.refused(good.replace(old, new, 1).encode(), word)
        self.refused(b"", "empty")
        self.refused(bytes(100_000), "no DATA line within the first 65536 bytes")

    def test_ascii(self):
        for text, word in ((b"1 2\n", "line 12: 2 values, 3 expected"), (b"1 2 3 4\n", "4 values"), (b"1 2 x\n", "'x'"),
                           (b"", "declares 1 points, but 0"), (b"1 2 1_0\n", "'1_0'"),
                           (b"1 2 \xff\n", "is not a number")):
            self.refused(pcd(PLAIN, "ascii", 1, text), word)

    def test_compressed(self):
        columns = bytes(12)
        for data, word in ((b"", "sizes"), (compressed(columns)[:-1], "announced"),
                           (compressed(columns, unpacked=24), "the packed size says 24"),
                           (compressed(columns, packed=b"\x00a"), "damaged"),
                           (compressed(columns, packed=b"\x20\x00"), "damaged")):
            self.refused(pcd(PLAIN, "binary_compressed", 1, data), word)

    def test_sizes_that_lie_take_no_memory(self):
        large = 2**32 - 1
        tracemalloc.start()
        for data in (pcd(PLAIN, "binary", large, bytes(24)), pcd(PLAIN, "ascii", large, b"1 2 3\n"),
                     pcd(PLAIN, "binary_compressed", 300_000_000,
                         compressed(b"", packed=b"\x00a", unpacked=3_600_000_000))):
            self.refused(data, "declares" if b"compressed" not in data else "cannot hold")
        self.assertLess(tracemalloc.get_traced_memory()[1], 10_000_000)
        tracemalloc.stop()

    def test_no_file(self):
        with self.assertRaises(OSError):
            read_pcd(scratch() / "missing.pcd")
        with self.assertRaisesRegex(pose_wall.PcdError, "not a regular file"):
            read_pcd(scratch())
        with self.assertRaisesRegex(pose_wall.PcdError, "not a regular file"):
            read_pcd("/dev/zero")

    def test_any_damage_is_read_or_refused(self):
        """Bytes changed, cut and doubled at random: points or a PcdError, nothing else."""
        chance = random.Random(35)
        columns = np.arange(30, dtype=np.float32).tobytes()
        good = [pcd(PLAIN, "binary", 10, columns), pcd(MIXED, "ascii", 1, b"1 2 3 4 5 6 7 8 9 10\n"),
                pcd(PLAIN, "binary_compressed", 10, compressed(columns))]
        file = scratch() / "damaged.pcd"
        read = 0
        for turn in range(1500):
            data = bytearray(good[turn % 3])
            for _ in range(chance.randint(1, 4)):
                at = chance.randrange(len(data))
                kind = chance.randrange(3)
                if kind == 0:
                    data[at] = chance.randrange(256)
                elif kind == 1:
                    del data[at:at + chance.randint(1, 20)]
                else:
                    data[at:at] = data[at:at + chance.randint(1, 20)]
                data = data or bytearray(b"x")
            file.write_bytes(data)
            try:
                pose_wall.CloudView(read_pcd(file).points, 0)
                read += 1
            except pose_wall.PcdError:
                pass
        self.assertGreater(read, 100)
        self.assertLess(read, 1400)


if __name__ == "__main__":
    unittest.main()
