#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""As checks_can_fail.py, for the checks of the process image and of what is packed."""

import json
import os
import shutil
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True  # the sources stay as they are

from checks_can_fail import CHECKS, BrokenProject, tool  # noqa: E402  pylint: disable=wrong-import-position


class Image(BrokenProject):
    def setUp(self):
        super().setUp()
        source = CHECKS.parent.parent
        for folder in ("tools/apps/plc", "tools/io/language/zh"):
            shutil.copytree(source / folder, self.root / folder)
        for path in ("include/pose_wall.h", "include/pose_wall_motion.h", "include/pose_wall_planar_stop.h",
                     "tests/checks/abi_layout.txt", "tools/apps/live/modbus/README.md",
                     "tools/apps/live/modbus/modbus_registers.hpp", "tools/study/planar/stop_reasons.cpp"):
            (self.root / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source / path, self.root / path)

    def check(self):
        return "python3", self.root / "tools/apps/plc/generate.py", "--check", self.root

    def change(self, path, old, new):
        text = (self.root / path).read_text(encoding="utf-8")
        self.assertIn(old, text)
        self.write(path, text.replace(old, new, 1))

    def test_passes(self):
        self.passes(*self.check())

    def test_header_edited_by_hand(self):
        self.change("include/pose_wall.h", "int32_t value_mm;", "uint32_t value_mm;")
        self.fails("include/pose_wall.h is not what", *self.check())

    def test_register_table_edited_by_hand(self):
        for before, after in (("| 1062, 1063 |", "| 1064, 1065 |"), ("| 3 | `stamp_back` |", "| 4 | `stamp_back` |")):
            self.change("tools/apps/live/modbus/README.md", before, after)
            self.fails("tools/apps/live/modbus/README.md is not what", *self.check())

    def test_tables_of_the_stop_edited_by_hand(self):
        for before, after in (("| 8 | 32 | `state` |", "| 9 | 36 | `state` |"), ("16#00000800", "16#00000400"),
                              ("畅通的时间还不够", "")):
            self.change("tools/apps/plc/README.md", before, after)
            self.fails("tools/apps/plc/README.md is not what", *self.check())

    def test_bit_of_the_stop_renumbered(self):
        self.change("include/pose_wall_planar_stop.h", "R_SPEED = 1 << 8,", "R_SPEED = 1 << 9,")
        self.fails("tools/apps/plc/README.md is not what", *self.check())
        self.fails("tools/apps/live/modbus/README.md is not what", *self.check())

    def test_image_moved_to_another_register(self):
        self.change("tools/apps/live/modbus/modbus_registers.hpp", "kImage2Register = 1000", "kImage2Register = 2000")
        self.fails("tools/apps/live/modbus/README.md is not what", *self.check())

    def test_structured_text_edited_by_hand(self):
        for ending in ("st", "scl", "xml"):
            self.change(f"tools/apps/plc/FB_PoseWall.{ending}", "xUsable", "xUseless")
            self.fails(f"FB_PoseWall.{ending} is not what", *self.check())

    def test_frames_of_can_edited_by_hand(self):
        for name in ("pose_wall_11bit.dbc", "pose_wall_j1939.dbc"):
            self.change(f"tools/apps/plc/can/{name}", "16|20@1-", "16|19@1-")
            self.fails(f"tools/apps/plc/can/{name} is not what", *self.check())
        self.change("tools/apps/plc/can/can_images.c", "POSE_WALL_CAN_LEVEL", "POSE_WALL_CAN_BITS")
        self.fails("tools/apps/plc/can/can_images.c is not what", *self.check())

    def test_frames_of_can_that_cannot_be(self):
        for old, new in (("FRAME Pitch 18 3", "FRAME Pitch 16 3"),
                         ("roll.positive_means  bits 3", "roll.positive_means  bits 9"),
                         ("roll.state           bits 2", "roll.status          bits 2")):
            self.change("tools/apps/plc/can/can.def", old, new)
            self.fails("can.def: ", *self.check())
            self.change("tools/apps/plc/can/can.def", new, old)

    def test_state_renumbered(self):
        self.change("include/pose_wall.h", "POSE_WALL_DEGRADED = 2", "POSE_WALL_DEGRADED = 4")
        self.fails("FB_PoseWall.st is not what", *self.check())

    def test_block_edited_by_hand(self):
        self.change("tools/apps/plc/blocks.def", "tWatchdog : TIME := T#300ms", "tWatchdog : TIME := T#900ms")
        self.fails("FB_PoseWall.scl is not what", *self.check())

    def test_number_of_the_header_changed(self):
        self.change("include/pose_wall.h", "NO_BOUND 2147483647", "NO_BOUND 2147483646")
        self.fails("FB_PoseWall.st is not what", *self.check())

    def test_other_description(self):
        """Nothing but image.def knows where a member lies, and how many there are."""
        self.change("tools/apps/plc/image.def", "told_by         uint32",
                    "spare uint32 | - | spare\ntold_by         uint32")
        self.passes("python3", self.root / "tools/apps/plc/generate.py", self.root)
        self.passes("python3", CHECKS / "plc_test.py", self.root)

    def test_other_description_of_the_stop(self):
        self.change("tools/apps/plc/image.def", "settings_crc32  bits",
                    "spare uint32 | - | spare\nsettings_crc32  bits")
        self.passes("python3", self.root / "tools/apps/plc/generate.py", self.root)
        self.passes("python3", CHECKS / "plc_stop_test.py", self.root, "Text", "Functions", "Permission")

    def test_description_differs_from_the_pinned_layout(self):
        self.change("tools/apps/plc/image.def", "value_mm        int32", "value_mm        float")
        self.fails("include/pose_wall.h is not what", *self.check())
        self.change("tests/checks/abi_layout.txt", "  verdict                           32", "  verdict     36")
        self.fails("does not hold what image.def says of pose_wall_image:", *self.check())


