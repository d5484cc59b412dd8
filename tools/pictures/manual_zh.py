#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Makes the pictures of the Chinese field manual (tools/apps/live/manual) anew: the live page as a technician sees it.

usage: manual_zh.py POSE_WALL POSE_WALLD     needs chromium, chromedriver, a Chinese font and python3-pil"""

import json
import pathlib
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "tests/live"), str(ROOT / "tests/checks")]

import check_report_page  # noqa: E402  pylint: disable=wrong-import-position
import live_peer  # noqa: E402  pylint: disable=wrong-import-position
from PIL import Image  # noqa: E402  pylint: disable=wrong-import-position

FOLDER = ROOT / "tools/apps/live/manual"
PORT = live_peer.free_port()
WIDTH = 1000  # of the page in its pictures: narrow enough to be read in print
COLOURS = 128  # of a picture: text, lines and a map need no more
HEIGHT = 5200  # more than the page has: nothing scrolls
RATE_HZ = 2  # of the stop's frames: a machine that draws pages beside it keeps up. A sensor gives ten a second
EVERY_S = 0.2  # a frame of the other pictures: from 0.3 s on without one the daemon tells a silence
FRAMES = 100  # enough for all pictures. Clouds that come again are told as frozen
# A rectangle and a floor that fit the simulated machine, so that the stop is about the road and not about the settings.
PLANAR = ("planar=map", "planar_map_every_s=1", "planar_x_min=-2.3", "planar_x_max=2.3", "planar_y_min=-0.7",
          "planar_y_max=0.7", "planar_floor_z=-1.35", "planar_period=0.5", "planar_stale=1",
          "planar_speed_max=0.2", "range_max=60")


class Frames(threading.Thread):
    """Gives the daemon a frame at a time, until the sensor is to be silent."""

    def __init__(self, daemon):
        super().__init__(daemon=True)
        self.daemon_program, self.goes = daemon, True

    def run(self):
        while self.goes:
            self.daemon_program.process.stdin.write("\n")
            self.daemon_program.process.stdin.flush()
            time.sleep(EVERY_S)


class Page:
    def __init__(self, port):
        self.browser = check_report_page.Browser(WIDTH, HEIGHT, "127.0.0.1")
        self.browser.open(f"http://127.0.0.1:{port}/")
        self.browser.run("page.language = 'zh'; document.documentElement.dataset.theme = 'light'; show_all()")

    def waits_for(self, condition):
        if not live_peer.becomes_true(lambda: self.browser.run(f"return {condition}"), 120):
            sys.exit(f"the page never got so far: {condition}")

    def stands_still_when(self, condition):
        """What is drawn then stays: a picture of a page that goes on takes longer than a browser waits."""
        freeze = "show_frame = show_link = () => {}; if (roadway) roadway.show = () => {};"
        wanted = f"if (!({condition})) return false; {freeze} return true"
        if not live_peer.becomes_true(lambda: self.browser.run(wanted), 120):
            sys.exit(f"the page never got so far: {condition}")

    def shoot(self, name, *spans):
        """From the top of one element to the end of another, span below span."""
        made = pathlib.Path(self.folder, name)
        time.sleep(1)  # until the last words have their place
        places = self.browser.run(
            "const box = (name) => document.querySelector(name).getBoundingClientRect();"
            f"return {json.dumps(spans)}.map(([first, last]) => [box(first).top, box(last).bottom])")
        self.browser.screenshot(made)
        whole = Image.open(made).convert("RGB")
        scale = whole.width / self.browser.run("return innerWidth")
        width = round(scale * self.browser.run("return document.documentElement.clientWidth"))  # no bar beside it
        cuts = [whole.crop((0, max(0, round((top - 8) * scale)), width, round((bottom + 8) * scale)))
                for top, bottom in places]
        picture = Image.new("RGB", (width, sum(cut.height for cut in cuts)))
        for at, cut in enumerate(cuts):
            picture.paste(cut, (0, sum(above.height for above in cuts[:at])))
        picture.quantize(COLOURS, dither=Image.Dither.NONE).save(FOLDER / name, optimize=True)
        print(f"{name}: {picture.width} x {picture.height}, {(FOLDER / name).stat().st_size} bytes")

    def __enter__(self):
        self.made = tempfile.TemporaryDirectory()
        self.folder = self.made.name
        return self

    def __exit__(self, *fault):
        self.browser.close()
        self.made.cleanup()


def stop_picture(words):
    planar = (word for setting in PLANAR for word in ("--set", setting))
    with live_peer.running(*words, *planar), Page(PORT) as shown:
        shown.waits_for("recording && recording.frames > 10 && roadway.map !== null")
        shown.browser.run("document.getElementById('roadway-zoom').click()")
        shown.stands_still_when("document.getElementById('place-line').textContent.includes('已知')")
        shown.shoot("stop.png", ("#stop-line", "#stop-line"), ("#roadway-panel", "#roadway-panel"))


def page_picture(words):
    with live_peer.running(*words, "--step", stdin=subprocess.PIPE) as daemon, Page(PORT) as shown:
        frames = Frames(daemon)
        frames.start()
        shown.waits_for("recording && recording.frames > 10")
        valid = "[...document.querySelectorAll('#tiles .state')].every((state) => state.textContent.startsWith('有效'))"
        shown.stands_still_when("document.getElementById('steer-not').textContent === '' && "
                                "document.getElementById('link').textContent.startsWith('实时') && "
                                f"document.getElementById('health').textContent.includes('正在测量') && {valid}")
        shown.shoot("page.png", ("#first", "#frame-panel"))
        shown.shoot("parts.png", ("#health", "#health"))
        frames.goes = False
        frames.join()


def silent_picture(words):
    with live_peer.running(*words, "--step", stdin=subprocess.PIPE) as daemon, Page(PORT) as shown:
        frames = Frames(daemon)
        frames.start()
        shown.waits_for("recording && recording.frames > 10")
        frames.goes = False
        frames.join()
        shown.stands_still_when("document.getElementById('link').textContent.includes('没有数据')")
        shown.shoot("silent.png", ("#first", "#tiles"))


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with tempfile.TemporaryDirectory() as road:
        subprocess.run([sys.argv[1], "sim", "--quiet", "--scene", "nominal", "--frames", str(FRAMES), "--rate",
                        str(RATE_HZ), "--output", road], check=True)
        words = [sys.argv[2], "--config", f"{road}/pose_wall.yaml", "--replay", f"{road}/frames", "--http",
                 f"127.0.0.1:{PORT}", "--language", "en"]
        page_picture(words)
        silent_picture(words)
        stop_picture(words)


if __name__ == "__main__":
    main()
