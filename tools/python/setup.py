# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Builds the shared library by CMake and puts it, with the headers it was built from, into the package. Where
POSE_WALL_LIBRARY names one that is built already, it is taken instead."""

import os
import pathlib
import shutil
import subprocess

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

TREE = pathlib.Path(__file__).resolve().parents[2]


class BuildWithLibrary(build_py):
    def run(self):
        super().run()
        package = pathlib.Path(self.build_lib) / "pose_wall"
        for header in ("pose_wall.h", "pose_wall_runtime.h"):
            shutil.copy(TREE / "include" / header, package)
        shutil.copy(os.environ.get("POSE_WALL_LIBRARY") or self.built_library(), package)

    def built_library(self):
        build = pathlib.Path(self.build_lib).resolve().parent / "cmake"
        subprocess.run(["cmake", "-S", str(TREE), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release",
                        "-DPOSE_WALL_BUILD_TOOLS=OFF", "-DPOSE_WALL_BUILD_TESTS=OFF", "-DPOSE_WALL_BUILD_SHARED=ON"],
                       check=True)
        subprocess.run(["cmake", "--build", str(build), "--target", "pose_wall_shared", "--parallel"], check=True)
        return build / "libpose_wall_shared.so"


class WithLibrary(Distribution):
    def has_ext_modules(self):
        return True  # it is of one machine


setup(cmdclass={"build_py": BuildWithLibrary}, distclass=WithLibrary)