class BillOfMaterials(BrokenProject):
    def setUp(self):
        super().setUp()
        self.write("eigen/Eigen/Core", '#include "src/Core/util/Macros.h"\n')
        self.eigen("3.4.0")
        self.write("libpose_wall.a", "archive")
        self.write("libpose_wall_motion.a", "another")
        archives = f"{self.root}/libpose_wall.a;{self.root}/libpose_wall_motion.a"
        self.passes(tool("CMAKE", "cmake"), f"-DOUTPUT={self.root}/bill.json", f"-DLIBRARIES={archives}",
                    "-DVERSION=0.1.0", f"-DEIGEN={self.root}/eigen", "-DCOMPILER=GNU 12.2.0", "-P",
                    CHECKS.parent.parent / "tools/cmake/write_sbom.cmake")

    def eigen(self, version):
        parts = zip(("WORLD", "MAJOR", "MINOR"), version.split("."))
        text = "".join(f"#define EIGEN_{name}_VERSION {number}\n" for name, number in parts)
        self.write("eigen/Eigen/src/Core/util/Macros.h", text)

    def check(self, version="0.1.0"):
        return (CHECKS / "check_sbom.py", self.root / "bill.json", version, tool("CC", "cc"), self.root / "eigen",
                self.root / "libpose_wall.a", self.root / "libpose_wall_motion.a")

    def change(self, old, new):
        text = (self.root / "bill.json").read_text(encoding="utf-8")
        self.assertIn(old, text)
        self.write("bill.json", text.replace(old, new))

    def test_passes(self):
        self.passes(*self.check())

    def test_other_eigen(self):
        self.eigen("3.3.9")
        self.fails("Eigen is 3.3.9, the bill says 3.4.0", *self.check())

    def test_other_version(self):
        self.fails("pose_wall is 0.2.0, the bill says 0.1.0", *self.check("0.2.0"))

    def test_other_archive(self):
        for name in ("pose_wall", "pose_wall_motion"):
            self.setUp()
            self.write(f"lib{name}.a", "one that came later")
            self.fails(f"{name}: the digest is not that of the archive", *self.check())

    def test_an_archive_that_it_does_not_name(self):
        self.write("libpose_wall_more.a", "archive")
        self.fails("no package pose_wall_more", *self.check(), self.root / "libpose_wall_more.a")

    def test_licence(self):
        self.change("MPL-2.0", "MIT")
        self.fails("licences of Eigen", *self.check())

    def test_missing_fields(self):
        for field in ("spdxVersion", "dataLicense", "documentNamespace", "created", "downloadLocation"):
            self.setUp()
            self.change(f'"{field}"', '"other"')
            self.fails(field, *self.check())


