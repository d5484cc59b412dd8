#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""What half and twice each constant of the engine changes in simulated roads.

    bench/constants/sweep.py --word swept                       all constants whose reason holds the word
    bench/constants/sweep.py engine/floor/candidates.cpp:kGhostShare
    bench/constants/sweep.py engine/floor/candidates.cpp:kGhostShare=1e9     another value, as one that is never met
    bench/constants/sweep.py --word swept --list                only names them
    bench/constants/sweep.py --table                            the table of what is measured already

Measured is with a copy of the sources in the work folder, in which these constants are read at start. The delivered
sources stay as they are. The first call builds the copy (minutes), simulates the frames (0.3 GB) and measures with all
values of the sources. A constant then takes some 2 s of one core for each value. Results stand in results.csv of the
work folder: interrupt it, and the same command continues. Other sources make other results: take another folder."""

import argparse
import concurrent.futures
import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

import outcome
import swept_copy

COMMON = ["--kind", "all", "--size", "small", "--scans", "instant", "--set", "motion=off", "-q", "-j1"]
# Every scene on a dense sensor, on one without rings and on a sparse one; and the events, which test the memory.
EVENTS = ("wall_lost,frozen,partial,jitter,dust_thickens,stamp_still,duplicated,dropped,turn_step,boom_sweep,"
          "stamp_leap,stamp_jump")
PLANS = {
    "scenes": ["--draws", "1", "--frames", "1", "--sensors", "os1-64,mid360,vlp16", "--seed", "4242"],
    "again": ["--draws", "1", "--frames", "1", "--sensors", "os1-64,mid360,vlp16", "--seed", "4243"],
    "events": ["--draws", "1", "--scenes", EVENTS, "--seed", "4242"],
}
HEAD = ("constant", "how", "value", "plan", *outcome.COUNTS, "seconds", "failure")
LONGEST_S = 600  # a campaign takes some 10 s: a value that takes so long does not end


class Campaign:
    """Runs the command of the copy, and compares with the values of the sources."""

    def __init__(self, work, copy):
        self.work, self.copy = work, copy
        self.frames = work / "frames"
        self.frames.mkdir(exist_ok=True)
        self.of_sources, self.taken = {}, {}

    def run(self, plan, swept=None):
        """The frames, and the names of unobservable scenes."""
        with tempfile.TemporaryDirectory(dir=self.work) as folder:
            env = {**os.environ, "POSE_WALL_FRAMES": str(self.frames)}
            log = pathlib.Path(folder) / "log"
            env["POSE_WALL_SWEPT" if swept else "POSE_WALL_SWEPT_LOG"] = swept or str(log)
            command = [self.copy.command, "campaign", *COMMON, *PLANS[plan], "--output", f"{folder}/out"]
            done = subprocess.run(command, env=env, capture_output=True, text=True, timeout=LONGEST_S)
            if done.returncode:
                raise RuntimeError(f"status {done.returncode}: {done.stderr.strip()[-200:]}")
            if not swept:
                self.note_values(log.read_text("utf-8"))
            card = json.loads(pathlib.Path(folder, "out/card.json").read_text("utf-8"))
            unobservable = {c["scene"] for c in card["classes"] if c["kind"] == "unobservable"}
            return outcome.frames_of(f"{folder}/out/frames.csv"), unobservable

    def note_values(self, log):
        for line in log.splitlines():
            name, value, _ = line.rsplit(" ", 2)
            self.taken[name] = value

    def start(self, plans):
        for plan in plans:
            print(f"{plan}: with all values of the sources", file=sys.stderr)
            self.of_sources[plan] = self.run(plan)

    def measure(self, name, how, plan):
        row = {"constant": name, "how": how, "value": self.value(name, how), "plan": plan}
        begin = time.monotonic()
        try:
            frames, unobservable = self.run(plan, f"{name}={how}")
            row.update(outcome.compare(self.of_sources[plan][0], frames, unobservable))
        except (RuntimeError, subprocess.TimeoutExpired) as error:
            row["failure"] = str(error).splitlines()[0][:100]
        return {**row, "seconds": round(time.monotonic() - begin, 1)}

    def value(self, name, how):
        was = self.taken.get(name)
        if was is None:
            return "not read"
        return {"half": f"{was} / 2", "twice": f"{was} * 2"}.get(how, how)


def wanted(options):
    """The constants asked for, and what is asked of each: (name, how)."""
    known = {c.key: c for c in swept_copy.all_constants()}
    asked = [(key, how) for key, c in known.items() for how in options.values.split(",")
             if options.word and re.search(rf"\b{options.word}\b", c.reason, re.I)]
    for word in options.names:
        name, _, value = word.partition("=")
        if name not in known:
            sys.exit(f"'{name}' is no constant of src/{', src/'.join(swept_copy.ROOMS)}; --word '' --list names them")
        asked += [(name, how) for how in ([value] if value else options.values.split(","))]
    return known, asked


def measured(path):
    if not path.exists():
        return []
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def sweep(asked, campaign, options, results):
    done = {(r["constant"], r["how"], r["plan"]) for r in measured(results)}
    left = [(name, how, plan) for plan in options.plans.split(",") for name, how in asked
            if (name, how, plan) not in done]
    fresh, begin = not results.exists(), time.monotonic()
    with open(results, "a", newline="", encoding="utf-8") as file, \
            concurrent.futures.ThreadPoolExecutor(options.jobs) as crew:
        out = csv.DictWriter(file, HEAD)
        if fresh:
            out.writeheader()
        tasks = [crew.submit(campaign.measure, *one) for one in left]
        for k, task in enumerate(concurrent.futures.as_completed(tasks), 1):
            row = task.result()
            out.writerow(row)
            file.flush()
            minutes = (time.monotonic() - begin) / k * (len(left) - k) / 60
            print(f"{k} of {len(left)}, {minutes:.0f} min left: {row['constant']} {row['how']}, {row['plan']}: "
                  f"{row.get('failure') or said(row)}", file=sys.stderr)


def said(row):
    return (f"{row['changed']} of {row['frames']} frames changed, {row['lost']} values lost, {row['won']} won, "
            f"{row['misleading_more']} misleading more, {row['beyond_more']} beyond more")


def total(rows):
    """Of one value in all plans; a plan that failed makes it fail."""
    failure = next((r["failure"] for r in rows if r["failure"]), "")
    return failure, {count: sum(int(r[count] or 0) for r in rows) for count in outcome.COUNTS}


def table(rows):
    by_value = {}
    for row in rows:
        by_value.setdefault((row["constant"], row["how"]), []).append(row)
    columns = ("changed", "lost", "won", "misleading_more", "beyond_more")
    print("| constant | value | frames | " + " | ".join(columns) + " |\n" + "| --- " * (3 + len(columns)) + "|")
    for (constant, how), of_value in sorted(by_value.items()):
        failure, sums = total(of_value)
        cells = [failure] if failure else [str(sums[c]) for c in columns]
        print(f"| {constant} | {how}: {of_value[0]['value']} | {sums['frames']} | " + " | ".join(cells) + " |")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="FILE:NAME[=VALUE]", help="below src/")
    parser.add_argument("--word", help="also all constants whose reason holds this word")
    parser.add_argument("--values", default="half,twice", help="half, twice or numbers; default %(default)s")
    parser.add_argument("--plans", default="scenes", help=f"of {', '.join(PLANS)}; default %(default)s")
    parser.add_argument("--jobs", type=int, default=2, help="campaigns at a time; default %(default)s")
    work = pathlib.Path(tempfile.gettempdir()) / "pose_wall_constants"
    parser.add_argument("--work", type=pathlib.Path, default=work,
                        help="folder of copy, frames and results; default %(default)s")
    parser.add_argument("--list", action="store_true", help="name the constants, and measure nothing")
    parser.add_argument("--table", action="store_true", help="print the table of results.csv, and measure nothing")
    return parser.parse_args()


def main():
    options = arguments()
    results = options.work / "results.csv"
    if options.table:
        table(measured(results))
        return
    known, asked = wanted(options)
    if not asked:
        sys.exit("no constant is asked for; --help has examples")
    if options.list:
        print("\n".join(f"{key}: {known[key].reason.strip(' /')}" for key in dict.fromkeys(key for key, _ in asked)))
        return
    options.work.mkdir(parents=True, exist_ok=True)
    copy = swept_copy.Copy(options.work)
    copy.fill([known[key] for key in dict.fromkeys(key for key, _ in asked)])
    copy.make()
    for key, why in sorted(copy.left.items()):
        print(f"not swept: {key}: {why}", file=sys.stderr)
    campaign = Campaign(options.work, copy)
    campaign.start(options.plans.split(","))
    for key in copy.swept:
        if key not in campaign.taken:
            print(f"not read in any frame: {key}", file=sys.stderr)
    sweep([(name, how) for name, how in asked if name in copy.swept], campaign, options, results)
    table(measured(results))


if __name__ == "__main__":
    main()
