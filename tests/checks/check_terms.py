#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Chinese texts call each thing of the mine by one word: that of tools/io/language/zh/terms.txt.

usage: check_terms.py ROOT     exit status 1 and one line per text that holds a refused word. Read are README.md, and
catalogues, pages, settings, scripts and sources with Chinese in include/ and tools/."""

import pathlib
import re
import sys

HAN = re.compile(r"[\u3400-\u9fff]")
READ = (".po", ".md", ".js", ".yaml", ".html", ".cpp", ".hpp", ".py", ".service")


def terms(root):
    """[(the word to use, a pattern of what is refused)]"""
    for line in (root / "tools/io/language/zh/terms.txt").read_text(encoding="utf-8").splitlines():
        if not line or line.startswith("#"):
            continue
        _, use, refused = (cell.strip() for cell in line.split("|"))
        for word in refused.split():
            word, _, within = word.partition("~")
            before = within[: within.find(word)] if within else ""
            yield use, re.compile((f"(?<!{before})" if before else "") + word)


def files(root):
    yield root / "README.md"
    for folder in ("include", "tools"):
        yield from sorted(path for path in (root / folder).rglob("*") if path.suffix in READ)


def faults(root):
    known = list(terms(root))
    lines = 0
    for path in files(root):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines() if path.is_file() else (), 1):
            if not HAN.search(line):
                continue
            lines += 1
            for use, refused in known:
                for found in refused.finditer(line):
                    around = line[max(0, found.start() - 12) : found.end() + 12]
                    yield f"{path.relative_to(root)}:{number}: '{found.group()}' instead of '{use}': {around}"
    if lines == 0:
        yield "no Chinese line: nothing was checked"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = list(faults(pathlib.Path(sys.argv[1]).resolve()))
    print("\n".join(found) or "each thing has one word")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
