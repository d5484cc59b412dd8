#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Runs a digest program and compares what it prints, line by line, with the digests that are noted.

    check_digests.py NOTED COMMAND...          exit status 1 where a line differs
    check_digests.py --note NOTED COMMAND...   writes them, after a change of the engine that is meant to change results
"""

import pathlib
import subprocess
import sys

COLUMNS = ["name", "frames", "points", "points given", "results", "measured"]


def lines_of(text):
    """Fields by name of the sequence."""
    return {line.split()[0]: line.split() for line in text.splitlines() if line and not line.startswith("#")}


def differences(noted, found):
    """In words. Where the points given differ, it is not the engine that made the difference."""
    if not found:
        return ["no sequence at all: nothing was checked"]
    out = [f"{name}: missing" for name in noted if name not in found]
    for name, fields in found.items():
        if name not in noted:
            out.append(f"{name}: not noted")
            continue
        out += [f"{name}: {COLUMNS[k]} {now}, noted {before}"
                for k, (before, now) in enumerate(zip(noted[name], fields)) if before != now]
    return out


def run(command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def main():
    words = sys.argv[1:]
    note = words[:1] == ["--note"]
    words = words[1:] if note else words
    if len(words) < 2:
        sys.exit(__doc__)
    path, printed = pathlib.Path(words[0]), run(words[1:])
    if note:
        head = [*HEAD, f"tests/digest/check_digests.py --note tests/digest/{path.name} {words[-1]}"]
        path.write_text("".join(f"# {text}\n" for text in head) + printed, encoding="utf-8")
        return
    worse = differences(lines_of(path.read_text(encoding="utf-8")), lines_of(printed))
    print("\n".join(worse) or f"{len(lines_of(printed))} sequences, the same bits as noted")
    sys.exit(1 if worse else 0)


HEAD = ["Sequence, frames, points, digest of the points, digest of the results, values measured of those asked for.",
        "The same from every build. After a change of the engine that is meant to change results, note them anew:"]

if __name__ == "__main__":
    main()
