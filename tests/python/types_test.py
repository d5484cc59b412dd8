# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The package's type hints hold, and say to its users what is wrong with a call, where mypy is installed."""

import importlib.util
import subprocess
import sys
import unittest

from support import ROOT, scratch

USE = """import numpy as np
import pose_wall
result: pose_wall.Result = pose_wall.Engine(pose_wall.Config(yaw_max_deg=40)).process(np.zeros((9, 3)), stamp_ns=0)
level: float = result.yaw.protection_level
state: pose_wall.State = result["d_lf"].state
"""


@unittest.skipUnless(importlib.util.find_spec("mypy"), "mypy is missing: apt install mypy")
class Types(unittest.TestCase):
    def mypy(self, *words):
        done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", scratch() / "mypy", *words],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                              cwd=ROOT / "tools/apps/python/src")
        return done.returncode, done.stdout

    def test_of_the_package(self):
        status, text = self.mypy("pose_wall")
        self.assertEqual(status, 0, text)

    def test_of_its_users(self):
        file = scratch() / "use.py"
        file.write_text(USE, encoding="utf-8")
        self.assertEqual(self.mypy(file)[0], 0, self.mypy(file)[1])
        for wrong, told in (("result.yaw.value = 1.0", "read-only"), ("result.yaw.vale", 'maybe "value"'),
                            ("pose_wall.Engine().process(np.zeros((9, 3)))", "stamp_ns")):
            file.write_text(f"{USE}{wrong}\n", encoding="utf-8")
            status, text = self.mypy(file)
            self.assertEqual(status, 1, text)
            self.assertIn(told, text)


if __name__ == "__main__":
    unittest.main()
