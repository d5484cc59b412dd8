#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Pages keep their promises: relative links and their anchors resolve, the C examples of README.md and
include/README.md compile, and CONTRIBUTING.md names every check of tests/checks, and no other.

usage: check_pages.py ROOT CC...   exit status 1 and one line per broken rule"""

import pathlib
import re
import subprocess
import sys
import tempfile
import urllib.parse

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
FENCED = re.compile(r"^```(\w*)\n(.*?)^```", re.S | re.M)
COMMENT = re.compile(r"<!--.*?-->", re.S)
CHECK = re.compile(r"\b(?:pose_wall_check\(|add_test\(NAME checks\.)([\w${}]+)")
NAME_OF_A_FUNCTION = "${name}"
NOT_OURS = {"build", "out", "node_modules", ".git"}

# What stands around the examples: names that are the reader's.
READERS = """
#include <stdio.h>
#include <pose_wall.h>
#include <pose_wall_motion.h>
#include <pose_wall_planar.h>
#include <pose_wall_runtime.h>
void must(int32_t status);
void steer(double yaw);
void act_on(const pose_wall_result *result);
void report_it(void);
int next_scan(pose_wall_planar_scan *scan);
int next_frame(const void **data, uint32_t *count, int64_t *stamp_ns);
extern void *block, *motion_block;
extern const void *points, *data;
extern uint32_t count;
extern int64_t stamp_ns;
extern uint64_t bytes, block_bytes;
extern pose_wall_config config;
extern pose_wall_cloud cloud;
extern pose_wall_engine *engine;
extern pose_wall_motion *motion;
extern pose_wall_planar_scan scan;
extern pose_wall_runtime *runtime;
extern pose_wall_motion_result moved;
extern pose_wall_result result;
extern pose_wall_image image;
"""


def slug(heading):
    """The anchor that GitHub makes of a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
    return re.sub(r"[^\w\- ]", "", text).strip().replace(" ", "-")


def anchors(page):
    text = FENCED.sub("", page.read_text(encoding="utf-8"))
    return {slug(heading) for heading in re.findall(r"^#+\s+(.*)$", text, re.M)}


def broken_links(root, page):
    text = COMMENT.sub("", FENCED.sub("", page.read_text(encoding="utf-8")))
    for link in LINK.findall(re.sub(r"`[^`\n]*`", "", text)):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = urllib.parse.unquote(link).partition("#")
        target = (page.parent / path).resolve() if path else page
        if not target.exists():
            yield f"{page.relative_to(root)}: {link} leads nowhere"
        elif anchor and target.suffix == ".md" and anchor not in anchors(target):
            yield f"{page.relative_to(root)}: {target.name} has no heading of #{anchor}"


def examples(page):
    blocks = [block for language, block in FENCED.findall(page.read_text(encoding="utf-8")) if language == "c"]
    for number, block in enumerate(blocks):
        body = re.sub(r"^#include.*$", "", block, flags=re.M)
        yield f"void example_{number}(void);\nvoid example_{number}(void) {{\n{body}}}\n"


def broken_examples(root, compiler, names):
    found = False
    for name in names:
        blocks = list(examples(root / name))
        found = found or bool(blocks)
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder) / "example.c"
            source.write_text(READERS + "".join(blocks), encoding="utf-8")
            command = [*compiler, "-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"-I{root}/include",
                       str(source)]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            yield f"{name}: an example does not compile:\n{done.stderr}"
    if not found:
        yield "no page holds an example: nothing was checked"


def checks_of(root):
    """Names as CMake has them, with * for what a loop fills in."""
    text = "\n".join(path.read_text(encoding="utf-8") for path in (root / "tests/checks").rglob("CMakeLists.txt"))
    return {re.sub(r"\$\{\w+\}", "*", name) for name in CHECK.findall(text) if name != NAME_OF_A_FUNCTION}


def table_of_checks(root):
    text = (root / "CONTRIBUTING.md").read_text(encoding="utf-8")
    rows = text[text.index("| you change |"):].splitlines()[2:]
    return {name for row in rows if row.startswith("|") for name in re.findall(r"`([\w*]+)`", row.split("|")[2])}


def broken_table(root):
    checks, table = checks_of(root), table_of_checks(root)
    yield from (f"CONTRIBUTING.md does not name the check {name}" for name in sorted(checks - table))
    yield from (f"CONTRIBUTING.md names {name}, which is no check" for name in sorted(table - checks))


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    found, pages = [], 0
    for page in sorted(root.rglob("*.md")):
        if NOT_OURS & set(page.relative_to(root).parts):
            continue
        pages += 1
        found += broken_links(root, page)
    found += broken_examples(root, sys.argv[2:], ("README.md", "include/README.md"))
    found += broken_table(root)
    print("\n".join(found) or f"{pages} pages")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