@unittest.skipUnless(os.environ.get("CONTROLLER"), "no controller and no command were built")
class Controller(BrokenProject):
    def check(self, *emulator):
        return (CHECKS / "check_controller.py", CHECKS.parent.parent, os.environ["POSE_WALL"], os.environ["CONTROLLER"],
                *emulator)

    def wrapper(self, change):
        """A program that runs the controller given to it and changes what it prints, or its images."""
        self.write("wrapper.py", f"""import pathlib, re, subprocess, sys
done = subprocess.run(sys.argv[1:], stdout=subprocess.PIPE, text=True)
text, words = done.stdout, sys.argv[1:]
if done.returncode == 0:
    images = pathlib.Path(words[words.index("-o") + 1])
    {change}
print(text, end="")
sys.exit(done.returncode)
""")
        return self.check("python3", self.root / "wrapper.py")

    def test_passes(self):
        self.passes(*self.check())
        self.passes(*self.wrapper("pass"))

    def test_a_digit_printed_wrong(self):
        wrong = "lambda found: found[1] + str((int(found[2]) + 1) % 10)"
        self.fails("frame 0: printed", *self.wrapper(f"text = re.sub(r'( pl=[0-9.]*)([0-9])', {wrong}, text, 1)"))

    def test_a_bit_of_an_image_wrong(self):
        self.fails("image 0: its CRC is not zlib's", *self.wrapper(
            "raw = bytearray(images.read_bytes()); raw[20] ^= 1; images.write_bytes(raw)"))

    def test_an_image_too_few(self):
        self.fails("3.0 images", *self.wrapper(
            "raw = images.read_bytes(); images.write_bytes(raw[:len(raw) * 3 // 4])"))

    def test_unknown_options_passed_over(self):
        self.write("deaf.py", """import subprocess, sys
sys.exit(0 if "-c" not in sys.argv else subprocess.run(sys.argv[1:]).returncode)
""")
        self.fails("['-q']: status 0", *self.check("python3", self.root / "deaf.py"))


class Presets(BrokenProject):
    """What test.sh takes can be tested, and of each it knows what to install."""

    SOURCE = CHECKS.parent.parent

    def packages(self, preset):
        return "bash", "-c", f". {self.SOURCE}/tools/shell/packages.sh; packages_of {preset}"

    def test_names(self):
        presets = json.loads((self.SOURCE / "CMakePresets.json").read_text(encoding="utf-8"))
        names = [test["name"] for test in presets["testPresets"]
                 if not test.get("hidden") and test["name"] == test.get("configurePreset")]
        self.fails(f"there are: {' '.join(names)}\n", self.SOURCE / "tools/test.sh", "arm")
        for name in names:
            self.passes(*self.packages(name))
        status, text = self.run_check(*self.packages("arm64-clang"))
        self.assertEqual(status, 0)
        self.assertLessEqual({"cmake", "clang", "g++-aarch64-linux-gnu", "libgtest-dev"}, set(text.split()))
        status, text = self.run_check(*self.packages("armhf"))
        self.assertEqual(status, 0)
        self.assertLessEqual({"g++-arm-linux-gnueabihf", "qemu-user-static", "libgtest-dev"}, set(text.split()))

    def test_refused(self):
        self.fails("there is no preset 'arm'", self.SOURCE / "tools/test.sh", "arm")
        self.fails("'bare' is no option of ctest", self.SOURCE / "tools/test.sh", "arm64", "bare")
        self.fails("", *self.packages("bench"))


