#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Builds the engine by several compilers, for several processors and at several levels of optimisation, and asks that
all give the same digests: of the roadways, as digests.txt notes them, and of recorded frames where there are any.

    compare_builds.py OUTPUT [--builds NAME,NAME...] [--recorded FILE.xyz...]

OUTPUT is a folder for the builds. FILE.xyz is what real_frames.sh makes of a recording. Recordings are compared between
builds, so at least two have to read them; the one without an operating system reads no files. Needs clang,
g++-aarch64-linux-gnu, g++-arm-linux-gnueabihf, qemu-user-static. All builds: some twelve minutes on two cores.
"""

import argparse
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True  # the sources stay as they are

from check_digests import differences, lines_of  # noqa: E402  pylint: disable=wrong-import-position

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
GCC, CLANG = ([f"-DCMAKE_C_COMPILER={c}", f"-DCMAKE_CXX_COMPILER={cpp}"]
              for c, cpp in (("gcc", "g++"), ("clang", "clang++")))
ARM_GCC, ARM_CLANG, BARE, ARMV7_GCC = ([f"-DCMAKE_TOOLCHAIN_FILE={ROOT}/toolchains/{name}.cmake"] for name in (
    "aarch64-linux-gnu", "aarch64-linux-gnu-clang", "aarch64-none-elf",
    "arm-linux-gnueabihf"))
ON_ARM = ["qemu-aarch64-static", "-L", "/usr/aarch64-linux-gnu", "-E", "LD_LIBRARY_PATH=/usr/aarch64-linux-gnu/lib"]
ON_A53 = ON_ARM + ["-cpu", "cortex-a53"]
ON_A8 = ["qemu-arm-static", "-L", "/usr/arm-linux-gnueabihf", "-E", "LD_LIBRARY_PATH=/usr/arm-linux-gnueabihf/lib",
         "-cpu", "cortex-a8"]

# Name, how to configure, flags, how to run; AVX2 and FMA are there for the taking on a haswell.
BUILDS = [
    ("x86-64-gcc-O1", GCC, "-O1", []),
    ("x86-64-gcc-O2", GCC, "-O2", []),
    ("x86-64-gcc-O3", GCC, "-O3", []),
    ("x86-64-gcc-O3-haswell", GCC, "-O3 -march=haswell", []),
    ("x86-64-clang-O1", CLANG, "-O1", []),
    ("x86-64-clang-O2", CLANG, "-O2", []),
    ("x86-64-clang-O3", CLANG, "-O3", []),
    ("x86-64-clang-O3-haswell", CLANG, "-O3 -march=haswell", []),
    ("aarch64-gcc-O1", ARM_GCC, "-O1", ON_A53),
    ("aarch64-gcc-O3", ARM_GCC, "-O3", ON_A53),
    ("aarch64-gcc-O3-neoverse-n1", ARM_GCC, "-O3 -mcpu=neoverse-n1", ON_ARM),
    ("aarch64-clang-O2", ARM_CLANG, "-O2", ON_A53),
    ("aarch64-clang-O3", ARM_CLANG, "-O3", ON_A53),
    ("aarch64-none-elf-clang-Os", BARE, "-Os", ["qemu-aarch64-static", "-cpu", "cortex-a53"]),
    ("armv7-gcc-O3", ARMV7_GCC, "-O3", ON_A8),
    ("armv7-gcc-O2-neon", ARMV7_GCC, "-O2 -mfpu=neon", ON_A8),
]


def quietly(command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def build(folder, configure, flags):
    """Of a build type of its own, which adds no flags to these."""
    options = ["-DCMAKE_BUILD_TYPE=Compared", f"-DCMAKE_C_FLAGS_COMPARED={flags}",
               f"-DCMAKE_CXX_FLAGS_COMPARED={flags} -DNDEBUG", "-DPOSE_WALL_BUILD_TOOLS=OFF"]
    quietly(["cmake", "-G", "Ninja", "-S", ROOT, "-B", folder] + configure + options)
    quietly(["cmake", "--build", folder, "--target", "pose_wall_digest", "-j2"])
    return folder / "tests/pose_wall_digest"


def reads_files(name):
    return "none-elf" not in name


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--builds", default=",".join(name for name, *_ in BUILDS), help="names, separated by commas")
    parser.add_argument("--recorded", nargs="*", default=[])
    options = parser.parse_args()
    wanted = set(options.builds.split(","))
    unknown = wanted - {name for name, *_ in BUILDS}
    if unknown:
        sys.exit(f"no such build: {', '.join(sorted(unknown))}")
    if options.recorded and sum(map(reads_files, wanted)) < 2:
        sys.exit("recordings are compared between builds: name two or more that read files")
    noted, recordings, failed = lines_of((HERE / "digests.txt").read_text(encoding="utf-8")), None, False
    for name, configure, flags, emulator in BUILDS:
        if name not in wanted:
            continue
        program = emulator + [build(options.output / name, configure, flags)]
        found = lines_of(quietly(program))
        worse = differences(noted, found)
        if options.recorded and reads_files(name):
            recorded = lines_of(quietly(program + options.recorded))
            recordings = recordings or recorded  # the first build says what is expected
            worse += differences(recordings, recorded)
            found.update(recorded)
        print(f"{name:28} {len(found):3d} sequences  {'DIFFERS' if worse else 'the same bits'}", flush=True)
        print("".join(f"    {line}\n" for line in worse), end="", flush=True)
        failed = failed or bool(worse)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
