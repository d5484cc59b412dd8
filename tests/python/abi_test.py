# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""What Python believes of the C ABI is what was compiled: every struct's size and offsets, the symbols, the texts. The
generator refuses what it does not understand. It does not prove that the engine is right: others do."""

import ctypes
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from support import ROOT, pose_wall, scratch

from pose_wall import _abi, _library  # pylint: disable=wrong-import-order

GENERATOR = ROOT / "tools/apps/python/generate.py"


def layout_of(struct):
    return {name: (getattr(struct, name).offset, getattr(struct, name).size) for name, _ in struct._fields_}


def compiled_layouts():
    """By the program that tests/checks compiles: struct -> (bytes, member -> (offset, bytes))."""
    text = subprocess.run([os.environ["ABI_LAYOUT"]], stdout=subprocess.PIPE, text=True, check=True).stdout
    layouts, members = {}, {}
    for line in text.splitlines():
        words = line.split()
        if line.startswith("  "):
            members[words[0]] = (int(words[1]), int(words[2]))
        else:
            layouts[words[0]] = (int(words[1]), members)
            members = {}
    return layouts


class Layout(unittest.TestCase):
    @unittest.skipUnless(os.access(os.environ.get("ABI_LAYOUT", ""), os.X_OK), "pose_wall_abi_layout was not built")
    def test_every_struct_is_as_compiled(self):
        compiled = compiled_layouts()
        self.assertGreater(len(_abi.STRUCTS), 20)
        for name, struct in _abi.STRUCTS.items():
            with self.subTest(name):
                size, members = compiled[name]
                self.assertEqual(ctypes.sizeof(struct), size)
                self.assertEqual(layout_of(struct), members)

    def test_the_library_takes_structs_of_these_sizes(self):
        """Of one byte less or more it says so: the sizes are those that it was compiled with."""
        engine = pose_wall.Engine()
        for change, expected in ((0, 0), (1, pose_wall.Status.STRUCT_NEWER), (-4096, pose_wall.Status.STRUCT_SIZE)):
            result = _abi.pose_wall_result()
            result.struct_size = max(ctypes.sizeof(result) + change, 0)
            with engine._alone() as c:
                self.assertEqual(_library.lib.pose_wall_age(c, 0, result), expected, change)

    def test_every_function_of_the_headers_is_there_and_nothing_else(self):
        library = pathlib.Path(pose_wall.__file__).with_name("libpose_wall_py.so")
        text = subprocess.run([os.environ.get("NM", "nm"), "-D", "--defined-only", library], stdout=subprocess.PIPE,
                              text=True, check=True).stdout
        shown = {line.split()[2] for line in text.splitlines()}
        of_box = {name for name in shown if name.startswith("pose_wall_box_")}
        self.assertEqual(shown - of_box, {*_abi.FUNCTIONS, "pose_wall_python_clock_ns"})

    def test_dataclasses_lack_no_member_of_c(self):
        """A member that a later header adds has to be thought of here."""
        told = {"pose_wall_value": (pose_wall.Value, {"part": "parts"}, {"reserved"}),
                "pose_wall_plane": (pose_wall.Plane, {}, set()),
                "pose_wall_publication": (pose_wall.Publication, {}, {"struct_size", "reserved", "has_motion",
                                                                       "motion_status", "motion", "odometry"}),
                "pose_wall_runtime_times": (pose_wall.Times, {}, set()),
                "pose_wall_runtime_statistics": (pose_wall.Statistics, {}, {
                    "struct_size", "reserved", "box_written", "box_lost", "box_failed", "box_bytes_written", "sink",
                    "motion_refused", "motion"}),
                "pose_wall_runtime_options": (pose_wall.RuntimeOptions, {}, {
                    "struct_size", "reserved", "reserved_2", "clock", "clock_user", "callback", "callback_user", "sink",
                    "sink_user", "box_clouds", "box_backlog", "box_bytes", "motion", "motion_settings"})}
        for name, (kind, renamed, left_out) in told.items():
            members = {renamed.get(member, member) for member, _ in _abi.STRUCTS[name]._fields_} - left_out
            extra = {"is_valid"} & set(kind.__dataclass_fields__)
            self.assertEqual(set(kind.__dataclass_fields__) - extra, members, name)
        result = {member for member, _ in _abi.pose_wall_result._fields_} - {"struct_size", "mark", "quantity"}
        had = {*pose_wall.Result.__dataclass_fields__, *pose_wall.Counts.__dataclass_fields__}
        self.assertEqual(had - result - {"counts", "bits"}, set(pose_wall.QUANTITIES))
        self.assertEqual(result - had, set())

    def test_every_status_has_its_text(self):
        texts = [pose_wall.status_text(status) for status in pose_wall.Status]
        self.assertEqual(len(set(texts)), len(texts))
        self.assertNotIn(pose_wall.status_text(-12345), texts)
        self.assertEqual(str(pose_wall.Error(-12345)), pose_wall.status_text(-12345))


class Generator(unittest.TestCase):
    def setUp(self):
        self.root = scratch() / self.id()
        for path in ("include/pose_wall.h", "include/pose_wall_motion.h", "include/pose_wall_runtime.h",
                     "include/pose_wall_motion_settings.def", "tools/apps/python/src/pose_wall/_abi.py"):
            (self.root / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / path, self.root / path)

    def check(self):
        done = subprocess.run([sys.executable, GENERATOR, "--check", self.root], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)
        return done.returncode, done.stdout

    def change(self, old, new, header="include/pose_wall.h"):
        text = (self.root / header).read_text(encoding="utf-8")
        self.assertTrue(old in text, old)
        (self.root / header).write_text(text.replace(old, new, 1), encoding="utf-8")

    def test_what_is_in_the_tree_is_what_the_headers_say(self):
        self.assertEqual(self.check(), (0, ""))

    def test_a_changed_header_is_noticed(self):
        for old, new in (("  double d_m; ", "  double more_m; double d_m; "),
                         ("POSE_WALL_HELD = 1,", "POSE_WALL_HELD = 9,"),
                         ("double age_s; ", "float age_s; "),
                         ("POSE_WALL_PARTS = 7", "POSE_WALL_PARTS = 8"),
                         ("uint64_t pose_wall_memento_bytes(void);", "uint32_t pose_wall_memento_bytes(void);")):
            self.setUp()
            self.change(old, new)
            status, text = self.check()
            self.assertEqual(status, 1, old)
            self.assertIn("is not what the headers say", text)

    def test_what_is_not_understood_is_named(self):
        for old, new, named in (("double age_s; ", "long double age_s; ", "'long double'"),
                                ("enum pose_wall_state {", "enum pose_wall_mood {", "enum pose_wall_mood has no class"),
                                ("double d_m;", "unsigned d_m : 3;", "d_m : 3")):
            self.setUp()
            self.change(old, new)
            status, text = self.check()
            self.assertEqual(status, 1, old)
            self.assertIn(named, text)

    def test_offsets_of_the_pinned_layout(self):
        """Also on a machine where the layout's program was not compiled."""
        pinned = (ROOT / "tests/checks/abi_layout.txt").read_text(encoding="utf-8")
        if ctypes.sizeof(ctypes.c_void_p) == 8:
            for name, struct in _abi.STRUCTS.items():
                size = re.search(rf"^{name} (\d+)$", pinned, re.M)
                self.assertEqual(int(size[1]), ctypes.sizeof(struct), name)


if __name__ == "__main__":
    unittest.main()
