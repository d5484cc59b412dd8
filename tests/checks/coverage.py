#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Which lines and branches of src/ the tests reach, by Clang's counters. Runs the tests of the engine and the runtime
(unit, property, abi, runtime, faults, what replays the fuzz corpora, the digests' roadways), but no scenarios and no
statistics over many draws: those go over the same code for minutes. A branch is one outcome of one condition of the
source; the compiler's own are none.

usage: cmake --preset coverage && cmake --build --preset coverage && tests/checks/coverage.py [--missing] [--again]
  --missing  also print each line and branch that was not reached
  --again    do not run the tests, read what they left
exit status 1 below 95 % of lines or 90 % of branches; JOBS=n: so many programs side by side"""

import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TESTS = ROOT / "build/coverage/tests"
PROFILES = ROOT / "build/coverage/profiles"
KINDS = ("unit", "property", "abi", "runtime", "faults")
LINES_MIN, BRANCHES_MIN = 95.0, 90.0


# Statistics over many draws; as in .ci/weekly.
MANY_DRAWS = ("WallStrips.TheRock*:WallStrips.RockWithout*:StripProfile.RoughRockHasNone*:GrooveProfile.RockIsNot*:"
              "PatchFit.OnRoughRock*:PatchFit.AFoot*:PatchFit.AFlat*:PatchFit.OnAFlat*:GroundFit.TheErrors*:"
              "UnevenPlane.Errors*:*SimRender.EveryScene*:*FramesAndSigns*")


def programs():
    """Every program with what it is run with."""
    for kind in KINDS:
        yield TESTS / f"pose_wall_{kind}_tests", [f"--gtest_filter=-{MANY_DRAWS}"]
    for program in sorted(TESTS.glob("pose_wall_*_replay")):
        name = re.sub("pose_wall_(.*)_replay", r"\1", program.name)
        yield program, ["--changed", "100", str(ROOT / "tests/fuzz/corpus" / name)]
    yield TESTS / "pose_wall_digest", []


def run_test(program, words):
    environment = dict(os.environ, LLVM_PROFILE_FILE=str(PROFILES / f"{program.name}.profraw"))
    done = subprocess.run([program, *words], cwd=ROOT, env=environment, capture_output=True, check=False)
    (PROFILES / f"{program.name}.log").write_bytes(done.stdout + done.stderr)
    print(f"{program.name}: {'passed' if done.returncode == 0 else 'FAILED'}", flush=True)
    return done.returncode == 0


def run_tests():
    PROFILES.mkdir(parents=True, exist_ok=True)
    for old in PROFILES.glob("*"):
        old.unlink()
    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("JOBS", os.cpu_count() or 1))) as pool:
        return all(list(pool.map(lambda test: run_test(*test), programs())))


def export():
    merged = PROFILES / "all.profdata"
    raw = sorted(PROFILES.glob("*.profraw"))
    subprocess.run(["llvm-profdata", "merge", "-sparse", "-o", merged, *raw], check=True)
    first, *others = [str(program) for program, _ in programs()]
    more = [word for other in others for word in ("-object", other)]
    told = subprocess.run(["llvm-cov", "export", f"-instr-profile={merged}", first, *more],
                          check=True, capture_output=True, text=True)
    files = json.loads(told.stdout)["data"][0]["files"]
    for file in files:  # the compiler was perhaps given a path from the build's folder
        file["filename"] = os.path.normpath(os.path.join(ROOT / "build/coverage", file["filename"]))
    return [file for file in files if file["filename"].startswith(f"{ROOT}/src/")]


def missing_branches(file):
    """(line, column, which outcome): not reached by any instance of a template."""
    sums = {}
    for line, column, end_line, end_column, true_count, false_count, *_ in file["branches"]:
        old = sums.get((line, column, end_line, end_column), (0, 0))
        sums[line, column, end_line, end_column] = (old[0] + true_count, old[1] + false_count)
    missing = []
    for (line, column, *_), counts in sorted(sums.items()):
        missing += [(line, column, outcome) for outcome, count in zip(("true", "false"), counts) if count == 0]
    return 2 * len(sums), missing


def missing_lines(file):
    """Lines on which a region begins or goes on that was never entered, and no other was."""
    reached, wanted, count, has = {}, set(), 0, False
    segments = file["segments"]
    for index, (line, _, segment_count, has_count, *_rest) in enumerate(segments):
        count, has = segment_count, has_count
        end = segments[index + 1][0] if index + 1 < len(segments) else line
        if has:
            for number in range(line, end + 1):
                reached[number] = max(reached.get(number, 0), count)
                wanted.add(number)
    return sorted(number for number in wanted if reached[number] == 0)


def percent(done, of):
    return 100.0 * done / of if of else 100.0


def main():
    if "--again" not in sys.argv and not run_tests():
        sys.exit("what a failing test does not reach is no figure")
    rows, sums = [], [0, 0, 0, 0]
    for file in export():
        lines = file["summary"]["lines"]
        branches, missing = missing_branches(file)
        row = [lines["covered"], lines["count"], branches - len(missing), branches]
        sums = [a + b for a, b in zip(sums, row)]
        rows.append((pathlib.Path(file["filename"]).relative_to(ROOT), row, missing, file))
    print(f"{'file':44} {'lines':>13} {'branches':>22}")
    for name, row, _, _ in sorted(rows, key=lambda r: percent(r[1][2], r[1][3])):
        print(f"{str(name):44} {percent(*row[:2]):6.1f} % of {row[1]:4} {percent(*row[2:]):6.1f} % of {row[3]:4}")
    print(f"{'all of src/':44} {percent(*sums[:2]):6.1f} % of {sums[1]:4} {percent(*sums[2:]):6.1f} % of {sums[3]:4}")
    if "--missing" in sys.argv:
        for name, _, missing, file in rows:
            text = (ROOT / name).read_text(encoding="utf-8").splitlines()
            for line in missing_lines(file):
                print(f"{name}:{line}: not reached: {text[line - 1].strip()}")
            for line, column, outcome in missing:
                print(f"{name}:{line}:{column}: never {outcome}: {text[line - 1].strip()}")
    sys.exit(0 if percent(*sums[:2]) >= LINES_MIN and percent(*sums[2:]) >= BRANCHES_MIN else 1)


if __name__ == "__main__":
    main()
