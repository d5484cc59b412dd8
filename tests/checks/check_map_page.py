#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Opens the page that `pose_wall report` makes of maps in a headless Chromium and uses it as a person would.

check_map_page.py REPORT.html PICTURES [SCREENSHOT_PREFIX]

As check_report_page.py, whose browser it uses.
"""
import pathlib
import sys

from check_report_page import Browser, Checks, check_chinese, check_quiet


def check(browser, pictures, prefix):
    run, checks = browser.run, Checks(browser)
    shown = lambda: run("return document.body.innerText")
    loaded = run("return Array.from(document.images, (x) => x.complete && x.naturalWidth > 100)")
    checks.hold(f"{pictures} pictures are drawn {loaded}", loaded == [True] * pictures)
    checks.hold("the map has its figures", all(words in shown() for words in ("keyframes", "free area")))
    checks.hold("localisation has its states", "unique" in shown() and "travel until unique" in shown())
    paper = "return getComputedStyle(document.body).backgroundColor"
    before = run(paper)
    if prefix:
        browser.screenshot(f"{prefix}_light_en.png")
    run("document.getElementById('theme').click()")
    checks.hold("the theme changes the page", run(paper) != before)
    run("document.getElementById('language').click()")
    checks.hold("the other language is Chinese", "关键帧" in shown() and "keyframes" not in shown())
    check_chinese(browser, checks)
    for _ in range(2):
        checks.hold("no word is missing", not any(word in shown() for word in ("undefined", "NaN", "nan", "null")))
        run("document.getElementById('language').click()")
    check_quiet(browser, checks)
    return checks.failed


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    browser = Browser()
    try:
        browser.open(pathlib.Path(sys.argv[1]).resolve().as_uri())
        failed = check(browser, int(sys.argv[2]), sys.argv[3] if len(sys.argv) > 3 else "")
    finally:
        browser.close()
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