@unittest.skipUnless(shutil.which("dpkg-deb"), "dpkg-deb is not installed")
class Packages(BrokenProject):
    """Of a command that is none; the library's packages, which are asked for after it, are missing."""

    def setUp(self):
        super().setUp()
        self.write("CMakeLists.txt", "project(pose_wall VERSION 0.2.0 LANGUAGES C CXX)\n")

    WORDS = ("man/man1/pose_wall.1", "bash-completion/completions/pose_wall", "zsh/site-functions/_pose_wall",
             "fish/vendor_completions.d/pose_wall.fish", "pose_wall/config/vlp16.yaml")

    def pack(self, version, depends, program, words=WORDS):
        control = f"Package: pose-wall\nVersion: {version}\nArchitecture: amd64\nMaintainer: x <x@y>\n{depends}"
        self.write("deb/DEBIAN/control", f"{control}Description: x\n")
        config = "[ \"$1\" != check-config ] || { echo /usr/share/pose_wall/config/vlp16.yaml:1; exit 0; }"
        self.write("deb/usr/bin/pose_wall", f"#!/bin/sh\n{config}\n{program}\n")
        (self.root / "deb/usr/bin/pose_wall").chmod(0o755)
        for word in words:
            self.write(f"deb/usr/share/{word}", "made\n")
        self.passes("dpkg-deb", "--root-owner-group", "-b", self.root / "deb",
                    self.root / f"pose-wall_{version}_amd64.deb")

    def pack_daemon(self, answer="'two words' is no topic of ROS", version="0.2.0"):
        self.write("deb/DEBIAN/control", f"Package: pose-walld\nVersion: {version}\nArchitecture: amd64\n"
                                         "Maintainer: x <x@y>\nDescription: x\n")
        self.write("deb/usr/bin/pose_walld",
                   f"#!/bin/sh\n[ \"$1\" = --version ] && echo {version} || echo \"{answer}\" >&2\n")
        (self.root / "deb/usr/bin/pose_walld").chmod(0o755)
        self.passes("dpkg-deb", "--root-owner-group", "-b", self.root / "deb",
                    self.root / f"pose-walld_{version}_amd64.deb")

    def pack_python(self, version="0.2.0", depends="python3-numpy, libc6", module=None):
        self.write("deb/DEBIAN/control", f"Package: python3-pose-wall\nVersion: {version}\nArchitecture: amd64\n"
                                         f"Maintainer: x <x@y>\nDepends: {depends}\nDescription: x\n")
        self.write("deb/usr/lib/python3/dist-packages/pose_wall.py",
                   module or f"__version__ = '{version}'\ndef self_test(): return 'tested'\n")
        self.passes("dpkg-deb", "--root-owner-group", "-b", self.root / "deb",
                    self.root / f"python3-pose-wall_{version}_amd64.deb")

    def check(self):
        return CHECKS / "check_package.sh", tool("CMAKE", "cmake"), self.root, self.root, "amd64", "cc", "c++", "-"

    def test_of_another_version_only(self):
        self.pack("0.1.0", "Depends: libyaml-0-2\n", "echo 0.1.0")
        self.fails("has no pose-wall_0.2.0_amd64.deb", *self.check())
        self.pack("0.2.0", "Depends: libyaml-0-2\n", "echo pose_wall 0.2.0")
        self.fails("has no pose-walld_0.2.0_amd64.deb", *self.check())
        self.pack_daemon()
        self.fails("has no python3-pose-wall_0.2.0_amd64.deb", *self.check())
        self.pack_python()
        self.fails("has no libpose-wall-dev_0.2.0_amd64.deb", *self.check())

    def test_of_the_daemon(self):
        self.pack("0.2.0", "Depends: libyaml-0-2\n", "echo pose_wall 0.2.0")
        self.pack_daemon("the program of ROS 1 is missing: there is no libexec/pose_wall/pose_walld_ros1")
        self.fails("does not find its program of ROS 1: the program of ROS 1 is missing", *self.check())
        self.pack_daemon("this build has no ROS 1: install libroscpp-dev")
        self.fails("has no python3-pose-wall_0.2.0_amd64.deb", *self.check())

    def test_of_python(self):
        self.pack("0.2.0", "Depends: libyaml-0-2\n", "echo pose_wall 0.2.0")
        self.pack_daemon()
        self.pack_python(depends="python3")
        self.fails("depends on 'python3'; the module needs python3-numpy", *self.check())
        numpy = subprocess.run(["/usr/bin/python3", "-c", "import numpy"], stderr=subprocess.DEVNULL, check=False)
        if numpy.returncode != 0:
            self.pack_python()
            self.fails("not tried", *self.check())
            return
        self.pack_python(module="import nothing_of_this_name\n")
        self.fails("the module does not work", *self.check())
        self.pack_python(module="__version__ = '0.1.0'\ndef self_test(): return 'tested'\n")
        self.fails("not 0.2.0", *self.check())

    def test_depends_on_nothing(self):
        self.pack("0.2.0", "", "echo 0.2.0")
        self.fails("the command needs libyaml", *self.check())
        self.pack("0.2.0", "Depends: libc6\n", "echo 0.2.0")
        self.fails("depends on 'libc6'; the command needs libyaml", *self.check())

    def test_does_not_run(self):
        self.pack("0.2.0", "Depends: libyaml-0-2\n", "exit 1")
        self.fails("the command does not run", *self.check())
        self.pack("0.2.0", "Depends: libyaml-0-2\n", "echo 0.1.0")
        self.fails("the command says it is '0.1.0', not 0.2.0", *self.check())

    def test_without_words_for_shells(self):
        self.pack("0.2.0", "Depends: libyaml-0-2\n", "echo 0.2.0", words=self.WORDS[:2])
        self.fails("has no share/zsh/site-functions/_pose_wall", *self.check())
        self.pack("0.2.0", "Depends: libyaml-0-2\n", "echo 0.2.0", words=self.WORDS[:4])
        self.fails("has no share/pose_wall/config/vlp16.yaml", *self.check())


class Consumer(BrokenProject):
    def test_package_that_was_moved_without_its_paths(self):
        self.write("moved/lib/pkgconfig/pose_wall.pc",
                   "Name: pose_wall\nDescription: x\nVersion: 0.1.0\nCflags: -I/opt/pose_wall/include\n")
        self.fails("pkg-config points elsewhere", CHECKS / "consume.sh", tool("CMAKE", "cmake"), CHECKS.parent.parent,
                   self.root / "moved", tool("CC", "cc"), "c++", "-")


if __name__ == "__main__":
    unittest.main()
