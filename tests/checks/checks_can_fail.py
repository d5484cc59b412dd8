#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Runs every check of this folder on a small broken project and asks that it fails and names the fault, and on the
same project unbroken and asks that it passes."""

import contextlib
import os
import pathlib
import platform
import shutil
import subprocess
import tempfile
import unittest
import zlib

CHECKS = pathlib.Path(__file__).parent
LICENCE = "// SPDX-License-Identifier: BSD-3-Clause\n// Copyright (c) 2026 the pose_wall authors\n"
HEADER = LICENCE + "#include <stdint.h>\nuint32_t pose_wall_abi_version(void);\n"
SOURCE = LICENCE + '#include "pose_wall.h"\nuint32_t pose_wall_abi_version(void) { return 1; }\n'
EXAMPLE = LICENCE + '#include "pose_wall.h"\nint main(void) { return pose_wall_abi_version() == 1 ? 0 : 1; }\n'


def tool(name, fallback):
    return os.environ.get(name) or shutil.which(fallback)


def sizes_table(columns, **rows):
    """A table of the page of sizes, with a row for each machine."""
    head = f"| machine | {columns} |\n" + "| --- " * (columns.count("|") + 2) + "|\n"
    return head + "".join(f"| {machine} | {cells} |\n" for machine, cells in rows.items())


class BrokenProject(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.write("include/pose_wall.h", HEADER)
        self.write("src/engine/c_api.cpp", SOURCE)
        for folder_name in ("tools/io/csv", "tests", "bench"):
            self.write(f"{folder_name}/empty.cpp", LICENCE)

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text, encoding="utf-8")

    def run_check(self, *command):
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def passes(self, *command):
        status, text = self.run_check(*command)
        self.assertEqual(status, 0, text)

    def fails(self, fault, *command):
        status, text = self.run_check(*command)
        self.assertNotEqual(status, 0, text)
        self.assertIn(fault, text)

    @contextlib.contextmanager
    def row(self, name):
        """A row of a table, in a project of its own. It is named where it fails, and the others go on."""
        with self.subTest(name):
            self.setUp()
            yield

    def archive(self, source, *flags):
        self.write("part.c", source)
        part, archive = self.root / "part.o", self.root / "lib.a"
        archive.unlink(missing_ok=True)
        compiler = [tool("CC", "cc"), "-c", "-O1", *flags, f"-I{self.root}/include", self.root / "part.c", "-o", part]
        self.passes(*compiler)
        self.passes("ar", "rcs", archive, part)
        return archive


class Layers(BrokenProject):
    ROWS = (
        # what is wrong, file, what it includes, what is said
        ("a room includes a later one", "src/engine/floor/floor.cpp", '"engine/walls/walls.hpp"',
         'engine/floor includes "engine/walls/walls.hpp" of engine/walls'),
        ("a room includes a later one by neighbouring path", "src/engine/floor/floor.cpp", '"../walls/walls.hpp"',
         'engine/floor includes "../walls/walls.hpp" of engine/walls'),
        ("a wall goes back", "src/engine/walls/propose/search.cpp", '"engine/walls/fit/surface.hpp"',
         'engine/walls/propose includes "engine/walls/fit/surface.hpp" of engine/walls/fit'),
        ("base includes a room", "src/base/estimation/irls.cpp", '"engine/floor/floor.hpp"',
         "base/estimation includes"),
        ("a room includes the engine", "src/engine/floor/floor.cpp", '"engine/engine.hpp"', "engine/floor includes"),
        ("iostream", "src/base/math/angles.hpp", "<iostream>", "<iostream> is not on the engine's list"),
        ("an unknown folder", "src/helpers/things.hpp", "<cmath>", "belongs to no room"),
        ("a tool includes the engine", "tools/apps/main.cpp", '"base/math/angles.hpp"',
         "tools see the engine only through"),
        ("a tool includes the engine by path", "tools/apps/main.cpp", '"../src/engine/engine.hpp"',
         "tools see the engine only through"),
        ("runtime includes the engine", "src/runtime/worker.cpp", '"engine/engine.hpp"',
         "it sees the engine only through pose_wall.h"),
        ("the engine includes runtime", "src/engine/engine.cpp", '"runtime/worker.hpp"',
         'engine/engine includes "runtime/worker.hpp"'),
        ("runtime takes the heap", "src/runtime/worker.hpp", "<vector>", "<vector> is not on the runtime's list"),
        ("motion includes a room", "src/motion/travel.cpp", '"engine/walls/walls.hpp"', "motion/travel includes"),
        ("motion includes the engine", "src/motion/travel.cpp", '"engine/engine.hpp"', "motion/travel includes"),
        ("motion goes back", "src/motion/travel.cpp", '"motion/odometry.hpp"',
         'motion/travel includes "motion/odometry.hpp" of motion/odometry'),
        ("a part of planar includes another", "src/planar/stop/stop.cpp", '"planar/match/matcher.hpp"',
         'planar/stop includes "planar/match/matcher.hpp" of planar/match'),
        ("the trunk includes a library", "src/lidar/box.hpp", '"engine/config.hpp"',
         'lidar includes "engine/config.hpp" of engine/config'),
        ("the engine includes motion", "src/engine/engine.cpp", '"motion/travel.hpp"',
         'engine/engine includes "motion/travel.hpp"'),
        ("the engine includes motion's header", "src/engine/engine.cpp", '"pose_wall_motion.h"',
         "src/engine/engine.cpp"),
    )

    def check(self):
        return CHECKS / "check_layers.py", self.root

    def include(self, path, line):
        self.write(path, LICENCE + line + "\n")

    def test_passes(self):
        self.include("src/engine/walls/walls.cpp", '#include "engine/types.hpp"\n'
                     '#include "engine/walls/propose/candidates.hpp"')
        self.include("src/engine/walls/propose/candidates.hpp", "#include <Eigen/Core>")
        self.include("src/engine/types.hpp", "#include <cstdint>")
        self.include("src/runtime/worker.hpp", '#include <pthread.h>\n#include "pose_wall.h"')
        self.include("src/runtime/worker.cpp", '#include "worker.hpp"')
        self.include("src/lidar/cloud_reader.hpp", "")
        self.include("src/part/struct_versions.hpp", "")
        self.include("src/motion/travel.cpp", '#include "motion/travel.hpp"\n#include "lidar/cloud_reader.hpp"\n'
                     '#include "part/struct_versions.hpp"\n#include "pose_wall_motion.h"')
        self.include("src/motion/travel.hpp", "#include <Eigen/Core>")
        self.include("src/planar/match/matcher.hpp", "")
        self.include("src/planar/slam/slam.cpp", '#include "planar/match/matcher.hpp"')
        self.passes(*self.check())

    def test_what_may_not_be_included(self):
        for name, path, included, said in self.ROWS:
            with self.row(name):
                if included.startswith('"') and not included.startswith('"pose_wall'):
                    target = included.strip('"').replace("../walls", "engine/walls").replace("../src/", "")
                    self.include(f"src/{target}", "")
                self.include(path, f"#include {included}")
                self.fails(said, *self.check())

    def test_folders_of_tools_stand_in_a_circle(self):
        for here, there in (("io/bags", "io/csv"), ("io/csv", "io/frames"), ("io/frames", "io/bags")):
            self.include(f"tools/{here}/all.hpp", f'#include "{there}/all.hpp"')
        self.include("tools/apps/verbs/scan.cpp", '#include "io/bags/all.hpp"')
        self.fails('tools/io/csv includes "io/frames/all.hpp" of io/frames, and these stand in a circle', *self.check())

    def test_tools_include_what_stands_on_them(self):
        for here, there in (("io", "study"), ("study", "lab"), ("lab", "apps")):
            self.include(f"tools/{there}/above/all.hpp", "")
            self.include(f"tools/{here}/below/all.hpp", f'#include "{there}/above/all.hpp"')
            self.fails(f'tools/{here} includes "{there}/above/all.hpp"; it may include', *self.check())

    def test_tools_outside_of_their_parts(self):
        self.include("tools/helpers/all.hpp", "")
        self.fails("tools/helpers/all.hpp: belongs to no part of tools/", *self.check())

    def test_daemon_includes_a_verb(self):
        self.include("tools/apps/verbs/one_of.hpp", "")
        self.include("tools/apps/live/main.cpp", '#include "apps/verbs/one_of.hpp"')
        self.fails('the daemon includes "apps/verbs/one_of.hpp"', *self.check())

    def test_public_header_includes_more(self):
        self.write("include/pose_wall.h", HEADER + "#include <stdio.h>\n")
        self.fails("includes stdio.h", *self.check())

    def test_nothing_to_check(self):
        (self.root / "src/engine/c_api.cpp").unlink()
        self.fails("nothing was checked", *self.check())


class Keys(BrokenProject):
    TABLE = "".join(f"  key_{n}\n    default 0; allowed: a number\n    meaning of\n    key {n}\n" for n in range(60))

    def check(self, page_of, file_of):
        command = self.root / "pose_wall"
        self.write("pose_wall", f"#!/bin/sh\ncat <<'END'\n{self.TABLE}END\n")
        command.chmod(0o755)
        self.write("config/README.md", "".join(f"| `key_{n}` | 0 | any | {page_of(n)} |\n" for n in range(60)))
        self.write("config/pose_wall.yaml", "".join(f"# {file_of(n)} [m]\nkey_{n}: 0\n" for n in range(60)))
        return CHECKS / "check_keys.py", self.root, command

    def test_passes(self):
        self.passes(*self.check("meaning of key {}".format, "meaning of key {}".format))

    def test_another_meaning(self):
        def other(n):
            return "what it was before" if n == 7 else f"meaning of key {n}"

        self.fails("README.md: key_7", *self.check(other, "meaning of key {}".format))
        self.fails("pose_wall.yaml: key_7", *self.check("meaning of key {}".format, other))


class Stack(BrokenProject):
    def check(self):
        return CHECKS / "check_stack.py", self.root / "build", 1000

    def graph(self, file, sizes, calls):
        nodes = [f'node: {{ title: "{name}" label: "void {name}()\\na.cpp:1:1\\n{size}" }}' for name, size in sizes]
        edges = [f'edge: {{ sourcename: "{a}" targetname: "{b}" label: "a.cpp:2:2" }}' for a, b in calls]
        self.write(f"build/{file}.ci", "\n".join(['graph: { title: "a.cpp"', *nodes, *edges, "}"]) + "\n")

    def test_passes(self):
        self.graph("a", [("pose_wall_open", "100 bytes (static)")], [("pose_wall_open", "inner"), ("inner", "memcpy")])
        self.graph("b", [("inner", "400 bytes (static)")], [])
        self.passes(*self.check())

    def test_the_deepest_chain_counts(self):
        self.graph("a", [("pose_wall_open", "100 bytes (static)")], [("pose_wall_open", "inner")])
        self.graph("b", [("inner", "901 bytes (static)")], [])
        self.fails("1001 bytes of stack are more than 1000", *self.check())

    def test_page_of_sizes(self):
        self.graph("a", [("pose_wall_open", "512 bytes (static)")], [])
        page = self.root / "SIZES.md"
        noted = (*self.check(), "--sizes", page)
        self.write("SIZES.md", sizes_table("stack, KiB", aarch64="0.5"))
        self.passes(*noted, "aarch64")
        self.fails("has no 'stack, KiB' of armv7; it is 0.5", *noted, "armv7")
        self.write("SIZES.md", sizes_table("stack, KiB", aarch64="0.8"))
        self.fails("says stack, KiB 0.8 of aarch64; it is 0.5", *noted, "aarch64")
        self.passes(*noted, "aarch64", "--note")
        self.passes(*noted, "aarch64")
        self.write("SIZES.md", "")
        self.fails("has no 'stack, KiB' of aarch64", *noted, "aarch64")
        self.fails("has no column 'stack, KiB'", *noted, "aarch64", "--note")

    def test_recursion(self):
        sizes = [("pose_wall_open", "1 bytes (static)"), ("b", "1 bytes (static)")]
        self.graph("a", sizes, [("pose_wall_open", "b"), ("b", "b")])
        self.fails("recursion: b -> b", *self.check())

    def test_a_frame_of_unknown_size(self):
        self.graph("a", [("pose_wall_open", "100 bytes (dynamic)")], [])
        self.fails("its frame is dynamic", *self.check())

    def test_of_one_library(self):
        roots = [("pose_wall_open", "2000 bytes (static)"), ("pose_wall_motion_open", "9 bytes (static)")]
        self.graph("a", roots, [("pose_wall_motion_open", "inner")])
        self.graph("b", [("inner", "400 bytes (static)")], [])
        self.passes(*self.check(), "--of", "pose_wall_motion_")
        self.fails("2000 bytes of stack", *self.check())
        self.fails("nothing was checked", *self.check(), "--of", "pose_wall_runtime_")

    def test_nothing_to_check(self):
        self.graph("a", [("other", "1 bytes (static)")], [])
        self.fails("nothing was checked", *self.check())


class Constants(BrokenProject):
    def check(self, *lines, folders=()):
        if lines:
            self.write("src/engine/walls/walls.cpp", LICENCE + "\n" + "\n".join(lines) + "\n")
        return CHECKS / "check_constants.py", self.root, *(folders or ["engine/walls"])

    def test_passes(self):
        self.passes(*self.check(
            "// A wall that ends sooner is none.", "constexpr double kEnd_m = 2.0;",
            "// Layout of a key, from the lowest bit:", "constexpr unsigned kZ = 3;", "constexpr unsigned kY = 2 * kZ;",
            "constexpr double square(double x) { return x * x; }  // not looked at", "constexpr Pair kPair{1, 2};",
            "struct Grid {", "  static constexpr std::uint32_t kSide = 8,  // a row is a byte",
            "                                 kCells =",
            "                                     kSide * kSide;  // cells of the square", "};", "double at(int k) {",
            "  constexpr double kTable[] = {1.0, 2.0};  // by signs of x", "  return kTable[k];", "}"))

    def test_says_how_many(self):
        status, text = self.run_check(*self.check("constexpr int kA = 1, kB = 2;  // one for each side"))
        self.assertEqual((status, text), (0, "2 constants and gates, 0 without a reason\n"))

    def test_without_a_reason(self):
        layout, end = "// Layout of a key, from the lowest bit:", "constexpr double kEnd_m = 2.0;"
        for name, said, *lines in (
                ("no comment", "src/engine/walls/walls.cpp:4 kEnd_m", end),
                ("two words", "kEnd_m", end + "  // two metres"),
                ("in a function", "walls.cpp:5 kMost",
                 "int f() {", "  constexpr int kMost = 3;", "  return kMost;", "}"),
                ("a member on the next line", "walls.cpp:6 kCells", "struct Grid {",
                 "  static constexpr std::uint32_t kSide = 8,  // a row is a byte",
                 "                                 kCells = kSide * kSide;", "};"),
                ("a comment above holds for one", "walls.cpp:6 kOther", "// A wall that ends sooner is none.", end,
                 "constexpr double kOther = 3.0;"),
                ("a row ends with a blank line", "walls.cpp:7 kY", layout, "constexpr int kZ = 3;", "",
                 "constexpr int kY = 6;"),
                ("a row ends with what is no constant", "walls.cpp:7 kY", layout, "constexpr int kZ = 3;", "int f();",
                 "constexpr int kY = 6;"),
                ("a comment goes on for the line before", "walls.cpp:6 kOther", end + "  // a wall that ends sooner",
                 "                                // is none", "constexpr double kOther = 3.0;"),
                ("a note to a tool", "kEnd_m", end + "  // NO" "LINT(some-rule-of-a-tool)")):
            with self.row(name):
                self.fails(said, *self.check(*lines))

    def test_judgement_is_no_reason(self):
        for reason in ("judgement, 2026-11-21", "Judgement, 2026-11-21: of mine"):
            self.fails("kEnd_m", *self.check(f"constexpr double kEnd_m = 2.0;  // {reason}"))
        self.passes(*self.check("constexpr double kEnd_m = 2.0;  // judgement, 2026-11-21: a wall is longer"))

    def test_origin_of_a_gate(self):
        for table, row in (("engine/gates", 'GATE(POINTS, "points", AT_LEAST, 1.0, "", "", TELLS, 0, "{}", "voxels")'),
                           ("motion", 'GATE(ROWS, "rows", AT_LEAST, 100, "rows", "{}", "rows of a curve, of 1024")')):
            for status, origin in ((1, "judgement, 2026-11-21"), (1, ""), (0, "key"), (0, "definition: of (this)")):
                with self.row(f"{table}: {origin}"):
                    self.write(f"src/{table}/gates.def", row.format(origin) + "\n")
                    self.check("constexpr double kEnd_m = 2.0;  // a wall is longer")
                    self.assertEqual(self.run_check(CHECKS / "check_constants.py", self.root)[0], status)

    def test_two_words_beside_a_reason_above(self):
        self.passes(*self.check("// A wall that ends sooner is none.", "constexpr double kEnd_m = 2.0;  // two metres"))

    def test_no_sources(self):
        self.fails("engine/floor holds no sources", *self.check("int f();", folders=["engine/floor"]))

    def test_no_constants(self):
        self.fails("nothing was checked", *self.check("int f();"))


class House(BrokenProject):
    def check(self):
        return CHECKS / "check_house.py", self.root

    def test_passes(self):
        self.passes(*self.check())

    def test_faults_of_lines(self):
        for name, text, said in (("no licence", "int x;\n", "1: does not begin"),
                                 ("a long line", LICENCE + "// " + "x" * 118 + "\n", "3: 121 characters"),
                                 ("unfinished", LICENCE + "// TO" + "DO\n", "3: unfinished"),
                                 ("a machine's path", LICENCE + "// /ho" + "me/somebody\n",
                                  "3: a path of one machine")):
            with self.row(name):
                self.write("src/engine/engine.cpp", text)
                self.fails("src/engine/engine.cpp:" + said, *self.check())

    def test_heaps(self):
        for path in self.root.rglob("*.*"):
            if path.is_file():
                path.write_text(LICENCE + "//\n" * 160, encoding="utf-8")
        self.fails("the median file has 162 lines", *self.check())


class Format(BrokenProject):
    def setUp(self):
        super().setUp()
        if not shutil.which("clang-format") and not shutil.which("clang-format-14"):
            self.skipTest("clang-format is not installed")
        self.write("src/engine/c_api.cpp", LICENCE)
        shutil.copy(CHECKS.parent.parent / ".clang-format", self.root)

    def test_passes(self):
        self.passes(CHECKS / "check_format.sh", self.root)

    def test_other_style(self):
        self.write("src/engine/engine.cpp", LICENCE + "int  x ;\n")
        self.fails("src/engine/engine.cpp:3", CHECKS / "check_format.sh", self.root)


class Archive(BrokenProject):
    def symbols(self, source):
        header, allowed = self.root / "include/pose_wall.h", CHECKS / "symbols_allowed.txt"
        return CHECKS / "check_symbols.sh", tool("NM", "nm"), self.archive(source), header, allowed

    def link(self, source, example):
        self.write("example.c", example)
        archive = self.archive(source)
        return (CHECKS / "check_c_link.sh", tool("CC", "cc"), tool("READELF", "readelf"), self.root / "include",
                archive, self.root / "example.c")

    def test_passes(self):
        self.passes(*self.symbols(SOURCE))
        self.passes(*self.link(SOURCE, EXAMPLE))

    def test_heap(self):
        heap = "#include <stdlib.h>\nstatic void* volatile kept;\n" + SOURCE
        heap = heap.replace("return 1;", "kept = malloc(4); return kept == NULL;")
        self.fails("imported but not on the list of allowed symbols: malloc", *self.symbols(heap))

    def test_foreign_global(self):
        helper = SOURCE + "int helper(void) { return 1; }\n"
        self.fails("defined but not named pose_wall_*: helper", *self.symbols(helper))

    def test_not_defined(self):
        self.write("include/pose_wall.h", HEADER + "void pose_wall_forgotten(void);\n")
        self.fails("declared in pose_wall.h but not defined: pose_wall_forgotten", *self.symbols(SOURCE))

    def test_not_declared(self):
        extra = SOURCE + "void pose_wall_secret(void);\nvoid pose_wall_secret(void) {}\n"
        self.fails("defined but not declared in pose_wall.h: pose_wall_secret", *self.symbols(extra))

    def test_motion_takes_what_it_may_not(self):
        self.write("include/pose_wall_motion.h", HEADER.replace("abi_version", "motion_abi_version"))
        motion = SOURCE.replace("pose_wall.h", "pose_wall_motion.h").replace("abi_version", "motion_abi_version")
        command = list(self.symbols(motion))
        command[-2:] = self.root / "include/pose_wall_motion.h", CHECKS / "symbols_allowed_motion.txt"
        self.passes(*command)
        asks = "extern unsigned pose_wall_save(void);\n" + motion.replace("return 1;", "return pose_wall_save();")
        command[2] = self.archive(asks)
        self.fails("imported but not on the list of allowed symbols: pose_wall_save", *command)

    def test_needs_more_than_c(self):
        runtime = SOURCE.replace("return 1;", "return (uint32_t)_ZSt9terminatev();")
        runtime = "extern int _ZSt9terminatev(void);\n" + runtime
        self.fails("undefined reference", *self.link(runtime, EXAMPLE))

    def test_example_fails(self):
        self.fails("the example failed", *self.link(SOURCE, EXAMPLE.replace("? 0 : 1", "? 1 : 0")))

    def test_example_is_not_c99(self):
        self.fails("error", *self.link(SOURCE, EXAMPLE.replace("int main", "inline static auto_t main")))


class ArchiveSections(BrokenProject):
    WITHOUT_TABLES = ("-fno-asynchronous-unwind-tables", "-O1")

    def sections(self, source, *more):
        archive = self.archive(source, *self.WITHOUT_TABLES)
        return CHECKS / "check_archive.py", tool("READELF", "readelf"), archive, *more

    def test_passes(self):
        self.passes(*self.sections(SOURCE))

    def test_state(self):
        state = SOURCE.replace("return 1;", "static uint32_t calls; return ++calls;")
        self.fails("section .bss: 4 bytes that can be written to", *self.sections(state))
        state = SOURCE.replace("return 1;", "static uint32_t calls = 7; return ++calls;")
        self.fails("section .data: 4 bytes that can be written to", *self.sections(state))

    def test_state_in_a_section_of_its_own(self):
        state = SOURCE.replace("return 1;", "return ++calls;")
        for name in ("my_state", ".my.state"):
            own = f'static unsigned calls __attribute__((section("{name}"))) = 7;\n'
            self.fails(f"section {name}: 4 bytes that can be written to", *self.sections(own + state))

    def test_weak(self):
        weak = SOURCE + "__attribute__((weak)) int pose_wall_inner(void) { return 1; }\n"
        self.fails("pose_wall_inner is weak: a linker would merge it", *self.sections(weak))

    def test_common(self):
        common = SOURCE + "__attribute__((common)) int pose_wall_shared;\n"
        self.fails("pose_wall_shared is common: a linker would merge it", *self.sections(common))

    def test_before_main(self):
        early = SOURCE + "__attribute__((constructor)) static void early(void) { __asm__ volatile(\"nop\"); }\n"
        self.fails("section .init_array", *self.sections(early))

    def test_unwind_tables(self):
        self.fails("section .eh_frame", CHECKS / "check_archive.py", tool("READELF", "readelf"),
                   self.archive(SOURCE, "-fasynchronous-unwind-tables"))

    def test_too_large(self):
        self.fails("bytes of text are more than 3", *self.sections(SOURCE, "--text-max", "3"))

    def test_nothing_to_check(self):
        self.write("readelf", "#!/bin/sh\necho '  [ 0]      NULL      0000 0000 00 00      0   0  0'\n")
        (self.root / "readelf").chmod(0o755)
        self.fails("nothing was checked", CHECKS / "check_archive.py", self.root / "readelf", "-")

    def test_page_of_sizes(self):
        page, columns = self.root / "SIZES.md", "text, KiB | data, KiB | relocated, KiB | functions"
        noted = (*self.sections(SOURCE, "--sizes", page),)
        self.write("SIZES.md", sizes_table(columns, here="0.0 | 0.0 | 0.0 | 1"))
        self.passes(*noted, "here")
        self.write("SIZES.md", sizes_table(columns, here="7.0 | 0.0 | 0.0 | 2"))
        self.fails("says text, KiB 7.0 of here; it is 0", *noted, "here")
        self.fails("says functions 2 of here; it is 1", *noted, "here")
        self.fails("has no 'functions' of there", *noted, "there")

    def test_page_of_sizes_of_another_library(self):
        page = self.root / "SIZES.md"
        noted = (*self.sections(SOURCE, "--of", "motion", "--sizes", page),)
        self.write("SIZES.md", sizes_table("motion text, KiB | motion functions", here="0.0 | 1"))
        self.passes(*noted, "here")
        self.write("SIZES.md", sizes_table("motion text, KiB | motion functions", here="0.0 | 2"))
        self.fails("says motion functions 2 of here; it is 1", *noted, "here")

    def test_noting_one_machine_keeps_the_others(self):
        page, columns = self.root / "SIZES.md", "text, KiB | data, KiB | relocated, KiB | functions | stack, KiB"
        noted = (*self.sections(SOURCE, "--sizes", page),)
        others = sizes_table(columns, armv7="9.0 | 0.0 | 0.0 | 3 | 8.0", x86_64="8.0 | 0.0 | 0.0 | 3 | -")
        self.write("SIZES.md", "# Sizes\n\n" + others + "\nThe end.\n")
        self.passes(*noted, "aarch64", "--note")
        self.passes(*noted, "aarch64")
        rows = sizes_table(columns, aarch64="0.0 | 0.0 | 0.0 | 1 | -", armv7="9.0 | 0.0 | 0.0 | 3 | 8.0",
                           x86_64="8.0 | 0.0 | 0.0 | 3 | -")
        self.assertEqual(page.read_text(encoding="utf-8"), "# Sizes\n\n" + rows + "\nThe end.\n")


class Sizes(BrokenProject):
    COLUMNS = "engine, MiB | image, bytes"

    def check(self, printed, *more):
        self.write("program", f"#!/bin/sh\nprintf '{printed}'\n")
        (self.root / "program").chmod(0o755)
        self.write("SIZES.md", sizes_table(self.COLUMNS, here="4.50 | 248"))
        return CHECKS / "check_sizes.py", "--sizes", self.root / "SIZES.md", "here", *more, "--", self.root / "program"

    def test_passes(self):
        self.passes(*self.check("engine, MiB: 4.55\\nimage, bytes: 248\\n"))

    def test_another_size(self):
        self.fails("says image, bytes 248 of here; it is 249", *self.check("image, bytes: 249\\n"))
        self.fails("says engine, MiB 4.50 of here; it is 4.7", *self.check("engine, MiB: 4.70\\n"))
        self.fails("has no 'box, bytes' of here", *self.check("box, bytes: 1\\n"))

    def test_noted(self):
        self.passes(*self.check("image, bytes: 249\\n", "--note"))
        self.assertIn("| here | 4.50 | 249 |", (self.root / "SIZES.md").read_text(encoding="utf-8"))

    def test_nothing_to_check(self):
        self.fails("nothing was checked", *self.check(""))


class Pages(BrokenProject):
    EXAMPLE = "```c\nmust(pose_wall_abi_version() == 2 ? 0 : -1);\n```\n"

    def setUp(self):
        super().setUp()
        for header in (CHECKS.parents[1] / "include").glob("pose_wall*.[hd]*"):  # and the tables of settings
            self.write(f"include/{header.name}", header.read_text(encoding="utf-8"))
        checks = "pose_wall_check(house COMMAND x)\npose_wall_check(header_${h} COMMAND x)\n"
        self.write("tests/checks/CMakeLists.txt", checks)
        self.write("CONTRIBUTING.md", "| you change | guards |\n| --- | --- |\n| `x` | `house`, `header_*` |\n")
        self.write("include/README.md", "# Link\n\n## Build it!\n")

    def check(self, readme):
        self.write("README.md", readme)
        return CHECKS / "check_pages.py", self.root, tool("CC", "cc")

    def test_passes(self):
        links = "[a](include/README.md#build-it) [b](https://b) `[c](d)` <!-- [e](f) -->\n"
        self.passes(*self.check(self.EXAMPLE + links))

    def test_links(self):
        self.fails("README.md: none.png leads nowhere", *self.check(self.EXAMPLE + "![a](none.png)"))
        self.fails("README.md has no heading of #linking", *self.check(self.EXAMPLE + "[a](include/README.md#linking)"))

    def test_examples(self):
        self.fails("pose_wall_abi_versio", *self.check("```c\nmust((int32_t)pose_wall_abi_versio());\n```\n"))
        self.fails("nothing was checked", *self.check("```\nmake\n```\n"))

    def test_table_of_checks(self):
        self.write("tests/checks/more/CMakeLists.txt", "pose_wall_check(stack COMMAND x)\n")
        self.fails("does not name the check stack", *self.check(self.EXAMPLE))
        self.write("tests/checks/CMakeLists.txt", "pose_wall_check(stack COMMAND x)\n")
        self.fails("names house, which is no check", *self.check(self.EXAMPLE))


class Prose(BrokenProject):
    SENTENCE = "The wall {} stands on the left side of the road here.\n\n"  # 11 words

    def check(self, page, name="README.md"):
        self.write(name, page)
        return CHECKS / "check_prose.py", self.root

    def test_passes(self):
        self.passes(*self.check(self.SENTENCE * 12 + "```\n" + "no sentence " * 60 + "\n```\n"))

    def test_a_long_sentence(self):
        self.fails("README.md:1: a sentence of 41", *self.check("word " * 40 + "ends.\n"))
        self.fails("README.md:3: a sentence of 82", *self.check(self.SENTENCE + "墙" * 82 + "。\n"))
        self.fails("include/pose_wall.h:1: a sentence of 50",
                   *self.check("/* " + "word " * 50 + ". */\n", "include/pose_wall.h"))

    def test_long_sentences(self):
        self.fails("README.md: sentences of 22.0 in the mean", *self.check(("word " * 22 + ".\n\n") * 12))

    def test_a_long_front_door(self):
        self.fails("README.md: 122 lines", *self.check(self.SENTENCE * 61))
        self.passes(*self.check(self.SENTENCE, "README.md"))
        self.passes(*self.check(self.SENTENCE * 61, "src/README.md"))

    def test_nothing_to_check(self):
        (self.root / "include/pose_wall.h").unlink()
        self.fails("nothing was checked", CHECKS / "check_prose.py", self.root)


class Terms(BrokenProject):
    """A list of words, beside a catalogue."""

    def check(self, text):
        self.write("tools/io/language/zh/terms.txt", "# words\nfloor | 底板 | 地面\nbeam | 激光束 | 光束~激光束\n")
        self.write("tools/io/language/zh/run.po", f'msgid "a"\nmsgstr "{text}"\n')
        return CHECKS / "check_terms.py", self.root

    def test_passes(self):
        self.passes(*self.check("底板上的激光束"))

    def test_other_words(self):
        self.fails("'地面' instead of '底板'", *self.check("地面"))
        self.fails("'光束' instead of '激光束'", *self.check("一条光束"))

    def test_nothing_to_check(self):
        self.fails("nothing was checked", *self.check("none"))


class Translations(BrokenProject):
    """Texts that a tool marks, beside a catalogue of Chinese."""

    def check(self, source, catalogue):
        self.write("tools/run.cpp", LICENCE + source)
        self.write("tools/io/language/zh/run.po", catalogue)
        return CHECKS / "check_translations.py", self.root

    WALL = 'msgid "the wall {name}"\nmsgstr "{name}侧墙"\n\n'

    def test_what_the_daemon_says(self):
        said = 'health.summary = is_on ? "plays" : fmt::format("waits for {}; it rests now", name);\n'
        self.write("tools/apps/live/part.cpp", LICENCE + said)
        self.write("tools/io/language/zh/live_health.po",
                   'msgid "waits for {}"\nmsgstr "等待 {}"\n\nmsgid "it rests now"\nmsgstr "已稳定"\n')
        broken = self.check('say("the wall {name}");\n', self.WALL)
        self.passes(*broken)
        self.write("tools/apps/live/part.cpp", LICENCE + said.replace("it rests", "it moves"))
        self.fails("in no catalogue: 'it moves now'", *broken)
        self.fails("said nowhere in tools/apps/live: it rests now", *broken)

    def test_passes(self):
        self.passes(*self.check('say("the wall {name}");\n', self.WALL))

    def test_missing(self):
        self.fails("the floor", *self.check('say("the wall {name}"); tr("the floor");\n', self.WALL))

    def test_not_marked(self):
        self.fails("the floor", *self.check('say("the wall {name}");\n',
                                            self.WALL + 'msgid "the floor"\nmsgstr "底板"\n'))

    def test_twice(self):
        self.fails("twice", *self.check('say("the wall {name}");\n', self.WALL + self.WALL))

    def test_other_arguments(self):
        self.fails("the wall", *self.check('say("the wall {name}");\n', self.WALL.replace("{name}侧", "侧")))

    def test_texts_of_the_engine(self):
        self.write("src/engine/names.def",
                   'STATUS(POSE_WALL_E_VALUE_TYPE, -2, "no value")\nSTATUS(POSE_WALL_E_NULL, -1, "no pointer")\n')
        self.write("src/engine/config.cpp", 'Rule rule = {true, {"a_min", "a_max", "a_min too great"}};\n')
        broken = self.check('say("the wall {name}");\n', self.WALL)
        self.fails("no value", *broken)
        self.fails("a_min too great", *broken)
        self.passes(*self.check('say("the wall {name}");\n', self.WALL + 'msgid "no value"\nmsgstr "没有值"\n\n'
                                'msgid "a_min too great"\nmsgstr "a_min 过大"\n'))

    def test_settings_that_a_verb_takes(self):
        self.write("include/x.def", 'POSE_WALL_SETTING(double, far_m, 1, 0, 2, "m",   "how far")\n')
        takes = '#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(x, __VA_ARGS__)\n#include "x.def"\ntr("far");\n'
        far = 'msgid "far"\nmsgstr "远"\n\n'
        self.fails("how far", *self.check(takes, far))
        self.passes(*self.check(takes, far + 'msgid "how far"\nmsgstr "多远"\n'))
        self.passes(*self.check(takes.replace("_ROW", "_RANGE"), far))

    def test_another_type(self):
        wall = 'msgid "{:.2f} m to the wall"\nmsgstr "距墙 {:d} m"\n'
        self.fails("fills in", *self.check('say("{:.2f} m to the wall");\n', wall))
        self.passes(*self.check('say("{:.2f} m to the wall");\n', wall.replace(":d", ":.1f")))

    def test_no_chinese(self):
        self.fails("the wall", *self.check('say("the wall {name}");\n', 'msgid "the wall {name}"\nmsgstr "{name}"\n'))


class Digests(BrokenProject):
    NOTED = "road 3 100 00aa 00bb 21/21\n"

    def check(self, noted, printed):
        self.write("noted.txt", "# a word\n" + noted)
        self.write("printed.txt", printed)
        return CHECKS.parent / "digest/check_digests.py", self.root / "noted.txt", "cat", self.root / "printed.txt"

    def test_passes(self):
        self.passes(*self.check(self.NOTED, self.NOTED))

    def test_other_bits(self):
        other = self.NOTED.replace("00bb", "00bc")
        self.fails("road: results 00bc, noted 00bb", *self.check(self.NOTED, other))

    def test_other_points(self):
        other = self.NOTED.replace("00aa", "00ab")
        self.fails("road: points given 00ab, noted 00aa", *self.check(self.NOTED, other))

    def test_missing_and_new(self):
        self.fails("road: missing", *self.check(self.NOTED, self.NOTED.replace("road", "lane")))
        self.fails("lane: not noted", *self.check(self.NOTED, self.NOTED + self.NOTED.replace("road", "lane")))

    def test_nothing(self):
        self.fails("nothing was checked", *self.check("", ""))

    def test_program_fails(self):
        self.fails("status 1", CHECKS.parent / "digest/check_digests.py", self.root / "noted.txt", "false")


class SelfTest(BrokenProject):
    HEADER = "constexpr std::uint64_t kSelfTestDigest = 0x0000000000000000ULL;\n"

    def note(self, report):
        self.write("digest.hpp", self.HEADER)
        self.write("report.txt", report)
        self.write("program", "#!/bin/sh\ncat \"$(dirname \"$0\")/report.txt\"\nexit 1\n")
        (self.root / "program").chmod(0o755)
        return CHECKS.parent / "digest/note_self_test.py", self.root / "digest.hpp", self.root / "program"

    def test_noted(self):
        report = "values_wrong 0\nrefused 0\ndigest_expected 00\ndigest_found 0123456789abcdef\n"
        self.passes(*self.note(report))
        self.assertIn("0x0123456789ABCDEFULL", (self.root / "digest.hpp").read_text(encoding="utf-8"))

    def test_a_wrong_engine_is_not_noted(self):
        report = "values_wrong 2\nrefused 0\ndigest_expected 00\ndigest_found 0123456789abcdef\n"
        self.fails("not noted: 2 values are wrong", *self.note(report))
        self.assertEqual((self.root / "digest.hpp").read_text(encoding="utf-8"), self.HEADER)
        self.fails("no report", *self.note("killed\n"))

    def code_crc(self, report):
        """A program that prints this report whatever its code is."""
        names = [f"engine_{part}_{end}" for part in ("text", "constants") for end in ("begin", "end")]
        self.write("program.c", "#include <stdio.h>\nconst char rows[8] = \"rows\", text[] = \"unknown status\";\n"
                   + "void pose_wall_config_get_text(void) {}\n"
                   + "".join(f'extern const char {name}[];\n__asm__(".globl {name}\\n.set {name}, rows + {at}");\n'
                             for at, name in zip((0, 0, 0, 4), names))
                   + f'int main(void) {{ puts("{report}"); return text[0] == rows[0]; }}\n')
        self.passes(tool("CC", "cc"), "-fno-pie", "-no-pie", self.root / "program.c", "-o", self.root / "program")
        return (CHECKS.parent / "digest/check_code_crc.py", tool("NM", "nm"), tool("READELF", "readelf"),
                self.root / "program")

    def test_a_crc_that_is_not_that_of_the_code(self):
        self.fails("the file says", *self.code_crc("code_crc32 00000000\\ncode_bytes 4"))
        right = f"code_crc32 {zlib.crc32(b'rows'):08x}\\ncode_bytes 4"
        self.fails("a bit fell over in the code", *self.code_crc(right))


class Fused(BrokenProject):
    """A planted fused instruction, as compilers make one where they may."""

    PLANTED = ("double f(double, double, double);\n"
               "double f(double a, double b, double c) { return __builtin_fma(a, b, c); }\n")
    MAY = ["-mfma"] if platform.machine() in ("x86_64", "AMD64") else []

    def check(self, source, *flags):
        return CHECKS / "check_fused.py", tool("OBJDUMP", "objdump"), self.archive(source, *flags)

    def levels(self, level, source):
        self.write("pairs.c", source)
        return (CHECKS / "check_fused.py", tool("OBJDUMP", "objdump"), "--levels", level, self.root / "pairs.c",
                tool("CC", "cc"), "-ffp-contract=off")

    def test_passes(self):
        apart = self.PLANTED.replace("__builtin_fma(a, b, c)", "a * b + c")
        self.passes(*self.check(apart, "-ffp-contract=off", *self.MAY))
        self.passes(*self.levels(" ".join(["-O1", *self.MAY]) + "|-O2", apart))

    def test_planted(self):
        self.fails("lib.a: f: 1 ", *self.check(self.PLANTED, *self.MAY))
        self.fails("-O3", *self.levels(" ".join(["-O3", *self.MAY]), self.PLANTED))

    def test_every_name(self):
        """As objdump prints them on each machine; those that round twice are not among them."""
        fused = ["vfmadd132ps (%rdi),%ymm0,%ymm1", "{evex} vfnmsub231sd %xmm1,%xmm2,%xmm3", "v4fmaddps (%rax),%zmm1",
                 "vfmsubadd213pd %zmm1,%zmm2,%zmm3", "vfmaddpd %xmm0,%xmm1,%xmm2,%xmm3", "fmadd d0, d1, d2, d3",
                 "fnmsub s0, s1, s2, s3", "fmla v0.4s, v1.4s, v2.4s", "fmls\tv0.2d, v1.2d, v2.2d",
                 "fcmla v0.2d, v1.2d, v2.2d, #90", "fmad z0.d, p0/m, z1.d, z2.d", "vfma.f32\tq0, q1, q2",
                 "vfnms.f64 d0, d1, d2", "vcmla.f32 q0, q1, q2, #90"]
        apart = ["vmulpd %ymm0,%ymm1,%ymm2", "vaddsubpd %ymm0,%ymm1,%ymm2", "fmul d0, d1, d2", "fnmul d0, d1, d2",
                 "fmov d0, #1.0", "vmla.f64 d0, d1, d2", "vmov.f64 d0, d1", "fcadd v0.2d, v1.2d, v2.2d, #90",
                 "fmsr s0, r1"]
        for text, wrong in [*((text, True) for text in fused), *((text, False) for text in apart)]:
            self.write("objdump", f"#!/bin/sh\nprintf '%s\\n' '0 <f>:' '   1c:\t{text}'\n")
            (self.root / "objdump").chmod(0o755)
            check = CHECKS / "check_fused.py", self.root / "objdump", "lib.a"
            with self.subTest(text):
                self.fails("lib.a: f: 1 ", *check) if wrong else self.passes(*check)

    def test_nothing_to_check(self):
        self.fails("nothing was checked", CHECKS / "check_fused.py", tool("OBJDUMP", "objdump"))
        self.write("lib.a", "!<arch>\n")
        self.fails("nothing was checked", CHECKS / "check_fused.py", tool("OBJDUMP", "objdump"), self.root / "lib.a")


class TwoEngines(BrokenProject):
    def check(self, main):
        self.write("two.c", LICENCE + '#include <stdio.h>\n#include <string.h>\n#include "pose_wall.h"\n' + main)
        return (CHECKS / "check_two_engines.sh", tool("CC", "cc"), self.root / "include", self.archive(SOURCE),
                self.root / "two.c")

    def test_releases_whatever_comes(self):
        main = """int main(void) {
          for (unsigned i = 0; i < 12 * pose_wall_abi_version(); ++i) puts("frame: 7 of 7 released");
          for (int q = 0; q < 7; ++q) puts("yaw agreed 12, disagreed  0, missing  0");
          return 0; }"""
        self.fails("scaled: exit status 0, not 3", *self.check(main))
        self.fails("bit: 0 lines hold 'withheld for good', not 1", *self.check(main))

    def test_releases_nothing(self):
        main = "int main(void) { return pose_wall_abi_version() == 1 ? 3 : 0; }"
        self.fails("none: exit status 3, not 0", *self.check(main))


class CompareBuilds(BrokenProject):
    """Of builds that are none: the program prints what is noted, and of recordings what the test says."""

    COMPARE = CHECKS.parent / "digest/compare_builds.py"
    BOTH = "a.xyz 1 10 00aa 00bb 7/7\nb.xyz 1 10 00cc 00dd 7/7\n"
    BUILDS = "x86-64-gcc-O1,x86-64-gcc-O2"

    def setUp(self):
        super().setUp()
        noted = self.COMPARE.parent / "digests.txt"
        self.script("program", f'[ $# -gt 0 ] || exec cat {noted}\ncat "$(dirname "$0")/../recorded"')
        for kind in ("motion", "planar"):
            self.script(kind, f"cat {noted.parent}/{kind}_digests.txt")
        self.script("cmake", f'[ "$1" = -G ] || exit 0\nmkdir -p "$6/tests"\n'
                    f'cp {self.root}/bin/program "$6/tests/pose_wall_digest"\n'
                    f'cp {self.root}/bin/motion "$6/tests/pose_wall_motion_digest"\n'
                    f'cp {self.root}/bin/planar "$6/tests/pose_wall_planar_digest"')
        for machine in ("", "aarch64-linux-gnu-"):
            self.script(f"{machine}objdump", "echo '   0:\tret'")
        self.script("qemu-aarch64-static", 'shift 2; exec "$@"')

    def script(self, name, text):
        self.write(f"bin/{name}", f"#!/bin/sh\n{text}\n")
        (self.root / "bin" / name).chmod(0o755)

    def compare(self, builds, of_the_second, *recorded):
        for name in builds.split(","):
            self.write(f"out/{name}/recorded", of_the_second if name.endswith("O2") else self.BOTH)
        path = f"PATH={self.root}/bin:{os.environ['PATH']}"
        more = ("--recorded", *recorded) if recorded else ()
        return "env", path, self.COMPARE, self.root / "out", "--builds", builds, *more

    def test_passes(self):
        kept = self.COMPARE.parent / "__pycache__"
        before = kept.exists()
        self.passes(*self.compare(self.BUILDS, ""))
        self.passes(*self.compare(self.BUILDS, self.BOTH, "a.xyz", "b.xyz"))
        self.passes(*self.compare(self.BUILDS + ",aarch64-none-elf-clang-Os", self.BOTH, "a.xyz", "b.xyz"))
        self.assertEqual(kept.exists(), before, "the sources stay as they are")

    def test_other_bits(self):
        other = self.BOTH.replace("00dd", "00de")
        self.fails("b.xyz: results 00de, noted 00dd", *self.compare(self.BUILDS, other, "a.xyz", "b.xyz"))

    def test_other_bits_of_a_library(self):
        for kind in ("motion", "planar"):
            noted = self.COMPARE.parent / f"{kind}_digests.txt"
            self.script(kind, f"sed '$ s/[0-9]*.[0-9]*$/0/' {noted}")
            self.fails(f"{kind}_", *self.compare(self.BUILDS, ""))
            self.script(kind, f"cat {noted}")

    def test_a_fused_instruction(self):
        self.script("objdump", "echo '   0:\tvfmaddsub132pd (%rdi),%ymm0,%ymm1'")
        self.fails("libpose_wall_planar.a: ?: 1 vfmaddsub132pd", *self.compare(self.BUILDS, ""))

    def test_a_recording_is_lost(self):
        lost = self.BOTH.splitlines()[0]
        self.fails("b.xyz: missing", *self.compare(self.BUILDS, lost, "a.xyz", "b.xyz"))
        self.fails("no sequence at all", *self.compare(self.BUILDS, "", "a.xyz", "b.xyz"))

    def test_nothing_to_compare_with(self):
        for builds in ("x86-64-gcc-O1", "x86-64-gcc-O1,aarch64-none-elf-clang-Os"):
            self.fails("recordings are compared between builds", *self.compare(builds, self.BOTH, "a.xyz"))


class TwoVersions(BrokenProject):
    def program(self, binding):
        """Two archives with a function `inner` each, and a program of both."""
        objects = []
        for name in ("first", "second"):
            inner = f"{binding} int inner(void) {{ return 1; }}\n"
            self.write(f"{name}.c", f"{inner}int {name}(void);\nint {name}(void) {{ return inner(); }}\n")
            objects.append(self.root / f"{name}.o")
            self.passes(tool("CC", "cc"), "-c", "-O0", self.root / f"{name}.c", "-o", objects[-1])
        self.write("main.c", "int first(void);\nint second(void);\nint main(void) { return first() - second(); }\n")
        self.passes(tool("CC", "cc"), self.root / "main.c", *objects, "-o", self.root / "program")
        return CHECKS / "two_versions/check_kept.sh", tool("NM", "nm"), *objects, self.root / "program"

    def test_passes(self):
        self.passes(*self.program("static"))

    def test_merged(self):
        self.fails("inner: 1 of 2 left", *self.program("__attribute__((weak))"))

    def test_nothing_in_both(self):
        check, nm, first, _, program = self.program("static")
        self.write("other.c", "int other(void);\nint other(void) { return 1; }\n")
        self.passes(tool("CC", "cc"), "-c", self.root / "other.c", "-o", self.root / "other.o")
        self.fails("nothing was checked", check, nm, first, self.root / "other.o", program)


class Abi(BrokenProject):
    def layout(self, printed, expected):
        self.write("printed", printed)
        self.write("expected", expected)
        program, file = f"-DPROGRAM={self.root}/printed", f"-DEXPECTED={self.root}/expected"
        header = f"-DHEADERS={self.root}/include/pose_wall.h"
        return tool("CMAKE", "cmake"), program, file, "-DEMULATOR=cat", header, "-P", CHECKS / "check_abi.cmake"

    def test_passes(self):
        self.passes(*self.layout("pose_wall_field 8\n", "pose_wall_field 8\n"))

    def test_moved(self):
        self.fails("are laid out otherwise", *self.layout("pose_wall_field 8\n", "pose_wall_field 12\n"))

    def test_struct_forgotten(self):
        struct = "typedef struct pose_wall_plane {\n  double d_m;\n} pose_wall_plane;\n"
        self.write("include/pose_wall.h", HEADER + struct)
        self.fails("does not hold pose_wall_plane", *self.layout("pose_wall_field 8\n", "pose_wall_field 8\n"))

    def test_program_fails(self):
        command = list(self.layout("", ""))
        command[3] = "-DEMULATOR=false"
        self.fails("implicit padding", *command)


class Statuses(BrokenProject):
    def check(self, number=-1, row='STATUS(POSE_WALL_E_NULL, -1, "no pointer")', other=-100, said="no pointer"):
        self.write("include/pose_wall.h", f"enum pose_wall_status {{ POSE_WALL_E_NULL = {number} /* = 7 */ }};\n")
        self.write("include/pose_wall_box.h", f"enum pose_wall_box_status {{\n  POSE_WALL_BOX_E_END = {other}\n}};\n")
        self.write("include/README.md", "| -1 to -89 | [pose_wall.h](x) |\n| -90 to -110 | [pose_wall_box.h](x) |\n")
        self.write("src/engine/names.def", f'{row}\nSTATUS(POSE_WALL_BOX_E_END, {other}, "no record")\n')
        self.write("said", f"-1\tplanar\t{said}\n{other}\tplanar\tno record\n-5\tplanar\tunknown status\n")
        return CHECKS / "check_statuses.py", self.root, "cat", self.root / "said"

    def test_passes(self):
        self.passes(*self.check())

    def test_faults(self):
        for name, change, said in (
                ("one number for two", {"other": -1}, "-1 is POSE_WALL_E_NULL and POSE_WALL_BOX_E_END"),
                ("out of its range", {"other": -120}, "POSE_WALL_BOX_E_END = -120 lies outside"),
                ("another number in the list", {"number": -2}, "POSE_WALL_E_NULL is -2 in the headers and -1"),
                ("not in the list", {"row": ""}, "POSE_WALL_E_NULL is -1 in the headers and None"),
                ("one sentence for two", {"row": 'STATUS(POSE_WALL_E_NULL, -1, "no record")'}, "of two statuses"),
                ("another text", {"said": "no way"}, "planar says 'no way' of -1")):
            with self.row(name):
                self.fails(said, *self.check(**change))


class Headers(BrokenProject):
    RULES = "install(FILES ${PROJECT_SOURCE_DIR}/include/LIMITS.md x RENAME planar_stop.md)\n"
    PAGE = "[a](pose_wall.h) [b](pose_wall_planar_x.h)\n"
    CALL = "POSE_WALL_CHECKED int32_t pose_wall_planar_x_open(void);\n"

    def check(self, header, page=PAGE):
        self.write("tools/cmake/pose_wall_install.cmake", self.RULES)
        self.write("include/README.md", page)
        self.write("include/pose_wall_planar_x.h", header)
        return CHECKS / "check_headers.py", self.root

    def test_passes(self):
        self.passes(*self.check("/* LIMITS.md, planar_stop.md */\n" + self.CALL +
                                "enum x {\n  POSE_WALL_PLANAR_A = 1, /* POSE_WALL_B = 2 */\n"
                                "  POSE_WALL_PLANAR_B\n};\n"))

    def test_unmarked(self):
        self.fails("pose_wall_planar_x_open returns a status without", *self.check(self.CALL[18:]))

    def test_prefix(self):
        self.fails("POSE_WALL_X_A does not begin", *self.check("enum x {\n  POSE_WALL_X_A = 1,\n};\n"))
        self.fails("POSE_WALL_X_B does not begin", *self.check("#define POSE_WALL_X_B 3\n"))

    def test_page_that_no_package_holds(self):
        self.fails("names src/x/README.md", *self.check("/* src/x/README.md has it */\n"))
        self.fails("names MOTION.md", *self.check("/* MOTION.md has it */\n"))

    def test_not_linked(self):
        self.fails("include/README.md does not link it", *self.check(self.CALL, page="[a](pose_wall.h)\n"))


class Budget(BrokenProject):
    HELP = "usage: [--frames N] vlp16, mid360, os1-64, os0-128; Exit status"
    ROW = "%-9s   28787   15746     4.2 ms     4.4 ms     4.5 ms   {ten}    {twenty}"

    REFUSES = ("did you mean '--frames', did you mean 'os1-64', from 1 to 100000, not '' '0' '12x' '--frmaes' 'os1-46' "
               "'nothing' --frames vlp16 mid360")

    def check(self, help_text=HELP, refuses=REFUSES, ten="fits, 5 % of it", twenty="fits, 9 % of it", status=0):
        row = self.ROW.format(ten=ten, twenty=twenty)
        lines = ["#!/usr/bin/env python3", "import sys", "words = sys.argv[1:]",
                 f"if words == ['--help']: sys.exit(print({help_text!r}))",
                 "if words != ['--frames', '2', 'vlp16', 'mid360']:",
                 f"    sys.stderr.write({refuses!r}); sys.exit(2)",
                 f"for name in ['vlp16', 'mid360']: print({row!r}.replace('%-9s', name))", f"sys.exit({status})"]
        self.write("budget", "\n".join(lines))
        (self.root / "budget").chmod(0o755)
        return (CHECKS / "check_budget.py", self.root / "budget")

    def test_passes(self):
        self.passes(*self.check())

    def test_faults(self):
        for name, change, said in (
                ("help without a sensor", {"help_text": self.HELP.replace("mid360", "")}, "does not say 'mid360'"),
                ("a complaint without advice", {"refuses": "no"}, "without did you mean"),
                ("no row", {"ten": "5 %"}, "no row for each sensor"),
                ("the share of another period", {"ten": "fits, 9 % of it"}, "are not 4.5 ms"),
                ("the verdict", {"twenty": "too slow, 9 % of it"}, "is said to be 'too slow'"),
                ("the status", {"status": 1}, "and the status is 1")):
            with self.row(name):
                self.fails(said, *self.check(**change))


if __name__ == "__main__":
    unittest.main()
