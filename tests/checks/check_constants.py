#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Every named number of the libraries has a reason beside it: a comment of three words or more. It stands at the end of
the constant's own line, or on lines of its own directly above. One above holds for one declaration; where it ends with
a colon, for the row of declarations below it, up to a blank line, another comment of its own line or anything else.
That somebody judged so on some day is no reason: "judgement" and dates are not counted among the three words.

Looked at is what is declared constexpr with an arithmetic type, or as an array of one, in any scope; and of each row of
a gates.def its origin, which may be one word ("key"), but not that one.

usage: check_constants.py ROOT [FOLDER...]      folders and files below src/, all of it if none is given;
                                                exit status 1 and one line per constant without a reason"""

import pathlib
import re
import sys

ALL = ("*",)
WORDS_MIN = 3
NUMBER = (r"(?:double|float|auto|bool|char|short|(?:unsigned|signed|long|int)(?:\s+(?:long|int|char|short))*"
          r"|(?:std::)?(?:u?int(?:_fast|_least)?\d+_t|u?intptr_t|size_t|ptrdiff_t)"
          r"|std::array<\s*(?:double|float|int|std::u?int\d+_t)\b[^;={]*>)")
ASIDE = r"(?:(?:static|inline|const)\s+)*"
DECLARATION = re.compile(rf"^[ \t]*{ASIDE}constexpr\s+{ASIDE}{NUMBER}\s+(?=\w+\s*[\[={{,])", re.M)
COMMENT_OR_STRING = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])'", re.S)
NAME = re.compile(r"\s*(\w+)\s*(?:\[[^\]]*\]\s*)*(?=[={])")
WORD = re.compile(r"[A-Za-z][A-Za-z'_]+")
NO_REASON = re.compile(r"NO" r"LINT\S*|clang-format (?:on|off)|\b[Jj]udge?ments?\b")
# A row's last text but one is its origin: the very last says what the value is.
GATE = re.compile(r'^GATE\((\w+), "\w+", .*"([^"]*)", "[^"]*"\)$')


def split(text):
    """The text with blanks for comments and strings, and by line (from 0) its comment: where it begins, its words."""
    code, comments = list(text), {}
    for match in COMMENT_OR_STRING.finditer(text):
        code[match.start():match.end()] = re.sub(r"[^\n]", " ", match[0])
        if match[0][0] == "/":
            line = text.count("\n", 0, match.start())
            column = match.start() - (text.rfind("\n", 0, match.start()) + 1)
            for k, part in enumerate(match[0].split("\n")):
                before = comments.get(line + k, (column, ""))
                comments[line + k] = (before[0], before[1] + " " + part)
    return "".join(code), comments


def declarators(code, start):
    """What a declaration declares, as (where the name stands, where its part ends, name), and where the whole ends."""
    names, depth, begin = [], 0, start
    for k in range(start, len(code)):
        depth += (code[k] in "([{") - (code[k] in ")]}")
        if depth == 0 and code[k] in ",;":
            match = NAME.match(code, begin)
            if match:
                names.append((match.start(1), k, match[1]))
            begin = k + 1
            if code[k] == ";":
                return names, k
    return names, len(code) - 1


def alone_above(code, comments, first):
    """The comment on lines of its own directly above line `first`. What begins further right is of the line before."""
    indent, text, k = len(code[first]) - len(code[first].lstrip()), "", first - 1
    while k >= 0 and k in comments and not code[k].strip() and comments[k][0] <= indent:
        text, k = comments[k][1] + text, k - 1
    return text


def is_reason(comment):
    return len(WORD.findall(NO_REASON.sub("", comment))) >= WORDS_MIN


def constants(text):
    """(line, name, reason) of each constant; lines count from 1."""
    code, comments = split(text)
    lines = code.split("\n")
    found, row = [], {}  # by the last line of a declaration: the comment that holds for the next one as well
    for match in DECLARATION.finditer(code):
        names, end = declarators(code, match.end())
        first, last = code.count("\n", 0, match.start()), code.count("\n", 0, end)
        above = alone_above(lines, comments, first) or row.get(first - 1, "")
        for at, stop, name in names:
            at, stop = code.count("\n", 0, at), code.count("\n", 0, stop)
            beside = "".join(comments[k][1] for k in range(at, stop + 1) if k in comments)
            found.append((at + 1, name, beside if is_reason(beside) else above))
        row[last] = above if above.rstrip().endswith(":") else ""
    return found


def sources(src, places):
    paths = (path for place in places for path in sorted(src.glob(place)))
    for path in paths:
        yield from sorted(p for p in [path, *path.rglob("*")] if p.suffix in {".cpp", ".hpp"})


def gates(text):
    """(line, name, origin) of each row of a table of gates."""
    lines = [(k, line) for k, line in enumerate(text.split("\n"), 1) if line.startswith("GATE(")]
    rows = [(k, GATE.match(line), line) for k, line in lines]
    return [(k, row[1], row[2]) if row else (k, line[:60], "") for k, row, line in rows]


def main():
    root, places = pathlib.Path(sys.argv[1]), sys.argv[2:] or ALL
    looked_at, found = 0, []
    for place in places:
        paths = list(sources(root / "src", [place]))
        if not paths:
            sys.exit(f"{root}/src/{place} holds no sources: nothing was checked")
        for path in paths:
            of_file = constants(path.read_text(encoding="utf-8"))
            looked_at += len(of_file)
            found += [f"{path.relative_to(root)}:{line} {name}" for line, name, text in of_file if not is_reason(text)]
        for path in sorted(path for top in (root / "src").glob(place) for path in top.rglob("gates.def")):
            of_file = gates(path.read_text(encoding="utf-8"))
            looked_at += len(of_file)
            found += [f"{path.relative_to(root)}:{line} {name}" for line, name, origin in of_file
                      if not WORD.search(NO_REASON.sub("", origin))]
    if not looked_at:
        sys.exit("no constants: nothing was checked")
    print("\n".join([*found, f"{looked_at} constants and gates, {len(found)} without a reason"]))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
