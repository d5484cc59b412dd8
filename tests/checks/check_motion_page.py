#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Opens the page that `pose_wall report` makes of a motion table in a headless Chromium and uses it as a person would.

check_motion_page.py REPORT.html FRAMES LOST_FRAME [SCREENSHOT_PREFIX]

As check_report_page.py, whose browser it uses.
"""
import pathlib
import sys

from check_report_page import Browser, Checks, check_chinese, check_quiet

SLIDE = "const s = document.getElementById('slider'); s.value = %d; s.dispatchEvent(new Event('input'));"


def check_views(browser, checks, frames):
    run = browser.run
    slider_at = lambda: int(run("return document.getElementById('slider').value"))
    checks.hold(f"the slider reaches {frames} frames",
                int(run("return document.getElementById('slider').max")) == frames - 1)
    for canvas in ("path", "chart-travel", "chart-step"):
        run(SLIDE % 0)
        checks.hold(f"{canvas} is not empty", run(
            f"const c = document.getElementById('{canvas}'), pen = c.getContext('2d');"
            "return pen.getImageData(0, 0, c.width, c.height).data.some((x) => x)"))
        checks.changes(f"the slider moves {canvas}", canvas, SLIDE % (frames // 2))
    run(SLIDE % 0)
    run("const c = document.getElementById('chart-travel'), b = c.getBoundingClientRect();"
        "c.dispatchEvent(new PointerEvent('pointerdown', {clientX: b.left + 0.8 * b.width, clientY: b.top + 20}))")
    checks.hold("a click into a chart goes to the frame", slider_at() > frames // 2)
    run(SLIDE % 0)
    run("const c = document.getElementById('path'), b = c.getBoundingClientRect();"
        f"const [x, y] = path.point(motion.place, {frames - 1});"
        "c.dispatchEvent(new PointerEvent('pointerdown', {clientX: b.left + x + 1, clientY: b.top + y + 1}))")
    checks.hold(f"a click on the path's end goes to its frame, {slider_at()}", slider_at() == frames - 1)


def check(browser, frames, lost_frame, prefix):
    run, checks = browser.run, Checks(browser)
    text = lambda name: run(f"return document.getElementById('{name}').textContent")
    checks.hold("the verdict says how far it went", "Travel along the road at the end" in text("verdict"))
    checks.hold("errors stand beside the truth", "across" in text("truth"))
    check_views(browser, checks, frames)
    run(SLIDE % lost_frame)
    checks.hold("a lost frame says so and has no place", "lost" in text("values") and "–, –, –" in text("values"))
    grey = "return document.querySelectorAll('#values .not-valid').length"
    checks.hold("its numbers are grey, and it has no bound", run(grey) == 9 and "0.010 m" not in text("values"))
    run(SLIDE % 0)
    checks.hold("those of a measured frame are not", run(grey) == 0 and "0.010 m" in text("values"))
    checks.hold("units stand beside those of the table", "The CSV of pose_wall motion holds radians" in
                run("return document.body.innerText"))
    checks.hold("the rule of the verdict stands on the page", "at least 95 %" in text("verdict"))
    if prefix:
        browser.screenshot(f"{prefix}_light_en.png")
    checks.changes("the theme changes the pictures", "path", "document.getElementById('theme').click()")
    english = text("summary")
    run("document.getElementById('language').click()")
    checks.hold("the other language is Chinese", text("summary") != english and "已测得" in text("summary"))
    checks.hold("so are the reasons", "地图从本帧开始" in text("reasons"))
    check_chinese(browser, checks)
    for language in range(2):
        shown = run("return document.body.innerText")
        checks.hold("no word is missing", not any(word in shown for word in ("undefined", "NaN", "Infinity")))
        run("document.getElementById('language').click()")
    if prefix:
        browser.screenshot(f"{prefix}_dark_zh.png")
    check_quiet(browser, checks)
    return checks.failed


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    browser = Browser()
    try:
        browser.open(pathlib.Path(sys.argv[1]).resolve().as_uri())
        failed = check(browser, int(sys.argv[2]), int(sys.argv[3]), sys.argv[4] if len(sys.argv) > 4 else "")
    finally:
        browser.close()
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
