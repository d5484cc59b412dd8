# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""pip install ./tools/apps/python: has CMake build the shared library out of the tree that this folder lies in. What it
makes is left below build/pip, so that a second run is quick. In the environment: CMAKE_ARGS are handed on;
POSE_WALL_BUILD names a folder that CMake was run in already, whose objects are taken."""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import setup
from setuptools.command.build_py import build_py
from setuptools.dist import Distribution
from wheel.bdist_wheel import bdist_wheel

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
BUILD = ROOT / "build" / "pip"
LIBRARY = "libpose_wall_py.so"


def version():
    """Of the engine that is built, which the package insists on when it loads the library."""
    lists = ROOT / "CMakeLists.txt"
    if not lists.exists():
        sys.exit(f"{lists} is missing: pose_wall is installed from its source tree, pip install ./tools/apps/python")
    return re.search(r"project\(pose_wall VERSION ([0-9.]+)", lists.read_text(encoding="utf-8"))[1]


def build_library():
    """Gives the path of the library."""
    if shutil.which("cmake") is None:
        sys.exit("pose_wall: cmake is missing. Debian: apt install cmake g++ libeigen3-dev")
    given = os.environ.get("POSE_WALL_BUILD")
    folder = pathlib.Path(given) if given else BUILD / "cmake"
    try:
        if not given:
            subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release",
                            "-DPOSE_WALL_BUILD_TOOLS=OFF", "-DPOSE_WALL_BUILD_TESTS=OFF", "-DPOSE_WALL_BUILD_PYTHON=ON",
                            *shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "pose_wall_py", "--parallel",
                        str(os.cpu_count() or 1)], check=True)
    except subprocess.CalledProcessError as error:
        sys.exit(f"pose_wall: the library was not built ({error}). It takes cmake, g++, binutils and Eigen; Debian: "
                 "apt install cmake g++ libeigen3-dev")
    return folder / "python" / "pose_wall" / LIBRARY


class BuildWithLibrary(build_py):
    """The modules, and the library beside them."""

    def run(self):
        if getattr(self, "editable_mode", False):
            sys.exit("pose_wall cannot be installed editable: build the target pose_wall_python and put "
                     "build/<preset>/python into PYTHONPATH")
        super().run()
        shutil.copy2(build_library(), pathlib.Path(self.build_lib) / "pose_wall" / LIBRARY)


class OfThisMachine(Distribution):
    """It holds machine code."""

    def has_ext_modules(self):
        return True


class AnyPython(bdist_wheel):
    """The library knows nothing of Python: one wheel for every version of it."""

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


BUILD.mkdir(parents=True, exist_ok=True)
setup(version=version(), packages=["pose_wall"], package_dir={"": "src"}, package_data={"pose_wall": ["py.typed"]},
      distclass=OfThisMachine, cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": AnyPython},
      options={"build": {"build_base": str(BUILD / "setuptools")}, "egg_info": {"egg_base": str(BUILD)}})
