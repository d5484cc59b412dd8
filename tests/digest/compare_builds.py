#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Builds engine, motion and planar library by several compilers, for several processors and at several levels of
optimisation. Asks that all give the same digests: of the roadways, as *digests.txt note them, and of recorded frames
where there are any. Asks also that no library has a fused instruction (check_fused.py).

    compare_builds.py OUTPUT [--builds NAME,NAME...] [--recorded FILE.xyz...]

OUTPUT is a folder for the builds. FILE.xyz is what real_frames.sh makes of a recording. Recordings are compared between
builds, so at least two have to read them; the one without an operating system reads no files and has the engine alone.
Needs clang, g++-aarch64-linux-gnu, g++-arm-linux-gnueabihf, qemu-user-static. A build takes two minutes of a processor.
"""

import argparse
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True  # the sources stay as they are

from check_digests import differences, lines_of  # noqa: E402  pylint: disable=wrong-import-position

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
FUSED = ROOT / "tests/checks/check_fused.py"
# What stands before "digest" in the names of the program and of the noted digests; the library is libpose_wall*.a.
LIBRARIES = {"": "libpose_wall.a", "motion_": "libpose_wall_motion.a", "planar_": "libpose_wall_planar.a"}
GCC, CLANG = ([f"-DCMAKE_C_COMPILER={c}", f"-DCMAKE_CXX_COMPILER={cpp}"]
              for c, cpp in (("gcc", "g++"), ("clang", "clang++")))
ARM_GCC, ARM_CLANG, BARE, ARMV7_GCC = ([f"-DCMAKE_TOOLCHAIN_FILE={ROOT}/toolchains/{name}.cmake"] for name in (
    "aarch64-linux-gnu", "aarch64-linux-gnu-clang", "aarch64-none-elf",
    "arm-linux-gnueabihf"))
ON_ARM = ["qemu-aarch64-static", "-L", "/usr/aarch64-linux-gnu", "-E", "LD_LIBRARY_PATH=/usr/aarch64-linux-gnu/lib"]
ON_A53 = ON_ARM + ["-cpu", "cortex-a53"]
ON_A8 = ["qemu-arm-static", "-L", "/usr/arm-linux-gnueabihf", "-E", "LD_LIBRARY_PATH=/usr/arm-linux-gnueabihf/lib",
         "-cpu", "cortex-a8"]
ON_A15 = ON_A8[:-1] + ["cortex-a15"]

# Name, how to configure, flags, how to run. There for the taking: AVX2 and FMA on a haswell, AVX-512 on an x86-64-v4,
# complex products on Armv8.3 and with SVE, fused products of floats on a neoverse-n1 and with VFPv4.
BUILDS = [
    ("x86-64-gcc-O1", GCC, "-O1", []),
    ("x86-64-gcc-O2", GCC, "-O2", []),
    ("x86-64-gcc-O3", GCC, "-O3", []),
    ("x86-64-gcc-O3-haswell", GCC, "-O3 -march=haswell", []),
    ("x86-64-gcc-O3-v4", GCC, "-O3 -march=x86-64-v4", []),
    ("x86-64-clang-O1", CLANG, "-O1", []),
    ("x86-64-clang-O2", CLANG, "-O2", []),
    ("x86-64-clang-O3", CLANG, "-O3", []),
    ("x86-64-clang-O3-haswell", CLANG, "-O3 -march=haswell", []),
    ("x86-64-clang-O3-v4", CLANG, "-O3 -march=x86-64-v4", []),
    ("aarch64-gcc-O1", ARM_GCC, "-O1", ON_A53),
    ("aarch64-gcc-O3", ARM_GCC, "-O3", ON_A53),
    ("aarch64-gcc-O3-neoverse-n1", ARM_GCC, "-O3 -mcpu=neoverse-n1", ON_ARM),
    ("aarch64-gcc-O3-armv8.3", ARM_GCC, "-O3 -march=armv8.3-a", ON_ARM),
    ("aarch64-gcc-O3-sve", ARM_GCC, "-O3 -march=armv8.2-a+sve", ON_ARM),
    ("aarch64-clang-O2", ARM_CLANG, "-O2", ON_A53),
    ("aarch64-clang-O3", ARM_CLANG, "-O3", ON_A53),
    ("aarch64-clang-O3-armv8.3", ARM_CLANG, "-O3 -march=armv8.3-a", ON_ARM),
    ("aarch64-none-elf-clang-Os", BARE, "-Os", ["qemu-aarch64-static", "-cpu", "cortex-a53"]),
    ("armv7-gcc-O3", ARMV7_GCC, "-O3", ON_A8),
    ("armv7-gcc-O2-neon", ARMV7_GCC, "-O2 -mfpu=neon", ON_A8),
    ("armv7-gcc-O3-vfpv4", ARMV7_GCC, "-O3 -mfpu=neon-vfpv4", ON_A15),
]


def quietly(command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def build(folder, configure, flags, kinds):
    """Of a build type of its own, which adds no flags to these."""
    options = ["-DCMAKE_BUILD_TYPE=Compared", f"-DCMAKE_C_FLAGS_COMPARED={flags}",
               f"-DCMAKE_CXX_FLAGS_COMPARED={flags} -DNDEBUG", "-DPOSE_WALL_BUILD_TOOLS=OFF"]
    quietly(["cmake", "-G", "Ninja", "-S", ROOT, "-B", folder] + configure + options)
    quietly(["cmake", "--build", folder, "-j2", "--target"] + [f"pose_wall_{kind}digest" for kind in kinds])


def reads_files(name):
    return "none-elf" not in name


def objdump_of(name):
    machine = name.split("-")[0]
    return {"aarch64": "aarch64-linux-gnu-", "armv7": "arm-linux-gnueabihf-"}.get(machine, "") + "objdump"


def cannot_run(name):
    """Why this machine cannot, or nothing."""
    cpu = pathlib.Path("/proc/cpuinfo")
    if name.endswith("-v4") and "avx512f" not in (cpu.read_text(encoding="utf-8") if cpu.exists() else ""):
        return "this processor has no AVX-512"
    return ""


def compared(folder, kinds, emulator, name):
    """Sequences found, and what is wrong of a build: other digests than noted, fused instructions."""
    found, worse = {}, []
    for kind in kinds:
        lines = lines_of(quietly(emulator + [folder / f"tests/pose_wall_{kind}digest"]))
        noted = lines_of((HERE / f"{kind}digests.txt").read_text(encoding="utf-8"))
        worse += [f"{kind}{line}" for line in differences(noted, lines)]
        found.update({kind + sequence: fields for sequence, fields in lines.items()})
    archives = [folder / LIBRARIES[kind] for kind in kinds]
    fused = subprocess.run([FUSED, objdump_of(name)] + archives, capture_output=True, text=True, check=False)
    if fused.returncode != 0:
        worse += (fused.stdout + fused.stderr).splitlines()
    return found, worse


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
    recordings, failed = None, False
    for name, configure, flags, emulator in BUILDS:
        if name not in wanted:
            continue
        if cannot_run(name):
            print(f"{name:28} skipped: {cannot_run(name)}", flush=True)
            continue
        folder, kinds = options.output / name, list(LIBRARIES) if reads_files(name) else [""]
        build(folder, configure, flags, kinds)
        found, worse = compared(folder, kinds, emulator, name)
        if options.recorded and reads_files(name):
            recorded = lines_of(quietly(emulator + [folder / "tests/pose_wall_digest"] + options.recorded))
            recordings = recordings or recorded  # the first build says what is expected
            worse += differences(recordings, recorded)
            found.update(recorded)
        print(f"{name:28} {len(found):3d} sequences  {'DIFFERS' if worse else 'the same bits'}", flush=True)
        print("".join(f"    {line}\n" for line in worse), end="", flush=True)
        failed = failed or bool(worse)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
