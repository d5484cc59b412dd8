#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Runs FB_PoseWall through hours of 10 ms cycles with random faults (tests/checks/plc): its plain text is translated to
C and compiled, and an oracle looks at every cycle. Then the same for blocks with one rule taken away each: the oracle
must find every one of them.

usage: plc_campaign.py ROOT CC [HOURS [SEED]]    without HOURS: one hour, seed 1, and the blocks that lack a rule"""

import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the sources stay as they are
sys.path.insert(0, str(pathlib.Path(__file__).parent))

import structured_text  # noqa: E402  pylint: disable=wrong-import-position
import structured_text_c  # noqa: E402  pylint: disable=wrong-import-position

CYCLES_PER_HOUR = 360000
# What is taken away, and what stands in its place
LACKING = {
    "the sum": ("adwNative[POSE_WALL_IMAGE_CRC_WORD] <> fbSum.dwSum", "diByteOrder > 9"),
    "the settings": ("dwConfigCrc <> 16#00000000 AND", "dwConfigCrc = 16#00000000 AND"),
    "obeying what is worse": ("xHas := xHas AND xBearable;", ""),
    "taking from new frames alone": ("xFresh := xGood AND xNew AND", "xFresh := xGood AND"),
    "ageing": ("diGrown := diRate / 1000 * diAge_ms + (diRate MOD 1000 * diAge_ms + 999) / 1000;", "diGrown := 0;"),
    "the limit while it ages": ("xHas := diGrown <= diLimit - diTakenLevel;", ""),
    "latency in the age": ("F_PoseWallMilliseconds(tTime := tonAge.ET) + diTakenLatency_ms;",
                           "F_PoseWallMilliseconds(tTime := tonAge.ET);"),
    "the watchdog": ("IF NOT xAlive OR diAge_ms", "IF diAge_ms"),
    "the end of holding": ("(xHeld AND diAge_ms > F_PoseWallMilliseconds(tTime := tHold))", "FALSE"),
    "no level below zero": ("diLevel >= 0 AND", ""),
    "NO_VALUE": ("diValue <> POSE_WALL_IMAGE_NO_VALUE AND", ""),
    "rates that make sense": ("diRate < 0 OR diRate > POSE_WALL_RATE_MAX OR", ""),
    "a level that is told larger": ("IF xGood AND diLevel > diTakenLevel + diGrown THEN", "IF FALSE THEN"),
    "rises at the start": ("diMissing := diRises;", "diMissing := 0;"),
    "rises after a silence": ("OR (xLate AND stArrived.sequence > udiSequence) THEN", "THEN"),
    "xSafeState": ("xSafeState := NOT xRelease;", "xSafeState := FALSE;"),
    "what the machine needs": ("xRelease := dwNeeded <> 16#00000000 AND", "xRelease :="),
    "the start values": ("xSafeState : BOOL := TRUE;", "xSafeState : BOOL;"),
}


class Campaign:
    def __init__(self, root, compiler, folder):
        self.root, self.compiler, self.folder = pathlib.Path(root), compiler, pathlib.Path(folder)
        # FB_PoseWallMotion, which comes last, repeats some of these rules: plc_test.py has its own tests.
        text = (self.root / "tools/apps/plc/FB_PoseWall.st").read_text(encoding="utf-8")
        self.text = text[:text.index("(* Beside FB_PoseWall, with the motion image")]

    def run(self, text, cycles, seed):
        translated = structured_text_c.translated(structured_text.Program(text))
        (self.folder / "fb_pose_wall.h").write_text(translated, encoding="utf-8")
        program, tests = self.folder / "campaign", self.root / "tests/checks/plc"
        # A number that its type does not hold ends the program.
        subprocess.run([self.compiler, "-std=c99", "-O1", "-w", "-fsanitize=undefined", "-fno-sanitize-recover=all",
                        f"-I{self.folder}", f"-I{self.root / 'include'}", f"-I{tests}", str(tests / "campaign.c"),
                        "-o", str(program)], check=True)
        return subprocess.run([str(program), str(cycles), str(seed)], capture_output=True, text=True, check=False)

    def faults(self, cycles, seed):
        done = self.run(self.text, cycles, seed)
        print(done.stdout + done.stderr, end="")
        if done.returncode != 0:
            yield "FB_PoseWall fails"

    def not_found(self):
        for what, (old, new) in LACKING.items():
            if self.text.count(old) != 1:
                yield f"{what}: {old!r} stands {self.text.count(old)} times in FB_PoseWall.st"
            elif self.run(self.text.replace(old, new), CYCLES_PER_HOUR, 1).returncode == 0:
                yield f"a block without {what} passes"


def main():
    hours, seed = (sys.argv[3:] + ["1", "1"][len(sys.argv[3:]):])[:2]
    with tempfile.TemporaryDirectory() as folder:
        campaign = Campaign(sys.argv[1], sys.argv[2], folder)
        faults = list(campaign.faults(int(float(hours) * CYCLES_PER_HOUR), int(seed)))
        if len(sys.argv) == 3:
            faults += campaign.not_found()
            print(f"{len(LACKING)} blocks that lack a rule")
    print("\n".join(faults), end="\n" if faults else "")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
