# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""`pip install ./tools/apps/python` in an environment of its own, as a user of Debian does without a network. The
example runs there, with and without matplotlib, and so does the README's quick start by copy and paste. The objects of
this build are taken. With POSE_WALL_TEST_PIP_ALONE=1 pip has CMake build everything, which takes minutes."""

import functools
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from support import COMMAND, ROOT, np, road, scratch, needs_command

HERE = ROOT / "tools/apps/python"


def run(words, **more):
    done = subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False, **more)
    return done.returncode, done.stdout


def environment(**more):
    """Without what points to the package of the build."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    if os.environ.get("POSE_WALL_TEST_PIP_ALONE"):
        kept.pop("POSE_WALL_BUILD", None)
    return {**kept, "PYTHONDONTWRITEBYTECODE": "1", **more}


@functools.lru_cache(None)
def installed():
    """The interpreter of an environment that the package was installed in."""
    folder = scratch() / "venv"
    status, text = run([sys.executable, "-m", "venv", "--system-site-packages", folder])
    if status == 0:
        status, text = run([folder / "bin/pip", "install", "--no-index", "--no-build-isolation", HERE],
                           env=environment())
    if status != 0:
        raise AssertionError(text)
    return folder / "bin/python"


@unittest.skipUnless(all(importlib.util.find_spec(name) for name in ("ensurepip", "pip", "setuptools", "wheel")),
                     "pip is missing: apt install python3-pip python3-setuptools python3-wheel python3-venv")
class Pip(unittest.TestCase):
    def python(self, code, **more):
        return run([installed(), "-c", code], env=environment(**more), cwd=scratch())

    def test_it_is_of_that_environment_and_computes_what_was_tested(self):
        status, text = self.python("import pose_wall; print(pose_wall.__file__, pose_wall.self_test().frames)")
        self.assertEqual(status, 0, text)
        self.assertRegex(text, re.escape(str(scratch() / "venv")) + r"/lib/.*/pose_wall/__init__.py 4")
        status, text = self.python("from importlib.metadata import version, files\nprint(version('pose-wall'))\n"
                                   "print(*sorted(str(file) for file in files('pose-wall')), sep='\\n')")
        self.assertEqual(status, 0, text)
        for file in ("pose_wall/py.typed", "pose_wall/_abi.py", "pose_wall/libpose_wall_py.so"):
            self.assertIn(f"\n{file}\n", text)

    def test_the_tree_is_left_as_it_was(self):
        installed()
        if not shutil.which("git"):
            self.skipTest("git is not installed")
        status, text = run(["git", "-C", ROOT, "status", "--porcelain", "--ignored", "tools/apps/python"])
        if status != 0:
            self.skipTest("no git repository")
        made = [line for line in text.splitlines() if line.startswith(("??", "!!"))]
        self.assertEqual(made, [])

    def test_without_its_library_it_says_what_to_do(self):
        status, text = run([sys.executable, "-c", "import pose_wall"], env=environment(PYTHONPATH=str(HERE / "src")))
        self.assertEqual(status, 1)
        self.assertIn("pip install ./tools/apps/python", text)

    @needs_command
    def test_the_example_simulates_and_plots(self):
        path = f"{pathlib.Path(COMMAND).parent}:{os.environ['PATH']}"
        status, text = run([installed(), HERE / "example.py"], env=environment(PATH=path), cwd=scratch())
        self.assertEqual(status, 0, text)
        self.assertRegex(text, r"40 frames.*\n(.*\n)*yaw +-?0\.\d+ +\d")
        if importlib.util.find_spec("matplotlib"):
            self.assertTrue((scratch() / "run.png").read_bytes().startswith(b"\x89PNG"))
        else:
            self.assertIn("apt install python3-matplotlib", text)

    def test_the_example_with_a_file_and_without_matplotlib(self):
        file = scratch() / "one.pcd"
        file.write_bytes(b"VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH %d\nHEIGHT 1\nDATA binary\n" %
                         len(road()) + np.ascontiguousarray(road()).tobytes())
        (scratch() / "hidden").mkdir(exist_ok=True)
        (scratch() / "hidden/matplotlib.py").write_text("raise ImportError", encoding="utf-8")
        status, text = run([installed(), HERE / "example.py", "--set", "yaw_max_deg=40", file],
                           env=environment(PYTHONPATH=str(scratch() / "hidden")), cwd=scratch())
        self.assertEqual(status, 0, text)
        self.assertIn("1 frames", text)
        self.assertIn("apt install python3-matplotlib", text)

    def test_the_example_says_what_is_wrong(self):
        for words, expected in ((["--set", "yaw_max=4", "x.pcd"], "did you mean 'yaw_max_deg'?"),
                                (["missing.pcd"], "missing.pcd"), ([], "put the command `pose_wall` onto PATH")):
            status, text = run([installed(), HERE / "example.py", *words], cwd=scratch(),
                               env=environment(PATH="/nowhere"))
            self.assertEqual(status, 1)
            self.assertIn(expected, text)
            self.assertNotIn("Traceback", text)

    @needs_command
    def test_the_python_of_the_readme_runs(self):
        """Every block, in their order, in a folder in which the road of the README was simulated."""
        run([COMMAND, "sim", "--quiet", "--scene", "nominal", "--frames", "10", "--output", scratch() / "road"])
        text = (HERE / "README.md").read_text(encoding="utf-8")
        blocks = re.findall(r"```python\n(.*?)```", text, re.S)
        self.assertGreater(len(blocks), 3)
        code = "if __name__ == '__main__':\n" + "".join(f"    {line}\n" for line in "\n".join(blocks).splitlines())
        (scratch() / "readme.py").write_text(code, encoding="utf-8")
        status, text = run([installed(), scratch() / "readme.py"], env=environment(), cwd=scratch())
        self.assertEqual(status, 0, text)


if __name__ == "__main__":
    unittest.main()
