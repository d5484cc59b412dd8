#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Runs FB_PoseWallStop through hours of cycles with random faults (tests/checks/plc/stop_campaign.c), as
plc_campaign.py does it with FB_PoseWall. Then the same for blocks with one rule taken away each: the oracle must find
every one of them.

usage: plc_stop_campaign.py ROOT CC [HOURS [SEED [CYCLE_MS]]]    without HOURS: ten hours of 100 ms cycles and one of
                                                                 20 ms, seed 1, and the blocks that lack a rule"""

import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the sources stay as they are
sys.path.insert(0, str(pathlib.Path(__file__).parent))

import structured_text  # noqa: E402  pylint: disable=wrong-import-position
import structured_text_c  # noqa: E402  pylint: disable=wrong-import-position

MS_PER_HOUR = 3600000
BEGIN = "(* Beside FB_PoseWall, with the stop's image"
# What is taken away, and what stands in its place; some rules stand at two places
LACKING = {
    "the sum": ("adwNative[POSE_WALL_IMAGE_CRC_WORD] <> fbSum.dwSum", "diByteOrder > 9"),
    "the settings": ("dwSettingsCrc <> 16#00000000 AND", "dwSettingsCrc = 16#00000000 AND"),
    "rises at the start": ("diMissing := diRises;", "diMissing := 0;"),
    "a fall": ("POSE_WALL_FAULT_CONFIG OR diStep < 0 OR", "POSE_WALL_FAULT_CONFIG OR",
               "ELSIF diStep < 0 OR (xFresh", "ELSIF (xFresh"),
    "heartbeats that only go on": ("xFresh := diStep > 0;", "xFresh := diStep <> 0;"),
    "the watchdog": ("xLate := NOT xSeen OR tonBeat.Q OR diWait_ms + diLag_ms >= diWatchdog_ms;", "xLate := FALSE;"),
    "lag on the way": ("diLag_ms := diLag_ms + diWait_ms - diClock_ms;", "diLag_ms := 0;"),
    "the age of the frame": ("OR diAge_ms >= F_PoseWallMilliseconds(tTime := tAgeMost) THEN", "THEN"),
    "the time here in the age": ("diAge_ms := diWait_ms + diLag_ms + diFrameAge_ms;", "diAge_ms := diFrameAge_ms / 2;"),
    "taking from new heartbeats alone": ("ELSIF xFresh THEN\n  diState", "ELSIF TRUE THEN\n  diState"),
    "obeying what is worse": ("IF diTold < diState THEN", "IF FALSE THEN"),
    "obeying a lower speed": ("IF diToldSpeed < diSpeed THEN", "IF FALSE THEN"),
    "speeds": ("AND diToldSpeed > 0 THEN", "THEN"),
    "the speed of a stop": ("diAllowed_mm_s := 0;", ""),
    "the start values": ("xStop : BOOL := TRUE;", "xStop : BOOL;"),
    "a stop in every doubt": ("IF udiFault <> POSE_WALL_FAULT_NONE THEN", "IF udiFault > 9 THEN"),
}


class Campaign:
    def __init__(self, root, compiler, folder):
        self.root, self.compiler, self.folder = pathlib.Path(root), compiler, pathlib.Path(folder)
        text = (self.root / "tools/apps/plc/FB_PoseWall.st").read_text(encoding="utf-8")
        at = text.index(BEGIN)
        self.before, self.block = text[:at], text[at:]

    def build(self, block):
        translated = structured_text_c.translated(structured_text.Program(self.before + block))
        (self.folder / "fb_pose_wall.h").write_text(translated, encoding="utf-8")
        program, tests = self.folder / "campaign", self.root / "tests/checks/plc"
        # A number that its type does not hold ends the program.
        subprocess.run([self.compiler, "-std=c99", "-O1", "-w", "-fsanitize=undefined", "-fno-sanitize-recover=all",
                        f"-I{self.folder}", f"-I{self.root / 'include'}", f"-I{tests}",
                        str(tests / "stop_campaign.c"), "-o", str(program)], check=True)
        return program

    def run(self, block, hours, seed, cycle_ms):
        program, cycles = self.build(block), int(hours * MS_PER_HOUR / cycle_ms)
        return subprocess.run([str(program), str(cycles), str(seed), str(cycle_ms)], capture_output=True, text=True,
                              check=False)

    def faults(self, hours, seed, cycle_ms):
        done = self.run(self.block, hours, seed, cycle_ms)
        print(done.stdout + done.stderr, end="")
        if done.returncode != 0:
            yield "FB_PoseWallStop fails"

    def not_found(self):
        for what, texts in LACKING.items():
            block = self.block
            for old, new in zip(texts[::2], texts[1::2]):
                if block.count(old) != 1:
                    yield f"{what}: {old!r} stands {block.count(old)} times in FB_PoseWallStop"
                block = block.replace(old, new)
            if self.run(block, 10, 1, 100).returncode == 0:
                yield f"a block without {what} passes"


def main():
    given = sys.argv[3:]
    with tempfile.TemporaryDirectory() as folder:
        campaign = Campaign(sys.argv[1], sys.argv[2], folder)
        if given:
            hours, seed, cycle_ms = (given + ["10", "1", "100"][len(given):])[:3]
            faults = list(campaign.faults(float(hours), int(seed), int(cycle_ms)))
        else:
            faults = [*campaign.faults(10, 1, 100), *campaign.faults(1, 1, 20), *campaign.not_found()]
            print(f"{len(LACKING)} blocks that lack a rule")
    print("\n".join(faults), end="\n" if faults else "")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
