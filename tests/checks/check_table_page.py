#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""A report of a table of `run` in a headless browser: it says what it lacks, and shows the values.

usage: check_table_page.py REPORT.html FRAMES"""

import pathlib
import sys

from check_report_page import Browser, Checks, check_chinese, check_quiet


def check(browser, frames):
    run, checks = browser.run, Checks(browser)
    text = lambda name: run(f"return document.getElementById('{name}').textContent")
    count = lambda what: run(f"return document.querySelectorAll('{what}').length")
    checks.hold("it says that it has no clouds", "Made from the table alone: no clouds, no pictures" in text("verdict"))
    checks.hold("there is no picture of a cloud", count("#views canvas") == 0 and count("#layers input") == 0)
    checks.hold("seven charts, seven rows of values", count(".chart canvas") == 7 and count("#values tr") == 8)
    checks.hold("it says how to get the parts", "run --parts" in text("level-parts") and count("#levels tr") == 0)
    checks.hold(f"the slider reaches {frames} frames",
                run("return document.getElementById('slider').max") == str(frames - 1))
    run("const s = document.getElementById('slider'); s.value = 5; s.dispatchEvent(new Event('input'));")
    checks.hold("the slider names the frame", "frame 5 " in text("frame-name"))
    broken = run("return recording.error.findIndex((text) => text)")
    run(f"show_frame({broken})")
    states = run("return Array.from(document.querySelectorAll('#values .state'), (x) => x.textContent)")
    checks.hold(f"a frame that could not be read says so {states}", broken >= 0 and states == ["unreadable"] * 7)
    run("show_frame(0); document.getElementById('theme').click(); document.getElementById('language').click()")
    checks.hold("it says it in Chinese, too", "仅由结果表生成" in text("verdict"))
    check_chinese(browser, checks)
    whole = run("return document.body.innerText")
    checks.hold("no word is missing", "undefined" not in whole and "NaN" not in whole)
    check_quiet(browser, checks)
    return checks.failed


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    browser = Browser()
    try:
        browser.open(pathlib.Path(sys.argv[1]).resolve().as_uri())
        failed = check(browser, int(sys.argv[2]))
    finally:
        browser.close()
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
